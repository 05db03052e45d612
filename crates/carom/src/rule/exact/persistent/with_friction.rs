//! Persistent contacts of a group in which friction acts: of spheres that lie on planes or curves, each by
//! itself.

use glam::DVec3;

use super::NoClosedForm;
use super::accelerations::Accelerations;
use super::planar::{self, PlanarSupport};
use super::rolling_over;
use crate::detect::contact::Bodies;
use crate::norm::Norm;
use crate::respond::friction_of;
use crate::rule::exact::contacts::{Corner, Group, Member, Plane, Touch};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::flights::{ContactWork, Support, Supported};

/// Normals that differ by less are one \[rad\]: rounding.
const SAME_NORMAL: f64 = 1e-9;

/// A sphere closes on a surface if it accelerates towards it by more than this part of the accelerations at
/// work: rounding.
const CLOSES: f64 = 1e-9;

/// Finds how each sphere goes on whose contacts press; of the `candidates`, those of two spheres that do not
/// press let go.
///
/// # Errors
/// [`NoClosedForm`] if two spheres press on each other, or one on several surfaces or on one that moves.
pub(super) fn find(
    context: &StepContext,
    group: &mut Group,
    candidates: &[Touch],
    pressing: &[Touch],
) -> Result<Vec<Support>, NoClosedForm> {
    let mut supports = Vec::new();
    for place in 0..group.members.len() {
        if !pressing.iter().any(|touch| touch.has(place)) {
            continue;
        }
        let member = group.members[place];
        let own: Vec<Touch> = pressing.iter().filter(|it| it.has(place)).copied().collect();
        if is_one_curve(&own) {
            supports.push(over_curve(context, group, place, &own)?);
            continue;
        }
        let mut corner = Corner::default();
        for touch in candidates.iter().filter(|touch| touch.has(place)) {
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
    // Two spheres that friction presses together meet again, as in a rack, until they part.
    let is_other = |touch: &&Touch| {
        let member = &group.members[touch.second];
        touch.first.is_none() && plane_of(context, member, touch).is_none()
    };
    if candidates.iter().filter(is_other).any(|touch| closes(touch, group, &supports)) {
        return Err(NoClosedForm);
    }
    Ok(supports)
}

/// Whether friction presses a sphere to a surface that it touches, and nothing else does.
fn closes(touch: &Touch, group: &Group, supports: &[Support]) -> bool {
    if supports.iter().any(|support| support.contacts.contains(&touch.bodies)) {
        return false;
    }
    let members = &group.members;
    let mut accelerations: Vec<DVec3> =
        members.iter().map(|member| member.species.acceleration).collect();
    for supported in supports.iter().flat_map(|support| &support.members) {
        if let Some(place) = members.iter().position(|member| member.slot == supported.slot) {
            accelerations[place] = supported.acceleration;
        }
    }
    let accelerations = Accelerations { each: accelerations, largest: 0.0 };
    accelerations.along(touch, members) < -CLOSES * accelerations.scale_at(touch, members)
}

/// Whether what bears a sphere is one curve: faces that share an edge have one normal.
fn is_one_curve(own: &[Touch]) -> bool {
    own.iter().all(|touch| {
        let is_same = (touch.normal - own[0].normal).norm() <= SAME_NORMAL;
        touch.first.is_none() && touch.is_curved() && is_same
    })
}

/// How the sphere at a place goes on over a curve, of one surface or several.
fn over_curve(
    context: &StepContext,
    group: &mut Group,
    place: usize,
    own: &[Touch],
) -> Result<Support, NoClosedForm> {
    let friction = friction_of(own[0].bodies, context.system);
    let member = &mut group.members[place];
    let piece = rolling_over::roll_over(context, member, &own[0], friction, group.time)?;
    *member = piece.member;
    let moment = context.system.spheres.moment_of_inertia(member.index as usize);
    Ok(Support {
        members: vec![Supported {
            slot: member.slot,
            acceleration: piece.acceleration,
            rotation: Some([member.angular_velocity, piece.angular_acceleration]),
            contact_work: ContactWork::Friction { moment },
        }],
        contacts: own.iter().map(|touch| touch.bodies).collect(),
        renewal: group.time + piece.valid_for,
    })
}

/// Whether a contact of two spheres, or with something else than a plane at rest, bears something.
fn is_pressing(touch: &Touch, pressing: &[Touch]) -> bool {
    pressing.iter().any(|it| it.bodies == touch.bodies)
}

/// The plane at rest that a touch is with; `None` if it is with something else.
fn plane_of<'a>(context: &StepContext<'a>, member: &Member, touch: &Touch) -> Option<Plane<'a>> {
    match touch.bodies {
        Bodies::Surface { surface, .. } if touch.shift == DVec3::ZERO => {
            Plane::under(member.state(), surface, context.system.surfaces)
        }
        _ => None,
    }
}
