//! Which surfaces spheres may meet, by the cells of a grid.

use glam::DVec3;

use super::grid::Grid;
use super::neighbours::Contents;
use super::periodic::way_round;
use crate::detect::surface_tree::Bounds;
use crate::surface::{Form, Role, Surface};

/// Bounds are widened by this factor: more than rounding.
const SLACK: f64 = 1.0 + 1e-6;

/// Surfaces at rest near each cell.
#[derive(Debug, Clone, Default)]
pub(super) struct NearSurfaces {
    /// Those of cell `c` are `surfaces[starts[c] .. starts[c + 1]]`; empty if there are none at all.
    starts: Vec<u32>,
    surfaces: Vec<NearSurface>,
}

/// A surface, or its image in the periodic box so many turns away.
#[derive(Debug, Clone, Copy)]
pub(super) struct NearSurface {
    pub surface: u32,
    pub turns: [i8; 3],
}

impl NearSurfaces {
    /// Finds the surfaces that are not farther than `reach` \[m\] along each axis from each cell.
    pub fn new(contents: Contents, grid: &Grid, reach: DVec3) -> Self {
        let mut near_surfaces = Self::default();
        if !contents.surfaces.iter().any(is_listed) {
            return near_surfaces;
        }
        let mut near = Vec::new();
        for cell in grid.cells() {
            near_surfaces.starts.push(near_surfaces.surfaces.len() as u32);
            let Bounds { min, max } = grid.bounds(cell);
            let bounds = Bounds { min: min - reach * SLACK, max: max + reach * SLACK };
            near_surfaces.add(contents, grid, bounds, &mut near);
        }
        near_surfaces.starts.push(near_surfaces.surfaces.len() as u32);
        near_surfaces
    }

    /// Whether there are no surfaces at all.
    pub fn is_empty(&self) -> bool {
        self.surfaces.is_empty()
    }

    pub fn of_cell(&self, cell: usize) -> &[NearSurface] {
        &self.surfaces[self.starts[cell] as usize..self.starts[cell + 1] as usize]
    }

    /// Appends what is within these bounds, images of bounded surfaces included.
    fn add(&mut self, contents: Contents, grid: &Grid, bounds: Bounds, near: &mut Vec<u32>) {
        for z in grid.image_turns(2) {
            for y in grid.image_turns(1) {
                for x in grid.image_turns(0) {
                    let turns = [x, y, z];
                    let shift = way_round(turns.map(i32::from), contents.period);
                    let bounds = Bounds { min: bounds.min - shift, max: bounds.max - shift };
                    contents.tree.near(&bounds, near);
                    let listed = near.iter().filter(|&&surface| {
                        let surface = &contents.surfaces[surface as usize];
                        let is_unbounded = matches!(surface.form, Form::HalfSpace { .. });
                        is_listed(surface) && (turns == [0; 3] || !is_unbounded)
                    });
                    self.surfaces.extend(listed.map(|&surface| NearSurface { surface, turns }));
                }
            }
        }
    }
}

/// Surfaces that move are near every sphere; they are not listed.
fn is_listed(surface: &Surface) -> bool {
    surface.role == Role::Deflects && surface.motion.is_at_rest()
}
