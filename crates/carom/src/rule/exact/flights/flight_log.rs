//! A log of the persistent contacts and the curved flights of spheres during a step, for derivatives.

use glam::DVec3;

use super::support_change::SupportChange;
use crate::id::SphereId;
use crate::polynomial_flight::PolynomialFlight;

/// Persistent contacts and curved flights of spheres during a step.
#[derive(Debug, Clone, Default)]
pub(crate) struct FlightLog {
    /// Changes of persistent contacts, in order of time.
    pub supports: Vec<SupportChange>,
    /// Curved flights of spheres that take their steps together, in order of time.
    pub curves: Vec<JointFlight>,
    /// Spheres that were added within the step, in order of time.
    pub arrivals: Vec<Arrival>,
}

/// A sphere that is added within a step, as it begins.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Arrival {
    pub id: SphereId,
    /// On the world's clock \[s\].
    pub time: f64,
    pub position: DVec3,
    pub velocity: DVec3,
    pub angular_velocity: DVec3,
}

/// Curved flights of some spheres from one instant on, until they all begin other ones.
#[derive(Debug, Clone)]
pub(crate) struct JointFlight {
    /// Start on the world's clock \[s\].
    pub time: f64,
    /// Index of each sphere in the arrays of the world, and its flight from the start on.
    pub flights: Vec<(u32, PolynomialFlight)>,
    /// Whether these are all spheres that forces connect with each other.
    pub is_complete: bool,
}
