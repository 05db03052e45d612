//! The state of a world as a value, to restore and to compare.

use super::World;
#[cfg(feature = "serde")]
use crate::forces::shipped;
use crate::hash::{self, StateHash};
#[cfg(feature = "serde")]
use crate::id::ForceId;
use crate::id::SphereId;
use crate::sphere::Sphere;
use crate::state::State;

/// The state of a world at one moment, to restore.
///
/// It holds everything that later steps depend on, with settings, forces, colliders and emitters.
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
///
/// With the feature `serde` it can be serialized, in any format that keeps every bit of a number: a world
/// restored from it continues like the original. The format differs between versions of this crate, so the
/// same version must read it. A force that is not one of this crate's is refused
/// ([`Self::foreign_force`]). The bytes are not checked: read only what you trust.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Snapshot(State);

impl Snapshot {
    /// Time of the world at the snapshot \[s\].
    pub fn time(&self) -> f64 {
        self.0.clock.seconds()
    }

    /// A sphere at the snapshot; `None` if it was not in the world.
    pub fn sphere(&self, id: SphereId) -> Option<Sphere> {
        let spheres = &self.0.spheres;
        spheres.index_of(id).map(|index| spheres.get(index))
    }
}

#[cfg(feature = "serde")]
impl Snapshot {
    /// The first force that cannot be serialized because it is not one of this crate's.
    pub fn foreign_force(&self) -> Option<ForceId> {
        shipped::first_foreign(&self.0.forces).map(ForceId)
    }
}

impl World {
    /// The state as one number, to compare worlds to the bit.
    pub fn state_hash(&self) -> StateHash {
        hash::of_state(&self.state)
    }

    /// Returns everything that later steps depend on, to restore it later.
    pub fn snapshot(&self) -> Snapshot {
        Snapshot(self.state.clone())
    }

    /// Takes a snapshot into the memory of an earlier one, which is overwritten. Where the world has as much to
    /// keep as before, this allocates little or nothing: for a ring of the last frames, to go back to.
    ///
    /// ```
    /// use carom::{DVec3, Sphere, World};
    ///
    /// let mut world = World::default();
    /// world.add_sphere(Sphere::new(DVec3::ZERO, 0.5).with_velocity(DVec3::X))?;
    /// let mut snapshot = world.snapshot();
    /// for _ in 0..3 {
    ///     world.snapshot_into(&mut snapshot);
    ///     world.step(1.0)?;
    /// }
    /// world.restore(&snapshot);
    /// assert_eq!(world.time(), 2.0);
    /// # Ok::<(), carom::Error>(())
    /// ```
    pub fn snapshot_into(&self, snapshot: &mut Snapshot) {
        snapshot.0.clone_from(&self.state);
    }

    /// Restores a snapshot, bit for bit, into the memory of the present state. The report of the last step is lost.
    pub fn restore(&mut self, snapshot: &Snapshot) {
        self.state.clone_from(&snapshot.0);
        self.report.clear();
    }
}
