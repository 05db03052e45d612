//! The thermostat in a step by the rule `exact`: flights restart where it changes velocities.

use glam::DVec3;

use super::attempt::Attempt;
use super::place::{account_for_persistent_contacts, place_spheres, work_written};
use crate::error::Error;
use crate::rule::exact::{self, Timeline};
use crate::settings::Settings;
use crate::shear::Shear;
use crate::state::State;
use crate::sum::Sum;
use crate::thermostat::{Kicked, Kicks, velocities_after};

/// The changes that the thermostat makes after `now` \[s\], if there is one.
pub(super) fn kicks_after(state: &State, now: f64) -> Option<Kicks> {
    let thermostat = state.settings.thermostat?;
    Some(Kicks::after(thermostat, &state.spheres, state.settings.dimensions, now))
}

/// Makes the changes of velocity that are due.
///
/// # Errors
/// [`Error::NonFiniteState`] if a sphere is nowhere.
pub(super) fn kick_spheres(
    attempt: &mut Attempt,
    timeline: &mut Timeline,
    kicks: &mut Kicks,
) -> Result<(), Error> {
    let time = kicks.next();
    while kicks.next() == time {
        match kicks.take(&attempt.state.spheres).map(|kick| kick.of) {
            Some(Kicked::One(index, velocity)) => {
                kick_one(attempt, timeline, (index, velocity), time)?;
            }
            Some(Kicked::All) => {
                place_spheres(attempt, timeline, time)?;
                let (shear, spheres) = (Shear::of(&attempt.state.settings), &attempt.state.spheres);
                let velocities = velocities_after(kicks, spheres, shear, time);
                restart_with(attempt, timeline, &velocities, time);
            }
            None => {}
        }
    }
    Ok(())
}

/// Sets the velocity of a sphere, by its index, relative to the mean flow \[m/s\] at `time` \[s\].
fn kick_one(
    attempt: &mut Attempt,
    timeline: &mut Timeline,
    (index, velocity): (usize, DVec3),
    time: f64,
) -> Result<(), Error> {
    let (system, _) = attempt.state.split();
    let mass = system.spheres.mass[index];
    if let Some(before) = exact::deflect(timeline, &system, index, velocity, time) {
        let gained = 0.5 * mass * (velocity - before).dot(velocity + before);
        attempt.report.energy_account.thermostat += gained;
        return Ok(());
    }
    place_spheres(attempt, timeline, time)?;
    let mut velocities = attempt.state.spheres.velocities().to_vec();
    let place = attempt.state.spheres.positions()[index];
    velocities[index] = velocity + flow_at(&attempt.state.settings, place);
    restart_with(attempt, timeline, &velocities, time);
    Ok(())
}

/// Mean velocity of spheres at a place in a box in steady shear, elsewhere zero \[m/s\].
fn flow_at(settings: &Settings, place: DVec3) -> DVec3 {
    Shear::of(settings).map_or(DVec3::ZERO, |shear| shear.velocity_at(place))
}

/// Restarts all flights at `time` \[s\], where the spheres were placed, with these velocities \[m/s\].
fn restart_with(attempt: &mut Attempt, timeline: &mut Timeline, velocities: &[DVec3], time: f64) {
    account_for_persistent_contacts(attempt.report, timeline, time);
    attempt.report.energy_account.colliders += work_written(attempt, timeline, time);
    let (system, motion) = attempt.state.split();
    let changes = motion.velocity.iter().zip(velocities);
    let bodies = motion.position.iter().zip(&system.spheres.mass);
    let gained = changes.zip(bodies).map(|((&from, &to), (&place, mass))| {
        let flow = flow_at(system.settings, place);
        0.5 * mass * (to - from).dot((to - flow) + (from - flow))
    });
    attempt.report.energy_account.thermostat += gained.collect::<Sum>().value();
    motion.velocity.copy_from_slice(velocities);
    *timeline = exact::restart(timeline, &system, motion, time);
}
