//! How much work each sphere took in a frame.

use educe::Educe;
use prefetch_index::prefetch_index;

use crate::report::StageCounts;
use crate::rule::exact::flights::Body;

/// Units of work that count as much as one flight of a sphere.
pub(crate) const UNITS_PER_FLIGHT: u64 = 32;

/// Returns by how much the generation grew without impacts: a flight that an impact began adds one,
/// which counts with the impact.
fn flights_between(before: u32, now: u32) -> u32 {
    now.wrapping_sub(before) & !1
}

/// Work in the frame, by slot, in flights.
#[derive(Debug, Educe, Default)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct FrameWork {
    /// Generation of each sphere's flight at the start of the frame.
    generations_before: Vec<u32>,
    /// Work of the groups of each sphere; empty where there was none.
    of_groups: Vec<u64>,
    /// Counts that are in no report yet.
    pub unreported: StageCounts,
}

impl FrameWork {
    /// Counts from here on.
    pub fn begin(&mut self, bodies: &[Body]) {
        self.of_groups.clear();
        self.generations_before.clear();
        self.generations_before.extend(bodies.iter().map(|body| body.generation));
    }

    /// Reorders the counts as the spheres at the slots of `order`.
    pub fn reorder(&mut self, order: &[u32]) {
        if !self.generations_before.is_empty() {
            let before = |&slot: &u32| self.generations_before[slot as usize];
            self.generations_before = order.iter().map(before).collect();
        }
        if !self.of_groups.is_empty() {
            let work = |&slot: &u32| self.of_groups[slot as usize];
            self.of_groups = order.iter().map(work).collect();
        }
    }

    /// Leaves out flights that all restarted at once and had these generations before.
    pub fn pass_over(&mut self, before: &[u32], bodies: &[Body]) {
        let generations = before.iter().zip(bodies).map(|(before, body)| (before, body.generation));
        for (counted, (before, now)) in self.generations_before.iter_mut().zip(generations) {
            *counted = counted.wrapping_add(flights_between(*before, now));
        }
    }

    /// Leaves out the flights of a sphere between two generations.
    pub fn pass_over_step(&mut self, slot: u32, [before, now]: [u32; 2]) {
        if let Some(counted) = self.generations_before.get_mut(slot as usize) {
            *counted = counted.wrapping_add(flights_between(before, now));
        }
    }

    /// Number of flights that a sphere with this generation began, plus the work of its groups.
    #[inline]
    pub fn of(&self, slot: u32, generation: u32) -> u64 {
        let before = self.generations_before[slot as usize];
        // Each flight adds two, or one if an impact began the flight before it.
        let flights = generation.wrapping_sub(before).div_ceil(2);
        let of_groups = self.of_groups.get(slot as usize).copied().unwrap_or(0);
        u64::from(flights) + of_groups
    }

    /// Counts the work of a group for each of its spheres.
    pub fn charge(&mut self, slots: impl Iterator<Item = u32>, work: u64) {
        if self.of_groups.is_empty() {
            self.of_groups.resize(self.generations_before.len(), 0);
        }
        slots.for_each(|slot| self.of_groups[slot as usize] += work);
    }

    /// Fetches what is kept of a sphere into the cache.
    #[inline(always)]
    pub fn prefetch(&self, slot: u32) {
        prefetch_index(&self.generations_before, slot as usize);
    }
}
