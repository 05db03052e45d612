//! Camera of a link.

use carom::DVec3;

use super::error::{LinkError, quoted};

/// Largest error of a camera's position, relative to its distance: a tenth of a pixel of a large
/// picture.
const SEEN: f64 = 3e-5;

/// Default field of view \[°\].
const USUAL_FOV_DEGREES: f64 = 35.0;

/// Position and target of a camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinkCamera {
    /// Position of the camera \[m\].
    pub position: DVec3,
    /// Point in the middle of the picture \[m\]; differs from the position.
    pub target: DVec3,
    /// Vertical field of view \[°\], in (0, 180).
    pub vertical_fov_degrees: f64,
}

impl LinkCamera {
    /// Writes position and target with few digits, then the field of view if it is not the default.
    pub(super) fn written(&self) -> String {
        let slack = SEEN * self.position.distance(self.target);
        let places = self.position.to_array().into_iter().chain(self.target.to_array());
        let fov = self.vertical_fov_degrees;
        let own = (fov != USUAL_FOV_DEGREES).then(|| short(fov, SEEN * fov));
        let numbers = places.map(|place| short(place, slack)).chain(own);
        numbers.collect::<Vec<_>>().join(",")
    }

    /// Reads a camera from this form.
    ///
    /// # Errors
    /// [`LinkError::Camera`] unless the text has six numbers, of two different points, or seven
    /// with a field of view.
    pub(super) fn read(text: &str) -> Result<Self, LinkError> {
        let wrong = || LinkError::Camera { found: quoted(text) };
        let numbers: Result<Vec<f64>, _> = text.split(',').map(str::parse).collect();
        let mut numbers = numbers.map_err(|_| wrong())?;
        if numbers.len() == 6 {
            numbers.push(USUAL_FOV_DEGREES);
        }
        let [x, y, z, target_x, target_y, target_z, vertical_fov_degrees] = *numbers else {
            return Err(wrong());
        };
        let (position, target) = (DVec3::new(x, y, z), DVec3::new(target_x, target_y, target_z));
        Self { position, target, vertical_fov_degrees }.checked().ok_or_else(wrong)
    }

    /// Returns the camera if its direction and field of view are valid.
    fn checked(self) -> Option<Self> {
        let distance = self.position.distance(self.target);
        let fov = self.vertical_fov_degrees;
        (distance > 0.0 && distance.is_finite() && fov > 0.0 && fov < 180.0).then_some(self)
    }
}

/// Writes a number with the fewest decimals whose error is at most `slack`.
fn short(value: f64, slack: f64) -> String {
    let rounded = (0..=15).map(|decimals| format!("{value:.decimals$}"));
    let is_near = |text: &String| text.parse().is_ok_and(|it: f64| (it - value).abs() <= slack);
    let text = rounded.into_iter().find(is_near).unwrap_or_else(|| format!("{value:?}"));
    if text.trim_matches(['-', '0', '.']).is_empty() { "0".to_owned() } else { text }
}
