//! How a recording starts, by the scene that it is said to be of.

use carom::Boundary;

use super::error::LineProblem;
use super::frame::{ReplayBall, ReplayFrame};
use crate::scene::Scene;

/// Within a frame a ball comes farther than at its larger speed at both ends where it was struck twice: by
/// this factor at most, and by so many radii. Of another scene a ball is hardly ever so near.
const WAY: [f64; 2] = [10.0, 2.0];

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
        Self { frame, boundary, until: frames * scene.simulation.frame_time }
    }

    /// The first ball, by its place in the first recorded frame, that cannot have come there.
    pub fn first_stray(&self, first: &ReplayFrame) -> Option<(u64, LineProblem)> {
        let (time, [factor, radii]) = (first.time, WAY);
        let stray = |(row, ball): (u64, &ReplayBall)| {
            let start = self.frame.balls.get(usize::try_from(ball.number).ok()?)?;
            let distance = self.boundary.nearest_image(ball.position - start.position).length();
            let speed = start.velocity.length().max(ball.velocity.length());
            let is_stray = distance > factor * speed * time + radii * ball.radius;
            let problem = LineProblem::Elsewhere { ball: ball.number, distance, time, speed };
            is_stray.then_some((row, problem))
        };
        if time > self.until { None } else { (0..).zip(&first.balls).find_map(stray) }
    }
}
