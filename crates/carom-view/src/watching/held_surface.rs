//! A surface that is dragged.

use carom::{ColliderId, DVec3, Pose};

/// A picked surface in the hand.
#[derive(Debug, Clone, Copy)]
pub(super) struct HeldSurface {
    pub id: ColliderId,
    /// Pose when it was taken.
    pub from: Pose,
    /// The point under the pointer then \[m\].
    pub point: DVec3,
    /// Direction of view: the pointer moves in the plane across it.
    pub normal: DVec3,
    /// The last position \[m\].
    pub position: DVec3,
    pub has_moved: bool,
    /// The picture in which it is held.
    pub side: usize,
}

impl HeldSurface {
    /// Returns the position of the surface with the pointer on a ray \[m\].
    pub fn position_on(&self, [origin, direction]: [DVec3; 2]) -> Option<DVec3> {
        let distance = (self.point - origin).dot(self.normal) / direction.dot(self.normal);
        let place = self.from.position + (origin + direction * distance - self.point);
        (distance > 0.0 && place.is_finite()).then_some(place)
    }
}
