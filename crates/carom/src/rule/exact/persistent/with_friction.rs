//! Persistent contacts of a group with friction: of spheres that lie on planes and push each other, or that lie on
//! curves, each by itself.

use glam::DVec3;

use super::NoClosedForm;
use super::accelerations::{Accelerations, IDLE};
use super::on_curves::SAME_NORMAL;
use super::planar::{self, PlanarSupport};
use super::pushed_piece::{PushedPiece, Rates};
use super::pushed_spheres::PushedSpheres;
use super::rolling_over;
use crate::detect::contact::Bodies;
use crate::norm::Norm;
use crate::respond::friction_of;
use crate::rule::exact::contacts::{Corner, Group, Member, Plane, Touch};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::flights::{ContactWork, Support, Supported};

/// A flying sphere leans on others, and does not rest on them, where the normals are across the acceleration up to
/// this part of it.
const LEANS: f64 = 0.1;

/// A sphere closes on a surface if it accelerates towards it by more than this part of the accelerations at
/// work: rounding.
const CLOSES: f64 = 1e-9;

/// Computes the motion of each sphere whose contacts press. Pairs of spheres among the `candidates` that do not
/// press part.
///
/// # Errors
/// [`NoClosedForm`] if two spheres press on each other that do not lie on one plane each, or one presses on
/// several surfaces or on one that moves.
pub(super) fn find(
    context: &StepContext,
    group: &mut Group,
    candidates: &[Touch],
    pressing: &[Touch],
) -> Result<Vec<Support>, NoClosedForm> {
    let bearings = bearings(context, group, pressing);
    let mut supports = Vec::new();
    for pushed in sets_that_push(context, group, &bearings, candidates)? {
        supports.push(support_pushed(group, pushed)?);
    }
    let is_pushed: Vec<bool> = {
        let slots = || supports.iter().flat_map(|it| &it.members).map(|member| member.slot);
        group.members.iter().map(|member| slots().any(|slot| slot == member.slot)).collect()
    };
    for (place, &is_pushed) in is_pushed.iter().enumerate() {
        let own: Vec<Touch> = pressing.iter().filter(|it| it.has(place)).copied().collect();
        if own.is_empty() || is_pushed {
            continue;
        }
        if is_one_curve(&own) {
            supports.push(over_curve(context, group, place, &own)?);
            continue;
        }
        // Friction separates two touching spheres that do not press.
        let bears = |touch: &Touch| {
            is_pressing(touch, pressing) && touch.places().any(|place| bearings[place].is_none())
        };
        let corner = corner_of(context, group, place, candidates, bears)?;
        supports.extend(on_planes(context, group, place, &corner)?);
    }
    let is_other = |touch: &&Touch| {
        let member = &group.members[touch.second];
        let is_plane = || plane_of(context, member, touch).is_some();
        touch.first.is_none() && (is_pushed[touch.second] || !is_plane())
    };
    if candidates.iter().filter(is_other).any(|touch| closes(touch, group, &supports)) {
        return Err(NoClosedForm);
    }
    Ok(supports)
}

/// Returns the planes that a sphere touches.
///
/// # Errors
/// [`NoClosedForm`] if they make no corner, or the sphere rests on something else.
fn corner_of<'a>(
    context: &StepContext<'a>,
    group: &Group,
    place: usize,
    candidates: &[Touch],
    bears: impl Fn(&Touch) -> bool,
) -> Result<Corner<'a>, NoClosedForm> {
    let mut corner = Corner::default();
    for touch in candidates.iter().filter(|touch| touch.has(place)) {
        match plane_of(context, &group.members[place], touch) {
            Some(plane) => corner.add(plane).ok_or(NoClosedForm)?,
            None if bears(touch) => return Err(NoClosedForm),
            None => {}
        }
    }
    Ok(corner)
}

/// Normal force and friction \[N\] on body 2 of each touch of spheres that push each other or other planes, as
/// they move now; `None` if these are no such spheres.
pub(super) fn forces_of_pushed(context: &StepContext, group: &Group) -> Option<Vec<(f64, DVec3)>> {
    let bears = |touch: &&Touch| {
        let acceleration = group.members[touch.second].species.acceleration;
        touch.first.is_none() && -acceleration.dot(touch.normal) > IDLE * acceleration.norm()
    };
    let bearing: Vec<Touch> = group.touches.iter().filter(bears).copied().collect();
    let planes: Option<Vec<_>> = bearings(context, group, &bearing).into_iter().collect();
    let pushing: Vec<Touch> = group.touches.iter().filter(|it| !bears(it)).copied().collect();
    let planes = planes.filter(|_| !pushing.is_empty())?;
    let found = PushedSpheres::of_touches(context, group, &planes, &pushing).forces_now()?;
    let force_of = |touch: &Touch| Some(found.iter().find(|it| it.0 == touch.bodies)?.1);
    group.touches.iter().map(force_of).collect()
}

/// The touch of each sphere, by place, with the plane at rest on which it lies; none if it flies and at most leans
/// on others. `None` where a sphere rests on something else or drag slows it.
fn bearings(
    context: &StepContext,
    group: &Group,
    pressing: &[Touch],
) -> Vec<Option<Option<Touch>>> {
    let bearing = |place: usize| {
        let member = &group.members[place];
        let own: Vec<&Touch> = pressing.iter().filter(|touch| touch.has(place)).collect();
        let surfaces = || own.iter().filter(|touch| touch.first.is_none());
        let plane = surfaces().next().filter(|touch| plane_of(context, member, touch).is_some());
        let is_one = surfaces().count() == 1 && plane.is_some();
        let only_leans = || own.iter().all(|touch| leans(member, touch));
        let has_form = member.species.drag_rate == 0.0 && (is_one || only_leans());
        has_form.then(|| plane.map(|touch| **touch))
    };
    (0..group.members.len()).map(bearing).collect()
}

/// Whether a touch is with another sphere, across the acceleration of this one.
fn leans(member: &Member, touch: &Touch) -> bool {
    let acceleration = member.species.acceleration;
    let along = touch.normal.dot(acceleration).abs();
    touch.first.is_some() && along <= LEANS * acceleration.norm()
}

/// Whether some sphere rests on another one by a touch that presses.
pub(super) fn are_some_borne(members: &[Member], pressing: &[Touch]) -> bool {
    let bears = |touch: &Touch| touch.first.is_some() && !leans(&members[touch.second], touch);
    pressing.iter().any(bears)
}

/// The sets of spheres, on planes or in flight, that push each other or other planes, with the contacts in which
/// they do.
///
/// # Errors
/// [`NoClosedForm`] if no forces are found.
fn sets_that_push<'a>(
    context: &'a StepContext<'a>,
    group: &Group,
    bearings: &[Option<Option<Touch>>],
    candidates: &[Touch],
) -> Result<Vec<PushedSpheres<'a>>, NoClosedForm> {
    let may_push = |touch: &&Touch| {
        let bearing = bearings[touch.second];
        match touch.first {
            Some(first) => bearing.is_some() && bearings[first].is_some(),
            None => {
                let is_other = |plane: Touch| plane.bodies != touch.bodies;
                let is_plane = || plane_of(context, &group.members[touch.second], touch).is_some();
                bearing.is_some_and(|plane| plane.is_none_or(is_other)) && is_plane()
            }
        }
    };
    let touches: Vec<Touch> = candidates.iter().filter(may_push).copied().collect();
    if touches.is_empty() {
        return Ok(Vec::new());
    }
    let planes: Vec<Option<Touch>> = bearings.iter().map(|it| it.flatten()).collect();
    let all = PushedSpheres::of_touches(context, group, &planes, &touches);
    let forces = all.pressing().ok_or(NoClosedForm)?;
    let pressing = touches.iter().copied().zip(forces).filter(|it| it.1 != DVec3::ZERO);
    let mut left: Vec<(Touch, DVec3)> = pressing.collect();
    let mut sets = Vec::new();
    while let Some(&(first, _)) = left.first() {
        let (own, others) = split_connected(first, left);
        let (touches, known): (Vec<Touch>, Vec<DVec3>) = own.into_iter().unzip();
        let mut set = PushedSpheres::of_touches(context, group, &planes, &touches);
        set.known = known;
        sets.push(set);
        left = others;
    }
    Ok(sets)
}

/// Touches with the forces on their second bodies \[N\].
type Pressed = Vec<(Touch, DVec3)>;

/// Splits touches into those that are connected with one of them, directly or through others, and the rest.
fn split_connected(first: Touch, touches: Pressed) -> (Pressed, Pressed) {
    let mut is_in: Vec<bool> = touches.iter().map(|touch| touch.0.bodies == first.bodies).collect();
    loop {
        let is_new = |number: usize| {
            let shares =
                |other: usize| touches[other].0.places().any(|it| touches[number].0.has(it));
            !is_in[number] && (0..touches.len()).any(|other| is_in[other] && shares(other))
        };
        let Some(new) = (0..touches.len()).find(|&number| is_new(number)) else { break };
        is_in[new] = true;
    }
    let mut is_in = is_in.into_iter();
    touches.into_iter().partition(|_| is_in.next() == Some(true))
}

/// The motion of spheres that push each other.
fn support_pushed(group: &mut Group, pushed: PushedSpheres) -> Result<Support, NoClosedForm> {
    let mut contacts: Vec<Bodies> = pushed.group.touches.iter().map(|touch| touch.bodies).collect();
    contacts.sort_unstable();
    let spheres = pushed.context.system.spheres;
    let PushedPiece { members, rates, valid_for, belt_work } =
        pushed.piece().ok_or(NoClosedForm)?;
    for member in &members {
        if let Some(place) = group.place_of(member.index) {
            group.members[place] = *member;
        }
    }
    let supported = |(member, rates): (&Member, Rates)| Supported {
        slot: member.slot,
        acceleration: rates.acceleration,
        rotation: Some([member.angular_velocity, rates.angular_acceleration]),
        contact_work: ContactWork::Friction {
            moment: spheres.moment_of_inertia(member.index as usize),
            collider_power: rates.collider_power,
        },
    };
    Ok(Support {
        members: members.iter().zip(rates).map(supported).collect(),
        contacts,
        sides: Vec::new(),
        renewal: group.time + valid_for,
        is_curved: false,
        belt_work,
    })
}

/// The motion of the sphere at a place that lies on the planes of a corner.
fn on_planes(
    context: &StepContext,
    group: &mut Group,
    place: usize,
    corner: &Corner,
) -> Result<Option<Support>, NoClosedForm> {
    let member = &mut group.members[place];
    let contact_duration = context.duration_of(&member.scale(false), group.time);
    let supported =
        planar::support(context.system, member, corner, contact_duration, f64::INFINITY)?;
    let Some(planar) = supported else { return Ok(None) };
    let PlanarSupport { velocity, angular_velocity, valid_for, persists, belt_work, .. } = planar;
    let lasting = corner.planes().zip(persists).filter(|it| it.1).map(|it| it.0.surface);
    let bodies = |surface: u32| Bodies::Surface { sphere: member.index, surface };
    let support = Support {
        members: vec![planar.supported(member.slot)],
        contacts: lasting.map(bodies).collect(),
        sides: Vec::new(),
        renewal: group.time + valid_for,
        is_curved: false,
        belt_work,
    };
    (member.velocity, member.angular_velocity) = (velocity, angular_velocity);
    Ok(Some(support))
}

/// Whether friction alone presses a sphere onto a surface that it touches.
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

/// Whether a sphere lies on one curve: faces that share an edge have one normal.
fn is_one_curve(own: &[Touch]) -> bool {
    own.iter().all(|touch| {
        let is_same = (touch.normal - own[0].normal).norm() <= SAME_NORMAL;
        touch.first.is_none() && touch.is_curved() && is_same
    })
}

/// The motion of the sphere at a place over a curve, of one surface or several.
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
            contact_work: ContactWork::Friction { moment, collider_power: 0.0 },
        }],
        contacts: own.iter().map(|touch| touch.bodies).collect(),
        sides: own.iter().filter_map(Touch::ring_side).collect(),
        renewal: group.time + piece.valid_for,
        is_curved: false,
        belt_work: 0.0,
    })
}

/// Whether a contact presses that is not with a plane at rest.
fn is_pressing(touch: &Touch, pressing: &[Touch]) -> bool {
    pressing.iter().any(|it| it.bodies == touch.bodies)
}

/// The plane at rest of a touch; `None` if it is with something else.
fn plane_of<'a>(context: &StepContext<'a>, member: &Member, touch: &Touch) -> Option<Plane<'a>> {
    match touch.bodies {
        Bodies::Surface { surface, .. } if touch.shift == DVec3::ZERO => {
            Plane::under(member.state(), surface, context.system.surfaces)
        }
        _ => None,
    }
}
