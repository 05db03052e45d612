//! Neighbour regions that another copy of the neighbours has moved.

use glam::DVec3;

use super::Neighbours;
use crate::norm::Norm;
use crate::rule::exact::neighbours::level::Level;
use crate::rule::exact::neighbours::region::LEAD;
use crate::rule::exact::neighbours::{Layout, NeighbourBuffer, Region};
use crate::rule::periodic;

impl Neighbours {
    /// The layout of the grid of the largest spheres; `None` without spheres. A sphere meets what lies in its cell and
    /// in those next to it.
    pub fn coarsest_layout(&self) -> Option<Layout> {
        self.levels.first().map(|level| level.grid.layout())
    }

    /// Returns the cell of a sphere in [the coarsest grid](Self::coarsest_layout), by coordinates.
    #[inline(always)]
    pub fn coarsest_cell(&self, slot: u32) -> [u16; 3] {
        self.cell_of(slot, &self.levels[0].grid)
    }

    /// Returns the cell of a region in [the coarsest grid](Self::coarsest_layout), by coordinates.
    #[inline(always)]
    pub fn coarsest_cell_of(&self, region: &Region) -> [u16; 3] {
        self.levels[0].grid.cell_of(region.center)
    }

    /// The neighbour region of a sphere.
    #[inline(always)]
    pub fn region_of(&self, slot: u32) -> Region {
        self.regions[slot as usize]
    }

    /// The neighbour region of a sphere of this level with this position \[m\] and velocity \[m/s\], if it begins now.
    pub fn region_at(&self, slot: u32, level: u32, [position, velocity]: [DVec3; 2]) -> Region {
        let Level { grid, half_edges, .. } = &self.levels[level as usize];
        let is_listed = self.lists.is_some();
        let speed = if is_listed { velocity.norm() } else { 0.0 };
        let lead = if speed > 0.0 && speed.is_finite() {
            LEAD * half_edges * (velocity / speed)
        } else {
            DVec3::ZERO
        };
        let period = self.periodic_box.period;
        let center = self.sliding.map_or(position + lead, |sliding| sliding.in_search(position));
        let image_offset = periodic::image_offset_of(center, period);
        let center = center - periodic::image_shift(image_offset, period);
        let center = if is_listed { center } else { grid.center(grid.cell_of(center)) };
        Region { center, image_offset, ..self.regions[slot as usize] }
    }

    /// Moves the neighbour region of a sphere of this level to where another copy of the neighbours has it.
    pub fn set_region(&mut self, slot: u32, level: u32, region: Region) {
        if self.regions[slot as usize] == region {
            return;
        }
        let before = self.cell_of(slot, &self.levels[level as usize].grid);
        self.leave_cells(slot, level, before);
        self.regions[slot as usize] = region;
        let cell = self.cell_of(slot, &self.levels[level as usize].grid);
        self.enter_cells(slot, level, cell);
        self.update_list(slot, &mut NeighbourBuffer::default());
    }
}
