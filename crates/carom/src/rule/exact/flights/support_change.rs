//! Changes of the persistent contacts of spheres.

use glam::DVec3;

/// Change of the persistent contacts of a sphere.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SupportChange {
    /// Place of the sphere in the arrays of the world.
    pub index: u32,
    /// Time on the world's clock \[s\].
    pub time: f64,
    /// Motion after the change; `None` for a free flight.
    pub held: Option<HeldMotion>,
}

/// The motion of a sphere in persistent contact.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HeldMotion {
    pub position: DVec3,
    pub velocity: DVec3,
    pub angular_velocity: DVec3,
    /// Acceleration by everything but drag \[m/s²\].
    pub acceleration: DVec3,
    pub angular_acceleration: DVec3,
    /// Surfaces that the sphere touches, the first ones.
    pub surfaces: [Option<u32>; 3],
    /// Whether these and other spheres that these touch have more than one contact.
    pub has_others: bool,
    /// Whether the sphere touches others.
    pub touches_spheres: bool,
    /// Whether it held before the step, too.
    pub is_old: bool,
}
