//! The neighbours of all spheres, by cell and by list.

mod crossing;
mod transfer;

use educe::Educe;
use fearless_simd::Simd;
use glam::DVec3;
use prefetch_index::prefetch_index;

use super::buffer::NeighbourBuffer;
use super::cells::Cells;
use super::contents::Contents;
use super::grid::{Grid, Side};
use super::images::{Images, PeriodicBox, offset_between};
use super::level::{Level, Levels};
use super::neighbour::Neighbour;
use super::neighbour_lists::{Crowd, NeighbourLists};
use super::region::{CROSSING, Region};
use super::sliding::Sliding;
use crate::groups::Groups;
use crate::lanes::{LANES, Lanes};
use crate::real::Vector;
use crate::rule::exact::flights::{Body, Flights, Species};
use crate::rule::periodic;

/// The regions of all spheres, and which spheres and surfaces are near them.
#[derive(Debug, Educe, Default)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Neighbours {
    /// Levels from the largest spheres to the smallest.
    levels: Vec<Level>,
    /// Region of each sphere, by slot.
    regions: Vec<Region>,
    /// Neighbour lists, by slot, where spheres are crowded.
    lists: Option<NeighbourLists>,
    periodic_box: PeriodicBox,
    /// Images of the box in steady shear. Regions and cells then lie in the coordinates of the search.
    sliding: Option<Sliding>,
    images: Images,
    /// Whether spheres collide with each other.
    spheres_collide: bool,
    /// Groups of the spheres, by slot; empty where all bodies collide.
    groups: Vec<Groups>,
    /// Groups of the surfaces, by number; empty where all bodies collide.
    groups_of_surfaces: Vec<Groups>,
}

/// A cell to search, and the side from which a sphere entered it: only spheres near that side are
/// new.
#[derive(Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Arrival {
    cell: [u16; 3],
    side: Option<Side>,
}

impl Neighbours {
    /// Finds the neighbours of all spheres.
    pub fn new(contents: Contents) -> Self {
        let Contents { flights, period, spheres_collide, .. } = contents;
        let Flights { bodies, species, .. } = flights;
        let Levels { levels, are_crowded } = Levels::new(contents);
        let nowhere =
            |body: &Body| Region::nowhere(flights.largest_radius(&species[body.species as usize]));
        // A neighbour is less than three cells away along each axis, of the coarsest grid.
        let images = match levels.first() {
            _ if !period.is_finite_mask().any() => Images::None,
            _ if contents.sliding.is_some() => Images::Sliding,
            Some(level) if level.grid.is_wide() => Images::ByPlace,
            _ => Images::ByMark,
        };
        let mut neighbours = Self {
            levels,
            regions: bodies.iter().map(nowhere).collect(),
            lists: are_crowded.then(|| NeighbourLists::new(bodies.len())),
            periodic_box: PeriodicBox::new(period),
            sliding: contents.sliding,
            images,
            spheres_collide,
            groups: contents.groups_by_slot(),
            groups_of_surfaces: Vec::new(),
        };
        if !neighbours.groups.is_empty() {
            let of_surfaces = contents.surfaces.iter().map(|surface| surface.groups);
            neighbours.groups_of_surfaces = of_surfaces.collect();
        }
        let mut new = NeighbourBuffer::default();
        for (slot, body) in (0u32..).zip(bodies) {
            let level = species[body.species as usize].level;
            let state = [contents.position_of(slot), body.velocity];
            let cell = neighbours.place(slot, level, state);
            neighbours.enter_cells(slot, level, cell);
            new.clear();
            neighbours.update_list(slot, &mut new);
        }
        neighbours
    }

    /// Whether a sphere is found among its neighbours.
    #[inline(always)]
    pub fn finds_itself(&self) -> bool {
        self.lists.is_none()
    }

    /// How images are distinguished from others.
    #[inline(always)]
    pub fn images(&self) -> Images {
        self.images
    }

    /// Finds the spheres that the sphere at `slot`, of this level, may meet before one of them leaves its neighbour
    /// region; the sphere itself may be among them.
    #[inline(always)]
    pub fn find(&self, slot: u32, level: u32, near: &mut NeighbourBuffer) {
        near.clear();
        match &self.lists {
            Some(NeighbourLists { lists, .. }) => near.add_list(lists, slot),
            None => {
                let cell = self.cell_of(slot, &self.levels[level as usize].grid);
                self.gather(slot, level, Arrival { cell, side: None }, near);
            }
        }
        if !self.groups.is_empty() {
            self.keep_those_met(slot, near);
        }
    }

    /// Keeps the neighbours that a sphere collides with, by their groups, and the sphere itself.
    #[inline(never)]
    fn keep_those_met(&self, slot: u32, near: &mut NeighbourBuffer) {
        let own = self.groups[slot as usize];
        near.retain(|it| it.slot() == slot || own.collides(self.groups[it.slot() as usize]));
    }

    /// Whether a sphere collides with a surface, by their groups.
    #[inline]
    pub fn meets_surface(&self, slot: u32, surface: u32) -> bool {
        self.groups.is_empty()
            || self.groups[slot as usize].collides(self.groups_of_surfaces[surface as usize])
    }

    /// Fetches the region of a sphere into the cache, and its list if there are lists.
    #[inline]
    pub fn prefetch_place(&self, slot: u32) {
        self.prefetch_region(slot);
        if let Some(NeighbourLists { lists, .. }) = &self.lists {
            lists.prefetch(slot as usize);
        }
    }

    /// Fetches a region, from its beginning to its end: that may be two lines of the cache.
    #[inline(always)]
    fn prefetch_region(&self, slot: u32) {
        prefetch_index(&self.regions, slot as usize);
        prefetch_index(&self.regions, slot as usize + 1);
    }

    /// Fetches the cells around a sphere, if they are needed: where there are lists, only if it leaves
    /// its neighbour region.
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

    /// Fetches, if there are lists, the `bodies` on the list of a sphere; if it leaves its neighbour
    /// region, the regions of the spheres that may come onto its list.
    #[inline]
    pub fn prefetch_near(&self, slot: u32, leaves: bool, bodies: &[Body]) {
        let ([Level { grid, own, .. }], Some(NeighbourLists { lists, .. })) =
            (&self.levels[..], &self.lists)
        else {
            return;
        };
        if !leaves {
            let near = lists.first(slot as usize).iter();
            return near.for_each(|near| prefetch_index(bodies, near.slot() as usize));
        }
        grid.for_each_block(self.cell_of(slot, grid), None, |block| {
            block.for_each_row(|row| {
                for other in row.flat_map(|cell| own.first(cell)) {
                    self.prefetch_region(other.slot());
                }
            });
        });
    }

    fn region(&self, slot: u32) -> &Region {
        &self.regions[slot as usize]
    }

    /// Offset \[m\] of a neighbour's image beside the sphere at `slot`.
    pub fn shift_of(&self, slot: u32, neighbour: Neighbour) -> DVec3 {
        if neighbour.is_in_same_box() {
            return DVec3::ZERO;
        }
        let (region, other) = (self.region(slot), self.region(neighbour.slot()));
        self.periodic_box.shift(offset_between(region, other, neighbour.image_offset()))
    }

    /// The shift to a neighbour's image beside the sphere at `slot` at `time` \[s\], \[m\], and its velocity \[m/s\].
    pub fn image_motion_of(&self, slot: u32, neighbour: Neighbour, time: f64) -> [DVec3; 2] {
        let Some(sliding) = self.sliding.filter(|_| !neighbour.is_in_same_box()) else {
            return [self.shift_of(slot, neighbour), DVec3::ZERO];
        };
        let (region, other) = (self.region(slot), self.region(neighbour.slot()));
        sliding.image_motion(offset_between(region, other, neighbour.image_offset()), time)
    }

    /// Offsets \[m\] of several neighbours' images, one per lane.
    #[inline(always)]
    pub fn shifts_of<S: Simd>(
        &self,
        simd: S,
        slot: u32,
        some: &[Neighbour; LANES],
    ) -> Vector<Lanes<S>> {
        let others = some.each_ref().map(|one| &self.regions[one.slot() as usize]);
        self.periodic_box.shifts_of(simd, &self.regions[slot as usize], others, some)
    }

    /// Offsets \[m\] of neighbours' images that are recognised by their positions, from the offsets at a time when
    /// all are in their neighbour regions \[m\].
    #[inline(always)]
    pub fn shifts_to_nearest<S: Simd>(
        &self,
        simd: S,
        offset: Vector<Lanes<S>>,
    ) -> Vector<Lanes<S>> {
        self.periodic_box.shifts_to_nearest(simd, offset)
    }

    /// Offset from the box about the origin to the box of the sphere's position \[m\].
    #[inline]
    pub fn shift_from_box(&self, slot: u32) -> DVec3 {
        self.periodic_box.shift_from_box(self.region(slot))
    }

    /// Surfaces that the sphere may meet in its neighbour region, with the offset \[m\] of the image beside the
    /// sphere.
    pub fn surfaces_near(&self, slot: u32, level: u32) -> impl Iterator<Item = (u32, DVec3)> {
        let Level { grid, surfaces, .. } = &self.levels[level as usize];
        let offset = self.region(slot).image_offset;
        let near = if surfaces.is_empty() {
            &[]
        } else {
            surfaces.of_cell(grid.index(self.cell_of(slot, grid)))
        };
        near.iter().map(move |near| {
            let shift = match (near.image_offset, offset) {
                ([0, 0, 0], [0, 0, 0]) => DVec3::ZERO,
                (of_image, offset) => {
                    let boxes = [0, 1, 2].map(|axis| i32::from(of_image[axis]) + offset[axis]);
                    self.periodic_box.shift(boxes)
                }
            };
            (near.surface, shift)
        })
    }

    /// Whether the sphere cannot leave its neighbour region until `horizon`, on the world's clock \[s\].
    #[inline]
    pub fn stays(&self, slot: u32, body: &Body, species: &Species, horizon: f64) -> bool {
        let Level { half_edges, .. } = &self.levels[species.level as usize];
        let center = self.region(slot).center;
        let offset = center + self.shift_from_box(slot) - body.position;
        let way = body.flight(species).farthest(horizon - body.time);
        (offset.abs() + way).cmple(CROSSING * half_edges).all()
    }

    /// Moves a sphere with this position \[m\] and velocity \[m/s\] to its next neighbour region,
    /// and finds the spheres that are new there; some that are not new, and itself, may be among
    /// them.
    pub fn cross_cell(
        &mut self,
        slot: u32,
        level: u32,
        state: [DVec3; 2],
        near: &mut NeighbourBuffer,
    ) {
        near.clear();
        let before = self.cell_of(slot, &self.levels[level as usize].grid);
        self.leave_cells(slot, level, before);
        let cell = self.place(slot, level, state);
        self.enter_cells(slot, level, cell);
        if self.lists.is_some() {
            self.update_list(slot, near);
        } else {
            let side = self.levels[level as usize].grid.side(before, cell);
            self.gather(slot, level, Arrival { cell, side }, near);
        }
        if !self.groups.is_empty() {
            self.keep_those_met(slot, near);
        }
    }

    /// Moves the neighbour region of a sphere so that the sphere is at its centre. Returns the cell there.
    fn place(&mut self, slot: u32, level: u32, state: [DVec3; 2]) -> [u16; 3] {
        let region = self.region_at(slot, level, state);
        self.regions[slot as usize] = region;
        self.levels[level as usize].grid.cell_of(region.center)
    }

    /// The cell of a grid that the region of a sphere lies about.
    #[inline(always)]
    fn cell_of(&self, slot: u32, grid: &Grid) -> [u16; 3] {
        grid.cell_of(self.regions[slot as usize].center)
    }

    fn enter_cells(&mut self, slot: u32, level: u32, own_cell: [u16; 3]) {
        self.for_its_cells(slot, level, own_cell, |cells, cell, mark| cells.add(cell, mark));
    }

    fn leave_cells(&mut self, slot: u32, level: u32, own_cell: [u16; 3]) {
        self.for_its_cells(slot, level, own_cell, |cells, cell, mark| cells.remove(cell, mark));
    }

    /// Calls `act` for a sphere, or an image of it, in its cell, in the cells that hold it on the levels above,
    /// and in the ghosts of these.
    #[inline]
    fn for_its_cells(
        &mut self,
        slot: u32,
        own_level: u32,
        own_cell: [u16; 3],
        mut act: impl FnMut(&mut Cells, usize, Neighbour),
    ) {
        let region = self.region(slot);
        let own_mark = if region.is_in_box() {
            Neighbour::in_same_box(slot)
        } else {
            Neighbour::image(slot, [0; 3])
        };
        let mark = |offset: [i32; 3]| match offset {
            [0, 0, 0] => own_mark,
            _ => Neighbour::image(slot, offset),
        };
        let mut act = |grid: &Grid, cells: &mut Cells, cell| {
            grid.for_each_copy(cell, |number, offset| act(cells, number, mark(offset)));
        };
        let center = region.center;
        for Level { grid, visitors, .. } in &mut self.levels[..own_level as usize] {
            if let Some(visitors) = visitors {
                act(grid, visitors, grid.cell_of(center));
            }
        }
        let Level { grid, own, .. } = &mut self.levels[own_level as usize];
        act(grid, own, own_cell);
    }

    /// Appends the spheres in the cells around a sphere; of its own level, and of smaller spheres, those
    /// on the side where they are new.
    #[inline(always)]
    fn gather(&self, slot: u32, own_level: u32, own: Arrival, near: &mut NeighbourBuffer) {
        if !self.spheres_collide {
            return;
        }
        for Level { grid, own, .. } in &self.levels[..own_level as usize] {
            let all = Arrival { cell: self.cell_of(slot, grid), side: None };
            self.gather_from(grid, own, slot, all, near);
        }
        let Level { grid, own: spheres, visitors, .. } = &self.levels[own_level as usize];
        self.gather_from(grid, spheres, slot, own, near);
        if let Some(visitors) = visitors {
            self.gather_from(grid, visitors, slot, own, near);
        }
    }

    /// Appends the spheres in a cell and those around it, or on one side of it.
    #[inline(always)]
    fn gather_from(
        &self,
        grid: &Grid,
        spheres: &Cells,
        slot: u32,
        Arrival { cell, side }: Arrival,
        near: &mut NeighbourBuffer,
    ) {
        let is_in_box = self.regions[slot as usize].is_in_box();
        grid.for_each_block(cell, side, |block| {
            let start = near.len;
            near.add_block(spheres, &block);
            if !is_in_box {
                // Even those in the box about the origin are images.
                near.make_images(start);
            }
        });
    }

    /// Updates the list of a sphere and those of its neighbours, where there are lists. Adds the new neighbours to
    /// `new`.
    fn update_list(&mut self, slot: u32, new: &mut NeighbourBuffer) {
        let Self { levels, regions, lists, periodic_box, .. } = self;
        if let ([level], Some(lists)) = (&levels[..], lists) {
            lists.update(Crowd { level, regions, periodic_box }, slot, new);
        }
    }

    /// Whether a position is in the periodic box.
    #[inline(always)]
    pub fn is_in_box(&self, position: DVec3) -> bool {
        periodic::is_in_box(position, self.periodic_box.period)
    }

    /// The image of a position in the periodic box \[m\].
    pub fn wrapped(&self, position: DVec3) -> DVec3 {
        periodic::wrapped(position, self.periodic_box.period)
    }

    /// Wraps the position of a sphere, where a flight of it begins, into the periodic box, if it is
    /// elsewhere.
    pub fn wrap(&mut self, slot: u32, level: u32, position: DVec3) -> Option<DVec3> {
        let period = self.periodic_box.period;
        let offset = periodic::image_offset_of(position, period);
        if offset == [0; 3] {
            return None;
        }
        self.drop_offset(slot, level, offset);
        Some(position - periodic::image_shift(offset, period))
    }

    /// Wraps the state of a sphere in a box in steady shear, where a flight of it begins at `time` \[s\], into the box,
    /// if its position \[m\] is elsewhere; its velocity \[m/s\] changes with the box.
    pub fn wrap_sliding(
        &mut self,
        (slot, level): (u32, u32),
        sliding: Sliding,
        [position, velocity]: [DVec3; 2],
        time: f64,
    ) -> [DVec3; 2] {
        let offset = sliding.image_offset_of(position, time);
        self.drop_offset(slot, level, offset);
        let [shift, speed] = sliding.image_motion(offset, time);
        [position - shift, velocity - speed]
    }

    /// Images of the box in steady shear.
    #[inline(always)]
    pub fn sliding(&self) -> Option<&Sliding> {
        self.sliding.as_ref()
    }

    /// Whether a sphere has left the box along y, in a box in steady shear.
    #[inline(always)]
    pub fn has_left_sheared_box(&self, slot: u32) -> bool {
        self.sliding.is_some() && self.region(slot).image_offset[1] != 0
    }

    /// Subtracts boxes from the image offset of a sphere; its neighbours' images change with it.
    fn drop_offset(&mut self, slot: u32, level: u32, offset: [i32; 3]) {
        let cell = self.cell_of(slot, &self.levels[level as usize].grid);
        self.leave_cells(slot, level, cell);
        let near = self.lists.as_ref().map(|lists| lists.lists.members(slot as usize));
        let near = near.unwrap_or_default();
        let in_box = |near: &Neighbour| {
            if near.is_in_same_box() {
                offset_between(self.region(near.slot()), self.region(slot), [0; 3])
            } else {
                near.image_offset()
            }
        };
        let in_box: Vec<_> = near.iter().map(in_box).collect();
        let region = &mut self.regions[slot as usize];
        (0..3).for_each(|axis| region.image_offset[axis] -= offset[axis]);
        let Self { levels, regions, lists, periodic_box, .. } = self;
        if let ([crowded], Some(lists)) = (&levels[..], lists) {
            let crowd = Crowd { level: crowded, regions, periodic_box };
            for (old, in_box) in near.into_iter().zip(in_box) {
                lists.replace(slot, old, crowd.neighbour(slot, old.slot(), in_box));
            }
        }
        self.enter_cells(slot, level, cell);
    }
}
