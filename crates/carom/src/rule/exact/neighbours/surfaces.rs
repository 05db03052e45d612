//! Finds the surfaces that spheres may meet, by the cells of a grid.

use glam::DVec3;

use super::contents::Contents;
use super::grid::Grid;
use crate::bounds::Bounds;
use crate::rule::periodic::image_shift;
use crate::surface::{Form, Role, Surface};

/// Bounds are widened by this factor: more than rounding.
const SLACK: f64 = 1.0 + 1e-6;

/// Surfaces at rest near each cell.
#[derive(Debug, Clone, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct NearSurfaces {
    /// Places in `surfaces`: those of cell `c` are `surfaces[starts[c] .. starts[c + 1]]`; empty if
    /// there are none at all.
    starts: Vec<u32>,
    surfaces: Vec<NearSurface>,
}

/// A surface, or its image in the periodic box.
#[derive(Debug, Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct NearSurface {
    pub surface: u32,
    /// Boxes between the surface and the image.
    pub image_offset: [i8; 3],
}

/// Where the centres of spheres may be.
#[derive(Clone, Copy)]
struct Centers {
    bounds: Bounds,
    /// Radius of the spheres \[m\].
    radius: f64,
}

impl NearSurfaces {
    /// Finds the surfaces that spheres of this `radius` \[m\] may touch from each cell, or not farther
    /// from it than `overhang` \[m\] along each axis.
    pub fn new(contents: Contents, grid: &Grid, overhang: DVec3, radius: f64) -> Self {
        let mut near_surfaces = Self::default();
        if !contents.surfaces.iter().any(is_listed) {
            return near_surfaces;
        }
        let mut near = Vec::new();
        for cell in grid.cells() {
            near_surfaces.starts.push(near_surfaces.surfaces.len() as u32);
            let Bounds { min, max } = grid.bounds(cell);
            // The slack, in parts of the radius, is in the reach whatever the overhang.
            let overhang = overhang * SLACK + radius * (SLACK - 1.0);
            let centers = Bounds { min: min - overhang, max: max + overhang };
            near_surfaces.add(contents, grid, Centers { bounds: centers, radius }, &mut near);
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

    /// Appends what spheres with centres within these bounds and of this radius \[m\] may touch, images
    /// of bounded surfaces included.
    fn add(
        &mut self,
        contents: Contents,
        grid: &Grid,
        Centers { bounds: centers, radius }: Centers,
        near: &mut Vec<u32>,
    ) {
        for z in grid.image_offsets(2) {
            for y in grid.image_offsets(1) {
                for x in grid.image_offsets(0) {
                    let image_offset = [x, y, z];
                    let shift = image_shift(image_offset.map(i32::from), contents.period);
                    let centers = Bounds { min: centers.min - shift, max: centers.max - shift };
                    contents.tree.near(&centers.widened(radius), near);
                    let listed = near.iter().filter(|&&surface| {
                        let surface = &contents.surfaces[surface as usize];
                        let is_unbounded = matches!(surface.form, Form::HalfSpace { .. });
                        is_listed(surface)
                            && (image_offset == [0; 3] || !is_unbounded)
                            && !is_behind(&surface.form, &centers)
                    });
                    self.surfaces
                        .extend(listed.map(|&surface| NearSurface { surface, image_offset }));
                }
            }
        }
    }
}

/// Whether all centres within some bounds are behind a rectangle or a face, which only its front can meet.
fn is_behind(form: &Form, centers: &Bounds) -> bool {
    let rectangle = match form {
        Form::Rectangle(rectangle) => rectangle,
        Form::Facet(facet) => &facet.frame,
        _ => return false,
    };
    let part = |axis: usize| match rectangle.normal[axis] {
        0.0 => 0.0,
        n if n > 0.0 => n * (centers.max[axis] - rectangle.center[axis]),
        n => n * (centers.min[axis] - rectangle.center[axis]),
    };
    // By more than rounding; bounds that are infinite on the side of the front are never behind.
    let slack = (SLACK - 1.0) * rectangle.center.abs().element_sum();
    part(0) + part(1) + part(2) < -slack
}

/// Surfaces that move are near every sphere; they are not listed.
fn is_listed(surface: &Surface) -> bool {
    surface.role == Role::Deflects && surface.motion.is_at_rest()
}
