//! Progress of a game, to continue it later.

use carom::{DQuat, DVec3, Sphere};
use serde::{Deserialize, Serialize};

use crate::tilt::Tilt;

/// Progress of a game: all plain numbers needed to continue it in the same maze.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Progress {
    /// Centre of the ball \[m\].
    pub position: [f64; 3],
    /// Velocity of the ball \[m/s\].
    pub velocity: [f64; 3],
    /// Orientation of the ball: a quaternion x, y, z, w.
    pub orientation: [f64; 4],
    /// Angular velocity of the ball \[rad/s\].
    pub angular_velocity: [f64; 3],
    /// Tilt of the maze about x and z \[rad\].
    pub tilt: [f64; 2],
    /// Remaining collectibles, ascending.
    pub remaining: Vec<usize>,
    /// Frames since the player first steered.
    pub frames: u64,
    /// Least time in which this maze was won \[s\].
    pub best: Option<f64>,
}

impl Progress {
    /// Returns the tilt of the maze.
    pub(crate) fn tilt(&self) -> Tilt {
        let [about_x, about_z] = self.tilt;
        Tilt { about_x, about_z }
    }

    /// Returns the ball with its earlier motion.
    pub(crate) fn ball(&self, ball: Sphere) -> Sphere {
        ball.with_position(DVec3::from_array(self.position))
            .with_velocity(DVec3::from_array(self.velocity))
            .with_orientation(DQuat::from_array(self.orientation))
            .with_angular_velocity(DVec3::from_array(self.angular_velocity))
    }
}
