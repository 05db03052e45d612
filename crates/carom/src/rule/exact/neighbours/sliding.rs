//! Images that slide: the periodic box in steady shear, as the neighbour search sees it.
//!
//! The search works in coordinates x - τ y, y, z, in which the boxes above and below are aligned with this one when
//! it begins. It is valid until they have slid by the extra width of the cells. Then all neighbours are found again.

use glam::DVec3;

use super::region::OVERHANG;
use crate::rule::periodic;
use crate::shear::Shear;

/// Extra width of cells for images that slide, by the mean distance of spheres: more makes wider cells, less more
/// searches.
const ROOM_TO_SLIDE: f64 = 0.5;

/// Images in steady shear, for a search that begins at some time.
#[derive(Debug, Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Sliding {
    shear: Shear,
    /// Whole edges that the box above has slid along x; image offsets count from there.
    edges: f64,
    /// Tilt τ of the lattice of boxes: along x for y.
    tilt: f64,
    /// Extra width of cells \[m\].
    room: f64,
    /// When the images have slid that far, on the world's clock \[s\].
    pub until: f64,
}

impl Sliding {
    /// The images from `time` \[s\] on, of spheres with this mean distance of neighbours \[m\].
    pub fn from(shear: Shear, spacing: f64, time: f64) -> Self {
        let (mut edges, mut rest) = shear.slide(time);
        // The nearest image above: the tilt is least.
        let nearest = (rest / shear.period.x).round();
        (edges, rest) = (edges + nearest, rest - nearest * shear.period.x);
        let room = (ROOM_TO_SLIDE * spacing).min(0.25 * shear.period.x);
        let until = (time + room / shear.speed().abs()).max(time.next_up());
        Self { shear, edges, tilt: rest / shear.period.y, room, until }
    }

    /// Width of cells in which spheres with this sum of radii \[m\] meet only those in adjacent cells \[m\].
    pub fn width(&self, radius_sum: f64) -> f64 {
        let stretched = radius_sum * (1.0 + self.tilt * self.tilt).sqrt();
        (stretched + self.room) / (1.0 - 2.0 * OVERHANG)
    }

    /// A vector in the coordinates of the search.
    #[inline]
    pub fn in_search(&self, vector: DVec3) -> DVec3 {
        DVec3::new(vector.x - self.tilt * vector.y, vector.y, vector.z)
    }

    /// The shift to an image at `time` \[s\], \[m\], and its velocity \[m/s\].
    pub fn image_motion(&self, [x, y, z]: [i32; 3], time: f64) -> [DVec3; 2] {
        let mut shift = periodic::image_shift([0, y, z], self.shear.period);
        if y == 0 {
            shift.x = f64::from(x) * self.shear.period.x;
            return [shift, DVec3::ZERO];
        }
        let up = f64::from(y);
        let (edges, rest) = self.shear.slide(time);
        let across = f64::from(x) + up * (edges - self.edges);
        shift.x = up * rest + across * self.shear.period.x;
        [shift, DVec3::new(up * self.shear.speed(), 0.0, 0.0)]
    }

    /// Image offset of a position at `time` \[s\].
    pub fn image_offset_of(&self, position: DVec3, time: f64) -> [i32; 3] {
        let period = self.shear.period;
        let [_, up, across] = periodic::image_offset_of(position, period);
        let [shift, _] = self.image_motion([0, up, across], time);
        let [along, ..] = periodic::image_offset_of(position - shift, period);
        [along, up, across]
    }
}
