//! Converts numbers from JavaScript into ids of a world.

use carom::{ColliderId, EmitterId, ForceId, SphereId, SpringId, World};

use crate::failure::Failure;

/// Returns the id of a sphere and its index in the arrays.
pub fn sphere(world: &World, number: f64) -> Result<(SphereId, usize), Failure> {
    let ids = world.spheres().ids();
    let found = ids.binary_search_by(|id| (id.number() as f64).total_cmp(&number));
    found.map(|index| (ids[index], index)).map_err(|_| unknown("sphere", number))
}

/// Returns the id of a collider and its position in the order.
pub fn collider(world: &World, number: f64) -> Result<(ColliderId, usize), Failure> {
    let mut ids = world.colliders().map(|(id, _)| id).zip(0..);
    ids.find(|(id, _)| id.number() as f64 == number).ok_or_else(|| unknown("collider", number))
}

/// Returns the id of a force and its position in the order.
pub fn force(world: &World, number: f64) -> Result<(ForceId, usize), Failure> {
    let mut ids = world.forces().map(|(id, _)| id).zip(0..);
    ids.find(|(id, _)| id.number() as f64 == number).ok_or_else(|| unknown("force", number))
}

/// Returns the id of an emitter and its position in the order.
pub fn emitter(world: &World, number: f64) -> Result<(EmitterId, usize), Failure> {
    let mut ids = world.emitters().map(|(id, _)| id).zip(0..);
    ids.find(|(id, _)| id.number() as f64 == number).ok_or_else(|| unknown("emitter", number))
}

/// Returns the id of a spring.
pub fn spring(world: &World, number: f64) -> Result<SpringId, Failure> {
    let mut ids = world.springs().map(|(id, _)| id);
    ids.find(|id| id.number() as f64 == number).ok_or_else(|| unknown("spring", number))
}

/// Returns a failure with the text of [`carom::Error::Unknown`].
fn unknown(kind: &str, number: f64) -> Failure {
    Failure::new(format!("there is no {kind} {number} in this world"))
}
