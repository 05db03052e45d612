//! Shapes at their poses.

use carom::{DQuat, DVec3};
use carom_scene::scene::{Quaternion, Shape, Vector};

use super::form::Form;
use super::pose::Pose;

/// A shape at a pose.
#[derive(Debug, Clone)]
pub(super) struct Solid {
    pub shape: Shape,
    pub position: Vector,
    pub rotation: Quaternion,
    /// Description of an inexact conversion, if there is one.
    pub inexact: Option<&'static str>,
}

impl Solid {
    /// Places a form at the pose of its node; the error is the reason for the report.
    pub fn of(form: &Form, pose: &Pose) -> Result<Self, &'static str> {
        let (center, rotation) = match *form {
            Form::Sphere { center, .. } => (center, DQuat::IDENTITY),
            Form::Box { center, rotation, .. } | Form::Rectangle { center, rotation, .. } => {
                (center, rotation)
            }
            Form::HalfSpace => (DVec3::ZERO, DQuat::IDENTITY),
        };
        let pose = pose.at(center, rotation);
        let scale = pose.scale().abs();
        if scale.max_element() == 0.0 {
            return Err(NO_SIZE);
        }
        let length = |length: f64| pose.written_length(length);
        let sheared = pose.is_sheared().then_some(SHEARED);
        let uneven = (scale.max_element() - scale.min_element() > 1e-5 * scale.max_element())
            .then_some("is scaled to an ellipsoid; the sphere around it is taken");
        let (shape, inexact) = match *form {
            Form::Sphere { radius, .. } => {
                let radius = length(radius * scale.max_element());
                (Shape::Sphere { radius }, sheared.or(uneven))
            }
            Form::Box { size, .. } => {
                (Shape::Box { size: (size * scale).to_array().map(length) }, sheared)
            }
            Form::Rectangle { size: [x, z], .. } => {
                let (size_x, size_z) = (length(x * scale.x), length(z * scale.z));
                (Shape::Rectangle { size_x, size_z }, sheared)
            }
            Form::HalfSpace => (Shape::HalfSpace, sheared),
        };
        let is_flat = matches!(shape, Shape::Rectangle { .. } | Shape::HalfSpace);
        // A mirrored surface faces the opposite direction.
        let rotation = match is_flat && pose.scale().y < 0.0 {
            true => pose.rotation * DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0),
            false => pose.rotation,
        };
        let (position, rotation) = (pose.written_position(), rotation.to_array());
        Ok(Self { shape, position, rotation, inexact })
    }

    /// Returns the back side of a rectangle.
    pub fn back(&self) -> Self {
        let around = DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0);
        let rotation = DQuat::from_array(self.rotation) * around;
        Self { rotation: rotation.to_array(), ..self.clone() }
    }
}

/// Why a node cannot be imported.
pub(super) const NO_SIZE: &str = "has no size at the start: it appears later";
const SHEARED: &str = "the scales of its parents shear it; its form is kept unsheared";
