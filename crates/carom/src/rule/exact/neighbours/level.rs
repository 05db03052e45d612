//! A level of the hierarchy of cell lists.

use std::sync::Arc;

use educe::Educe;
use glam::DVec3;

use super::cells::Cells;
use super::contents::Contents;
use super::grid::Grid;
use super::region::OVERHANG;
use super::surfaces::NearSurfaces;

/// The spheres of one size class, by cell.
#[derive(Debug, Educe)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Level {
    pub grid: Grid,
    /// Half the edges of their neighbour regions \[m\].
    pub half_edges: DVec3,
    /// The spheres of this size.
    pub own: Cells,
    /// Smaller ones, if there are any.
    pub visitors: Option<Cells>,
    /// Shared by snapshots, as it may be large.
    pub surfaces: Arc<NearSurfaces>,
}

/// The cells of all levels, still empty.
pub(super) struct Levels {
    /// Levels from the largest spheres to the smallest.
    pub levels: Vec<Level>,
    /// Whether spheres are crowded, so that each needs a list of its neighbours.
    pub are_crowded: bool,
}

impl Levels {
    pub fn new(contents: Contents) -> Self {
        let mut grids = contents.grids();
        let mut half_edges: Vec<DVec3> =
            grids.iter().map(|grid| (0.5 + OVERHANG) * grid.width()).collect();
        let mut are_crowded = false;
        if let [grid] = &mut grids[..]
            && let Some(crowded) = contents.crowded_grid(grid)
        {
            half_edges = vec![crowded.half_edges];
            *grid = crowded.grid;
            are_crowded = true;
        }
        let count = grids.len();
        let numbered = (0u32..).zip(grids.into_iter().zip(half_edges));
        let level = |(number, (grid, half_edges)): (u32, (Grid, DVec3))| {
            // A region lies about the centre of its cell, unless there are lists.
            let overhang = if are_crowded { half_edges } else { half_edges - 0.5 * grid.width() };
            let radius = contents.radius_of(number);
            let cells = || Cells::new(grid.len_with_ghosts(), are_crowded);
            Level {
                own: cells(),
                visitors: (number as usize + 1 < count).then(cells),
                surfaces: Arc::new(NearSurfaces::new(contents, &grid, overhang, radius)),
                half_edges,
                grid,
            }
        };
        Self { levels: numbered.map(level).collect(), are_crowded }
    }
}
