//! Persistent contacts of a group in which friction acts: of spheres that lie on planes, each by itself.

use glam::DVec3;

use super::NoClosedForm;
use super::planar::{self, PlanarSupport};
use crate::detect::contact::Bodies;
use crate::rule::exact::contacts::{Corner, Group, Member, Plane, Touch};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::flights::Support;

/// Finds how each sphere goes on whose contacts press; of the `candidates`, those of two spheres that do not
/// press let go.
///
/// # Errors
/// [`NoClosedForm`] if two spheres press on each other, or one on anything but planes at rest.
pub(super) fn find(
    context: &StepContext,
    group: &mut Group,
    candidates: &[Touch],
    pressing: &[Touch],
) -> Result<Vec<Support>, NoClosedForm> {
    let mut supports = Vec::new();
    for place in 0..group.members.len() {
        if !pressing.iter().any(|touch| touch.places().any(|it| it == place)) {
            continue;
        }
        let member = group.members[place];
        let mut corner = Corner::default();
        for touch in candidates.iter().filter(|touch| touch.places().any(|it| it == place)) {
            match plane_of(context, &member, touch) {
                Some(plane) => corner.add(plane).ok_or(NoClosedForm)?,
                None if is_pressing(touch, pressing) => return Err(NoClosedForm),
                None => {}
            }
        }
        let contact_duration = context.duration_of(&member.scale(false), group.time);
        let supported =
            planar::support(context.system, &member, &corner, contact_duration, f64::INFINITY)?;
        let Some(planar) = supported else { continue };
        let PlanarSupport { velocity, angular_velocity, valid_for, persists, .. } = planar;
        let lasting = corner.planes().zip(persists).filter(|it| it.1).map(|it| it.0.surface);
        let bodies = |surface: u32| Bodies::Surface { sphere: member.index, surface };
        supports.push(Support {
            members: vec![planar.supported(member.slot)],
            contacts: lasting.map(bodies).collect(),
            renewal: group.time + valid_for,
        });
        let member = &mut group.members[place];
        (member.velocity, member.angular_velocity) = (velocity, angular_velocity);
    }
    Ok(supports)
}

/// Whether a contact of two spheres, or with something else than a plane at rest, bears something.
fn is_pressing(touch: &Touch, pressing: &[Touch]) -> bool {
    pressing.iter().any(|it| it.bodies == touch.bodies)
}

/// The plane at rest that a touch is with; `None` if it is with something else.
fn plane_of<'a>(context: &StepContext<'a>, member: &Member, touch: &Touch) -> Option<Plane<'a>> {
    match touch.bodies {
        Bodies::Surface { surface, .. } if touch.shift == DVec3::ZERO => {
            Plane::under(member.position, surface, context.system.surfaces)
        }
        _ => None,
    }
}
