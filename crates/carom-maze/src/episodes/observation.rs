//! Observations of agents.

use std::iter::repeat_n;

use carom::DVec3;

use super::options::EpisodeOptions;
use crate::floor;
use crate::maze::Maze;
use crate::tilt::Tilt;

/// Position, velocity and tilt, two numbers each, come before the collectibles.
const BEFORE_COLLECTIBLES: usize = 6;

/// Returns the smallest and the largest value of each number of an observation.
pub(super) fn bounds(maze: &Maze, options: &EpisodeOptions) -> [Vec<f32>; 2] {
    let [low, high] = floor::bounds(maze);
    let tilt = options.max_tilt_degrees.to_radians();
    let diagonal = (high - low).reject_from(DVec3::Y).length();
    let speed = (2.0 * maze.gravity() * libm::sin(tilt) * diagonal).sqrt();
    let of = |corner: DVec3, sign: f64, there: f32| {
        let ball = [corner.x, corner.z, sign * speed, sign * speed, sign * tilt, sign * tilt];
        let ball = ball.into_iter().map(|bound| bound as f32);
        ball.chain(repeat_n(there, maze.collectibles().count())).collect()
    };
    [of(low, -1.0, 0.0), of(high, 1.0, 1.0)]
}

/// Writes the observation of a ball with this position \[m\] and velocity \[m/s\], clamped to its
/// bounds.
pub(super) fn write(
    (place, velocity): (DVec3, DVec3),
    tilt: Tilt,
    taken: u64,
    [low, high]: [&[f32]; 2],
    out: &mut [f32],
) {
    // The slopes towards +x and +z: see `Tilt::down`.
    let ball = [place.x, place.z, velocity.x, velocity.z, -tilt.about_z, tilt.about_x];
    for (((number, value), low), high) in out.iter_mut().zip(ball).zip(low).zip(high) {
        *number = (value as f32).clamp(*low, *high);
    }
    for (index, number) in out.iter_mut().skip(BEFORE_COLLECTIBLES).enumerate() {
        let is_there = taken >> index & 1 == 0;
        *number = if is_there { 1.0 } else { 0.0 };
    }
}
