//! The plastic answer to an impact: no contact closes any more.

use glam::DVec3;

use super::complementarity::Outcome;
use super::group::{Answer, Group};
use super::project::Projector;

/// The plastic answer: the motion nearest (in kinetic energy) to the given one in which no
/// contact closes. Unless surfaces crush spheres between them, there is one.
pub(super) fn answer(group: &Group, start: &[DVec3], projector: &mut Projector) -> Answer {
    let mut answer = Answer::unchanged(group, start);
    let outcome = finish(group, &mut answer, projector);
    answer.complete = outcome == Outcome::Solved;
    answer
}

/// Finishes an answer plastically: what still closes, no longer does.
pub(super) fn finish(group: &Group, answer: &mut Answer, projector: &mut Projector) -> Outcome {
    let velocities = &mut answer.motion.velocities;
    let before = velocities.clone();
    let outcome = projector.project(group, |_| true, |_| 0.0, velocities);
    answer.energy += group.work(projector.impulses(), &before, velocities).min(0.0);
    answer.motion.add(projector.impulses(), 1.0);
    outcome
}
