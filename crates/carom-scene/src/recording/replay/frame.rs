//! The spheres of a recording at one time.

use carom::{DQuat, DVec3};

use crate::scene::Color;

/// The spheres at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct ReplayFrame {
    /// In s.
    pub time: f64,
    /// In order of their numbers.
    pub balls: Vec<ReplayBall>,
}

/// A sphere at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReplayBall {
    /// Place in the order of appearance, from 0.
    pub number: u64,
    /// Centre \[m\].
    pub position: DVec3,
    /// Velocity \[m/s\].
    pub velocity: DVec3,
    /// From its own coordinate system to the world's; `None` where the recording does not say.
    pub orientation: Option<DQuat>,
    /// In m.
    pub radius: f64,
    /// In kg.
    pub mass: f64,
    /// Its own colour, or that of its generator or emitter; see [`crate::Palette`] for others.
    pub color: Option<Color>,
}
