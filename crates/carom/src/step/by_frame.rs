//! Steps by a rule with frames only: spheres that are due are emitted at the start.

use super::attempt::{Attempt, Scratch};
use super::sweep;
use crate::emitter;
use crate::error::Error;
use crate::interval::Interval;
use crate::report::{BodyPair, Impact, StepReport};
use crate::state::State;
use crate::sum::Sum;
use crate::surface::SurfaceMotion;

/// Takes a step in which `advance` moves the spheres over the frame and returns whether it was completed. If it
/// fails, the spheres keep their places.
pub(super) fn step(
    attempt: &mut Attempt,
    advance: impl FnOnce(&mut State, Interval, &mut Scratch, &mut StepReport) -> bool,
) -> Result<(), Error> {
    let frame = Interval { time: attempt.start, h: attempt.length };
    let due = emitter::due_with_frame(frame.time, frame.h);
    attempt.state.check_emitters(due)?;
    attempt.state.check_springs(frame.h)?;
    attempt.take(|attempt| {
        attempt.scratch.start.copy_all(&attempt.state.spheres.motion);
        attempt.emit(due);
        attempt.begin_tracks();
        let Attempt { state, scratch, report, .. } = attempt;
        let is_done = advance(state, frame, scratch, report);
        let stopped = Error::Stopped { time: frame.time };
        let checked = if is_done { state.check_finite() } else { Err(stopped) };
        if checked.is_err() {
            std::mem::swap(&mut state.spheres.motion, &mut scratch.start);
        } else {
            sweep::report(attempt);
        }
        checked
    })
}

/// Accounts for impacts that were answered one after the other, so that the speeds of each are those right
/// before and after it.
pub(super) fn account_for_impacts(state: &State, report: &mut StepReport) {
    let [mut contacts, mut colliders, mut kicks] = [Sum::default(); 3];
    for impact in &report.impacts {
        let &Impact { impulse, approach_speed, separation_speed, kick, .. } = impact;
        contacts.add(0.5 * impulse * (separation_speed - approach_speed));
        if kick > 0.0 {
            // From e v to e v + k; the impulse is m ((1 + e) v + k).
            let mass = impulse / (approach_speed + separation_speed);
            let work = mass * kick * (separation_speed - 0.5 * kick);
            kicks.add(work);
            contacts.add(-work);
        }
        let BodyPair::Collider { collider, .. } = impact.between else { continue };
        if let Some(collider) = state.colliders.list().get(collider.0) {
            let velocity = SurfaceMotion::of(collider).velocity_at(impact.point);
            colliders.add(impact.impulse * impact.normal.dot(velocity));
        }
    }
    report.energy_account.contacts += contacts.value();
    report.energy_account.colliders += colliders.value();
    report.energy_account.kicks += kicks.value();
}
