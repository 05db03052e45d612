//! Cell lists: the spheres in each cell of a grid.

use educe::Educe;

use super::grid::Block;
use super::neighbour::Neighbour;
use super::paged_lists::PagedLists;

/// Spheres by cell, relative to the box about the origin.
#[derive(Debug, Educe)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) enum Cells {
    /// Pages of three spheres, for cells that rarely have more.
    Sparse(PagedLists<Neighbour, 3>),
    /// Pages of five spheres, for cells that rarely have more.
    Crowded(PagedLists<Neighbour, 5>),
}

impl Cells {
    /// Creates a number of empty cells.
    pub fn new(count: usize, are_crowded: bool) -> Self {
        if are_crowded {
            Self::Crowded(PagedLists::new(count))
        } else {
            Self::Sparse(PagedLists::new(count))
        }
    }

    #[inline(always)]
    pub fn add(&mut self, cell: usize, sphere: Neighbour) {
        match self {
            Self::Sparse(lists) => lists.add(cell, sphere),
            Self::Crowded(lists) => lists.add(cell, sphere),
        }
    }

    #[inline(always)]
    pub fn remove(&mut self, cell: usize, sphere: Neighbour) {
        match self {
            Self::Sparse(lists) => lists.remove(cell, sphere),
            Self::Crowded(lists) => lists.remove(cell, sphere),
        }
    }

    /// Prefetches the first spheres in a cell into the cache.
    #[inline(always)]
    pub fn prefetch(&self, cell: usize) {
        match self {
            Self::Sparse(lists) => lists.prefetch(cell),
            Self::Crowded(lists) => lists.prefetch(cell),
        }
    }

    /// Returns the spheres on the first page of a cell, in most cells all.
    #[inline(always)]
    pub fn first(&self, cell: usize) -> &[Neighbour] {
        match self {
            Self::Sparse(lists) => lists.first(cell),
            Self::Crowded(lists) => lists.first(cell),
        }
    }

    /// Writes the spheres of a block of cells into `found` from `len` on, and returns their end;
    /// entries after that have no meaning.
    #[inline(always)]
    pub fn gather(&self, block: &Block, found: &mut Vec<Neighbour>, len: usize) -> usize {
        match self {
            Self::Sparse(lists) => gather(lists, block, found, len),
            Self::Crowded(lists) => gather(lists, block, found, len),
        }
    }
}

#[inline(always)]
fn gather<const SIZE: usize>(
    lists: &PagedLists<Neighbour, SIZE>,
    block: &Block,
    found: &mut Vec<Neighbour>,
    len: usize,
) -> usize {
    let most = lists.room(block.len());
    if found.len() < len + most {
        found.resize(len + most, Neighbour::default());
    }
    let (mut end, mut has_rest) = (len, false);
    block.for_each_row(|row| {
        let (new_end, row_has_rest) = lists.copy_first(row, found, end);
        (end, has_rest) = (new_end, has_rest | row_has_rest);
    });
    if has_rest { gather_rest(lists, block, found, end) } else { end }
}

/// Gathers the spheres that are not on the first pages.
#[cold]
#[inline(never)]
fn gather_rest<const SIZE: usize>(
    lists: &PagedLists<Neighbour, SIZE>,
    block: &Block,
    found: &mut Vec<Neighbour>,
    mut end: usize,
) -> usize {
    block.for_each_row(|row| end = lists.copy_rest(row, found, end));
    end
}
