//! Adds forces of scene files to worlds.

use carom::{
    Buoyancy, ConstantForce, Error, ForceId, Gravity, MutualGravity, PointAttractor, QuadraticDrag,
    ViscousDrag, Vortex, Wind, World,
};

use crate::scene::Force;
use crate::scene::values::vector;

impl Force {
    /// Adds this force to a world.
    ///
    /// # Errors
    /// The same as those of [`World::add_force`].
    pub fn add_to(&self, world: &mut World) -> Result<ForceId, Error> {
        self.give_to(Add(world))
    }

    /// Replaces the force `id` of a world by this one.
    ///
    /// # Errors
    /// The same as those of [`World::set_force`].
    pub fn replace_in(&self, world: &mut World, id: ForceId) -> Result<(), Error> {
        self.give_to(Replace(world, id))
    }

    /// Creates the force of `carom` and passes it to `taker`.
    fn give_to<T: Taker>(&self, taker: T) -> Result<T::Answer, Error> {
        match *self {
            Self::Constant { force } => taker.take(ConstantForce::new(vector(force))),
            Self::Gravity { acceleration } => taker.take(Gravity::new(vector(acceleration))),
            Self::ViscousDrag { coefficient } => taker.take(ViscousDrag::new(coefficient)),
            Self::PointAttractor { position, gravitational_parameter, softening } => taker.take(
                PointAttractor::new(vector(position), gravitational_parameter)
                    .with_softening(softening),
            ),
            Self::MutualGravity { constant, softening, opening_angle } => taker.take(
                MutualGravity::new(constant)
                    .with_softening(softening)
                    .with_opening_angle(opening_angle),
            ),
            Self::Wind { velocity, coefficient } => {
                taker.take(Wind::new(vector(velocity), coefficient))
            }
            Self::Vortex { position, axis, circulation, core_radius, coefficient } => taker.take(
                Vortex::new(vector(position), circulation, coefficient)
                    .with_axis(vector(axis))
                    .with_core_radius(core_radius),
            ),
            Self::QuadraticDrag { density, drag_coefficient, viscosity, wind } => taker.take(
                QuadraticDrag::new(density)
                    .with_drag_coefficient(drag_coefficient)
                    .with_viscosity(viscosity)
                    .with_wind(vector(wind)),
            ),
            Self::Buoyancy { density, surface_height, gravity } => {
                taker.take(Buoyancy::new(density, surface_height).with_gravity(vector(gravity)))
            }
        }
    }
}

/// Uses a force of any type.
trait Taker {
    type Answer;

    fn take(self, force: impl carom::Force + 'static) -> Result<Self::Answer, Error>;
}

/// Adds the force to a world.
struct Add<'a>(&'a mut World);

/// Replaces a force of a world.
struct Replace<'a>(&'a mut World, ForceId);

impl Taker for Add<'_> {
    type Answer = ForceId;

    fn take(self, force: impl carom::Force + 'static) -> Result<ForceId, Error> {
        self.0.add_force(force)
    }
}

impl Taker for Replace<'_> {
    type Answer = ();

    fn take(self, force: impl carom::Force + 'static) -> Result<(), Error> {
        self.0.set_force(self.1, force)
    }
}
