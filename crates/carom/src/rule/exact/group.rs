//! Groups of bodies that touch at one instant: their impacts are answered together, and contacts
//! that would not part again become lasting ones.

use glam::DVec3;

use super::body::Kind;
use super::stage::Stage;
use super::support::{self, Support};
use super::timeline::Timeline;
use super::touch::{self, Touch};
use super::{periodic, predict};
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

impl Member {
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
    let mut group = touch::gather(timeline, stage, seeds, surface, time);
    support::settle(&mut group);
    let struck = respond_to_impacts(timeline, stage, &mut group);
    let supports = support::find(stage, &mut group);
    let held = supports.iter().flat_map(|support| &support.contacts).copied();
    let answered: Vec<Bodies> = struck.iter().copied().chain(held).collect();
    begin_flights(timeline, &group, &struck, supports);
    for member in &group.members {
        predict::predict(timeline, stage, member.slot, group.time);
    }
    // Who met, and whoever else touches there and was predicted anew, perhaps to meet at once.
    let touching = group.touches.iter().map(|touch| touch.bodies);
    let until = time + stage.parameters.contact_duration;
    for bodies in touching.chain(met(timeline, seeds, surface)) {
        if !answered.contains(&bodies) {
            for index in bodies.spheres() {
                predict::pause(timeline, timeline.slot_of[index as usize], bodies, until);
            }
        }
    }
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

/// Gives every closing contact its impulse, by the impact law, and writes them down; tells who got
/// one.
fn respond_to_impacts(timeline: &Timeline, stage: &mut Stage, group: &mut Group) -> Vec<Bodies> {
    let is_closing = |touch: &Touch| touch.normal_velocity(&group.members) < 0.0;
    if !group.touches.iter().any(is_closing) {
        return Vec::new();
    }
    let contacts = contacts_of(timeline, stage, group);
    let approach: Vec<f64> =
        group.touches.iter().map(|touch| -touch.normal_velocity(&group.members)).collect();
    let masses: Vec<f64> = group.members.iter().map(|member| member.kind.mass).collect();
    let before: Vec<DVec3> = group.members.iter().map(|member| member.velocity).collect();
    let mut after = before.clone();
    let response =
        respond::resolve(stage.system.settings.impact_law, &contacts, &masses, &mut after);
    for (member, velocity) in group.members.iter_mut().zip(&after) {
        member.velocity = *velocity;
    }
    let mut account = account_of([&before, &after], &masses);
    account.energy_demanded = response.restitution_energy;
    let (mut impacts, mut struck): (Vec<Impact>, _) = (Vec::new(), Vec::new());
    for ((touch, &impulse), approach_speed) in
        group.touches.iter().zip(&response.impulses).zip(approach)
    {
        if impulse <= 0.0 {
            continue;
        }
        if matches!(touch.bodies, Bodies::Surface { .. }) {
            account.momentum_after -= impulse * touch.normal;
            account.energy_after -= impulse * touch.normal.dot(touch.surface_velocity);
        }
        struck.push(touch.bodies);
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
    struck
}

/// The touches as the impact laws take them.
fn contacts_of(timeline: &Timeline, stage: &Stage, group: &Group) -> Vec<TouchingContact> {
    let body = |place: usize| &timeline.bodies[group.members[place].slot as usize];
    let contact = |touch: &Touch| {
        let own = |place: usize| group.members[place].kind.restitution;
        let restitution = match (touch.first, touch.bodies) {
            (Some(first), _) => {
                let restitution = stage.restitution_rule().combine(own(first), own(touch.second));
                let bodies = [body(first), body(touch.second)];
                stage.restitution_at(bodies, restitution, group.time)
            }
            (None, bodies) => {
                let restitution = respond::restitution_of(bodies, stage.system);
                stage.restitution_at([body(touch.second)], restitution, group.time)
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
