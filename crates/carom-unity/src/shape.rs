//! Forms of colliders: built-in meshes, and the colliders of Unity's own physics.

use carom::{DQuat, DVec3};
use carom_scene::import::shortened;
use carom_scene::scene::Shape;

use crate::class;
use crate::document::Document;
use crate::error::ImportError;
use crate::pose::Pose;
use crate::value::Value;

/// A form at a place, in Unity's frame.
#[derive(Debug, Clone)]
pub(crate) struct Placed {
    pub shape: Shape,
    pub position: DVec3,
    pub rotation: DQuat,
    /// What is not quite so, if anything.
    pub inexact: Option<&'static str>,
}

/// A mesh that comes with Unity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mesh {
    /// Of diameter 1.
    Sphere,
    /// With edges of 1.
    Cube,
    /// 10 x 10 in the xz plane, facing +y.
    Plane,
    /// 1 x 1 in the xy plane, facing -z.
    Quad,
}

impl Mesh {
    /// The built-in mesh of a reference.
    ///
    /// # Errors
    /// Why it is none, for the report.
    pub fn of(reference: Option<&Value>) -> Result<Self, String> {
        const BUILT_IN: &str = "0000000000000000e000000000000000";
        let reference = reference.and_then(Value::reference).ok_or("it has no mesh")?;
        if reference.guid.as_deref() != Some(BUILT_IN) {
            return Err("its mesh is none of sphere, cube, plane and quad".to_owned());
        }
        match reference.id {
            10202 => Ok(Self::Cube),
            10207 => Ok(Self::Sphere),
            10209 => Ok(Self::Plane),
            10210 => Ok(Self::Quad),
            10206 => Err("a cylinder has no counterpart".to_owned()),
            10208 => Err("a capsule has no counterpart".to_owned()),
            id => Err(format!("the built-in mesh {id} is not known")),
        }
    }

    /// The collider of this form at a pose.
    pub fn placed(self, pose: &Pose) -> Placed {
        let scale = pose.scale();
        let whole = Placed {
            shape: Shape::HalfSpace,
            position: pose.position,
            rotation: pose.rotation,
            inexact: sheared(pose),
        };
        match self {
            Self::Sphere => Placed {
                shape: Shape::Sphere { radius: short(0.5 * scale.max_element()) },
                inexact: whole.inexact.or(uneven(scale)),
                ..whole
            },
            Self::Cube => {
                Placed { shape: Shape::Box { size: shortened(scale.to_array()) }, ..whole }
            }
            Self::Plane => {
                let (size_x, size_z) = (short(10.0 * scale.x), short(10.0 * scale.z));
                Placed { shape: Shape::Rectangle { size_x, size_z }, ..whole }
            }
            Self::Quad => {
                // From +y to -z, about x.
                let half = 0.5_f64.sqrt();
                let rotation = pose.rotation * DQuat::from_xyzw(-half, 0.0, 0.0, half);
                let (size_x, size_z) = (short(scale.x), short(scale.y));
                Placed { shape: Shape::Rectangle { size_x, size_z }, rotation, ..whole }
            }
        }
    }
}

/// The form of a collider of Unity's own physics; `Err` says for the report why it has none.
///
/// # Errors
/// Numbers that are none.
pub(crate) fn of_collider(
    collider: &Document,
    pose: &Pose,
) -> Result<Result<Placed, String>, ImportError> {
    let fields = &collider.fields;
    let scale = pose.scale();
    let (rotation, inexact) = (pose.rotation, sheared(pose));
    Ok(match collider.class {
        class::SPHERE_COLLIDER => {
            let position = pose.point(fields.vector_at("m_Center", DVec3::ZERO)?);
            let radius = fields.number_at("m_Radius", 0.5)?;
            let radius = short(radius * scale.max_element());
            let inexact = inexact.or(uneven(scale));
            Ok(Placed { shape: Shape::Sphere { radius }, position, rotation, inexact })
        }
        class::BOX_COLLIDER => {
            let position = pose.point(fields.vector_at("m_Center", DVec3::ZERO)?);
            let size =
                shortened((fields.vector_at("m_Size", DVec3::ONE)? * scale).abs().to_array());
            Ok(Placed { shape: Shape::Box { size }, position, rotation, inexact })
        }
        _ => Mesh::of(fields.get("m_Mesh")).map(|mesh| mesh.placed(pose)),
    })
}

fn short(number: f64) -> f64 {
    shortened([number])[0]
}

fn sheared(pose: &Pose) -> Option<&'static str> {
    pose.is_sheared().then_some("the scales of its parents shear it; its form is kept unsheared")
}

fn uneven(scale: DVec3) -> Option<&'static str> {
    let even = scale.max_element() - scale.min_element() <= 1e-5 * scale.max_element();
    (!even).then_some("is scaled to an ellipsoid; the sphere around it is taken")
}
