//! Points of view that suit any scene.

use carom::DVec3;

use crate::bounds::Bounds;
use crate::camera::Camera;

/// A point of view.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Preset {
    /// The scene's own camera; [`Self::Whole`] where it has none.
    Scene,
    /// Shows everything, from a little to the right and above.
    Whole,
    /// View from the front, along -z.
    Front,
    /// View from straight above.
    Top,
}

/// Direction of the view from a little to the right and above.
const OBLIQUE: DVec3 = DVec3::new(0.45, 0.5, 1.0);

impl Preset {
    /// Returns the camera at this point of view that shows `bounds`, in a picture with this ratio
    /// of width to height.
    pub fn camera(self, of_scene: Option<Camera>, bounds: &Bounds, aspect: f64) -> Camera {
        let fitted = |from| Camera::fitted(bounds, from, aspect);
        match self {
            Self::Scene => of_scene.unwrap_or_else(|| fitted(OBLIQUE)),
            Self::Whole => fitted(OBLIQUE),
            Self::Front => fitted(DVec3::Z),
            Self::Top => fitted(DVec3::Y),
        }
    }
}
