//! Forces of scene files in worlds.

use carom::{ConstantForce, Error, ForceId, Gravity, ViscousDrag, World};

use crate::scene::Force;

impl Force {
    /// Adds this force to a world.
    ///
    /// # Errors
    /// As [`World::add_force`].
    pub fn add_to(&self, world: &mut World) -> Result<ForceId, Error> {
        match *self {
            Self::Constant { force } => world.add_force(ConstantForce::new(force.into())),
            Self::Gravity { acceleration } => world.add_force(Gravity::new(acceleration.into())),
            Self::ViscousDrag { coefficient } => world.add_force(ViscousDrag::new(coefficient)),
        }
    }

    /// Puts this force in the place of another.
    ///
    /// # Errors
    /// As [`World::set_force`].
    pub fn replace_in(&self, world: &mut World, id: ForceId) -> Result<(), Error> {
        match *self {
            Self::Constant { force } => world.set_force(id, ConstantForce::new(force.into())),
            Self::Gravity { acceleration } => {
                world.set_force(id, Gravity::new(acceleration.into()))
            }
            Self::ViscousDrag { coefficient } => world.set_force(id, ViscousDrag::new(coefficient)),
        }
    }
}
