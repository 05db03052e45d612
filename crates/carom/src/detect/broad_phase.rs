//! Broad phase: pairs of spheres that may be near each other, by a hierarchy of uniform grids.
//!
//! A level holds the spheres of one size class (within a factor of two), in cubic cells as wide
//! as the largest sphere it may hold. Two spheres of one level that touch lie in the same or in
//! neighbouring cells; a sphere meets larger ones by looking into the coarser levels. Work is
//! proportional to the number of spheres times the number of size classes in use, whatever the
//! ratio of the radii.
//!
//! Cells are hashed into a table, so the world has no bounds and empty space costs nothing.
//! Blocks of 4 x 4 x 4 cells stay together in the table, so neighbours share cache lines.

use std::ops::ControlFlow;

use glam::DVec3;

/// Cells are wider than the spheres in them by this factor, far above the rounding of a cell
/// coordinate (exact to 1e-6 of a cell up to 1e9 cells from the origin).
const CELL_SLACK: f64 = 1.0 + 1e-6;
/// Size classes; anything smaller than 2^-40 of the largest shares the last one.
const MAX_LEVELS: usize = 41;
/// Cells of a block that lie together in the table.
const BLOCK_CELLS: usize = 64;

/// Spheres sorted by place to find near pairs.
#[derive(Debug, Clone, Default)]
pub(crate) struct BroadPhase {
    levels: Vec<Level>,
    /// Reach added to each radius \[m\]: half the distance at which a pair is still of interest.
    margin: f64,
}

/// Spheres of one size class. `entries[starts[b] .. starts[b + 1]]` are those of bucket `b`.
#[derive(Debug, Clone, Default)]
struct Level {
    cells_per_metre: f64,
    /// Largest reach (radius + margin) of its spheres \[m\].
    largest_reach: f64,
    starts: Vec<u32>,
    entries: Vec<Entry>,
    /// The entries as they came.
    unsorted: Vec<Entry>,
}

#[derive(Debug, Clone, Copy)]
struct Entry {
    center: DVec3,
    /// Radius + margin \[m\].
    reach: f64,
    cell: [i32; 3],
    index: u32,
}

impl Entry {
    fn meets(&self, center: DVec3, reach: f64) -> bool {
        let offset = self.center - center;
        let reach = self.reach + reach;
        // Rounding must not lose a pair that the exact test afterwards would keep.
        offset.dot(offset) <= reach * reach * (1.0 + 1e-12)
    }
}

impl BroadPhase {
    /// Arranges spheres, given as `(index, centre [m], radius [m])`, to find pairs whose surfaces
    /// are at most `tolerance` \[m\] apart.
    pub fn rebuild(
        &mut self,
        spheres: impl Iterator<Item = (u32, DVec3, f64)> + Clone,
        tolerance: f64,
    ) {
        self.margin = 0.5 * tolerance;
        let margin = self.margin;
        let reach = |radius: f64| radius + margin;
        let largest = spheres.clone().fold(0.0, |max: f64, s| max.max(reach(s.2)));

        self.levels.resize_with(MAX_LEVELS, Level::default);
        for level in &mut self.levels {
            level.unsorted.clear();
            level.largest_reach = 0.0;
        }
        for (index, center, radius) in spheres {
            let reach = reach(radius);
            let level = &mut self.levels[size_class(largest, reach)];
            level.largest_reach = level.largest_reach.max(reach);
            level.unsorted.push(Entry { center, reach, cell: [0; 3], index });
        }
        let mut cell_size = 2.0 * largest * CELL_SLACK;
        for level in &mut self.levels {
            level.cells_per_metre = 1.0 / cell_size;
            level.arrange();
            cell_size *= 0.5;
        }
        self.levels.retain(|level| !level.entries.is_empty());
    }

    /// Calls `visit` once for each pair of spheres within reach of each other, in no useful order.
    pub fn for_each_pair(&self, mut visit: impl FnMut(u32, u32)) {
        let every: ControlFlow<()> = self.try_for_each_pair(|i, j| {
            visit(i, j);
            ControlFlow::Continue(())
        });
        debug_assert!(every.is_continue());
    }

    /// Calls `visit` once for each pair of spheres within reach of each other, until a visit breaks off.
    pub fn try_for_each_pair<B>(
        &self,
        mut visit: impl FnMut(u32, u32) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        // Levels run from the largest spheres to the smallest.
        for (number, level) in self.levels.iter().enumerate() {
            level.try_for_each_pair(&mut visit)?;
            for entry in &level.entries {
                for larger in &self.levels[..number] {
                    larger.near(entry.center, entry.reach, |index| visit(entry.index, index))?;
                }
            }
        }
        ControlFlow::Continue(())
    }

    /// Calls `visit` once for each pair of one sphere here and one in `others` within reach of each
    /// other, in no useful order.
    pub fn for_each_pair_with(&self, others: &Self, mut visit: impl FnMut(u32, u32)) {
        for own in &self.levels {
            for other in &others.levels {
                if own.is_cheaper_to_look_into(other) {
                    for entry in &other.entries {
                        own.for_each_near(entry, |index| visit(index, entry.index));
                    }
                } else {
                    for entry in &own.entries {
                        other.for_each_near(entry, |index| visit(entry.index, index));
                    }
                }
            }
        }
    }
}

/// 0 for spheres of more than half the largest reach, 1 of more than a quarter, and so on.
fn size_class(largest: f64, reach: f64) -> usize {
    let ratio = largest / reach;
    // The exponent field of the ratio, which is at least 1, is floor(log2).
    let log2 = (ratio.to_bits() >> 52) as usize & 0x7ff;
    (log2 - 1023).min(MAX_LEVELS - 1)
}

impl Level {
    /// Sorts the entries into their buckets (a counting sort, stable).
    fn arrange(&mut self) {
        self.entries.clear();
        self.starts.clear();
        let Some(&any) = self.unsorted.first() else { return };
        let buckets = (2 * self.unsorted.len()).next_power_of_two().max(BLOCK_CELLS);
        // Shifted by one place, which leaves room to count while sorting.
        self.starts.resize(buckets + 2, 0);
        for entry in &mut self.unsorted {
            entry.cell = cell_of(entry.center, self.cells_per_metre);
            self.starts[bucket_of(entry.cell, buckets) + 2] += 1;
        }
        for bucket in 2..buckets + 2 {
            self.starts[bucket] += self.starts[bucket - 1];
        }
        self.entries.resize(self.unsorted.len(), any);
        for &entry in &self.unsorted {
            let slot = &mut self.starts[bucket_of(entry.cell, buckets) + 1];
            self.entries[*slot as usize] = entry;
            *slot += 1;
        }
        self.starts.pop();
    }

    /// Entries of the bucket that `cell` falls into; some may be of other cells.
    fn bucket(&self, cell: [i32; 3]) -> &[Entry] {
        let bucket = bucket_of(cell, self.starts.len() - 1);
        &self.entries[self.starts[bucket] as usize..self.starts[bucket + 1] as usize]
    }

    fn try_for_each_pair<B>(
        &self,
        visit: &mut impl FnMut(u32, u32) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        for entry in &self.entries {
            for other in self.bucket(entry.cell) {
                let once = other.index > entry.index && other.cell == entry.cell;
                if once && other.meets(entry.center, entry.reach) {
                    visit(entry.index, other.index)?;
                }
            }
            for offset in HALF_OF_NEIGHBOURS {
                let Some(cell) = shifted(entry.cell, offset) else { continue };
                for other in self.bucket(cell) {
                    if other.cell == cell && other.meets(entry.center, entry.reach) {
                        visit(entry.index, other.index)?;
                    }
                }
            }
        }
        ControlFlow::Continue(())
    }

    /// Whether searching here for all spheres of `other` costs less than the reverse: a few spheres search many
    /// cells, or many search few.
    fn is_cheaper_to_look_into(&self, other: &Self) -> bool {
        let cost = |seeking: &Self, sought: &Self| {
            let span = 2.0 * (seeking.largest_reach + sought.largest_reach);
            let across = span * sought.cells_per_metre + 1.0;
            let cells = (across * across * across).min(sought.entries.len() as f64);
            seeking.entries.len() as f64 * cells.max(1.0)
        };
        cost(other, self) <= cost(self, other)
    }

    /// Visits the spheres of this level within reach of one of another level.
    fn for_each_near(&self, entry: &Entry, mut visit: impl FnMut(u32)) {
        let every: ControlFlow<()> = self.near(entry.center, entry.reach, |index| {
            visit(index);
            ControlFlow::Continue(())
        });
        debug_assert!(every.is_continue());
    }

    /// Visits the spheres of this level within `reach` \[m\] of `center`, until a visit breaks off.
    fn near<B>(
        &self,
        center: DVec3,
        reach: f64,
        mut visit: impl FnMut(u32) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        let span = DVec3::splat((reach + self.largest_reach) * CELL_SLACK);
        let low = cell_of(center - span, self.cells_per_metre);
        let high = cell_of(center + span, self.cells_per_metre);
        let cells = (0..3).map(|axis| f64::from(high[axis]) - f64::from(low[axis]) + 1.0);
        // A sphere far larger than the cells: fewer spheres to look at than cells.
        if cells.product::<f64>() > self.entries.len() as f64 {
            let mut near = self.entries.iter().filter(|entry| entry.meets(center, reach));
            return near.try_for_each(|entry| visit(entry.index));
        }
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                for z in low[2]..=high[2] {
                    for entry in self.bucket([x, y, z]) {
                        if entry.cell == [x, y, z] && entry.meets(center, reach) {
                            visit(entry.index)?;
                        }
                    }
                }
            }
        }
        ControlFlow::Continue(())
    }
}

/// Half of the 26 neighbours of a cell, so that each pair of cells comes up once.
const HALF_OF_NEIGHBOURS: [[i32; 3]; 13] = [
    [1, 0, 0],
    [-1, 1, 0],
    [0, 1, 0],
    [1, 1, 0],
    [-1, -1, 1],
    [0, -1, 1],
    [1, -1, 1],
    [-1, 0, 1],
    [0, 0, 1],
    [1, 0, 1],
    [-1, 1, 1],
    [0, 1, 1],
    [1, 1, 1],
];

/// Cell of a place. Beyond the range of i32 all places share the outermost cell: slow there, but
/// still right.
fn cell_of(place: DVec3, cells_per_metre: f64) -> [i32; 3] {
    let cell = (place * cells_per_metre).floor();
    [cell.x as i32, cell.y as i32, cell.z as i32]
}

fn shifted(cell: [i32; 3], by: [i32; 3]) -> Option<[i32; 3]> {
    Some([cell[0].checked_add(by[0])?, cell[1].checked_add(by[1])?, cell[2].checked_add(by[2])?])
}

/// Bucket of a cell in a table of `buckets`, a power of two: a hash of the block of cells it lies
/// in, then its place in the block.
fn bucket_of(cell: [i32; 3], buckets: usize) -> usize {
    let [x, y, z] = cell;
    let block = [x >> 2, y >> 2, z >> 2].map(|part| u64::from(part as u32));
    // Odd multipliers without structure (the fractions of the golden ratio, sqrt 2 and sqrt 3).
    let mixed = block[0]
        .wrapping_mul(0x9e37_79b9_7f4a_7c15)
        .wrapping_add(block[1].wrapping_mul(0x6a09_e667_f3bc_c909))
        .wrapping_add(block[2].wrapping_mul(0xbb67_ae85_84ca_a73b));
    let hash = ((mixed ^ (mixed >> 32)).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32) as usize;
    let in_block = ((x & 3) | (y & 3) << 2 | (z & 3) << 4) as usize;
    (hash * BLOCK_CELLS + in_block) & (buckets - 1)
}

#[cfg(test)]
mod tests {
    //! The broad phase against the loop over all pairs it replaces. Proves that no pair is lost
    //! or given twice, for radii from 1 to 1/1000, touching and aliased cells included.

    use super::*;

    /// A small generator of numbers in [0, 1): good enough to scatter spheres.
    struct Scatter(u64);

    impl Scatter {
        fn next(&mut self) -> f64 {
            self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (self.0 >> 11) as f64 / (1u64 << 53) as f64
        }

        fn point(&mut self, extent: DVec3) -> DVec3 {
            DVec3::new(self.next(), self.next(), self.next()) * extent
        }
    }

    fn all_pairs(spheres: &[(u32, DVec3, f64)], tolerance: f64) -> Vec<(u32, u32)> {
        let mut pairs = Vec::new();
        for (i, a) in spheres.iter().enumerate() {
            for b in &spheres[i + 1..] {
                if a.1.distance(b.1) <= a.2 + b.2 + tolerance {
                    pairs.push((a.0, b.0));
                }
            }
        }
        pairs
    }

    fn found_pairs(broad_phase: &BroadPhase) -> Vec<(u32, u32)> {
        let mut pairs = Vec::new();
        broad_phase.for_each_pair(|i, j| pairs.push((i.min(j), i.max(j))));
        pairs.sort_unstable();
        pairs
    }

    fn check(spheres: &[(u32, DVec3, f64)], tolerance: f64) -> usize {
        let mut broad_phase = BroadPhase::default();
        broad_phase.rebuild(spheres.iter().copied(), tolerance);
        let expected = all_pairs(spheres, tolerance);
        assert_eq!(found_pairs(&broad_phase), expected);
        check_between(spheres, &expected, tolerance);
        expected.len()
    }

    /// The pairs between two parts of the spheres, however large the parts are.
    fn check_between(spheres: &[(u32, DVec3, f64)], all: &[(u32, u32)], tolerance: f64) {
        for size in [1, 20, spheres.len() / 2] {
            let (mut some, mut others) = (BroadPhase::default(), BroadPhase::default());
            some.rebuild(spheres[..size].iter().copied(), tolerance);
            others.rebuild(spheres[size..].iter().copied(), tolerance);
            let mut found = Vec::new();
            some.for_each_pair_with(&others, |i, j| found.push((i, j)));
            found.sort_unstable();
            let is_between =
                |pair: &&(u32, u32)| (pair.0 as usize) < size && pair.1 as usize >= size;
            let expected: Vec<_> = all.iter().filter(is_between).copied().collect();
            assert_eq!(found, expected);
        }
    }

    #[test]
    fn finds_exactly_the_pairs_of_the_all_pairs_loop() {
        let mut scatter = Scatter(1);
        let extents = [
            DVec3::splat(8.0),
            DVec3::new(60.0, 0.0, 8.0),
            DVec3::new(500.0, 0.1, 0.0),
            DVec3::new(1e9, 3.0, 3.0),
        ];
        for extent in extents {
            let spheres: Vec<_> = (0..700)
                .map(|i| (i, scatter.point(extent) - 0.5 * extent, 0.3 + 0.3 * scatter.next()))
                .collect();
            check(&spheres, 1e-3);
        }
    }

    #[test]
    fn finds_pairs_of_radii_a_thousand_times_apart() {
        let mut scatter = Scatter(2);
        let spheres: Vec<_> = (0..900)
            .map(|i| {
                let radius = [1.0, 0.1, 0.03, 0.001][i as usize % 4] * (1.0 + scatter.next());
                (i, scatter.point(DVec3::splat(4.0)), radius)
            })
            .collect();
        assert!(check(&spheres, 0.0) > 1000);
    }

    #[test]
    fn finds_touching_lattice_neighbours_at_cell_boundaries() {
        let spheres: Vec<_> = (0..512u32)
            .map(|i| {
                let cell = DVec3::new((i % 8).into(), (i / 8 % 8).into(), (i / 64).into());
                (i, cell - 4.0, 0.5)
            })
            .collect();
        // Three directions, 7 x 8 x 8 neighbouring pairs each.
        assert_eq!(check(&spheres, 1e-9), 3 * 7 * 64);
    }
}
