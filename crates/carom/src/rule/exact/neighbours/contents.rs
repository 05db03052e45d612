//! The input of the neighbour search, and the grids that suit it.

use std::ops::Range;

use glam::DVec3;

use super::grid::Grid;
use super::region::OVERHANG;
use super::sliding::Sliding;
use crate::bounds::Bounds;
use crate::detect::surface_tree::SurfaceTree;
use crate::groups::Groups;
use crate::rule::exact::flights::{Flights, Species};
use crate::rule::periodic::wrapped;
use crate::surface::Surface;

/// Neighbour lists are kept if there are more spheres than this in a cell as wide as a diameter: then fewer
/// neighbours to test are worth the upkeep.
const CROWDED: f64 = 0.55;
/// Where there are lists, cells are wider than a diameter by this part of it, at least.
const LIST_MARGIN: f64 = 0.28;
/// Where there are more surfaces than this for each sphere, as in a mesh of many facets, cells divide the surfaces.
pub(crate) const SURFACES_PER_SPHERE: usize = 16;
/// Distances are compared with this margin, more than their rounding.
pub(super) const SLACK: f64 = 1.0 + 1e-9;

/// Spheres at some time, and surfaces.
#[derive(Clone, Copy)]
pub(crate) struct Contents<'a> {
    pub flights: &'a Flights,
    /// Time on the world's clock \[s\].
    pub time: f64,
    /// Edges of the periodic box about the origin \[m\]; infinite along an open axis.
    pub period: DVec3,
    /// Images of the box in steady shear.
    pub sliding: Option<Sliding>,
    pub surfaces: &'a [Surface],
    pub tree: &'a SurfaceTree,
    /// Whether spheres collide with each other.
    pub spheres_collide: bool,
    /// Groups of spheres, by index; empty where all spheres collide.
    pub groups: &'a [Groups],
    /// Index of each sphere, by slot.
    pub index_of: &'a [u32],
}

/// A grid for crowded spheres.
pub(super) struct CrowdedGrid {
    pub grid: Grid,
    /// Half the edges of the neighbour regions \[m\].
    pub half_edges: DVec3,
}

impl Contents<'_> {
    pub(super) fn position_of(&self, slot: u32) -> DVec3 {
        self.flights.state_of(slot, self.time).0
    }

    fn slots(&self) -> Range<u32> {
        0..self.flights.bodies.len() as u32
    }

    /// Groups of spheres by slot; empty where all bodies collide.
    pub(super) fn groups_by_slot(&self) -> Vec<Groups> {
        let is_special = |surface: &Surface| surface.groups != Groups::DEFAULT;
        if self.groups.is_empty() && !self.surfaces.iter().any(is_special) {
            return Vec::new();
        }
        let of = |&index: &u32| self.groups.get(index as usize).copied().unwrap_or_default();
        self.index_of.iter().map(of).collect()
    }

    fn level_count(&self) -> u32 {
        self.flights.species.iter().map(|species| species.level + 1).max().unwrap_or(0)
    }

    /// The largest radius of a level, or of one of smaller spheres, which may outgrow it \[m\].
    pub(super) fn radius_of(&self, level: u32) -> f64 {
        let has_level = |species: &&Species| species.level >= level;
        let of_level = self.flights.species.iter().filter(has_level);
        of_level.map(|it| self.flights.largest_radius(it)).fold(0.0, f64::max)
    }

    /// The grid of each level.
    pub(super) fn grids(&self) -> Vec<Grid> {
        let mut grids: Vec<Grid> = Vec::new();
        for level in 0..self.level_count() {
            let (min_width, seek) = self.cells_wanted(level);
            grids.push(match grids.last() {
                Some(above) => above.divided(min_width, seek),
                None => self.grid(min_width, seek),
            });
        }
        grids
    }

    /// Least width of the cells of a level \[m\], and the number of bodies that search in them. Spheres that pass
    /// through each other search for surfaces alone.
    fn cells_wanted(&self, level: u32) -> (f64, usize) {
        let radius = self.radius_of(level);
        if !self.spheres_collide {
            return (radius, self.surfaces.len());
        }
        let is_held = |&slot: &u32| self.flights.species_of(slot).level >= level;
        let width = match &self.sliding {
            Some(sliding) => sliding.width(2.0 * radius),
            None => 2.0 * radius / (1.0 - 2.0 * OVERHANG),
        };
        let spheres = self.slots().filter(is_held).count();
        let seek =
            if self.is_of_surfaces() { self.surfaces.len() / SURFACES_PER_SPHERE } else { spheres };
        (width * SLACK, seek)
    }

    /// Whether there are more than [`SURFACES_PER_SPHERE`] surfaces for each sphere.
    fn is_of_surfaces(&self) -> bool {
        self.surfaces.len() / SURFACES_PER_SPHERE > self.flights.bodies.len()
    }

    /// A grid over all spheres; over surfaces, too, where cells divide these.
    fn grid(&self, min_width: f64, seek: usize) -> Grid {
        let positions = self.slots().map(|slot| wrapped(self.position_of(slot), self.period));
        if !self.is_of_surfaces() {
            return Grid::over(positions, self.period, min_width, seek);
        }
        let corners = self.tree.bounds().into_iter().flat_map(|Bounds { min, max }| [min, max]);
        Grid::over(positions.chain(corners), self.period, min_width, seek)
    }

    /// A grid for lists of neighbours, if spheres are of one level and crowded in `grid`.
    pub(super) fn crowded_grid(&self, grid: &Grid) -> Option<CrowdedGrid> {
        let count = self.flights.bodies.len();
        let diameter = 2.0 * self.radius_of(0);
        let volume = grid.len() as f64 * grid.width().element_product();
        let crowd = count as f64 / volume * (diameter * diameter * diameter);
        // Lists need images that stand still.
        let is_still = self.sliding.is_none();
        let is_crowded =
            self.spheres_collide && is_still && self.level_count() == 1 && crowd > CROWDED;
        is_crowded.then(|| {
            let grid = self.grid(diameter * (1.0 + LIST_MARGIN), count);
            // Two adjacent regions, and the spheres that reach out of them, are as wide as a cell.
            let reach = grid.width().min_element() / (2.0 * SLACK);
            CrowdedGrid { half_edges: DVec3::splat(reach - self.radius_of(0)), grid }
        })
    }

    /// Slots in an order in which neighbours are near each other in memory: along a space-filling
    /// curve through the cells of the smallest spheres.
    pub fn curve_order(&self) -> Vec<u32> {
        let Some(grid) = self.grids().pop() else { return Vec::new() };
        let key = |slot: &u32| grid.curve_key(wrapped(self.position_of(*slot), self.period));
        let mut order: Vec<u32> = self.slots().collect();
        order.sort_by_cached_key(key);
        order
    }
}
