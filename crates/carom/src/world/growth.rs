//! Radii that grow.

use super::World;
use crate::error::{Error, Subject};
use crate::validate;

impl World {
    /// Sets the growth rate of all radii r \[1/s\]: they grow as `r (1 + rate t)`. 0 ends the growth.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a rate that is negative or not finite.
    ///
    /// ```
    /// use carom::{DVec3, Sphere, World};
    ///
    /// let mut world = World::default();
    /// let ball = world.add_sphere(Sphere::new(DVec3::ZERO, 0.5))?;
    /// world.set_growth_rate(0.25)?;
    /// world.step(2.0)?;
    /// assert_eq!(world.sphere(ball)?.radius, 0.75);
    /// # Ok::<(), carom::Error>(())
    /// ```
    pub fn set_growth_rate(&mut self, rate: f64) -> Result<(), Error> {
        validate::non_negative("growth rate", rate)
            .map_err(|invalid| invalid.about(Subject::Step))?;
        let spheres = &mut self.state.changed().spheres.properties;
        spheres.growth_speed = match rate {
            0.0 => Vec::new(),
            rate => spheres.radius.iter().map(|radius| rate * radius).collect(),
        };
        Ok(())
    }
}
