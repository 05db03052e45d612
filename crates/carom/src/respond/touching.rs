//! What is given: contacts of a group of bodies that touch at one instant.

use glam::DVec3;

/// One contact of a group of bodies that touch at one instant.
///
/// Body 1 is a sphere of the group, or a surface of infinite mass; body 2 a sphere of the group.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TouchingContact {
    /// Index of sphere 1 in the group; none if body 1 is a surface.
    pub first: Option<usize>,
    /// Index of sphere 2 in the group.
    pub second: usize,
    /// Unit vector from body 1 to body 2.
    pub normal: DVec3,
    /// Velocity \[m/s\] of the surface where it is touched; without meaning if body 1 is a sphere.
    pub surface_velocity: DVec3,
    /// Coefficient of restitution e in \[0, 1\].
    pub restitution: f64,
}

/// What the answer to the impacts of one instant was.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct GroupResponse {
    /// One per contact \[N s\], >= 0: along the normal on body 2, against it on body 1. Where
    /// contacts are redundant, as in a lattice, one of many distributions.
    pub impulses: Vec<f64>,
    /// Change of kinetic energy \[J\] that the law demands, <= 0, without rounding; measured
    /// against the surfaces, so it does not depend on their velocities.
    pub restitution_energy: f64,
    /// Kinetic energy \[J\] that moving surfaces give besides: `Σ impulse · normal · velocity`.
    pub surface_work: f64,
    /// Closing speed \[m/s\] below which a contact counts as no longer closing: the rounding of
    /// the speeds in the group.
    pub resolution: f64,
    /// Whether the law came to no end of its own and was finished otherwise
    /// (`docs/physics/impacts.md` says how, for each law).
    pub cut_short: bool,
}
