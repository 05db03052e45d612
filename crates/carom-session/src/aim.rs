//! The path of a ball that is aimed, before it is struck.

use carom::{DVec3, SphereId, World};

/// Time for which the path is predicted \[s\].
const HORIZON: f64 = 3.0;

/// Largest number of impacts of the ball on the path.
const MOST_IMPACTS: usize = 6;

/// Number of points of a path over the whole horizon.
const POINTS: u32 = 120;

/// A ball, and the velocity that a blow is to give it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aim {
    /// The ball.
    pub sphere: SphereId,
    /// Velocity of the ball after the blow \[m/s\].
    pub velocity: DVec3,
}

impl Aim {
    /// Returns points of the path of the ball's centre from now on \[m\], at equal intervals of time: all of them before
    /// the path ends; none if the motion has no closed form.
    ///
    /// The path is that of [`World::predict`].
    pub fn path(&self, world: &World) -> Vec<DVec3> {
        let mut struck = world.clone();
        if struck.set_velocity(self.sphere, self.velocity).is_err() {
            return Vec::new();
        }
        let Ok(path) = struck.predict(self.sphere, HORIZON, MOST_IMPACTS) else {
            return Vec::new();
        };
        let time = |i: u32| struck.time() + HORIZON * f64::from(i) / f64::from(POINTS);
        (0..=POINTS).map_while(|i| path.position_at(time(i))).collect()
    }
}
