//! Which persistent contacts follow the curves of their spheres, so that their forces need not be held.

use glam::DVec3;

use crate::detect::contact::Bodies;
use crate::respond::friction_of;
use crate::rule::exact::contacts::{Member, Touch};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::features::Feature;
use crate::rule::exact::flights::{CurveBody, CurveContact, CurveContacts, MOST_CONTACTS};

/// Whether all spheres in these contacts fly on curves with them: they touch each other and surfaces at rest, without
/// friction, and no contact follows from others.
pub(super) fn fly_so(context: &StepContext, members: &[Member], touches: &[Touch]) -> bool {
    if touches.len() > MOST_CONTACTS || context.period != DVec3::INFINITY {
        return false;
    }
    let contacts = touches.iter().map(|touch| smooth_contact(context, members, touch)).collect();
    let contacts: Option<Vec<CurveContact>> = contacts;
    let positions: Vec<DVec3> = members.iter().map(|member| member.position).collect();
    contacts.is_some_and(|contacts| {
        CurveContacts::new(contacts)
            .are_independent(&positions, |place| members[place].species.mass)
    })
}

/// A contact without friction, of spheres on curves with each other or with a surface at rest.
fn smooth_contact(
    context: &StepContext,
    members: &[Member],
    touch: &Touch,
) -> Option<CurveContact> {
    let is_curved = |place: usize| {
        let species = &members[place].species;
        species.is_curved && species.growth_speed == 0.0
    };
    if !touch.places().all(is_curved) || friction_of(touch.bodies, context.system).acts() {
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
