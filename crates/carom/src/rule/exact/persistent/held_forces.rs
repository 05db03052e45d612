//! Held forces: forces between spheres and on spheres in persistent contact, constant from one force tick to the
//! next; and applied forces, constant over a frame.

use glam::DVec3;

use super::planar::{self, PlanarSupport};
use crate::detect::contact::Bodies;
use crate::forces::{self, SphereState};
use crate::integrate;
use crate::rule::exact::contacts::{Corner, Member, Plane};
use crate::rule::exact::flights::Species;
use crate::rule::exact::ticks::first_tick_after;
use crate::rule::exact::timeline::Timeline;
use crate::system::System;

/// Forces on spheres of zones are taken later than in the middle of a tick by this part of it, times the square of the
/// angle by which springs turn in it.
const LATER: f64 = 1.0 / 32.0;

/// Returns the time until which forces that are computed `now` \[s\] are held: until the next force
/// tick, or for applied forces the end of the frame, and no longer than until the next emission.
fn held_until(timeline: &Timeline, system: &System, now: f64) -> f64 {
    let next_tick = match timeline.flights.forces_vary {
        true => first_tick_after(now, timeline.force_tick),
        false => timeline.frame[1],
    };
    let are_applied = !system.spheres.applied_force.is_empty();
    let others =
        [timeline.next_emission, if are_applied { timeline.frame[1] } else { f64::INFINITY }];
    // An emission that is due happens at once, when this is called again.
    others.into_iter().filter(|&other| other > now).fold(next_tick, f64::min)
}

/// Starts the force ticks at an event at `now` \[s\], where no forces were held before.
#[inline]
pub(crate) fn prepare(timeline: &mut Timeline, system: &System, now: f64) {
    if timeline.flights.are_curved() && timeline.held_until <= now && !timeline.holds_forces() {
        timeline.held_until = held_until(timeline, system, now);
    }
}

/// Computes the forces between spheres at `now` \[s\] for a zone that begins, where none are held on free spheres.
pub(crate) fn prepare_zone(timeline: &mut Timeline, system: &System, now: f64) {
    prepare(timeline, system, now);
    if timeline.flights.are_curved() && timeline.zone.is_empty() {
        let interval = [now, timeline.held_until];
        timeline.zone.held_forces = forces_between(timeline, system, interval);
        timeline.working_forces = working_forces(timeline, system, interval);
    }
}

/// Begins a new flight `now` \[s\] of every sphere whose forces are held: of those in persistent contact, and of all
/// others if none flies on a curve. Returns their slots.
///
/// They fly under the forces that act on them in the middle of the time for which these are held: an error of the
/// third order in its length, of the second over all ticks (the midpoint rule). Persistent contacts with planes
/// continue where forces are the same everywhere; others are computed again.
///
/// Forces between spheres are those where all would be in the middle if nothing accelerated them, a drift,
/// a kick and a drift: the leapfrog scheme, which keeps energy, without damping, as velocity Verlet does.
pub(crate) fn renew(timeline: &mut Timeline, system: &System, start: f64) -> Vec<u32> {
    let end = held_until(timeline, system, start);
    timeline.held_until = end;
    let between = match timeline.holds_forces() {
        true => forces_between(timeline, system, [start, end]),
        false => Vec::new(),
    };
    timeline.zone.held_forces.clone_from(&between);
    timeline.working_forces = working_forces(timeline, system, [start, end]);
    let are_curved = timeline.flights.are_curved();
    // Forces applied over a frame differ in each frame.
    let are_restarted = timeline.curves_until.is_finite() && start == timeline.frame[0];
    let mut renewed = Vec::new();
    for slot in 0..timeline.flights.bodies.len() as u32 {
        let species = *timeline.flights.free_species_of(slot);
        let present = timeline.flights.species_of(slot);
        let is_free = present.cluster.is_none() || present.is_curved;
        if are_curved && is_free && !timeline.flights.is_stepped(slot) {
            if are_restarted {
                begin_free(timeline, system, slot, start);
                renewed.push(slot);
            }
            continue;
        }
        let index = timeline.flights.index_of[slot as usize] as usize;
        let applied = system.spheres.applied_acceleration(index).unwrap_or(DVec3::ZERO);
        let (linear, is_all) = forces::total_linear(system.forces, species.radius, species.mass);
        let uniform = linear.acceleration + applied;
        let uniform = between.get(index).map_or(uniform, |&force| uniform + force / species.mass);
        if timeline.flights.is_stepped(slot) {
            // For its flight after the contact.
            timeline.flights.set_free_acceleration(slot, uniform);
            continue;
        }
        if is_all {
            begin_under(timeline, system, slot, uniform, [start, end]);
        } else {
            begin_under_varying(timeline, system, slot, uniform, [start, end]);
        }
        timeline.find_clearance(system, slot);
        renewed.push(slot);
    }
    renewed
}

/// Begins the flight of a sphere without persistent contacts at `start` \[s\], where applied forces changed.
fn begin_free(timeline: &mut Timeline, system: &System, slot: u32, start: f64) {
    let species = *timeline.flights.species_of(slot);
    let (position, velocity) = timeline.flights.state_of(slot, start);
    if !species.is_curved {
        let index = timeline.flights.index_of[slot as usize] as usize;
        let applied = system.spheres.applied_acceleration(index).unwrap_or(DVec3::ZERO);
        let (linear, _) = forces::total_linear(system.forces, species.radius, species.mass);
        timeline.flights.set_free_acceleration(slot, linear.acceleration + applied);
    }
    timeline.begin_flight(slot, position, velocity, start);
}

/// The forces between spheres in the middle of an interval \[N\], by index; empty where there are none.
fn forces_between(timeline: &Timeline, system: &System, interval: [f64; 2]) -> Vec<DVec3> {
    let mut forces = Vec::new();
    if system.has_interactions() {
        let (positions, velocities) = states_in_the_middle(timeline, system, interval);
        let middle = interval[0] + 0.5 * (interval[1] - interval[0]);
        system.forces_between([&positions, &velocities], middle, &mut forces);
    }
    forces
}

/// The nonconservative forces between spheres in the middle of an interval \[N\], by index, without dampers; empty
/// where there are none.
fn working_forces(timeline: &Timeline, system: &System, interval: [f64; 2]) -> Vec<DVec3> {
    let mut forces = Vec::new();
    if system.has_nonconservative_interactions() {
        let (positions, velocities) = states_in_the_middle(timeline, system, interval);
        let middle = interval[0] + 0.5 * (interval[1] - interval[0]);
        system.nonconservative_interactions([&positions, &velocities], middle, &mut forces);
    }
    forces
}

/// The time after which forces act that are held for a time of `h` \[s\]: its middle, where no zone is.
///
/// A stiff spring between a sphere of a zone and one outside gains amplitude under the leapfrog scheme, by at most
/// `(w h)³/195` in a radian at the rate w, since the latter follows the straight paths of the former. Forces that
/// are later by `(w h)²/32 h` damp it by as much as `(w h)³/128`, where they act on one end only.
fn middle_of(timeline: &Timeline, h: f64) -> f64 {
    if timeline.zone.is_empty() {
        return 0.5 * h;
    }
    let turn = timeline.spring_rate * h;
    (0.5 + LATER * turn * turn) * h
}

/// Centres \[m\] and velocities \[m/s\] of all spheres, by index, in the middle of an interval.
fn states_in_the_middle(
    timeline: &Timeline,
    system: &System,
    [start, end]: [f64; 2],
) -> (Vec<DVec3>, Vec<DVec3>) {
    let mut forces = Vec::new();
    let half = middle_of(timeline, end - start);
    let state_of = |&slot: &u32| timeline.flights.state_of(slot, start);
    let (mut positions, mut velocities): (Vec<DVec3>, Vec<DVec3>) =
        timeline.flights.slot_of.iter().map(state_of).unzip();
    // A zone's straight flights have the mean velocities of a tick, which would be late by half of it.
    for (index, velocity) in timeline.zone.velocities(start) {
        velocities[index as usize] = velocity;
    }
    if system.has_damped_interactions() {
        // Forces that depend on velocities need those of the middle, to the first order.
        system.forces_between([&positions, &velocities], start, &mut forces);
        for (index, velocity) in velocities.iter_mut().enumerate() {
            let at = (positions[index], *velocity);
            let alone = integrate::acceleration_alone(system, index, at, start);
            positions[index] += half * *velocity;
            let free = alone + forces[index] / system.spheres.mass[index];
            *velocity += half * under_contacts(timeline, index, free);
        }
    } else {
        positions.iter_mut().zip(&velocities).for_each(|(position, v)| *position += half * *v);
    }
    (positions, velocities)
}

/// The acceleration \[m/s²\] of the sphere with this index: `free` without contacts, less what its persistent
/// contacts take.
fn under_contacts(timeline: &Timeline, index: usize, free: DVec3) -> DVec3 {
    let species = timeline.flights.species_of(timeline.flights.slot_of[index]);
    match (species.is_stepped, species.cluster) {
        (true, _) => DVec3::ZERO,
        (false, Some(_)) => species.acceleration,
        (false, None) => free,
    }
}

/// Begins the flight of a sphere at `start` \[s\] under an acceleration \[m/s²\] that is the same
/// everywhere.
fn begin_under(
    timeline: &mut Timeline,
    system: &System,
    slot: u32,
    acceleration: DVec3,
    [start, end]: [f64; 2],
) {
    // The state to which the forces up to now have led.
    let member = Member::at(&timeline.flights, slot, start);
    let species = Species { acceleration, ..*timeline.flights.free_species_of(slot) };
    let member = Member { species, ..member };
    let Some((cluster, planar)) = planar_support(timeline, system, &member, [start, end]) else {
        // This counts the work of the contacts under the forces up to now.
        timeline.set_free(slot, start);
        timeline.flights.set_free_acceleration(slot, acceleration);
        timeline.begin_flight(slot, member.position, member.velocity, start);
        return;
    };
    timeline.flights.count_contact_work(slot, start);
    timeline.flights.set_free_acceleration(slot, acceleration);
    let contact_work = planar.contact_work();
    let PlanarSupport { velocity, acceleration, valid_for, persists, belt_work, .. } = planar;
    let after = Member { velocity, angular_velocity: planar.angular_velocity, ..member };
    let moment = system.spheres.moment_of_inertia(member.index as usize);
    timeline.flights.add_contact_work(after.gained_since(&member, moment) - belt_work);
    timeline.flights.add_collider_work(belt_work);
    timeline.flights.set_acceleration(slot, acceleration, contact_work);
    timeline.flights.rotate(slot, [planar.angular_velocity, planar.angular_acceleration], start);
    let cluster = timeline.flights.clusters.get_mut(cluster);
    cluster.renewal = start + valid_for;
    let (before, mut persists) = (cluster.contacts.len(), persists.into_iter());
    cluster.contacts.retain(|_| persists.next().unwrap_or(false));
    if cluster.contacts.len() < before {
        timeline.drop_clearance(slot);
    }
    timeline.begin_flight(slot, member.position, velocity, start);
}

/// The continuation of a sphere's persistent contacts from a start to an end \[s\], with the number of its cluster,
/// if it follows without computing them again.
fn planar_support(
    timeline: &Timeline,
    system: &System,
    member: &Member,
    [start, end]: [f64; 2],
) -> Option<(u32, PlanarSupport)> {
    let number = timeline.flights.species_of(member.slot).cluster?;
    let cluster = timeline.flights.clusters.get(number);
    // In a periodic box the contact may be with an image of the sphere.
    if cluster.members.len() != 1 || system.settings.boundary.is_periodic() {
        return None;
    }
    let plane_of = |bodies: &Bodies| match *bodies {
        Bodies::Surface { surface, .. } => Plane::under(member.state(), surface, system.surfaces),
        Bodies::Pair(..) => None,
    };
    let mut corner = Corner::default();
    for contact in &cluster.contacts {
        corner.add(plane_of(contact)?)?;
    }
    let scale = member.scale(false);
    let contact_duration = scale.duration(timeline.parameters.contact_duration, start);
    let planar = planar::support(system, member, &corner, contact_duration, end - start).ok()??;
    Some((number, planar))
}

/// Begins the flight of a sphere under forces that depend on its state, besides a uniform acceleration \[m/s²\]:
/// those in the middle of its flight, or of its motion in contact, under the forces of the start.
fn begin_under_varying(
    timeline: &mut Timeline,
    system: &System,
    slot: u32,
    uniform: DVec3,
    [start, end]: [f64; 2],
) {
    let middle = start + 0.5 * (end - start);
    let Species { radius, mass, .. } = *timeline.flights.species_of(slot);
    let acceleration_at = |timeline: &Timeline, time: f64| {
        let (position, velocity) = timeline.flights.state_of(slot, time);
        let state = SphereState { position, velocity, radius, mass };
        uniform + forces::total_of_others(system.forces, &state, time) / mass
    };
    // In a periodic box the flight may begin at an image of that place.
    let (position, velocity) = timeline.flights.state_of(slot, start);
    timeline.flights.count_contact_work(slot, start);
    timeline.begin_flight(slot, position, velocity, start);
    for time in [start, middle] {
        let acceleration = acceleration_at(timeline, time);
        begin_under(timeline, system, slot, acceleration, [start, end]);
    }
}
