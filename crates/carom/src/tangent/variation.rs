//! A small change of the initial state of a world.

use std::collections::BTreeMap;

use glam::DVec3;

use super::state::SphereTangent;
use crate::id::{ColliderId, SphereId, SpringId};

/// A change of the initial state of a world: a direction in which derivatives are taken. Also used for a gradient:
/// the derivatives of one number with respect to the initial state.
///
/// ```
/// use carom::{DVec3, SphereId, Variation};
///
/// # let ball = carom::World::default().add_sphere(carom::Sphere::new(DVec3::ZERO, 1.0)).unwrap();
/// // The ball starts a bit faster, everything falls a bit more.
/// let direction = Variation::default()
///     .with_velocity(ball, DVec3::X)
///     .with_acceleration(DVec3::NEG_Y);
/// assert_eq!(direction.sphere(ball).velocity, DVec3::X);
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Variation {
    spheres: BTreeMap<SphereId, SphereVariation>,
    colliders: BTreeMap<ColliderId, ColliderVariation>,
    springs: BTreeMap<SpringId, SpringVariation>,
    /// Change of the acceleration of all spheres, as by gravity \[m/s²\].
    pub acceleration: DVec3,
}

/// A change of the initial state of a sphere.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[non_exhaustive]
pub struct SphereVariation {
    /// Change of the centre \[m\].
    pub position: DVec3,
    /// Change of the velocity \[m/s\].
    pub velocity: DVec3,
    /// Change of the angular velocity \[rad/s\].
    pub angular_velocity: DVec3,
    /// Change of the radius \[m\] at constant mass.
    pub radius: f64,
    /// Change of the mass \[kg\] at constant radius.
    pub mass: f64,
    /// Change of the coefficient of restitution.
    pub restitution: f64,
    /// Change of the coefficient of sliding friction.
    pub friction: f64,
    /// Change of the acceleration of this sphere alone, as by an applied force \[m/s²\].
    pub acceleration: DVec3,
}

/// A change of the initial state of a collider.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[non_exhaustive]
pub struct ColliderVariation {
    /// Change of the position \[m\]: a shift of the whole collider.
    pub position: DVec3,
    /// Change of the velocity \[m/s\].
    pub velocity: DVec3,
    /// Change of the rotation about the position: an angle along its axis \[rad\]. A gradient has it for colliders at
    /// rest that meet one sphere at a time; else it is NaN.
    pub rotation: DVec3,
    /// Change of the coefficient of restitution.
    pub restitution: f64,
    /// Change of the coefficient of sliding friction.
    pub friction: f64,
}

/// A change of a spring.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[non_exhaustive]
pub struct SpringVariation {
    /// Change of the stiffness \[N/m\].
    pub stiffness: f64,
    /// Change of the rest length \[m\].
    pub rest_length: f64,
    /// Change of the damping \[kg/s\].
    pub damping: f64,
}

impl Variation {
    /// Sets the change of the centre of a sphere \[m\].
    pub fn with_position(mut self, sphere: SphereId, position: DVec3) -> Self {
        self.sphere_mut(sphere).position = position;
        self
    }

    /// Sets the change of the velocity of a sphere \[m/s\].
    pub fn with_velocity(mut self, sphere: SphereId, velocity: DVec3) -> Self {
        self.sphere_mut(sphere).velocity = velocity;
        self
    }

    /// Sets the change of the angular velocity of a sphere \[rad/s\].
    pub fn with_angular_velocity(mut self, sphere: SphereId, angular_velocity: DVec3) -> Self {
        self.sphere_mut(sphere).angular_velocity = angular_velocity;
        self
    }

    /// Sets the change of the acceleration of all spheres \[m/s²\].
    pub fn with_acceleration(mut self, acceleration: DVec3) -> Self {
        self.acceleration = acceleration;
        self
    }

    /// Returns the change of a sphere; zero if none is set.
    pub fn sphere(&self, sphere: SphereId) -> SphereVariation {
        self.spheres.get(&sphere).copied().unwrap_or_default()
    }

    /// Returns a mutable reference to the change of a sphere.
    pub fn sphere_mut(&mut self, sphere: SphereId) -> &mut SphereVariation {
        self.spheres.entry(sphere).or_default()
    }

    /// Returns the change of a collider; zero if none is set.
    pub fn collider(&self, collider: ColliderId) -> ColliderVariation {
        self.colliders.get(&collider).copied().unwrap_or_default()
    }

    /// Returns a mutable reference to the change of a collider.
    pub fn collider_mut(&mut self, collider: ColliderId) -> &mut ColliderVariation {
        self.colliders.entry(collider).or_default()
    }

    /// Returns the change of a spring; zero if none is set.
    pub fn spring(&self, spring: SpringId) -> SpringVariation {
        self.springs.get(&spring).copied().unwrap_or_default()
    }

    /// Returns a mutable reference to the change of a spring.
    pub fn spring_mut(&mut self, spring: SpringId) -> &mut SpringVariation {
        self.springs.entry(spring).or_default()
    }

    /// Returns the spheres with a change, ascending by id.
    pub fn spheres(&self) -> impl Iterator<Item = (SphereId, &SphereVariation)> {
        self.spheres.iter().map(|(&id, variation)| (id, variation))
    }

    /// Returns the colliders with a change, ascending by id.
    pub fn colliders(&self) -> impl Iterator<Item = (ColliderId, &ColliderVariation)> {
        self.colliders.iter().map(|(&id, variation)| (id, variation))
    }

    /// Returns the springs with a change, ascending by id.
    pub fn springs(&self) -> impl Iterator<Item = (SpringId, &SpringVariation)> {
        self.springs.iter().map(|(&id, variation)| (id, variation))
    }

    /// Returns the derivative in a direction, if this is a gradient.
    pub fn dot(&self, direction: &Self) -> f64 {
        let by_spheres = direction.spheres().map(|(id, it)| self.sphere(id).dot(it));
        let of_colliders = direction.colliders().map(|(id, it)| self.collider(id).dot(it));
        let of_springs = direction.springs().map(|(id, it)| self.spring(id).dot(it));
        self.acceleration.dot(direction.acceleration)
            + by_spheres.sum::<f64>()
            + of_colliders.sum::<f64>()
            + of_springs.sum::<f64>()
    }
}

impl SphereVariation {
    /// Returns the change of the motion of the sphere.
    pub(super) fn motion(&self) -> SphereTangent {
        let Self { position, velocity, angular_velocity, .. } = *self;
        SphereTangent { position, velocity, angular_velocity }
    }

    fn dot(&self, other: &Self) -> f64 {
        self.position.dot(other.position)
            + self.velocity.dot(other.velocity)
            + self.angular_velocity.dot(other.angular_velocity)
            + self.radius * other.radius
            + self.mass * other.mass
            + self.restitution * other.restitution
            + self.friction * other.friction
            + self.acceleration.dot(other.acceleration)
    }
}

impl SpringVariation {
    fn dot(&self, other: &Self) -> f64 {
        self.stiffness * other.stiffness
            + self.rest_length * other.rest_length
            + self.damping * other.damping
    }
}

impl ColliderVariation {
    fn dot(&self, other: &Self) -> f64 {
        self.position.dot(other.position)
            + self.velocity.dot(other.velocity)
            + if other.rotation == DVec3::ZERO { 0.0 } else { self.rotation.dot(other.rotation) }
            + self.restitution * other.restitution
            + self.friction * other.friction
    }
}
