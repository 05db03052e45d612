use glam::DVec3;

use super::kinematics::Kinematics;
use super::scheme::{MOST_STAGES, Scheme};

/// `x' = x + h v`, `v' = v + h a(x, v)`.
///
/// Source: Hairer, Nørsett, Wanner, "Solving Ordinary Differential Equations I", I.7.
pub(super) struct ExplicitEuler;

impl Scheme for ExplicitEuler {
    const STAGES: usize = 1;
    const ORDER: u32 = 1;
    const WEIGHTS: [f64; MOST_STAGES] = [1.0, 0.0, 0.0, 0.0];

    fn stage(start: Kinematics, _h: f64, _known: &[DVec3]) -> (f64, Kinematics) {
        (0.0, start)
    }

    fn end(start: Kinematics, h: f64, known: &[DVec3]) -> Kinematics {
        Kinematics {
            position: start.position + h * start.velocity,
            velocity: start.velocity + h * known[0],
        }
    }
}
