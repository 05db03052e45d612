//! The touches of spheres on rings: with the side that a sphere moves to, and the one opposite.

use glam::DVec3;

use super::group::Group;
use super::member::Member;
use super::touch::Touch;
use crate::detect::contact::Bodies;
use crate::norm::Norm;
use crate::rule::exact::context::StepContext;
use crate::rule::exact::features::side_of_ring;
use crate::rule::exact::flights::RingSide;
use crate::rule::exact::persistent::free_acceleration;
use crate::surface::Form;

/// A side counts as known if the sine of the angle to it is smaller, and as closed on beyond this part of what the
/// sphere does: rounding.
const ROUNDING: f64 = 1e-9;

/// The touches in place of one: where the sphere is on a ring, those with the side to which it moves and the one
/// opposite; from rest those with the `known` sides, or those to which it is pulled; else itself.
pub(super) fn with_sides(
    context: &StepContext,
    members: &[Member],
    touch: Touch,
    known: Vec<DVec3>,
    time: f64,
) -> Vec<Touch> {
    let sides = |motion, least| {
        let side = side_towards(context, members, &touch, (motion, least), time)?;
        Some(vec![side, -side])
    };
    let member = &members[touch.second];
    let pull = free_acceleration(member) - touch.drive;
    let known =
        || Some(known).filter(|it| !it.is_empty() && is_on_ring(context, members, &touch, time));
    let moving = sides(touch.relative_velocity(members), slow(member));
    let sides = moving.or_else(known).or_else(|| sides(pull, ROUNDING * pull.norm()));
    let Some(sides) = sides else { return vec![touch] };
    let on = |side: DVec3| on_side(context, members, touch, (side, time));
    sides.into_iter().filter_map(on).collect()
}

/// The sides of rings on which spheres close that the touches of a group leave out: those of spheres that move to them,
/// or from rest, under these accelerations, one per member \[m/s²\].
pub(crate) fn closing_sides(
    context: &StepContext,
    group: &Group,
    accelerations: Option<&[DVec3]>,
) -> Vec<RingSide> {
    let Group { members, touches, time, fastest } = group;
    let free = members.iter().map(|member| free_acceleration(member).norm());
    let with_contacts = accelerations.into_iter().flatten().map(|it| it.norm());
    let largest = free.chain(with_contacts).fold(0.0, f64::max);
    let mut found: Vec<RingSide> = Vec::new();
    for touch in touches {
        let towards = |motion, least| {
            let side = side_towards(context, members, touch, (motion, least), *time)?;
            Some((side, motion, least))
        };
        let least_speed = slow(&members[touch.second]).max(ROUNDING * fastest);
        let acceleration =
            |of: &[DVec3]| towards(of[touch.second] - touch.drive, ROUNDING * largest);
        let moving = towards(touch.relative_velocity(members), least_speed)
            .or_else(|| accelerations.and_then(acceleration));
        let Some((side, motion, least)) = moving else { continue };
        let is_it = |bodies, known: DVec3| bodies == touch.bodies && is_same(known, side);
        let is_known =
            touches.iter().any(|it| it.side.is_some_and(|known| is_it(it.bodies, known)))
                || found.iter().any(|it| is_it(it.bodies, it.side));
        let of_side = || on_side(context, members, *touch, (side, *time));
        if !is_known && of_side().is_some_and(|it| motion.dot(it.normal) < -least) {
            found.push(RingSide { bodies: touch.bodies, side });
        }
    }
    found
}

/// Adds touches with sides of rings to a group. Where a touch was with a ring as a whole, two opposite sides replace it.
pub(crate) fn add_sides(context: &StepContext, group: &mut Group, closing: &[RingSide]) {
    let Group { members, touches, time, .. } = group;
    for &RingSide { bodies, side } in closing {
        let Some(place) = touches.iter().position(|touch| touch.bodies == bodies) else { continue };
        let touch = touches[place];
        let new: Vec<Touch> = match touch.side {
            Some(_) => on_side(context, members, touch, (side, *time)).into_iter().collect(),
            None => {
                touches.remove(place);
                both_sides(context, members, touch, (side, *time)).into_iter().flatten().collect()
            }
        };
        touches.splice(place..place, new);
    }
}

fn is_same(side: DVec3, other: DVec3) -> bool {
    (side - other).norm() <= ROUNDING
}

/// Unit vector to the side of a ring to which a sphere comes that moves in a direction, relative to the surface; `None`
/// where the part of that across the axis is at most the least that counts.
fn side_towards(
    context: &StepContext,
    members: &[Member],
    touch: &Touch,
    (direction, least): (DVec3, f64),
    time: f64,
) -> Option<DVec3> {
    let Bodies::Surface { surface, .. } = touch.bodies else { return None };
    let (form, _) = context.surface_at(surface, time);
    let side = side_of_ring(&form, [members[touch.second].position + touch.shift, direction])?;
    (direction.dot(side) > least).then_some(side)
}

/// A speed \[m/s\] that counts as none: a small part of what the sphere gains where it falls by its radius.
fn slow(member: &Member) -> f64 {
    ROUNDING * (free_acceleration(member).norm() * member.species.radius).sqrt()
}

/// Whether the sphere of a touch is on a ring of the surface.
fn is_on_ring(context: &StepContext, members: &[Member], touch: &Touch, time: f64) -> bool {
    let Bodies::Surface { surface, .. } = touch.bodies else { return false };
    let (form, _) = context.surface_at(surface, time);
    let center = members[touch.second].position + touch.shift;
    matches!(form, Form::Band(band) if band.has_ring_about(center))
}

/// The touches with a side of a ring and with the side opposite, in place of one.
fn both_sides(
    context: &StepContext,
    members: &[Member],
    touch: Touch,
    (side, time): (DVec3, f64),
) -> [Option<Touch>; 2] {
    [side, -side].map(|side| on_side(context, members, touch, (side, time)))
}

/// The touch with a side of a ring, in place of one with the ring. It persists where the sphere slides along the side.
fn on_side(
    context: &StepContext,
    members: &[Member],
    touch: Touch,
    (side, time): (DVec3, f64),
) -> Option<Touch> {
    let touch = Touch { side: Some(side), ..touch }.measured_at(context, members, time)?;
    let has_persisted = touch.has_persisted && touch.is_unfelt(members);
    Some(Touch { has_persisted, ..touch })
}
