//! The energy of contacts that begin to persist: what they take, what moving surfaces give, and what the correction of
//! overlaps gives.

use glam::DVec3;

use crate::forces;
use crate::norm::Norm;
use crate::rule::exact::contacts::{Group, Member, Touch};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::displacement::{Displacement, energy_gained};
use crate::rule::exact::timeline::Timeline;

/// A sphere is moved out of more than rounding, or the end of a piece of path, by more than this part of its radius.
const ROUNDING: f64 = 1e-9;

/// Centre and velocity of each member, where a surface that moves touches one; else nothing.
pub(super) fn states_of(group: &Group) -> Vec<[DVec3; 2]> {
    let gets_work = group.touches.iter().any(Touch::does_work);
    let states = || group.members.iter().map(Member::state).collect();
    if gets_work { states() } else { Vec::new() }
}

/// The work \[J\] of moving surfaces on spheres that were moved onto them, from these states.
pub(super) fn work_of_corrections(group: &Group, before: &[[DVec3; 2]]) -> f64 {
    let gained = |(member, &[position, velocity]): (&Member, &[DVec3; 2])| {
        let change = 0.5 * (member.velocity - velocity).dot(member.velocity + velocity);
        let fallen = member.species.acceleration.dot(member.position - position);
        member.species.mass * (change - fallen)
    };
    group.members.iter().zip(before).map(gained).sum()
}

/// Accounts for the energy that contacts took as they began to persist, since the members were so: closings too small
/// for an impact end without one, and overlaps are corrected.
pub(super) fn account_for_closings(
    timeline: &mut Timeline,
    context: &mut StepContext,
    group: &Group,
    mut before: Vec<Member>,
) {
    let moved = displacements(context, group, &before);
    context.report.energy_account.correction +=
        energy_gained(timeline, context.system, &moved, group.time);
    for (member, moved) in before.iter_mut().zip(&moved) {
        member.position = moved.to;
    }
    if group.touches.iter().any(Touch::does_work) {
        let states: Vec<[DVec3; 2]> = before.iter().map(Member::state).collect();
        timeline.flights.add_collider_work(work_of_corrections(group, &states));
        return;
    }
    let spheres = context.system.spheres;
    let gained = |(after, before): (&Member, &Member)| {
        let moment = spheres.moment_of_inertia(after.index as usize);
        after.gained_since(before, moment)
    };
    let gained = group.members.iter().zip(&before).map(gained).sum();
    timeline.flights.add_contact_work(gained);
}

/// How far the members are moved out of overlaps that are more than rounding, where forces vary between both places;
/// else nothing.
fn displacements(context: &StepContext, group: &Group, before: &[Member]) -> Vec<Displacement> {
    let are_constant =
        !context.system.has_interactions() && forces::are_linear(context.system.forces);
    let moves = group.members.iter().zip(before).map(|(after, before)| Displacement {
        index: after.index,
        from: before.position,
        to: after.position,
        velocity: after.velocity,
    });
    let is_far = |(it, member): (Displacement, &Member)| {
        (it.to - it.from).norm() > ROUNDING * member.species.radius
    };
    if are_constant || !moves.clone().zip(before).any(is_far) {
        return Vec::new();
    }
    moves.collect()
}
