//! The order of spheres in memory: by cells of a grid, in layers.

use glam::DVec3;

use super::row::Row;

/// Cells along an axis at most; beyond, spheres share the outermost ones.
const MOST_CELLS: f64 = 1024.0;
/// Largest number of cells per sphere: where spheres are scattered, cells are wider. With few cells, spheres that
/// fly apart would share cells with many.
const CELLS_PER_SPHERE: f64 = 32.0;

/// A grid over all spheres. Its slowest axis makes layers.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Grid {
    /// The corner where cells begin along each axis \[m\].
    origin: DVec3,
    /// Cells per metre along each axis \[1/m\]; negative where the numbers of cells fall along it.
    cells_per_metre: DVec3,
    /// Width of a cell \[m\].
    width: f64,
    /// The axes, from the slowest to the fastest.
    axes: [usize; 3],
    /// Number of cells along each of the axes.
    pub cells: [usize; 3],
}

impl Grid {
    /// A grid over these centres \[m\] with cells of at least this width \[m\]. Its fastest axis is that of the
    /// forces: columns stay together, and a sphere comes before those on which it lies.
    pub fn over(centers: &[Row], width: f64, down: DVec3) -> Self {
        let bounds = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = centers
            .iter()
            .map(|row| row.vector())
            .fold(bounds, |(low, high), it| (low.min(it), high.max(it)));
        let extent = (high - low).max(DVec3::ZERO);
        let most = CELLS_PER_SPHERE * centers.len() as f64 + 64.0;
        let mut width = width.max(extent.max_element() / MOST_CELLS);
        let count = |width: f64| {
            let cells = (extent / width).floor() + 1.0;
            cells.x * cells.y * cells.z
        };
        while count(width) > most {
            width *= 1.25;
        }
        let fastest = if down == DVec3::ZERO { 1 } else { down.abs().max_position() };
        let [first, second] = [(fastest + 1) % 3, (fastest + 2) % 3];
        let [slowest, middle] =
            if extent[first] >= extent[second] { [first, second] } else { [second, first] };
        let axes = [slowest, middle, fastest];
        let cells = axes.map(|axis| (extent[axis] / width) as usize + 1);
        let (mut origin, mut cells_per_metre) = (low, DVec3::splat(1.0 / width));
        if down[fastest] < 0.0 {
            origin[fastest] = high[fastest];
            cells_per_metre[fastest] *= -1.0;
        }
        Self { origin, cells_per_metre, width, axes, cells }
    }

    /// Returns the width of a cell \[m\].
    pub fn width(&self) -> f64 {
        self.width
    }

    /// Returns the number of cells.
    pub fn len(&self) -> usize {
        self.cells.iter().product()
    }

    /// The cell of a place, along the axes from the slowest to the fastest.
    #[inline]
    pub fn cell_of(&self, center: DVec3) -> [usize; 3] {
        let offset = (center - self.origin) * self.cells_per_metre;
        let along = |rank: usize| (offset[self.axes[rank]] as usize).min(self.cells[rank] - 1);
        [along(0), along(1), along(2)]
    }

    /// The first and the last cells, along the axes from the slowest to the fastest, within `span` \[m\] of a
    /// place.
    pub fn cells_within(&self, center: DVec3, span: f64) -> [[usize; 3]; 2] {
        let span = DVec3::splat(span);
        let [one, other] = [self.cell_of(center - span), self.cell_of(center + span)];
        let of_both = |choose: fn(usize, usize) -> usize| {
            [0, 1, 2].map(|rank| choose(one[rank], other[rank]))
        };
        [of_both(usize::min), of_both(usize::max)]
    }

    /// The number of a cell.
    #[inline]
    pub fn number(&self, [layer, row, column]: [usize; 3]) -> usize {
        (layer * self.cells[1] + row) * self.cells[2] + column
    }
}

/// Sorts slots by cell, those of one cell by the index of the sphere. `slot_of` has the slot of each index,
/// `starts[c] .. starts[c + 1]` are the places of cell c in `order`.
pub(crate) fn sort(
    count: usize,
    cells: &[u32],
    slot_of: &[u32],
    starts: &mut Vec<u32>,
    order: &mut Vec<u32>,
) {
    starts.clear();
    // Shifted by one place, which leaves room to count while sorting.
    starts.resize(count + 2, 0);
    for &cell in cells {
        starts[cell as usize + 2] += 1;
    }
    for cell in 2..starts.len() {
        starts[cell] += starts[cell - 1];
    }
    order.clear();
    order.resize(cells.len(), 0);
    for &slot in slot_of {
        let place = &mut starts[cells[slot as usize] as usize + 1];
        order[*place as usize] = slot;
        *place += 1;
    }
}
