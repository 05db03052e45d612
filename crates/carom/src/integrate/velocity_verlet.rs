use glam::DVec3;

use super::kinematics::Kinematics;
use super::scheme::{MOST_STAGES, Scheme};

/// `x' = x + h v + h²/2 a`, `v' = v + h/2 (a + a')` with `a' = a(x', v + h a)`.
///
/// The predicted velocity `v + h a` keeps the second order where forces depend on the velocity.
/// Source: Swope, Andersen, Berens, Wilson, J. Chem. Phys. 76, 637 (1982); the prediction as in
/// Groot and Warren, J. Chem. Phys. 107, 4423 (1997), with their lambda = 1.
pub(super) struct VelocityVerlet;

impl Scheme for VelocityVerlet {
    const STAGES: usize = 2;
    const ORDER: u32 = 2;
    const WEIGHTS: [f64; MOST_STAGES] = [0.5, 0.5, 0.0, 0.0];

    fn stage(start: Kinematics, h: f64, known: &[DVec3]) -> (f64, Kinematics) {
        match *known {
            [] => (0.0, start),
            [a, ..] => (h, predicted(start, h, a)),
        }
    }

    fn end(start: Kinematics, h: f64, known: &[DVec3]) -> Kinematics {
        let position = predicted(start, h, known[0]).position;
        Kinematics { position, velocity: start.velocity + 0.5 * h * (known[0] + known[1]) }
    }
}

fn predicted(start: Kinematics, h: f64, a: DVec3) -> Kinematics {
    Kinematics {
        position: start.position + h * (start.velocity + 0.5 * h * a),
        velocity: start.velocity + h * a,
    }
}
