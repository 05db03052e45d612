//! Persistent contacts: which ones stay, with which forces, and for how long those hold.

use std::collections::BTreeMap;

use super::accelerations::{
    Accelerations, IDLE, accelerations_under, bias, forces, free_acceleration, is_idle,
};
use super::correction::correct;
use super::piece::{TURN, through_the_middle, turning_time};
use super::sliding::sliding_time;
use crate::norm::Norm;
use crate::respond::restitution_of;
use crate::rule::exact::contact_scale::ContactScale;
use crate::rule::exact::contacts::{Group, Member, Touch};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::flights::Support;
use crate::work::Work;

use glam::DVec3;

/// Spheres in lasting contact whose speed is below this part of the speeds they came with are at
/// rest, but for rounding.
pub(crate) const REST: f64 = 1e-12;
/// Finds the contacts of a group that stay closed and what they do; brings their gaps and normal
/// velocities to zero.
pub(crate) fn find(context: &StepContext, group: &mut Group) -> Vec<Support> {
    let may_persist = may_persist(context, group);
    let (mut lasting, known_forces) = pressing_contacts(context.work, &group.members, &may_persist);
    let mut known_forces = Some(known_forces);
    while !lasting.is_empty() {
        let has_moved = correct(context, group, &mut lasting);
        // Contacts that push nothing were left out: the forces of the others are the same, unless drag
        // has changed with the velocities.
        let has_drag = group.members.iter().any(|member| member.species.drag_rate > 0.0);
        let known_forces = known_forces.take().filter(|_| !(has_moved || has_drag));
        let forces = known_forces.unwrap_or_else(|| forces(context.work, &group.members, &lasting));
        let accelerations =
            zero_roundoff(context, group, accelerations_under(&group.members, &lasting, &forces));
        let frame_left = (context.start + context.length - group.time).max(0.0);
        let turning = turning_time(&group.members, &lasting, &accelerations, frame_left);
        let (accelerations, hold) = if turning == f64::INFINITY {
            (accelerations, turning)
        } else {
            match through_the_middle(context, group, &lasting, (&accelerations, &forces), turning) {
                Ok((middle, hold)) => (zero_roundoff(context, group, middle), hold),
                Err(released) => {
                    let mut released = released.into_iter();
                    lasting.retain(|_| !released.next().unwrap_or(false));
                    continue;
                }
            }
        };
        if hold < f64::INFINITY {
            add_closing(&group.members, &may_persist, &accelerations, &mut lasting);
        }
        let hold = hold.min(sliding_time(context, group, &lasting, &accelerations));
        // What holds for less than a contact's duration is in doubt only by rounding.
        let hold = hold.max(context.parameters.contact_duration);
        return connected(group, &lasting, &accelerations, group.time + hold);
    }
    Vec::new()
}

/// The touches that may stay closed: those whose bodies would be back in contact within a contact's
/// duration.
fn may_persist(context: &StepContext, group: &Group) -> Vec<Touch> {
    let members = &group.members;
    let persists = |touch: &&Touch| {
        let free = touch.first.map_or(DVec3::ZERO, |first| free_acceleration(&members[first]));
        let free = free.norm() + free_acceleration(&members[touch.second]).norm();
        let acceleration = free + bias(touch, members).abs();
        let is_elastic = restitution_of(touch.bodies, context.system) == 1.0;
        let scale = ContactScale { acceleration, is_elastic, ..group.scale(touch) };
        let duration = context.duration_of(&scale, group.time);
        is_back_within(duration, touch.normal_velocity(members), acceleration)
    };
    group.touches.iter().filter(persists).copied().collect()
}

/// Of slow touches, those that stay closed, for their forces press; with the forces \[N\].
fn pressing_contacts(
    work: &Work,
    members: &[Member],
    may_persist: &[Touch],
) -> (Vec<Touch>, Vec<f64>) {
    if may_persist.is_empty() {
        return (Vec::new(), Vec::new());
    }
    let forces = forces(work, members, may_persist);
    let mut is_borne = vec![false; members.len()];
    for (touch, &force) in may_persist.iter().zip(&forces) {
        if force > 0.0 {
            touch.places().for_each(|place| is_borne[place] = true);
        }
    }
    let accelerations = accelerations_under(members, may_persist, &forces);
    let stays = |(&touch, force): (&Touch, f64)| {
        let all_borne = is_borne[touch.second] && touch.first.is_none_or(|first| is_borne[first]);
        let persists = force > 0.0 || (all_borne && is_idle(&accelerations, &touch, members));
        persists.then_some((touch, force))
    };
    may_persist.iter().zip(forces).filter_map(stays).unzip()
}

/// Adds slow touches that open now and would close under the accelerations of the middle of a turn:
/// for this piece of the path their bodies add_closing on each other without a force, and the gap that is
/// missing is of the third order in the turn, like that of the piece.
fn add_closing(
    members: &[Member],
    may_persist: &[Touch],
    accelerations: &Accelerations,
    lasting: &mut Vec<Touch>,
) {
    let leans = |touch: &&Touch| {
        let closing = -accelerations.along(touch, members);
        closing > 0.0
            && closing <= TURN * accelerations.scale_at(touch, members)
            && !lasting.iter().any(|known| known.bodies == touch.bodies)
    };
    let leaning: Vec<Touch> = may_persist.iter().filter(leans).copied().collect();
    lasting.extend(leaning);
    lasting.sort_unstable_by_key(|touch| touch.bodies);
}

/// Whether what parts with a speed \[m/s\] against an acceleration \[m/s²\] is back within a `duration`
/// \[s\]: thrown up with u against a, a body is back after 2 u / a.
pub(crate) fn is_back_within(duration: f64, speed: f64, acceleration: f64) -> bool {
    acceleration > 0.0 && speed <= 0.5 * acceleration * duration
}

/// Stops what moves and accelerates by no more than rounding.
fn zero_roundoff(
    context: &StepContext,
    group: &mut Group,
    mut accelerations: Accelerations,
) -> Accelerations {
    let (fastest, time) = (group.fastest, group.time);
    for (member, acceleration) in group.members.iter_mut().zip(&mut accelerations.each) {
        let Member { position, velocity, species, .. } = member;
        let scale = species.acceleration.norm() + accelerations.largest;
        let contact = ContactScale::default().with(*position, *velocity, species);
        let gained = scale * context.duration_of(&contact, time);
        if acceleration.norm() <= IDLE * scale && velocity.norm() <= REST * (fastest + gained) {
            (*velocity, *acceleration) = (DVec3::ZERO, DVec3::ZERO);
        }
    }
    accelerations
}

/// The spheres and contacts that hang together, each set by itself.
fn connected(
    group: &Group,
    touches: &[Touch],
    accelerations: &Accelerations,
    renewal: f64,
) -> Vec<Support> {
    let mut root: Vec<usize> = (0..group.members.len()).collect();
    let mut is_borne = vec![false; root.len()];
    for touch in touches {
        is_borne[touch.second] = true;
        if let Some(first) = touch.first {
            is_borne[first] = true;
            let (a, b) = (root_of(&root, first), root_of(&root, touch.second));
            root[a.max(b)] = a.min(b);
        }
    }
    let mut supports: BTreeMap<usize, Support> = BTreeMap::new();
    let of = |supports: &mut BTreeMap<usize, Support>, place: usize| {
        let empty = || Support { members: Vec::new(), contacts: Vec::new(), renewal };
        let root = root_of(&root, place);
        supports.entry(root).or_insert_with(empty);
        root
    };
    for (place, member) in group.members.iter().enumerate().filter(|(place, _)| is_borne[*place]) {
        let root = of(&mut supports, place);
        if let Some(support) = supports.get_mut(&root) {
            support.members.push((member.slot, accelerations.each[place]));
        }
    }
    for touch in touches {
        let root = of(&mut supports, touch.second);
        if let Some(support) = supports.get_mut(&root) {
            support.contacts.push(touch.bodies);
        }
    }
    supports.into_values().collect()
}

/// The smallest place that hangs together with this one.
fn root_of(root: &[usize], mut place: usize) -> usize {
    while root[place] != place {
        place = root[place];
    }
    place
}
