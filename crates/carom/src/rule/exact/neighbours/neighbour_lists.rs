//! Neighbour lists: for each of many crowded spheres of one size, the others that it can meet while both
//! are in their regions.

use std::mem::take;

use educe::Educe;
use fearless_simd::{Simd, SimdMask, dispatch};
use glam::DVec3;

use super::buffer::{self, NeighbourBuffer, are_in_same_box};
use super::contents::SLACK;
use super::images::{PeriodicBox, offset_between};
use super::level::Level;
use super::neighbour::Neighbour;
use super::region::Region;
use crate::lanes::Lanes;
use crate::real::Vector;

/// Lists by slot, and the memory that brings them up to date.
#[derive(Debug, Educe)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct NeighbourLists {
    pub lists: buffer::NeighbourLists,
    /// Neighbours of the sphere at work, before and after.
    #[cfg_attr(feature = "serde", serde(skip))]
    before: NeighbourBuffer,
    #[cfg_attr(feature = "serde", serde(skip))]
    after: NeighbourBuffer,
}

/// Crowded spheres, as the lists read them.
#[derive(Clone, Copy)]
pub(super) struct Crowd<'a> {
    /// The only level.
    pub level: &'a Level,
    /// Region of each sphere, by slot.
    pub regions: &'a [Region],
    pub periodic_box: &'a PeriodicBox,
}

impl NeighbourLists {
    /// Empty lists for this number of spheres.
    pub fn new(count: usize) -> Self {
        let (before, after) = Default::default();
        Self { lists: buffer::NeighbourLists::new(count), before, after }
    }

    /// Updates the list of a sphere and those of its neighbours. Adds the new neighbours to `new`.
    pub fn update(&mut self, crowd: Crowd, slot: u32, new: &mut NeighbourBuffer) {
        let (mut before, mut after) = (take(&mut self.before), take(&mut self.after));
        before.clear();
        after.clear();
        crowd.find_peers(slot, &mut after);
        let lists = &mut self.lists;
        before.add_list(lists, slot);
        lists.set(slot as usize, after.found());
        for come in after.without(&mut before) {
            lists.add(come.slot() as usize, come.mirrored(slot));
            new.push(come);
        }
        for gone in before.without(&mut after) {
            lists.remove(gone.slot() as usize, gone.mirrored(slot));
        }
        (self.before, self.after) = (before, after);
    }

    /// Replaces a neighbour of a sphere, on both their lists.
    pub fn replace(&mut self, slot: u32, old: Neighbour, new: Neighbour) {
        self.lists.replace(slot as usize, old, new);
        self.lists.replace(old.slot() as usize, old.mirrored(slot), new.mirrored(slot));
    }
}

impl Crowd<'_> {
    fn region(&self, slot: u32) -> &Region {
        &self.regions[slot as usize]
    }

    /// Finds the others that a sphere can meet while both are in their regions.
    fn find_peers(&self, slot: u32, peers: &mut NeighbourBuffer) {
        let Level { grid, half_edges, own, .. } = self.level;
        let cell = grid.cell_of(self.region(slot).center);
        grid.for_each_block(cell, None, |block| {
            let start = peers.len;
            peers.add_block(own, &block);
            let reach = block.is_endless.map(|is| if is { f64::INFINITY } else { 2.0 });
            let reach = DVec3::from_array(reach) * half_edges;
            let level = fearless_simd::Level::new();
            dispatch!(level, simd => self.keep_peers(simd, slot, reach, peers, start));
            for other in &mut peers.buffer[start..peers.len] {
                *other = self.neighbour(slot, other.slot(), other.image_offset());
            }
        });
    }

    /// Keeps, of the spheres from `start` on, those whose regions reach the sphere's, for centres up to `reach`
    /// apart \[m\].
    #[inline(always)]
    fn keep_peers<S: Simd>(
        &self,
        simd: S,
        slot: u32,
        reach: DVec3,
        peers: &mut NeighbourBuffer,
        start: usize,
    ) {
        let Region { center, radius, .. } = *self.region(slot);
        let (here, radius) = (Vector::all(simd, center), Lanes::all(simd, f64::from(radius)));
        let reach = Vector::all(simd, reach);
        let itself = Lanes::all(simd, f64::from(slot));
        peers.retain_from(
            start,
            #[inline(always)]
            |four| {
                let others = four.each_ref().map(|one| self.region(one.slot()));
                // Seen from the other sphere, only the sign differs.
                let mut offset = Vector::each(simd, others.map(|other| other.center)) - here;
                if !are_in_same_box(four) {
                    offset = offset + self.periodic_box.shifts_of_images(simd, four);
                }
                let gap = offset.beyond(reach);
                let radii = others.map(|other| f64::from(other.radius));
                let radius_sum = radius + Lanes::each(simd, radii);
                let are_near = gap.length_squared().is_at_most(radius_sum * radius_sum * SLACK);
                let slots = Lanes::each(simd, four.map(Neighbour::slot_in_numbers));
                (are_near & !slots.is_equal(itself)).to_bitmask()
            },
        );
    }

    /// The sphere `other` as a neighbour of the sphere at `slot`, for this image offset in the box.
    pub fn neighbour(&self, slot: u32, other: u32, in_box: [i32; 3]) -> Neighbour {
        if offset_between(self.region(slot), self.region(other), in_box) == [0; 3] {
            Neighbour::in_same_box(other)
        } else {
            Neighbour::image(other, in_box)
        }
    }
}
