//! Territories: in which cells a domain may take events.

use crate::rule::exact::neighbours::Layout;

/// Layers of cells that an event reads on each side of its own: those of the spheres that may meet the two of a pair,
/// and those of a cell that one of them crosses into.
const READ: u16 = 2;
/// Layers on each side of a border whose events are taken in the second phase.
pub(super) const BAND: u16 = 6;
/// Layers beyond a slab whose events the domain defers, so that it notices what they may change.
const GUARD: u16 = 4;

/// Which of the two phases of a window.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Phase {
    /// Each domain takes the events of its slab, but for those at its borders.
    Slabs,
    /// Each domain takes the events about its upper border.
    Borders,
}

/// What a domain does in one layer of cells.
#[derive(Debug, Clone, Copy, Default)]
struct Layer {
    /// Whether its events are taken in the first phase.
    is_inside: bool,
    /// Whether it is one of the slab.
    is_own: bool,
    /// Whether its events are taken in the second phase.
    is_at_border: bool,
    /// Whether the domain has the present flights of the spheres there.
    is_known: bool,
    /// Whether other domains must have them, too.
    is_shared: bool,
}

/// The cells of a domain: a slab of the box, and what lies about its borders.
#[derive(Debug, Default)]
pub(super) struct Territory {
    axis: usize,
    cells: Layout,
    layers: Vec<Layer>,
    /// The phase, by its number, in which a sphere in or next to a cell was changed last by a deferred event, by index of
    /// the cell.
    unknown_in: Vec<u32>,
}

/// A cut of a box into slabs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Cut {
    axis: usize,
    /// The first layer of each slab, and the end of the last.
    borders: Vec<u16>,
}

impl Cut {
    /// Cuts a grid across its longest axis into slabs with about the same number of spheres: as many as there are
    /// threads, or as have room. `cells` are those of the spheres.
    pub fn of(layout: Layout, cells: impl Iterator<Item = [u16; 3]>, threads: usize) -> Self {
        let Layout { counts, .. } = layout;
        let axis = (0..3).rev().max_by_key(|&axis| counts[axis]).unwrap_or(0);
        let layers = counts[axis];
        let slabs = threads.min(usize::from(layers / (2 * BAND)));
        let mut spheres = vec![0_usize; usize::from(layers)];
        cells.for_each(|cell| spheres[usize::from(cell[axis])] += 1);
        let all: usize = spheres.iter().sum();
        let mut borders = vec![0];
        let mut below = 0;
        for (layer, count) in (0..layers).zip(spheres) {
            let (begun, last) = (borders.len(), borders[borders.len() - 1]);
            let is_full = below * slabs >= begun * all;
            let rest = slabs.saturating_sub(begun) as u16;
            let has_room = layer >= last + 2 * BAND && layer + 2 * BAND * rest <= layers;
            if rest > 0 && has_room && (is_full || layer + 2 * BAND * rest == layers) {
                borders.push(layer);
            }
            below += count;
        }
        borders.push(layers);
        Self { axis, borders }
    }

    /// Returns the number of slabs.
    pub fn slabs(&self) -> usize {
        self.borders.len() - 1
    }
}

impl Territory {
    /// The territory of each slab of a cut.
    pub fn all(layout: Layout, cut: &Cut) -> Vec<Self> {
        let mut all: Vec<Self> = (0..cut.slabs()).map(|slab| Self::of(layout, cut, slab)).collect();
        for one in 0..all.len() {
            for layer in 0..all[one].layers.len() {
                let is_known =
                    |(other, it): (usize, &Self)| other != one && it.layers[layer].is_known;
                all[one].layers[layer].is_shared = all.iter().enumerate().any(is_known);
            }
        }
        all
    }

    fn of(cells: Layout, cut: &Cut, slab: usize) -> Self {
        let Layout { counts, periodic } = cells;
        let count = i32::from(counts[cut.axis]);
        let mut layers = vec![Layer::default(); count as usize];
        let is_ring = periodic[cut.axis];
        let [start, end] = [cut.borders[slab], cut.borders[slab + 1]].map(i32::from);
        let is_open = [slab == 0, slab + 1 == cut.slabs()].map(|is_last| is_last && !is_ring);
        let [read, band, guard] = [READ, BAND, GUARD].map(i32::from);
        let mut mark = |from: i32, to: i32, mark: fn(&mut Layer)| {
            for layer in from..to {
                if is_ring || (0..count).contains(&layer) {
                    mark(&mut layers[layer.rem_euclid(count) as usize]);
                }
            }
        };
        let inside = [(start, is_open[0], 1), (end, is_open[1], -1)];
        let [low, high] = inside.map(|(border, is_open, sign)| match is_open {
            true => border,
            false => border + sign * read,
        });
        mark(low, high, |layer| layer.is_inside = true);
        mark(start, end, |layer| layer.is_own = true);
        mark(start - guard, end, |layer| layer.is_known = true);
        if !is_open[1] {
            mark(end, end + band, |layer| layer.is_known = true);
            mark(end - band + read, end + band - read, |layer| layer.is_at_border = true);
        }
        let count = counts.into_iter().map(usize::from).product();
        Self { axis: cut.axis, cells, layers, unknown_in: vec![0; count] }
    }

    fn layer(&self, cell: [u16; 3]) -> &Layer {
        &self.layers[usize::from(cell[self.axis])]
    }

    /// Whether the domain has the present flights of the spheres in a cell.
    pub fn knows(&self, cell: [u16; 3]) -> bool {
        self.layer(cell).is_known
    }

    /// Whether a cell lies in the slab of the domain.
    pub fn owns(&self, cell: [u16; 3]) -> bool {
        self.layer(cell).is_own
    }

    /// Forgets what deferred events may have changed.
    pub fn begin_segment(&mut self) {
        self.unknown_in.fill(0);
    }

    /// Whether other domains must have the flights of the spheres in a cell.
    pub fn shares(&self, cell: [u16; 3]) -> bool {
        self.layer(cell).is_shared
    }

    /// Whether the domain takes the events of a cell in a phase.
    pub fn takes(&self, cell: [u16; 3], phase: Phase) -> bool {
        let layer = self.layer(cell);
        match phase {
            Phase::Slabs => layer.is_inside,
            Phase::Borders => layer.is_at_border,
        }
    }

    /// Whether no sphere in a cell or next to it was changed by an event that was deferred in the phase with this
    /// `number`.
    pub fn is_clear(&self, cell: [u16; 3], number: u32) -> bool {
        self.unknown_in[self.index(cell)] != number
    }

    /// Notes that a deferred event may have changed a sphere in a cell, in the phase with this `number`.
    pub fn note_unknown(&mut self, cell: [u16; 3], number: u32) {
        let Layout { counts, periodic } = self.cells;
        let near = [0, 1, 2].map(|axis| {
            let count = i32::from(counts[axis]);
            let places = [-1, 0, 1].map(|step| i32::from(cell[axis]) + step);
            let is_there = move |place: &i32| periodic[axis] || (0..count).contains(place);
            places.into_iter().filter(is_there).map(move |place| place.rem_euclid(count) as u16)
        });
        let [x, y, z] = near;
        for z in z {
            for y in y.clone() {
                for x in x.clone() {
                    let index = self.index([x, y, z]);
                    self.unknown_in[index] = number;
                }
            }
        }
    }

    fn index(&self, cell: [u16; 3]) -> usize {
        let [x, y, z] = cell.map(usize::from);
        let [row, column, _] = self.cells.counts.map(usize::from);
        x + row * (y + column * z)
    }
}
