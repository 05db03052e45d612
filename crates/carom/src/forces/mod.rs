//! What accelerates spheres.

mod constant;
mod drag;
mod gravity;

use std::fmt::{self, Debug, Display};
use std::sync::Arc;

use glam::DVec3;

pub use constant::ConstantForce;
pub use drag::ViscousDrag;
pub use gravity::Gravity;

use crate::error::InvalidValue;
use crate::numbered::Numbered;

/// A force that acts on every sphere. Several add up.
///
/// Forces are values without memory: to change one, put another in its place
/// ([`World::set_force`](crate::World::set_force)); the next evaluation uses it.
///
/// For reproducible bits an implementation must use no function whose result depends on the
/// platform (`sin`, `exp`, ... of the standard library; take those of the `libm` crate).
pub trait Force: Debug + Send + Sync {
    /// Force \[N\] on a sphere in this state, at this time \[s\] of the world's clock.
    fn on(&self, sphere: &SphereState, time: f64) -> DVec3;

    /// Potential energy \[J\] of a sphere in this state; 0 (the default) where there is none.
    fn potential_energy(&self, _sphere: &SphereState, _time: f64) -> f64 {
        0.0
    }

    /// Refuses parameters that make no sense; asked once, when the force enters a world.
    ///
    /// # Errors
    /// The field, what it must be and what it is.
    fn validate(&self) -> Result<(), InvalidValue> {
        Ok(())
    }
}

/// What a force may depend on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SphereState {
    /// Centre \[m\].
    pub position: DVec3,
    /// Velocity \[m/s\].
    pub velocity: DVec3,
    /// Radius \[m\].
    pub radius: f64,
    /// Mass \[kg\].
    pub mass: f64,
}

/// Names a force of a world.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ForceId(pub(crate) usize);

impl Display for ForceId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Display::fmt(&self.0, f)
    }
}

/// Sum of all forces \[N\] on a sphere, added in the order in which they entered the world.
pub(crate) fn total(forces: &Numbered<Arc<dyn Force>>, sphere: &SphereState, time: f64) -> DVec3 {
    forces.iter().fold(DVec3::ZERO, |sum, (_, force)| sum + force.on(sphere, time))
}
