//! Which persistent contacts follow the curves of their spheres, so that their forces need not be held.

use glam::DVec3;

use crate::detect::contact::Bodies;
use crate::norm::Norm;
use crate::respond::friction_of;
use crate::rule::exact::contacts::{Member, Touch};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::features::Feature;
use crate::rule::exact::flights::{CurveBody, CurveContact, CurveContacts, MOST_CONTACTS, Species};

/// Angle \[rad\] below which two normals count as one: they differ by rounding.
pub(super) const SAME_NORMAL: f64 = 1e-9;

/// Whether all spheres in these contacts fly on curves with them: they touch each other and surfaces at rest, without
/// friction, and no contact follows from others.
pub(super) fn fly_so(context: &StepContext, members: &[Member], touches: &[Touch]) -> bool {
    if touches.len() > MOST_CONTACTS || context.period != DVec3::INFINITY {
        return false;
    }
    let contacts = touches.iter().map(|touch| smooth_contact(context, members, touch)).collect();
    let Some(contacts): Option<Vec<CurveContact>> = contacts else { return false };
    // Of faces with a common edge one bears the sphere.
    let numbers = (0..touches.len()).filter(|&number| !is_repeated(&touches[..=number]));
    let apart = numbers.map(|number| contacts[number]).collect();
    let positions: Vec<DVec3> = members.iter().map(|member| member.position).collect();
    CurveContacts::new(apart).are_independent(&positions, |place| members[place].species.mass)
}

/// Whether a sphere of this species flies on curves with a contact: none has friction or a sphere that grows.
pub(in crate::rule::exact) fn flies_with(
    context: &StepContext,
    species: &Species,
    bodies: Bodies,
) -> bool {
    let is_smooth = !friction_of(bodies, context.system).acts();
    species.is_curved && species.growth_speed == 0.0 && is_smooth
}

/// Whether the last of several touches is with a surface that touches its sphere where another one does.
fn is_repeated(touches: &[Touch]) -> bool {
    let Some((last, others)) = touches.split_last() else { return false };
    others.iter().any(|other| {
        let are_of_surfaces = last.first.is_none() && other.first.is_none();
        let is_same = (last.normal - other.normal).norm() <= SAME_NORMAL;
        are_of_surfaces && other.second == last.second && is_same
    })
}

/// A contact without friction, of spheres on curves with each other or with a surface at rest.
fn smooth_contact(
    context: &StepContext,
    members: &[Member],
    touch: &Touch,
) -> Option<CurveContact> {
    if !touch.places().all(|place| flies_with(context, &members[place].species, touch.bodies)) {
        return None;
    }
    let second = touch.second;
    let first = match touch.bodies {
        Bodies::Pair(..) => CurveBody::Sphere(touch.first?),
        Bodies::Surface { .. } if touch.does_work() => return None,
        Bodies::Surface { surface, .. } => {
            let form = &context.system.surfaces[surface as usize].form;
            let Member { position, velocity, species, .. } = members[second];
            CurveBody::Feature(Feature::under(form, [position, velocity], species.radius)?)
        }
    };
    Some(CurveContact { first, second })
}
