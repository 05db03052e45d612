//! Forces that are held constant over a frame.

use glam::DVec3;

use super::carry::{self, Carried};
use super::corner::{Corner, Plane};
use super::group::Member;
use super::timeline::Timeline;
use crate::detect::contact::Bodies;
use crate::forces::{self, SphereState};
use crate::rule::Rule;
use crate::system::System;

/// Begins a new flight of every sphere at the start of a frame, or of a part of it, under the forces
/// that act on it in the middle: an error of the third order in its length, of the second over all
/// frames (the midpoint rule). Lasting contacts with planes go on where forces are the same
/// everywhere; others are found anew.
pub(super) fn renew(timeline: &mut Timeline, system: &System, [start, end]: [f64; 2]) {
    for slot in 0..timeline.bodies.len() as u32 {
        let kind = *timeline.free_kind_of(slot);
        let index = timeline.index_of[slot as usize] as usize;
        let applied = system.spheres.applied_acceleration(index).unwrap_or(DVec3::ZERO);
        let (linear, is_all) = forces::total_linear(system.forces, kind.radius, kind.mass);
        let uniform = linear.acceleration + applied;
        if is_all {
            begin_under(timeline, system, slot, uniform, [start, end]);
            timeline.find_room(system, slot);
        } else {
            timeline.set_free(slot);
            begin_under_varying(timeline, system, slot, uniform, [start, end]);
        }
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
    let (position, velocity) = timeline.state_of(slot, start);
    timeline.set_free_acceleration(slot, acceleration);
    let kind = *timeline.free_kind_of(slot);
    let member = Member { slot, position, velocity, kind };
    let Some((cluster, carried)) = carried(timeline, system, &member, end - start) else {
        timeline.set_free(slot);
        timeline.begin_flight(slot, position, velocity, start);
        return;
    };
    let Carried { velocity, acceleration, hold, lasts } = carried;
    timeline.set_acceleration(slot, acceleration);
    let cluster = timeline.clusters.get_mut(cluster);
    cluster.renewal = start + hold;
    let (before, mut lasts) = (cluster.contacts.len(), lasts.into_iter());
    cluster.contacts.retain(|_| lasts.next().unwrap_or(false));
    if cluster.contacts.len() < before {
        timeline.leave_room(slot);
    }
    timeline.begin_flight(slot, position, velocity, start);
}

/// How the lasting contacts of a sphere go on, with the number of its cluster, if that is known
/// for a `duration` \[s\] without finding them anew.
fn carried(
    timeline: &Timeline,
    system: &System,
    member: &Member,
    duration: f64,
) -> Option<(u32, Carried)> {
    let Rule::Exact(parameters) = system.settings.rule else { return None };
    let number = timeline.kind_of(member.slot).cluster?;
    let cluster = timeline.clusters.get(number);
    // In a periodic box a surface may bear the sphere by one of its images.
    if cluster.members.len() != 1 || system.settings.boundary.period() != DVec3::INFINITY {
        return None;
    }
    let plane_of = |bodies: &Bodies| match *bodies {
        Bodies::Surface { surface, .. } => Plane::under(member.position, surface, system.surfaces),
        Bodies::Pair(..) => None,
    };
    let mut corner = Corner::default();
    for contact in &cluster.contacts {
        corner.add(plane_of(contact)?)?;
    }
    let scale = member.scale(false);
    let contact_duration = scale.duration(parameters.contact_duration, timeline.frame[0]);
    let carried = carry::carry(member, &corner, contact_duration, duration)?;
    Some((number, carried))
}

/// Begins the flight of a sphere under forces that depend on where it is and how it moves, besides
/// an acceleration \[m/s²\] that is the same everywhere.
fn begin_under_varying(
    timeline: &mut Timeline,
    system: &System,
    slot: u32,
    uniform: DVec3,
    [start, end]: [f64; 2],
) {
    let half = 0.5 * (end - start);
    let kind = *timeline.kind_of(slot);
    let acceleration_in = |(position, velocity): (DVec3, DVec3), time: f64| {
        let state = SphereState { position, velocity, radius: kind.radius, mass: kind.mass };
        uniform + forces::total_of_others(system.forces, &state, time) / kind.mass
    };
    let (position, velocity) = timeline.state_of(slot, start);
    timeline.begin_flight(slot, position, velocity, start);
    // In a periodic box the flight may begin at an image of that place.
    let before = acceleration_in(timeline.state_of(slot, start), start);
    timeline.set_acceleration(slot, before);
    let middle = acceleration_in(timeline.state_of(slot, start + half), start + half);
    timeline.set_acceleration(slot, middle);
}
