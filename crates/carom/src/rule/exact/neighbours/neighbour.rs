//! A neighbour of a sphere.

use glam::DVec3;

use crate::rule::periodic::image_shift;

/// Bits of the slot in a [`Neighbour`].
const SLOT_BITS: u32 = 27;
/// The number of the image with offset 0, among those at -1, 0 or 1 boxes along each axis.
const MIDDLE_IMAGE: i32 = 13;
/// Number of images that can be distinguished, with that in the same box and the values that mean none.
pub(super) const IMAGES: usize = 1 << (u32::BITS - SLOT_BITS);
/// The offset of each image by its number, and 1: reading a table takes less than counting.
const OFFSETS: [[i32; 3]; IMAGES] = {
    let mut offsets = [[0; 3]; IMAGES];
    let mut number = 0;
    while number <= 2 * MIDDLE_IMAGE {
        offsets[number as usize + 1] = [number % 3 - 1, number / 3 % 3 - 1, number / 9 - 1];
        number += 1;
    }
    offsets
};

const OFFSETS_IN_NUMBERS: [(DVec3, f64); IMAGES] = {
    let mut numbers = [(DVec3::ZERO, 1.0); IMAGES];
    numbers[0].1 = 0.0;
    let mut image = 0;
    while image < IMAGES {
        let [x, y, z] = OFFSETS[image];
        numbers[image].0 = DVec3::new(x as f64, y as f64, z as f64);
        image += 1;
    }
    numbers
};

/// More spheres than this cannot be distinguished.
pub(crate) const MAX_SPHERES: usize = 1 << SLOT_BITS;

/// A neighbour of a sphere: its slot, and which of its images it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Neighbour(u32);

impl Neighbour {
    /// No neighbour: an image that does not exist.
    pub const NONE: Self = Self((IMAGES as u32 - 1) << SLOT_BITS);

    /// A neighbour whose position is in the same box as the sphere's.
    #[inline(always)]
    pub fn in_same_box(slot: u32) -> Self {
        Self(slot)
    }

    /// A neighbour whose image is near, at this offset in the box about the origin.
    pub fn image(slot: u32, [x, y, z]: [i32; 3]) -> Self {
        let number = x + 3 * y + 9 * z + MIDDLE_IMAGE;
        Self(slot | (number as u32 + 1) << SLOT_BITS)
    }

    #[inline(always)]
    pub fn slot(self) -> u32 {
        self.0 & ((1 << SLOT_BITS) - 1)
    }

    /// The slot in numbers.
    #[inline(always)]
    pub fn slot_in_numbers(self) -> f64 {
        // The conversion of a signed number takes less.
        f64::from(self.slot() as i32)
    }

    #[inline(always)]
    pub fn is_in_same_box(self) -> bool {
        self.0 < 1 << SLOT_BITS
    }

    /// The union of two neighbours: an image if one of them is. It names no sphere.
    #[inline(always)]
    pub fn joined(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// The offset of an image.
    pub fn image_offset(self) -> [i32; 3] {
        OFFSETS[self.image_number()]
    }

    /// The offset of an image in numbers, and 1; zeros if it is no image.
    #[inline(always)]
    pub fn image_offset_in_numbers(self) -> &'static (DVec3, f64) {
        &OFFSETS_IN_NUMBERS[self.image_number()]
    }

    /// This neighbour as an image, even if it is in the box about the origin.
    #[inline(always)]
    pub fn as_image(self) -> Self {
        if self.is_in_same_box() { Self::image(self.slot(), [0; 3]) } else { self }
    }

    /// Returns the number of the image.
    #[inline(always)]
    pub fn image_number(self) -> usize {
        (self.0 >> SLOT_BITS) as usize
    }

    /// The shift to each image in a periodic box with these edges \[m\], by its number.
    pub fn image_shifts(period: DVec3) -> [DVec3; IMAGES] {
        OFFSETS.map(|offset| image_shift(offset, period))
    }

    /// The sphere at `slot` as a neighbour of this neighbour.
    #[inline]
    pub fn mirrored(self, slot: u32) -> Self {
        match self.0 >> SLOT_BITS {
            0 => Self(slot),
            image => Self(slot | (2 * (MIDDLE_IMAGE as u32 + 1) - image) << SLOT_BITS),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn image_gives_its_offset_and_mirrors_it() {
        let slot = MAX_SPHERES as u32 - 1;
        for number in 0..27 {
            let offset = [number % 3 - 1, number / 3 % 3 - 1, number / 9 - 1];
            let image = Neighbour::image(slot, offset);
            assert_eq!((image.slot(), image.is_in_same_box()), (slot, false));
            assert_eq!((image.image_offset(), image.as_image()), (offset, image));
            let numbers = DVec3::from_array(offset.map(f64::from));
            assert_eq!(*image.image_offset_in_numbers(), (numbers, 1.0));
            assert_eq!(image.mirrored(7), Neighbour::image(7, offset.map(|offset| -offset)));
        }
        let plain = Neighbour::in_same_box(slot);
        assert_eq!(*plain.image_offset_in_numbers(), (DVec3::ZERO, 0.0));
        assert!(plain.is_in_same_box() && plain.slot() == slot);
        assert_eq!(plain.mirrored(7), Neighbour::in_same_box(7));
        assert_eq!(plain.as_image(), Neighbour::image(slot, [0; 3]));
    }
}
