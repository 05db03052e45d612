//! Contacts that persist though nothing presses the bodies together.

use glam::DVec3;

use crate::id::{ColliderId, SphereId};
use crate::tangent::state::SphereTangent;
use crate::tangent::variation::Variation;

/// A direction keeps a contact if it changes its gap and its rate of opening by at most this part of its change of the two
/// bodies.
const KEEPS: f64 = 1e-9;

/// Two bodies that touch, and fly as if they did not: there is a derivative only along directions that keep them in
/// touch.
#[derive(Debug, Clone)]
pub(in crate::tangent) struct LooseContact {
    pub first: First,
    /// Index in the arrays of the world, and id.
    pub second: (usize, SphereId),
    /// Unit vector from body 1 to body 2.
    pub normal: DVec3,
    /// Time since the start of the derivatives \[s\].
    pub time: f64,
}

/// Body 1.
#[derive(Debug, Clone, Copy)]
pub(in crate::tangent) enum First {
    Sphere(usize, SphereId),
    Surface(ColliderId),
}

impl LooseContact {
    /// Returns whether a direction keeps the bodies in touch.
    pub fn stays(&self, direction: &Variation, spheres: &[SphereTangent]) -> bool {
        let (place, id) = self.second;
        let (first, radius) = match self.first {
            First::Sphere(place, id) => (spheres[place], direction.sphere(id).radius),
            First::Surface(id) => {
                let collider = direction.collider(id);
                let position = collider.position + self.time * collider.velocity;
                let velocity = collider.velocity;
                (SphereTangent { position, velocity, ..SphereTangent::default() }, 0.0)
            }
        };
        let second = spheres[place];
        let radii = radius + direction.sphere(id).radius;
        let gap = (second.position - first.position).dot(self.normal) - radii;
        let rate = (second.velocity - first.velocity).dot(self.normal);
        let lengths = second.position.length() + first.position.length() + radii.abs();
        let speeds = second.velocity.length() + first.velocity.length();
        gap.abs() <= KEEPS * lengths && rate.abs() <= KEEPS * speeds
    }
}
