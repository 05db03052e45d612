//! The budget: how much work impacts may take in a tick, before their spheres are stepped.

use std::collections::BTreeMap;

use crate::settings::Exact;

/// Ticks in which all groups together may spend the budget of one group.
const TICKS_OF_A_BUDGET: f64 = 4.0;
/// Budgets of one group by which all groups together may be ahead of that.
const AHEAD: u64 = 8;
/// Each time that all groups together have spent the budget of one, the budget of each is halved, up to this many
/// times. Many groups then cost hardly more than a few.
const MOST_HALVINGS: u64 = 16;

/// A flight after which the sphere does not count as moved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ShortFlight {
    /// The sphere stayed where it was.
    Still,
    /// Forces brought it back to the body that it left, and some of them take energy: each hop is lower than the one
    /// before, without end, and what is left of them is no motion to be seen.
    DampedHop,
}

impl ShortFlight {
    /// Units of work that the flight counts as: the budget divided by them is the number of such flights that a sphere
    /// may make in a tick.
    fn units(self) -> u64 {
        match self {
            Self::Still => 60,
            Self::DampedHop => 6_000,
        }
    }
}

/// What the groups of a tick have spent, in units of work.
#[derive(Debug, Clone, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Budget {
    /// The number of the tick.
    tick: f64,
    /// Units spent, by index of the sphere.
    spent_by_sphere: BTreeMap<u32, u64>,
    /// Units of short flights, by index of the sphere.
    short_flights: BTreeMap<u32, u64>,
    of_all: u64,
}

impl Budget {
    /// How much a group of these spheres, by index, may spend at `time` \[s\].
    pub fn allowance(&mut self, parameters: Exact, spheres: &[u32], time: f64) -> u64 {
        let of_each = u64::from(parameters.zone_budget);
        self.follow(time / parameters.zone_tick, of_each);
        let halvings = (self.of_all / of_each).saturating_sub(AHEAD).min(MOST_HALVINGS);
        let spent = spheres.iter().filter_map(|index| self.spent_by_sphere.get(index)).max();
        (of_each >> halvings).saturating_sub(spent.copied().unwrap_or(0))
    }

    /// Adds what the answer of a group of these spheres spent, and what it took `besides`.
    pub fn charge(&mut self, spheres: &[u32], spent: u64, besides: u64) {
        self.of_all += spent + besides;
        spheres.iter().for_each(|&index| *self.spent_by_sphere.entry(index).or_default() += spent);
    }

    /// Adds what the curves of these spheres, by index, spent that begin at `time` \[s\].
    pub fn charge_at(&mut self, parameters: Exact, spheres: &[u32], spent: u64, time: f64) {
        if spent > 0 {
            self.follow(time / parameters.zone_tick, u64::from(parameters.zone_budget));
            self.charge(spheres, spent, 0);
        }
    }

    /// Counts a short flight of a sphere, by index, that ends at `time` \[s\]. Returns whether there have been too
    /// many in this tick.
    pub fn is_spent_by_flight(
        &mut self,
        parameters: Exact,
        (sphere, flight): (u32, ShortFlight),
        time: f64,
    ) -> bool {
        self.follow(time / parameters.zone_tick, u64::from(parameters.zone_budget));
        let units = self.short_flights.entry(sphere).or_default();
        *units += flight.units();
        *units > u64::from(parameters.zone_budget)
    }

    /// Advances to a time, in ticks.
    fn follow(&mut self, ticks: f64, of_each: u64) {
        let tick = ticks.floor();
        if tick != self.tick {
            let regained = (tick - self.tick) * (of_each as f64 / TICKS_OF_A_BUDGET);
            self.of_all = self.of_all.saturating_sub(regained as u64);
            self.tick = tick;
            self.spent_by_sphere.clear();
            self.short_flights.clear();
        }
    }
}
