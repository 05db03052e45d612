//! The pair search: the neighbours of a sphere, and which of them it meets first.

use glam::DVec3;
use prefetch_index::prefetch_index;

use super::kernel::{Meeting, PairQuery};
use crate::contact_time;
use crate::detect::contact::Bodies;
use crate::rule::exact::events::NextEvents;
use crate::rule::exact::flights::{Body, Flights, Species};
use crate::rule::exact::neighbours::{Neighbour, NeighbourBuffer};
use crate::rule::exact::timeline::Timeline;

/// A search among the neighbours of a sphere, with its result.
#[derive(Debug, Clone, Default)]
pub(crate) struct PairSearch {
    pub near: NeighbourBuffer,
    /// The first two meetings with spheres that fly alike.
    meetings: [Meeting; 2],
    /// How many pairs were tested in all searches so far.
    tests: u64,
}

/// Decides which neighbours count as near: all but one, within the sum of radii and a part of it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct NearTest {
    /// The slot of the sphere that does not count.
    pub exempt: u32,
    /// Part of the sum of radii.
    pub margin: f64,
}

impl NearTest {
    /// A test for the neighbours of a sphere whose result is not needed.
    #[inline(always)]
    pub fn none(slot: u32) -> Self {
        Self { exempt: slot, margin: 0.0 }
    }
}

impl PairSearch {
    /// Searches, `now` \[s\], for the first meetings of a sphere with its neighbours. Returns whether
    /// one of those that fly alike is near.
    #[inline(always)]
    pub fn search(
        &mut self,
        timeline: &Timeline,
        slot: u32,
        now: f64,
        near_test: NearTest,
    ) -> bool {
        let level = timeline.flights.species_of(slot).level;
        timeline.neighbours.find(slot, level, &mut self.near);
        // Where spheres pass through each other, the search finds not even the sphere itself.
        let itself = usize::from(timeline.neighbours.finds_itself());
        self.tests += self.near.len.saturating_sub(itself) as u64;
        self.test_found(timeline, slot, now, near_test)
    }

    /// Searches, `now` \[s\], for the first meetings of a sphere with those neighbours that it `meets`, by
    /// their slots.
    pub fn search_among(
        &mut self,
        timeline: &Timeline,
        slot: u32,
        now: f64,
        meets: impl Fn(u32) -> bool,
    ) {
        let level = timeline.flights.species_of(slot).level;
        timeline.neighbours.find(slot, level, &mut self.near);
        self.near.retain(|neighbour| meets(neighbour.slot()));
        self.search_found(timeline, slot, now);
    }

    /// Searches for the first meetings among the neighbours that were found already.
    pub fn search_found(&mut self, timeline: &Timeline, slot: u32, now: f64) {
        self.tests += self.near.others(slot).count() as u64;
        self.test_found(timeline, slot, now, NearTest::none(slot));
    }

    #[inline(always)]
    fn test_found(
        &mut self,
        timeline: &Timeline,
        slot: u32,
        now: f64,
        near_test: NearTest,
    ) -> bool {
        if timeline.are_many() {
            let slots = self.near.found().iter().map(|near| near.slot() as usize);
            slots.for_each(|slot| prefetch_index(&timeline.flights.bodies, slot));
        }
        let (count, has_images) = (self.near.len, self.near.has_images());
        let NearTest { exempt, margin } = near_test;
        let near = self.near.in_fours();
        let query = PairQuery { timeline, slot, near, count, has_images, now, exempt, margin };
        let result = query.result();
        self.meetings = result.meetings;
        result.is_near
    }

    /// Returns the number of pairs tested in all searches so far.
    pub fn tests(&self) -> u64 {
        self.tests
    }

    /// Whether one of the spheres that fly differently is near to a sphere when its flight begins.
    pub fn is_near_others(&self, timeline: &Timeline, slot: u32, near_test: NearTest) -> bool {
        let flights = &timeline.flights;
        let (body, species) = (&flights.bodies[slot as usize], flights.species_of(slot));
        let neighbourhood =
            Neighbourhood { position: body.position, time: body.time, margin: near_test.margin };
        self.near.others(slot).any(|near| {
            near.slot() != near_test.exempt
                && !flights.species_of(near.slot()).flies_like(species)
                && neighbourhood.includes(timeline, slot, near)
        })
    }

    /// Returns whether any neighbour is within this distance of a sphere.
    pub fn is_near_any(
        &mut self,
        timeline: &Timeline,
        slot: u32,
        neighbourhood: Neighbourhood,
    ) -> bool {
        let level = timeline.flights.species_of(slot).level;
        timeline.neighbours.find(slot, level, &mut self.near);
        self.near.others(slot).any(|near| neighbourhood.includes(timeline, slot, near))
    }

    /// The first two meetings that the search found, with those with spheres that fly differently.
    #[inline(always)]
    pub fn first_meetings(&self, timeline: &Timeline, slot: u32) -> NextEvents {
        let [first, second] = self.meetings;
        let mut events = NextEvents {
            first: timeline.meeting(first.time, first.other),
            second: timeline.meeting(second.time, second.other),
        };
        if timeline.flights.only_species().is_none() {
            self.add_meetings_with_others(timeline, slot, &mut events);
        }
        events
    }

    /// Adds the meetings of a sphere outside zones with neighbours in zones to its next events. Returns whether
    /// there are such neighbours.
    pub fn add_meetings_with_zone(
        &mut self,
        timeline: &Timeline,
        slot: u32,
        events: &mut NextEvents,
    ) -> bool {
        let level = timeline.flights.species_of(slot).level;
        timeline.neighbours.find(slot, level, &mut self.near);
        let mut are_any = false;
        for near in self.near.others(slot).filter(|it| timeline.flights.is_stepped(it.slot())) {
            are_any = true;
            self.tests += 1;
            let time = time_of_meeting(timeline, slot, near);
            if time < f64::INFINITY {
                events.add(timeline.meeting(time, near.slot()));
            }
        }
        are_any
    }

    #[inline(never)]
    fn add_meetings_with_others(&self, timeline: &Timeline, slot: u32, events: &mut NextEvents) {
        let species = timeline.flights.species_of(slot);
        for near in self.near.others(slot) {
            if !species.flies_like(timeline.flights.species_of(near.slot())) {
                let time = time_of_meeting(timeline, slot, near);
                events.add(timeline.meeting(time, near.slot()));
            }
        }
    }
}

/// Position of a sphere at a time, and the margin within which neighbours count as near.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Neighbourhood {
    /// Centre of the sphere \[m\].
    pub position: DVec3,
    /// Time of that position, on the world's clock \[s\].
    pub time: f64,
    /// Part of the sum of radii by which the gap to a neighbour may be open.
    pub margin: f64,
}

impl Neighbourhood {
    /// Whether a neighbour of the sphere at `slot` is within the margin.
    fn includes(&self, timeline: &Timeline, slot: u32, neighbour: Neighbour) -> bool {
        let flights = &timeline.flights;
        let shift = timeline.neighbours.shift_of(slot, neighbour);
        let offset = flights.state_of(neighbour.slot(), self.time).0 + shift - self.position;
        let species = [slot, neighbour.slot()].map(|slot| flights.species_of(slot));
        let reach = flights.contact_distance(species) * (1.0 + self.margin);
        offset.length_squared() <= reach * reach
    }
}

/// Returns when a sphere meets one that flies differently, on the world's clock \[s\]; infinite if
/// never.
fn time_of_meeting(timeline: &Timeline, slot: u32, neighbour: Neighbour) -> f64 {
    let flights = &timeline.flights;
    let slots = [slot, neighbour.slot()];
    let bodies = slots.map(|slot| &flights.bodies[slot as usize]);
    let species = slots.map(|slot| flights.species_of(slot));
    let indices @ [index, other_index] = slots.map(|slot| flights.index_of[slot as usize]);
    let are_stepped = species.map(|species| species.is_stepped);
    if are_stepped == [true; 2] || flights.are_held_together(Bodies::pair(indices)) {
        // No impact ends their flights.
        return f64::INFINITY;
    }
    let shift = timeline.neighbours.shift_of(slot, neighbour);
    let [end, other_end] = [0, 1].map(|one| timeline.flight_end(slots[one], species[one]));
    let end = end.min(other_end);
    if end < f64::INFINITY {
        let [reach, other_reach] = slots.map(|slot| flights.reach_of(slot, end));
        let beyond = flights.distance_factor(species) - 1.0;
        if reach.misses_sphere(&other_reach, beyond, shift) {
            return f64::INFINITY;
        }
    }
    if species.iter().any(|species| species.is_curved) {
        let ordered = if index < other_index { slots } else { [slots[1], slots[0]] };
        let shift = if index < other_index { shift } else { -shift };
        let time = time_of_contact_on_curves(timeline, ordered, shift);
        let is_too_late = are_stepped != [false; 2] && time > end;
        return if is_too_late { f64::INFINITY } else { time };
    }
    let time = if index < other_index {
        time_of_contact(flights, bodies, species, shift)
    } else {
        // In the order of ids: the opposite order might round differently.
        time_of_contact(flights, [bodies[1], bodies[0]], [species[1], species[0]], -shift)
    };
    let is_too_late = are_stepped != [false; 2] && time > end;
    if is_too_late { f64::INFINITY } else { time }
}

/// Returns when two spheres meet of which one is on a curve, on the world's clock \[s\], before the
/// end of a step; infinite if they do not.
fn time_of_contact_on_curves(timeline: &Timeline, slots: [u32; 2], shift: DVec3) -> f64 {
    let flights = &timeline.flights;
    let start = flights.bodies[slots[0] as usize].time.max(flights.bodies[slots[1] as usize].time);
    let [first, second] = slots.map(|slot| flights.track_from(slot, start));
    let end = flights.step_end(slots[0]).min(flights.step_end(slots[1]));
    if end < start {
        return f64::INFINITY;
    }
    let distance = flights.contact_distance(slots.map(|slot| flights.species_of(slot)));
    let delay = contact_time::tracks(&first, &second.shifted(shift), distance, end - start);
    delay.map_or(f64::INFINITY, |delay| start + delay)
}

/// Time at which two spheres that fly differently meet, on the world's clock \[s\]; infinite if never. The search
/// has no end time, so that a known horizon never changes a bit of the result.
fn time_of_contact(
    flights: &Flights,
    bodies: [&Body; 2],
    species: [&Species; 2],
    shift: DVec3,
) -> f64 {
    let start = bodies[0].time.max(bodies[1].time);
    let first = bodies[0].flight_from(species[0], start);
    let mut second = bodies[1].flight_from(species[1], start);
    second.position += shift;
    let distance = flights.contact_distance(species);
    match contact_time::sphere_sphere(&first, &second, distance, f64::INFINITY) {
        Some(delay) => start + delay,
        None => f64::INFINITY,
    }
}
