//! Steps by a rule that knows nothing but frames: what is due is emitted at the start.

use super::attempt::{Attempt, Scratch};
use crate::emitter;
use crate::error::Error;
use crate::interval::Interval;
use crate::report::StepReport;
use crate::state::State;

/// Takes a step in which `advance` moves the spheres over the frame. If that fails, the spheres are
/// where they were.
pub(super) fn step(
    attempt: &mut Attempt,
    advance: impl FnOnce(&mut State, Interval, &mut Scratch, &mut StepReport),
) -> Result<(), Error> {
    let frame = Interval { time: attempt.start, h: attempt.length };
    attempt.state.check_emitters(frame.time)?;
    attempt.take(|attempt| {
        attempt.scratch.start.copy_all(&attempt.state.spheres.motion);
        attempt.emit(frame.time + emitter::DUE_TOLERANCE);
        let Attempt { state, scratch, report, .. } = attempt;
        advance(state, frame, scratch, report);
        let checked = state.check_finite();
        if checked.is_err() {
            std::mem::swap(&mut state.spheres.motion, &mut scratch.start);
        }
        checked
    })
}
