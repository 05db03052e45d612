//! Shapes where they stand in a scene.

use carom::{DQuat, DVec3};
use carom_scene::scene::Shape;

/// A shape with its pose in Unity's coordinates.
#[derive(Debug, Clone)]
pub(crate) struct Placed {
    pub shape: Shape,
    pub position: DVec3,
    pub rotation: DQuat,
    /// Description of an inexact conversion, if there is one.
    pub inexact: Option<&'static str>,
}
