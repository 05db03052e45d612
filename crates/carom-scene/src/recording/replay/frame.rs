//! The spheres of a recording at one time.

use carom::{DQuat, DVec3};

use crate::scene::Color;

/// State of all spheres at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct ReplayFrame {
    /// Time \[s\].
    pub time: f64,
    /// Spheres by ascending number.
    pub balls: Vec<ReplayBall>,
}

/// State of a sphere at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReplayBall {
    /// Place in the order of appearance, from 0.
    pub number: u64,
    /// Centre \[m\].
    pub position: DVec3,
    /// Velocity \[m/s\].
    pub velocity: DVec3,
    /// Rotation from the sphere's own coordinate system to the world's; `None` if the recording has
    /// no orientations.
    pub orientation: Option<DQuat>,
    /// Radius \[m\].
    pub radius: f64,
    /// Mass \[kg\].
    pub mass: f64,
    /// Colour of the ball itself, or that of its generator or emitter; [`crate::Palette`] has the
    /// default colours.
    pub color: Option<Color>,
}
