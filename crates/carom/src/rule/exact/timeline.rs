//! The timeline: where every sphere flies, and what happens next.

use std::collections::BTreeMap;

use glam::DVec3;

use super::body::{Body, Kind};
use super::cells::{self, Cells, Contents, Crossing, Near};
use super::cluster::{Cluster, Clusters};
use super::queue::{Entry, EventQueue};
use super::support::Support;
use super::{hold, predict};
use crate::bodies::{Motion, SphereId};
use crate::forces;
use crate::surface::Role;
use crate::system::System;

/// Spheres are put in order of place again after this many events per sphere: seldom enough to
/// cost little, often enough that neighbours stay near each other in memory.
const EVENTS_PER_ARRANGEMENT: u64 = 24;

/// All that the rule keeps between frames.
///
/// Only the flights and the clusters are state. Cells, queue and events follow from them: they
/// decide how fast the next event is found, never what it is.
#[derive(Debug, Clone, Default)]
pub(crate) struct Timeline {
    /// By slot: in the order of places, so that neighbours share memory.
    pub(super) bodies: Vec<Body>,
    /// What each sphere meets next, by slot.
    pub(super) events: Vec<Event>,
    /// When each sphere leaves its cell, by slot.
    pub(super) crossings: Vec<Crossing>,
    pub(super) kinds: Vec<Kind>,
    /// Kinds that nobody is of.
    spare_kinds: Vec<u32>,
    /// Number of each sphere's flight at the start of the frame, by index.
    flights_before: Vec<u32>,
    /// Place of each slot in the arrays of the world, and back.
    pub(super) index_of: Vec<u32>,
    pub(super) slot_of: Vec<u32>,
    pub(super) cells: Cells,
    pub(super) queue: EventQueue,
    pub(super) clusters: Clusters,
    /// Surfaces that move: near every sphere.
    pub(super) moving_surfaces: Vec<u32>,
    /// When surfaces are where the system says, and until when that tells how they turn, on the
    /// world's clock \[s\]: the frame.
    pub(super) frame: [f64; 2],
    /// Whether spheres are under forces that are held constant over a frame.
    holds_forces: bool,
    events_since_arranged: u64,
    /// Working memory: spheres near those at work.
    pub(super) around: [Surroundings; 2],
}

/// Who is near a sphere.
#[derive(Debug, Clone, Default)]
pub(super) struct Surroundings {
    pub near: Near,
    /// From the centre of the sphere to that of each \[m\].
    pub offsets: Vec<DVec3>,
    /// The places in that order of those that it may meet.
    pub closing: Vec<u32>,
}

/// What a sphere meets next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Event {
    /// On the world's clock \[s\].
    pub time: f64,
    pub target: Target,
    /// Number of the other sphere's flight for which this was predicted.
    pub flights: u32,
}

/// What happens next to a sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Next {
    Event(Event),
    Crossing(Crossing),
}

/// What a sphere comes upon.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Target {
    /// Another sphere, by slot.
    Sphere(u32),
    Surface(u32),
    /// The forces of its lasting contacts have to be found anew.
    Cluster,
    /// Nothing: its flight begins anew from where it is.
    Restart,
}

impl Event {
    pub const NEVER: Self = Self { time: f64::INFINITY, target: Target::Restart, flights: 0 };
}

impl Timeline {
    /// Starts a flight of every sphere from its state at `time` \[s\].
    pub fn new(system: &System, motion: &Motion, time: f64) -> Self {
        let mut timeline = Self { frame: [time; 2], ..Self::default() };
        timeline.take_in(system, motion, |_| Err(time));
        timeline.arrange(system, time);
        timeline
    }

    /// Takes in, at `time` \[s\], the spheres that came since `before`, when these were the `ids`, and
    /// leaves out those that went; the others fly on. Spheres that came begin their flights at
    /// `time_of` them \[s\]. Lasting contacts are found anew.
    pub fn adopt(
        before: &Self,
        ids: &[SphereId],
        (system, motion): (&System, &Motion),
        time: f64,
        time_of: impl Fn(SphereId) -> f64,
    ) -> Self {
        let mut timeline = Self { frame: before.frame, ..Self::default() };
        timeline.take_in(system, motion, |id| match ids.binary_search(&id) {
            Ok(index) => Ok(before.free_flight_of(index, time)),
            Err(_) => Err(time_of(id)),
        });
        if timeline.holds_forces {
            hold::renew(&mut timeline, system, [time, before.frame[1]]);
        }
        timeline.arrange(system, time);
        timeline
    }

    /// Fills the arrays: with the flight of each sphere, or one that begins at a time \[s\].
    fn take_in(
        &mut self,
        system: &System,
        motion: &Motion,
        flight_of: impl Fn(SphereId) -> Result<Body, f64>,
    ) {
        let count = system.spheres.id.len();
        let kinds_of = self.find_kinds(system);
        self.bodies = (0..count)
            .map(|index| {
                let (position, velocity) = (motion.position[index], motion.velocity[index]);
                let begun = |time| Body { position, velocity, time, kind: 0, flights: 0 };
                let flight = flight_of(system.spheres.id[index]).unwrap_or_else(begun);
                Body { kind: kinds_of[index], ..flight }
            })
            .collect();
        self.index_of = (0..count as u32).collect();
        self.slot_of = self.index_of.clone();
        self.count_flights();
    }

    /// Counts the flights of each sphere from here on.
    fn count_flights(&mut self) {
        let Self { flights_before, bodies, slot_of, .. } = self;
        flights_before.clear();
        flights_before.extend(slot_of.iter().map(|&slot| bodies[slot as usize].flights));
    }

    /// How many flights of a sphere began in this frame.
    pub fn flights_in_frame(&self, slot: u32) -> u32 {
        let before = self.flights_before[self.index_of[slot as usize] as usize];
        self.bodies[slot as usize].flights.wrapping_sub(before)
    }

    /// Gathers the spheres into kinds; gives the kind of each.
    fn find_kinds(&mut self, system: &System) -> Vec<u32> {
        let spheres = system.spheres;
        let levels = cells::levels_of(&spheres.radius);
        let mut known = BTreeMap::new();
        let mut kinds_of = Vec::with_capacity(levels.len());
        for (index, &level) in levels.iter().enumerate() {
            let (radius, mass) = (spheres.radius[index], spheres.mass[index]);
            let restitution = spheres.restitution[index];
            let (force, is_all) = forces::total_linear(system.forces, radius, mass);
            self.holds_forces |= !is_all;
            // Spheres under forces of their own are each of its own kind.
            let own = if is_all { 0 } else { index + 1 };
            let key = ([radius, mass, restitution].map(f64::to_bits), own);
            let next = self.kinds.len() as u32;
            let number = *known.entry(key).or_insert(next);
            if number == next {
                let (acceleration, drag_rate) = (force.acceleration, force.drag_rate);
                self.kinds.push(Kind {
                    radius,
                    mass,
                    restitution,
                    acceleration,
                    drag_rate,
                    level,
                    cluster: None,
                    free: number,
                });
            }
            kinds_of.push(number);
        }
        kinds_of
    }

    /// Puts the spheres in the order of their places and predicts everything anew, as of `time`
    /// \[s\].
    pub fn arrange(&mut self, system: &System, time: f64) {
        self.moving_surfaces = (0u32..)
            .zip(system.surfaces)
            .filter(|(_, surface)| surface.role == Role::Deflects && !surface.motion.is_at_rest())
            .map(|(number, _)| number)
            .collect();
        self.fill_cells(system, time);
        let order = self.cells.curve_order();
        if order.windows(2).any(|pair| pair[0] > pair[1]) {
            let mut new_slots = vec![0; order.len()];
            for (new, &old) in (0u32..).zip(&order) {
                new_slots[old as usize] = new;
            }
            self.bodies = order.iter().map(|&slot| self.bodies[slot as usize]).collect();
            self.index_of = order.iter().map(|&slot| self.index_of[slot as usize]).collect();
            for (slot, &index) in (0u32..).zip(&self.index_of) {
                self.slot_of[index as usize] = slot;
            }
            self.clusters.renumber(|slot| new_slots[slot as usize]);
            self.fill_cells(system, time);
        }
        self.predict_all(system, time);
    }

    fn fill_cells(&mut self, system: &System, time: f64) {
        self.cells = Cells::new(Contents {
            bodies: &self.bodies,
            kinds: &self.kinds,
            time,
            period: system.settings.boundary.period(),
            surfaces: system.surfaces,
            tree: system.tree,
            spheres_collide: system.settings.spheres_collide,
        });
    }

    /// Predicts the next event of every sphere, as of `time` \[s\].
    pub fn predict_all(&mut self, system: &System, time: f64) {
        self.events_since_arranged = 0;
        self.queue = EventQueue::new(self.bodies.len());
        self.events.clear();
        self.events.resize(self.bodies.len(), Event::NEVER);
        self.crossings.clear();
        self.crossings.resize(self.bodies.len(), Crossing::NEVER);
        for slot in 0..self.bodies.len() as u32 {
            predict::predict(self, system, slot, time);
        }
    }

    /// Puts the spheres in order again if enough has happened since.
    pub fn arrange_if_due(&mut self, system: &System, time: f64) {
        let is_live = |entry: &Entry| is_live(&self.events, &self.crossings, entry);
        self.queue.tidy(is_live);
        if self.events_since_arranged > EVENTS_PER_ARRANGEMENT * self.bodies.len() as u64 {
            self.arrange(system, time);
        }
    }

    /// Prepares for a frame from and to these times \[s\].
    ///
    /// # Errors
    /// A sphere on which a force is not finite.
    pub fn begin_frame(&mut self, system: &System, frame: [f64; 2]) -> Result<(), SphereId> {
        self.frame = frame;
        if self.holds_forces {
            hold::renew(self, system, frame);
            let is_lost = |body: &Body| !self.kinds[body.kind as usize].acceleration.is_finite();
            if let Some(slot) = self.bodies.iter().position(is_lost) {
                return Err(system.spheres.id[self.index_of[slot] as usize]);
            }
        }
        if self.holds_forces || !self.moving_surfaces.is_empty() {
            self.predict_all(system, frame[0]);
        }
        self.arrange_if_due(system, frame[0]);
        self.count_flights();
        Ok(())
    }

    /// Notes what a sphere meets next.
    pub(super) fn reschedule(&mut self, slot: u32, event: Event) {
        self.schedule(slot, event, self.crossings[slot as usize]);
    }

    /// Notes what a sphere meets next, and when it leaves its cell.
    #[inline]
    pub(super) fn schedule(&mut self, slot: u32, event: Event, crossing: Crossing) {
        self.events[slot as usize] = event;
        self.crossings[slot as usize] = crossing;
        let index = self.index_of[slot as usize];
        self.queue.push(Entry { time: event.time.min(crossing.time), slot, index });
    }

    /// What happens next, not later than `end` \[s\], and to which sphere.
    pub(super) fn next(&mut self, end: f64) -> Option<(u32, Next)> {
        let Self { events, crossings, .. } = self;
        let entry = self.queue.pop(end, |entry| is_live(events, crossings, entry))?;
        self.events_since_arranged += 1;
        let (event, crossing) = (&events[entry.slot as usize], &crossings[entry.slot as usize]);
        let next = if crossing.time < event.time {
            Next::Crossing(*crossing)
        } else {
            Next::Event(*event)
        };
        Some((entry.slot, next))
    }

    pub(super) fn kind_of(&self, slot: u32) -> &Kind {
        &self.kinds[self.bodies[slot as usize].kind as usize]
    }

    /// What the sphere is without contact forces.
    pub(super) fn free_kind_of(&self, slot: u32) -> &Kind {
        &self.kinds[self.kind_of(slot).free as usize]
    }

    /// Changes the acceleration \[m/s²\] of a sphere that is of a kind of its own.
    pub fn set_acceleration(&mut self, slot: u32, acceleration: DVec3) {
        let kind = self.bodies[slot as usize].kind;
        self.kinds[kind as usize].acceleration = acceleration;
    }

    /// Takes away the contact forces on a sphere, and its cluster.
    pub fn set_free(&mut self, slot: u32) {
        let kind = *self.kind_of(slot);
        if let Some(cluster) = kind.cluster {
            self.clusters.remove(cluster);
            self.spare_kinds.push(self.bodies[slot as usize].kind);
            self.bodies[slot as usize].kind = kind.free;
        }
    }

    /// Makes spheres that are free a cluster.
    pub(super) fn set_supported(&mut self, support: Support) {
        let Support { members, contacts, renewal } = support;
        let slots = members.iter().map(|member| member.0).collect();
        let cluster = self.clusters.add(Cluster { members: slots, contacts, renewal });
        for (slot, acceleration) in members {
            let kind = Kind { acceleration, cluster: Some(cluster), ..*self.kind_of(slot) };
            let number = match self.spare_kinds.pop() {
                Some(number) => {
                    self.kinds[number as usize] = kind;
                    number
                }
                None => {
                    self.kinds.push(kind);
                    self.kinds.len() as u32 - 1
                }
            };
            self.bodies[slot as usize].kind = number;
        }
    }

    /// Surfaces that a sphere may meet before it leaves its cell, with the shift \[m\] that brings
    /// them to where its position counts.
    pub fn surfaces_near(&self, slot: u32) -> impl Iterator<Item = (u32, DVec3)> {
        let level = self.kind_of(slot).level;
        let shift = self.cells.way_round(slot, level);
        let moving = self.moving_surfaces.iter().map(move |&surface| (surface, shift));
        self.cells.surfaces_near(slot, level).chain(moving)
    }

    /// Centre \[m\] and velocity \[m/s\] of a sphere at `time` \[s\].
    pub fn state_of(&self, slot: u32, time: f64) -> (DVec3, DVec3) {
        let body = &self.bodies[slot as usize];
        body.state_at(&self.kinds[body.kind as usize], time)
    }

    /// Begins another flight of a sphere from this state at `time` \[s\].
    pub fn begin_flight(&mut self, slot: u32, position: DVec3, velocity: DVec3, time: f64) {
        let level = self.kind_of(slot).level;
        let position = self.cells.fold(slot, level, position);
        self.bodies[slot as usize].begin_flight(position, velocity, time);
    }

    /// The flight of the sphere at an index of the world's arrays. One that lasting contacts bear
    /// begins another flight at `time` \[s\], free of them.
    fn free_flight_of(&self, index: usize, time: f64) -> Body {
        let slot = self.slot_of[index];
        let mut body = self.bodies[slot as usize];
        if self.kind_of(slot).cluster.is_some() {
            let (position, velocity) = self.state_of(slot, time);
            body.begin_flight(position, velocity, time);
        }
        body
    }

    /// Writes the states of all spheres at `time` \[s\].
    pub fn write_motion(&self, motion: &mut Motion, period: DVec3, time: f64) {
        for (body, &index) in self.bodies.iter().zip(&self.index_of) {
            let (position, velocity) = body.state_at(&self.kinds[body.kind as usize], time);
            motion.position[index as usize] = cells::folded(position, period);
            motion.velocity[index as usize] = velocity;
        }
    }
}

/// Whether an entry of the queue still tells what happens next to its sphere.
fn is_live(events: &[Event], crossings: &[Crossing], entry: &Entry) -> bool {
    let slot = entry.slot as usize;
    events[slot].time.min(crossings[slot].time) == entry.time
}
