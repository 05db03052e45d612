//! Events of a sphere that touches only surfaces at rest: it bounces off them, rests on planes or slides along
//! them.

use glam::DVec3;

use super::account::account_of;
use super::friction::{self, FrictionImpulses};
use super::group;
use super::kick::kick_of;
use super::surface_contacts::{
    MOST_TOUCHED, SingleSphere, SurfaceContacts, restitution_of, single_sphere,
};
use crate::detect::contact::Bodies;
use crate::norm::Norm;
use crate::report::{BodyPair, Impact, ImpactGroup};
use crate::respond;
use crate::rule::exact::answer::changed::{Changed, Unresolved};
use crate::rule::exact::contacts::Member;
use crate::rule::exact::context::StepContext;
use crate::rule::exact::flights::{ContactWork, Support, Supported};
use crate::rule::exact::persistent::planar::{self, PlanarSupport};
use crate::rule::exact::persistent::{REST, flies_with};
use crate::rule::exact::timeline::Timeline;

/// Answers an event of a sphere at `time` \[s\]: an impact with `surface`, or, without one, new forces of its
/// persistent contacts. The answer equals that of the sphere as a group, up to rounding. Returns the spheres to be
/// predicted.
pub(crate) fn answer_single(
    timeline: &mut Timeline,
    context: &mut StepContext,
    slot: u32,
    surface: Option<u32>,
    time: f64,
) -> Changed {
    let Some(SingleSphere { mut member, touched }) =
        single_sphere(timeline, context, slot, surface, time)
    else {
        return group::answer(timeline, context, &[slot], surface, time);
    };
    // Friction couples the contacts, and drag and forces that are not linear leave no closed form.
    let is_one = || touched.contacts(member.position).iter().flatten().count() == 1;
    let has_form = || member.species.drag_rate == 0.0 && !member.species.is_curved;
    if timeline.has_friction() && !(is_one() && has_form()) {
        return group::answer(timeline, context, &[slot], surface, time);
    }
    let fastest = member.velocity.norm();
    let struck = strike(timeline, context, &touched, &mut member, time);
    member.renew_forces(&timeline.flights, context.system, time);
    let contact_duration = context.duration_of(&member.scale(touched.is_curved()), time);
    let corner = &touched.corner;
    let duration = timeline.horizon() - time;
    let planar = planar::support(context.system, &member, corner, contact_duration, duration);
    let planar = planar.ok().flatten();
    let closing = member;
    if let Some(planar) = &planar {
        let is_at_rest = planar.velocity.norm() <= REST * fastest;
        member.velocity = if is_at_rest { DVec3::ZERO } else { planar.velocity };
        let angular_velocity = planar.angular_velocity;
        let moment = context.system.spheres.moment_of_inertia(member.index as usize);
        let settled = Member { angular_velocity, ..member };
        // A closing too small for an impact ends without one.
        timeline.flights.add_contact_work(settled.gained_since(&closing, moment));
    }
    timeline.begin_free_flight(&member, time);
    timeline.flights.rotate(slot, [member.angular_velocity, DVec3::ZERO], time);
    if struck.iter().any(Option::is_some) {
        timeline.flights.bodies[slot as usize].strike();
    }
    let sphere = member.index;
    if let Some(planar) = planar {
        let surfaces = corner.planes().zip(planar.persists).filter(|it| it.1);
        let surfaces = surfaces.map(|it| Bodies::Surface { sphere, surface: it.0.surface });
        let support = support_by(context, &member, planar, surfaces.collect(), time);
        timeline.set_supported(support, time);
    }
    let is_answered = |timeline: &Timeline, surface: u32| {
        touched.is_struck(&struck, surface) || timeline.flights.is_held_by(slot, surface)
    };
    let Some(met) = surface.filter(|&surface| !is_answered(timeline, surface)) else {
        return Changed::sphere(slot);
    };
    // Other contacts may close by rounding, too: passed over one at a time, they would alternate without end.
    let contacts = touched.contacts(member.position).into_iter().flatten();
    let others = contacts.map(|contact| contact.surface).filter(|&it| !is_answered(timeline, it));
    let unresolved = others
        .chain([met])
        .map(|surface| Bodies::Surface { sphere, surface })
        .map(|bodies| Unresolved { bodies, until: time + contact_duration })
        .collect();
    Changed::Sphere { slot, unresolved }
}

/// Returns the support of a sphere by planes from `time` \[s\] on: along a curve where it flies on one.
fn support_by(
    context: &StepContext,
    member: &Member,
    planar: PlanarSupport,
    contacts: Vec<Bodies>,
    time: f64,
) -> Support {
    let PlanarSupport { valid_for, belt_work, .. } = planar;
    let supported = planar.supported(member.slot);
    let flies = |&bodies: &Bodies| flies_with(context, &member.species, bodies);
    let is_curved = member.species.is_curved && contacts.iter().all(flies);
    let (member, renewal) = match is_curved {
        true => {
            let (rotation, contact_work) = (None, ContactWork::None);
            (Supported { rotation, contact_work, ..supported }, f64::INFINITY)
        }
        false => (supported, time + valid_for),
    };
    let (members, sides) = (vec![member], Vec::new());
    Support { members, contacts, sides, renewal, is_curved, belt_work }
}

/// Applies the impulses of the surfaces on which the sphere closes, by Newton's law, and records them. All impact
/// laws equal it for independent contacts. Returns the surfaces with an impulse.
fn strike(
    timeline: &Timeline,
    context: &mut StepContext,
    touched: &SurfaceContacts,
    member: &mut Member,
    time: f64,
) -> [Option<u32>; MOST_TOUCHED] {
    let Member { slot, index, position, velocity: before, species, .. } = *member;
    let rounding = respond::rounding_of(before);
    let (mut impacts, mut struck) = ([None; MOST_TOUCHED], [None; MOST_TOUCHED]);
    let (mut energy_demanded, mut kick_work, mut collider_work) = (0.0, 0.0, 0.0);
    let mut friction = FrictionImpulses::default();
    for (place, contact) in touched.contacts(position).into_iter().flatten().enumerate() {
        let approach_speed = -before.dot(contact.normal);
        if approach_speed <= rounding {
            continue;
        }
        let touched = (slot, contact.surface);
        let closing = (contact.normal, before);
        let restitution = restitution_of(timeline, context, touched, closing, time).value;
        let Some(change) = respond::reflection(before, contact.normal, restitution) else {
            continue;
        };
        let kick = kick_of(context, member, (contact.surface, contact.normal));
        let change = change + kick;
        member.velocity += change * contact.normal;
        let impulse = species.mass * change;
        kick_work += species.mass * kick * (restitution * approach_speed + 0.5 * kick);
        let struck_back = species.mass * (change - kick);
        energy_demanded -= 0.5 * (1.0 - restitution) * struck_back * approach_speed;
        let bodies = Bodies::Surface { sphere: index, surface: contact.surface };
        if timeline.has_friction() {
            let motion = &context.system.surfaces[contact.surface as usize].motion;
            let belt = respond::belt_of(bodies, motion, contact.normal, context.system);
            let along = (contact.normal, impulse);
            friction = friction::at_surface(context, member, (bodies, belt), along);
            collider_work += friction.total().dot(belt);
        }
        struck[place] = Some(contact.surface);
        impacts[place] = Some(Impact {
            time: context.since_start(time),
            between: BodyPair::of(bodies, context.system),
            point: contact.point,
            normal: contact.normal,
            approach_speed,
            separation_speed: member.velocity.dot(contact.normal),
            impulse,
            tangential_impulse: friction.total(),
            kick,
        });
    }
    if struck.iter().any(Option::is_some) {
        let mut account = account_of([&[before], &[member.velocity]], &[species.mass]);
        for impact in impacts.iter().flatten() {
            account.momentum_after -= impact.impulse * impact.normal;
        }
        account.momentum_after -= friction.total();
        account.energy_after -= kick_work + collider_work;
        let account = ImpactGroup { energy_demanded, kick_work, collider_work, ..account };
        let account = friction.add_to(account);
        context.record(impacts.into_iter().flatten(), account);
    }
    struck
}
