//! Persistent contacts of a sphere in a corner: which of them persist, their forces, and how long the forces hold.

use glam::DVec3;

use super::NoClosedForm;
use super::accelerations::{IDLE, free_acceleration, is_back_within};
use super::rolling::{PressedSphere, Rolling, on_plane};
use super::sliding::time_on_disc;
use crate::axis_motion::AxisMotion;
use crate::detect::contact::Bodies;
use crate::flight::Flight;
use crate::norm::Norm;
use crate::respond::{self, belt_of, friction_of};
use crate::rule::exact::contacts::{Corner, MOST_PLANES, Member, Plane};
use crate::rule::exact::features::{beyond, time_on};
use crate::rule::exact::flights::{ContactWork, Supported};
use crate::surface::Form;
use crate::system::System;

/// The motion of a sphere in its persistent contacts.
pub(crate) struct PlanarSupport {
    /// \[m/s\]
    pub velocity: DVec3,
    /// \[rad/s\]
    pub angular_velocity: DVec3,
    /// Acceleration by everything but drag \[m/s²\].
    pub acceleration: DVec3,
    /// \[rad/s²\]
    pub angular_acceleration: DVec3,
    /// Moment of inertia \[kg m²\].
    moment: f64,
    /// Power of a belt on the sphere \[W\].
    collider_power: f64,
    /// Work of the belt at the start, where friction ends a slip at once \[J\].
    pub belt_work: f64,
    /// How long that holds \[s\]; infinite if longer than the given duration.
    pub valid_for: f64,
    /// Whether each contact persists, in the order of the planes; the others part.
    pub persists: [bool; MOST_PLANES],
}

impl PlanarSupport {
    /// The sphere at `slot` with this support.
    pub fn supported(&self, slot: u32) -> Supported {
        let rotation = Some([self.angular_velocity, self.angular_acceleration]);
        let contact_work = self.contact_work();
        Supported { slot, acceleration: self.acceleration, rotation, contact_work }
    }

    /// The work that the contacts do.
    pub fn contact_work(&self) -> ContactWork {
        ContactWork::Friction { moment: self.moment, collider_power: self.collider_power }
    }
}

/// The motion of a sphere that touches the planes of a corner. Where it is pressed onto a plane, it loses the
/// velocity along the normal; elsewhere the contact ends. `None` where no contact is left.
///
/// All of that holds for a `duration` \[s\]. Contacts that part for less than a contact's duration
/// \[s\] persist, and what holds for less is in doubt only by rounding.
///
/// Forces at right angles do not depend on each other, so each follows from its own plane, as it
/// would from [`contact_forces`](crate::respond::contact_forces). With friction that is so on one plane only:
/// [`on_plane`].
///
/// # Errors
/// [`NoClosedForm`] if friction acts, and the sphere is pressed onto several planes, or slowed by drag.
pub(crate) fn support(
    system: &System,
    member: &Member,
    corner: &Corner,
    contact_duration: f64,
    duration: f64,
) -> Result<Option<PlanarSupport>, NoClosedForm> {
    let Member { mut velocity, angular_velocity, species, .. } = *member;
    let (mut acceleration, mut largest) = (species.acceleration, 0.0f64);
    let mut persists = [false; MOST_PLANES];
    let pull = free_acceleration(member).norm();
    for (plane, persists) in corner.planes().zip(&mut persists) {
        // Along the plane, drag has no part in what presses on it.
        let pressing = -species.acceleration.dot(plane.normal);
        let parting = velocity.dot(plane.normal);
        let is_back = is_back_within(contact_duration, parting, pull);
        *persists = is_back && pressing >= -IDLE * pull;
        if *persists {
            let pressing = pressing.max(0.0);
            acceleration += pressing * plane.normal;
            velocity -= parting * plane.normal;
            largest = largest.max(pressing);
        }
    }
    if largest == 0.0 {
        return Ok(None);
    }
    if acceleration.norm() <= IDLE * (species.acceleration.norm() + largest) {
        acceleration = DVec3::ZERO;
    }
    let mut support = PlanarSupport {
        velocity,
        angular_velocity,
        acceleration,
        angular_acceleration: DVec3::ZERO,
        moment: system.spheres.moment_of_inertia(member.index as usize),
        collider_power: 0.0,
        belt_work: 0.0,
        valid_for: f64::INFINITY,
        persists,
    };
    support.add_friction(system, member, corner, contact_duration)?;
    support.end_at_edges(member, corner, duration);
    support.valid_for = support.valid_for.max(contact_duration);
    Ok(Some(support))
}

impl PlanarSupport {
    /// Adds friction to the acceleration of the sphere.
    fn add_friction(
        &mut self,
        system: &System,
        member: &Member,
        corner: &Corner,
        contact_duration: f64,
    ) -> Result<(), NoClosedForm> {
        let pressed = self.pressed_spheres(system, member, corner);
        if pressed.is_empty() {
            return Ok(());
        }
        let on_planes = rolling_on(&pressed, contact_duration)?;
        let rolling = self.beside_planes(&pressed, on_planes, corner, contact_duration);
        if let [sphere] = &pressed[..] {
            let mass = member.species.mass;
            self.collider_power = mass * (rolling.acceleration - sphere.pull).dot(sphere.belt);
            let ended = on_planes.velocity - sphere.velocity;
            // What another plane stops, friction stops of the turning.
            let stopped = rolling.velocity - on_planes.velocity;
            let by_belt = ended - sphere.inertia_factor * stopped;
            self.belt_work = mass * by_belt.dot(sphere.belt);
        }
        (self.velocity, self.angular_velocity) = (rolling.velocity, rolling.angular_velocity);
        self.acceleration = rolling.acceleration;
        self.angular_acceleration = rolling.angular_acceleration;
        self.valid_for = rolling.valid_for;
        let moves = self.velocity != DVec3::ZERO || self.acceleration != DVec3::ZERO;
        if moves && member.species.drag_rate > 0.0 {
            return Err(NoClosedForm);
        }
        let least = IDLE * free_acceleration(member).norm();
        for (plane, persists) in corner.planes().zip(&mut self.persists) {
            let opening = self.acceleration.dot(plane.normal);
            if *persists && opening < -least {
                // Friction presses it onto another plane.
                return Err(NoClosedForm);
            }
            *persists &= opening <= least;
        }
        Ok(())
    }

    /// The motion of a sphere to which friction gives a velocity towards or away from planes that do not press on
    /// it: it rolls along the former and leaves the latter.
    ///
    /// A slip that friction ends within a contact's duration is gone at once, and may leave such a velocity. In
    /// a persistent contact nothing would meet it.
    fn beside_planes(
        &mut self,
        pressed: &[PressedSphere],
        rolling: Rolling,
        corner: &Corner,
        contact_duration: f64,
    ) -> Rolling {
        let [sphere] = pressed else { return rolling };
        let rounding = respond::rounding_of(rolling.velocity);
        let (mut velocity, mut is_turned) = (rolling.velocity, false);
        for (plane, persists) in corner.planes().zip(&mut self.persists) {
            let parting = velocity.dot(plane.normal);
            if plane.normal == sphere.normal || !*persists || parting == 0.0 {
                continue;
            }
            if parting > rounding {
                *persists = false;
            } else {
                velocity -= parting * plane.normal;
                is_turned |= parting < -rounding;
            }
        }
        if !is_turned {
            return Rolling { velocity, ..rolling };
        }
        on_plane(&sphere.rolling_with(velocity), contact_duration)
    }

    /// Shortens the piece to the time at which the sphere may reach the end of a face, if that is within `duration`
    /// \[s\].
    fn end_at_edges(&mut self, member: &Member, corner: &Corner, duration: f64) {
        let Member { position, species, .. } = *member;
        let Self { velocity, acceleration, .. } = *self;
        let motion = |axis: DVec3| AxisMotion {
            velocity: velocity.dot(axis),
            acceleration: acceleration.dot(axis),
            drag_rate: species.drag_rate,
        };
        let flight = Flight { position, velocity, acceleration, drag_rate: species.drag_rate };
        let way = flight.farthest(duration).element_sum();
        for (plane, persists) in corner.planes().zip(self.persists) {
            // The distance of an endless time is unknown.
            let is_within = |beyond: f64| beyond + way < 0.0;
            let may_end = match plane.form {
                Form::Rectangle(face) => !beyond(face, position).into_iter().all(is_within),
                Form::Facet(_) => true,
                _ => false,
            };
            if persists && may_end {
                let time = time_on(plane.form, [position, velocity], motion);
                self.valid_for = self.valid_for.min(time);
            }
            if let Form::Band(disc) = plane.form
                && persists
            {
                self.valid_for = self.valid_for.min(time_on_disc(disc, &flight));
            }
        }
    }

    /// The sphere on each plane that presses on it, if friction acts on one of them; with its motion without
    /// friction.
    fn pressed_spheres(
        &self,
        system: &System,
        member: &Member,
        corner: &Corner,
    ) -> Vec<PressedSphere> {
        let Member { species, angular_velocity, index, .. } = *member;
        let on = |plane: Plane| {
            let bodies = Bodies::Surface { sphere: index, surface: plane.surface };
            let motion = &system.surfaces[plane.surface as usize].motion;
            PressedSphere {
                normal: plane.normal,
                belt: belt_of(bodies, motion, plane.normal, system),
                radius: species.radius,
                inertia_factor: system.spheres.inertia_factor(index as usize),
                velocity: self.velocity,
                angular_velocity,
                pressing: -species.acceleration.dot(plane.normal),
                pull: self.acceleration,
                friction: friction_of(bodies, system),
            }
        };
        let persisting = corner.planes().zip(self.persists).filter(|it| it.1).map(|it| on(it.0));
        let least = IDLE * species.acceleration.norm();
        let pressed: Vec<PressedSphere> = persisting.filter(|it| it.pressing > least).collect();
        if pressed.iter().any(|it| it.friction.acts()) { pressed } else { Vec::new() }
    }
}

/// The motion of a sphere that is pressed onto planes.
fn rolling_on(pressed: &[PressedSphere], contact_duration: f64) -> Result<Rolling, NoClosedForm> {
    match pressed {
        [sphere] => Ok(on_plane(sphere, contact_duration)),
        // Nothing sets it in motion.
        _ if pressed.iter().all(PressedSphere::is_at_rest) => Ok(Rolling::AT_REST),
        _ => Err(NoClosedForm),
    }
}
