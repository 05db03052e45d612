//! A small change of what a world starts with.

use std::collections::BTreeMap;

use glam::DVec3;

use super::state::SphereTangent;
use crate::id::{ColliderId, SphereId};

/// A change of what a world starts with: a direction in which derivatives are taken. Also a gradient: the
/// derivatives of one number by all of that.
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
    /// Of the acceleration of all spheres: that of gravity \[m/s²\].
    pub acceleration: DVec3,
}

/// A change of a sphere at the start.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[non_exhaustive]
pub struct SphereVariation {
    /// Of its centre \[m\].
    pub position: DVec3,
    /// Of its velocity \[m/s\].
    pub velocity: DVec3,
    /// Of its angular velocity \[rad/s\].
    pub angular_velocity: DVec3,
    /// Of its radius \[m\], with the mass as it is.
    pub radius: f64,
    /// Of its mass \[kg\], with the radius as it is.
    pub mass: f64,
    /// Of its coefficient of restitution.
    pub restitution: f64,
    /// Of its coefficient of sliding friction.
    pub friction: f64,
}

/// A change of a collider at the start.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[non_exhaustive]
pub struct ColliderVariation {
    /// Of its place \[m\]: it is shifted as a whole.
    pub position: DVec3,
    /// Of its velocity \[m/s\].
    pub velocity: DVec3,
    /// Of its coefficient of restitution.
    pub restitution: f64,
    /// Of its coefficient of sliding friction.
    pub friction: f64,
}

impl Variation {
    /// The same with this change of the centre of a sphere \[m\].
    pub fn with_position(mut self, sphere: SphereId, position: DVec3) -> Self {
        self.sphere_mut(sphere).position = position;
        self
    }

    /// The same with this change of the velocity of a sphere \[m/s\].
    pub fn with_velocity(mut self, sphere: SphereId, velocity: DVec3) -> Self {
        self.sphere_mut(sphere).velocity = velocity;
        self
    }

    /// The same with this change of the angular velocity of a sphere \[rad/s\].
    pub fn with_angular_velocity(mut self, sphere: SphereId, angular_velocity: DVec3) -> Self {
        self.sphere_mut(sphere).angular_velocity = angular_velocity;
        self
    }

    /// The same with this change of the acceleration of all spheres \[m/s²\].
    pub fn with_acceleration(mut self, acceleration: DVec3) -> Self {
        self.acceleration = acceleration;
        self
    }

    /// The change of a sphere; nothing, if it is not named.
    pub fn sphere(&self, sphere: SphereId) -> SphereVariation {
        self.spheres.get(&sphere).copied().unwrap_or_default()
    }

    /// The change of a sphere, to be set.
    pub fn sphere_mut(&mut self, sphere: SphereId) -> &mut SphereVariation {
        self.spheres.entry(sphere).or_default()
    }

    /// The change of a collider; nothing, if it is not named.
    pub fn collider(&self, collider: ColliderId) -> ColliderVariation {
        self.colliders.get(&collider).copied().unwrap_or_default()
    }

    /// The change of a collider, to be set.
    pub fn collider_mut(&mut self, collider: ColliderId) -> &mut ColliderVariation {
        self.colliders.entry(collider).or_default()
    }

    /// The spheres that are named, ascending.
    pub fn spheres(&self) -> impl Iterator<Item = (SphereId, &SphereVariation)> {
        self.spheres.iter().map(|(&id, variation)| (id, variation))
    }

    /// The colliders that are named, ascending.
    pub fn colliders(&self) -> impl Iterator<Item = (ColliderId, &ColliderVariation)> {
        self.colliders.iter().map(|(&id, variation)| (id, variation))
    }

    /// The derivative in a direction, if this is a gradient.
    pub fn dot(&self, direction: &Self) -> f64 {
        let of_spheres = direction.spheres().map(|(id, it)| self.sphere(id).dot(it));
        let of_colliders = direction.colliders().map(|(id, it)| self.collider(id).dot(it));
        self.acceleration.dot(direction.acceleration)
            + of_spheres.sum::<f64>()
            + of_colliders.sum::<f64>()
    }
}

impl SphereVariation {
    /// How its motion changes.
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
    }
}

impl ColliderVariation {
    fn dot(&self, other: &Self) -> f64 {
        self.position.dot(other.position)
            + self.velocity.dot(other.velocity)
            + self.restitution * other.restitution
            + self.friction * other.friction
    }
}
