//! What flights add to a log.

use glam::DVec3;

use super::flight_log::{Arrival, FlightLog, GroupImpact, JointFlight};
use super::state::Flights;
use super::support_change::{HeldMotion, SupportChange};
use crate::polynomial_flight::PolynomialFlight;

impl Flights {
    /// Starts the log with the persistent contacts and the curved flights at `now` \[s\].
    pub fn begin_log(&mut self, now: f64) {
        let slots: Vec<u32> =
            self.clusters.iter().flat_map(|cluster| cluster.members.iter().copied()).collect();
        self.log = Some(FlightLog::default());
        slots.into_iter().for_each(|slot| self.note_support(slot, now, true));
        for number in 0..self.components.len() {
            let slot_of = |&index: &u32| self.slot_of[index as usize];
            let members = &self.components.get(number).members;
            let slots: Vec<u32> = members.iter().map(slot_of).collect();
            if slots.iter().any(|&slot| self.curve_of(slot).is_some()) {
                self.note_curves(&slots, now);
            }
        }
    }

    /// Continues a log after spheres were added at `now` \[s\], and all flights began again.
    pub fn resume_log(&mut self, before: FlightLog, arrivals: Vec<Arrival>, now: f64) {
        self.begin_log(now);
        let log = self.log.get_or_insert_default();
        let FlightLog { supports, curves, groups, .. } = std::mem::replace(log, before);
        log.supports.extend(supports);
        log.curves.extend(curves);
        log.groups.extend(groups);
        log.arrivals.extend(arrivals);
    }

    /// Ends and returns the log.
    pub fn end_log(&mut self) -> FlightLog {
        self.log.take().unwrap_or_default()
    }

    /// Adds the flights of spheres that take a step together at `now` \[s\] to the log, if there is one.
    pub fn note_curves(&mut self, slots: &[u32], now: f64) {
        if self.log.is_none() {
            return;
        }
        let flight = |&slot: &u32| {
            let (flight, _) = self.curve_of(slot)?;
            let age = now - self.bodies[slot as usize].time;
            let (position, velocity) = flight.after(age);
            let acceleration =
                if age == 0.0 { flight.acceleration } else { flight.acceleration.from(age) };
            let flight = PolynomialFlight { position, velocity, acceleration };
            Some((self.index_of[slot as usize], flight))
        };
        let flights: Vec<_> = slots.iter().filter_map(flight).collect();
        let is_complete = flights.len() == slots.len();
        let joint = JointFlight { time: now, flights, is_complete };
        self.log.get_or_insert_default().curves.push(joint);
    }

    /// Adds the impact of a group to the log, if there is one.
    pub fn note_group(&mut self, group: impl FnOnce() -> GroupImpact) {
        if let Some(log) = &mut self.log {
            log.groups.push(group());
        }
    }

    /// Adds the present contact of a sphere to the log, if there is one.
    #[inline]
    pub(super) fn note_support(&mut self, slot: u32, now: f64, is_old: bool) {
        if self.log.is_some() {
            let change = self.support_of(slot, now, is_old);
            self.log.get_or_insert_default().supports.push(change);
        }
    }

    #[inline(never)]
    fn support_of(&self, slot: u32, now: f64, is_old: bool) -> SupportChange {
        let index = self.index_of[slot as usize];
        let species = self.species_of(slot);
        let held = species.cluster.map(|number| {
            let (position, velocity) = self.state_of(slot, now);
            let cluster = self.clusters.get(number);
            let rotation = self.rotations.get(index as usize);
            HeldMotion {
                position,
                velocity,
                angular_velocity: self.angular_velocity_of(slot, now),
                acceleration: species.acceleration,
                angular_acceleration: rotation.map_or(DVec3::ZERO, |it| it.angular_acceleration()),
                surfaces: {
                    let mut surfaces = cluster.surfaces_of(index);
                    [(); 3].map(|()| surfaces.next())
                },
                has_others: cluster.contacts.len() > 1,
                touches_spheres: cluster.touches_spheres(index),
                is_old,
            }
        });
        SupportChange { index, time: now, held }
    }
}
