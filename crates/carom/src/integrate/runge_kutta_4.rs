use glam::DVec3;

use super::kinematics::Kinematics;
use super::scheme::{MOST_STAGES, Scheme};

/// Four slopes `k1 .. k4` at 0, h/2, h/2 and h; the step takes `(k1 + 2 k2 + 2 k3 + k4) / 6`.
///
/// Source: Hairer, Nørsett, Wanner, "Solving Ordinary Differential Equations I", II.1, table 1.2.
pub(super) struct RungeKutta4;

impl Scheme for RungeKutta4 {
    const STAGES: usize = 4;
    const ORDER: u32 = 4;
    const WEIGHTS: [f64; MOST_STAGES] = [1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0];

    fn stage(start: Kinematics, h: f64, known: &[DVec3]) -> (f64, Kinematics) {
        let t = TIMES[known.len()] * h;
        match known.len() {
            0 => (t, start),
            number => (t, along(start, t, slope(start, h, known, number - 1))),
        }
    }

    fn end(start: Kinematics, h: f64, known: &[DVec3]) -> Kinematics {
        let [k1, k2, k3, k4] = [0, 1, 2, 3].map(|number| slope(start, h, known, number));
        let mean = Slope {
            x: (k1.x + 2.0 * (k2.x + k3.x) + k4.x) / 6.0,
            v: (k1.v + 2.0 * (k2.v + k3.v) + k4.v) / 6.0,
        };
        along(start, h, mean)
    }
}

/// When the slopes are taken, in parts of the interval.
const TIMES: [f64; 4] = [0.0, 0.5, 0.5, 1.0];

/// Rates of change: of the position \[m/s\] and of the velocity \[m/s²\].
#[derive(Clone, Copy)]
struct Slope {
    x: DVec3,
    v: DVec3,
}

/// The slope of this number, from 0. The state that it is taken at lies along the slope before.
fn slope(start: Kinematics, h: f64, known: &[DVec3], number: usize) -> Slope {
    let velocity = match number {
        0 => start.velocity,
        _ => start.velocity + (TIMES[number] * h) * known[number - 1],
    };
    Slope { x: velocity, v: known[number] }
}

fn along(start: Kinematics, h: f64, slope: Slope) -> Kinematics {
    Kinematics { position: start.position + h * slope.x, velocity: start.velocity + h * slope.v }
}
