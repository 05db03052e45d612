//! Decides which persistent contacts follow the curves of their spheres, so that their forces need
//! not be held.

use glam::DVec3;

use super::accelerations::{Accelerations, IDLE, free_acceleration};
use crate::detect::contact::Bodies;
use crate::friction::ContactFriction;
use crate::integrate::field::Values;
use crate::norm::Norm;
use crate::respond::friction_of;
use crate::rule::exact::contacts::{Group, Member, Touch};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::features::Feature;
use crate::rule::exact::flights::{
    ContactSphere, CurveBody, CurveContact, CurveContacts, MOST_CONTACTS, Moving, MovingSurface,
    Species,
};
use crate::system::System;

/// Angle \[rad\] below which two normals count as one: they differ by rounding.
pub(super) const SAME_NORMAL: f64 = 1e-9;

/// Whether contacts between these members may make curves of their flights: forces on one of them do, or a surface that
/// turns the normal.
pub(super) fn may_bend(members: &[Member], touches: &[Touch]) -> bool {
    let turns = |touch: &Touch| touch.first.is_none() && touch.is_curved();
    are_some_curved(members) || touches.iter().any(turns)
}

/// Whether forces make a curve of the flight of some member.
pub(super) fn are_some_curved(members: &[Member]) -> bool {
    members.iter().any(|member| member.species.is_curved)
}

/// Whether drag in closed form slows some member.
pub(super) fn are_some_slowed(members: &[Member]) -> bool {
    members.iter().any(|member| member.species.drag_rate > 0.0)
}

/// Whether all spheres in these contacts can fly on curves with them: no contact follows from others.
pub(super) fn fly_so(context: &StepContext, group: &Group, touches: &[Touch]) -> bool {
    let Group { members, time, .. } = group;
    let Some(mut contacts) = contacts(context, group, touches) else { return false };
    let motion = MotionOfMembers::of(members, *time);
    contacts.are_independent(motion.moving(), &spheres(context, members))
}

/// The touches, of those that may persist, that press where friction acts, with the accelerations of the members;
/// `None` unless all of them fly on curves with these contacts.
pub(super) fn pressing_with_friction(
    context: &StepContext,
    group: &Group,
    candidates: &[Touch],
) -> Option<(Vec<Touch>, Accelerations)> {
    let members = &group.members;
    let touches = in_order(candidates);
    let mut contacts = contacts(context, group, &touches)?;
    let (spheres, motion) = (spheres(context, members), MotionOfMembers::of(members, group.time));
    let free = motion.free();
    let found = contacts.unilateral(motion.moving(), &spheres, &free);
    let largest = contacts.forces.iter().map(|force| force.0).fold(0.0, f64::max);
    let presses: Vec<bool> = contacts.forces.iter().map(|it| it.0 > IDLE * largest).collect();
    let mut is_carried = vec![false; members.len()];
    let pressing = touches.iter().zip(&presses).filter(|it| *it.1);
    pressing.flat_map(|it| it.0.places()).for_each(|place| is_carried[place] = true);
    let scale = free.sizes.iter().copied().fold(0.0, f64::max);
    let is_idle = |number: usize| {
        let are_carried = touches[number].places().all(|place| is_carried[place]);
        are_carried && contacts.opening(number, motion.moving(), &found) <= IDLE * scale
    };
    let stays = |&number: &usize| presses[number] || is_idle(number);
    let persistent: Vec<Touch> =
        (0..touches.len()).filter(stays).map(|number| touches[number]).collect();
    let (persistent, found) =
        without_pulling(context, group, (persistent, found), (&motion, &spheres))?;
    if !fly_so(context, group, &persistent) {
        return None;
    }
    // Faces that share an edge persist together.
    let persists = |touch: &&Touch| persistent.iter().any(|it| are_same(it, touch));
    let all: Vec<Touch> = candidates.iter().filter(persists).copied().collect();
    let with_drag = |(member, &acceleration): (&Member, &DVec3)| {
        acceleration + member.species.drag_rate * member.velocity
    };
    let each = members.iter().zip(&found).map(with_drag).collect();
    let part = |touch: &Touch| largest / members[touch.second].species.mass;
    let largest = all.iter().map(part).fold(0.0, f64::max);
    Some((all, Accelerations { each, largest }))
}

/// The persistent touches without those that pull at once where a step begins with them, and the accelerations of the
/// members \[m/s²\]; `None` where the spheres do not fly on curves with them, or friction jams them.
///
/// Friction may allow several solutions, of which a step takes one and the search for contacts that press another.
fn without_pulling(
    context: &StepContext,
    group: &Group,
    (mut touches, mut accelerations): (Vec<Touch>, Vec<DVec3>),
    (motion, spheres): (&MotionOfMembers, &[ContactSphere]),
) -> Option<(Vec<Touch>, Vec<DVec3>)> {
    loop {
        let mut contacts = contacts(context, group, &touches)?;
        let mut values = motion.free();
        contacts.choose_states(motion.moving(), spheres, &values, 0.0);
        contacts.add(motion.moving(), spheres, &mut values);
        if contacts.are_jammed() {
            return None;
        }
        let Some(number) = contacts.hardest_pull(spheres, &values.sizes) else {
            return Some((touches, accelerations));
        };
        touches.remove(number);
        accelerations = values.accelerations;
    }
}

/// Normal force and friction \[N\] on body 2 of each touch of a cluster on curves, as it moves now; `None` if it is none.
pub(super) fn forces_now(context: &StepContext, group: &Group) -> Option<Vec<(f64, DVec3)>> {
    let Group { members, touches, time, .. } = group;
    let ordered = in_order(touches);
    let mut contacts = contacts(context, group, &ordered)?;
    let (spheres, motion) = (spheres(context, members), MotionOfMembers::of(members, *time));
    let mut values = motion.free();
    contacts.choose_states(motion.moving(), &spheres, &values, 0.0);
    contacts.add(motion.moving(), &spheres, &mut values);
    let force_of = |touch: &Touch| {
        let place =
            ordered.iter().position(|it| it.bodies == touch.bodies && it.side == touch.side);
        place.map_or((0.0, DVec3::ZERO), |place| contacts.forces[place])
    };
    Some(touches.iter().map(force_of).collect())
}

/// The motion of the members of a group, as contacts take it.
struct MotionOfMembers {
    /// On the world's clock \[s\].
    time: f64,
    positions: Vec<DVec3>,
    velocities: Vec<DVec3>,
    angular_velocities: Vec<DVec3>,
    accelerations: Vec<DVec3>,
}

impl MotionOfMembers {
    fn of(members: &[Member], time: f64) -> Self {
        let of_all = |of: fn(&Member) -> DVec3| members.iter().map(of).collect();
        Self {
            time,
            positions: of_all(|member| member.position),
            velocities: of_all(|member| member.velocity),
            angular_velocities: of_all(|member| member.angular_velocity),
            accelerations: of_all(free_acceleration),
        }
    }

    fn moving(&self) -> Moving<'_> {
        let Self { time, positions, velocities, angular_velocities, .. } = self;
        Moving { time: *time, positions, velocities, angular_velocities }
    }

    /// The accelerations without contacts: those of all centres, then the angular ones.
    fn free(&self) -> Values {
        let count = self.accelerations.len();
        let mut free = Values::of(2 * count);
        free.accelerations[..count].copy_from_slice(&self.accelerations);
        for (size, acceleration) in free.sizes.iter_mut().zip(&self.accelerations) {
            *size = acceleration.norm();
        }
        free
    }
}

/// The touches, those of each sphere beside each other; of faces that share an edge one.
fn in_order(touches: &[Touch]) -> Vec<Touch> {
    let numbers = (0..touches.len()).filter(|&number| !is_repeated(&touches[..=number]));
    let mut ordered: Vec<Touch> = numbers.map(|number| touches[number]).collect();
    ordered.sort_by_key(|touch| touch.second);
    ordered
}

/// Whether two touches are of one sphere at the same place.
fn are_same(one: &Touch, other: &Touch) -> bool {
    let is_sphere = one.first == other.first && one.second == other.second;
    is_sphere && (one.normal - other.normal).norm() <= SAME_NORMAL
}

/// The contacts in the form of curves; `None` if some sphere does not fly on one with them.
fn contacts<'a>(
    context: &StepContext<'a>,
    group: &Group,
    touches: &[Touch],
) -> Option<CurveContacts<'a>> {
    // In a sheared box images slide past each other.
    let is_sheared = context.system.settings.shear_rate != 0.0;
    if touches.len() > MOST_CONTACTS || is_sheared {
        return None;
    }
    let contacts = touches.iter().map(|touch| contact(context, group, touch)).collect();
    let contacts: Option<Vec<CurveContact>> = contacts;
    let contacts = contacts?;
    // Of faces with a common edge one bears the sphere.
    let numbers = (0..touches.len()).filter(|&number| !is_repeated(&touches[..=number]));
    Some(CurveContacts::new(numbers.map(|number| contacts[number]).collect()))
}

/// What contacts need to know of members.
fn spheres(context: &StepContext, members: &[Member]) -> Vec<ContactSphere> {
    let sphere = |member: &Member| {
        let Species { radius, mass, .. } = member.species;
        let inertia_factor = context.system.spheres.inertia_factor(member.index as usize);
        ContactSphere { radius, mass, inertia_factor }
    };
    members.iter().map(sphere).collect()
}

/// Whether a sphere of this species can fly on curves with a contact: no rolling or spinning friction acts there, and
/// the sphere does not grow.
pub(in crate::rule::exact) fn flies_with(
    context: &StepContext,
    species: &Species,
    bodies: Bodies,
) -> bool {
    let ContactFriction { rolling, spinning, .. } = friction_of(bodies, context.system);
    let only_slides = rolling == 0.0 && spinning == 0.0;
    !context.system.holds_forces_of_all() && species.growth_speed == 0.0 && only_slides
}

/// Whether the last of several touches is with a surface that touches its sphere where another one does.
fn is_repeated(touches: &[Touch]) -> bool {
    let Some((last, others)) = touches.split_last() else { return false };
    last.first.is_none() && others.iter().any(|other| are_same(last, other))
}

/// A contact of spheres on curves with each other or with a surface.
fn contact<'a>(
    context: &StepContext<'a>,
    Group { members, time, .. }: &Group,
    touch: &Touch,
) -> Option<CurveContact<'a>> {
    if !touch.places().all(|place| flies_with(context, &members[place].species, touch.bodies)) {
        return None;
    }
    let second = touch.second;
    let first = match touch.bodies {
        Bodies::Pair(..) => CurveBody::Sphere(touch.first?),
        Bodies::Surface { surface, .. } => {
            let system: &'a System<'a> = context.system;
            let surface = &system.surfaces[surface as usize];
            let (form, moving) = (&surface.form, MovingSurface::of(surface, context.start));
            let Member { position, velocity, species, .. } = members[second];
            let state = [position + touch.shift, velocity];
            let feature = match (touch.side, moving) {
                // The sides of a ring are known where it is at rest.
                (Some(_), Some(_)) => return None,
                (Some(side), None) => Feature::side_of(form, side)?,
                (None, Some(it)) => {
                    Feature::under(form, it.seen_from(state, *time), species.radius)?
                }
                (None, None) => Feature::under(form, state, species.radius)?,
            };
            CurveBody::part_of(feature, moving)
        }
    };
    Some(CurveContact {
        first,
        second,
        shift: touch.shift,
        friction: friction_of(touch.bodies, context.system).sliding,
    })
}
