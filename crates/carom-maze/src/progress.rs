//! How far a game has got, to go on with it later.

use carom::{DQuat, DVec3, Sphere};
use serde::{Deserialize, Serialize};

use crate::tilt::Tilt;

/// How far a game has got: all that it takes to go on with it in the same maze, in plain numbers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Progress {
    /// Centre of the ball \[m\].
    pub position: [f64; 3],
    /// Velocity of the ball \[m/s\].
    pub velocity: [f64; 3],
    /// How the ball is turned: a quaternion x, y, z, w.
    pub orientation: [f64; 4],
    /// Angular velocity of the ball \[rad/s\].
    pub angular_velocity: [f64; 3],
    /// Tilt of the maze about x and z \[rad\].
    pub tilt: [f64; 2],
    /// Which collectibles are still there, ascending.
    pub remaining: Vec<usize>,
    /// Frames since the player first steered.
    pub frames: u64,
    /// The least time in which this maze was won \[s\].
    pub best: Option<f64>,
}

impl Progress {
    /// The tilt of the maze.
    pub(crate) fn tilt(&self) -> Tilt {
        let [about_x, about_z] = self.tilt;
        Tilt { about_x, about_z }
    }

    /// The ball as it was.
    pub(crate) fn ball(&self, ball: Sphere) -> Sphere {
        ball.with_position(DVec3::from_array(self.position))
            .with_velocity(DVec3::from_array(self.velocity))
            .with_orientation(DQuat::from_array(self.orientation))
            .with_angular_velocity(DVec3::from_array(self.angular_velocity))
    }
}
