use glam::DVec3;

use super::kinematics::Kinematics;
use super::scheme::{MOST_STAGES, Scheme};

/// `v' = v + h a(x, v)`, `x' = x + h v'`.
///
/// Source: Hairer, Lubich, Wanner, "Geometric Numerical Integration", I.1.2 (symplectic Euler).
pub(super) struct SemiImplicitEuler;

impl Scheme for SemiImplicitEuler {
    const STAGES: usize = 1;
    const ORDER: u32 = 1;
    const WEIGHTS: [f64; MOST_STAGES] = [1.0, 0.0, 0.0, 0.0];

    fn stage(start: Kinematics, _h: f64, _known: &[DVec3]) -> (f64, Kinematics) {
        (0.0, start)
    }

    fn end(start: Kinematics, h: f64, known: &[DVec3]) -> Kinematics {
        let velocity = start.velocity + h * known[0];
        Kinematics { position: start.position + h * velocity, velocity }
    }
}
