//! Edits of a running scene.

use carom::{
    ColliderId, DVec3, Emitter, EmitterId, ForceId, Friction, Mass, Pose, SphereId, Spring,
    SpringId,
};
use carom_scene::scene::{Color, Force, Simulation};

/// An edit of a running scene.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Edit {
    /// Sets the simulation: the rule, its parameters, the frame time, ...
    Simulation(Box<Simulation>),
    /// Sets the length of a frame \[s\] only.
    FrameTime(f64),
    /// Replaces a force.
    Force(ForceId, Force),
    /// Adds a force.
    AddForce(Force),
    /// Removes a force.
    RemoveForce(ForceId),
    /// Replaces a spring.
    Spring(SpringId, Spring),
    /// Adds a spring.
    AddSpring(Spring),
    /// Removes a spring; its spheres stay.
    RemoveSpring(SpringId),
    /// Sets the coefficient of restitution of a collider.
    ColliderRestitution(ColliderId, f64),
    /// Sets the coefficient of restitution of all colliders.
    AllColliderRestitutions(f64),
    /// Sets the coefficient of restitution of all colliders with this group name, see
    /// [`group_name`](crate::group_name).
    NamedColliderRestitutions(String, f64),
    /// Sets the friction of a collider.
    ColliderFriction(ColliderId, Friction),
    /// Sets the friction of all colliders.
    AllColliderFrictions(Friction),
    /// Sets the friction of all colliders with this group name, see
    /// [`group_name`](crate::group_name).
    NamedColliderFrictions(String, Friction),
    /// Puts a collider elsewhere; one with a motion moves on from there in the same way.
    ColliderPose(ColliderId, Pose),
    /// Scales a collider of triangles: a mesh to this factor of its vertices, a height field to this length along x
    /// \[m\], a track to this radius of its gutter \[m\].
    ColliderScale(ColliderId, f64),
    /// Replaces an emitter. If its period changes, it starts again now.
    Emitter(EmitterId, Box<Emitter>),
    /// Changes a sphere.
    Sphere(SphereId, Box<SphereChange>),
    /// Adds a sphere; it may overlap others.
    Throw {
        /// The new sphere.
        sphere: Box<carom::Sphere>,
        /// Colour of the sphere; `None` for the colour of its density or the scene's default.
        color: Option<Color>,
    },
    /// Removes a sphere.
    RemoveSphere(SphereId),
}

/// Changed properties of a sphere. The others keep the values that they have when the edit is made,
/// so that a sphere which has moved in the meantime is not set back.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SphereChange {
    /// Centre \[m\].
    pub position: Option<DVec3>,
    /// Velocity \[m/s\].
    pub velocity: Option<DVec3>,
    /// Radius \[m\], > 0; the mass does not change.
    pub radius: Option<f64>,
    /// Mass \[kg\], > 0.
    pub mass: Option<f64>,
    /// Coefficient of restitution in \[0, 1\].
    pub restitution: Option<f64>,
    /// All coefficients of friction.
    pub friction: Option<Friction>,
    /// Angular velocity, along the axis of rotation \[rad/s\].
    pub angular_velocity: Option<DVec3>,
}

impl SphereChange {
    /// Returns the changed sphere.
    ///
    /// A coefficient that is set takes the sphere out of its material, whose pairs would override it.
    pub(crate) fn of(&self, sphere: carom::Sphere) -> carom::Sphere {
        let is_set = self.restitution.is_some() || self.friction.is_some();
        let material = if is_set { 0 } else { sphere.material };
        let changed = sphere
            .with_material(material)
            .with_position(self.position.unwrap_or(sphere.position))
            .with_velocity(self.velocity.unwrap_or(sphere.velocity))
            .with_radius(self.radius.unwrap_or(sphere.radius))
            .with_mass(self.mass.map_or(sphere.mass, Mass::Kilograms))
            .with_friction(self.friction.unwrap_or(sphere.friction))
            .with_angular_velocity(self.angular_velocity.unwrap_or(sphere.angular_velocity));
        self.restitution.map_or(changed, |restitution| changed.with_restitution(restitution))
    }

    /// Combines this change with a later one.
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
    /// Reduces the edit to properties that can be set at the beginning of a run, without positions
    /// and motion; `None` if nothing remains.
    pub(crate) fn value(&self) -> Option<Self> {
        match self {
            Self::Throw { .. } | Self::RemoveSphere(_) | Self::ColliderPose(..) => None,
            // Springs depend on the spheres that they join.
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

    /// Merges this edit with a `later` one that directly follows it; `None` if both are needed.
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
            (Self::ColliderPose(id, _), Self::ColliderPose(same, _)) if id == same => {
                Some(later.clone())
            }
            (Self::ColliderScale(id, _), Self::ColliderScale(same, _)) if id == same => {
                Some(later.clone())
            }
            (
                Self::NamedColliderRestitutions(name, _),
                Self::NamedColliderRestitutions(same, _),
            )
            | (Self::NamedColliderFrictions(name, _), Self::NamedColliderFrictions(same, _))
                if name == same =>
            {
                Some(later.clone())
            }
            _ => None,
        }
    }
}
