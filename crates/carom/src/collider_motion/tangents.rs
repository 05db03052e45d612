//! Velocities at the keyframes of a motion.

use glam::DVec3;

use crate::norm::Norm;

/// Largest velocity at a keyframe over the mean velocity of a neighbouring piece: up to it a cubic piece is monotone
/// (Fritsch and Carlson, SIAM J. Numer. Anal. 17, 238 (1980)).
const MOST: f64 = 3.0;

/// Returns the velocities at the keyframes between and around pieces with these ways \[m or rad\] and lengths \[s\].
/// At the first and at the last one it is zero, or where the motion repeats, that of a keyframe between the last and
/// the first piece.
pub(super) fn of(ways: &[DVec3], lengths: &[f64], repeats: bool) -> Vec<DVec3> {
    let count = lengths.len();
    let between = |before: usize, after: usize| {
        tangent([ways[before], ways[after]], [lengths[before], lengths[after]])
    };
    let ends = if repeats && count > 0 { between(count - 1, 0) } else { DVec3::ZERO };
    let inner = (1..count).map(|number| between(number - 1, number));
    std::iter::once(ends).chain(inner).chain(std::iter::once(ends)).collect()
}

/// Returns the velocity between two pieces: the derivative of the parabola through their ends, without what is opposite
/// to either of them, and of a limited size.
fn tangent(ways: [DVec3; 2], lengths: [f64; 2]) -> DVec3 {
    let [before, after] = [ways[0] / lengths[0], ways[1] / lengths[1]];
    let mut velocity = (lengths[1] * before + lengths[0] * after) / (lengths[0] + lengths[1]);
    for mean in [before, after] {
        let along = velocity.dot(mean);
        if along < 0.0 {
            velocity -= along / mean.dot(mean) * mean;
        }
    }
    let (speed, most) = (velocity.norm(), MOST * before.norm().min(after.norm()));
    if speed > most { most / speed * velocity } else { velocity }
}
