//! Groups of bodies that touch at one instant: their impacts are answered together, and contacts
//! that would not part again become lasting ones.

use glam::DVec3;

use super::body::Kind;
use super::contact_duration::ContactScale;
use super::predict::{self, Unresolved};
use super::stage::Stage;
use super::support::{self, Support};
use super::timeline::Timeline;
use super::touch::{self, Touch};
use super::{UNITS_PER_FLIGHT, follow_up, periodic, settle};
use crate::detect::contact::Bodies;
use crate::flight::Flight;
use crate::norm::Norm;
use crate::report::{Impact, ImpactGroup, Participants};
use crate::respond;
use crate::respond::TouchingContact;
use crate::sum::Sum;

/// Bodies that touch at one instant.
pub(super) struct Group {
    /// On the world's clock \[s\].
    pub time: f64,
    /// Ascending by index.
    pub members: Vec<Member>,
    /// In the order of their bodies.
    pub touches: Vec<Touch>,
    /// Largest speed among the members as they came \[m/s\].
    pub fastest: f64,
}

/// A sphere of a group.
#[derive(Debug, Clone, Copy)]
pub(super) struct Member {
    pub slot: u32,
    /// Centre \[m\] and velocity \[m/s\] at the instant.
    pub position: DVec3,
    pub velocity: DVec3,
    /// Free of contact forces.
    pub kind: Kind,
}

impl Group {
    /// Place among the members of the sphere at an index of the world's arrays.
    pub fn place_of(&self, timeline: &Timeline, index: u32) -> Option<usize> {
        let index_of = |member: &Member| timeline.index_of[member.slot as usize];
        self.members.binary_search_by_key(&index, index_of).ok()
    }

    /// What can be resolved of a contact of the group. Where one contact is curved, the spheres that it
    /// moves have the error of its path in all their contacts.
    pub fn scale(&self, touch: &Touch) -> ContactScale {
        let is_curved = self.touches.iter().any(Touch::bends);
        touch
            .places()
            .map(|place| &self.members[place])
            .fold(ContactScale { is_curved, ..ContactScale::default() }, |scale, member| {
                scale.with(member.position, member.velocity, &member.kind)
            })
    }

    /// Whether two bodies touch in the group.
    pub fn has(&self, bodies: Bodies) -> bool {
        self.touches.binary_search_by_key(&bodies, |touch| touch.bodies).is_ok()
    }
}

impl Member {
    /// What can be resolved of the contacts of this sphere with surfaces, some of them curved or none.
    pub fn scale(&self, is_curved: bool) -> ContactScale {
        let scale = ContactScale { is_curved, ..ContactScale::default() };
        scale.with(self.position, self.velocity, &self.kind)
    }

    /// The sphere after `h` \[s\] under this acceleration of everything but drag \[m/s²\].
    pub fn after(&self, acceleration: DVec3, h: f64) -> Self {
        let Self { position, velocity, kind, .. } = *self;
        let flight = Flight { position, velocity, acceleration, drag_rate: kind.drag_rate };
        let (position, velocity) = flight.after(h);
        Self { position, velocity, ..*self }
    }
}

/// Answers what happens at `time` \[s\] among the spheres at `seeds`, the surface they met, if any,
/// and all that touch them.
pub(super) fn answer(
    timeline: &mut Timeline,
    stage: &mut Stage,
    seeds: &[u32],
    surface: Option<u32>,
    time: f64,
) {
    let work_before = stage.work.done();
    stage.work.allow(UNITS_PER_FLIGHT * (u64::from(stage.parameters.max_impacts) + 1));
    let mut merged = Vec::new();
    let (mut group, answer) = loop {
        let mut group = touch::gather(timeline, stage, seeds, surface, &merged, time);
        settle::settle(timeline, stage, &mut group);
        let answer = respond_to_impacts(timeline, stage, &mut group, &merged);
        let found = follow_up::follow_ups(timeline, stage, &group, &answer.struck(&group));
        if found.is_empty() || !stage.work.spend(group.members.len() as u64) {
            break (group, answer);
        }
        merged.extend(found);
    };
    record(stage, &group, &answer);
    let struck = answer.struck(&group);
    let supports = support::find(stage, &mut group);
    let held: Vec<Bodies> =
        supports.iter().flat_map(|support| &support.contacts).copied().collect();
    begin_flights(timeline, &group, &struck, supports);
    for member in &group.members {
        predict::predict(timeline, stage, member.slot, group.time);
    }
    let work = (stage.work.done() - work_before) / UNITS_PER_FLIGHT;
    timeline.charge(group.members.iter().map(|member| member.slot), work);
    stage.work.allow(u64::MAX);
    // Bodies that touch and part, or still close by rounding, may be predicted to meet at once.
    let unresolved = unresolved(timeline, stage, &group, &held, met(timeline, seeds, surface));
    for member in &group.members {
        predict::pass_over(timeline, member.slot, &unresolved);
    }
}

/// The bodies that touch and are not `held` in persistent contact, and those whose meeting was
/// predicted though they do not touch.
fn unresolved(
    timeline: &Timeline,
    stage: &Stage,
    group: &Group,
    held: &[Bodies],
    met: Option<Bodies>,
) -> Vec<Unresolved> {
    let parting = group.touches.iter().filter(|touch| !held.contains(&touch.bodies));
    let unresolved = parting.map(|touch| Unresolved {
        bodies: touch.bodies,
        until: group.time + unresolved_time(timeline, stage, group, touch),
    });
    let apart = met
        .filter(|&bodies| !group.has(bodies))
        .map(|bodies| Unresolved { bodies, until: group.time + stage.parameters.contact_duration });
    unresolved.chain(apart).collect()
}

/// How long \[s\] bodies that touch and are not in persistent contact close by less than the gap at
/// which they count as touching.
fn unresolved_time(timeline: &Timeline, stage: &Stage, group: &Group, touch: &Touch) -> f64 {
    let acceleration = |place: usize| {
        let Member { slot, velocity, kind, .. } = group.members[place];
        timeline.kind_of(slot).acceleration - kind.drag_rate * velocity
    };
    let first = touch.first.map_or(DVec3::ZERO, acceleration);
    let pull = (first - acceleration(touch.second)).dot(touch.normal).max(0.0);
    let closing = (-touch.normal_velocity(&group.members)).max(0.0);
    let scale = group.scale(touch);
    let gap = scale.resolved_gap();
    let speed = touch.relative_velocity(&group.members).norm();
    let closed = 2.0 * gap / (closing + (closing * closing + 2.0 * pull * gap).sqrt());
    closed.min(scale.resolved_time(speed)).max(stage.parameters.contact_duration)
}

/// The two bodies whose meeting was predicted, if any was.
fn met(timeline: &Timeline, seeds: &[u32], surface: Option<u32>) -> Option<Bodies> {
    let index = |slot: u32| timeline.index_of[slot as usize];
    match (seeds, surface) {
        (&[first, second], _) => Some(Bodies::pair([first, second].map(index))),
        (&[slot], Some(surface)) => Some(Bodies::Surface { sphere: index(slot), surface }),
        _ => None,
    }
}

/// What impacts did to a group.
struct Answer {
    /// One per touch: speed of approach before all impacts \[m/s\].
    approach_speeds: Vec<f64>,
    /// One per touch \[N s\].
    impulses: Vec<f64>,
    /// What the impacts did to momentum and energy of the spheres.
    account: ImpactGroup,
}

impl Answer {
    /// The touches that got an impulse.
    fn struck(&self, group: &Group) -> Vec<Bodies> {
        let touches = group.touches.iter().zip(&self.impulses);
        touches.filter(|(_, impulse)| **impulse > 0.0).map(|(touch, _)| touch.bodies).collect()
    }
}

/// Gives every closing contact its impulse, by the impact law. What of the `merged` contacts still
/// closes then is answered plastically, together with all others.
fn respond_to_impacts(
    timeline: &Timeline,
    stage: &Stage,
    group: &mut Group,
    merged: &[Bodies],
) -> Answer {
    let count = group.touches.len();
    let speeds = group.touches.iter().map(|touch| -touch.normal_velocity(&group.members));
    let approach_speeds: Vec<f64> = speeds.collect();
    let (mut impulses, mut energy_demanded) = (vec![0.0; count], 0.0);
    if !approach_speeds.iter().any(|&speed| speed > 0.0) {
        return Answer { approach_speeds, impulses, account: ImpactGroup::default() };
    }
    let masses: Vec<f64> = group.members.iter().map(|member| member.kind.mass).collect();
    let before: Vec<DVec3> = group.members.iter().map(|member| member.velocity).collect();
    let mut after = before.clone();
    let contacts = contacts_of(timeline, stage, group);
    let law = stage.system.settings.impact_law;
    let mut resolve = |places: &[usize], contacts: &[TouchingContact]| {
        let response = respond::resolve_within(stage.work, law, contacts, &masses, &mut after);
        energy_demanded += response.restitution_energy;
        for (&place, impulse) in places.iter().zip(response.impulses) {
            impulses[place] += impulse;
        }
    };
    let is_merged = |place: &usize| merged.contains(&group.touches[*place].bodies);
    let touching: Vec<usize> = (0..count).filter(|place| !is_merged(place)).collect();
    let given: Vec<_> = touching.iter().map(|&place| contacts[place]).collect();
    resolve(&touching, &given);
    if !merged.is_empty() {
        let plastic = |contact: &TouchingContact| TouchingContact { restitution: 0.0, ..*contact };
        let all: Vec<usize> = (0..count).collect();
        resolve(&all, &contacts.iter().map(plastic).collect::<Vec<_>>());
    }
    for (member, velocity) in group.members.iter_mut().zip(&after) {
        member.velocity = *velocity;
    }
    let account = ImpactGroup { energy_demanded, ..account_of([&before, &after], &masses) };
    Answer { approach_speeds, impulses, account }
}

/// Writes down the impacts of a group.
fn record(stage: &mut Stage, group: &Group, answer: &Answer) {
    let Answer { approach_speeds, impulses, .. } = answer;
    let mut account = answer.account;
    let mut impacts: Vec<Impact> = Vec::new();
    for ((touch, &impulse), &approach_speed) in
        group.touches.iter().zip(impulses).zip(approach_speeds)
    {
        if impulse <= 0.0 {
            continue;
        }
        if matches!(touch.bodies, Bodies::Surface { .. }) {
            account.momentum_after -= impulse * touch.normal;
            account.energy_after -= impulse * touch.normal.dot(touch.surface_velocity);
        }
        let between = Participants::of(touch.bodies, stage.system);
        let point = periodic::folded(touch.point, stage.period);
        // Faces of a box share edges and corners, where a sphere meets several at one place.
        let same = impacts.iter_mut().find(|it| it.between == between && it.point == point);
        if let Some(impact) = same {
            impact.impulse += impulse;
            continue;
        }
        impacts.push(Impact {
            time: stage.since_start(group.time),
            between,
            point,
            normal: touch.normal,
            approach_speed,
            separation_speed: touch.normal_velocity(&group.members),
            impulse,
        });
    }
    if !impacts.is_empty() {
        stage.record(impacts, account);
    }
}

/// The touches as the impact laws take them.
fn contacts_of(timeline: &Timeline, stage: &Stage, group: &Group) -> Vec<TouchingContact> {
    let slot = |place: usize| group.members[place].slot;
    let contact = |touch: &Touch| {
        let own = |place: usize| group.members[place].kind.restitution;
        let restitution = match (touch.first, touch.bodies) {
            (Some(first), _) => {
                let restitution = stage.restitution_rule().combine(own(first), own(touch.second));
                let slots = [slot(first), slot(touch.second)];
                stage.restitution_at(timeline, slots, restitution, group.time)
            }
            (None, bodies) => {
                let restitution = respond::restitution_of(bodies, stage.system);
                stage.restitution_at(timeline, [slot(touch.second)], restitution, group.time)
            }
        };
        TouchingContact { restitution, ..touch.contact() }
    };
    group.touches.iter().map(contact).collect()
}

/// Momentum and energy of the spheres before and after.
pub(super) fn account_of([before, after]: [&[DVec3]; 2], masses: &[f64]) -> ImpactGroup {
    let momentum = |velocities: &[DVec3]| {
        let part = |axis: usize| {
            masses.iter().zip(velocities).map(|(m, v)| m * v[axis]).collect::<Sum>().value()
        };
        DVec3::new(part(0), part(1), part(2))
    };
    let energy = |velocities: &[DVec3]| {
        let terms = masses.iter().zip(velocities).map(|(m, v)| 0.5 * m * v.length_squared());
        terms.collect::<Sum>().value()
    };
    let sizes = masses.iter().zip(before).map(|(m, v)| m * v.norm());
    ImpactGroup {
        momentum_before: momentum(before),
        momentum_after: momentum(after),
        momentum_scale: sizes.collect::<Sum>().value(),
        energy_before: energy(before),
        energy_after: energy(after),
        ..ImpactGroup::default()
    }
}

/// Begins a new flight of every sphere of the group, borne by its lasting contacts. Bodies that were
/// `struck` begin it by that.
fn begin_flights(
    timeline: &mut Timeline,
    group: &Group,
    struck: &[Bodies],
    supports: Vec<Support>,
) {
    for member in &group.members {
        timeline.set_free(member.slot);
        timeline.begin_flight(member.slot, member.position, member.velocity, group.time);
    }
    for index in struck.iter().flat_map(|bodies| bodies.spheres()) {
        timeline.bodies[timeline.slot_of[index as usize] as usize].strike();
    }
    supports.into_iter().for_each(|support| timeline.set_supported(support));
}
