//! A camera that shows a whole maze.

use carom::{DQuat, DVec3};
use carom_scene::scene::Camera;

/// Angle below the horizon \[rad\], so steep that walls hide little of what is behind them.
const PITCH: f64 = 66.0 / 180.0 * std::f64::consts::PI;
const VERTICAL_FOV_DEGREES: f64 = 40.0;
/// Ratio of width to height of a picture.
const ASPECT: f64 = 16.0 / 9.0;
/// Factor by which the maze may be larger when it is tilted.
const MARGIN: f64 = 1.12;

/// Returns a camera that shows the box from -half to +half \[m\], from +z and above.
pub(crate) fn fitted(half: DVec3) -> Camera {
    let (sine, cosine) = libm::sincos(PITCH);
    let back = DVec3::new(0.0, sine, cosine);
    let up = DVec3::new(0.0, cosine, -sine);
    let tangent = libm::tan(0.5 * VERTICAL_FOV_DEGREES.to_radians());
    // A point p is in the picture if |p·up| and |p·x| / aspect are within (distance - p·back) tan.
    let mut distance: f64 = 0.0;
    for corner in 0..8 {
        let side = |bit: u32| if corner >> bit & 1 == 0 { -MARGIN } else { MARGIN };
        let point = half * DVec3::new(side(0), side(1), side(2));
        let across = point.dot(up).abs().max(point.x.abs() / ASPECT);
        distance = distance.max(across / tangent + point.dot(back));
    }
    let position = distance * back;
    let (sine, cosine) = libm::sincos(-0.5 * PITCH);
    let rotation = DQuat::from_xyzw(sine, 0.0, 0.0, cosine);
    Camera {
        position: position.to_array(),
        rotation: rotation.to_array(),
        vertical_fov_degrees: VERTICAL_FOV_DEGREES,
        near: 0.3,
        far: 1000.0,
    }
}
