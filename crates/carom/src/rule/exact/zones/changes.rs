//! Changes of energy between two ticks of a zone.

use glam::DVec3;

use crate::force_work::ForceWork;
use crate::forces::{self, SphereState};
use crate::report::EnergyAccount;
use crate::rule::exact::flights::{Flights, Species};
use crate::system::System;

/// Changes of energy over a time in which velocities change steadily and positions along straight lines.
#[derive(Debug, Clone, Copy, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Changes {
    pub account: EnergyAccount,
    /// Kinetic energy of the changes of velocity \[J\].
    pub energy_of_changes: f64,
    /// Part of the account that is reported, 0 to 1.
    pub reported: f64,
}

impl Changes {
    /// Reports the changes up to a part of the time, 0 to 1. They grow linearly, as velocities do, whose energy is then
    /// less than that by a parabola.
    pub fn report(&mut self, part: f64, account: &mut EnergyAccount) {
        let part = part.max(self.reported);
        let missing = |part: f64| self.energy_of_changes * part * (1.0 - part);
        account.integration += missing(self.reported) - missing(part);
        *account += self.account.part(part - self.reported);
        self.reported = part;
    }
}

/// Returns the changes of energy of a sphere with this centre \[m\] that moves with a mean velocity from a time until the
/// next tick \[s\], while its velocity changes from one to another \[m/s\]: what its forces do not do, the spheres or
/// surfaces do with which it moves; and the part of its forces that has a potential, or is a damper \[N\].
pub(super) fn changes_until_tick(
    system: &System,
    flights: &Flights,
    slot: u32,
    ([position, mean], [before, after]): ([DVec3; 2], [DVec3; 2]),
    [time, tick]: [f64; 2],
) -> (Changes, DVec3) {
    let Species { radius, mass, acceleration, drag_rate, .. } = *flights.free_species_of(slot);
    let way = (tick - time) * mean;
    let gained = 0.5 * mass * (after - before).dot(after + before);
    let all = mass * (acceleration - drag_rate * before);
    let energy_of_changes = 0.5 * mass * (after - before).length_squared();
    let mut changes = Changes { energy_of_changes, ..Changes::default() };
    changes.account.correction = gained - all.dot(way);
    if !system.has_nonconservative_forces() {
        return (changes, all);
    }
    let state = SphereState { position, velocity: before, radius, mass };
    let force = forces::total_nonconservative(system.forces, &state, time);
    let index = flights.index_of[slot as usize] as usize;
    let applied = system.spheres.applied_force.get(index).copied().unwrap_or(DVec3::ZERO);
    let works = [force, applied].map(|force| force.dot(way));
    changes.account.add_force_work(ForceWork {
        forces: works[0],
        applied: works[1],
        ..ForceWork::default()
    });
    (changes, all - force - applied)
}
