//! Cameras chosen on the command line.

use std::str::FromStr;

use carom::DVec3;
use carom_render::{Bounds, Camera, Preset};

/// Camera chosen on the command line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Viewpoint {
    /// A camera that depends on the scene.
    Preset(Preset),
    /// A camera at one point that looks at another \[m\].
    Between {
        /// Position of the camera.
        position: DVec3,
        /// Point in the middle of the picture.
        target: DVec3,
    },
}

impl Viewpoint {
    /// Creates the camera for a picture; `aspect` is width / height.
    pub fn camera(&self, of_scene: Option<Camera>, bounds: &Bounds, aspect: f64) -> Camera {
        match *self {
            Self::Preset(preset) => preset.camera(of_scene, bounds, aspect),
            Self::Between { position, target } => {
                Camera::looking_at(position, target, Camera::VERTICAL_FOV_DEGREES.to_radians())
            }
        }
    }
}

impl FromStr for Viewpoint {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let preset = match text {
            "scene" => Preset::Scene,
            "fit" => Preset::Whole,
            "front" => Preset::Front,
            "top" => Preset::Top,
            _ => return between(text),
        };
        Ok(Self::Preset(preset))
    }
}

fn between(text: &str) -> Result<Viewpoint, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    let needed = "scene, front, top or fit is needed, or six numbers: X,Y,Z of the camera, \
                  TX,TY,TZ of what it looks at";
    let numbers = numbers.map_err(|_| needed)?;
    let [x, y, z, tx, ty, tz] = *numbers.as_slice() else { return Err(needed.to_owned()) };
    let (position, target) = (DVec3::new(x, y, z), DVec3::new(tx, ty, tz));
    if !position.is_finite() || !target.is_finite() || position == target {
        return Err("the camera and what it looks at must be two different points".to_owned());
    }
    Ok(Viewpoint::Between { position, target })
}
