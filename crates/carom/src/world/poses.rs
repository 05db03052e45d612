//! Colliders that programs move.

use super::World;
use crate::collider::Collider;
use crate::error::{Error, Subject};
use crate::id::ColliderId;
use crate::pose::Pose;
use crate::rotation;
use crate::validate;

impl World {
    /// Moves a collider to a pose at once: spheres feel no velocity of this change. The pose at rest of a motion in
    /// closed form moves with it.
    ///
    /// # Errors
    /// As [`Self::set_collider`].
    pub fn set_pose(&mut self, id: ColliderId, pose: Pose) -> Result<(), Error> {
        self.set_collider(id, Collider { pose, ..self.collider(id)? })
    }

    /// Sets the velocities of a collider so that it reaches a pose after `dt` \[s\], by the shorter rotation. A
    /// step of this length takes it there, and spheres feel its velocity. It moves on until it gets another
    /// velocity.
    ///
    /// ```
    /// use carom::{Collider, DVec3, Pose, Shape, World};
    ///
    /// let mut world = World::default();
    /// let door = Collider::new(Shape::Box { size: DVec3::ONE }, Pose::at(DVec3::ZERO));
    /// let id = world.add_collider(door)?;
    /// world.set_next_pose(id, Pose::at(DVec3::X), 0.02)?;
    /// world.step(0.02)?;
    /// assert_eq!(world.collider(id)?.pose.position, DVec3::X);
    /// # Ok::<(), carom::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Self::set_collider`]; [`Error::Invalid`] if `dt` is not positive, or a motion moves the collider.
    pub fn set_next_pose(&mut self, id: ColliderId, pose: Pose, dt: f64) -> Result<(), Error> {
        self.set_collider(id, self.moving_to(id, pose, dt)?)
    }

    /// Returns a collider with the velocities of [`Self::set_next_pose`], to set it later.
    ///
    /// # Errors
    /// Those of [`Self::set_next_pose`].
    pub fn moving_to(&self, id: ColliderId, pose: Pose, dt: f64) -> Result<Collider, Error> {
        let collider = self.collider(id)?;
        let requirement = "empty for velocities to move the collider";
        pose.validate()
            .and_then(|()| validate::positive("dt", dt))
            .and_then(|()| {
                let is_empty = collider.motion.is_empty();
                validate::require(is_empty, "motion", requirement, "one with parts")
            })
            .map_err(|invalid| invalid.about(Subject::Collider(id)))?;
        let Pose { position, rotation } = collider.pose;
        let turn = pose.rotation.normalize() * rotation.normalize().conjugate();
        let velocity = (pose.position - position) / dt;
        let moving = collider.moving(velocity, rotation::rotation_vector(turn) / dt);
        self.check_collider(id, &moving)?;
        Ok(moving)
    }
}
