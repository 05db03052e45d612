//! The states of all spheres at one time, from their flights.

use std::array;
use std::ops::Range;

use fearless_simd::{Level, Simd, dispatch};
use glam::DVec3;
use prefetch_index::prefetch_index;

use super::lanes::FlightLanes;
use super::state::Flights;
use crate::bodies::Motion;
use crate::lanes::{LANES, Lanes};
use crate::parallel;
use crate::real::Vector;
use crate::rule::periodic;

/// Number of flights that are fetched into the cache ahead where all flights are read in order.
const FETCHED_AHEAD: usize = 32;

/// Writes the states of all spheres at `time` \[s\], in a periodic box with these edges \[m\].
pub(crate) fn write_motion(flights: &Flights, motion: &mut Motion, period: DVec3, time: f64) {
    parallel::fill((&mut motion.position, &mut motion.velocity), |first, run| {
        let states = Run { flights, first, period, time };
        dispatch!(Level::new(), simd => states.write(simd, run));
    });
}

/// Spheres one after another in the arrays of the world, at one time.
struct Run<'a> {
    flights: &'a Flights,
    /// Index of the first one.
    first: usize,
    /// Edges of the periodic box \[m\]; infinite along an open axis.
    period: DVec3,
    /// Time on the world's clock \[s\].
    time: f64,
}

impl Run<'_> {
    /// Writes centres \[m\] and velocities \[m/s\]: side by side, where all spheres are of one species,
    /// else one by one.
    #[inline(always)]
    fn write<S: Simd>(&self, simd: S, (positions, velocities): (&mut [DVec3], &mut [DVec3])) {
        let Self { flights, first, period, time } = *self;
        let slots = &flights.slot_of[first..];
        let fetch = |places: Range<usize>| {
            let slots = slots.get(places).unwrap_or_default();
            slots.iter().for_each(|&slot| prefetch_index(&flights.bodies, slot as usize));
        };
        let mut done = 0;
        if let Some(species) = flights.only_species() {
            let acceleration = Vector::all(simd, species.acceleration);
            let states = positions.as_chunks_mut().0.iter_mut().zip(velocities.as_chunks_mut().0);
            for ((positions, velocities), slots) in states.zip(slots.as_chunks::<LANES>().0) {
                fetch(done + FETCHED_AHEAD..done + FETCHED_AHEAD + LANES);
                let bodies = slots.map(|slot| &flights.bodies[slot as usize]);
                let lanes = FlightLanes::of_each(simd, bodies);
                [*positions, *velocities] = lanes.states_at(simd, acceleration, period, time);
                done += LANES;
            }
        }
        for place in done..positions.len() {
            fetch(place + FETCHED_AHEAD..place + FETCHED_AHEAD + 1);
            let (position, velocity) = flights.state_of(slots[place], time);
            positions[place] = periodic::wrapped(position, period);
            velocities[place] = velocity;
        }
    }
}

/// The first sphere, by index, whose state is not finite at `time` \[s\], and which of its quantities
/// is not.
pub(crate) fn first_lost(flights: &Flights, time: f64) -> Option<(usize, &'static str)> {
    // In most cases this bound shows that all states are finite, and no path is followed.
    let pull = flights.species.iter().map(|it| it.acceleration.abs().element_sum()).sum();
    if dispatch!(Level::new(), simd => farthest(flights, simd, time, pull)).is_finite() {
        return None;
    }
    flights.slot_of.iter().enumerate().find_map(|(index, &slot)| {
        let (position, velocity) = flights.state_of(slot, time);
        let quantities = [("velocity", velocity), ("position", position)];
        let lost = quantities.into_iter().find(|(_, value)| !value.is_finite());
        lost.map(|(quantity, _)| (index, quantity))
    })
}

/// Upper bounds of the distance from the origin \[m\] and the speed \[m/s\] of all spheres at `time` \[s\], where
/// no acceleration exceeds `pull` \[m/s²\].
#[inline(always)]
fn farthest<S: Simd>(flights: &Flights, simd: S, time: f64, pull: f64) -> f64 {
    let [time, pull, one] = [time, pull, 1.0].map(|number| Lanes::all(simd, number));
    let (in_fours, rest) = flights.bodies.as_chunks();
    let rest = rest.first().map(|&body| array::from_fn(|place| *rest.get(place).unwrap_or(&body)));
    let mut sum = Lanes::all(simd, 0.0);
    for bodies in in_fours.iter().chain(&rest) {
        let FlightLanes { position, velocity, time: start } =
            FlightLanes::of_each(simd, bodies.each_ref());
        let age = (time - start).abs();
        sum = sum + position.l1_norm() + (one + age) * (velocity.l1_norm() + age * pull);
    }
    sum.to_array().iter().sum()
}
