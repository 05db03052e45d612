//! The state of a world as a value: to return to, and to compare by.

use super::World;
use crate::bodies::Sphere;
use crate::hash::{self, StateHash};
use crate::id::SphereId;
use crate::state::State;

/// The state of a world at one moment, to return to.
///
/// Holds all that the future depends on, parameters too: settings, forces, colliders, emitters.
///
/// ```
/// use carom::{DVec3, Sphere, World};
///
/// let mut world = World::default();
/// world.add_sphere(Sphere::new(DVec3::ZERO, 0.5).with_velocity(DVec3::X))?;
/// world.step(1.0)?;
/// let (snapshot, hash) = (world.snapshot(), world.state_hash());
/// world.step(1.0)?;
/// world.restore(&snapshot);
/// assert_eq!(world.state_hash(), hash);
/// assert_eq!(world.time(), 1.0);
/// # Ok::<(), carom::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Snapshot(State);

impl Snapshot {
    /// Time of the world then \[s\].
    pub fn time(&self) -> f64 {
        self.0.clock.seconds()
    }

    /// A sphere as it was then; `None` if it was not in the world.
    pub fn sphere(&self, id: SphereId) -> Option<Sphere> {
        let spheres = &self.0.spheres;
        spheres.index_of(id).map(|index| spheres.get(index))
    }
}

impl World {
    /// The state as one number, to compare worlds to the bit.
    pub fn state_hash(&self) -> StateHash {
        hash::of_state(&self.state)
    }

    /// Everything the future depends on, to return to.
    pub fn snapshot(&self) -> Snapshot {
        Snapshot(self.state.clone())
    }

    /// Returns to a snapshot, bit for bit. The report of the last step is gone.
    pub fn restore(&mut self, snapshot: &Snapshot) {
        self.state.clone_from(&snapshot.0);
        self.report.clear();
    }
}
