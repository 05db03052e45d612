//! A log of the persistent contacts and the curved flights of spheres during a step, for derivatives.

use glam::DVec3;

use super::support_change::SupportChange;
use crate::detect::contact::Bodies;
use crate::id::SphereId;
use crate::polynomial_flight::PolynomialFlight;
use crate::rule::exact::features::NormalCurvature;

/// Persistent contacts and curved flights of spheres during a step.
#[derive(Debug, Clone, Default)]
pub(crate) struct FlightLog {
    /// Changes of persistent contacts, in order of time.
    pub supports: Vec<SupportChange>,
    /// Curved flights of spheres that take their steps together, in order of time.
    pub curves: Vec<JointFlight>,
    /// Spheres that were added within the step, in order of time.
    pub arrivals: Vec<Arrival>,
    /// Impacts of groups of touching bodies, in order of time.
    pub groups: Vec<GroupImpact>,
}

/// Impact of a group of touching bodies.
#[derive(Debug, Clone)]
pub(crate) struct GroupImpact {
    /// On the world's clock \[s\].
    pub time: f64,
    pub members: Vec<StruckMember>,
    pub touches: Vec<StruckTouch>,
    /// Whether the impact law and friction alone answered it.
    pub is_plain: bool,
}

/// A sphere in the impact of a group.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StruckMember {
    /// Index in the arrays of the world.
    pub index: u32,
    pub position: DVec3,
    /// Velocity \[m/s\] and angular velocity \[rad/s\] before the impact, and after it.
    pub before: [DVec3; 2],
    pub after: [DVec3; 2],
}

/// Two touching bodies in the impact of a group.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StruckTouch {
    pub bodies: Bodies,
    /// Places of the spheres among the members; the first body may be a surface.
    pub first: Option<usize>,
    pub second: usize,
    /// Unit vector from body 1 to body 2.
    pub normal: DVec3,
    pub curvature: NormalCurvature,
    /// Coefficient of restitution in this impact.
    pub restitution: f64,
    /// Impulse along the normal \[N s\].
    pub impulse: f64,
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
