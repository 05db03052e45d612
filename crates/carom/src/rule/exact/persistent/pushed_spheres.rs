//! Spheres on planes at rest that push each other where friction acts: their states, and the forces at their
//! contacts (`docs/physics/persistent-contacts.md`).

use glam::DVec3;

use super::accelerations::{IDLE, bias};
use super::correction::corrections;
use super::pushed_sphere::{PushedSphere, Response};
use super::pushing_contact::{self, PushingContact};
use crate::detect::contact::Bodies;
use crate::friction::ContactFriction;
use crate::norm::Norm;
use crate::respond::{friction_of, least_change};
use crate::rule::exact::contacts::contact_scale::{ContactScale, TOUCHING};
use crate::rule::exact::contacts::{Group, Member, Touch};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::flights::Species;

/// Part of a radius by which the start of a piece of path closes a gap: more than what a piece opens.
const MOST_CLOSED: f64 = 1e-9;

/// Spheres that fly or lie on one plane each, with the contacts in which they push each other or other planes.
pub(super) struct PushedSpheres<'a> {
    pub context: &'a StepContext<'a>,
    /// The contacts in which they push, then those with the planes on which they lie.
    pub group: Group,
    /// Number of touches in which they push.
    pushing: usize,
    /// The touch of each member with the plane on which it lies, if any.
    pub planes: Vec<Option<Touch>>,
    /// Estimates of the forces on the second bodies of touches in which they push \[N\].
    pub known: Vec<DVec3>,
}

/// The direction of a velocity that friction opposes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Direction {
    /// The velocity is zero.
    None,
    /// The direction of the velocity at each instant.
    Current,
    /// A constant direction.
    Fixed(DVec3),
}

/// Directions of the velocities that friction acts against.
#[derive(Debug, Clone)]
pub(super) struct Directions {
    /// One per sphere: of its slip on the plane.
    pub slides: Vec<Direction>,
    /// Direction of the velocity of each sphere, if rolling friction acts on it.
    pub moves: Vec<Direction>,
    /// One per sphere: sign of its spin about the normal.
    pub spins: Vec<f64>,
    /// One per touch in which spheres push: of the slip of body 2 on body 1.
    pub contacts: Vec<Direction>,
}

/// The forces at an instant, and what they do.
pub(super) struct Forces {
    pub spheres: Vec<PushedSphere>,
    /// One per sphere.
    pub responses: Vec<Response>,
    pub contacts: Vec<PushingContact>,
    /// One per contact, on its second body \[N\].
    pub on_second: Vec<DVec3>,
}

impl Direction {
    fn of(self, velocity: DVec3) -> Option<DVec3> {
        match self {
            Self::None => None,
            Self::Current if velocity == DVec3::ZERO => None,
            Self::Current => Some(velocity / velocity.norm()),
            Self::Fixed(direction) => Some(direction),
        }
    }

    fn current_if(is_moving: bool) -> Self {
        if is_moving { Self::Current } else { Self::None }
    }
}

impl<'a> PushedSpheres<'a> {
    /// The spheres of a group that push in some touches. `planes` has the touch of each member with the plane on
    /// which it lies, if any.
    pub fn of_touches(
        context: &'a StepContext<'a>,
        group: &Group,
        planes: &[Option<Touch>],
        pushing: &[Touch],
    ) -> Self {
        let is_in = |place: &usize| pushing.iter().any(|touch| touch.has(*place));
        let places: Vec<usize> = (0..group.members.len()).filter(is_in).collect();
        let place_of = |old: usize| places.iter().position(|&place| place == old);
        let renumbered = |touch: &Touch| {
            let first = touch.first.and_then(place_of);
            Some(Touch { first, second: place_of(touch.second)?, ..*touch })
        };
        let plane = |&place: &usize| planes[place].as_ref().and_then(renumbered);
        let planes: Vec<Option<Touch>> = places.iter().map(plane).collect();
        let members = places.iter().map(|&place| group.members[place]).collect();
        let pushing_here = pushing.iter().filter_map(renumbered);
        let touches = pushing_here.chain(planes.iter().flatten().copied()).collect();
        let Group { time, fastest, .. } = *group;
        let group = Group { time, members, touches, fastest };
        let known = vec![DVec3::ZERO; pushing.len()];
        Self { context, group, pushing: pushing.len(), planes, known }
    }

    /// The touches in which spheres push.
    pub fn pushing(&self) -> &[Touch] {
        &self.group.touches[..self.pushing]
    }

    /// The part of a vector along the plane of the sphere at a place: all of it, where there is none.
    fn along_plane(&self, place: usize, vector: DVec3) -> DVec3 {
        self.planes[place].map_or(vector, |plane| plane.across(vector))
    }

    /// The time \[s\] within which a slip ends at once: the longest contact duration with a plane.
    pub fn least_duration(&self) -> f64 {
        let Self { context, group, .. } = self;
        let of = |member: &Member| context.duration_of(&member.scale(false), group.time);
        group.members.iter().map(of).fold(0.0, f64::max)
    }

    /// Closes gaps that a piece of path left by rounding or its error of the third order.
    pub fn close_gaps(&mut self) {
        let Self { context, group, .. } = self;
        let excess = |touch: &Touch| {
            let ContactScale { radius, length, .. } = group.scale(touch);
            let excess = touch.gap.min(MOST_CLOSED * radius);
            if excess.abs() > TOUCHING * length { excess } else { 0.0 }
        };
        let excess: Vec<f64> = group.touches.iter().map(excess).collect();
        if excess.iter().all(|&excess| excess == 0.0) {
            return;
        }
        let moves = corrections(context.work, &group.members, &group.touches, &excess);
        for (member, by) in group.members.iter_mut().zip(moves) {
            member.position += by;
        }
        let measured = self.measured_at(&self.group.members, self.group.time);
        self.group.touches[..self.pushing].copy_from_slice(&measured);
    }

    /// Ends slips, speeds and spins on planes that friction would end within a contact's duration. Returns the work of
    /// belts \[J\].
    pub fn end_slow_motion(&mut self) -> f64 {
        let duration = self.least_duration();
        let mut belt_work = 0.0;
        for place in 0..self.group.members.len() {
            let Some(plane) = self.planes[place] else { continue };
            let friction = self.friction_of(&plane);
            let inertia_factor = self.inertia_factor(place);
            let member = &mut self.group.members[place];
            let (normal, radius) = (plane.normal, member.species.radius);
            let pressing = (-member.species.acceleration.dot(normal)).max(0.0);
            // Relative to the material of the plane.
            let mut velocity = plane.across(member.velocity) - plane.belt;
            let mut spin = member.angular_velocity.dot(normal);
            let mut across = plane.across(member.angular_velocity);
            let slip = velocity - radius * across.cross(normal);
            if slip.norm() <= slip_loss(friction, inertia_factor, pressing) * duration {
                velocity -= inertia_factor / (1.0 + inertia_factor) * slip;
                if velocity.norm() <= speed_loss(friction, &plane, member) * duration {
                    velocity = DVec3::ZERO;
                }
                across = normal.cross(velocity) / radius;
            }
            if spin.abs() <= friction.spinning * pressing / (inertia_factor * radius) * duration {
                spin = 0.0;
            }
            let before = plane.across(member.velocity);
            member.velocity = plane.with_belt(velocity);
            member.angular_velocity = across + spin * normal;
            belt_work += member.species.mass * (member.velocity - before).dot(plane.belt);
        }
        belt_work
    }

    /// Sets the velocities along normals to zero; rolling spheres keep rolling. Returns the work of belts \[J\].
    pub fn stop_along_normals(&mut self) -> f64 {
        let Directions { slides, .. } = self.directions();
        let members = &self.group.members;
        let speeds: Vec<f64> =
            self.group.touches.iter().map(|touch| touch.normal_velocity(members)).collect();
        let contacts: Vec<_> = self.group.touches.iter().map(Touch::contact).collect();
        let mass = |(place, member): (usize, &Member)| match slides[place] {
            Direction::None => (1.0 + self.inertia_factor(place)) * member.species.mass,
            _ => member.species.mass,
        };
        let masses: Vec<f64> = members.iter().enumerate().map(mass).collect();
        let changes = least_change(self.context.work, &contacts, &masses, &speeds);
        let mut belt_work = 0.0;
        for (place, change) in changes.into_iter().enumerate() {
            let change = self.along_plane(place, change);
            let plane = self.planes[place].filter(|_| slides[place] == Direction::None);
            let inertia_factor = self.inertia_factor(place);
            let member = &mut self.group.members[place];
            member.velocity += change;
            if let Some(plane) = plane {
                member.angular_velocity += plane.normal.cross(change) / member.species.radius;
                // The impulse of friction that turns it.
                belt_work -= inertia_factor * member.species.mass * change.dot(plane.belt);
            }
        }
        belt_work
    }

    /// Directions of velocities that friction acts against, as they are now.
    pub fn directions(&self) -> Directions {
        let members = &self.group.members;
        let places = || 0..members.len();
        let moves = |place: usize| {
            let loss = self.planes[place]
                .map_or(0.0, |plane| speed_loss(self.friction_of(&plane), &plane, &members[place]));
            let least = loss * self.least_duration();
            Direction::current_if(self.velocity_on_plane(place, &members[place]).norm() > least)
        };
        let spin = |place: usize| {
            let spin = self.planes[place]
                .map_or(0.0, |plane| members[place].angular_velocity.dot(plane.normal));
            if spin == 0.0 { 0.0 } else { spin.signum() }
        };
        Directions {
            slides: places().map(|place| self.direction_of_slip(place)).collect(),
            moves: places().map(moves).collect(),
            spins: places().map(spin).collect(),
            contacts: self.pushing().iter().map(|it| self.direction_of_contact(it)).collect(),
        }
    }

    /// The direction of the slip of a sphere on its plane.
    fn direction_of_slip(&self, place: usize) -> Direction {
        let members = &self.group.members;
        // A flying sphere does not roll.
        let Some(plane) = &self.planes[place] else { return Direction::Fixed(DVec3::ZERO) };
        let pressing = (-members[place].species.acceleration.dot(plane.normal)).max(0.0);
        let loss = slip_loss(self.friction_of(plane), self.inertia_factor(place), pressing);
        Direction::current_if(self.slip(members, plane).norm() > loss * self.least_duration())
    }

    /// The direction of the slip in a touch in which spheres push.
    fn direction_of_contact(&self, touch: &Touch) -> Direction {
        let members = &self.group.members;
        let pressing: f64 =
            touch.places().map(|place| members[place].species.acceleration.norm()).sum();
        let least_factor =
            touch.places().map(|place| self.inertia_factor(place)).fold(f64::INFINITY, f64::min);
        let loss = slip_loss(self.friction_of(touch), least_factor, pressing);
        Direction::current_if(self.slip(members, touch).norm() > loss * self.least_duration())
    }

    /// Normal force and friction \[N\] on body 2 of each touch as the spheres move now; `None` where they are
    /// not found.
    pub fn forces_now(&self) -> Option<Vec<(Bodies, (f64, DVec3))>> {
        let Group { members, time, .. } = &self.group;
        let found = self.forces(members, *time, &self.directions(), &self.known)?;
        let split = |(touch, force): (&Touch, DVec3)| {
            (touch.bodies, (force.dot(touch.normal), touch.across(force)))
        };
        let pushing = self.pushing().iter().zip(found.on_second).map(split);
        let plane = |(plane, response): (&Option<Touch>, &Response)| {
            plane.map(|touch| (touch.bodies, (response.normal_force, response.friction)))
        };
        let planes = self.planes.iter().zip(&found.responses).filter_map(plane);
        Some(pushing.chain(planes).collect())
    }

    /// Returns the forces where these are the members, at a time \[s\]; `None` where they are not found.
    pub fn forces(
        &self,
        members: &[Member],
        time: f64,
        directions: &Directions,
        known: &[DVec3],
    ) -> Option<Forces> {
        let touches = self.measured_at(members, time);
        let sphere = |place: usize| self.sphere(place, &members[place], directions);
        let spheres: Vec<PushedSphere> = (0..members.len()).map(sphere).collect();
        let contacts: Vec<PushingContact> =
            touches.iter().zip(&directions.contacts).map(|it| self.contact(members, it)).collect();
        let mut on_second = known.to_vec();
        let work = self.context.work;
        let responses = pushing_contact::forces(work, &spheres, &contacts, &mut on_second)?;
        Some(Forces { spheres, responses, contacts, on_second })
    }

    /// Returns the forces of touches in which spheres push \[N\], zero where they do not press; `None` where none
    /// are found.
    pub fn pressing(mut self) -> Option<Vec<DVec3>> {
        self.end_slow_motion();
        let members = &self.group.members;
        let found = self.forces(members, self.group.time, &self.directions(), &self.known)?;
        let or_zero = |(touch, force): (&Touch, DVec3)| {
            let least = |place: usize| {
                let Species { mass, acceleration, .. } = members[place].species;
                IDLE * mass * acceleration.norm()
            };
            let presses = force.norm() > touch.places().map(least).sum();
            if presses { force } else { DVec3::ZERO }
        };
        Some(self.pushing().iter().zip(found.on_second).map(or_zero).collect())
    }

    /// The touches in which spheres push, measured at other places. Bodies that no longer face each other keep the
    /// old values.
    fn measured_at(&self, members: &[Member], time: f64) -> Vec<Touch> {
        let measured =
            |touch: &Touch| touch.measured_at(self.context, members, time).unwrap_or(*touch);
        self.pushing().iter().map(measured).collect()
    }

    fn sphere(&self, place: usize, member: &Member, directions: &Directions) -> PushedSphere {
        let plane = &self.planes[place];
        let normal = plane.map_or(DVec3::ZERO, |plane| plane.normal);
        let velocity = self.velocity_on_plane(place, member);
        let turning = member.angular_velocity.cross(normal);
        PushedSphere {
            normal,
            radius: member.species.radius,
            mass: member.species.mass,
            inertia_factor: self.inertia_factor(place),
            acceleration: member.species.acceleration,
            friction: plane.map(|plane| self.friction_of(&plane)).unwrap_or_default(),
            slides: directions.slides[place].of(velocity - member.species.radius * turning),
            moves: directions.moves[place].of(velocity),
            spin: directions.spins[place],
        }
    }

    fn contact(&self, members: &[Member], (touch, slides): (&Touch, &Direction)) -> PushingContact {
        let velocity = touch.across(touch.relative_velocity(members));
        let normal_turns = touch.curvature.rate(velocity);
        let slip_bias = touch.across(surface_turning(members, touch).cross(normal_turns));
        PushingContact {
            first: touch.first,
            second: touch.second,
            normal: touch.normal,
            friction: self.friction_of(touch).sliding,
            slides: slides.of(self.slip(members, touch)),
            bias: bias(touch, members) * touch.normal - slip_bias,
        }
    }

    /// Velocity with which the surface of body 2 slides along that of body 1 \[m/s\].
    pub fn slip(&self, members: &[Member], touch: &Touch) -> DVec3 {
        let relative = touch.across(touch.relative_velocity(members)) - touch.belt;
        relative - surface_turning(members, touch).cross(touch.normal)
    }

    /// Velocity of a sphere at a place along its plane, relative to the material of that \[m/s\].
    pub fn velocity_on_plane(&self, place: usize, member: &Member) -> DVec3 {
        let belt = self.planes[place].map_or(DVec3::ZERO, |plane| plane.belt);
        self.along_plane(place, member.velocity) - belt
    }

    /// Power of belts on the sphere at a place \[W\].
    pub fn collider_power(&self, place: usize, forces: &Forces) -> f64 {
        let pushing = self.pushing().iter().zip(&forces.on_second);
        let pushed = pushing.filter(|(touch, _)| touch.second == place);
        let by_pushing: f64 = pushed.map(|(touch, force)| force.dot(touch.belt)).sum();
        let friction = forces.responses[place].friction;
        by_pushing + self.planes[place].map_or(0.0, |plane| friction.dot(plane.belt))
    }

    pub fn friction_of(&self, touch: &Touch) -> ContactFriction {
        friction_of(touch.bodies, self.context.system)
    }

    fn inertia_factor(&self, place: usize) -> f64 {
        self.context.system.spheres.inertia_factor(self.group.members[place].index as usize)
    }
}

/// Sum of radius times angular velocity of the spheres in a touch \[m/s\].
fn surface_turning(members: &[Member], touch: &Touch) -> DVec3 {
    touch
        .places()
        .map(|place| members[place].species.radius * members[place].angular_velocity)
        .sum()
}

/// The largest change of the speed of a sphere that rolls on a plane, by rolling friction and the force along the
/// plane \[m/s²\].
fn speed_loss(friction: ContactFriction, plane: &Touch, member: &Member) -> f64 {
    let acceleration = member.species.acceleration;
    let pressing = (-acceleration.dot(plane.normal)).max(0.0);
    friction.rolling * pressing + plane.across(acceleration).norm()
}

/// Returns the deceleration of a slip on a plane by friction \[m/s²\], for a sphere that `pressing` \[m/s²\]
/// presses on the plane.
fn slip_loss(friction: ContactFriction, inertia_factor: f64, pressing: f64) -> f64 {
    (1.0 + 1.0 / inertia_factor) * friction.sliding * pressing
}
