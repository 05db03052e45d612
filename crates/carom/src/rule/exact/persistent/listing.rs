//! The list of the contacts that persist, with their forces.

use super::accelerations::forces;
use super::piece_end::settle;
use crate::detect::contact::Bodies;
use crate::persistent_contact::PersistentContact;
use crate::report::BodyPair;
use crate::rule::exact::contacts;
use crate::rule::exact::context::StepContext;
use crate::rule::exact::periodic;
use crate::rule::exact::timeline::Timeline;

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
        let forces = forces(context.work, &group.members, &group.touches);
        found.extend(group.touches.iter().zip(forces).map(|(touch, normal_force)| {
            let contact = PersistentContact {
                between: BodyPair::of(touch.bodies, context.system),
                point: periodic::wrapped(touch.point, context.period),
                normal: touch.normal,
                gap: touch.gap,
                normal_force,
                ..PersistentContact::NONE
            };
            (touch.bodies, contact)
        }));
    }
    found.sort_by_key(|(bodies, _)| *bodies);
    found.into_iter().map(|(_, contact)| contact).collect()
}
