//! Cell lists: the spheres in each cell of a grid.

use super::grid::Block;
use super::neighbour::Neighbour;
use super::paged_lists::PagedLists;

/// Spheres by cell, as they are seen from the box about the origin.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) enum Cells {
    /// As a rule, at most three are in a cell.
    Sparse(PagedLists<Neighbour, 3>),
    /// As a rule, at most five are.
    Crowded(PagedLists<Neighbour, 5>),
}

impl Cells {
    /// So many empty cells.
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

    /// The first spheres in a cell: as a rule, all.
    #[inline(always)]
    pub fn first(&self, cell: usize) -> &[Neighbour] {
        match self {
            Self::Sparse(lists) => lists.first(cell),
            Self::Crowded(lists) => lists.first(cell),
        }
    }

    /// Puts the spheres of some cells into `found`, from `len` on, and gives where they end. What is
    /// there behind that has no meaning.
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
