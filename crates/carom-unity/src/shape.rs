//! Shapes of colliders: built-in meshes, and colliders of Unity's own physics.

use carom::{DQuat, DVec3};
use carom_scene::import::shortened;
use carom_scene::scene::Shape;

use crate::class;
use crate::document::Document;
use crate::error::ImportError;
use crate::model;
use crate::placed::Placed;
use crate::pose::Pose;
use crate::project::Project;
use crate::value::Value;

/// A mesh that comes with Unity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mesh {
    /// A sphere of diameter 1.
    Sphere,
    /// A cube with edges of 1.
    Cube,
    /// A rectangle of 10 x 10 in the xz plane that faces +y.
    Plane,
    /// A rectangle of 1 x 1 in the xy plane that faces -z.
    Quad,
}

impl Mesh {
    /// Finds the built-in mesh of a number.
    ///
    /// # Errors
    /// The reason for the report, if it is no such mesh.
    fn built_in(id: i64) -> Result<Self, String> {
        match id {
            10202 => Ok(Self::Cube),
            10207 => Ok(Self::Sphere),
            10209 => Ok(Self::Plane),
            10210 => Ok(Self::Quad),
            10206 => Err("a cylinder has no counterpart".to_owned()),
            10208 => Err("a capsule has no counterpart".to_owned()),
            id => Err(format!("the built-in mesh {id} is not known")),
        }
    }

    /// Shape of this mesh at a pose.
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
                // Rotates +y to -z, about x.
                let half = 0.5_f64.sqrt();
                let rotation = pose.rotation * DQuat::from_xyzw(-half, 0.0, 0.0, half);
                let (size_x, size_z) = (short(scale.x), short(scale.y));
                Placed { shape: Shape::Rectangle { size_x, size_z }, rotation, ..whole }
            }
        }
    }
}

/// Shape of the mesh of a reference: one that comes with Unity, or a model of the project.
///
/// # Errors
/// The reason for the report.
pub(crate) fn of_mesh(
    reference: Option<&Value>,
    pose: &Pose,
    project: &Project,
) -> Result<Placed, String> {
    const BUILT_IN: &str = "0000000000000000e000000000000000";
    let reference = reference.and_then(Value::reference).ok_or("it has no mesh")?;
    match reference.guid.as_deref() {
        Some(BUILT_IN) => Mesh::built_in(reference.id).map(|mesh| mesh.placed(pose)),
        Some(guid) => model::placed(guid, pose, project),
        None => Err("its mesh is in the scene itself, which is not read".to_owned()),
    }
}

/// Shape of a collider of Unity's own physics; the inner error is the reason for the report.
///
/// # Errors
/// [`ImportError`] for an invalid number.
pub(crate) fn of_collider(
    collider: &Document,
    pose: &Pose,
    project: &Project,
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
        class::CAPSULE_COLLIDER => Ok(capsule(fields, pose)?),
        _ => of_mesh(fields.get("m_Mesh"), pose, project),
    })
}

/// Shape of a capsule along x, y or z, by its direction. As in Unity, the larger scale across it counts for the radius,
/// and a height below the diameter makes a sphere.
fn capsule(fields: &Value, pose: &Pose) -> Result<Placed, ImportError> {
    let half = 0.5_f64.sqrt();
    let scale = pose.scale();
    let (along, across, turn) = match fields.number_at("m_Direction", 1.0)? {
        0.0 => (scale.x, scale.y.max(scale.z), DQuat::from_xyzw(0.0, 0.0, -half, half)),
        2.0 => (scale.z, scale.x.max(scale.y), DQuat::from_xyzw(half, 0.0, 0.0, half)),
        _ => (scale.y, scale.x.max(scale.z), DQuat::IDENTITY),
    };
    let radius = across * fields.number_at("m_Radius", 0.5)?;
    let length = along * fields.number_at("m_Height", 1.0)? - 2.0 * radius;
    let shape = if length > 0.0 {
        Shape::Capsule { radius: short(radius), length: short(length) }
    } else {
        Shape::Sphere { radius: short(radius) }
    };
    Ok(Placed {
        shape,
        position: pose.point(fields.vector_at("m_Center", DVec3::ZERO)?),
        rotation: pose.rotation * turn,
        inexact: sheared(pose),
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
