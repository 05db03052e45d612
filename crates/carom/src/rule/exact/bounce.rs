//! What a sphere does that is alone with surfaces at rest: it bounces off them, rests on planes or
//! slides along.

use glam::DVec3;

use super::alone::{Alone, MOST_TOUCHED, Touched, alone, restitution_of};
use super::carry::{self, Carried};
use super::group::{self, Member};
use super::predict::{self, Unresolved};
use super::stage::Stage;
use super::support::{REST, Support};
use super::timeline::Timeline;
use crate::detect::contact::Bodies;
use crate::norm::Norm;
use crate::report::{Impact, ImpactGroup, Participants};
use crate::respond;

/// Answers what happens to a sphere at `time` \[s\]: it meets a `surface`, or else the forces of its
/// lasting contacts have to be found anew. The answer is that of its group, but for rounding.
pub(super) fn answer(
    timeline: &mut Timeline,
    stage: &mut Stage,
    slot: u32,
    surface: Option<u32>,
    time: f64,
) {
    let Some(Alone { mut member, touched }) = alone(timeline, stage, slot, surface, time) else {
        return group::answer(timeline, stage, &[slot], surface, time);
    };
    let fastest = member.velocity.norm();
    let struck = strike(timeline, stage, &touched, &mut member, time);
    let contact_duration = stage.duration_of(&member.scale(touched.is_curved()), time);
    let corner = &touched.corner;
    let carried = carry::carry(&member, corner, contact_duration, timeline.horizon() - time);
    if let Some(carried) = &carried {
        let is_at_rest = carried.velocity.norm() <= REST * fastest;
        member.velocity = if is_at_rest { DVec3::ZERO } else { carried.velocity };
    }
    timeline.set_free(slot);
    timeline.begin_flight(slot, member.position, member.velocity, time);
    if struck.iter().any(Option::is_some) {
        timeline.bodies[slot as usize].strike();
    }
    let sphere = timeline.index_of[slot as usize];
    if let Some(Carried { acceleration, hold, lasts, .. }) = carried {
        let lasting = corner.planes().zip(lasts).filter(|it| it.1).map(|it| it.0.surface);
        let contacts = lasting.map(|surface| Bodies::Surface { sphere, surface }).collect();
        let support =
            Support { members: vec![(slot, acceleration)], contacts, renewal: time + hold };
        timeline.set_supported(support);
    }
    predict::predict(timeline, stage, slot, time);
    let is_answered = |timeline: &Timeline, surface: u32| {
        touched.is_struck(&struck, surface) || timeline.is_held_by(slot, surface)
    };
    let Some(met) = surface.filter(|&surface| !is_answered(timeline, surface)) else { return };
    // Others may be closed by rounding, too: passed over one at a time, they would take turns.
    let contacts = touched.contacts(member.position).into_iter().flatten();
    let others = contacts.map(|contact| contact.surface).filter(|&it| !is_answered(timeline, it));
    let unresolved: Vec<Unresolved> = others
        .chain([met])
        .map(|surface| Bodies::Surface { sphere, surface })
        .map(|bodies| Unresolved { bodies, until: time + contact_duration })
        .collect();
    predict::pass_over(timeline, slot, &unresolved);
}

/// Gives a sphere the impulses of the surfaces that it closes on, by Newton's law, which is what all
/// impact laws say of contacts that do not feel each other, and writes them down. Tells which surfaces
/// gave one.
fn strike(
    timeline: &Timeline,
    stage: &mut Stage,
    touched: &Touched,
    member: &mut Member,
    time: f64,
) -> [Option<u32>; MOST_TOUCHED] {
    let Member { slot, position, velocity: before, kind } = *member;
    let sphere = timeline.index_of[slot as usize];
    let rounding = respond::rounding_of(before);
    let (mut impacts, mut struck) = ([None; MOST_TOUCHED], [None; MOST_TOUCHED]);
    let mut energy_demanded = 0.0;
    for (place, contact) in touched.contacts(position).into_iter().flatten().enumerate() {
        let approach_speed = -before.dot(contact.normal);
        if approach_speed <= rounding {
            continue;
        }
        let restitution = restitution_of(timeline, stage, slot, contact.surface, time);
        let Some(change) = respond::reflection(before, contact.normal, restitution) else {
            continue;
        };
        member.velocity += change * contact.normal;
        let impulse = kind.mass * change;
        energy_demanded -= 0.5 * (1.0 - restitution) * impulse * approach_speed;
        struck[place] = Some(contact.surface);
        let bodies = Bodies::Surface { sphere, surface: contact.surface };
        impacts[place] = Some(Impact {
            time: stage.since_start(time),
            between: Participants::of(bodies, stage.system),
            point: contact.point,
            normal: contact.normal,
            approach_speed,
            separation_speed: member.velocity.dot(contact.normal),
            impulse,
        });
    }
    if struck.iter().any(Option::is_some) {
        let mut account = group::account_of([&[before], &[member.velocity]], &[kind.mass]);
        for impact in impacts.iter().flatten() {
            account.momentum_after -= impact.impulse * impact.normal;
        }
        stage.record(impacts.into_iter().flatten(), ImpactGroup { energy_demanded, ..account });
    }
    struck
}
