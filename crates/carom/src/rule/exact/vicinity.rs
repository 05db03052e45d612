//! Who is near one sphere, gathered from cells or lists into memory that is used again.

use super::grid::Block;
use super::lists::Lists;
use super::neighbour::Neighbour;

/// Spheres by cell, as they are seen from the box about the origin: as a rule not more than three.
pub(super) type CellLists = Lists<Neighbour, 3>;
/// Neighbours of each sphere, by slot: as a rule not more than fifteen.
pub(super) type NeighbourLists = Lists<Neighbour, 15>;

/// Whether no neighbour is an image. Looks at all of them, which is faster than to stop at one.
#[inline(always)]
pub(super) fn are_in_same_box(neighbours: &[Neighbour]) -> bool {
    neighbours.iter().fold(Neighbour::default(), |all, &other| all.joined(other)).is_in_same_box()
}

/// Those who are near a sphere.
#[derive(Debug, Clone, Copy)]
pub(super) struct Near<'a> {
    /// Those whose positions count in the same box as that of the sphere.
    pub same_box: &'a [Neighbour],
    /// Those of whom an image is near.
    pub images: &'a [Neighbour],
}

impl<'a> Near<'a> {
    pub fn iter(self) -> impl Iterator<Item = Neighbour> + use<'a> {
        self.same_box.iter().chain(self.images).copied()
    }
}

/// Memory in which those who are near a sphere are gathered.
#[derive(Debug, Clone, Default)]
pub(super) struct Vicinity {
    pub same_box: Buffer,
    pub images: Buffer,
    /// Whether they are all on the list of the sphere, in the same box: then they are not here.
    pub are_listed: bool,
}

impl Vicinity {
    /// Those who were gathered.
    #[inline(always)]
    pub fn near(&self) -> Near<'_> {
        Near { same_box: self.same_box.found(), images: self.images.found() }
    }

    #[inline(always)]
    pub fn clear(&mut self) {
        self.same_box.len = 0;
        self.images.len = 0;
        self.are_listed = false;
    }

    /// Of those from `start` on, moves images to the others, and drops the sphere itself, and images
    /// of it.
    #[inline(always)]
    pub fn sort_from(&mut self, start: usize, slot: u32) {
        let Self { same_box, images, .. } = self;
        let added = &same_box.buffer[start..same_box.len];
        if are_in_same_box(added) {
            same_box.drop_from(start, Neighbour::in_same_box(slot));
        } else {
            images.add(added, |other| (other, !other.is_in_same_box() & (other.slot() != slot)));
            same_box.retain_from(start, |other| other.is_in_same_box() & (other.slot() != slot));
        }
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

    /// Adds what some neighbours are turned into, if that is to be kept. Without branches on that,
    /// which no processor can foresee.
    #[inline(always)]
    pub fn add(
        &mut self,
        neighbours: &[Neighbour],
        turned: impl Fn(Neighbour) -> (Neighbour, bool),
    ) {
        let Self { buffer, len } = self;
        if buffer.len() < *len + neighbours.len() {
            buffer.resize(*len + neighbours.len(), Neighbour::default());
        }
        let free = &mut buffer[*len..][..neighbours.len()];
        let mut count = 0;
        for &neighbour in neighbours {
            let (neighbour, is_kept) = turned(neighbour);
            free[count] = neighbour;
            count += usize::from(is_kept);
        }
        *len += count;
    }

    /// Adds the spheres of some cells.
    #[inline(always)]
    pub fn add_block(&mut self, cells: &CellLists, block: &Block) {
        let Self { buffer, len } = self;
        let most = cells.room(block.len());
        if buffer.len() < *len + most {
            buffer.resize(*len + most, Neighbour::default());
        }
        let mut end = *len;
        block.for_each_row(|row| {
            end = match cells.copy_first(row.clone(), buffer, end) {
                (end, true) => end,
                (end, false) => cells.copy_rest(row, buffer, end, most),
            };
        });
        *len = end;
    }

    /// Adds the neighbours of a sphere.
    #[inline(always)]
    pub fn add_list(&mut self, lists: &NeighbourLists, slot: u32) {
        self.len = lists.gather(slot as usize, &mut self.buffer, self.len);
    }

    /// Of those from `start` on, drops one who is there once at most; whether it was there. Looks at
    /// all of them, likewise.
    #[inline(always)]
    pub fn drop_from(&mut self, start: usize, one: Neighbour) -> bool {
        let found = &mut self.buffer[start..self.len];
        let Some(&last) = found.last() else { return false };
        let mut count = 0;
        for other in found {
            let is_one = *other == one;
            count += usize::from(is_one);
            *other = if is_one { last } else { *other };
        }
        self.len -= count;
        count > 0
    }

    /// Of those from `start` on, keeps some, likewise without branches.
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
