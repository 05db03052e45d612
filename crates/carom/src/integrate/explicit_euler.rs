use glam::DVec3;

use super::kinematics::Kinematics;

/// `x' = x + h v`, `v' = v + h a(x, v)`.
///
/// Source: Hairer, Nørsett, Wanner, "Solving Ordinary Differential Equations I", I.7.
pub(super) fn advance(
    start: Kinematics,
    h: f64,
    acceleration: impl Fn(f64, Kinematics) -> DVec3,
) -> Kinematics {
    Kinematics {
        position: start.position + h * start.velocity,
        velocity: start.velocity + h * acceleration(0.0, start),
    }
}
