//! Speed that surfaces add in impacts.

use glam::DVec3;

use crate::detect::contact::Bodies;
use crate::norm::Norm;
use crate::report::BodyPair;
use crate::respond;
use crate::rule::exact::contacts::{Group, Member};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::persistent::free_acceleration;

/// Contacts of a sphere and a collider whose normals differ by less are at one place, where faces share an edge or a
/// corner: far more than the rounding of places.
const SAME_NORMAL: f64 = 1e-9;

/// Speed that a surface adds to a sphere along its normal in an impact \[m/s\].
pub(super) fn kick_of(
    context: &StepContext,
    member: &Member,
    (surface, normal): (u32, DVec3),
) -> f64 {
    let kick = context.system.surfaces[surface as usize].kick;
    if kick == 0.0 {
        return 0.0;
    }
    respond::kick(kick, -free_acceleration(member).dot(normal), member.species.radius)
}

/// The effect of kicks of surfaces on a group.
#[derive(Default)]
pub(super) struct Kicks {
    /// One per touch \[m/s\].
    pub speeds: Vec<f64>,
    /// Work \[J\].
    pub work: f64,
}

/// Adds the kick of a surface to spheres that got an impulse of it; at an edge that faces of a collider share,
/// once.
pub(super) fn kick_in_group(
    context: &StepContext,
    group: &mut Group,
    impulses: &mut [f64],
) -> Kicks {
    let mut kicks = Kicks { speeds: vec![0.0; impulses.len()], work: 0.0 };
    let mut kicked: Vec<(BodyPair, DVec3)> = Vec::new();
    for (place, touch) in group.touches.iter().enumerate() {
        let Bodies::Surface { surface, .. } = touch.bodies else { continue };
        let between = BodyPair::of(touch.bodies, context.system);
        let is_kicked = |it: &(BodyPair, DVec3)| it.0 == between && is_same(it.1, touch.normal);
        if impulses[place] <= 0.0 || kicked.iter().any(is_kicked) {
            continue;
        }
        let member = &group.members[touch.second];
        let speed = kick_of(context, member, (surface, touch.normal));
        let mass = member.species.mass;
        kicks.work += mass * speed * (touch.normal_velocity(&group.members) + 0.5 * speed);
        kicks.speeds[place] = speed;
        impulses[place] += mass * speed;
        group.members[touch.second].velocity += speed * touch.normal;
        kicked.push((between, touch.normal));
    }
    kicks
}

/// Whether two normals of contacts of a sphere and a collider are at one place.
pub(super) fn is_same(normal: DVec3, other: DVec3) -> bool {
    (normal - other).norm() <= SAME_NORMAL
}
