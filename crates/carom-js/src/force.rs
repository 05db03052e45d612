//! Forces as scene files describe them.

use carom::{ConstantForce, Error, ForceId, Gravity, ViscousDrag, World};
use carom_scene::scene::Force;

/// Adds a force to a world.
///
/// # Errors
/// As [`World::add_force`].
pub fn add(world: &mut World, force: &Force) -> Result<ForceId, Error> {
    match *force {
        Force::Constant { force } => world.add_force(ConstantForce::new(force.into())),
        Force::Gravity { acceleration } => world.add_force(Gravity::new(acceleration.into())),
        Force::ViscousDrag { coefficient } => world.add_force(ViscousDrag::new(coefficient)),
    }
}

/// Puts a force in the place of another.
///
/// # Errors
/// As [`World::set_force`].
pub fn set(world: &mut World, id: ForceId, force: &Force) -> Result<(), Error> {
    match *force {
        Force::Constant { force } => world.set_force(id, ConstantForce::new(force.into())),
        Force::Gravity { acceleration } => world.set_force(id, Gravity::new(acceleration.into())),
        Force::ViscousDrag { coefficient } => world.set_force(id, ViscousDrag::new(coefficient)),
    }
}
