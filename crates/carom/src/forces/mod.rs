//! Forces on spheres.

mod attractor;
mod buoyancy;
mod constant;
mod derivatives;
mod drag;
mod edge;
mod gravity;
mod interaction;
mod interactions;
mod mutual_gravity;
mod nonconservative;
mod quadratic_drag;
#[cfg(feature = "serde")]
pub(crate) mod shipped;
mod spring;
mod vortex;
mod wind;

use std::any::Any;
use std::fmt::Debug;
use std::sync::Arc;

use glam::DVec3;

pub use attractor::PointAttractor;
pub use buoyancy::Buoyancy;
pub use constant::ConstantForce;
pub use derivatives::ForceDerivatives;
pub use drag::ViscousDrag;
pub use edge::ForceEdge;
pub use gravity::Gravity;
pub use interaction::{Interaction, SphereStates};
pub(crate) use interactions::Interactions;
pub use mutual_gravity::MutualGravity;
pub(crate) use nonconservative::{
    are_conservative, conservative_potential, nonconservative_linear, nonconservative_others,
    nonconservative_potential, total_conservative, total_nonconservative,
};
pub use quadratic_drag::QuadraticDrag;
pub(crate) use spring::PullDerivatives;
pub use spring::{Spring, SpringEnd};
pub use vortex::Vortex;
pub use wind::Wind;

use crate::error::InvalidValue;
use crate::numbered::Numbered;

/// A force that acts on every sphere. Forces add up.
///
/// Forces are values without state: to change one, replace it ([`World::set_force`](crate::World::set_force)); the
/// next evaluation uses the new one.
///
/// For reproducible bits an implementation must use no function whose result depends on the
/// platform (`sin`, `exp`, ... of the standard library; take those of the `libm` crate).
///
/// ```
/// use carom::{DVec3, Force, Sphere, SphereState, World};
///
/// /// A spring from the origin to every sphere.
/// #[derive(Debug)]
/// struct Spring {
///     /// In N/m.
///     stiffness: f64,
/// }
///
/// impl Force for Spring {
///     fn on(&self, sphere: &SphereState, _time: f64) -> DVec3 {
///         -self.stiffness * sphere.position
///     }
///
///     fn potential_energy(&self, sphere: &SphereState, _time: f64) -> f64 {
///         0.5 * self.stiffness * sphere.position.length_squared()
///     }
///
///     fn is_conservative(&self) -> bool {
///         true
///     }
/// }
///
/// let mut world = World::default();
/// world.add_force(Spring { stiffness: 1.0 })?;
/// let sphere = world.add_sphere(Sphere::new(DVec3::X, 0.1))?;
/// for _ in 0..100 {
///     world.step(std::f64::consts::PI / 100.0)?;
/// }
/// // Half a period later it is on the other side, with the same energy.
/// assert!((world.sphere(sphere)?.position + DVec3::X).length() < 1e-3);
/// assert!((world.total_energy() - 0.5).abs() < 1e-3);
/// # Ok::<(), carom::Error>(())
/// ```
pub trait Force: Any + Debug + Send + Sync {
    /// Force \[N\] on a sphere in this state, at this time \[s\] of the world's clock.
    fn on(&self, sphere: &SphereState, time: f64) -> DVec3;

    /// The same force as a constant acceleration and a linear drag, for spheres of this `radius`
    /// \[m\] and `mass` \[kg\]; `None` (the default) for a force that depends on more than that.
    ///
    /// The rule `exact` moves spheres under such forces in closed form. Any other force it evaluates some
    /// tens of times in each step of a curved flight, at whatever time and state it needs, not in their
    /// order.
    fn linear(&self, _radius: f64, _mass: f64) -> Option<LinearForce> {
        None
    }

    /// Potential energy \[J\] of a sphere in this state; 0 (the default) where there is none.
    fn potential_energy(&self, _sphere: &SphereState, _time: f64) -> f64 {
        0.0
    }

    /// Whether its potential energy, that of its interaction included, accounts for all of its work; false (the
    /// default) for one that dissipates or drives.
    ///
    /// The work of any other force is measured, and stands in
    /// [`EnergyAccount::forces`](crate::EnergyAccount::forces), less what its potential accounts for.
    fn is_conservative(&self) -> bool {
        false
    }

    /// Planes at which the force on a sphere of this `radius` \[m\] bends or jumps; none by default.
    ///
    /// The rule `exact` ends a step of a curved flight there, so that none misses a field however thin, and all between
    /// are smooth, for derivatives of whole runs, too.
    fn edges(&self, _radius: f64) -> Vec<ForceEdge> {
        Vec::new()
    }

    /// Derivatives of [`Self::on`] by the state of the sphere, for derivatives of whole runs; `None` (the default)
    /// where they are not known.
    fn derivatives(&self, _sphere: &SphereState, _time: f64) -> Option<ForceDerivatives> {
        None
    }

    /// The forces between spheres, besides the force on each by itself; `None` (the default) for none.
    fn interaction(&self) -> Option<&dyn Interaction> {
        None
    }

    /// Checks the parameters; called once, when the force is added to a world.
    ///
    /// # Errors
    /// The field, what it must be and what it is.
    fn validate(&self) -> Result<(), InvalidValue> {
        Ok(())
    }
}

/// A force `m a - m c v`: a constant acceleration a, and a drag of rate c.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearForce {
    /// a \[m/s²\]
    pub acceleration: DVec3,
    /// c, the coefficient of drag divided by the mass \[1/s\], >= 0.
    pub drag_rate: f64,
}

/// State of a sphere, on which a force may depend.
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

/// Sum of all forces \[N\] on a sphere, added in the order in which they entered the world.
pub(crate) fn total(forces: &Numbered<Arc<dyn Force>>, sphere: &SphereState, time: f64) -> DVec3 {
    forces.iter().fold(DVec3::ZERO, |sum, (_, force)| sum + force.on(sphere, time))
}

/// Sum of all linear forces on spheres of this `radius` \[m\] and `mass` \[kg\], added in the order in
/// which they entered the world, and whether there are no others.
pub(crate) fn total_linear(
    forces: &Numbered<Arc<dyn Force>>,
    radius: f64,
    mass: f64,
) -> (LinearForce, bool) {
    sum_of_linear(forces.iter().map(|(_, force)| &**force), radius, mass)
}

/// Sum of those of some forces that are linear for spheres of this `radius` \[m\] and `mass` \[kg\], added in
/// their order, and whether there are no others.
fn sum_of_linear<'a>(
    forces: impl Iterator<Item = &'a dyn Force>,
    radius: f64,
    mass: f64,
) -> (LinearForce, bool) {
    let mut total = LinearForce { acceleration: DVec3::ZERO, drag_rate: 0.0 };
    let mut is_all = true;
    for force in forces {
        match linear_form(force, radius, mass) {
            Some(linear) => {
                total.acceleration += linear.acceleration;
                total.drag_rate += linear.drag_rate;
            }
            None => is_all = false,
        }
    }
    (total, is_all)
}

/// Whether all forces have a linear form, for spheres of a usual size.
pub(crate) fn are_linear(forces: &Numbered<Arc<dyn Force>>) -> bool {
    forces.iter().all(|(_, force)| linear_form(&**force, 1.0, 1.0).is_some())
}

/// The linear form of a force, if it has one that motion in closed form is made for: a drag that
/// drives is not.
fn linear_form(force: &dyn Force, radius: f64, mass: f64) -> Option<LinearForce> {
    let is_usable = |linear: &LinearForce| {
        linear.acceleration.is_finite() && linear.drag_rate >= 0.0 && linear.drag_rate.is_finite()
    };
    force.linear(radius, mass).filter(is_usable)
}

/// The forces that are not linear for spheres of this `radius` \[m\] and `mass` \[kg\].
pub(crate) fn without_linear_form(
    forces: &Numbered<Arc<dyn Force>>,
    radius: f64,
    mass: f64,
) -> Vec<&dyn Force> {
    let others = forces.iter().map(|(_, force)| &**force);
    others.filter(|force| linear_form(*force, radius, mass).is_none()).collect()
}

/// Sum of the forces \[N\] that are not linear on a sphere.
pub(crate) fn total_of_others(
    forces: &Numbered<Arc<dyn Force>>,
    sphere: &SphereState,
    time: f64,
) -> DVec3 {
    let others =
        forces.iter().filter(|(_, f)| linear_form(&***f, sphere.radius, sphere.mass).is_none());
    others.fold(DVec3::ZERO, |sum, (_, force)| sum + force.on(sphere, time))
}
