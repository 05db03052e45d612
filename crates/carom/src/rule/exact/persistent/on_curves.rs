//! Which persistent contacts follow the curves of their spheres, so that their forces need not be held.

use glam::DVec3;

use crate::detect::contact::Bodies;
use crate::respond::friction_of;
use crate::rule::exact::contacts::{Member, Touch};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::flights::{CurveContact, CurveContacts, MOST_CONTACTS};
use crate::surface::Form;

/// Whether all spheres in these contacts fly on curves with them: some touch each other, without friction, the
/// others planes without edges at rest, and no contact follows from others.
pub(super) fn fly_so(context: &StepContext, members: &[Member], touches: &[Touch]) -> bool {
    let are_few = touches.len() <= MOST_CONTACTS;
    let is_between_spheres = |touch: &Touch| touch.first.is_some();
    are_few
        && context.period == DVec3::INFINITY
        && touches.iter().any(is_between_spheres)
        && touches.iter().all(|touch| is_smooth(context, members, touch))
        && are_independent(members, touches)
}

/// Whether a contact has no friction, of spheres on curves with each other or with a plane without edges at rest.
fn is_smooth(context: &StepContext, members: &[Member], touch: &Touch) -> bool {
    let is_curved = |place: usize| {
        let species = &members[place].species;
        species.is_curved && species.growth_speed == 0.0
    };
    let is_simple = match touch.bodies {
        Bodies::Pair(..) => true,
        Bodies::Surface { surface, .. } => {
            let form = &context.system.surfaces[surface as usize].form;
            matches!(form, Form::HalfSpace { .. }) && !touch.does_work()
        }
    };
    is_simple && touch.places().all(is_curved) && !friction_of(touch.bodies, context.system).acts()
}

fn are_independent(members: &[Member], touches: &[Touch]) -> bool {
    let contact = |touch: &Touch| CurveContact {
        first: touch.first,
        second: touch.second,
        normal: touch.normal,
    };
    let positions: Vec<DVec3> = members.iter().map(|member| member.position).collect();
    CurveContacts::new(touches.iter().map(contact).collect())
        .are_independent(&positions, |place| members[place].species.mass)
}
