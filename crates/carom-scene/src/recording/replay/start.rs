//! How a recording starts, by the scene that it is said to be of.

use carom::Boundary;

use super::error::LineProblem;
use super::frame::{ReplayBall, ReplayFrame};
use crate::scene::Scene;

/// Within a frame hardly any ball comes farther than at its larger speed at both ends by this factor, and by so
/// many radii: one that was struck twice, or came to rest. Of another scene hardly any is so near.
const WAY: [f64; 2] = [10.0, 2.0];
/// In longer frames anything may happen \[s\].
const LONGEST_FRAME: f64 = 0.05;

/// The scene of a recording at its start.
#[derive(Debug)]
pub(super) struct Start {
    pub frame: ReplayFrame,
    pub boundary: Boundary,
    /// Until when speeds tell how far balls have come \[s\].
    until: f64,
}

impl Start {
    pub fn new(scene: &Scene, frame: ReplayFrame, boundary: Boundary) -> Self {
        // A stiff spring may turn a ball round within a frame, and rounding counts for little.
        let frames = if scene.springs.is_empty() { 1.5 } else { 0.0 };
        let until = (frames * scene.simulation.frame_time).min(LONGEST_FRAME);
        Self { frame, boundary, until }
    }

    /// If most balls of the first recorded frame cannot have come there: the first one, by its place.
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
