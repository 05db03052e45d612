//! The neighbour buffer: the neighbours of one sphere, gathered from cells or lists into memory that is
//! used again.

use std::iter;

use educe::Educe;

use super::cells::Cells;
use super::grid::Block;
use super::neighbour::Neighbour;
use super::paged_lists::PagedLists;
use crate::lanes::LANES;

/// Neighbours of each sphere, by slot: as a rule not more than fifteen.
pub(super) type NeighbourLists = PagedLists<Neighbour, 15>;

/// Neighbours that are compared at once.
const LINE: usize = 16;
/// Flags that fit into one number.
const BITS: usize = u64::BITS as usize;

/// Whether none of the four is an image.
#[inline(always)]
pub(super) fn are_in_same_box(four: &[Neighbour; LANES]) -> bool {
    four.iter().fold(Neighbour::default(), |all, &other| all.joined(other)).is_in_same_box()
}

/// Memory in which the neighbours of a sphere are gathered.
#[derive(Debug, Educe, Default)]
#[educe(Clone)]
pub(crate) struct NeighbourBuffer {
    /// The neighbours. Entries behind them are unused; each holds the slot of a sphere.
    pub(super) buffer: Vec<Neighbour>,
    pub(crate) len: usize,
    /// Union of the neighbours from lists and perhaps others: in the same box only if all of these are.
    joined: Neighbour,
}

impl NeighbourBuffer {
    #[inline(always)]
    pub fn clear(&mut self) {
        self.len = 0;
        self.joined = Neighbour::default();
    }

    /// Whether images may be among the neighbours from lists.
    #[inline(always)]
    pub fn has_images(&self) -> bool {
        !self.joined.is_in_same_box()
    }

    #[inline(always)]
    pub fn found(&self) -> &[Neighbour] {
        &self.buffer[..self.len]
    }

    /// The neighbours without a sphere and its images.
    pub fn others(&self, slot: u32) -> impl Iterator<Item = Neighbour> {
        self.found().iter().copied().filter(move |other| other.slot() != slot)
    }

    /// Keeps some of the neighbours.
    pub fn retain(&mut self, keeps: impl Fn(Neighbour) -> bool) {
        let mut kept = 0;
        for place in 0..self.len {
            let neighbour = self.buffer[place];
            if keeps(neighbour) {
                self.buffer[kept] = neighbour;
                kept += 1;
            }
        }
        self.len = kept;
    }

    /// The neighbours in groups of four; unused entries fill the last group.
    #[inline(always)]
    pub fn in_fours(&mut self) -> &[[Neighbour; LANES]] {
        let end = self.len.next_multiple_of(LANES);
        self.extend_to(end);
        self.buffer[..end].as_chunks().0
    }

    /// Extends the memory to `end`.
    #[inline(always)]
    fn extend_to(&mut self, end: usize) {
        if self.buffer.len() < end {
            self.buffer.resize(end, Neighbour::NONE);
        }
    }

    pub fn push(&mut self, neighbour: Neighbour) {
        if self.buffer.len() == self.len {
            self.buffer.push(neighbour);
        } else {
            self.buffer[self.len] = neighbour;
        }
        self.len += 1;
        self.joined = self.joined.joined(neighbour);
    }

    /// Adds the spheres of some cells.
    #[inline(always)]
    pub(super) fn add_block(&mut self, cells: &Cells, block: &Block) {
        self.len = cells.gather(block, &mut self.buffer, self.len);
    }

    /// Adds the neighbours on the list of a sphere.
    #[inline(always)]
    pub(super) fn add_list(&mut self, lists: &NeighbourLists, slot: u32) {
        let start = self.len;
        self.len = lists.gather(slot as usize, &mut self.buffer, start);
        // Reads the first page in place and whole: reading freshly written data in other pieces waits until the
        // data are in the cache.
        let rest = &self.buffer[start + lists.first(slot as usize).len()..self.len];
        let all = lists.first_page(slot as usize).iter().chain(rest);
        self.joined = all.fold(self.joined, |all, &other| all.joined(other));
    }

    /// The neighbours that are not among `others`. All are compared, which is faster than to stop at
    /// one.
    #[inline(always)]
    pub fn without<'a>(&'a self, others: &'a mut Self) -> impl Iterator<Item = Neighbour> + 'a {
        let others = others.filled_up();
        let is_there = |one: Neighbour| {
            let is_among = |some: &[Neighbour; LINE]| {
                some.iter().fold(false, |is_there, &other| is_there | (other == one))
            };
            others.iter().fold(false, |is_there, some| is_there | is_among(some))
        };
        self.found().chunks(BITS).flat_map(move |some| {
            let one_bit = |(place, &one)| u64::from(!is_there(one)) << place;
            let missing = some.iter().enumerate().map(one_bit).fold(0, |all, bit| all | bit);
            places(missing).map(|place| some[place])
        })
    }

    /// The neighbours, filled up with entries that are none.
    #[inline(always)]
    fn filled_up(&mut self) -> &[[Neighbour; LINE]] {
        let end = self.len.next_multiple_of(LINE);
        self.extend_to(end);
        self.buffer[self.len..end].fill(Neighbour::NONE);
        self.buffer[..end].as_chunks().0
    }

    /// Marks the neighbours from `start` on as images.
    pub(super) fn make_images(&mut self, start: usize) {
        for other in &mut self.buffer[start..self.len] {
            *other = other.as_image();
        }
    }

    /// Keeps, of the neighbours from `start` on, those whose bits are set by `kept`, which tests four at a time.
    #[inline(always)]
    pub(super) fn retain_from(&mut self, start: usize, kept: impl Fn(&[Neighbour; LANES]) -> u64) {
        let count = self.len - start;
        let room = start + count.next_multiple_of(LANES);
        self.extend_to(room);
        let mut end = start;
        for first in (start..self.len).step_by(BITS) {
            let last = usize::min(first + BITS, self.len);
            // All are tested before any is moved: few of many stay, and there is no branch for each.
            let fours = self.buffer[first..room].as_chunks().0;
            let fours = &fours[..(last - first).div_ceil(LANES)];
            let bits = fours.iter().rev().fold(0, |bits, four| bits << LANES | kept(four));
            for place in places(bits & u64::MAX >> (BITS - (last - first))) {
                self.buffer[end] = self.buffer[first + place];
                end += 1;
            }
        }
        self.len = end;
    }
}

/// The places of the bits that are set.
#[inline(always)]
fn places(mut bits: u64) -> impl Iterator<Item = usize> {
    iter::from_fn(move || {
        let place = (bits != 0).then(|| bits.trailing_zeros() as usize);
        bits &= bits.wrapping_sub(1);
        place
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_image_on_a_further_page_of_a_list_is_noticed() {
        let mut lists = NeighbourLists::new(1);
        (1..=15).for_each(|slot| lists.add(0, Neighbour::in_same_box(slot)));
        lists.add(0, Neighbour::image(16, [1, 0, 0]));
        // The first page is no longer full.
        (1..4).for_each(|slot| lists.remove(0, Neighbour::in_same_box(slot)));
        let mut near = NeighbourBuffer::default();
        near.add_list(&lists, 0);
        assert_eq!((near.len, near.has_images()), (13, true));
        lists.remove(0, Neighbour::image(16, [1, 0, 0]));
        near.clear();
        near.add_list(&lists, 0);
        assert_eq!((near.len, near.has_images()), (12, false));
    }
}
