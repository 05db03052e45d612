//! The list of persistent contacts, with their forces.

use glam::DVec3;

use super::accelerations::forces;
use super::on_curves;
use super::piece_end::settle;
use super::with_friction::forces_of_pushed;
use crate::detect::contact::Bodies;
use crate::norm::Norm;
use crate::persistent_contact::PersistentContact;
use crate::report::BodyPair;
use crate::respond;
use crate::rule::exact::contacts::{self, Group, Member, Touch};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::timeline::Timeline;
use crate::rule::periodic;

/// A contact slides where friction is at least this part of the largest possible.
const SLIDES: f64 = 1.0 - 1e-9;

/// All contacts that persist at `time` \[s\], in the order of their bodies: pairs of spheres first.
/// Forces are those of this instant.
pub(crate) fn list(
    timeline: &Timeline,
    context: &StepContext,
    time: f64,
) -> Vec<PersistentContact> {
    let mut found: Vec<(Bodies, PersistentContact)> = Vec::new();
    for cluster in timeline.flights.clusters.iter() {
        let mut group = contacts::gather_cluster(timeline, context, cluster, time);
        settle(timeline, context, &mut group);
        let on_curves =
            if cluster.is_curved { on_curves::forces_now(context, &group) } else { None };
        let forces = on_curves.unwrap_or_else(|| forces_in(timeline, context, &group)).into_iter();
        found.extend(group.touches.iter().zip(forces).map(
            |(touch, (normal_force, tangential_force))| {
                let sliding = respond::friction_of(touch.bodies, context.system).sliding;
                let contact = PersistentContact {
                    between: BodyPair::of(touch.bodies, context.system),
                    point: periodic::wrapped(touch.point, context.period),
                    normal: touch.normal,
                    gap: touch.gap,
                    normal_force,
                    tangential_force,
                    is_sliding: tangential_force.norm() >= SLIDES * sliding * normal_force,
                };
                (touch.bodies, contact)
            },
        ));
    }
    found.sort_by_key(|(bodies, _)| *bodies);
    found.into_iter().map(|(_, contact)| contact).collect()
}

/// Normal force and friction \[N\] on body 2 of each touch of a cluster.
fn forces_in(timeline: &Timeline, context: &StepContext, group: &Group) -> Vec<(f64, DVec3)> {
    let pushed = timeline.has_friction().then(|| forces_of_pushed(context, group)).flatten();
    pushed.unwrap_or_else(|| {
        let forces = forces(context.work, &group.members, &group.touches);
        let with_friction = |(touch, force)| (force, friction_on(timeline, group, touch));
        group.touches.iter().zip(forces).map(with_friction).collect()
    })
}

/// The force of friction on body 2 of a touch \[N\]: what accelerates a sphere on a plane, along it, besides
/// the forces on all.
fn friction_on(timeline: &Timeline, group: &Group, touch: &Touch) -> DVec3 {
    if !timeline.has_friction() || group.members.len() > 1 {
        return DVec3::ZERO;
    }
    let Member { slot, species, .. } = group.members[touch.second];
    let change = timeline.flights.species_of(slot).acceleration - species.acceleration;
    let forces = group.touches.iter().filter(|it| it.bodies != touch.bodies);
    // Another plane takes the part along its own normal.
    let along = |rest: DVec3, other: &Touch| rest - rest.dot(other.normal) * other.normal;
    species.mass * touch.across(forces.fold(change, along))
}
