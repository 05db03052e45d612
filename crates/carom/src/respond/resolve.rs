//! The answer to the impacts of one instant in a group of touching bodies.

use glam::DVec3;

use super::group::{Answer, Group, speed_scale, tolerance};
use super::project::{Projection, Projector};
use super::touching::{GroupResponse, TouchingContact};
use super::{generalized_reflection, order_free, sequential, simultaneous};
use crate::settings::ImpactLaw;
use crate::work::Work;

/// Answers the impacts of one instant in a group of touching bodies: sets the velocities of the
/// spheres after it, and returns the impulses.
///
/// No contact closes afterwards beyond [`GroupResponse::resolution`], momentum is kept to
/// round-off, and energy falls by what the law demands. The laws and their formulas are in
/// `docs/physics/impacts.md`, "Impacts at one instant". A single contact gets the bits that
/// [`line_of_centres`](super::line_of_centres()) or [`reflection`](super::reflection()) give it.
///
/// With `Simultaneous` and `Reflection`, renumbering contacts or spheres, or mirroring everything
/// in a coordinate plane, does the same to the velocities: to the last bit as long as masses in
/// the group differ by less than about 10⁶, else to rounding.
///
/// - `contacts`: between spheres of the group, which are numbered from 0
/// - `masses` \[kg\], > 0, `velocities` \[m/s\]: one per sphere. If any velocity is not finite,
///   all are left as they are
///
/// # Panics
/// If a contact names a sphere that has no mass or velocity.
pub fn resolve(
    law: ImpactLaw,
    contacts: &[TouchingContact],
    masses: &[f64],
    velocities: &mut [DVec3],
) -> GroupResponse {
    resolve_within(&Work::unlimited(), law, contacts, masses, velocities)
}

/// [`resolve`] as part of the work of a step. If that has to end, the answer is any.
pub(crate) fn resolve_within(
    work: &Work,
    law: ImpactLaw,
    contacts: &[TouchingContact],
    masses: &[f64],
    velocities: &mut [DVec3],
) -> GroupResponse {
    let surfaces = contacts.iter().filter(|contact| contact.first.is_none());
    let speeds = velocities.iter().copied().chain(surfaces.map(|it| it.surface_velocity));
    let Some(unit) = unit_of(speeds) else {
        return GroupResponse { impulses: vec![0.0; contacts.len()], ..GroupResponse::default() };
    };
    let group = Group::new(contacts, masses, unit, work);
    let start: Vec<DVec3> = velocities.iter().map(|velocity| *velocity / unit).collect();
    let mut projector = Projector::default();
    let Answer { motion, energy, complete } = answer(law, &group, &start, &mut projector);

    for (velocity, scaled) in velocities.iter_mut().zip(&motion.velocities) {
        *velocity = unit * *scaled;
    }
    let impulses: Vec<f64> = motion.impulses.iter().map(|impulse| unit * impulse).collect();
    let surface_work = |(contact, impulse): (&TouchingContact, &f64)| match contact.first {
        Some(_) => 0.0,
        None => impulse * contact.normal.dot(contact.surface_velocity),
    };
    let speed = speed_scale(motion.velocities.iter().chain(&start).copied());
    GroupResponse {
        restitution_energy: energy * unit * unit,
        surface_work: order_free::sum(contacts.iter().zip(&impulses).map(surface_work)),
        resolution: unit * tolerance(speed).coarse.max(projector.resolution()),
        cut_short: !complete,
        impulses,
    }
}

/// Returns the projections of which the law `Reflection` makes its answer; `None` if it has none of its own.
pub(crate) fn projections(
    contacts: &[TouchingContact],
    masses: &[f64],
    velocities: &[DVec3],
) -> Option<Vec<Projection>> {
    let surfaces = contacts.iter().filter(|contact| contact.first.is_none());
    let speeds = velocities.iter().copied().chain(surfaces.map(|it| it.surface_velocity));
    let unit = unit_of(speeds)?;
    let work = Work::unlimited();
    let group = Group::new(contacts, masses, unit, &work);
    let start: Vec<DVec3> = velocities.iter().map(|velocity| *velocity / unit).collect();
    let mut projector = Projector::recording();
    let answer = answer(ImpactLaw::Reflection, &group, &start, &mut projector);
    (answer.complete && contacts.len() > 1).then(|| projector.into_projections())
}

fn answer(law: ImpactLaw, group: &Group, start: &[DVec3], projector: &mut Projector) -> Answer {
    if !group.closes(start) {
        return Answer::unchanged(group, start);
    }
    let answer = match law {
        // For one contact, all laws are one.
        _ if group.links.len() == 1 => sequential::resolve(group, start, projector),
        ImpactLaw::Sequential => sequential::resolve(group, start, projector),
        ImpactLaw::Simultaneous => {
            simultaneous::resolve(group, &group.restitutions, start, projector)
        }
        ImpactLaw::Reflection => generalized_reflection::resolve(group, start, projector),
    };
    if !answer.complete && group.closes(&answer.motion.velocities) {
        // Too many contacts at too unlike masses to solve for at once.
        return Answer { complete: false, ..sequential::resolve(group, start, projector) };
    }
    answer
}

/// The power of two near the largest component; none if all are zero or one is not finite.
pub(super) fn unit_of(vectors: impl Iterator<Item = DVec3> + Clone) -> Option<f64> {
    let finite = vectors.clone().all(DVec3::is_finite);
    let largest = vectors.map(|vector| vector.abs().max_element()).fold(0.0, f64::max);
    (finite && largest > 0.0).then(|| order_free::power_of_two(order_free::exponent_of(largest)))
}
