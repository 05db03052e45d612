//! Cells: which spheres can meet a sphere before one of them leaves its cell.
//!
//! A hierarchy of grids. A level holds the spheres of one size class, in cells at least as wide
//! as the largest of them, and as visitors all smaller ones. Two spheres that touch lie in the
//! same or in neighbouring cells of the level of the larger one. A sphere changes its cell by an
//! event of its own; between such events nothing has to be looked for.
//!
//! The outermost cells of an open axis reach to infinity, so spheres may go anywhere. A periodic
//! axis closes on itself; there each sphere counts how often it went round.
//!
//! Cells decide only when a meeting is noticed, never its time: results do not depend on them.

use glam::DVec3;

use super::axis_motion::AxisMotion;
use super::body::{Body, Kind};
use crate::detect::surface_tree::{Bounds, SurfaceTree};
use crate::surface::{Form, Role, Surface};

/// No sphere: the end of a chain.
const NONE: u32 = u32::MAX;
/// Radii within this factor share a level.
const LEVEL_RATIO: f64 = 4.0;
/// Smaller spheres than `LEVEL_RATIO` to the minus this share the last level.
const MAX_LEVELS: usize = 24;
/// Below this number of spheres, one cell for all of them is faster than any grid.
const SINGLE_CELL: usize = 24;
/// Cells per sphere, at most.
const CELLS_PER_SPHERE: f64 = 4.0;
/// Cells along an axis, at most: a coordinate is 16 bits.
const MAX_CELLS: f64 = 65_000.0;
/// A sphere leaves its cell when it is beyond its face by this part of the cell's width: more than
/// rounding, so that none is ever between two cells.
const OVERHANG: f64 = 1.0 / 256.0;
/// Cells are wider than they need be by this factor: more than the rounding of the faces' places.
const WIDTH_SLACK: f64 = 1.0 + 1e-9;

/// All levels, from the largest spheres to the smallest.
#[derive(Debug, Clone, Default)]
pub(super) struct Cells {
    levels: Vec<Level>,
    /// Edges of the periodic box \[m\]; infinite along an open axis.
    period: DVec3,
}

/// A grid for the spheres of one size class and all smaller ones.
#[derive(Debug, Clone)]
struct Level {
    /// Corner of cell (0, 0, 0) \[m\].
    origin: DVec3,
    /// Edges of a cell \[m\].
    width: DVec3,
    counts: [u16; 3],
    periodic: [bool; 3],
    /// Edges of the periodic box \[m\]; infinite along an open axis.
    period: DVec3,
    /// Spheres of the level's own size class, by cell.
    own: Vec<Cell>,
    /// Smaller ones; empty if there are none.
    visitors: Vec<Cell>,
    /// Where each sphere is registered.
    links: Vec<Link>,
    /// Surfaces that a sphere of the level's own class may meet from cell `c`:
    /// `surfaces[surface_starts[c] .. surface_starts[c + 1]]`.
    surface_starts: Vec<u32>,
    surfaces: Vec<NearSurface>,
}

/// A surface, or its image in the periodic box so many turns away.
#[derive(Debug, Clone, Copy)]
struct NearSurface {
    surface: u32,
    turns: [i32; 3],
}

/// Spheres registered in a cell, as marks: the slot, with a flag for spheres that went round an axis.
#[derive(Debug, Clone, Copy)]
struct Cell {
    /// The first ones, as many as cells of equal spheres hold as a rule; then [`NONE`].
    marks: [u32; 3],
    /// First of the others, which are linked to each other.
    more: u32,
}

const EMPTY: Cell = Cell { marks: [NONE; 3], more: NONE };
/// Flag of a mark: the turns of this sphere are not all 0.
const TURNED: u32 = 1 << 31;

/// Spheres that another one may meet before it leaves its cell.
#[derive(Debug, Clone, Default)]
pub(super) struct Near {
    /// Those whose positions count in the same box; from here on:
    slots: Vec<u32>,
    /// how many of them there are,
    count: usize,
    /// and those whose image is near, with the shift to it \[m\].
    images: Vec<(u32, DVec3)>,
}

impl Near {
    fn clear(&mut self) {
        self.count = 0;
        self.images.clear();
    }

    /// Those whose positions count in the same box.
    #[inline(always)]
    pub fn in_same_box(&self) -> &[u32] {
        &self.slots[..self.count]
    }

    /// Those whose image is near, with the shift to it \[m\].
    #[inline(always)]
    pub fn images(&self) -> &[(u32, DVec3)] {
        &self.images
    }

    /// The n-th sphere, counting those in the same box first, with the shift \[m\] from where its
    /// position counts to its image that is near.
    #[inline(always)]
    pub fn nth(&self, n: usize) -> (u32, DVec3) {
        if n < self.count { (self.slots[n], DVec3::ZERO) } else { self.images[n - self.count] }
    }

    /// Each sphere, in this order.
    #[inline]
    pub fn iter(&self) -> impl Iterator<Item = (u32, DVec3)> {
        let same_box = self.slots[..self.count].iter().map(|&slot| (slot, DVec3::ZERO));
        same_box.chain(self.images.iter().copied())
    }

    /// Appends the marks of a row of cells that are not turned, but for `own`. Without branches
    /// on what is in a cell, which no processor can foresee.
    #[inline(always)]
    fn add_row(&mut self, row: &[Cell], own: u32) -> u32 {
        let most = self.count + row.len() * EMPTY.marks.len();
        if self.slots.len() < most {
            self.slots.resize(most, 0);
        }
        let mut rest = 0;
        let (mut count, slots) = (self.count, &mut self.slots[..most]);
        for cell in row {
            for mark in cell.marks {
                slots[count.min(most - 1)] = mark;
                let is_plain = (mark < TURNED) & (mark != own);
                count += usize::from(is_plain);
                rest |= u32::from((mark >= TURNED) & (mark != NONE));
            }
            rest |= u32::from(cell.more != NONE);
        }
        self.count = count;
        rest
    }

    fn add(&mut self, slot: u32) {
        self.slots.truncate(self.count);
        self.slots.push(slot);
        self.count += 1;
    }
}

#[derive(Debug, Clone, Copy)]
struct Link {
    /// Mark of the next sphere of the cell, beyond the first ones.
    next: u32,
    cell: [u16; 3],
    /// How often the sphere went round each periodic axis since its position was last folded
    /// into the box.
    turns: [i32; 3],
}

/// A sphere leaves its cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Crossing {
    /// When, on the world's clock \[s\].
    pub time: f64,
    pub face: Face,
}

impl Crossing {
    pub const NEVER: Self =
        Self { time: f64::INFINITY, face: Face { level: 0, axis: 0, upward: false } };
}

/// The face through which a cell is left.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Face {
    pub level: u8,
    pub axis: u8,
    pub upward: bool,
}

/// What cells are made from.
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

impl Cells {
    /// Registers every sphere at its place.
    pub fn new(contents: Contents) -> Self {
        let Contents { bodies, kinds, time, period, .. } = contents;
        let level_count = kinds.iter().map(|kind| kind.level as usize + 1).max().unwrap_or(0);
        let places: Vec<DVec3> =
            bodies.iter().map(|body| body.state_at(&kinds[body.kind as usize], time).0).collect();
        let mut cells = Self { levels: Vec::with_capacity(level_count), period };
        for number in 0..level_count {
            let mut level = Level::new(contents, &places, number as u32);
            for (slot, body) in bodies.iter().enumerate() {
                let own = kinds[body.kind as usize].level as usize;
                if own >= number {
                    level.register(slot as u32, places[slot], period, own == number);
                }
            }
            level.list_surfaces(contents, number as u32);
            cells.levels.push(level);
        }
        cells
    }

    /// The order in which neighbours are near each other in memory: slots along a space-filling
    /// curve (Morton) through the cells of the finest level.
    pub fn curve_order(&self) -> Vec<u32> {
        let Some(level) = self.levels.last() else { return Vec::new() };
        let key = |slot: &u32| {
            let cell = level.links[*slot as usize].cell;
            (0..3).fold(0u64, |key, axis| key | spread(cell[axis]) << axis)
        };
        let mut order: Vec<u32> = (0..level.links.len() as u32).collect();
        order.sort_by_cached_key(key);
        order
    }

    /// Finds the spheres that may meet the one at `slot` before a cell is left.
    #[inline]
    pub fn near(&self, slot: u32, own_level: u32, near: &mut Near) {
        near.clear();
        for (number, level) in self.levels.iter().enumerate().take(own_level as usize + 1) {
            level.collect(slot, None, number == own_level as usize, near);
        }
    }

    /// Finds those that have come near because the sphere went through a face.
    pub fn near_beyond(&self, slot: u32, own_level: u32, face: Face, near: &mut Near) {
        near.clear();
        let level = &self.levels[face.level as usize];
        level.collect(slot, Some(face), u32::from(face.level) == own_level, near);
    }

    /// Surfaces that the sphere may meet before it leaves its cell, with the shift \[m\] that brings
    /// them to where its position counts.
    pub fn surfaces_near(&self, slot: u32, level: u32) -> impl Iterator<Item = (u32, DVec3)> {
        let level = &self.levels[level as usize];
        let link = &level.links[slot as usize];
        let listed = if level.surfaces.is_empty() {
            &[]
        } else {
            let cell = level.index(link.cell);
            let range =
                level.surface_starts[cell] as usize..level.surface_starts[cell + 1] as usize;
            &level.surfaces[range]
        };
        listed.iter().map(|near| {
            let turns = |axis| near.turns[axis] + link.turns[axis];
            (near.surface, turned(std::array::from_fn(turns), self.period))
        })
    }

    /// From the box about the origin to where the position of the sphere counts \[m\].
    pub fn way_round(&self, slot: u32, level: u32) -> DVec3 {
        let turns = self.levels[level as usize].links[slot as usize].turns;
        turned(turns, self.period)
    }

    /// When and where the sphere leaves its cell, of the levels that hold it the first one.
    pub fn next_crossing(&self, slot: u32, body: &Body, kind: &Kind, now: f64) -> Crossing {
        let mut first = Crossing::NEVER;
        let (position, velocity) = body.state_at(kind, now);
        for (number, level) in self.levels.iter().enumerate().take(kind.level as usize + 1) {
            let link = &level.links[slot as usize];
            for axis in 0..3 {
                let [low, high] = level.reach(link, axis, self.period);
                let motion = AxisMotion {
                    velocity: velocity[axis],
                    acceleration: kind.acceleration[axis],
                    drag_rate: kind.drag_rate,
                };
                let (delay, upward) = motion.leaves(low - position[axis], high - position[axis]);
                if now + delay < first.time {
                    let face = Face { level: number as u8, axis: axis as u8, upward };
                    first = Crossing { time: now + delay, face };
                }
            }
        }
        first
    }

    /// Puts the sphere into the next cell beyond `face`, if it is there already: the time of a
    /// crossing is only a time before which there is none. Tells whether it is.
    pub fn cross(&mut self, slot: u32, body: &Body, kind: &Kind, face: Face, now: f64) -> bool {
        let level = &mut self.levels[face.level as usize];
        let axis = face.axis as usize;
        let place = body.state_at(kind, now).0[axis];
        let [low, high] = level.reach(&level.links[slot as usize], axis, self.period);
        // Halfway through the overhang is far enough: no rounding of the clock keeps it in.
        let slack = 0.5 * OVERHANG * level.width[axis];
        let is_out = if face.upward { place >= high - slack } else { place <= low + slack };
        if is_out {
            level.shift(slot, kind.level == u32::from(face.level), axis, face.upward);
        }
        is_out
    }

    /// Folds the position of a sphere into the periodic box.
    pub fn fold(&mut self, slot: u32, own_level: u32, position: DVec3) -> DVec3 {
        let turns = turns_of(position, self.period);
        if turns == [0; 3] {
            return position;
        }
        for (number, level) in self.levels.iter_mut().enumerate().take(own_level as usize + 1) {
            // The mark in the cell tells whether the sphere went round.
            let is_own = number == own_level as usize;
            level.remove(slot, is_own);
            let counted = &mut level.links[slot as usize].turns;
            (0..3).for_each(|axis| counted[axis] -= turns[axis]);
            level.insert(slot, is_own);
        }
        position - turned(turns, self.period)
    }
}

impl Level {
    /// An empty grid, as fine as the spheres allow and their number makes worth while.
    fn new(contents: Contents, places: &[DVec3], number: u32) -> Self {
        let Contents { bodies, kinds, period, .. } = contents;
        let kind_of = |body: &Body| &kinds[body.kind as usize];
        let held = || bodies.iter().zip(places).filter(|(body, _)| kind_of(body).level >= number);
        let count = held().count();
        let of_level = kinds.iter().filter(|kind| kind.level >= number);
        let radius = of_level.map(|kind| kind.radius).fold(0.0, f64::max);
        let min_width = 2.0 * radius / (1.0 - 2.0 * OVERHANG) * WIDTH_SLACK;

        let mut low = DVec3::INFINITY;
        let mut high = DVec3::NEG_INFINITY;
        held().for_each(|(_, place)| (low, high) = (low.min(*place), high.max(*place)));
        let periodic = [0, 1, 2].map(|axis| period[axis].is_finite());
        for axis in 0..3 {
            if periodic[axis] {
                (low[axis], high[axis]) = (-0.5 * period[axis], 0.5 * period[axis]);
            }
        }
        let extent = (high - low).max(DVec3::ZERO);
        let seeking = if contents.spheres_collide { count } else { 0 };
        let counts = cell_counts(extent, min_width, seeking);
        let width = DVec3::from_array([0, 1, 2].map(|axis| {
            let width = extent[axis] / f64::from(counts[axis]);
            if periodic[axis] { width } else { width.max(min_width) }
        }));
        let any_smaller = kinds.iter().any(|kind| kind.level > number);
        let cells = counts.iter().map(|&count| count as usize).product();
        let unregistered = Link { next: NONE, cell: [0; 3], turns: [0; 3] };
        Self {
            origin: low,
            width,
            counts,
            periodic,
            period,
            own: vec![EMPTY; cells],
            visitors: if any_smaller { vec![EMPTY; cells] } else { Vec::new() },
            links: vec![unregistered; bodies.len()],
            surface_starts: Vec::new(),
            surfaces: Vec::new(),
        }
    }

    fn index(&self, cell: [u16; 3]) -> usize {
        let [x, y, z] = cell.map(usize::from);
        x + usize::from(self.counts[0]) * (y + usize::from(self.counts[1]) * z)
    }

    fn register(&mut self, slot: u32, place: DVec3, period: DVec3, is_own: bool) {
        let turns = turns_of(place, period);
        let place = place - turned(turns, period);
        let mut link = Link { next: NONE, cell: [0; 3], turns };
        for axis in 0..3 {
            let cell = ((place[axis] - self.origin[axis]) / self.width[axis]).floor();
            link.cell[axis] = cell.clamp(0.0, f64::from(self.counts[axis] - 1)) as u16;
        }
        self.links[slot as usize] = link;
        self.insert(slot, is_own);
    }

    fn mark(&self, slot: u32) -> u32 {
        if self.links[slot as usize].turns == [0; 3] { slot } else { slot | TURNED }
    }

    fn insert(&mut self, slot: u32, is_own: bool) {
        let mark = self.mark(slot);
        let index = self.index(self.links[slot as usize].cell);
        let cell = if is_own { &mut self.own[index] } else { &mut self.visitors[index] };
        match cell.marks.iter_mut().find(|place| **place == NONE) {
            Some(place) => *place = mark,
            None => self.links[slot as usize].next = std::mem::replace(&mut cell.more, mark),
        }
    }

    fn remove(&mut self, slot: u32, is_own: bool) {
        let mark = self.mark(slot);
        let index = self.index(self.links[slot as usize].cell);
        let Self { own, visitors, links, .. } = self;
        let cell = if is_own { &mut own[index] } else { &mut visitors[index] };
        let next_of = |mark: u32, links: &[Link]| links[(mark & !TURNED) as usize].next;
        if let Some(place) = cell.marks.iter().position(|other| *other == mark) {
            // Another one takes its place, so that none is empty before one that is not.
            if cell.more != NONE {
                cell.marks[place] = cell.more;
                cell.more = next_of(cell.more, links);
            } else {
                let last = cell.marks.iter().rposition(|other| *other != NONE).unwrap_or(place);
                cell.marks[place] = cell.marks[last];
                cell.marks[last] = NONE;
            }
        } else if cell.more == mark {
            cell.more = next_of(mark, links);
        } else {
            let mut before = cell.more;
            while next_of(before, links) != mark {
                before = next_of(before, links);
            }
            links[(before & !TURNED) as usize].next = next_of(mark, links);
        }
    }

    /// Moves a sphere by one cell along an axis.
    fn shift(&mut self, slot: u32, is_own: bool, axis: usize, upward: bool) {
        self.remove(slot, is_own);
        let last = self.counts[axis] - 1;
        let link = &mut self.links[slot as usize];
        let cell = &mut link.cell[axis];
        match (upward, *cell) {
            (true, cell_before) if cell_before == last => {
                *cell = 0;
                link.turns[axis] += 1;
            }
            (true, _) => *cell += 1,
            (false, 0) => {
                *cell = last;
                link.turns[axis] -= 1;
            }
            (false, _) => *cell -= 1,
        }
        self.insert(slot, is_own);
    }

    /// Where a sphere may be along an axis without leaving its cell \[m\].
    fn reach(&self, link: &Link, axis: usize, period: DVec3) -> [f64; 2] {
        let (cell, width) = (link.cell[axis], self.width[axis]);
        let overhang = OVERHANG * width;
        let face = |number: u16| self.origin[axis] + f64::from(number) * width;
        let (low, high) = (face(cell) - overhang, face(cell + 1) + overhang);
        if self.periodic[axis] {
            let shift = f64::from(link.turns[axis]) * period[axis];
            return [low + shift, high + shift];
        }
        let is_last = cell + 1 == self.counts[axis];
        [
            if cell == 0 { f64::NEG_INFINITY } else { low },
            if is_last { f64::INFINITY } else { high },
        ]
    }

    /// Appends the spheres in the cells around a sphere, or in those of them beyond the face it just
    /// came through.
    #[inline]
    fn collect(&self, slot: u32, came_through: Option<Face>, with_visitors: bool, near: &mut Near) {
        let link = &self.links[slot as usize];
        let mut steps = [[-1, 1]; 3];
        if let Some(face) = came_through {
            let step = if face.upward { 1 } else { -1 };
            steps[face.axis as usize] = [step, step];
        }
        let is_inside =
            (0..3).all(|axis| link.cell[axis] > 0 && link.cell[axis] + 1 < self.counts[axis]);
        let with_visitors = with_visitors && !self.visitors.is_empty();
        if is_inside && link.turns == [0; 3] && !with_visitors {
            self.collect_inside(slot, steps, near);
            return;
        }
        let mut visit = |cell: [u16; 3], turns: [i8; 3]| {
            let index = self.index(cell);
            self.add_marks(&self.own[index], slot, turns, near);
            if with_visitors {
                self.add_marks(&self.visitors[index], slot, turns, near);
            }
        };
        for z in steps[2][0]..=steps[2][1] {
            let Some((cell_z, turn_z)) = self.neighbour(link, 2, z) else { continue };
            for y in steps[1][0]..=steps[1][1] {
                let Some((cell_y, turn_y)) = self.neighbour(link, 1, y) else { continue };
                for x in steps[0][0]..=steps[0][1] {
                    let Some((cell_x, turn_x)) = self.neighbour(link, 0, x) else { continue };
                    visit([cell_x, cell_y, cell_z], [turn_x, turn_y, turn_z]);
                }
            }
        }
    }

    /// Likewise where all these cells are in the box, for a sphere that did not go round.
    #[inline]
    fn collect_inside(&self, slot: u32, steps: [[i32; 2]; 3], near: &mut Near) {
        let [nx, ny, _] = self.counts.map(|count| count as i32);
        let center = self.index(self.links[slot as usize].cell) as i32;
        let [low, high] = steps[0];
        for z in steps[2][0]..=steps[2][1] {
            for y in steps[1][0]..=steps[1][1] {
                let middle = center + nx * (y + ny * z);
                let row = &self.own[(middle + low) as usize..=(middle + high) as usize];
                let rest = near.add_row(row, slot);
                if rest != 0 {
                    row.iter().for_each(|cell| self.add_rest(cell, slot, near));
                }
            }
        }
    }

    /// Appends what [`Near::add_row`] leaves out.
    fn add_rest(&self, cell: &Cell, slot: u32, near: &mut Near) {
        for mark in cell.marks.into_iter().filter(|&mark| mark >= TURNED && mark != NONE) {
            self.add_mark(mark, slot, [0; 3], near);
        }
        self.for_each_other_mark(cell, |mark| self.add_mark(mark, slot, [0; 3], near));
    }
    /// The neighbouring cell along an axis, and how often the way there goes round the axis.
    fn neighbour(&self, link: &Link, axis: usize, step: i32) -> Option<(u16, i8)> {
        let count = i32::from(self.counts[axis]);
        let cell = i32::from(link.cell[axis]) + step;
        if (0..count).contains(&cell) {
            return Some((cell as u16, 0));
        }
        self.periodic[axis].then(|| (cell.rem_euclid(count) as u16, cell.div_euclid(count) as i8))
    }

    /// Appends the spheres of a cell that is so many turns away.
    fn add_marks(&self, cell: &Cell, slot: u32, turns: [i8; 3], near: &mut Near) {
        for mark in cell.marks.into_iter().take_while(|&mark| mark != NONE) {
            self.add_mark(mark, slot, turns, near);
        }
        self.for_each_other_mark(cell, |mark| self.add_mark(mark, slot, turns, near));
    }

    fn for_each_other_mark(&self, cell: &Cell, mut visit: impl FnMut(u32)) {
        let mut mark = cell.more;
        while mark != NONE {
            visit(mark);
            mark = self.links[(mark & !TURNED) as usize].next;
        }
    }

    fn add_mark(&self, mark: u32, slot: u32, turns: [i8; 3], near: &mut Near) {
        let other = mark & !TURNED;
        if other == slot {
            return;
        }
        let of = |slot: u32, axis: usize| self.links[slot as usize].turns[axis];
        let turns = [0, 1, 2].map(|axis| i32::from(turns[axis]) + of(slot, axis) - of(other, axis));
        if turns == [0; 3] {
            near.add(other);
        } else {
            near.images.push((other, turned(turns, self.period)));
        }
    }

    /// Notes for each cell the surfaces that a sphere of the level's own class may touch there.
    fn list_surfaces(&mut self, contents: Contents, number: u32) {
        let of_level = contents.kinds.iter().filter(|kind| kind.level == number);
        let radius = of_level.map(|kind| kind.radius).fold(0.0, f64::max);
        let mut near = Vec::new();
        for z in 0..self.counts[2] {
            for y in 0..self.counts[1] {
                for x in 0..self.counts[0] {
                    self.surface_starts.push(self.surfaces.len() as u32);
                    let link = Link { next: NONE, cell: [x, y, z], turns: [0; 3] };
                    let reach = [0, 1, 2].map(|axis| self.reach(&link, axis, contents.period));
                    let bounds = Bounds {
                        min: DVec3::from_array(reach.map(|ends| ends[0] - radius * SURFACE_SLACK)),
                        max: DVec3::from_array(reach.map(|ends| ends[1] + radius * SURFACE_SLACK)),
                    };
                    self.list_surfaces_of_cell(contents, bounds, &mut near);
                }
            }
        }
        self.surface_starts.push(self.surfaces.len() as u32);
        if self.surfaces.is_empty() {
            self.surface_starts = Vec::new();
        }
    }

    /// Likewise for one cell, where spheres have these bounds; images of bounded surfaces included.
    fn list_surfaces_of_cell(&mut self, contents: Contents, bounds: Bounds, near: &mut Vec<u32>) {
        let Contents { surfaces, tree, period, .. } = contents;
        let turns = |axis: usize| if self.periodic[axis] { -1..=1 } else { 0..=0 };
        for z in turns(2) {
            for y in turns(1) {
                for x in turns(0) {
                    let turns = [x, y, z];
                    let shift = turned(turns, period);
                    let bounds = Bounds { min: bounds.min - shift, max: bounds.max - shift };
                    tree.near(&bounds, near);
                    let listed = near.iter().filter(|&&surface| {
                        let Surface { form, role, motion, .. } = &surfaces[surface as usize];
                        let has_image = turns == [0; 3] || !matches!(form, Form::HalfSpace { .. });
                        *role == Role::Deflects && has_image && motion.is_at_rest()
                    });
                    self.surfaces.extend(listed.map(|&surface| NearSurface { surface, turns }));
                }
            }
        }
    }
}

/// The image of a place in the periodic box.
pub(super) fn folded(place: DVec3, period: DVec3) -> DVec3 {
    match turns_of(place, period) {
        [0, 0, 0] => place,
        turns => place - turned(turns, period),
    }
}

/// How often a place went round each periodic axis: 0 in the box about the origin.
fn turns_of(place: DVec3, period: DVec3) -> [i32; 3] {
    let half = 0.5 * period;
    if place.abs().cmple(half).all() {
        return [0; 3];
    }
    [0, 1, 2].map(|axis| {
        // An axis that is open has no turns.
        let turns = place[axis] / period[axis] + 0.5;
        turns.floor() as i32
    })
}

/// Radii are widened by this when surfaces are listed: more than rounding.
const SURFACE_SLACK: f64 = 1.0 + 1e-6;

/// Cells along each axis: at least `min_width` \[m\] wide, and not more than are worth while for
/// this number of spheres.
fn cell_counts(extent: DVec3, min_width: f64, spheres: usize) -> [u16; 3] {
    if spheres <= SINGLE_CELL {
        return [1; 3];
    }
    let budget = CELLS_PER_SPHERE * spheres as f64;
    let along =
        |width: f64| [0, 1, 2].map(|axis| (extent[axis] / width).floor().clamp(1.0, MAX_CELLS));
    let mut width = min_width;
    // Widening by an eighth at a time comes within a third of the budget.
    while along(width).iter().product::<f64>() > budget {
        width *= 1.125;
    }
    along(width).map(|count| count as u16)
}

/// The way round each periodic axis this often \[m\]; nothing along open ones.
fn turned(turns: [i32; 3], period: DVec3) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|axis| match turns[axis] {
        0 => 0.0,
        turns => f64::from(turns) * period[axis],
    }))
}

/// The bits of a coordinate, each three places from the next.
fn spread(coordinate: u16) -> u64 {
    (0..16).fold(0, |bits, bit| bits | (u64::from(coordinate) >> bit & 1) << (3 * bit))
}
