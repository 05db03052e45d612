//! Steps by a rule that knows nothing but frames: what is due is emitted at the start.

use super::Step;
use crate::bodies::Motion;
use crate::emitter;
use crate::error::Error;
use crate::interval::Interval;
use crate::report::StepReport;
use crate::rule;
use crate::system::System;

/// Takes a step in which `advance` moves the spheres over the frame. If that fails, the spheres are
/// where they were.
pub(super) fn step(
    mut step: Step,
    advance: impl FnOnce(&System, &mut Motion, Interval, &mut rule::Scratch, &mut StepReport),
) -> Result<(), Error> {
    let frame = Interval { time: step.start, h: step.length };
    step.state.check_emitters(frame.time)?;
    step.take(|step| {
        step.scratch.start.copy_all(&step.state.spheres.motion);
        step.emit(frame.time + emitter::DUE_TOLERANCE);
        let Step { state, scratch, report, .. } = step;
        let (system, motion) = state.split();
        advance(&system, motion, frame, &mut scratch.rule, report);
        let checked = state.check_finite();
        if checked.is_err() {
            std::mem::swap(&mut state.spheres.motion, &mut scratch.start);
        }
        checked
    })
}
