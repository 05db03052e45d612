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

/// Memory in which those who are near a sphere are gathered.
#[derive(Debug, Clone, Default)]
pub(super) struct Vicinity {
    pub gathered: Buffer,
    /// Whether they are all on the list of the sphere: then they are not here.
    pub are_listed: bool,
}

impl Vicinity {
    #[inline(always)]
    pub fn clear(&mut self) {
        self.gathered.len = 0;
        self.are_listed = false;
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

    pub fn push(&mut self, neighbour: Neighbour) {
        let Self { buffer, len } = self;
        buffer.truncate(*len);
        buffer.push(neighbour);
        *len += 1;
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

    /// Whether one is among them. Looks at all of them, likewise.
    #[inline(always)]
    pub fn has(&self, one: Neighbour) -> bool {
        self.found().iter().fold(false, |found, &other| found | (other == one))
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
