//! Neighbour regions: boxes in which spheres stay between cell crossings.

use glam::DVec3;

/// A neighbour region reaches beyond the cell by this part of its width, so that a sphere that leaves it
/// is in another cell, whatever rounding does.
pub(super) const OVERHANG: f64 = 1.0 / 256.0;
/// A sphere has left its region when it is this part of the half edge away from the centre: the rest is
/// more than rounding, of positions and of the clock.
pub(super) const CROSSING: f64 = 1.0 - 1.0 / 512.0;
/// Where there are lists, a region is laid ahead of its sphere by this part of its half edge.
pub(super) const LEAD: f64 = 0.5;

/// The region of a sphere until it crosses into another.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Region {
    /// Centre of the region in the box \[m\].
    pub center: DVec3,
    /// Radius of the sphere, rounded up \[m\].
    pub radius: f32,
    /// Boxes that the sphere has crossed along each periodic axis since its flight began.
    pub image_offset: [i32; 3],
}

impl Region {
    /// The region of a sphere with this radius \[m\], without a place.
    pub fn nowhere(radius: f64) -> Self {
        Self { center: DVec3::ZERO, radius: rounded_up(radius), image_offset: [0; 3] }
    }

    /// The image offset in numbers.
    #[inline(always)]
    pub fn offset_in_numbers(&self) -> DVec3 {
        DVec3::from_array(self.image_offset.map(f64::from))
    }

    /// Whether the position of the sphere counts in the box about the origin.
    #[inline(always)]
    pub fn is_in_box(&self) -> bool {
        self.image_offset == [0; 3]
    }
}

/// The next number in single precision that is not less.
fn rounded_up(number: f64) -> f32 {
    let nearest = number as f32;
    if f64::from(nearest) < number { nearest.next_up() } else { nearest }
}
