use glam::DVec3;

use super::kinematics::Kinematics;

/// Four slopes `k1 .. k4` at 0, h/2, h/2 and h; the step takes `(k1 + 2 k2 + 2 k3 + k4) / 6`.
///
/// Source: Hairer, Nørsett, Wanner, "Solving Ordinary Differential Equations I", II.1, table 1.2.
pub(super) fn advance(
    start: Kinematics,
    h: f64,
    acceleration: impl Fn(f64, Kinematics) -> DVec3,
) -> Kinematics {
    let half = 0.5 * h;
    let slope = |t, at: Kinematics| Slope { x: at.velocity, v: acceleration(t, at) };
    let k1 = slope(0.0, start);
    let k2 = slope(half, along(start, half, k1));
    let k3 = slope(half, along(start, half, k2));
    let k4 = slope(h, along(start, h, k3));
    let mean = Slope {
        x: (k1.x + 2.0 * (k2.x + k3.x) + k4.x) / 6.0,
        v: (k1.v + 2.0 * (k2.v + k3.v) + k4.v) / 6.0,
    };
    along(start, h, mean)
}

/// Rates of change: of the position \[m/s\] and of the velocity \[m/s²\].
#[derive(Clone, Copy)]
struct Slope {
    x: DVec3,
    v: DVec3,
}

fn along(start: Kinematics, h: f64, slope: Slope) -> Kinematics {
    Kinematics { position: start.position + h * slope.x, velocity: start.velocity + h * slope.v }
}
