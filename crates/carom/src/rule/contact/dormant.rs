//! Contacts of spheres that sleep.

use super::batch::Impulses;
use crate::id::SphereId;

/// A contact of an island that sleeps.
#[derive(Debug, Clone, Copy)]
pub(super) struct Dormant {
    pub sphere: SphereId,
    pub partner: Partner,
    /// On the sphere.
    pub impulses: Impulses,
    /// Coefficient of friction.
    pub sliding: f64,
}

/// What a sphere touches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Partner {
    Sphere(SphereId),
    Surface(u32),
}
