//! Who is near one sphere, gathered from cells or lists into memory that is used again.

use std::ops::Range;

use super::lists::Lists;
use super::neighbour::Neighbour;

/// Spheres by cell, as they are seen from the box about the origin: as a rule not more than three.
pub(super) type CellLists = Lists<Neighbour, 3>;
/// Neighbours of each sphere, by slot: as a rule not more than fifteen.
pub(super) type NeighbourLists = Lists<Neighbour, 15>;

/// Those who are near a sphere.
#[derive(Debug, Clone, Default)]
pub(super) struct Vicinity {
    pub same_box: Buffer,
    pub images: Vec<Neighbour>,
}

impl Vicinity {
    /// Those whose positions count in the same box as that of the sphere.
    #[inline(always)]
    pub fn in_same_box(&self) -> &[Neighbour] {
        self.same_box.found()
    }

    /// Those of whom an image is near.
    #[inline(always)]
    pub fn images(&self) -> &[Neighbour] {
        &self.images
    }

    pub fn iter(&self) -> impl Iterator<Item = Neighbour> {
        self.in_same_box().iter().chain(&self.images).copied()
    }

    pub fn clear(&mut self) {
        self.same_box.len = 0;
        self.images.clear();
    }

    /// Of those from `start` on, moves images to the others, and drops the sphere itself.
    #[inline(always)]
    pub fn sort_from(&mut self, start: usize, slot: u32) {
        let Self { same_box, images } = self;
        let added = &same_box.buffer[start..same_box.len];
        let are_images = added.iter().fold(false, |any, other| any | !other.is_in_same_box());
        if are_images {
            images.extend(added.iter().filter(|other| !other.is_in_same_box()));
        }
        same_box.retain_from(start, |other| other.is_in_same_box() & (other.slot() != slot));
    }
}

/// Neighbours in memory that is used again.
#[derive(Debug, Clone, Default)]
pub(super) struct Buffer {
    /// Those who were found; what lies behind has no meaning.
    pub buffer: Vec<Neighbour>,
    pub len: usize,
}

impl Buffer {
    #[inline(always)]
    pub fn found(&self) -> &[Neighbour] {
        &self.buffer[..self.len]
    }

    /// Adds the spheres of some cells.
    #[inline(always)]
    pub fn add_cells(&mut self, cells: &CellLists, range: Range<usize>) {
        self.len = cells.gather(range, &mut self.buffer, self.len);
    }

    /// Adds the neighbours of a sphere.
    #[inline(always)]
    pub fn add_list(&mut self, lists: &NeighbourLists, slot: u32) {
        let list = slot as usize..slot as usize + 1;
        self.len = lists.gather(list, &mut self.buffer, self.len);
    }

    /// Of those from `start` on, keeps some. Without branches on that, which no processor can
    /// foresee.
    #[inline(always)]
    pub fn retain_from(&mut self, start: usize, is_kept: impl Fn(Neighbour) -> bool) {
        let found = &mut self.buffer[start..self.len];
        let mut count = 0;
        for n in 0..found.len() {
            let neighbour = found[n];
            found[count] = neighbour;
            count += usize::from(is_kept(neighbour));
        }
        self.len = start + count;
    }
}
