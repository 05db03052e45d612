//! What programs do with the physics as a whole.

use bevy_ecs::world::World;

use crate::plugin::PhysicsSchedule;
use crate::rollback::{self, PhysicsSnapshot, RollbackError};

/// The physics of a Bevy [`World`] as a whole; in systems by `Commands::queue`.
///
/// All methods but [`Self::roll_back`] panic, as `World::resource` does, without
/// [`CaromPlugin`](crate::CaromPlugin).
pub trait PhysicsWorldExt {
    /// Takes one step of the physics now, of the fixed timestep.
    fn step_physics(&mut self);

    /// Returns the present state of the physics.
    fn physics_snapshot(&self) -> PhysicsSnapshot;

    /// Restores a state, bit for bit. Bodies that were not there are despawned. Those that are gone are spawned again
    /// with the components of this crate, as other entities; what draws them is added where a program looks for
    /// `Added<Ball>`.
    fn restore_physics(&mut self, snapshot: &PhysicsSnapshot);

    /// Restores the state after this many steps from [`Rollback`](crate::Rollback), as [`Self::restore_physics`], and
    /// drops later ones.
    ///
    /// # Errors
    /// [`RollbackError`] if it is not kept.
    fn roll_back(&mut self, frame: u64) -> Result<(), RollbackError>;

    /// Replaces the physics by a scene: every body gets an entity. The forces are those of the scene, so
    /// [`Gravity`](crate::Gravity) is removed; steps are as long as its frames, and so is the fixed timestep.
    ///
    /// # Errors
    /// Those of [`Scene::world`](carom_scene::Scene::world).
    #[cfg(feature = "scene")]
    fn load_physics_scene(
        &mut self,
        scene: &carom_scene::Scene,
    ) -> Result<(), carom_scene::SceneError>;
}

impl PhysicsWorldExt for World {
    fn step_physics(&mut self) {
        self.run_schedule(PhysicsSchedule);
    }

    fn physics_snapshot(&self) -> PhysicsSnapshot {
        PhysicsSnapshot::of(self)
    }

    fn restore_physics(&mut self, snapshot: &PhysicsSnapshot) {
        snapshot.restore(self);
    }

    fn roll_back(&mut self, frame: u64) -> Result<(), RollbackError> {
        rollback::roll_back(self, frame)
    }

    #[cfg(feature = "scene")]
    fn load_physics_scene(
        &mut self,
        scene: &carom_scene::Scene,
    ) -> Result<(), carom_scene::SceneError> {
        crate::scene::load(self, scene)
    }
}
