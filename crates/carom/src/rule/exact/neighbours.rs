//! Neighbours: whom a sphere can meet before one of them leaves its neighbourhood.
//!
//! Each sphere has a neighbourhood, a box about a place where it was. It leaves it by an event of
//! its own, and gets another one; between such events the spheres near it stay the same.
//!
//! Who is near is found in a hierarchy of grids. A level holds the spheres of one size class, and
//! as visitors all smaller ones; its cells are parts of those of the level above. Two spheres that
//! can meet lie in the same or in adjacent cells of the level of the larger one. As a rule the
//! neighbourhood of a sphere is its cell, and the spheres in the cells around it may be met.
//!
//! Where spheres of one size are crowded, that would be many. There a neighbourhood is a cube about
//! the sphere itself, and each has a list of the others that it can meet while both are in theirs
//! (Donev, Torquato and Stillinger, J. Comput. Phys. 202, 737 (2005)).
//!
//! In a periodic box places are folded into the box, and each sphere counts how often it went round
//! since its flight began. On open axes the outermost cells, and the neighbourhoods in them, reach
//! to infinity, so spheres may go anywhere.
//!
//! Neighbours decide only when a meeting is noticed, never its time: results do not depend on them.

use std::mem::take;

use fearless_simd::{Simd, SimdMask, dispatch};
use glam::DVec3;
use prefetch_index::prefetch_index;

use super::axis_motion::AxisMotion;
use super::body::{Body, Kind};
use super::cells::Cells;
use super::grid::{Grid, Side};
use super::lists::Lists;
use super::near_surfaces::NearSurfaces;
use super::neighbour::{IMAGES, Neighbour};
use super::periodic::{self, folded, turns_of, way_round};
use super::vicinity::{NeighbourLists, Vicinity, are_in_same_box};
use crate::detect::surface_tree::SurfaceTree;
use crate::lanes::{LANES, Lanes};
use crate::norm::Norm;
use crate::real::Vector;
use crate::surface::Surface;

/// Radii within this factor share a level.
const LEVEL_RATIO: f64 = 4.0;
/// Smaller spheres than `LEVEL_RATIO` to the minus this share the last level.
const MAX_LEVELS: usize = 24;
/// A neighbourhood reaches beyond the cell by this part of its width, so that a sphere that leaves it is
/// in another cell, whatever rounding does.
const OVERHANG: f64 = 1.0 / 256.0;
/// A sphere has left its neighbourhood when it is this part of the half edge away from the centre:
/// the rest is more than rounding, of places and of the clock.
const DEPARTURE: f64 = 1.0 - 1.0 / 512.0;
/// Lists are kept if there are more spheres than this to a cell as wide as a diameter: then to
/// look at fewer neighbours is worth the upkeep.
const CROWDED: f64 = 0.55;
/// Where there are lists, cells are wider than a diameter by this part of it, at least.
const LIST_ROOM: f64 = 0.28;
/// Where there are lists, a neighbourhood is laid ahead of its sphere by this part of its half edge.
const AHEAD: f64 = 0.5;
/// Distances are compared with this margin, more than their rounding.
const SLACK: f64 = 1.0 + 1e-9;

/// The neighbourhoods of all spheres, and who is near whom.
#[derive(Debug, Clone, Default)]
pub(super) struct Neighbours {
    /// From the largest spheres to the smallest.
    levels: Vec<Level>,
    /// By slot.
    neighbourhoods: Vec<Neighbourhood>,
    /// By slot, where spheres are crowded.
    lists: Option<NeighbourLists>,
    /// Edges of the periodic box \[m\]; infinite along an open axis.
    period: DVec3,
    /// Edges of the periodic box \[m\]; 0 along an open axis, which has no images.
    edges: DVec3,
    /// One over the edges of the box \[1/m\], 0 along an open axis.
    per_edge: DVec3,
    images: Images,
    /// The way to each image there \[m\], by its number.
    ways_to_images: [DVec3; IMAGES],
    /// Whether spheres have to find each other at all.
    spheres_collide: bool,
    /// Working memory of a relocation: neighbours before and after.
    before: Vicinity,
    after: Vicinity,
}

/// How images of spheres are told from others.
#[derive(Debug, Clone, Copy, Default)]
pub(super) enum Images {
    /// There are none: all axes are open.
    #[default]
    None,
    /// One near a sphere is nearer than all its other images.
    ByPlace,
    /// In a narrow box, by their marks in cells and lists.
    ByMark,
}

/// The spheres of one size class.
#[derive(Debug, Clone)]
struct Level {
    grid: Grid,
    /// Half the edges of their neighbourhoods \[m\].
    half_edges: DVec3,
    /// Its spheres.
    own: Cells,
    /// Smaller ones, if there are any.
    visitors: Option<Cells>,
    surfaces: NearSurfaces,
}

/// Where a sphere is until it leaves.
#[derive(Debug, Clone, Copy)]
struct Neighbourhood {
    /// In the box \[m\].
    center: DVec3,
    /// That of the sphere, or more by its rounding \[m\].
    radius: f32,
    /// How often the sphere went round each periodic axis since its flight began.
    turns: [i32; 3],
}

impl Neighbourhood {
    #[inline(always)]
    fn turns_in_numbers(&self) -> DVec3 {
        DVec3::from_array(self.turns.map(f64::from))
    }
}

/// What neighbours are found from.
#[derive(Clone, Copy)]
pub(super) struct Contents<'a> {
    pub bodies: &'a [Body],
    pub kinds: &'a [Kind],
    /// On the world's clock \[s\].
    pub time: f64,
    /// Edges of the periodic box about the origin \[m\]; infinite along an open axis.
    pub period: DVec3,
    pub surfaces: &'a [Surface],
    pub tree: &'a SurfaceTree,
    /// Whether spheres have to find each other at all.
    pub spheres_collide: bool,
}

impl Contents<'_> {
    fn place_of(&self, body: &Body) -> DVec3 {
        body.state_at(&self.kinds[body.kind as usize], self.time).0
    }

    fn level_count(&self) -> u32 {
        self.kinds.iter().map(|kind| kind.level + 1).max().unwrap_or(0)
    }

    /// The largest radius of a level \[m\].
    fn radius_of(&self, level: u32) -> f64 {
        let of_level = self.kinds.iter().filter(|kind| kind.level == level);
        of_level.map(|kind| kind.radius).fold(0.0, f64::max)
    }

    /// The grid of each level.
    fn grids(&self) -> Vec<Grid> {
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

    /// How wide the cells of a level have to be at least \[m\], and how many things look for each
    /// other in them. Spheres that pass through each other look for surfaces alone.
    fn cells_wanted(&self, level: u32) -> (f64, usize) {
        let radius = self.radius_of(level);
        if !self.spheres_collide {
            return (radius, self.surfaces.len());
        }
        let is_held = |body: &&Body| self.kinds[body.kind as usize].level >= level;
        let diameter = 2.0 * radius / (1.0 - 2.0 * OVERHANG) * SLACK;
        (diameter, self.bodies.iter().filter(is_held).count())
    }

    /// A grid over all spheres.
    fn grid(&self, min_width: f64, seek: usize) -> Grid {
        let places = self.bodies.iter().map(|body| folded(self.place_of(body), self.period));
        Grid::over(places, self.period, min_width, seek)
    }

    /// A grid for lists of neighbours, if spheres are of one level and crowded in `grid`.
    fn grid_for_lists(&self, grid: &Grid) -> Option<Grid> {
        let count = self.bodies.len();
        let diameter = 2.0 * self.radius_of(0);
        let volume = grid.len() as f64 * grid.width().element_product();
        let crowd = count as f64 / volume * (diameter * diameter * diameter);
        let lists = self.spheres_collide && self.level_count() == 1 && crowd > CROWDED;
        lists.then(|| self.grid(diameter * (1.0 + LIST_ROOM), count))
    }

    /// Slots in an order in which neighbours are near each other in memory: along a space-filling
    /// curve through the cells of the smallest spheres.
    pub fn curve_order(&self) -> Vec<u32> {
        let Some(grid) = self.grids().pop() else { return Vec::new() };
        let key = |slot: &u32| {
            let place = self.place_of(&self.bodies[*slot as usize]);
            grid.curve_key(folded(place, self.period))
        };
        let mut order: Vec<u32> = (0..self.bodies.len() as u32).collect();
        order.sort_by_cached_key(key);
        order
    }
}

/// Level of each radius, from 0 for the largest, with no empty level between.
pub(super) fn levels_of(radii: &[f64]) -> Vec<u32> {
    let largest = radii.iter().copied().fold(0.0, f64::max);
    let size_class = |radius: f64| {
        let mut class = 0;
        let mut bound = largest / LEVEL_RATIO;
        while radius <= bound && class + 1 < MAX_LEVELS {
            (class, bound) = (class + 1, bound / LEVEL_RATIO);
        }
        class
    };
    let mut in_use = [false; MAX_LEVELS];
    radii.iter().for_each(|&radius| in_use[size_class(radius)] = true);
    let level = |radius: f64| in_use[..size_class(radius)].iter().filter(|used| **used).count();
    radii.iter().map(|&radius| level(radius) as u32).collect()
}

impl Neighbours {
    /// Finds who is near whom.
    pub fn new(contents: Contents) -> Self {
        let Contents { bodies, kinds, period, spheres_collide, .. } = contents;
        let mut grids = contents.grids();
        let mut lists = None;
        let mut half_edges: Vec<DVec3> =
            grids.iter().map(|grid| (0.5 + OVERHANG) * grid.width()).collect();
        if let [grid] = &mut grids[..]
            && let Some(wider) = contents.grid_for_lists(grid)
        {
            // Two neighbourhoods side by side, and the spheres that reach out of them, are as wide
            // as a cell.
            let reach = wider.width().min_element() / (2.0 * SLACK);
            half_edges = vec![DVec3::splat(reach - contents.radius_of(0))];
            *grid = wider;
            lists = Some(Lists::new(bodies.len()));
        }
        let count = grids.len();
        let levels = (0u32..).zip(grids.into_iter().zip(half_edges));
        let levels = levels.map(|(number, (grid, half_edges))| {
            // A neighbourhood lies about the centre of its cell, unless there are lists.
            let overhang =
                if lists.is_some() { half_edges } else { half_edges - 0.5 * grid.width() };
            let radius = contents.radius_of(number);
            let cells = || Cells::new(grid.len_with_ghosts(), lists.is_some());
            Level {
                own: cells(),
                visitors: (number as usize + 1 < count).then(cells),
                surfaces: NearSurfaces::new(contents, &grid, overhang, radius),
                half_edges,
                grid,
            }
        });
        let levels: Vec<Level> = levels.collect();
        let nowhere = |body: &Body| Neighbourhood {
            center: DVec3::ZERO,
            radius: rounded_up(kinds[body.kind as usize].radius),
            turns: [0; 3],
        };
        // Who is near is less than three cells away along each axis, of the coarsest grid.
        let images = match levels.first() {
            _ if !period.is_finite_mask().any() => Images::None,
            Some(level) if level.grid.is_wide() => Images::ByPlace,
            _ => Images::ByMark,
        };
        let mut neighbours = Self {
            levels,
            neighbourhoods: bodies.iter().map(nowhere).collect(),
            lists,
            period,
            edges: DVec3::select(period.is_finite_mask(), period, DVec3::ZERO),
            per_edge: period.recip(),
            images,
            ways_to_images: Neighbour::ways_to_images(period),
            spheres_collide,
            ..Self::default()
        };
        let mut new = Vicinity::default();
        for (slot, body) in (0u32..).zip(bodies) {
            let (kind, place) = (&kinds[body.kind as usize], contents.place_of(body));
            let cell = neighbours.place(slot, kind.level, place, body.velocity);
            neighbours.enter_cells(slot, kind.level, cell);
            if neighbours.lists.is_some() {
                new.clear();
                neighbours.list(slot, &mut new);
            }
        }
        neighbours
    }

    /// Whether a sphere is found among those near it.
    #[inline(always)]
    pub fn finds_itself(&self) -> bool {
        self.lists.is_none()
    }

    /// Finds the spheres that the one at `slot`, of level `level`, may meet before one of them
    /// leaves its neighbourhood, perhaps with itself.
    #[inline(always)]
    pub fn find(&self, slot: u32, level: u32, near: &mut Vicinity) {
        near.clear();
        let Some(lists) = &self.lists else {
            let cell = self.cell_of(slot, &self.levels[level as usize].grid);
            return self.gather(slot, level, (cell, None), near);
        };
        near.add_list(lists, slot);
    }

    /// Has it fetched into the cache where a sphere is, and its list if there are lists.
    #[inline]
    pub fn prefetch_place(&self, slot: u32) {
        self.prefetch_neighbourhood(slot);
        if let Some(lists) = &self.lists {
            lists.prefetch(slot as usize);
        }
    }

    /// A neighbourhood, from its beginning to its end: that may be two lines of the cache.
    #[inline(always)]
    fn prefetch_neighbourhood(&self, slot: u32) {
        prefetch_index(&self.neighbourhoods, slot as usize);
        prefetch_index(&self.neighbourhoods, slot as usize + 1);
    }

    /// Prefetches the cells around a sphere, if they are needed: where there are lists, only if it
    /// leaves its neighbourhood.
    #[inline]
    pub fn prefetch_cells(&self, slot: u32, leaves: bool) {
        let [Level { grid, own, .. }] = &self.levels[..] else { return };
        if self.lists.is_some() && !leaves {
            return;
        }
        grid.for_each_block(self.cell_of(slot, grid), None, |block| {
            block.for_each_row(|row| {
                own.prefetch(row.start);
                own.prefetch(row.end - 1);
            });
        });
    }

    /// Prefetches, if there are lists, the `bodies` of those on the list of a sphere; if it leaves its
    /// neighbourhood, where those are who may come onto its list.
    #[inline]
    pub fn prefetch_near(&self, slot: u32, leaves: bool, bodies: &[Body]) {
        let ([Level { grid, own, .. }], Some(lists)) = (&self.levels[..], &self.lists) else {
            return;
        };
        if !leaves {
            let near = lists.first(slot as usize).iter();
            return near.for_each(|near| prefetch_index(bodies, near.slot() as usize));
        }
        grid.for_each_block(self.cell_of(slot, grid), None, |block| {
            block.for_each_row(|row| {
                for other in row.flat_map(|cell| own.first(cell)) {
                    self.prefetch_neighbourhood(other.slot());
                }
            });
        });
    }

    /// Where to a neighbour of the sphere at `slot` has to be shifted to be near \[m\].
    pub fn shift_of(&self, slot: u32, neighbour: Neighbour) -> DVec3 {
        if neighbour.is_in_same_box() {
            return DVec3::ZERO;
        }
        let turns = self.turns_between(slot, neighbour.slot(), neighbour.image_turns());
        way_round(turns, self.period)
    }

    /// The image offsets of several neighbours, side by side.
    #[inline(always)]
    pub fn shifts_of<S: Simd>(
        &self,
        simd: S,
        slot: u32,
        some: &[Neighbour; LANES],
    ) -> Vector<Lanes<S>> {
        // In whole numbers, which are exact.
        let turns = |slot: u32| self.neighbourhoods[slot as usize].turns_in_numbers();
        let here = Vector::all(simd, turns(slot));
        let there = Vector::each(simd, some.each_ref().map(|one| turns(one.slot())));
        let images = some.each_ref().map(|one| one.image_turns_in_numbers());
        let is_image = Lanes::each(simd, images.map(|image| image.1));
        let in_box = Vector::each(simd, images.map(|image| image.0));
        ((in_box + (here - there)) * is_image).scaled(Vector::all(simd, self.edges))
    }

    /// How images are told from others.
    #[inline(always)]
    pub fn images(&self) -> Images {
        self.images
    }

    /// Where to neighbours have to be shifted to be near, where images are told by their places, from
    /// their offsets at a time when all are in their neighbourhoods \[m\].
    #[inline(always)]
    pub fn shifts_to_nearest<S: Simd>(
        &self,
        simd: S,
        offset: Vector<Lanes<S>>,
    ) -> Vector<Lanes<S>> {
        let turns = offset.scaled(Vector::all(simd, self.per_edge)).rounded(simd);
        turns.scaled(Vector::all(simd, -self.edges))
    }

    /// The ways to images of spheres in the box about the origin \[m\].
    #[inline(always)]
    fn ways_to<S: Simd>(&self, simd: S, some: &[Neighbour; LANES]) -> Vector<Lanes<S>> {
        let ways = some.each_ref().map(|one| &self.ways_to_images[one.image_number()]);
        Vector::each(simd, ways.map(|way| *way))
    }

    /// Turns between where the positions of two spheres count, when in the box there are so many.
    fn turns_between(&self, slot: u32, other: u32, in_box: [i32; 3]) -> [i32; 3] {
        let turns = |slot: u32, axis: usize| self.neighbourhoods[slot as usize].turns[axis];
        [0, 1, 2].map(|axis| in_box[axis] + turns(slot, axis) - turns(other, axis))
    }

    /// From the box about the origin to where the position of the sphere counts \[m\].
    #[inline]
    pub fn way_round(&self, slot: u32) -> DVec3 {
        self.neighbourhoods[slot as usize].turns_in_numbers() * self.edges
    }

    /// Surfaces that the sphere may meet in its neighbourhood, with the shift \[m\] that brings them to
    /// where its position counts.
    pub fn surfaces_near(&self, slot: u32, level: u32) -> impl Iterator<Item = (u32, DVec3)> {
        let Level { grid, surfaces, .. } = &self.levels[level as usize];
        let turns = self.neighbourhoods[slot as usize].turns;
        let near = if surfaces.is_empty() {
            &[]
        } else {
            surfaces.of_cell(grid.index(self.cell_of(slot, grid)))
        };
        near.iter().map(move |near| {
            let shift = match (near.turns, turns) {
                ([0, 0, 0], [0, 0, 0]) => DVec3::ZERO,
                (of_image, turns) => {
                    let turns = [0, 1, 2].map(|axis| i32::from(of_image[axis]) + turns[axis]);
                    way_round(turns, self.period)
                }
            };
            (near.surface, shift)
        })
    }

    /// A time before which the sphere does not leave its neighbourhood, on the world's clock \[s\].
    #[inline(always)]
    pub fn departure(&self, slot: u32, body: &Body, kind: &Kind, now: f64) -> f64 {
        let Level { grid, half_edges, .. } = &self.levels[kind.level as usize];
        let center = self.neighbourhoods[slot as usize].center;
        let center_here = center + self.way_round(slot);
        let half_edges = DEPARTURE * half_edges;
        if grid.is_closed() && kind.flies_straight() {
            // Without branches on the direction, which no processor can foresee. What is at rest on
            // a side has 0 / 0 there, which is never the least.
            let velocity = body.velocity;
            let offset = center_here - (body.position + (now - body.time) * velocity);
            let distance = half_edges + DVec3::ONE.copysign(velocity) * offset;
            let first = (distance.max(DVec3::ZERO) / velocity.abs()).min_element();
            return (now + first).max(now.next_up());
        }
        let (position, velocity) = body.state_at(kind, now);
        let offset = center_here - position;
        let (low, high) = grid.without_ends(center, offset - half_edges, offset + half_edges);
        let mut first = f64::INFINITY;
        for axis in 0..3 {
            let motion = AxisMotion {
                velocity: velocity[axis],
                acceleration: kind.acceleration[axis],
                drag_rate: kind.drag_rate,
            };
            first = first.min(motion.leaves(low[axis], high[axis]));
        }
        // The clock has to move on, however fast the sphere is.
        (now + first).max(now.next_up())
    }

    /// Whether the sphere certainly does not leave its neighbourhood until `horizon`, on the world's
    /// clock \[s\].
    #[inline]
    pub fn stays(&self, slot: u32, body: &Body, kind: &Kind, horizon: f64) -> bool {
        let Level { half_edges, .. } = &self.levels[kind.level as usize];
        let center = self.neighbourhoods[slot as usize].center;
        let offset = center + self.way_round(slot) - body.position;
        let way = body.flight(kind).farthest(horizon - body.time);
        (offset.abs() + way).cmple(DEPARTURE * half_edges).all()
    }

    /// Gives a sphere that is at `position` \[m\] with `velocity` \[m/s\] another neighbourhood, and
    /// finds those who were not near it before, perhaps with others who were and with itself.
    pub fn relocate(
        &mut self,
        slot: u32,
        level: u32,
        [position, velocity]: [DVec3; 2],
        near: &mut Vicinity,
    ) {
        near.clear();
        let before = self.cell_of(slot, &self.levels[level as usize].grid);
        self.leave_cells(slot, level, before);
        let cell = self.place(slot, level, position, velocity);
        self.enter_cells(slot, level, cell);
        if self.lists.is_some() {
            self.list(slot, near);
        } else {
            let side = self.levels[level as usize].grid.side(before, cell);
            self.gather(slot, level, (cell, side), near);
        }
    }

    /// Lays the neighbourhood of a sphere about it, and gives the cell that it lies about.
    fn place(&mut self, slot: u32, level: u32, position: DVec3, velocity: DVec3) -> [u16; 3] {
        let Level { grid, half_edges, .. } = &self.levels[level as usize];
        let neighbourhood = &mut self.neighbourhoods[slot as usize];
        let is_listed = self.lists.is_some();
        let speed = if is_listed { velocity.norm() } else { 0.0 };
        let ahead = if speed > 0.0 && speed.is_finite() {
            AHEAD * half_edges * (velocity / speed)
        } else {
            DVec3::ZERO
        };
        let center = position + ahead;
        neighbourhood.turns = turns_of(center, self.period);
        neighbourhood.center = center - way_round(neighbourhood.turns, self.period);
        let cell = grid.cell_of(neighbourhood.center);
        if !is_listed {
            neighbourhood.center = grid.center(cell);
        }
        cell
    }

    /// The cell of a grid that the neighbourhood of a sphere lies about.
    #[inline(always)]
    fn cell_of(&self, slot: u32, grid: &Grid) -> [u16; 3] {
        grid.cell_of(self.neighbourhoods[slot as usize].center)
    }

    /// The sphere, as it is seen from the box about the origin.
    fn mark(&self, slot: u32) -> Neighbour {
        match self.neighbourhoods[slot as usize].turns {
            [0, 0, 0] => Neighbour::in_same_box(slot),
            _ => Neighbour::image(slot, [0; 3]),
        }
    }

    fn enter_cells(&mut self, slot: u32, level: u32, own_cell: [u16; 3]) {
        self.for_its_cells(slot, (level, own_cell), |cells, cell, mark| cells.add(cell, mark));
    }

    fn leave_cells(&mut self, slot: u32, level: u32, own_cell: [u16; 3]) {
        self.for_its_cells(slot, (level, own_cell), |cells, cell, mark| cells.remove(cell, mark));
    }

    /// Does something about a sphere, or an image of it, in its cell, in those that hold it on the
    /// levels above, and in the ghosts of these.
    #[inline]
    fn for_its_cells(
        &mut self,
        slot: u32,
        (own_level, own_cell): (u32, [u16; 3]),
        mut act: impl FnMut(&mut Cells, usize, Neighbour),
    ) {
        let own_mark = self.mark(slot);
        let mark = |turns| if turns == [0; 3] { own_mark } else { Neighbour::image(slot, turns) };
        let mut act = |grid: &Grid, cells: &mut Cells, cell| {
            grid.for_each_copy(cell, |number, turns| act(cells, number, mark(turns)));
        };
        let center = self.neighbourhoods[slot as usize].center;
        for Level { grid, visitors, .. } in &mut self.levels[..own_level as usize] {
            if let Some(visitors) = visitors {
                act(grid, visitors, grid.cell_of(center));
            }
        }
        let Level { grid, own, .. } = &mut self.levels[own_level as usize];
        act(grid, own, own_cell);
    }

    /// Appends the spheres in the cells around a sphere, whose own cell is given; of its own level,
    /// and of smaller spheres, those on one side, if one is given.
    #[inline(always)]
    fn gather(
        &self,
        slot: u32,
        own_level: u32,
        (cell, side): ([u16; 3], Option<Side>),
        near: &mut Vicinity,
    ) {
        if !self.spheres_collide {
            return;
        }
        for Level { grid, own, .. } in &self.levels[..own_level as usize] {
            self.gather_from((grid, own), slot, (self.cell_of(slot, grid), None), near);
        }
        let Level { grid, own, visitors, .. } = &self.levels[own_level as usize];
        self.gather_from((grid, own), slot, (cell, side), near);
        if let Some(visitors) = visitors {
            self.gather_from((grid, visitors), slot, (cell, side), near);
        }
    }

    /// Appends the spheres in a cell and those around it, or on one side of it.
    #[inline(always)]
    fn gather_from(
        &self,
        (grid, spheres): (&Grid, &Cells),
        slot: u32,
        (cell, side): ([u16; 3], Option<Side>),
        near: &mut Vicinity,
    ) {
        let is_turned = self.neighbourhoods[slot as usize].turns != [0; 3];
        grid.for_each_block(cell, side, |block| {
            let start = near.len;
            near.add_block(spheres, &block);
            if is_turned {
                // Even those in the box about the origin are images.
                near.make_images(start);
            }
        });
    }

    /// Brings the list of a sphere and those of its neighbours up to date. Finds those who are new to
    /// its own.
    fn list(&mut self, slot: u32, new: &mut Vicinity) {
        let (mut before, mut after) = (take(&mut self.before), take(&mut self.after));
        before.clear();
        after.clear();
        self.find_peers(slot, &mut after);
        if let Some(lists) = &mut self.lists {
            before.add_list(lists, slot);
            lists.set(slot as usize, after.found());
            for come in after.without(&mut before) {
                lists.add(come.slot() as usize, come.mirrored(slot));
                new.push(come);
            }
            for gone in before.without(&mut after) {
                lists.remove(gone.slot() as usize, gone.mirrored(slot));
            }
        }
        (self.before, self.after) = (before, after);
    }

    /// Finds the others whom a sphere can meet while both are in their neighbourhoods.
    fn find_peers(&self, slot: u32, peers: &mut Vicinity) {
        let [Level { grid, half_edges, own, .. }] = &self.levels[..] else { return };
        let cell = self.cell_of(slot, grid);
        grid.for_each_block(cell, None, |block| {
            let start = peers.len;
            peers.add_block(own, &block);
            let reach = block.is_endless.map(|is| if is { f64::INFINITY } else { 2.0 });
            let reach = DVec3::from_array(reach) * half_edges;
            let level = fearless_simd::Level::new();
            dispatch!(level, simd => self.keep_peers(simd, slot, reach, peers, start));
            for other in &mut peers.buffer[start..peers.len] {
                *other = self.neighbour(slot, other.slot(), other.image_turns());
            }
        });
    }

    /// Keeps, of those from `start` on, the others whose neighbourhoods reach that of the sphere, when
    /// their centres may be so far apart \[m\].
    #[inline(always)]
    fn keep_peers<S: Simd>(
        &self,
        simd: S,
        slot: u32,
        reach: DVec3,
        peers: &mut Vicinity,
        start: usize,
    ) {
        let Neighbourhood { center, radius, .. } = self.neighbourhoods[slot as usize];
        let (here, radius) = (Vector::all(simd, center), Lanes::all(simd, f64::from(radius)));
        let reach = Vector::all(simd, reach);
        let itself = Lanes::all(simd, f64::from(slot));
        peers.retain_from(
            start,
            #[inline(always)]
            |four| {
                let others = four.each_ref().map(|one| &self.neighbourhoods[one.slot() as usize]);
                // Seen from the other one it is the same to the last bit, but for the sign.
                let mut offset = Vector::each(simd, others.map(|other| other.center)) - here;
                if !are_in_same_box(four) {
                    offset = offset + self.ways_to(simd, four);
                }
                let gap = offset.beyond(reach);
                let radii = others.map(|other| f64::from(other.radius));
                let radius_sum = radius + Lanes::each(simd, radii);
                let are_near = gap.length_squared().is_at_most(radius_sum * radius_sum * SLACK);
                let slots = Lanes::each(simd, four.map(Neighbour::slot_in_numbers));
                (are_near & !slots.is_equal(itself)).to_bitmask()
            },
        );
    }

    /// What a sphere is to that at `slot`, when its image so many turns away is near.
    fn neighbour(&self, slot: u32, other: u32, turns: [i32; 3]) -> Neighbour {
        if self.turns_between(slot, other, turns) == [0; 3] {
            Neighbour::in_same_box(other)
        } else {
            Neighbour::image(other, turns)
        }
    }

    /// Whether a place is in the periodic box.
    #[inline(always)]
    pub fn is_in_box(&self, place: DVec3) -> bool {
        periodic::is_in_box(place, self.period)
    }

    /// Folds the position of a sphere, where a flight of it begins, into the periodic box, if it is
    /// elsewhere.
    pub fn fold(&mut self, slot: u32, level: u32, position: DVec3) -> Option<DVec3> {
        let turns = turns_of(position, self.period);
        if turns == [0; 3] {
            return None;
        }
        self.turn_back(slot, level, turns);
        Some(position - way_round(turns, self.period))
    }

    /// Counts turns of a sphere no longer: of its neighbours, others are now in the same box.
    fn turn_back(&mut self, slot: u32, level: u32, turns: [i32; 3]) {
        let cell = self.cell_of(slot, &self.levels[level as usize].grid);
        self.leave_cells(slot, level, cell);
        let near = self.lists.as_ref().map(|lists| lists.members(slot as usize));
        let near = near.unwrap_or_default();
        let in_box = |near: &Neighbour| {
            if near.is_in_same_box() {
                self.turns_between(near.slot(), slot, [0; 3])
            } else {
                near.image_turns()
            }
        };
        let in_box: Vec<_> = near.iter().map(in_box).collect();
        let counted = &mut self.neighbourhoods[slot as usize].turns;
        (0..3).for_each(|axis| counted[axis] -= turns[axis]);
        for (old, in_box) in near.into_iter().zip(in_box) {
            let new = self.neighbour(slot, old.slot(), in_box);
            if let Some(lists) = &mut self.lists {
                lists.replace(slot as usize, old, new);
                lists.replace(old.slot() as usize, old.mirrored(slot), new.mirrored(slot));
            }
        }
        self.enter_cells(slot, level, cell);
    }
}

/// The next number in single precision that is not less.
fn rounded_up(number: f64) -> f32 {
    let nearest = number as f32;
    if f64::from(nearest) < number { nearest.next_up() } else { nearest }
}
