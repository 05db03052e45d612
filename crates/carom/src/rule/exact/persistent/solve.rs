//! Persistent contacts: which of them persist, their forces, and how long the forces hold.

use std::collections::BTreeMap;

use glam::DVec3;

use super::accelerations::{
    Accelerations, IDLE, accelerations_under, bias, forces, free_acceleration, is_back_within,
    is_idle,
};
use super::correction::correct;
use super::on_curves;
use super::piece::{TURN, TurnStart, through_the_middle, turning_time};
use super::sliding::sliding_time;
use super::{NoClosedForm, with_friction};
use crate::connected::Connected;
use crate::norm::Norm;
use crate::respond::{friction_of, restitution_of};
use crate::rule::exact::contacts::contact_scale::ContactScale;
use crate::rule::exact::contacts::{self, Group, Member, Touch};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::flights::{ContactWork, Support, Supported};
use crate::work::Work;

/// Spheres in persistent contact are at rest if their speed is below this part of their speeds before the event:
/// rounding.
pub(crate) const REST: f64 = 1e-12;

/// Sides of a ring that are tried for one sphere, at most: each one halves the angle in which the sphere may close on
/// another.
const MOST_SIDES: u32 = 64;

/// Computes the persistent contacts of a group and their forces; sets their gaps and normal velocities to zero. Sides of
/// a ring join until spheres on it close on none.
///
/// # Errors
/// [`NoClosedForm`] where friction acts but on spheres that lie on one surface at rest each.
pub(crate) fn find(context: &StepContext, group: &mut Group) -> Result<Vec<Support>, NoClosedForm> {
    let before = group.members.clone();
    for _ in 0..MOST_SIDES {
        let supports = find_among(context, group)?;
        let accelerations = accelerations_of(group, &supports);
        let closing = contacts::closing_sides(context, group, Some(&accelerations));
        if closing.is_empty() {
            return Ok(supports);
        }
        group.members.clone_from(&before);
        contacts::add_sides(context, group, &closing);
    }
    Err(NoClosedForm)
}

/// The acceleration of each member with its contacts \[m/s²\].
fn accelerations_of(group: &Group, supports: &[Support]) -> Vec<DVec3> {
    let supported = || supports.iter().flat_map(|support| &support.members);
    let acceleration = |member: &Member| {
        let own = supported().find(|it| it.slot == member.slot);
        own.map_or(member.species.acceleration, |it| it.acceleration)
    };
    group.members.iter().map(acceleration).collect()
}

/// Computes the persistent contacts among the touches of a group.
fn find_among(context: &StepContext, group: &mut Group) -> Result<Vec<Support>, NoClosedForm> {
    let candidates = may_persist(context, group);
    let acts = |touch: &Touch| friction_of(touch.bodies, context.system).acts();
    if candidates.iter().any(acts)
        && on_curves::may_bend(&group.members, &candidates)
        && let Some(supports) = find_on_curves(context, group, &candidates)
    {
        return Ok(supports);
    }
    let (persistent, known_forces) = pressing(context.work, &group.members, &candidates);
    let least = IDLE * known_forces.iter().copied().fold(0.0, f64::max);
    let bearing = || persistent.iter().zip(&known_forces).filter(|it| *it.1 > least).map(|it| it.0);
    if bearing().any(acts) {
        let bearing: Vec<Touch> = bearing().copied().collect();
        return find_with_friction(context, group, &candidates, &bearing);
    }
    Ok(find_smooth(context, group, candidates, persistent, known_forces))
}

/// Computes the persistent contacts where friction acts in those that bear: in closed form if there is one, else, of
/// spheres that drag slows or a moving surface carries, and no others bear, on curves. Heaps are for zones.
///
/// # Errors
/// [`NoClosedForm`] if there are neither.
fn find_with_friction(
    context: &StepContext,
    group: &mut Group,
    candidates: &[Touch],
    bearing: &[Touch],
) -> Result<Vec<Support>, NoClosedForm> {
    let are_carried = || bearing.iter().any(|touch| touch.does_work() || touch.belt != DVec3::ZERO);
    let may_bend = (on_curves::are_some_slowed(&group.members) || are_carried())
        && !with_friction::are_some_borne(&group.members, bearing);
    if !may_bend {
        return with_friction::find(context, group, candidates, bearing);
    }
    let members = group.members.clone();
    with_friction::find(context, group, candidates, bearing).or_else(|error| {
        group.members = members;
        find_on_curves(context, group, candidates).ok_or(error)
    })
}

/// Computes the persistent contacts of spheres that fly on curves with friction; `None` if they do not.
fn find_on_curves(
    context: &StepContext,
    group: &mut Group,
    candidates: &[Touch],
) -> Option<Vec<Support>> {
    let (mut persistent, accelerations) =
        on_curves::pressing_with_friction(context, group, candidates)?;
    correct(context, group, &mut persistent);
    let accelerations = zero_roundoff(context, group, accelerations);
    let mut supports = connected(group, &persistent, &accelerations, None);
    for member in supports.iter_mut().flat_map(|support| &mut support.members) {
        let of_slot = |it: &&Member| it.slot == member.slot;
        if let Some(Member { index, .. }) = group.members.iter().find(of_slot) {
            let moment = context.system.spheres.moment_of_inertia(*index as usize);
            member.contact_work = ContactWork::Friction { moment, collider_power: 0.0 };
        }
    }
    Some(supports)
}

/// Computes the persistent contacts among contacts without friction.
fn find_smooth(
    context: &StepContext,
    group: &mut Group,
    candidates: Vec<Touch>,
    mut persistent: Vec<Touch>,
    known_forces: Vec<f64>,
) -> Vec<Support> {
    let mut known_forces = Some(known_forces);
    while !persistent.is_empty() {
        let has_moved = correct(context, group, &mut persistent);
        // Contacts without a force were left out: the forces of the others do not change, unless drag changed with
        // the velocities.
        let has_drag = group.members.iter().any(|member| member.species.drag_rate > 0.0);
        let known_forces = known_forces.take().filter(|_| !(has_moved || has_drag));
        let forces =
            known_forces.unwrap_or_else(|| forces(context.work, &group.members, &persistent));
        let accelerations = zero_roundoff(
            context,
            group,
            accelerations_under(&group.members, &persistent, &forces),
        );
        let frame_left = (context.start + context.length - group.time).max(0.0);
        let turning = turning_time(&group.members, &persistent, &accelerations, frame_left);
        let is_bent = on_curves::may_bend(&group.members, &persistent)
            && (turning < f64::INFINITY || on_curves::are_some_curved(&group.members));
        if is_bent && on_curves::fly_so(context, group, &persistent) {
            return connected(group, &persistent, &accelerations, None);
        }
        let (accelerations, valid_for) = if turning == f64::INFINITY {
            (accelerations, turning)
        } else {
            let start = TurnStart { accelerations: &accelerations, forces: &forces };
            // A contact ends with its face.
            let sliding = sliding_time(context, group, &persistent, &accelerations);
            let turning = turning.min(sliding.max(context.parameters.contact_duration));
            match through_the_middle(context, group, &persistent, start, turning) {
                Ok((middle, valid_for)) => (zero_roundoff(context, group, middle), valid_for),
                Err(released) => {
                    let mut released = released.into_iter();
                    persistent.retain(|_| !released.next().unwrap_or(false));
                    continue;
                }
            }
        };
        if valid_for < f64::INFINITY {
            let turn = most_turned(&persistent, valid_for);
            add_closing(&group.members, &candidates, (&accelerations, turn), &mut persistent);
        }
        let valid_for = valid_for.min(sliding_time(context, group, &persistent, &accelerations));
        // A validity below a contact's duration comes from rounding.
        let valid_for = valid_for.max(context.parameters.contact_duration);
        return connected(group, &persistent, &accelerations, Some(group.time + valid_for));
    }
    Vec::new()
}

/// The touches that may persist: those whose bodies would be back in contact within a contact's duration.
fn may_persist(context: &StepContext, group: &Group) -> Vec<Touch> {
    let members = &group.members;
    let persists = |touch: &&Touch| {
        let free = touch.first.map_or(DVec3::ZERO, |first| free_acceleration(&members[first]));
        let free = free.norm() + free_acceleration(&members[touch.second]).norm();
        let acceleration = free + bias(touch, members).abs();
        let is_elastic = restitution_of(touch.bodies, context.system).is_elastic();
        let scale = ContactScale { acceleration, is_elastic, ..group.scale(touch) };
        let duration = context.duration_of(&scale, group.time);
        is_back_within(duration, touch.normal_velocity(members), acceleration)
    };
    group.touches.iter().filter(persists).copied().collect()
}

/// The touches, of those that may persist, whose forces press, with the forces \[N\].
fn pressing(work: &Work, members: &[Member], candidates: &[Touch]) -> (Vec<Touch>, Vec<f64>) {
    if candidates.is_empty() {
        return (Vec::new(), Vec::new());
    }
    let forces = forces(work, members, candidates);
    let mut is_carried = vec![false; members.len()];
    for (touch, &force) in candidates.iter().zip(&forces) {
        if force > 0.0 {
            touch.places().for_each(|place| is_carried[place] = true);
        }
    }
    let accelerations = accelerations_under(members, candidates, &forces);
    let stays = |(&touch, force): (&Touch, f64)| {
        let all_carried =
            is_carried[touch.second] && touch.first.is_none_or(|first| is_carried[first]);
        let persists = force > 0.0 || (all_carried && is_idle(&accelerations, &touch, members));
        persists.then_some((touch, force))
    };
    candidates.iter().zip(forces).filter_map(stays).unzip()
}

/// Adds touches that may persist, that open now and would close under the accelerations of the middle of
/// a `turn` \[rad\]: for this piece of the path their bodies rest on each other without a force, and the gap that
/// is missing is of the third order in the turn, like that of the piece.
fn add_closing(
    members: &[Member],
    candidates: &[Touch],
    (accelerations, turn): (&Accelerations, f64),
    persistent: &mut Vec<Touch>,
) {
    let closes = |touch: &&Touch| {
        let closing = -accelerations.along(touch, members);
        closing > 0.0
            && closing <= turn * accelerations.scale_at(touch, members)
            && !persistent.iter().any(|known| known.bodies == touch.bodies)
    };
    let closing: Vec<Touch> = candidates.iter().filter(closes).copied().collect();
    persistent.extend(closing);
    persistent.sort_unstable_by_key(|touch| touch.bodies);
}

/// Largest turn of a normal in a piece of path of `valid_for` \[s\] \[rad\].
fn most_turned(touches: &[Touch], valid_for: f64) -> f64 {
    touches
        .iter()
        .map(|touch| touch.form_spin().norm().max(touch.drive_rate) * valid_for)
        .fold(TURN, f64::max)
}

/// Stops spheres whose velocity and acceleration are rounding.
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

/// The connected sets of spheres and contacts. Without a `renewal` \[s\] they fly on curves.
fn connected(
    group: &Group,
    touches: &[Touch],
    accelerations: &Accelerations,
    renewal: Option<f64>,
) -> Vec<Support> {
    let mut connected = Connected::new(group.members.len());
    let mut is_carried = vec![false; group.members.len()];
    for touch in touches {
        is_carried[touch.second] = true;
        if let Some(first) = touch.first {
            is_carried[first] = true;
            connected.join(first, touch.second);
        }
    }
    let does_work = touches.iter().any(Touch::does_work);
    let contact_work = if does_work { ContactWork::Colliders } else { ContactWork::None };
    let mut supports: BTreeMap<usize, Support> = BTreeMap::new();
    let mut of = |supports: &mut BTreeMap<usize, Support>, place: usize| {
        let is_curved = renewal.is_none();
        let renewal = renewal.unwrap_or(f64::INFINITY);
        let empty = || Support {
            members: Vec::new(),
            contacts: Vec::new(),
            sides: Vec::new(),
            renewal,
            is_curved,
            belt_work: 0.0,
        };
        let root = connected.root_of(place);
        supports.entry(root).or_insert_with(empty);
        root
    };
    for (place, member) in group.members.iter().enumerate().filter(|(place, _)| is_carried[*place])
    {
        let root = of(&mut supports, place);
        if let Some(support) = supports.get_mut(&root) {
            let acceleration = accelerations.each[place];
            let (slot, rotation) = (member.slot, None);
            support.members.push(Supported { slot, acceleration, rotation, contact_work });
        }
    }
    for touch in touches {
        let root = of(&mut supports, touch.second);
        if let Some(support) = supports.get_mut(&root) {
            // Sides of a ring are one contact.
            if support.contacts.last() != Some(&touch.bodies) {
                support.contacts.push(touch.bodies);
            }
            support.sides.extend(touch.ring_side());
        }
    }
    supports.into_values().collect()
}
