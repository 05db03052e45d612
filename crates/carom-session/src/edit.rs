//! Everything that can be changed while a scene runs.

use carom::{
    ColliderId, DVec3, Emitter, EmitterId, ForceId, Friction, Mass, SphereId, Spring, SpringId,
};
use carom_scene::scene::{Color, Force, Simulation};

/// A change from outside.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Edit {
    /// How the scene is stepped: the rule and its parameters, the frame time, ...
    Simulation(Box<Simulation>),
    /// Length of a frame \[s\], alone.
    FrameTime(f64),
    /// Another force in the place of one.
    Force(ForceId, Force),
    /// One more force.
    AddForce(Force),
    /// A force less.
    RemoveForce(ForceId),
    /// Another spring in the place of one.
    Spring(SpringId, Spring),
    /// One more spring.
    AddSpring(Spring),
    /// A spring less; its spheres stay.
    RemoveSpring(SpringId),
    /// Coefficient of restitution of a collider.
    ColliderRestitution(ColliderId, f64),
    /// Coefficient of restitution of all colliders.
    AllColliderRestitutions(f64),
    /// What a collider says of friction.
    ColliderFriction(ColliderId, Friction),
    /// What all colliders say of friction.
    AllColliderFrictions(Friction),
    /// An emitter. With another period it starts anew, now.
    Emitter(EmitterId, Box<Emitter>),
    /// A sphere.
    Sphere(SphereId, Box<SphereChange>),
    /// A new sphere; it may overlap others.
    Throw {
        /// As it starts.
        sphere: Box<carom::Sphere>,
        /// Its colour; by density or the scene's own without one.
        color: Option<Color>,
    },
    /// A sphere less.
    RemoveSphere(SphereId),
}

/// What changes of a sphere; the rest stays as it is when the change comes, so that a sphere which
/// moves on meanwhile is not set back.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SphereChange {
    /// Centre \[m\].
    pub position: Option<DVec3>,
    /// Velocity \[m/s\].
    pub velocity: Option<DVec3>,
    /// Radius \[m\], > 0; the mass stays.
    pub radius: Option<f64>,
    /// Mass \[kg\], > 0.
    pub mass: Option<f64>,
    /// Coefficient of restitution in \[0, 1\].
    pub restitution: Option<f64>,
    /// All that it says of friction.
    pub friction: Option<Friction>,
    /// Angular velocity, along the axis of rotation \[rad/s\].
    pub angular_velocity: Option<DVec3>,
}

impl SphereChange {
    /// The sphere, changed.
    pub(crate) fn of(&self, sphere: carom::Sphere) -> carom::Sphere {
        sphere
            .with_position(self.position.unwrap_or(sphere.position))
            .with_velocity(self.velocity.unwrap_or(sphere.velocity))
            .with_radius(self.radius.unwrap_or(sphere.radius))
            .with_mass(self.mass.map_or(sphere.mass, Mass::Kilograms))
            .with_restitution(self.restitution.unwrap_or(sphere.restitution))
            .with_friction(self.friction.unwrap_or(sphere.friction))
            .with_angular_velocity(self.angular_velocity.unwrap_or(sphere.angular_velocity))
    }

    /// This change, then a later one.
    fn then(&self, later: &Self) -> Self {
        Self {
            position: later.position.or(self.position),
            velocity: later.velocity.or(self.velocity),
            radius: later.radius.or(self.radius),
            mass: later.mass.or(self.mass),
            restitution: later.restitution.or(self.restitution),
            friction: later.friction.or(self.friction),
            angular_velocity: later.angular_velocity.or(self.angular_velocity),
        }
    }
}

impl Edit {
    /// What of it makes sense at the beginning of a run, whenever it was made: how things are, not
    /// where they are; `None` if nothing does.
    pub(crate) fn value(&self) -> Option<Self> {
        match self {
            Self::Throw { .. } | Self::RemoveSphere(_) => None,
            // As the spheres that they join.
            Self::AddSpring(_) | Self::RemoveSpring(_) => None,
            Self::Sphere(id, change) => {
                let SphereChange { radius, mass, restitution, friction, .. } = **change;
                let value =
                    SphereChange { radius, mass, restitution, friction, ..Default::default() };
                (value != SphereChange::default()).then(|| Self::Sphere(*id, Box::new(value)))
            }
            other => Some(other.clone()),
        }
    }

    /// One edit instead of this one and a `later` one right after it; `None` if it takes both.
    pub fn merged(&self, later: &Self) -> Option<Self> {
        match (self, later) {
            (Self::Sphere(id, change), Self::Sphere(same, next)) if id == same => {
                Some(Self::Sphere(*id, Box::new(change.then(next))))
            }
            (Self::Simulation(_), Self::Simulation(_))
            | (Self::FrameTime(_), Self::FrameTime(_))
            | (Self::AllColliderRestitutions(_), Self::AllColliderRestitutions(_))
            | (Self::AllColliderFrictions(_), Self::AllColliderFrictions(_)) => Some(later.clone()),
            (Self::Force(id, _), Self::Force(same, _)) if id == same => Some(later.clone()),
            (Self::Spring(id, _), Self::Spring(same, _)) if id == same => Some(later.clone()),
            (Self::Emitter(id, _), Self::Emitter(same, _)) if id == same => Some(later.clone()),
            (Self::ColliderRestitution(id, _), Self::ColliderRestitution(same, _))
                if id == same =>
            {
                Some(later.clone())
            }
            (Self::ColliderFriction(id, _), Self::ColliderFriction(same, _)) if id == same => {
                Some(later.clone())
            }
            _ => None,
        }
    }
}
