//! Contacts that persist from step to step.

use glam::DVec3;

use crate::report::BodyPair;

/// Two bodies that stay in contact, and the force between them.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct PersistentContact {
    /// The two bodies.
    pub between: BodyPair,
    /// Where on the surface of body 1 \[m\].
    pub point: DVec3,
    /// Unit normal from body 1 to body 2.
    pub normal: DVec3,
    /// Distance of the two surfaces \[m\]: zero but for rounding, negative where they overlap.
    pub gap: f64,
    /// Force along the normal on body 2 \[N\], >= 0; body 1 feels the opposite one.
    pub normal_force: f64,
}
