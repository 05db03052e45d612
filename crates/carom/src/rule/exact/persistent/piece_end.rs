//! The end of a piece of path in persistent contact: corrects what the piece, a parabola, misses of the curve.

use std::collections::BTreeMap;

use glam::DVec3;

use super::correction::correct;
use crate::bodies::Motion;
use crate::norm::Norm;
use crate::respond;
use crate::rule::exact::contacts::{self, Group, Member, Touch};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::flights::ContactWork;
use crate::rule::exact::timeline::Timeline;
use crate::rule::periodic;
use crate::sum::Sum;

/// Kinetic energy is restored to at most this many times what is left, so that nothing is pushed past its turning
/// point.
const MOST_RESTORED: f64 = 4.0;
/// Normals that differ by less than this angle \[rad\] count as one direction.
const SAME_DIRECTION: f64 = 1e-6;

/// Removes the overlap and the normal velocities that a piece of path left in contacts on curves, and restores the
/// energy that the spheres had at its start. A persistent contact allows no normal velocity: the velocity comes
/// from the parabola and is neither an impact nor a separation.
pub(crate) fn settle(timeline: &Timeline, context: &StepContext, group: &mut Group) {
    let has_persisted = |touch: &&Touch| touch.has_persisted;
    let mut persisted: Vec<Touch> = group.touches.iter().filter(has_persisted).copied().collect();
    if !persisted.iter().any(|touch| touch.is_curved() || touch.is_handed_over) {
        return;
    }
    correct(context, group, &mut persisted);
    let Group { members, touches, time, .. } = group;
    let measured = |touch: &Touch| touch.measured_at(context, members, *time);
    *touches = touches.iter().filter_map(measured).collect();
    let mut clusters: BTreeMap<u32, Cluster> = BTreeMap::new();
    for (place, member) in members.iter().enumerate() {
        if let Some(number) = timeline.flights.species_of(member.slot).cluster {
            let cluster = clusters.entry(number).or_default();
            cluster.members.push(place);
            // An integrator keeps the energy of its curves.
            cluster.is_on_curves |= timeline.flights.species_of(member.slot).is_curved;
        }
    }
    for touch in touches.iter().filter(|touch| touch.has_persisted) {
        let number = timeline.flights.species_of(members[touch.second].slot).cluster;
        if let Some(cluster) = number.and_then(|number| clusters.get_mut(&number)) {
            cluster.is_curved |= touch.is_curved() || touch.is_handed_over;
            if touch.first.is_none() {
                cluster.hold_along(touch.normal);
                // Along the piece, the normal stayed in the plane of sliding.
                cluster.hold_along(touch.sliding(members));
            }
            let has_friction = || respond::friction_of(touch.bodies, context.system).acts();
            cluster.gets_work |= touch.does_work() || (timeline.has_friction() && has_friction());
        }
    }
    let is_restored =
        |cluster: &&Cluster| cluster.is_curved && !cluster.gets_work && !cluster.is_on_curves;
    for cluster in clusters.values().filter(is_restored) {
        restore_energy(timeline, members, cluster, *time);
    }
}

/// Writes the states at a frame's end of spheres in persistent contact on curves, as if their piece of path ended
/// there; the piece continues.
pub(crate) fn write_motion(
    timeline: &Timeline,
    context: &StepContext,
    motion: &mut Motion,
    time: f64,
) {
    for cluster in timeline.flights.clusters.iter() {
        let is_moving = |&slot: &u32| {
            timeline.flights.bodies[slot as usize].velocity != DVec3::ZERO
                || timeline.flights.species_of(slot).acceleration != DVec3::ZERO
        };
        if !cluster.members.iter().any(is_moving) {
            continue;
        }
        let mut group = contacts::gather_cluster(timeline, context, cluster, time);
        settle(timeline, context, &mut group);
        for member in &group.members {
            let index = timeline.flights.index_of[member.slot as usize] as usize;
            motion.position[index] = periodic::wrapped(member.position, context.period);
            motion.velocity[index] = member.velocity;
        }
    }
}

/// The work \[J\] of moving colliders on spheres that [`write_motion`] moved onto them at `time` \[s\]: the flights go
/// on as if nothing had, so the next frame begins with less.
pub(crate) fn work_written(timeline: &Timeline, motion: &Motion, period: DVec3, time: f64) -> f64 {
    let flights = &timeline.flights;
    let gained = |&slot: &u32| {
        let species = flights.species_of(slot);
        if species.contact_work != ContactWork::Colliders {
            return 0.0;
        }
        let index = flights.index_of[slot as usize] as usize;
        let (position, velocity) = flights.state_of(slot, time);
        let written = motion.velocity[index];
        let change = 0.5 * (written - velocity).dot(written + velocity);
        let way = periodic::wrapped(motion.position[index] - position, period);
        species.mass * (change - flights.free_species_of(slot).acceleration.dot(way))
    };
    flights.clusters.iter().flat_map(|cluster| &cluster.members).map(gained).sum()
}

/// Spheres that were in persistent contact with each other.
#[derive(Default)]
struct Cluster {
    /// Places among the members of the group.
    members: Vec<usize>,
    /// Whether a normal turns.
    is_curved: bool,
    /// Orthogonal directions along which surfaces hold the cluster: its momentum is not conserved there.
    held: Vec<DVec3>,
    /// Whether a moving surface, or friction, does work on the cluster.
    gets_work: bool,
    /// Whether the spheres fly on curves.
    is_on_curves: bool,
}

impl Cluster {
    /// Notes that a surface holds the cluster along a direction, which is not zero.
    fn hold_along(&mut self, direction: DVec3) {
        let rest = across(&self.held, direction.normalize_or_zero());
        if rest.norm() > SAME_DIRECTION {
            self.held.push(rest / rest.norm());
        }
    }
}

/// The part of a vector at right angles to these orthogonal directions.
fn across(directions: &[DVec3], vector: DVec3) -> DVec3 {
    directions.iter().fold(vector, |rest, &direction| rest - rest.dot(direction) * direction)
}

/// Scales the velocities of a cluster so that its energy is that of the start of its flights: contact forces at
/// surfaces at rest do no work. Momentum is conserved in all directions in which no surface holds the cluster. With
/// drag, the energy is not changed.
fn restore_energy(timeline: &Timeline, members: &mut [Member], cluster: &Cluster, time: f64) {
    let spheres = || cluster.members.iter().map(|&place| &members[place]);
    if spheres().any(|member| member.species.drag_rate > 0.0) {
        return;
    }
    let mass: f64 = spheres().map(|member| member.species.mass).sum();
    let momentum: DVec3 = spheres().map(|member| member.species.mass * member.velocity).sum();
    let mean =
        if cluster.held.len() < 3 { across(&cluster.held, momentum / mass) } else { DVec3::ZERO };
    let kinetic =
        |member: &Member| 0.5 * member.species.mass * (member.velocity - mean).length_squared();
    let gained = |member: &Member| {
        let body = &timeline.flights.bodies[member.slot as usize];
        // Differences and sums of the velocities: their squares would cancel.
        let change = member.velocity - body.velocity;
        let kinetic = 0.5 * change.dot(member.velocity + body.velocity);
        let fallen = member.species.acceleration.dot(member.position - body.position);
        member.species.mass * (kinetic - fallen)
    };
    let kinetic = spheres().map(kinetic).collect::<Sum>().value();
    let gained = spheres().map(gained).collect::<Sum>().value();
    let is_moving =
        spheres().any(|member| timeline.flights.bodies[member.slot as usize].time < time);
    if kinetic <= 0.0 || !is_moving {
        return;
    }
    let factor = (1.0 - gained / kinetic).clamp(0.0, MOST_RESTORED).sqrt();
    for &place in &cluster.members {
        let velocity = &mut members[place].velocity;
        *velocity = mean + factor * (*velocity - mean);
    }
}
