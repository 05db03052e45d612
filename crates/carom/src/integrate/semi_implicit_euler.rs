use glam::DVec3;

use super::kinematics::Kinematics;

/// `v' = v + h a(x, v)`, `x' = x + h v'`.
///
/// Source: Hairer, Lubich, Wanner, "Geometric Numerical Integration", I.1.2 (symplectic Euler).
pub(super) fn advance(
    start: Kinematics,
    h: f64,
    acceleration: impl Fn(f64, Kinematics) -> DVec3,
) -> Kinematics {
    let velocity = start.velocity + h * acceleration(0.0, start);
    Kinematics { position: start.position + h * velocity, velocity }
}
