//! The timeline: the flights of all spheres and their next events.

use educe::Educe;
use glam::DVec3;

use super::contacts::Member;
use super::events::{Event, NextEvents, PackedTarget, Prediction, Schedule, UpcomingEvent};
use super::flights::{Component, Flights, JointStep, Species, StepLimits, Support};
use super::moving_regions::MovingRegions;
use super::neighbours::clearance::{Clearance, Obstacle};
use super::neighbours::{NeighbourBuffer, Neighbours};
use super::ticks;
use super::watch::Watch;
use super::zones::budget::Budget;
use super::zones::frame_work::FrameWork;
use super::zones::zone::Zone;
use crate::report::EnergyAccount;
use crate::settings::Exact;
use crate::system::System;

/// More spheres than this do not stay in the fast caches.
const MANY: usize = 20_000;

/// The state of the rule between frames.
///
/// Only the flights are state. Neighbours and schedule follow from them: they decide speed, never the next event.
#[derive(Debug, Educe, Default)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Timeline {
    pub(super) parameters: Exact,
    pub(super) flights: Flights,
    pub(super) neighbours: Neighbours,
    /// End of the validity of neighbours on the world's clock \[s\]; finite where radii grow or images slide.
    pub(super) neighbours_until: f64,
    pub(super) schedule: Schedule,
    /// Moving surfaces that deflect spheres.
    pub(super) moving_surfaces: Vec<u32>,
    /// Where colliders that move may be within the frame.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(super) moving_regions: MovingRegions,
    /// Clearance of each sphere, by slot, where flights restart often near surfaces at rest; else empty.
    pub(super) clearances: Vec<Clearance>,
    pub(super) work: FrameWork,
    /// What groups spent in a tick.
    pub(super) budget: Budget,
    /// The spheres in zones.
    pub(crate) zone: Zone,
    /// The frame on the world's clock \[s\]: surfaces are where the system says at its start, and their rotation is
    /// known up to its end.
    pub(super) frame: [f64; 2],
    /// Time between two force ticks \[s\].
    pub(super) force_tick: f64,
    /// The force tick before springs made it shorter \[s\]: the work of curves is bounded in each.
    pub(super) work_tick: f64,
    /// A bound for the rate of motion on springs \[1/s\].
    pub(super) spring_rate: f64,
    /// End of the time for which the present forces are held, on the world's clock \[s\].
    pub(super) held_until: f64,
    /// Held forces of nonconservative interactions \[N\], by index, or empty. Only programs define these: none is written.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(super) working_forces: Vec<DVec3>,
    /// Latest end of all curves, as forces applied over a frame need it, on the world's clock \[s\].
    pub(super) curves_until: f64,
    /// When the next spheres are emitted, on the world's clock \[s\].
    pub(super) next_emission: f64,
    /// A sphere, by index, in contact on curves, after the work of its tick was spent or where friction jams it.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(super) spent: Option<u32>,
    /// Slots of spheres whose flights restarted because those of companions did, and which are not predicted yet.
    pub(super) restarted: Vec<u32>,
    /// Watch over spheres during a step, for sensors and for the work of forces.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(super) watch: Option<Box<Watch>>,
    /// Events, and cell crossings among them, since the spheres were put in order of place.
    pub(super) events: u64,
    pub(super) cell_crossings: u64,
}

impl Timeline {
    /// Whether all flights restart at the start of each frame: applied forces are held over a frame, and no sphere
    /// is in a zone.
    pub fn is_renewed_each_frame(&self, are_applied: bool) -> bool {
        self.flights.hold_forces && are_applied && self.zone.is_empty()
    }

    /// The next force tick, on the world's clock \[s\]; infinite if no force changes with where spheres are.
    pub(super) fn next_force_tick(&self) -> f64 {
        if self.flights.forces_vary && self.holds_forces() {
            self.held_until
        } else {
            f64::INFINITY
        }
    }

    /// Whether forces are held on some spheres: on all where none flies on a curve, else on those in persistent
    /// contact and in zones.
    pub(super) fn holds_forces(&self) -> bool {
        let is_free = !self.flights.clusters.hold_forces() && self.zone.is_empty();
        !(is_free && self.flights.are_curved())
    }

    /// Returns when neighbours stop being valid, as radii grow or images slide, on the world's clock \[s\].
    pub(super) fn room_until(&self) -> f64 {
        self.neighbours_until
    }

    /// Writes the radii of all spheres at `time` \[s\] if some grow, in metres.
    pub fn write_radii(&self, radii: &mut [f64], time: f64) {
        self.flights.write_radii(radii, time);
    }

    /// Time between two ticks of zones in the present frame \[s\].
    pub(super) fn zone_tick(&self) -> f64 {
        let [start, end] = self.frame;
        let tick = self.parameters.zone_tick;
        if end > start { ticks::zone_tick(self.parameters, end - start) } else { tick }
    }

    /// Whether friction acts, so that spins change.
    pub fn has_friction(&self) -> bool {
        !self.flights.rotations.is_empty()
    }

    /// Whether spheres grow.
    pub fn has_growth(&self) -> bool {
        self.flights.growth.is_some()
    }

    /// Reports the changes of energy in zones up to `time` \[s\].
    pub fn report_zone_energy(&mut self, time: f64, account: &mut EnergyAccount) {
        self.zone.report_energy(time, account);
    }

    /// Returns the work that persistent contacts have done up to `time` \[s\] since it was taken last: that of
    /// friction and that of colliders that move \[J\].
    pub fn take_contact_work(&mut self, time: f64) -> [f64; 2] {
        self.flights.take_contact_work(time)
    }

    /// The zone, for a timeline that is made again.
    pub fn into_zone(self) -> Zone {
        self.zone
    }

    /// Whether there are more spheres than the fast caches hold.
    #[inline(always)]
    pub fn are_many(&self) -> bool {
        self.flights.bodies.len() > MANY
    }

    /// Time up to which predictions are of use, on the world's clock \[s\]: when all flights begin
    /// again.
    #[inline]
    pub fn horizon(&self) -> f64 {
        if !self.flights.hold_forces {
            f64::INFINITY
        } else if self.flights.are_curved() {
            self.curves_until
        } else {
            self.held_until
        }
    }

    /// Latest end of the flight of the sphere at `slot`, of this species, on the world's clock \[s\]: the end of
    /// its curve's step, the next computation of its persistent contacts, the next step of its zone, or the next
    /// restart of all flights.
    #[inline]
    pub(super) fn flight_end(&self, slot: u32, species: &Species) -> f64 {
        if species.is_curved {
            return self.flights.step_end(slot);
        }
        if species.is_stepped {
            return self.zone.next_tick().min(self.horizon());
        }
        let renewal = species.cluster.map(|number| self.flights.clusters.get(number).renewal);
        renewal.map_or(self.horizon(), |renewal| {
            renewal.min(self.horizon()).min(self.next_force_tick())
        })
    }

    /// Whether a sphere that is connected with the one at `slot`, and flies on no curve, ends its flight at `time` \[s\].
    pub(super) fn companion_ends(&self, slot: u32, time: f64) -> bool {
        let flights = &self.flights;
        let component = || flights.components.of_sphere(flights.index_of[slot as usize]);
        let Some(number) = component().filter(|_| flights.has_companions(slot)) else {
            return false;
        };
        let [numbers, _] = flights.connected_components(number);
        let members = numbers.iter().flat_map(|&number| &flights.components.get(number).members);
        members.map(|&index| flights.slot_of[index as usize]).any(|other| {
            let species = flights.species_of(other);
            !species.is_curved && self.flight_end(other, species) == time
        })
    }

    /// Begins the flight of a sphere in the state of an event, without contact forces.
    pub(super) fn begin_free_flight(&mut self, member: &Member, time: f64) {
        let Member { slot, position, velocity, species, .. } = *member;
        self.set_free(slot, time);
        if species.is_curved {
            self.flights.set_free_acceleration(slot, species.acceleration);
        }
        self.begin_flight(slot, position, velocity, time);
    }

    /// Computes the flight of a sphere to the end of a step, if forces without a closed form act on it and the step
    /// is not known yet. The flights of its component's members restart.
    #[inline]
    pub(super) fn find_curve(&mut self, system: &System, slot: u32) {
        if self.flights.are_curved()
            && let Some(number) = self.flights.unknown_component_of(slot)
        {
            self.take_step(system, number);
        }
    }

    /// Computes all flights that are not known yet.
    pub(super) fn find_curves(&mut self, system: &System) {
        if !self.flights.are_curved() {
            return;
        }
        // In the order of ids: a force of a program may count its calls.
        for index in 0..self.flights.slot_of.len() {
            self.find_curve(system, self.flights.slot_of[index]);
        }
    }

    /// Restarts the flights of each component in which one restarted, and lists them as `restarted`.
    #[inline]
    pub(super) fn restart_companions(&mut self, system: &System) {
        while let Some(number) = self.flights.components.next_due() {
            self.take_step(system, number);
        }
    }

    /// Takes the next step of a component, by its number, from the latest start of its members' flights.
    #[inline(never)]
    fn take_step(&mut self, system: &System, number: u32) {
        let [numbers, clusters] = self.flights.connected_components(number);
        let parts = numbers.iter().map(|&number| self.flights.components.get(number));
        let component = Component::joined(parts);
        let slot_of = |&index: &u32| self.flights.slot_of[index as usize];
        let slots: Vec<u32> = component.members.iter().map(slot_of).collect();
        let begun = |&slot: &u32| self.flights.bodies[slot as usize].time;
        let now = slots.iter().map(begun).fold(f64::NEG_INFINITY, f64::max);
        for &slot in &slots {
            if self.flights.curve_of(slot).is_some() {
                self.go_on(slot, now);
                self.restarted.push(slot);
            }
        }
        let given = slots.iter().filter(|&&slot| !self.flights.species_of(slot).is_curved);
        let ends = given.map(|&slot| self.flight_end(slot, self.flights.species_of(slot)));
        let until = ends.fold(self.curves_until, f64::min);
        let tick_number = (now / self.work_tick).floor();
        let only_contacts = slots.iter().all(|&it| !self.flights.free_species_of(it).is_curved);
        let mut is_rough = false;
        for &number in &numbers {
            is_rough |= self.flights.components.begin_step(number, tick_number, only_contacts);
        }
        let tick =
            if self.spring_rate > 0.0 { self.force_tick } else { self.parameters.force_tick };
        let limits = StepLimits { until, surfaces_at: self.frame[0], tick, is_rough };
        let step = self.flights.step_from_start(system, (&component, &clusters), limits);
        let JointStep { curves, turning, evaluations, contact_work, releases, .. } = step;
        let held = slots.iter().find(|&&slot| self.flights.cluster_on_curves(slot).is_some());
        let is_spent = step.is_jammed || is_rough && (only_contacts || !step.is_accurate);
        let held = held.filter(|_| is_spent);
        self.spent = held.map(|&slot| self.flights.index_of[slot as usize]).or(self.spent);
        curves.into_iter().for_each(|(slot, curve)| self.flights.set_curve(slot, curve));
        self.flights.note_curves(&slots, now);
        for (slot, turning) in turning {
            self.flights.rotate_over_step(slot, turning, now);
        }
        for (number, release) in clusters.into_iter().zip(releases) {
            self.flights.clusters.get_mut(number).renewal = release;
        }
        self.flights.components.charge(number, evaluations);
        self.budget.charge_at(self.parameters, &component.members, contact_work, now);
    }

    /// Continues a sphere in another flight at `time` \[s\] without counting it as work.
    pub(super) fn go_on(&mut self, slot: u32, time: f64) {
        let (position, velocity) = self.flights.state_of(slot, time);
        self.flights.count_contact_work(slot, time);
        let body = &mut self.flights.bodies[slot as usize];
        let before = body.generation;
        body.begin_flight(position, velocity, time);
        self.work.pass_over_step(slot, [before, body.generation]);
        self.note_flight(slot);
        self.wrap(slot);
    }

    /// Begins another flight of a sphere from this state at `time` \[s\].
    pub(super) fn begin_flight(&mut self, slot: u32, position: DVec3, velocity: DVec3, time: f64) {
        let rest = match self.flights.has_companions(slot) {
            true => self.flights.rest_of_step(slot, [position, velocity], time),
            false => None,
        };
        self.flights.bodies[slot as usize].begin_flight(position, velocity, time);
        match rest {
            // Companions are not affected.
            Some(rest) => self.flights.set_rest_of_step(slot, rest),
            None => self.note_for_companions(slot),
        }
        self.note_flight(slot);
        self.wrap(slot);
    }

    /// Notes that the companions of a sphere must restart their flights.
    #[inline]
    pub(super) fn note_for_companions(&mut self, slot: u32) {
        if self.flights.are_curved() {
            self.flights.components.note(self.flights.index_of[slot as usize]);
        }
    }

    /// Makes a cluster of free spheres from `time` \[s\] on.
    pub(super) fn set_supported(&mut self, support: Support, time: f64) {
        support.members.iter().for_each(|member| self.note_for_companions(member.slot));
        self.flights.set_supported(support, time);
    }

    /// Notes for the watch that a sphere begins another flight.
    #[inline]
    pub(super) fn note_flight(&mut self, slot: u32) {
        if let Some(watch) = &mut self.watch {
            watch.begun.push(slot);
        }
    }

    /// Wraps the position where a flight begins into the periodic box. Returns whether it changed.
    #[inline(always)]
    pub(super) fn wrap(&mut self, slot: u32) -> bool {
        let is_elsewhere = !self.neighbours.is_in_box(self.flights.bodies[slot as usize].position);
        is_elsewhere && self.wrap_into_box(slot)
    }

    /// Wraps the position where a flight begins into the periodic box, where it may be outside.
    #[inline(never)]
    fn wrap_into_box(&mut self, slot: u32) -> bool {
        let body = &mut self.flights.bodies[slot as usize];
        let level = self.flights.species[body.species as usize].level;
        if let Some(&sliding) = self.neighbours.sliding() {
            let state = [body.position, body.velocity];
            [body.position, body.velocity] =
                self.neighbours.wrap_sliding((slot, level), sliding, state, body.time);
            return true;
        }
        let wrapped = self.neighbours.wrap(slot, level, body.position);
        body.position = wrapped.unwrap_or(body.position);
        wrapped.is_some()
    }

    /// Removes the contact forces on a sphere at `time` \[s\], and its cluster.
    pub(super) fn set_free(&mut self, slot: u32, time: f64) {
        if self.flights.set_free(slot, time) {
            self.drop_clearance(slot);
        }
    }

    /// Moves the sphere with this index of the world's arrays at `time` \[s\]. Its predictions are not renewed.
    pub fn place(&mut self, index: usize, position: DVec3, velocity: DVec3, time: f64) {
        let slot = self.flights.slot_of[index];
        self.set_free(slot, time);
        let position = self.neighbours.wrapped(position);
        self.flights.bodies[slot as usize].begin_flight(position, velocity, time);
        self.note_for_companions(slot);
        self.cross_cell(slot, [position, velocity], &mut NeighbourBuffer::default());
        self.wrap(slot);
    }

    /// Shifts the flights from `now` \[s\] to another time \[s\]. Predictions are not renewed.
    pub fn set_time(&mut self, now: f64, time: f64) {
        for slot in 0..self.flights.bodies.len() as u32 {
            let (position, velocity) = self.flights.state_of(slot, now);
            self.begin_flight(slot, position, velocity, time);
        }
        self.flights.rotations.iter_mut().for_each(|rotation| rotation.set_time(now, time));
        self.flights.restart_contact_work();
    }

    /// Moves a sphere at a position \[m\] with a velocity \[m/s\] to its next neighbour region, and
    /// finds the neighbours that are new there.
    pub(super) fn cross_cell(&mut self, slot: u32, state: [DVec3; 2], found: &mut NeighbourBuffer) {
        let level = self.flights.species_of(slot).level;
        self.neighbours.cross_cell(slot, level, state, found);
        self.drop_clearance(slot);
    }

    /// Whether a sphere cannot meet a surface on its flight, other than those in persistent contact with it.
    #[inline]
    pub(super) fn is_clear_of_surfaces(&self, slot: u32) -> bool {
        self.clearances.get(slot as usize).is_some_and(|clearance| {
            let body = &self.flights.bodies[slot as usize];
            let species = self.flights.species_of(slot);
            if species.is_curved {
                let curve = self.flights.curve_of(slot);
                return curve.is_some_and(|(flight, _)| {
                    clearance.holds_way(body.position, flight.farthest())
                });
            }
            clearance.holds(&body.flight(species), self.flight_end(slot, species) - body.time)
        })
    }

    /// Computes the clearance of a sphere again, if the sphere leaves the old one.
    pub(super) fn find_clearance(&mut self, system: &System, slot: u32) {
        if self.clearances.is_empty() || self.is_clear_of_surfaces(slot) {
            return;
        }
        let obstacles = self
            .surfaces_at_rest_near(slot)
            .filter(|&(surface, _)| !self.flights.is_held_by(slot, surface))
            .map(|(surface, shift)| Obstacle {
                form: &system.surfaces[surface as usize].form,
                shift,
            });
        let center = self.flights.bodies[slot as usize].position;
        let radius = self.flights.species_of(slot).radius;
        self.clearances[slot as usize] = Clearance::about(center, radius, obstacles);
    }

    /// Drops the clearance of a sphere that may meet other surfaces now.
    pub(super) fn drop_clearance(&mut self, slot: u32) {
        if let Some(clearance) = self.clearances.get_mut(slot as usize) {
            *clearance = Clearance::NONE;
        }
    }

    /// Notes a sphere with a sphere of a zone among its neighbours; or its neighbours, if it is in a zone.
    pub(super) fn note_near_zone(&mut self, slot: u32, near: &NeighbourBuffer) {
        let Self { flights, zone, .. } = self;
        if zone.is_empty() {
            return;
        }
        let mut others = near.others(slot).map(|near| near.slot());
        if flights.is_stepped(slot) {
            zone.near.extend(others.filter(|&other| !flights.is_stepped(other)));
        } else if others.any(|other| flights.is_stepped(other)) {
            zone.near.push(slot);
        }
    }

    /// Changes the next events of a sphere in the same neighbour region.
    pub(super) fn reschedule(&mut self, slot: u32, events: NextEvents) {
        let cell_crossing = self.schedule.cell_crossing(slot);
        self.enter(slot, Prediction { events, cell_crossing });
    }

    /// Enters the prediction of a sphere into the schedule.
    #[inline]
    pub(super) fn enter(&mut self, slot: u32, prediction: Prediction) {
        self.schedule.enter(slot, self.flights.index_of[slot as usize], prediction);
    }

    /// The meeting with another sphere at this time \[s\], with that sphere's present generation.
    #[inline(always)]
    pub(super) fn meeting(&self, time: f64, other: u32) -> Event {
        let generation = self.flights.bodies[other as usize].generation;
        Event { time, target: PackedTarget::sphere(other), generation }
    }

    /// Whether a meeting is void because the other sphere restarted.
    #[inline]
    pub(super) fn is_void(&self, event: &Event) -> bool {
        let generation_of = |other: u32| self.flights.bodies[other as usize].generation;
        event.target.slot().is_some_and(|other| generation_of(other) != event.generation)
    }

    /// Takes out what happens next, not later than `end` \[s\], with the slot of the sphere.
    pub(super) fn next(&mut self, end: f64) -> Option<(u32, UpcomingEvent)> {
        let next = self.schedule.pop(end)?;
        self.events += 1;
        self.cell_crossings += u64::from(matches!(next.1, UpcomingEvent::CellCrossing(_)));
        Some(next)
    }

    /// Number of flights that a sphere began in this frame, plus the work of its groups.
    #[inline]
    pub(super) fn work_in_frame(&self, slot: u32) -> u64 {
        self.work.of(slot, self.flights.bodies[slot as usize].generation)
    }
}
