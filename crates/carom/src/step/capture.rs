//! Spheres that enter a trigger that captures leave the world at the end of the step.

use crate::id::SphereId;
use crate::report::StepReport;
use crate::state::State;

/// Removes the spheres that entered such a trigger in the step, and reports them with the others that left.
pub(super) fn capture(state: &mut State, report: &mut StepReport) {
    let mut captured: Vec<SphereId> = Vec::new();
    for event in report.sensor_events.iter().filter(|it| it.enters) {
        let collider = state.colliders.list().get(event.collider.0);
        if collider.is_some_and(|it| it.captures) && state.spheres.index_of(event.sphere).is_some()
        {
            captured.push(event.sphere);
        }
    }
    if captured.is_empty() {
        return;
    }
    captured.sort_unstable();
    captured.dedup();
    let time = state.clock.seconds();
    let [energy, potential] = [state.total_energy(time), state.nonconservative_potential(time)];
    state.remove_spheres(&captured);
    report.triggers.retain(|it| captured.binary_search(&it.sphere).is_err());
    report.energy_account.emission += state.total_energy(time) - energy;
    report.energy_account.forces -= state.nonconservative_potential(time) - potential;
    report.retired.extend(captured);
}
