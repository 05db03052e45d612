//! Images of spheres in the periodic box.

use fearless_simd::Simd;
use glam::DVec3;

use super::neighbour::{IMAGES, Neighbour};
use super::region::Region;
use crate::lanes::{LANES, Lanes};
use crate::real::Vector;
use crate::rule::periodic;

/// How images of spheres are distinguished from others.
#[derive(Debug, Clone, Copy, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) enum Images {
    /// No images: all axes are open.
    #[default]
    None,
    /// Chosen by position: the image beside a sphere is nearer than all others.
    ByPlace,
    /// Chosen by marks in cells and lists, in a narrow box.
    ByMark,
    /// Chosen by marks in cells, in a box in steady shear.
    Sliding,
}

/// A periodic box, with what the kernels read of it.
#[derive(Debug, Clone, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct PeriodicBox {
    /// Edges \[m\]; infinite along an open axis.
    pub period: DVec3,
    /// Edges \[m\]; 0 along an open axis, which has no images.
    pub edges: DVec3,
    /// One over the edges \[1/m\], 0 along an open axis.
    per_edge: DVec3,
    /// The shift to each image \[m\], by its number.
    image_shifts: [DVec3; IMAGES],
}

impl PeriodicBox {
    /// A box with these edges \[m\], infinite along open axes.
    pub fn new(period: DVec3) -> Self {
        Self {
            period,
            edges: DVec3::select(period.is_finite_mask(), period, DVec3::ZERO),
            per_edge: period.recip(),
            image_shifts: Neighbour::image_shifts(period),
        }
    }

    /// The shift of an image offset \[m\].
    pub fn shift(&self, offset: [i32; 3]) -> DVec3 {
        periodic::image_shift(offset, self.period)
    }

    /// Offset from the box about the origin to the box of a sphere's position \[m\].
    #[inline]
    pub fn shift_from_box(&self, region: &Region) -> DVec3 {
        region.offset_in_numbers() * self.edges
    }

    /// Offsets \[m\] of neighbours' images beside a sphere, one per lane.
    #[inline(always)]
    pub fn shifts_of<S: Simd>(
        &self,
        simd: S,
        region: &Region,
        others: [&Region; LANES],
        marks: &[Neighbour; LANES],
    ) -> Vector<Lanes<S>> {
        // In whole numbers, which are exact.
        let here = Vector::all(simd, region.offset_in_numbers());
        let there = Vector::each(simd, others.map(Region::offset_in_numbers));
        let images = marks.each_ref().map(|one| one.image_offset_in_numbers());
        let is_image = Lanes::each(simd, images.map(|image| image.1));
        let in_box = Vector::each(simd, images.map(|image| image.0));
        ((in_box + (here - there)) * is_image).scaled(Vector::all(simd, self.edges))
    }

    /// Offsets \[m\] of neighbours' images that are recognised by their positions, from the offsets at a time when
    /// all are in their regions \[m\].
    #[inline(always)]
    pub fn shifts_to_nearest<S: Simd>(
        &self,
        simd: S,
        offset: Vector<Lanes<S>>,
    ) -> Vector<Lanes<S>> {
        let boxes = offset.scaled(Vector::all(simd, self.per_edge)).rounded(simd);
        boxes.scaled(Vector::all(simd, -self.edges))
    }

    /// The shifts to images of spheres in the box about the origin \[m\].
    #[inline(always)]
    pub fn shifts_of_images<S: Simd>(
        &self,
        simd: S,
        marks: &[Neighbour; LANES],
    ) -> Vector<Lanes<S>> {
        let shifts = marks.each_ref().map(|one| &self.image_shifts[one.image_number()]);
        Vector::each(simd, shifts.map(|shift| *shift))
    }
}

/// The image offset between the positions of two spheres; `in_box` is the offset between their wrapped positions.
pub(super) fn offset_between(region: &Region, other: &Region, in_box: [i32; 3]) -> [i32; 3] {
    let (here, there) = (region.image_offset, other.image_offset);
    [0, 1, 2].map(|axis| in_box[axis] + here[axis] - there[axis])
}
