//! Clearance: free space in which a sphere meets no surface, but those that hold it, whichever way it
//! flies. While the sphere stays there, no surface has to be looked at.

use glam::DVec3;

use crate::bounds::Bounds;
use crate::detect::surface_tree::bounds;
use crate::flight::Flight;
use crate::surface::Form;

/// Where the centre of a sphere may be and touch no surface at rest of its neighbour region, but those
/// that hold it.
#[derive(Debug, Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Clearance(Bounds);

/// A surface that a sphere may meet.
pub(super) struct Obstacle<'a> {
    pub form: &'a Form,
    /// Brings the surface to where the position of the sphere counts \[m\].
    pub shift: DVec3,
}

impl Clearance {
    /// Nowhere.
    pub const NONE: Self = Self(Bounds { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY });

    /// A large one about the centre \[m\] of a sphere of this radius \[m\]; none where it touches an
    /// obstacle, or an obstacle has no bounds.
    pub fn about<'a>(
        center: DVec3,
        radius: f64,
        obstacles: impl Iterator<Item = Obstacle<'a>>,
    ) -> Self {
        let mut free = Bounds { min: DVec3::NEG_INFINITY, max: DVec3::INFINITY };
        for Obstacle { form, shift } in obstacles {
            let Some(closed) = bounds(form).map(|bounds| bounds.widened(radius)) else {
                return Self::NONE;
            };
            let (below, above) = (closed.min + shift - center, center - (closed.max + shift));
            let gaps = below.max(above);
            let axis = gaps.max_position();
            if gaps[axis] <= 0.0 {
                return Self::NONE;
            }
            // It is open on that side of the surface that is farthest from it.
            if below[axis] > above[axis] {
                free.max[axis] = free.max[axis].min(center[axis] + below[axis]);
            } else {
                free.min[axis] = free.min[axis].max(center[axis] - above[axis]);
            }
        }
        Self(free)
    }

    /// Whether a sphere stays in it for a `time` \[s\].
    #[inline]
    pub fn holds(&self, flight: &Flight, time: f64) -> bool {
        self.holds_way(flight.position, flight.farthest(time))
    }

    /// Whether a sphere stays in it that goes no farther from a position \[m\] than this along each axis \[m\].
    pub fn holds_way(&self, position: DVec3, way: DVec3) -> bool {
        ((position - way).cmpgt(self.0.min) & (position + way).cmplt(self.0.max)).all()
    }
}
