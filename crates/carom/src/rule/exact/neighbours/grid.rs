//! Grids: which places are near each other.

use std::hint::select_unpredictable;
use std::ops::{Range, RangeInclusive};

use educe::Educe;
use glam::DVec3;

use crate::bounds::Bounds;

/// Up to this number of spheres, one cell for all of them is faster than any grid; along a periodic axis
/// [`CELLS_OF_FEW`], where one cell would bring the images on both sides of each sphere.
const SINGLE_CELL: usize = 24;
/// Cells along a periodic axis, at most, where spheres are few: a cell and those beside it hold each sphere once.
const CELLS_OF_FEW: f64 = 3.0;
/// Cells per sphere, at most.
const CELLS_PER_SPHERE: f64 = 4.0;
/// Cells along an axis, at most: a coordinate is 16 bits.
const MAX_CELLS: f64 = 65_000.0;

/// Cells of equal size. The outermost ones of an open axis reach to infinity; a periodic axis closes
/// on itself: beyond its ends are ghosts, which are copies of the cells at the other end.
#[derive(Debug, Educe)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Grid {
    /// Corner of cell (0, 0, 0) \[m\].
    origin: DVec3,
    /// Edges of a cell \[m\].
    width: DVec3,
    /// Inverse widths of the cells \[1/m\].
    per_metre: DVec3,
    counts: [u16; 3],
    periodic: [bool; 3],
    /// Difference between the numbers of a cell and of the next one along each axis, ghosts
    /// counted.
    strides: [usize; 3],
    /// A cell and those next to it, by axis and coordinate.
    runs: [Vec<[Run; 3]>; 3],
}

/// How many cells a grid has.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Layout {
    /// Number of cells along each axis.
    pub counts: [u16; 3],
    /// Whether each axis closes on itself.
    pub periodic: [bool; 3],
}

/// A block of cells around a cell, ghosts included, that share one image offset.
#[derive(Debug, Clone, Copy)]
pub(super) struct Block<'a> {
    grid: &'a Grid,
    /// Ghosts counted.
    first: [u16; 3],
    lens: [u16; 3],
    /// Whether these cells, or the one they are seen from, reach to infinity along each axis.
    pub is_endless: [bool; 3],
}

impl Block<'_> {
    /// How many cells there are.
    #[inline(always)]
    pub fn len(&self) -> usize {
        self.lens.iter().map(|&len| usize::from(len)).product()
    }

    /// Visits the cells, in rows or parts of rows, by their numbers with ghosts.
    #[inline(always)]
    pub fn for_each_row(&self, mut visit: impl FnMut(Range<usize>)) {
        // Most blocks are cubes or sides of cubes, whose loops need no counters.
        let [x, y, z] = self.grid.strides;
        let strides = match self.lens {
            [3, 3, 3] => return self.rows([3; 3], &mut visit),
            [1, 3, 3] => [y, z],
            [3, 1, 3] => [x, z],
            [3, 3, 1] => [x, y],
            lens => return self.rows(lens.map(usize::from), &mut visit),
        };
        // One cell after another, for a side in any direction.
        let first = self.grid.number_with_ghosts(self.first);
        for line in 0..3 {
            for place in 0..3 {
                let cell = first + place * strides[0] + line * strides[1];
                visit(cell..cell + 1);
            }
        }
    }

    #[inline(always)]
    fn rows(&self, [x, y, z]: [usize; 3], visit: &mut impl FnMut(Range<usize>)) {
        let [_, row, layer] = self.grid.strides;
        let mut first_of_layer = self.grid.number_with_ghosts(self.first);
        for _ in 0..z {
            let mut first = first_of_layer;
            for _ in 0..y {
                visit(first..first + x);
                first += row;
            }
            first_of_layer += layer;
        }
    }
}

/// A [`Block`] along one axis.
#[derive(Debug, Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Run {
    first: u16,
    len: u16,
    is_endless: bool,
}

impl Run {
    const NONE: Self = Self { first: 0, len: 0, is_endless: false };
}

/// A side of a cell: downward or upward along an axis.
#[derive(Debug, Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Side {
    axis: usize,
    step: i16,
}

impl Grid {
    /// A grid over these places \[m\]: its cells are at least `min_width` \[m\] wide, and no more than pay off for
    /// the number of spheres that `seek` each other.
    pub fn over(
        places: impl Iterator<Item = DVec3>,
        period: DVec3,
        min_width: f64,
        seek: usize,
    ) -> Self {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        places.for_each(|place| (low, high) = (low.min(place), high.max(place)));
        let periodic = [0, 1, 2].map(|axis| period[axis].is_finite());
        for axis in 0..3 {
            if periodic[axis] {
                (low[axis], high[axis]) = (-0.5 * period[axis], 0.5 * period[axis]);
            }
        }
        let extent = (high - low).max(DVec3::ZERO);
        let counts = match seek <= SINGLE_CELL {
            true => cell_counts_of_few([1; 3], periodic, extent / min_width),
            false => cell_counts([1; 3], extent, min_width, seek),
        };
        let width = DVec3::from_array([0, 1, 2].map(|axis| {
            let width = extent[axis] / f64::from(counts[axis]);
            if periodic[axis] { width } else { width.max(min_width) }
        }));
        let (strides, runs) = Default::default();
        let per_metre = width.recip();
        Self { origin: low, width, per_metre, counts, periodic, strides, runs }.with_runs()
    }

    /// A grid whose cells are parts of the cells of this one, none narrower than `min_width` \[m\].
    pub fn divided(&self, min_width: f64, seek: usize) -> Self {
        let counts = match seek <= SINGLE_CELL {
            true => cell_counts_of_few(self.counts, self.periodic, self.width / min_width),
            false => cell_counts(self.counts, self.width, min_width, seek),
        };
        let parts = [0, 1, 2].map(|axis| f64::from(counts[axis] / self.counts[axis]));
        let width = self.width / DVec3::from_array(parts);
        Self { width, per_metre: width.recip(), counts, ..self.clone() }.with_runs()
    }

    fn with_runs(self) -> Self {
        let runs = |axis| {
            let cells = 0..self.counts[axis];
            cells.map(|cell| self.runs_of(cell, axis, [-1, 1])).collect()
        };
        let [row, column, _] = self.counts_with_ghosts();
        Self { strides: [1, row, row * column], runs: [0, 1, 2].map(runs), ..self }
    }

    /// Returns the number of cells.
    pub fn len(&self) -> usize {
        self.counts.iter().map(|&count| usize::from(count)).product()
    }

    /// Returns the number of cells along each axis.
    pub fn layout(&self) -> Layout {
        Layout { counts: self.counts, periodic: self.periodic }
    }

    /// Returns the number of cells with ghosts.
    pub fn len_with_ghosts(&self) -> usize {
        self.counts_with_ghosts().into_iter().product()
    }

    /// Ghosts before the first cell of an axis, and behind the last.
    #[inline(always)]
    fn ghosts(&self, axis: usize) -> u16 {
        u16::from(self.periodic[axis])
    }

    #[inline(always)]
    fn counts_with_ghosts(&self) -> [usize; 3] {
        [0, 1, 2].map(|axis| usize::from(self.counts[axis] + 2 * self.ghosts(axis)))
    }

    /// The number of a cell whose coordinates count ghosts.
    #[inline(always)]
    fn number_with_ghosts(&self, cell: [u16; 3]) -> usize {
        let ([x, y, z], [_, row, layer]) = (cell.map(usize::from), self.strides);
        x + row * y + layer * z
    }

    /// Visits a cell and its ghosts, with their numbers and the image offset of each.
    #[inline(always)]
    pub fn for_each_copy(&self, cell: [u16; 3], mut visit: impl FnMut(usize, [i32; 3])) {
        // The ends of an axis may be one cell.
        let offsets = |axis: usize| {
            let [is_first, is_last] = [cell[axis] == 0, cell[axis] + 1 == self.counts[axis]];
            let is_periodic = self.periodic[axis];
            -i32::from(is_last & is_periodic)..1 + i32::from(is_first & is_periodic)
        };
        let place = |axis: usize, offset: i32| {
            let own = i32::from(cell[axis] + self.ghosts(axis));
            (own + offset * i32::from(self.counts[axis])) as u16
        };
        for z in offsets(2) {
            for y in offsets(1) {
                for x in offsets(0) {
                    let copy = [place(0, x), place(1, y), place(2, z)];
                    visit(self.number_with_ghosts(copy), [x, y, z]);
                }
            }
        }
    }

    /// Whether every axis closes on itself.
    #[inline(always)]
    pub fn is_closed(&self) -> bool {
        self.periodic == [true; 3]
    }

    /// Whether a body less than three cells away along each axis is nearer than all its images.
    pub fn is_wide(&self) -> bool {
        (0..3).all(|axis| !self.periodic[axis] || self.counts[axis] >= 6)
    }

    /// Edges of a cell \[m\].
    pub fn width(&self) -> DVec3 {
        self.width
    }

    /// Centre of a cell \[m\].
    #[inline]
    pub fn center(&self, cell: [u16; 3]) -> DVec3 {
        self.origin + (DVec3::from_array(cell.map(f64::from)) + 0.5) * self.width
    }

    /// The cell of a place in the box \[m\].
    pub fn cell_of(&self, place: DVec3) -> [u16; 3] {
        [0, 1, 2].map(|axis| {
            let cell = (place[axis] - self.origin[axis]) * self.per_metre[axis];
            // A conversion rounds to zero, and takes what is below it for zero.
            (cell as u16).min(self.counts[axis] - 1)
        })
    }

    pub fn index(&self, cell: [u16; 3]) -> usize {
        let [x, y, z] = cell.map(usize::from);
        x + usize::from(self.counts[0]) * (y + usize::from(self.counts[1]) * z)
    }

    /// Each cell, in the order of indices.
    pub fn cells(&self) -> impl Iterator<Item = [u16; 3]> + use<> {
        let [nx, ny, nz] = self.counts;
        (0..nz).flat_map(move |z| (0..ny).flat_map(move |y| (0..nx).map(move |x| [x, y, z])))
    }

    /// Bounds of a body at a place, extended to infinity where the cell of the place is endless.
    #[inline(always)]
    pub fn without_ends(&self, place: DVec3, low: DVec3, high: DVec3) -> (DVec3, DVec3) {
        if self.is_closed() {
            (low, high)
        } else {
            self.without_ends_of(self.cell_of(place), low, high)
        }
    }

    fn without_ends_of(&self, cell: [u16; 3], mut low: DVec3, mut high: DVec3) -> (DVec3, DVec3) {
        for axis in 0..3 {
            let open = !self.periodic[axis];
            if open && cell[axis] == 0 {
                low[axis] = f64::NEG_INFINITY;
            }
            if open && cell[axis] + 1 == self.counts[axis] {
                high[axis] = f64::INFINITY;
            }
        }
        (low, high)
    }

    /// Image offsets along an axis for which images may be near cells.
    pub fn image_offsets(&self, axis: usize) -> RangeInclusive<i8> {
        if self.periodic[axis] { -1..=1 } else { 0..=0 }
    }

    /// Bounds of the places of a cell \[m\].
    pub fn bounds(&self, cell: [u16; 3]) -> Bounds {
        let corner = self.origin + DVec3::from_array(cell.map(f64::from)) * self.width;
        let (min, max) = self.without_ends_of(cell, corner, corner + self.width);
        Bounds { min, max }
    }

    /// Visits the blocks of a cell and the cells next to it, or those on one side.
    #[inline(always)]
    pub fn for_each_block(&self, cell: [u16; 3], side: Option<Side>, mut visit: impl FnMut(Block)) {
        if (0..3).all(|axis| self.is_inside(axis, cell[axis])) {
            let mut first = [0, 1, 2].map(|axis| cell[axis] + self.ghosts(axis) - 1);
            let mut lens = [3; 3];
            if let Some(Side { axis, step }) = side {
                (first[axis], lens[axis]) = ((first[axis] + 1).wrapping_add_signed(step), 1);
            }
            visit(Block { grid: self, first, lens, is_endless: [false; 3] });
            return;
        }
        let runs = |axis| match side {
            Some(side) if side.axis == axis => self.runs_of(cell[axis], axis, [side.step; 2]),
            _ => self.runs[axis][usize::from(cell[axis])],
        };
        let [x, y, z] = [runs(0), runs(1), runs(2)];
        for z in z.into_iter().take_while(|run| run.len > 0) {
            for y in y.into_iter().take_while(|run| run.len > 0) {
                for x in x.into_iter().take_while(|run| run.len > 0) {
                    visit(Block {
                        grid: self,
                        first: [x.first, y.first, z.first],
                        lens: [x.len, y.len, z.len],
                        is_endless: [x.is_endless, y.is_endless, z.is_endless],
                    });
                }
            }
        }
    }

    /// The side of a cell on which another one lies, if it is a neighbour along one axis.
    pub fn side(&self, from: [u16; 3], to: [u16; 3]) -> Option<Side> {
        let [x, y, z] = [0, 1, 2].map(|axis| usize::from(from[axis] != to[axis]));
        // Without branches on the axis, which the processor cannot predict.
        let axis = y + 2 * z;
        if x + y + z != 1 {
            return None;
        }
        let last = i32::from(self.counts[axis]) - 1;
        let step = i32::from(to[axis]) - i32::from(from[axis]);
        // Around a periodic axis it is as many cells the other way.
        let step = select_unpredictable(step.abs() == last, -step.signum(), step);
        // In a ring of two cells, one is on both sides of the other.
        (last > 1 && step.abs() == 1).then_some(Side { axis, step: step as i16 })
    }

    /// Whether a cell has others next to it on both sides of an axis, and none of them, nor itself,
    /// reaches to infinity.
    #[inline(always)]
    fn is_inside(&self, axis: usize, cell: u16) -> bool {
        self.periodic[axis] || (cell >= 2 && cell + 2 < self.counts[axis])
    }

    /// A cell and those next to it along an axis, of these steps: runs in order, then empty ones.
    fn runs_of(&self, cell: u16, axis: usize, steps: [i16; 2]) -> [Run; 3] {
        if self.is_inside(axis, cell) {
            let first = (cell + self.ghosts(axis)).wrapping_add_signed(steps[0]);
            let run = Run { first, len: (steps[1] - steps[0] + 1) as u16, is_endless: false };
            return [run, Run::NONE, Run::NONE];
        }
        let count = i32::from(self.counts[axis]);
        let is_outermost = |cell: i32| cell == 0 || cell + 1 == count;
        let mut runs = [Run::NONE; 3];
        let mut next = 0;
        for step in steps[0]..=steps[1] {
            let number = i32::from(cell) + i32::from(step);
            if !(0..count).contains(&number) {
                continue;
            }
            let is_endless = is_outermost(number) || is_outermost(i32::from(cell));
            let last: &mut Run = &mut runs[usize::max(next, 1) - 1];
            if next > 0 && last.is_endless == is_endless {
                last.len += 1;
            } else {
                runs[next] = Run { first: number as u16, len: 1, is_endless };
                next += 1;
            }
        }
        runs
    }

    /// Position of a place in the box along a space-filling curve through the cells (Morton).
    pub fn curve_key(&self, place: DVec3) -> u64 {
        let cell = self.cell_of(place);
        (0..3).fold(0, |key, axis| key | spread(cell[axis]) << axis)
    }
}

/// Cells along each axis: a multiple of `counts`, where that many cells are `width` \[m\] wide. A cell is at least
/// `min_width` \[m\] wide, and there are no more cells than pay off for this number of spheres.
fn cell_counts(counts: [u16; 3], width: DVec3, min_width: f64, spheres: usize) -> [u16; 3] {
    if !width.is_finite() {
        return counts;
    }
    let budget = CELLS_PER_SPHERE * spheres as f64;
    let along = |min_width: f64| {
        [0, 1, 2].map(|axis| {
            let count = f64::from(counts[axis]);
            let most = (MAX_CELLS / count).floor();
            count * (width[axis] / min_width).floor().clamp(1.0, most)
        })
    };
    let is_divided = |cells: [f64; 3]| (0..3).any(|axis| cells[axis] > f64::from(counts[axis]));
    let mut min_width = min_width;
    // Widening by an eighth at a time comes within a third of the budget.
    while along(min_width).iter().product::<f64>() > budget && is_divided(along(min_width)) {
        min_width *= 1.125;
    }
    along(min_width).map(|count| count as u16)
}

/// Cells along each axis where spheres are few: more than in `counts` only along periodic axes that are not divided and
/// have room for these numbers of cells.
fn cell_counts_of_few(counts: [u16; 3], periodic: [bool; 3], room: DVec3) -> [u16; 3] {
    [0, 1, 2].map(|axis| {
        let is_divided = counts[axis] > 1 || !periodic[axis];
        if is_divided { counts[axis] } else { room[axis].floor().clamp(1.0, CELLS_OF_FEW) as u16 }
    })
}

/// The bits of a coordinate, each three places from the next.
fn spread(coordinate: u16) -> u64 {
    (0..16).fold(0, |bits, bit| bits | (u64::from(coordinate) >> bit & 1) << (3 * bit))
}
