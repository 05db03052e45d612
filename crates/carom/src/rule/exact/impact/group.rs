//! Impacts of a group: everything that touches at one instant is answered together. Contacts that would not part
//! become persistent.

use std::iter::repeat;

use glam::DVec3;

use super::account::account_of;
use super::closings::{account_for_closings, states_of, work_of_corrections};
use super::follow_up;
use super::friction::{self, FrictionImpulses};
use super::group_log;
use super::kick::{Kicks, is_same, kick_in_group};
use crate::detect::contact::Bodies;
use crate::norm::Norm;
use crate::report::{BodyPair, Impact, ImpactGroup};
use crate::respond;
use crate::respond::TouchingContact;
use crate::rule::exact::answer::changed::{Changed, Unresolved};
use crate::rule::exact::contacts::contact_scale::ContactScale;
use crate::rule::exact::contacts::{self, Group, Member, Touch};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::flights::Support;
use crate::rule::exact::persistent::{piece_end, solve};
use crate::rule::exact::timeline::Timeline;
use crate::rule::exact::zones;
use crate::rule::exact::zones::frame_work::UNITS_PER_FLIGHT;
use crate::rule::periodic;

/// Units of work that it takes to find what touches a sphere, and to predict what it meets next.
const UNITS_PER_MEMBER: u64 = 500;
/// Sides of a ring that join the impacts of one sphere, at most.
const MOST_SIDES: u32 = 16;
/// A touch closes of itself if it closes faster than this part of the fastest one: far more than rounding.
const CLOSING: f64 = 1e-6;

/// Where no impulses open all contacts of a group, some close at more than this part of the fastest speed in it: far
/// more than rounding.
const JAMMED: f64 = 1e-6;

/// Answers what happens at `time` \[s\] among the spheres at `seeds`, the surface they met, if any,
/// and all that touch them. Returns the spheres to be predicted.
pub(super) fn answer(
    timeline: &mut Timeline,
    context: &mut StepContext,
    seeds: &[u32],
    surface: Option<u32>,
    time: f64,
) -> Changed {
    let work_before = context.work.done();
    let recorded = [context.report.impacts.len(), context.report.groups.len()];
    let mut allowance = None;
    let (mut merged, mut joined) = (Vec::new(), Vec::new());
    let (mut group, answer) = loop {
        let (mut group, work) = gather(timeline, context, seeds, surface, &joined, time);
        let allowed = *allowance.get_or_insert_with(|| allow_work(timeline, context, &group));
        let answer = respond_on_rings(timeline, context, &mut group, &merged);
        let mut found = follow_up::follow_ups(timeline, context, &group, &answer.struck(&group));
        // What gathering leaves out, as a seam beside a plane, would be found again for ever.
        found.retain(|it| !merged.contains(it));
        if found.is_empty() || allowed == 0 || !context.work.spend(group.members.len() as u64) {
            timeline.flights.add_collider_work(work);
            break (group, answer);
        }
        joined.extend(follow_up::impacts_beside(timeline, &group, &found));
        joined.extend(found.iter().copied());
        merged.extend(found);
    };
    context.counts.groups += 1;
    let is_over = context.work.is_stopped()
        || allowance.is_some_and(|allowed| context.work.done() - work_before >= allowed);
    if answer.cut_short && !is_over && is_jammed(&group) {
        // Moving surfaces leave a sphere no room.
        context.work.allow(u64::MAX);
        let (group, _) = gather(timeline, context, seeds, surface, &joined, time);
        return refuse(timeline, context, &group);
    }
    record(context, &group, &answer);
    let struck = answer.struck(&group);
    let before = group.members.clone();
    let found = solve::find(context, &mut group);
    let spent = context.work.done() - work_before;
    context.work.allow(u64::MAX);
    if context.has_zones() && allowance.is_some_and(|allowed| spent >= allowed) {
        context.report.impacts.truncate(recorded[0]);
        context.report.groups.truncate(recorded[1]);
        let (group, _) = gather(timeline, context, seeds, surface, &joined, time);
        return zones::make_zone(timeline, context, &group);
    }
    let Ok(supports) = found else {
        return refuse(timeline, context, &group);
    };
    account_for_closings(timeline, context, &group, before);
    // Impacts without persistent contacts may be many: their number is that of flights.
    let lasting = if supports.is_empty() { 0 } else { group.members.len() as u64 };
    timeline.budget.charge(&indices_of(&group), spent, UNITS_PER_MEMBER * lasting);
    let held: Vec<Bodies> =
        supports.iter().flat_map(|support| &support.contacts).copied().collect();
    begin_flights(timeline, &group, &struck, supports);
    if !struck.is_empty() {
        let has_kicks = answer.kicks.iter().any(|&kick| kick > 0.0);
        let is_plain = merged.is_empty() && !answer.cut_short && !has_kicks;
        let numbers = [&answer.restitutions[..], &answer.impulses];
        let note = || group_log::impact_of(&group, &answer.before, numbers, is_plain);
        timeline.flights.note_group(note);
    }
    // All flights before any prediction.
    group.members.iter().for_each(|member| timeline.find_curve(context.system, member.slot));
    let slots = group.members.iter().map(|member| member.slot);
    timeline.work.charge(slots, spent / UNITS_PER_FLIGHT);
    // Bodies that touch and part, or still close by rounding, may be predicted to meet at once.
    let unresolved = unresolved(timeline, context, &group, &held, met(timeline, seeds, surface));
    Changed::Group { slots: group.members.iter().map(|member| member.slot).collect(), unresolved }
}

/// Joins a group without an answer to a zone; without zones, the step fails.
fn refuse(timeline: &mut Timeline, context: &mut StepContext, group: &Group) -> Changed {
    if context.has_zones() {
        return zones::make_zone(timeline, context, group);
    }
    context.unanswered = Some(group.members[0].slot);
    Changed::NONE
}

/// Whether contacts still close after the impacts that should open them.
fn is_jammed(group: &Group) -> bool {
    let closing = group.touches.iter().map(|touch| -touch.normal_velocity(&group.members));
    let speeds = group.touches.iter().map(|touch| touch.relative_velocity(&group.members).norm());
    let fastest = speeds.fold(0.0, f64::max);
    closing.fold(0.0, f64::max) > JAMMED * fastest
}

/// Collects what touches at `time` \[s\], in the state before the impact, and the work \[J\] of moving surfaces on
/// what settles.
fn gather(
    timeline: &Timeline,
    context: &StepContext,
    seeds: &[u32],
    surface: Option<u32>,
    joined: &[Bodies],
    time: f64,
) -> (Group, f64) {
    let mut group = contacts::gather(timeline, context, seeds, surface, joined, time);
    let before = states_of(&group);
    piece_end::settle(timeline, context, &mut group);
    let work = work_of_corrections(&group, &before);
    (group, work)
}

/// Limits the solvers to the work that the group may take. Returns that work.
fn allow_work(timeline: &mut Timeline, context: &StepContext, group: &Group) -> u64 {
    let in_frame = UNITS_PER_FLIGHT * (u64::from(context.parameters.max_impacts) + 1);
    let allowed = if context.has_zones() {
        let spheres = indices_of(group);
        timeline.budget.allowance(context.parameters, &spheres, group.time).min(in_frame)
    } else {
        in_frame
    };
    context.work.allow(allowed);
    allowed
}

/// The spheres of a group, by index.
fn indices_of(group: &Group) -> Vec<u32> {
    group.members.iter().map(|member| member.index).collect()
}

/// The bodies that touch and are not `held` in persistent contact, and those whose meeting was
/// predicted though they do not touch.
fn unresolved(
    timeline: &Timeline,
    context: &StepContext,
    group: &Group,
    held: &[Bodies],
    met: Option<Bodies>,
) -> Vec<Unresolved> {
    let parting = group.touches.iter().filter(|touch| !held.contains(&touch.bodies));
    let unresolved = parting.map(|touch| Unresolved {
        bodies: touch.bodies,
        until: group.time + unresolved_time(timeline, context, group, touch),
    });
    let apart = met.filter(|&bodies| !group.has(bodies)).map(|bodies| Unresolved {
        bodies,
        until: group.time + context.parameters.contact_duration,
    });
    unresolved.chain(apart).collect()
}

/// How long \[s\] bodies that touch and are not in persistent contact close by less than the gap at
/// which they count as touching.
fn unresolved_time(
    timeline: &Timeline,
    context: &StepContext,
    group: &Group,
    touch: &Touch,
) -> f64 {
    let acceleration = |place: usize| {
        let Member { slot, velocity, species, .. } = group.members[place];
        timeline.flights.species_of(slot).acceleration - species.drag_rate * velocity
    };
    let first = touch.first.map_or(DVec3::ZERO, acceleration);
    let pull = (first - acceleration(touch.second)).dot(touch.normal).max(0.0);
    let closing = (-touch.normal_velocity(&group.members)).max(0.0);
    let is_elastic = respond::restitution_of(touch.bodies, context.system).is_elastic();
    let scale = ContactScale { is_elastic, ..group.scale(touch) };
    let gap = scale.resolved_gap();
    let speed = touch.relative_velocity(&group.members).norm();
    let closed = 2.0 * gap / (closing + (closing * closing + 2.0 * pull * gap).sqrt());
    closed.min(scale.resolved_time(speed)).max(context.parameters.contact_duration)
}

/// The two bodies whose meeting was predicted, if any was.
fn met(timeline: &Timeline, seeds: &[u32], surface: Option<u32>) -> Option<Bodies> {
    let index = |slot: u32| timeline.flights.index_of[slot as usize];
    match (seeds, surface) {
        (&[first, second], _) => Some(Bodies::pair([first, second].map(index))),
        (&[slot], Some(surface)) => Some(Bodies::Surface { sphere: index(slot), surface }),
        _ => None,
    }
}

/// The effect of impacts on a group.
#[derive(Default)]
struct Answer {
    /// The members before all impacts.
    before: Vec<Member>,
    /// One per touch: coefficient of restitution.
    restitutions: Vec<f64>,
    /// One per touch: speed of approach before all impacts \[m/s\].
    approach_speeds: Vec<f64>,
    /// One per touch \[N s\].
    impulses: Vec<f64>,
    friction: FrictionImpulses,
    /// One per touch: what its surface added \[m/s\]; empty where none did.
    kicks: Vec<f64>,
    /// What the impacts did to momentum and energy of the spheres.
    account: ImpactGroup,
    /// Whether an impact law had no answer, or took too much work.
    cut_short: bool,
}

impl Answer {
    /// The touches that got an impulse.
    fn struck(&self, group: &Group) -> Vec<Bodies> {
        let touches = group.touches.iter().zip(&self.impulses);
        touches.filter(|(_, impulse)| **impulse > 0.0).map(|(touch, _)| touch.bodies).collect()
    }
}

/// Applies the impact law. Sides of a ring join until spheres on it close on none.
fn respond_on_rings(
    timeline: &Timeline,
    context: &StepContext,
    group: &mut Group,
    merged: &[Bodies],
) -> Answer {
    let before = group.members.clone();
    let mut answer = respond_to_impacts(timeline, context, group, merged);
    for _ in 0..MOST_SIDES {
        let closing = contacts::closing_sides(context, group, None);
        if closing.is_empty() {
            break;
        }
        group.members.clone_from(&before);
        contacts::add_sides(context, group, &closing);
        answer = respond_to_impacts(timeline, context, group, merged);
    }
    Answer { before, ..answer }
}

/// Applies the impact law to every closing contact. If one of the `merged` contacts still closes
/// then, all are answered plastically.
fn respond_to_impacts(
    timeline: &Timeline,
    context: &StepContext,
    group: &mut Group,
    merged: &[Bodies],
) -> Answer {
    let count = group.touches.len();
    let speeds = group.touches.iter().map(|touch| -touch.normal_velocity(&group.members));
    let approach_speeds: Vec<f64> = speeds.collect();
    let (mut impulses, mut energy_demanded) = (vec![0.0; count], 0.0);
    let mut cut_short = false;
    if !approach_speeds.iter().any(|&speed| speed > 0.0) {
        return Answer { approach_speeds, impulses, ..Answer::default() };
    }
    let masses: Vec<f64> = group.members.iter().map(|member| member.species.mass).collect();
    let before = velocities_of(group);
    let contacts = contacts_of(timeline, context, group, &approach_speeds);
    let plastic = |contact: &TouchingContact| TouchingContact { restitution: 0.0, ..*contact };
    let has_friction = timeline.has_friction();
    let surfaces = context.system.surfaces;
    let has_kick = |touch: &Touch| {
        matches!(touch.bodies, Bodies::Surface { surface, .. }
        if surfaces[surface as usize].kick > 0.0)
    };
    let has_kicks = group.touches.iter().any(has_kick);
    // These are kept only if impacts are answered a second time.
    let repeated = if merged.is_empty() && !has_friction && !has_kicks { 0 } else { count };
    let plastic: Vec<TouchingContact> = contacts[..repeated].iter().map(plastic).collect();
    let all: Vec<usize> = (0..repeated).collect();
    let law = context.parameters.impact_law;
    let mut resolve = |(places, contacts): (&[usize], &[TouchingContact]),
                       group: &mut Group,
                       impulses: &mut [f64]| {
        let mut after = velocities_of(group);
        let response = respond::resolve_within(context.work, law, contacts, &masses, &mut after);
        for (member, velocity) in group.members.iter_mut().zip(after) {
            member.velocity = velocity;
        }
        energy_demanded += response.restitution_energy;
        cut_short |= response.cut_short;
        for (&place, impulse) in places.iter().zip(response.impulses) {
            impulses[place] += impulse;
        }
    };
    let is_merged = |place: &usize| merged.contains(&group.touches[*place].bodies);
    let touching: Vec<usize> = (0..count).filter(|place| !is_merged(place)).collect();
    let given: Vec<_> = touching.iter().map(|&place| contacts[place]).collect();
    resolve((&touching, &given), group, &mut impulses);
    if !merged.is_empty() {
        resolve((&all, &plastic), group, &mut impulses);
    }
    let mut kicks = Kicks::default();
    if has_kicks {
        kicks = kick_in_group(context, group, &mut impulses);
        // A kick may have set bodies in motion towards others.
        resolve((&all, &plastic), group, &mut impulses);
    }
    let mut friction = FrictionImpulses::default();
    if has_friction {
        friction = friction::in_group(context, group, &impulses);
        // Friction may have set bodies in motion towards others.
        resolve((&all, &plastic), group, &mut impulses);
    }
    let account = account_of([&before, &velocities_of(group)], &masses);
    let kick_work = kicks.work;
    let account = friction.add_to(ImpactGroup { energy_demanded, kick_work, ..account });
    let restitutions = contacts.iter().map(|contact| contact.restitution).collect();
    let kicks = kicks.speeds;
    let before = Vec::new();
    Answer { before, restitutions, approach_speeds, impulses, friction, kicks, account, cut_short }
}

fn velocities_of(group: &Group) -> Vec<DVec3> {
    group.members.iter().map(|member| member.velocity).collect()
}

/// Records the impacts of a group.
fn record(context: &mut StepContext, group: &Group, answer: &Answer) {
    let Answer { approach_speeds, impulses, friction, kicks, .. } = answer;
    let mut account = answer.account;
    for (touch, &impulse) in group.touches.iter().zip(&friction.impulses) {
        if touch.first.is_none() {
            account.momentum_after -= impulse;
            let velocity = friction::surface_velocity(touch, &group.members);
            account.collider_work += impulse.dot(velocity);
        }
    }
    let mut impacts: Vec<Impact> = Vec::new();
    let frictions = friction.impulses.iter().copied().chain(repeat(DVec3::ZERO));
    let kicks = kicks.iter().copied().chain(repeat(0.0));
    let answers = impulses.iter().zip(approach_speeds).zip(frictions).zip(kicks);
    for (touch, (((&impulse, &approach_speed), tangential_impulse), kick)) in
        group.touches.iter().zip(answers)
    {
        if impulse <= 0.0 {
            continue;
        }
        if matches!(touch.bodies, Bodies::Surface { .. }) {
            account.momentum_after -= impulse * touch.normal;
            account.collider_work += impulse * touch.normal.dot(touch.surface_velocity);
        }
        let between = BodyPair::of(touch.bodies, context.system);
        let point = periodic::wrapped(touch.point, context.period);
        // Faces of a box share edges and corners, where a sphere meets several at one place.
        let is_there = |it: &&mut Impact| it.between == between && is_same(it.normal, touch.normal);
        let same = impacts.iter_mut().find(is_there);
        if let Some(impact) = same {
            impact.impulse += impulse;
            impact.tangential_impulse += tangential_impulse;
            continue;
        }
        impacts.push(Impact {
            time: context.since_start(group.time),
            between,
            point,
            normal: touch.normal,
            approach_speed,
            separation_speed: touch.normal_velocity(&group.members),
            impulse,
            tangential_impulse,
            kick,
        });
    }
    if !impacts.is_empty() {
        account.energy_after -= account.collider_work + account.kick_work;
        context.record(impacts, account);
    }
}

/// The touches as the impact laws take them, given their speeds of approach \[m/s\].
///
/// A restitution that depends on the speed is that at the speed of the touch before all impacts. A touch that does not
/// close then is closed by the impacts of the others, so that the speed of the fastest counts for it.
fn contacts_of(
    timeline: &Timeline,
    context: &StepContext,
    group: &Group,
    approach_speeds: &[f64],
) -> Vec<TouchingContact> {
    let slot = |place: usize| group.members[place].slot;
    let fastest = approach_speeds.iter().copied().fold(0.0, f64::max);
    let contact = |(touch, &speed): (&Touch, &f64)| {
        let speed = if speed > CLOSING * fastest { speed } else { fastest };
        let restitution = respond::restitution_of(touch.bodies, context.system).coefficient(speed);
        let velocity = touch.relative_velocity(&group.members);
        let second = slot(touch.second);
        let restitution = match touch.first {
            Some(first) => {
                let slots = [slot(first), second];
                context.restitution_at(timeline, slots, velocity, restitution, group.time)
            }
            None => context.restitution_at(timeline, [second], velocity, restitution, group.time),
        };
        TouchingContact { restitution: restitution.value, ..touch.contact() }
    };
    group.touches.iter().zip(approach_speeds).map(contact).collect()
}

/// Begins a new flight of every sphere of the group, under the forces of its persistent contacts. The flights of
/// `struck` bodies begin with an impact.
fn begin_flights(
    timeline: &mut Timeline,
    group: &Group,
    struck: &[Bodies],
    supports: Vec<Support>,
) {
    for member in &group.members {
        timeline.begin_free_flight(member, group.time);
        timeline.flights.rotate(member.slot, [member.angular_velocity, DVec3::ZERO], group.time);
    }
    for index in struck.iter().flat_map(|bodies| bodies.spheres()) {
        timeline.flights.bodies[timeline.flights.slot_of[index as usize] as usize].strike();
    }
    supports.into_iter().for_each(|support| timeline.set_supported(support, group.time));
}
