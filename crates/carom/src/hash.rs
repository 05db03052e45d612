//! The state hash: one number to compare the states of two worlds, to the bit.

use std::fmt::{self, Display};

use glam::DVec3;
use xxhash_rust::xxh3::Xxh3Default;

use crate::state::State;

/// Hash of a world's state: XXH3 (64 bits) over the bits of all quantities that steps change.
///
/// It covers the time; of every sphere id, position, velocity, radius, mass and restitution; the
/// places of colliders; what each emitter has emitted; and how spheres are turned and turn, if one
/// does. Settings, forces, shapes and other
/// parameters are not part of it: it compares worlds that were set up alike. Equal states have
/// equal hashes on every platform; one changed bit changes the hash.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct StateHash(pub u64);

impl Display for StateHash {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

/// Hashes, in this order: the two parts of the clock's sum; the next id; the number of spheres; per
/// sphere its id, position, velocity, radius, mass, restitution; the number of colliders; per
/// collider its position and rotation; per emitter its start, the number of spheres emitted, and
/// the number and ids of those that still count; if a sphere is turned or turns, per sphere its
/// orientation and angular velocity.
pub(crate) fn of_state(state: &State) -> StateHash {
    let mut words = Words(Xxh3Default::new());
    state.clock.parts().into_iter().for_each(|part| words.number(part));
    words.integer(state.next_id);
    let spheres = &state.spheres;
    words.integer(spheres.len() as u64);
    for (i, id) in spheres.ids().iter().enumerate() {
        words.integer(id.number());
        words.vector(spheres.positions()[i]);
        words.vector(spheres.velocities()[i]);
        words.number(spheres.radii()[i]);
        words.number(spheres.masses()[i]);
        words.number(spheres.restitutions()[i]);
    }
    words.integer(state.colliders.list().iter().len() as u64);
    for (_, collider) in state.colliders.list().iter() {
        words.vector(collider.pose.position);
        collider.pose.rotation.to_array().into_iter().for_each(|part| words.number(part));
    }
    for (_, emitter) in state.emitters.iter() {
        words.number(emitter.start);
        words.integer(emitter.emitted);
        words.integer(emitter.ring.len() as u64);
        emitter.ring.iter().for_each(|id| words.integer(id.number()));
    }
    let spin = &spheres.motion.spin;
    if spin.is_any() {
        for (orientation, &angular_velocity) in spin.orientation.iter().zip(&spin.angular_velocity)
        {
            orientation.to_array().into_iter().for_each(|part| words.number(part));
            words.vector(angular_velocity);
        }
    }
    StateHash(words.0.digest())
}

/// Feeds numbers to the hash in little-endian order, whatever the machine's.
struct Words(Xxh3Default);

impl Words {
    fn integer(&mut self, value: u64) {
        self.0.update(&value.to_le_bytes());
    }

    fn number(&mut self, value: f64) {
        self.integer(value.to_bits());
    }

    fn vector(&mut self, value: DVec3) {
        value.to_array().into_iter().for_each(|part| self.number(part));
    }
}
