//! Groups points by grid cell.

use std::ops::Range;

/// Most cells along each axis, relative to the cube root of the number of points; with more, most
/// cells would be empty.
const CELLS_PER_ROOT: f64 = 2.0;

/// Points grouped by cells at least as wide as a given distance.
pub struct Cells {
    /// Number of cells along each axis.
    counts: [usize; 3],
    is_periodic: [bool; 3],
    /// Points by cell, wrapped into the box along periodic axes \[m\].
    pub points: Vec<[f64; 3]>,
    /// Original index of each point.
    pub order: Vec<usize>,
    /// Start of the points of each cell, followed by the end of the last one.
    starts: Vec<usize>,
}

impl Cells {
    /// Groups points \[m\] in a box with these sides \[m\]; sides are infinite along open axes.
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
                // Along an axis without extent, `part` is NaN, which the cast turns into cell 0.
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

    /// Number of cells.
    pub fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// Points of a cell, as indices of [`Self::points`].
    pub fn points_of(&self, cell: usize) -> Range<usize> {
        self.starts[cell]..self.starts[cell + 1]
    }

    /// Neighbours of a cell with greater numbers, each once, so that every pair of neighbours
    /// occurs once.
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

    /// The coordinate and its neighbours along an axis, each once.
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

/// Wraps a point into the box along periodic axes.
fn wrap(point: [f64; 3], sides: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|axis| {
        let (x, side) = (point[axis], sides[axis]);
        if side.is_finite() { x - (x / side).floor() * side } else { x }
    })
}
