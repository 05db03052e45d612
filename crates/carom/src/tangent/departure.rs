//! The derivative of a sphere's leaving a plane over the end of a face.

use glam::DVec3;

use super::state::SphereTangent;
use super::variation::Variation;
use crate::id::{ColliderId, SphereId};

/// Derivative of the instant at which a sphere leaves a face over its end: a saltation matrix, as of an impact.
#[derive(Debug, Clone)]
pub(super) struct Departure {
    /// Index of the sphere in the arrays of the world.
    pub place: usize,
    pub id: SphereId,
    pub collider: ColliderId,
    /// Unit vector along the face and out of it, where the sphere leaves.
    pub outward: DVec3,
    /// Velocity relative to the face \[m/s\].
    pub velocity: DVec3,
    /// How much smaller the acceleration is afterwards \[m/s²\], and the angular acceleration \[rad/s²\].
    pub lost: [DVec3; 2],
    /// Time since the start of the derivatives \[s\].
    pub time: f64,
}

impl Departure {
    /// Returns the ratio of the speed across the end to the speed: 0 if the sphere grazes it.
    pub fn directness(&self) -> f64 {
        self.velocity.dot(self.outward) / self.velocity.length()
    }

    /// Applies the derivative to the derivatives of the spheres in one direction.
    pub fn pass(&self, direction: &Variation, spheres: &mut [SphereTangent]) {
        let sphere = &mut spheres[self.place];
        let collider = direction.collider(self.collider);
        let moved = sphere.position - collider.position - self.time * collider.velocity;
        let later = -moved.dot(self.outward) / self.velocity.dot(self.outward);
        sphere.velocity += later * self.lost[0];
        sphere.angular_velocity += later * self.lost[1];
    }

    /// The transpose of [`Self::pass`]; adds the derivatives with respect to the collider to a gradient.
    pub fn pass_back(&self, spheres: &mut [SphereTangent], gradient: &mut Variation) {
        let sphere = &mut spheres[self.place];
        let by_delay =
            self.lost[0].dot(sphere.velocity) + self.lost[1].dot(sphere.angular_velocity);
        let by_end = by_delay / self.velocity.dot(self.outward) * self.outward;
        sphere.position -= by_end;
        let collider = gradient.collider_mut(self.collider);
        collider.position += by_end;
        collider.velocity += self.time * by_end;
        collider.rotation = DVec3::NAN;
    }
}
