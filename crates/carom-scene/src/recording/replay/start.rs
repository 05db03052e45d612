//! Checks that a recording starts as its scene does.

use carom::Boundary;

use super::error::LineProblem;
use super::frame::{ReplayBall, ReplayFrame};
use crate::scene::Scene;

/// Largest distance that a ball moves within a frame: the larger of its two speeds times the first
/// factor and the time, plus the second factor times its radius. Balls that were struck twice or
/// came to rest stay below it; few balls of another scene do.
const WAY: [f64; 2] = [10.0, 2.0];
/// Longest time for which this check is meaningful \[s\].
const LONGEST_FRAME: f64 = 0.05;

/// The scene of a recording at its start.
#[derive(Debug)]
pub(super) struct Start {
    pub frame: ReplayFrame,
    pub boundary: Boundary,
    /// Latest time at which the speeds limit the distance that balls have moved \[s\].
    until: f64,
}

impl Start {
    pub fn new(scene: &Scene, frame: ReplayFrame, boundary: Boundary) -> Self {
        // A stiff spring can turn a ball back within a frame, so 0 leaves out the check.
        let frames = if scene.springs.is_empty() { 1.5 } else { 0.0 };
        let until = (frames * scene.simulation.frame_time).min(LONGEST_FRAME);
        Self { frame, boundary, until }
    }

    /// Returns the first ball that is too far from its start, with its row, if most balls of the
    /// first recorded frame are.
    pub fn first_stray(&self, first: &ReplayFrame) -> Option<(u64, LineProblem)> {
        if first.time > self.until {
            return None;
        }
        let (time, [factor, radii]) = (first.time, WAY);
        let stray = |(row, ball): (u64, &ReplayBall)| {
            let start = self.frame.balls.get(usize::try_from(ball.number).ok()?)?;
            let distance = self.boundary.nearest_image(ball.position - start.position).length();
            let speed = start.velocity.length().max(ball.velocity.length());
            let is_stray = distance > factor * speed * time + radii * ball.radius;
            let problem = LineProblem::Elsewhere { ball: ball.number, distance, time, speed };
            is_stray.then_some((row, problem))
        };
        let strays: Vec<_> = (0..).zip(&first.balls).filter_map(stray).collect();
        let known = first.balls.len().min(self.frame.balls.len());
        let are_most = 2 * strays.len() > known;
        strays.into_iter().next().filter(|_| are_most)
    }
}
