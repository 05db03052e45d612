//! Contacts that persist from step to step.

use glam::DVec3;

use crate::id::SphereId;
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
    /// Force of friction on body 2 \[N\], across the normal; body 1 feels the opposite one. Zero under
    /// rules without friction.
    pub tangential_force: DVec3,
    /// Whether the surfaces slide on each other, or would at the least touch: friction is as large as it
    /// can be.
    pub is_sliding: bool,
}

impl PersistentContact {
    /// A contact without forces.
    pub(crate) const NONE: Self = Self {
        between: BodyPair::Spheres(SphereId(0), SphereId(0)),
        point: DVec3::ZERO,
        normal: DVec3::Y,
        gap: 0.0,
        normal_force: 0.0,
        tangential_force: DVec3::ZERO,
        is_sliding: true,
    };
}
