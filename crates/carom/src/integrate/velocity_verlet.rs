use glam::DVec3;

use super::kinematics::Kinematics;

/// `x' = x + h v + h²/2 a`, `v' = v + h/2 (a + a')` with `a' = a(x', v + h a)`.
///
/// The predicted velocity `v + h a` keeps the second order where forces depend on the velocity.
/// Source: Swope, Andersen, Berens, Wilson, J. Chem. Phys. 76, 637 (1982); the prediction as in
/// Groot and Warren, J. Chem. Phys. 107, 4423 (1997), with their lambda = 1.
pub(super) fn advance(
    start: Kinematics,
    h: f64,
    acceleration: impl Fn(f64, Kinematics) -> DVec3,
) -> Kinematics {
    let a = acceleration(0.0, start);
    let predicted = Kinematics {
        position: start.position + h * (start.velocity + 0.5 * h * a),
        velocity: start.velocity + h * a,
    };
    let velocity = start.velocity + 0.5 * h * (a + acceleration(h, predicted));
    Kinematics { position: predicted.position, velocity }
}
