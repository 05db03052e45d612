//! Clearance: a box in which the centre of a sphere can move without touching a surface, other than those in
//! persistent contact with it. While the centre stays in the box, no surface is tested.

use glam::DVec3;

use crate::bounds::Bounds;
use crate::detect::surface_tree::bounds;
use crate::flight::Flight;
use crate::surface::Form;

/// Where the centre of a sphere can be without touching a surface at rest of its neighbour region, other than those
/// in persistent contact with it.
#[derive(Debug, Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Clearance(Bounds);

/// A surface that a sphere may meet.
pub(crate) struct Obstacle<'a> {
    pub form: &'a Form,
    /// Offset \[m\] that moves the surface to the image beside the sphere's position.
    pub shift: DVec3,
}

impl Clearance {
    /// An empty clearance.
    pub const NONE: Self = Self(Bounds { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY });

    /// A large clearance about the centre \[m\] of a sphere of this radius \[m\]; empty where the sphere touches an
    /// obstacle or an obstacle has no bounds.
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
            // An obstacle bounds the clearance along the axis on which it is farthest.
            if below[axis] > above[axis] {
                free.max[axis] = free.max[axis].min(center[axis] + below[axis]);
            } else {
                free.min[axis] = free.min[axis].max(center[axis] - above[axis]);
            }
        }
        Self(free)
    }

    /// Whether a sphere stays in the clearance for a `time` \[s\].
    #[inline]
    pub fn holds(&self, flight: &Flight, time: f64) -> bool {
        self.holds_way(flight.position, flight.farthest(time))
    }

    /// Whether a sphere stays in the clearance if it moves no farther from a position \[m\] than `way` \[m\] along
    /// each axis.
    pub fn holds_way(&self, position: DVec3, way: DVec3) -> bool {
        ((position - way).cmpgt(self.0.min) & (position + way).cmplt(self.0.max)).all()
    }
}
