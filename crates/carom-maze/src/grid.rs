//! A grid of free and blocked cells.

/// Offsets of the eight neighbours of a cell: columns, rows, and distance in cells.
const NEIGHBOURS: [(isize, isize, f64); 8] = [
    (-1, 0, 1.0),
    (1, 0, 1.0),
    (0, -1, 1.0),
    (0, 1, 1.0),
    (-1, -1, std::f64::consts::SQRT_2),
    (1, -1, std::f64::consts::SQRT_2),
    (-1, 1, std::f64::consts::SQRT_2),
    (1, 1, std::f64::consts::SQRT_2),
];

/// Cells in rows, each free or blocked.
#[derive(Debug, Clone)]
pub(crate) struct Grid {
    /// Edge of a cell \[m\].
    pub cell: f64,
    pub columns: usize,
    pub rows: usize,
    pub free: Vec<bool>,
    /// Distance to the nearest blocked cell \[cells\]; 0 for blocked cells.
    pub clearance: Vec<f64>,
}

impl Grid {
    pub fn len(&self) -> usize {
        self.columns * self.rows
    }

    /// Returns the distance of a cell from the nearest blocked cell \[m\].
    pub fn clearance(&self, index: usize) -> f64 {
        self.cell * self.clearance.get(index).copied().unwrap_or(0.0)
    }

    /// Returns the neighbours of a cell with their distance \[cells\].
    pub fn neighbours(&self, index: usize) -> impl Iterator<Item = (usize, f64)> {
        let (columns, rows) = (self.columns, self.rows);
        let (column, row) = (index % columns, index / columns);
        NEIGHBOURS.into_iter().filter_map(move |(x, z, distance)| {
            let column = column.checked_add_signed(x).filter(|&it| it < columns)?;
            let row = row.checked_add_signed(z).filter(|&it| it < rows)?;
            Some((row * columns + column, distance))
        })
    }
}
