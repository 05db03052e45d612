//! Slabs: runs of slots that are processed in parallel.
//!
//! A slab has the contacts of its own spheres with each other and with those of the next slab. In the
//! even phase slabs 0, 2, ... are at work, each with the next one's slots, in the odd phase 1, 3, ...: so
//! none writes what another reads. What fits into no slab is done alone, after them. How many slabs there
//! are follows from the spheres, never from the threads.

pub(crate) mod descent;
pub(crate) mod incidence;
pub(crate) mod landings;
pub(crate) mod search;
pub(crate) mod warm_start;

use educe::Educe;

use self::descent::Descent;
use crate::parallel;
use crate::rule::contact::contacts::batch::Batches;
use crate::rule::contact::contacts::images::ImagePair;
use crate::rule::contact::contacts::surfaces::SurfaceContact;
use crate::rule::contact::slots::slab_totals::SlabTotals;
use crate::rule::contact::slots::{Run, Slots};

/// Approximate number of spheres in a slab.
const SPHERES: usize = 500;
/// Largest number of slabs: of 100,000 spheres each slab still fits into a cache of the processor.
const MOST: usize = 200;

/// The contacts of a run of slots.
#[derive(Debug, Educe, Default)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Slab {
    pub start: usize,
    pub end: usize,
    pub batches: Batches,
    pub surfaces: Vec<SurfaceContact>,
    /// Places of the contacts with surfaces that may press in the sub-step.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub active: Vec<u32>,
    /// Pairs of slots that a search found, until contacts are made of them.
    pub pairs: Vec<[u32; 2]>,
    /// Pairs across the faces of a periodic box that a search found, until contacts are made of them.
    pub image_pairs: Vec<ImagePair>,
    pub descent: Descent,
    /// Pairs that the search tested.
    pub tests: u64,
    /// Whether sweeps pass over it.
    pub is_done: bool,
    /// Sums and maxima of a stage in this slab.
    pub totals: SlabTotals,
}

impl Slab {
    /// Makes it a slab without slots and contacts.
    fn clear(&mut self) {
        let Self { batches, surfaces, pairs, image_pairs, .. } = self;
        batches.clear(0);
        surfaces.clear();
        pairs.clear();
        image_pairs.clear();
        (self.start, self.end) = (0, 0);
        (self.descent, self.totals) = (Descent::default(), SlabTotals::default());
        (self.tests, self.is_done) = (0, false);
    }

    /// The contacts with surfaces, and the places of those that may press in the sub-step.
    pub fn active_surfaces(&mut self) -> (&mut [SurfaceContact], &[u32]) {
        (&mut self.surfaces, &self.active)
    }

    /// The slots of both spheres of a contact.
    pub fn slots_of(&self, batch: usize, lane: usize) -> [usize; 2] {
        let batch = &self.batches.pairs[batch];
        [batch.first[lane], batch.second[lane]].map(|slot| self.start + slot as usize)
    }
}

/// Number of slabs for a number of spheres.
pub(crate) fn count(spheres: usize) -> usize {
    let count = (spheres / SPHERES).clamp(1, MOST);
    // With equal numbers of even and odd slabs, both phases have the same work.
    if count > 1 { count & !1 } else { 1 }
}

/// All slabs, and the contacts that fit into none.
#[derive(Debug, Educe, Default)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Slabs {
    pub list: Vec<Slab>,
    /// Contacts of spheres of slabs that are not neighbours.
    pub far: Slab,
}

/// Order of the phases.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Direction {
    Forwards,
    Backwards,
}

impl Slabs {
    /// Makes one slab with this number of slots, without contacts, in the memory of the present ones.
    pub fn make_one(&mut self, slots: usize) {
        self.list.resize_with(1, Slab::default);
        self.iter_mut().for_each(Slab::clear);
        self.list[0].end = slots;
    }

    /// Returns all slabs, in the order in which contacts are listed.
    pub fn iter(&self) -> impl Iterator<Item = &Slab> {
        self.list.iter().chain([&self.far])
    }

    /// The contacts of a sphere, by its slot, with surfaces.
    pub fn surfaces_of(&self, slot: usize) -> impl Iterator<Item = &SurfaceContact> {
        let slab = &self.list[self.list.partition_point(|slab| slab.end <= slot)];
        let relative = (slot - slab.start) as u32;
        let first = slab.surfaces.partition_point(|contact| contact.slot < relative);
        slab.surfaces[first..].iter().take_while(move |it| it.slot == relative)
    }

    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut Slab> {
        self.list.iter_mut().chain([&mut self.far])
    }

    /// Sum of the energies of a stage.
    pub fn energy(&self) -> f64 {
        self.iter().map(|slab| slab.totals.energy).sum()
    }

    /// Runs a stage on the own slots of each slab, side by side.
    pub fn each(&mut self, slots: &mut Slots, stage: impl Fn(Run, &mut Slab) + Sync) {
        if let [only] = &mut self.list[..] {
            return stage(slots.first(only.end), only);
        }
        let ends: Vec<usize> = self.list.iter().map(|slab| slab.end).collect();
        let tasks = slots.runs(ends.into_iter()).into_iter().zip(&mut self.list).collect();
        parallel::for_each(tasks, |(run, slab)| stage(run, slab));
    }

    /// Runs a stage on the slots of each slab that needs nothing else of it, side by side.
    pub fn each_run(&mut self, slots: &mut Slots, stage: impl Fn(Run) + Sync) {
        self.each(slots, |run, _| stage(run));
    }

    /// Runs a stage on the contacts of all slabs, phase after phase.
    pub fn each_contact(
        &mut self,
        slots: &mut Slots,
        direction: Direction,
        stage: impl Fn(&mut Run, &mut Slab) + Sync,
    ) {
        match direction {
            Direction::Forwards => {
                self.phase(slots, 0, &stage);
                self.phase(slots, 1, &stage);
                self.far(slots, &stage);
            }
            Direction::Backwards => {
                self.far(slots, &stage);
                self.phase(slots, 1, &stage);
                self.phase(slots, 0, &stage);
            }
        }
    }

    fn far(&mut self, slots: &mut Slots, stage: impl Fn(&mut Run, &mut Slab)) {
        self.far.totals = SlabTotals::default();
        if !self.far.batches.pairs.is_empty() {
            stage(&mut slots.all(), &mut self.far);
        }
    }

    /// Runs a stage on the contacts of every other slab, from slab `first` on.
    fn phase(
        &mut self,
        slots: &mut Slots,
        first: usize,
        stage: impl Fn(&mut Run, &mut Slab) + Sync,
    ) {
        if let [only] = &mut self.list[..] {
            // In the odd phase it is not at work.
            if first == 0 {
                stage(&mut slots.first(only.end), only);
            }
            return;
        }
        let end = |slab: usize| self.list[slab.min(self.list.len() - 1)].end;
        // In the odd phase, slab 0 is not at work.
        let idle = (first == 1).then(|| end(0));
        let pairs = (first..self.list.len()).step_by(2).map(|slab| end(slab + 1));
        let ends: Vec<usize> = idle.into_iter().chain(pairs).collect();
        let runs = slots.runs(ends.into_iter()).into_iter().skip(first);
        let tasks = runs.zip(self.list.iter_mut().skip(first).step_by(2)).collect();
        parallel::for_each(tasks, |(mut run, slab): (Run, &mut Slab)| stage(&mut run, slab));
    }
}
