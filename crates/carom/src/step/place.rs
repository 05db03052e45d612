//! Spheres at the ends of their flights, within a step by the rule `exact`, with the accounts up to there.

use super::attempt::Attempt;
use crate::error::Error;
use crate::id::SphereId;
use crate::report::StepReport;
use crate::rule::exact::{self, Span, Timeline};

/// Moves all spheres to the ends of their flights at `end` \[s\].
///
/// # Errors
/// [`Error::NonFiniteState`] if one is nowhere; then none is moved.
pub(super) fn place_spheres(
    attempt: &mut Attempt,
    timeline: &Timeline,
    end: f64,
) -> Result<(), Error> {
    let (start, length) = (attempt.start, attempt.length);
    let (system, motion) = attempt.state.split();
    exact::end(timeline, &system, motion, Span { start, length, end }).map_err(
        |(index, quantity)| {
            let sphere = attempt.state.spheres.ids()[index];
            no_longer_finite(sphere, quantity, start)
        },
    )
}

/// The error for a sphere with a quantity that exceeded the range of numbers, in a step that starts at `time`
/// \[s\].
pub(super) fn no_longer_finite(sphere: SphereId, quantity: &'static str, time: f64) -> Error {
    Error::NonFiniteState { sphere, quantity, time }
}

/// Accounts for the work of persistent contacts, and of zones, up to `time` \[s\].
pub(super) fn account_for_persistent_contacts(
    report: &mut StepReport,
    timeline: &mut Timeline,
    time: f64,
) {
    timeline.report_zone_energy(time, &mut report.energy_account);
    let [friction, colliders] = timeline.take_contact_work(time);
    report.energy_account.contacts += friction;
    report.energy_account.colliders += colliders;
}

/// The work of moving colliders \[J\] that the written states have beyond that of the flights, at `time` \[s\].
pub(super) fn work_written(attempt: &mut Attempt, timeline: &Timeline, time: f64) -> f64 {
    let (system, motion) = attempt.state.split();
    exact::work_written(timeline, &system, motion, time)
}
