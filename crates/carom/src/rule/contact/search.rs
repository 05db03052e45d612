//! The search for neighbours: which spheres and surfaces may touch before the next one.

use glam::DVec3;

use super::order::{self, Grid};
use super::row::Row;
use super::slots::Slots;
use crate::detect::broad_phase::BroadPhase;

/// A sphere may go at least this part of its radius from where a search found it.
const LEAST_MARGIN: f64 = 0.04;
/// A sphere may go at most this part of its radius, unless it goes farther in a sub-step.
const MOST_MARGIN: f64 = 0.3;
/// Searches are worth their cost if they last this part of a frame at the speeds of now.
const LASTING: f64 = 0.5;
/// Speeds may grow by this factor meanwhile.
const FASTER: f64 = 1.1;
/// A sphere is wide whose reach is more than this many times the mean: it is looked for in all cells that
/// it may reach, so that cells can fit the others.
const WIDE: f64 = 1.5;
/// With more wide ones than this part of all, spheres are found by a hierarchy of grids.
const MOST_WIDE: f64 = 1.0 / 16.0;

/// How far a sphere of this radius \[m\] and speed \[m/s\] may go until the next search \[m\], in frames of
/// `frame` and sub-steps of `h` \[s\].
pub(super) fn margin(radius: f64, speed: f64, frame: f64, h: f64) -> f64 {
    let lasting = FASTER * speed * (LASTING * frame + h);
    let bounded = lasting.clamp(LEAST_MARGIN * radius, MOST_MARGIN * radius);
    bounded.max(1.5 * FASTER * speed * h)
}

/// Working memory of a search.
#[derive(Debug, Clone, Default)]
pub(super) struct Search {
    grid: Grid,
    starts: Vec<u32>,
    order: Vec<u32>,
    wide: Vec<u32>,
    broad_phase: BroadPhase,
    /// Pairs of slots, the smaller one first, in order of it.
    pub pairs: Vec<[u32; 2]>,
    /// Pairs that were tested.
    pub tests: u64,
}

impl Search {
    /// The indices of spheres with these centres and radii \[m\], in the order in which they are to be in
    /// memory. `down` is the direction of the forces.
    pub fn order(
        &mut self,
        centers: &[DVec3],
        radii: &[f64],
        margins: &[f64],
        down: DVec3,
    ) -> &[u32] {
        let reach = |index: usize| radii[index] + margins[index];
        let count = centers.len();
        let mean = (0..count).map(reach).sum::<f64>() / count.max(1) as f64;
        let widest = (0..count).map(reach).filter(|&it| it <= WIDE * mean).fold(0.0, f64::max);
        self.grid = Grid::over(centers, 2.0 * widest.max(f64::MIN_POSITIVE), down);
        order::sort(&self.grid, centers, &mut self.starts, &mut self.order);
        &self.order
    }

    /// First slots of so many runs of whole layers, and the end of the last: about as many spheres in each.
    pub fn runs(&self, wanted: usize) -> Vec<usize> {
        let [layers, rows, columns] = self.grid.cells;
        let count = self.order.len();
        let wanted = wanted.clamp(1, layers);
        let start_of = |layer: usize| self.starts[layer * rows * columns] as usize;
        let mut starts = vec![0];
        for layer in 1..layers {
            let runs = starts.len();
            let start = start_of(layer);
            if runs < wanted && start >= count * runs / wanted && start > starts[runs - 1] {
                starts.push(start);
            }
        }
        starts.push(count);
        starts
    }

    /// Finds the pairs of slots whose spheres may touch until the next search.
    pub fn find_pairs(&mut self, slots: &Slots) {
        self.pairs.clear();
        let Slots { position, reference, .. } = slots;
        let reach = |slot: usize| position[slot].number() + reference[slot].number();
        let widest = 0.5 * self.grid.width();
        self.wide.clear();
        self.wide.extend((0..slots.len() as u32).filter(|&slot| reach(slot as usize) > widest));
        if self.wide.len() as f64 > MOST_WIDE * slots.len() as f64 {
            self.find_by_hierarchy(slots);
            return;
        }
        self.find_in_cells(position, &reach);
        if !self.wide.is_empty() {
            self.find_of_wide(position, &reach);
            // Wide ones are found last, but belong in between.
            self.pairs.sort_unstable();
        }
    }

    /// Spheres of all sizes: pairs come in no useful order.
    fn find_by_hierarchy(&mut self, slots: &Slots) {
        let Self { broad_phase, pairs, tests, .. } = self;
        let spheres = (0..slots.len()).map(|slot| {
            let reach = slots.position[slot].number() + slots.reference[slot].number();
            (slot as u32, slots.position[slot].vector(), reach)
        });
        broad_phase.rebuild(spheres, 0.0);
        broad_phase.for_each_pair(|i, j| pairs.push([i.min(j), i.max(j)]));
        *tests += pairs.len() as u64;
        pairs.sort_unstable();
    }

    /// Pairs of spheres none of which is wide: in one cell or in neighbouring ones.
    fn find_in_cells(&mut self, position: &[Row], reach: &impl Fn(usize) -> f64) {
        let Self { grid, starts, pairs, tests, .. } = self;
        let [layers, rows, columns] = grid.cells;
        let widest = 0.5 * grid.width();
        for first in 0..position.len() {
            let own_reach = reach(first);
            if own_reach > widest {
                continue;
            }
            let center = position[first].vector();
            let [layer, row, column] = grid.cell_of(center);
            let mut scan = |from: usize, to: usize| {
                *tests += (to - from) as u64;
                for (second, row) in (from..to).zip(&position[from..to]) {
                    let offset = row.vector() - center;
                    let other_reach = reach(second);
                    let sum = own_reach + other_reach;
                    if offset.length_squared() < sum * sum && other_reach <= widest {
                        pairs.push([first as u32, second as u32]);
                    }
                }
            };
            let (left, right) = (column.saturating_sub(1), (column + 2).min(columns));
            let start_of = |layer: usize, row: usize, column: usize| {
                starts[(layer * rows + row) * columns + column] as usize
            };
            scan(first + 1, start_of(layer, row, right));
            if row + 1 < rows {
                scan(start_of(layer, row + 1, left), start_of(layer, row + 1, right));
            }
            if layer + 1 < layers {
                for row in row.saturating_sub(1)..(row + 2).min(rows) {
                    scan(start_of(layer + 1, row, left), start_of(layer + 1, row, right));
                }
            }
        }
    }

    /// Pairs of wide spheres with all others, in all cells that they may reach.
    fn find_of_wide(&mut self, position: &[Row], reach: &impl Fn(usize) -> f64) {
        let Self { grid, starts, wide, pairs, tests, .. } = self;
        let widest = 0.5 * grid.width();
        for &slot in wide.iter() {
            let center = position[slot as usize].vector();
            let span = DVec3::splat(reach(slot as usize) + widest);
            let (low, high) = (grid.cell_of(center - span), grid.cell_of(center + span));
            let mut visit = |other: u32| {
                *tests += 1;
                let offset = position[other as usize].vector() - center;
                let sum = reach(slot as usize) + reach(other as usize);
                if offset.length_squared() < sum * sum {
                    pairs.push([slot.min(other), slot.max(other)]);
                }
            };
            for layer in low[0]..=high[0] {
                for row in low[1]..=high[1] {
                    let from = starts[grid.number([layer, row, low[2]])];
                    let to = starts[grid.number([layer, row, high[2]]) + 1];
                    let narrow = |&other: &u32| reach(other as usize) <= widest;
                    (from..to).filter(narrow).for_each(&mut visit);
                }
            }
            let others = wide.iter().copied().filter(|&other| other > slot);
            others.for_each(&mut visit);
        }
    }
}
