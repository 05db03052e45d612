//! Spheres that a cue strikes.

use glam::DVec3;

use super::World;
use crate::error::{Error, Subject};
use crate::id::SphereId;
use crate::respond::Strike;

impl World {
    /// Strikes a sphere with a cue: changes its velocity and its angular velocity at once. A part that presses it onto a
    /// table is answered by the table in the next step. Returns the impulse \[N s\].
    ///
    /// ```
    /// use carom::{DVec3, Sphere, Strike, World};
    ///
    /// let mut world = World::default();
    /// let ball = world.add_sphere(Sphere::new(DVec3::ZERO, 0.0286).with_mass(0.17))?;
    /// // Below the middle: the ball moves along x and spins backwards about z.
    /// let strike = Strike::new(DVec3::X, 2.0).with_offset(DVec3::new(0.0, -0.01, 0.0));
    /// world.strike(ball, strike)?;
    /// assert!(world.sphere(ball)?.velocity.x > 2.0);
    /// assert!(world.sphere(ball)?.angular_velocity.z > 0.0);
    /// # Ok::<(), carom::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Unknown`] if the sphere is not in the world, [`Error::Invalid`] for an invalid number, or an offset by
    /// its radius or more.
    pub fn strike(&mut self, id: SphereId, strike: Strike) -> Result<DVec3, Error> {
        let sphere = self.sphere(id)?;
        let (impulse, point) =
            strike.impulse_on(&sphere).map_err(|invalid| invalid.about(Subject::Sphere(id)))?;
        self.apply_impulse_at(id, impulse, sphere.position + point)?;
        Ok(impulse)
    }
}
