//! Cells: points by the place where they are.

use std::ops::Range;

/// Cells are no more along each axis than this times the cube root of the number of points: most would be empty.
const CELLS_PER_ROOT: f64 = 2.0;

/// Points in cells at least as wide as a distance.
pub struct Cells {
    /// Along each axis.
    counts: [usize; 3],
    is_periodic: [bool; 3],
    /// Points by cell, wrapped into the box along axes that are periodic \[m\].
    pub points: Vec<[f64; 3]>,
    /// Which point each was.
    pub order: Vec<usize>,
    /// Where the points of each cell begin, and behind the last one their end.
    starts: Vec<usize>,
}

impl Cells {
    /// Puts points \[m\] into cells of a box with these sides \[m\], infinite along axes that are open.
    pub fn new(points: &[[f64; 3]], sides: [f64; 3], distance: f64) -> Self {
        let is_periodic = sides.map(f64::is_finite);
        let wrapped: Vec<[f64; 3]> = points.iter().map(|&point| wrap(point, sides)).collect();
        let along = |axis: usize| wrapped.iter().map(move |point| point[axis]);
        let low = [0, 1, 2].map(|axis| match is_periodic[axis] {
            true => 0.0,
            false => along(axis).fold(f64::INFINITY, f64::min),
        });
        let most = (CELLS_PER_ROOT * (points.len() as f64).cbrt().ceil()).max(1.0);
        let extents = [0, 1, 2].map(|axis| match is_periodic[axis] {
            true => sides[axis],
            false => along(axis).fold(f64::NEG_INFINITY, f64::max) - low[axis],
        });
        let counts = extents.map(|extent| (extent / distance).floor().clamp(1.0, most) as usize);
        let cell_of = |point: &[f64; 3]| {
            let coordinate = |axis: usize| {
                let part = (point[axis] - low[axis]) / extents[axis];
                // Along an axis without extent it is not a number, and the first cell.
                ((part * counts[axis] as f64) as usize).min(counts[axis] - 1)
            };
            number(counts, [0, 1, 2].map(coordinate))
        };
        let cells: Vec<usize> = wrapped.iter().map(cell_of).collect();
        let mut order: Vec<usize> = (0..points.len()).collect();
        order.sort_by_key(|&point| cells[point]);
        let mut starts = vec![0; counts.iter().product::<usize>() + 1];
        cells.iter().for_each(|&cell| starts[cell + 1] += 1);
        for cell in 1..starts.len() {
            starts[cell] += starts[cell - 1];
        }
        let points = order.iter().map(|&point| wrapped[point]).collect();
        Self { counts, is_periodic, points, order, starts }
    }

    /// How many cells there are.
    pub fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// The points of a cell, by their places in [`Self::points`].
    pub fn points_of(&self, cell: usize) -> Range<usize> {
        self.starts[cell]..self.starts[cell + 1]
    }

    /// The cells around one whose numbers are greater, each once: every two neighbours come together once.
    pub fn greater_neighbours(&self, cell: usize) -> Vec<usize> {
        let [_, rows, columns] = self.counts;
        let place = [cell / (rows * columns), cell / columns % rows, cell % columns];
        let near = [0, 1, 2].map(|axis| self.near(axis, place[axis]));
        let mut greater = Vec::with_capacity(27);
        for &x in &near[0] {
            for &y in &near[1] {
                greater.extend(near[2].iter().map(|&z| number(self.counts, [x, y, z])));
            }
        }
        greater.retain(|&other| other > cell);
        greater
    }

    /// The coordinates next to one along an axis, and its own, each once.
    fn near(&self, axis: usize, coordinate: usize) -> Vec<usize> {
        let count = self.counts[axis];
        match (self.is_periodic[axis], count) {
            (true, 0..=2) => (0..count).collect(),
            (true, _) => [count - 1, 0, 1].map(|step| (coordinate + step) % count).to_vec(),
            (false, _) => (coordinate.saturating_sub(1)..(coordinate + 2).min(count)).collect(),
        }
    }
}

fn number([_, rows, columns]: [usize; 3], [x, y, z]: [usize; 3]) -> usize {
    (x * rows + y) * columns + z
}

/// A point in the box, from 0 to its sides along axes that are periodic.
fn wrap(point: [f64; 3], sides: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|axis| {
        let (x, side) = (point[axis], sides[axis]);
        if side.is_finite() { x - (x / side).floor() * side } else { x }
    })
}
