//! The search for neighbours: which spheres and surfaces may touch before the next one.

use std::ops::Range;

use glam::DVec3;

use super::{Slab, Slabs};
use crate::detect::broad_phase::BroadPhase;
use crate::parallel;
use crate::rule::contact::contacts::images::{ImagePair, ImageSearch};
use crate::rule::contact::slots::Slots;
use crate::rule::contact::slots::drift::Drift;
use crate::rule::contact::slots::order::{self, Grid};
use crate::rule::contact::slots::row::Row;

/// Least distance of a sphere from its place at a search, as a part of its radius, before the next search.
const LEAST_MARGIN: f64 = 0.04;
/// Largest such distance, unless the sphere moves farther in a sub-step.
const MOST_MARGIN: f64 = 0.3;
/// Where at most this part of all spheres, or this number, would move farther, they may move [`MOST_OF_FEW`] times
/// their radius: few spheres add few pairs.
const FEW: (f64, usize) = (1.0 / 32.0, 16);
const MOST_OF_FEW: f64 = 8.0;
/// Mean margin as a part of the mean radius: wider margins mean fewer searches, but more contacts that do not
/// press.
const MEAN_MARGIN: f64 = 0.15;
/// In a periodic box, spheres may move at most this part of its shortest edge, unless they move farther in a
/// sub-step: so two never reach images beyond the next box.
const MOST_OF_BOX: f64 = 0.25;
/// Shear until the next search, at most, unless it lasts two sub-steps only.
const MOST_STRAIN: f64 = 0.1;
/// Least and most frames that a search is to last at the present speeds.
const LASTING: [f64; 2] = [1.5, 16.0];
/// Least number of sub-steps that a search is to last where many surfaces are near.
const SHORTEST: f64 = 2.0;
/// Mean number of surfaces near a sphere above which searches that last shorter cost less.
pub(crate) const MOST_SURFACES: usize = 64;
/// Speeds may grow by this factor meanwhile.
const FASTER: f64 = 1.1;
/// A sphere is wide if its reach is more than this many times the mean. It is looked for in all cells that it may
/// reach, so that cells can fit the others.
const WIDE: f64 = 1.5;
/// With more wide ones than this part of all, spheres are found by a hierarchy of grids.
const MOST_WIDE: f64 = 1.0 / 16.0;

/// How far spheres of this mean radius \[m\] may move, as a part of it: the more room each has the farther, up to
/// the mean distance of the next one.
fn most_among(slots: &Slots, radius: f64) -> f64 {
    let bounds = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let centers = slots.position.iter().map(|row| row.vector());
    let (low, high) = centers.fold(bounds, |(low, high), it| (low.min(it), high.max(it)));
    let extent = (high - low).max(DVec3::splat(2.0 * radius)) / radius;
    let room = extent.x * extent.y * extent.z / slots.len() as f64;
    (0.5 * libm::cbrt(room) - 1.0).clamp(MOST_MARGIN, MOST_OF_FEW)
}

/// Speed that moving surfaces may add to a sphere in a frame, by its slot \[m/s\]: an elastic impact adds twice the
/// speed of approach.
fn hit(approaches: &[f64], slot: usize) -> f64 {
    approaches.get(slot).map_or(0.0, |speed| 2.0 * speed)
}

/// Whether too many surfaces are near spheres within their `paths` until the next search \[m\], by slot, where these
/// are long.
fn is_crowded(
    slots: &Slots,
    near: impl Fn(&Row, f64) -> usize,
    paths: impl Fn(usize) -> f64,
) -> bool {
    let far = (0..slots.len()).filter(|&slot| {
        let radius = slots.position[slot].number();
        paths(slot) > MOST_MARGIN * radius
    });
    let surfaces = far.map(|slot| near(&slots.position[slot], paths(slot)));
    surfaces.sum::<usize>() > MOST_SURFACES * slots.len()
}

/// Working memory of a search.
#[derive(Debug, Clone, Default)]
pub(crate) struct Search {
    grid: Grid,
    /// Where each cell begins among the slots.
    starts: Vec<u32>,
    /// Margin of each sphere \[m\], by slot.
    margins: Vec<f64>,
    /// The former slot of each sphere, in the new order.
    from: Vec<u32>,
    slot_of: Vec<u32>,
    cells: Vec<u32>,
    spare: Vec<Row>,
    wide: Vec<u32>,
    broad_phase: BroadPhase,
    pairs: Vec<[u32; 2]>,
    image_search: ImageSearch,
    image_pairs: Vec<ImagePair>,
    /// Pairs that were tested.
    tests: u64,
}

impl Search {
    /// Sorts spheres by place, and notes their places and margins, in frames of `frame` and sub-steps of `h` \[s\].
    /// Returns the common motion, to which the margins are relative. Where there are surfaces, spheres may reverse,
    /// and moving ones may approach them this fast, by slot \[m/s\]. `near` returns the number of surfaces up to a
    /// distance \[m\] from a sphere with this row of centre and radius.
    pub fn arrange(
        &mut self,
        slots: &mut Slots,
        [frame, h]: [f64; 2],
        approaches: Option<&[f64]>,
        near: impl Fn(&Row, f64) -> usize,
    ) -> Drift {
        let drift = self.find_margins(slots, [frame, h], approaches, near);
        let Self { grid, starts, margins, from, slot_of, cells, spare, .. } = self;
        let count = slots.len();
        let reach = |slot: usize| slots.factor * slots.position[slot].number() + margins[slot];
        let mean = (0..count).map(reach).sum::<f64>() / count.max(1) as f64;
        let widest = (0..count).map(reach).filter(|&it| it <= WIDE * mean).fold(0.0, f64::max);
        let down = slots.acceleration.iter().map(|row| row.vector()).sum::<DVec3>();
        *grid = Grid::over(&slots.position, 2.0 * widest.max(f64::MIN_POSITIVE), down);
        cells.clear();
        cells.extend(
            slots.position.iter().map(|row| grid.number(grid.cell_of(row.vector())) as u32),
        );
        // By index, so that the order in a cell does not depend on the present order.
        slot_of.resize(count, 0);
        slots.index.iter().zip(0..).for_each(|(&index, slot)| slot_of[index as usize] = slot);
        order::sort(grid.len(), cells, slot_of, starts, from);
        slots.reference.clear();
        slots.reference.extend(
            from.iter().map(|&slot| {
                Row::new(slots.position[slot as usize].vector(), margins[slot as usize])
            }),
        );
        slots.permute(from, spare);
        drift
    }

    /// The margin of each sphere relative to the common motion: on average a given part of the radius, but more for
    /// faster spheres, so that a few fast ones do not cause frequent searches. Where many surfaces are near, searches
    /// are more frequent.
    fn find_margins(
        &mut self,
        slots: &Slots,
        [frame, h]: [f64; 2],
        approaches: Option<&[f64]>,
        near: impl Fn(&Row, f64) -> usize,
    ) -> Drift {
        let count = slots.len().max(1) as f64;
        let own = |slot: usize| slots.beside_flow(slot);
        let velocity = (0..slots.len()).map(own).sum::<DVec3>() / count;
        let speed = |slot: usize| (own(slot) - velocity).length();
        let speeds = (0..slots.len()).map(speed).sum::<f64>();
        let radii = slots.position.iter().map(|row| row.number()).sum::<f64>();
        let rate = slots.shear.map_or(0.0, |shear| shear.rate);
        let strained = (MOST_STRAIN / rate.abs()).max(2.0 * h);
        let [least, most] = LASTING.map(|frames| (frames * frame + h).min(strained));
        let mut lasting = (MEAN_MARGIN * radii / speeds.max(f64::MIN_POSITIVE)).clamp(least, most);
        // A slow sphere among fast ones may be hit and fly like them.
        let mean_speed = speeds / count;
        let farthest = MOST_OF_BOX * slots.period.min_element();
        let wanted = |slot: usize, lasting: f64| {
            FASTER * lasting * speed(slot).max(mean_speed) / slots.position[slot].number()
        };
        let most_for = |lasting: f64| {
            let fast = (0..slots.len()).filter(|&slot| wanted(slot, lasting) > MOST_MARGIN).count();
            let are_few = fast <= FEW.1 || fast as f64 <= FEW.0 * count;
            if are_few { MOST_OF_FEW } else { most_among(slots, radii / count) }
        };
        let mut most = most_for(lasting);
        let path = |slot: usize, lasting: f64, most: f64| {
            let margin = wanted(slot, lasting).min(most) * slots.position[slot].number();
            margin + lasting * velocity.length()
        };
        while lasting > SHORTEST * h && is_crowded(slots, &near, |slot| path(slot, lasting, most)) {
            lasting = (0.5 * lasting).max(SHORTEST * h);
            most = most_for(lasting);
        }
        self.margins.clear();
        self.margins.extend((0..slots.len()).map(|slot| {
            let bounded =
                wanted(slot, lasting).clamp(LEAST_MARGIN, most) * slots.position[slot].number();
            let bounded = bounded.min(farthest);
            // Within a sub-step it may move on by half its path, or reverse at a surface.
            let row = &slots.velocity[slot];
            let beside = 1.5 * speed(slot).max(mean_speed) + slots.speed_beside_last(slot);
            let turned = row.vector().length() + velocity.length();
            let Some(approaches) = approaches else {
                let margin = bounded.max(FASTER * beside * h);
                let radius = slots.factor * slots.position[slot].number();
                return margin + rate.abs() * lasting * (radius + margin);
            };
            let fastest = beside.max(turned + hit(approaches, slot));
            bounded.max(FASTER * fastest * h)
        }));
        let within = (farthest / velocity.length().max(f64::MIN_POSITIVE)).max(FASTER * h);
        Drift::begin(velocity, lasting.min(within)).with_shear(rate, slots.factor)
    }

    /// First slots of runs of whole layers with about equal numbers of spheres, and the end of the last.
    pub fn runs(&self, wanted: usize) -> Vec<usize> {
        let [layers, rows, columns] = self.grid.cells;
        let count = self.from.len();
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

    /// Finds the pairs of slots whose spheres may touch until the next search, the smaller slot first and
    /// in order of it, for the slab of that one.
    pub fn find_pairs(&mut self, slots: &Slots, slabs: &mut Slabs) {
        let Slots { position, .. } = slots;
        let reach = |slot: usize| slots.reach_of(slot);
        let widest = 0.5 * self.grid.width();
        self.wide.clear();
        self.wide.extend((0..slots.len() as u32).filter(|&slot| reach(slot as usize) > widest));
        self.pairs.clear();
        if self.wide.len() as f64 > MOST_WIDE * slots.len() as f64 {
            self.find_by_hierarchy(slots);
        } else {
            let cells = Cells { grid: &self.grid, starts: &self.starts, slots };
            let tasks = slabs.list.iter_mut().collect();
            parallel::for_each(tasks, |slab: &mut Slab| {
                slab.tests = cells.find_pairs(slab.start..slab.end, &mut slab.pairs);
            });
            self.tests += slabs.list.iter().map(|slab| slab.tests).sum::<u64>();
            if self.wide.is_empty() {
                return;
            }
            slabs.list.iter_mut().for_each(|slab| self.pairs.append(&mut slab.pairs));
            self.find_of_wide(position, &reach);
        }
        self.pairs.sort_unstable();
        let mut rest = &self.pairs[..];
        for slab in &mut slabs.list {
            let count = rest.partition_point(|pair| (pair[0] as usize) < slab.end);
            slab.pairs.extend_from_slice(&rest[..count]);
            rest = &rest[count..];
        }
    }

    /// Finds the pairs across the faces of a periodic box, each for the slab of the smaller slot.
    pub fn find_image_pairs(&mut self, slots: &Slots, slabs: &mut Slabs) {
        let Self { image_search, image_pairs, tests, .. } = self;
        image_search.find(slots, image_pairs);
        *tests += image_pairs.len() as u64;
        let mut rest = &image_pairs[..];
        for slab in &mut slabs.list {
            let count = rest.partition_point(|pair| (pair.slots[0] as usize) < slab.end);
            slab.image_pairs.extend_from_slice(&rest[..count]);
            rest = &rest[count..];
        }
    }

    /// Returns how far spheres may reach beyond the box until the next search, with radii and
    /// margins \[m\].
    pub fn reach(slots: &Slots) -> f64 {
        (0..slots.len()).map(|slot| slots.reach_of(slot)).fold(0.0, f64::max)
    }

    /// The slot that the sphere of each slot was moved to.
    pub fn places(&self) -> Vec<u32> {
        let mut places = vec![0; self.from.len()];
        self.from.iter().zip(0..).for_each(|(&from, slot)| places[from as usize] = slot);
        places
    }

    /// The slot that each sphere was in before it was moved.
    pub fn from(&self) -> &[u32] {
        &self.from
    }

    /// Returns the number of pairs tested since the last call.
    pub fn take_tests(&mut self) -> u64 {
        std::mem::take(&mut self.tests)
    }

    /// Spheres of all sizes: pairs come in no useful order.
    fn find_by_hierarchy(&mut self, slots: &Slots) {
        let Self { broad_phase, pairs, tests, .. } = self;
        let spheres = (0..slots.len())
            .map(|slot| (slot as u32, slots.position[slot].vector(), slots.reach_of(slot)));
        broad_phase.rebuild(spheres, 0.0);
        broad_phase.for_each_pair(|i, j| pairs.push([i.min(j), i.max(j)]));
        *tests += pairs.len() as u64;
    }

    /// Pairs of wide spheres with all others, in all cells that they may reach.
    fn find_of_wide(&mut self, position: &[Row], reach: &impl Fn(usize) -> f64) {
        let Self { grid, starts, wide, pairs, tests, .. } = self;
        let widest = 0.5 * grid.width();
        for &slot in wide.iter() {
            let center = position[slot as usize].vector();
            let [low, high] = grid.cells_within(center, reach(slot as usize) + widest);
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

/// Spheres in their cells.
#[derive(Clone, Copy)]
struct Cells<'a> {
    grid: &'a Grid,
    starts: &'a [u32],
    slots: &'a Slots,
}

impl Cells<'_> {
    /// Pairs of spheres none of which is wide, and one of which is awake, in one cell or in neighbouring
    /// ones, the smaller slot among these. Returns how many were tested.
    fn find_pairs(&self, slots: Range<usize>, pairs: &mut Vec<[u32; 2]>) -> u64 {
        let Self { grid, slots: all @ Slots { position, sleeps, .. }, .. } = *self;
        let [layers, rows, columns] = grid.cells;
        let widest = 0.5 * grid.width();
        let reach = |slot: usize| all.reach_of(slot);
        let mut tests = 0;
        for first in slots {
            let own_reach = reach(first);
            if own_reach > widest {
                continue;
            }
            let center = position[first].vector();
            let [layer, row, column] = grid.cell_of(center);
            let farthest = own_reach + widest;
            let mut scan = |from: usize, to: usize| {
                tests += (to - from) as u64;
                for (second, row) in (from..to).zip(&position[from..to]) {
                    let distance_squared = (row.vector() - center).length_squared();
                    if distance_squared < farthest * farthest {
                        let other_reach = reach(second);
                        let sum = own_reach + other_reach;
                        let is_idle = sleeps[first] && sleeps[second];
                        if distance_squared < sum * sum && other_reach <= widest && !is_idle {
                            pairs.push([first as u32, second as u32]);
                        }
                    }
                }
            };
            let (left, right) = (column.saturating_sub(1), (column + 2).min(columns));
            let start_of = |layer: usize, row: usize, column: usize| {
                self.starts[(layer * rows + row) * columns + column] as usize
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
        tests
    }
}
