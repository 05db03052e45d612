//! The timeline: where every sphere flies, and what happens next.

use std::array;
use std::collections::BTreeMap;
use std::ops::Range;

use fearless_simd::{Level, Simd, dispatch};
use glam::DVec3;
use prefetch_index::prefetch_index;

use super::body::{Body, Kind};
use super::cluster::{Cluster, Clusters};
use super::contact_duration::ContactScale;
use super::flights::Flights;
use super::neighbours::{self, Contents, Neighbours};
use super::outlook::{Ahead, Event, Next, Outlook, Target};
use super::periodic;
use super::queue::{Entry, EventQueue};
use super::room::Room;
use super::support::Support;
use super::surroundings::Surroundings;
use super::vicinity::Vicinity;
use super::{hold, predict};
use crate::bodies::{Motion, SphereId};
use crate::detect::contact::Bodies;
use crate::forces;
use crate::lanes::{LANES, Lanes};
use crate::parallel;
use crate::real::Vector;
use crate::surface::Role;
use crate::system::System;

/// In a periodic box, spheres are put in order of place again after this many departures per sphere:
/// seldom enough to cost little, often enough that neighbours stay near each other in memory.
const DEPARTURES_PER_ARRANGEMENT: u64 = 10;
/// Departures per sphere before that, where all stay in the fast caches in whatever order they are.
const DEPARTURES_OF_FEW: u64 = 100;
/// On open axes the spheres are arranged after this many events per sphere: they may have gathered in
/// outermost cells, which none of them leaves.
const EVENTS_PER_ARRANGEMENT: u64 = 24;

/// More spheres than this do not stay in the fast caches.
const MANY: usize = 20_000;
/// Where all are read one after another, so many are fetched into the cache ahead.
const FETCHED_AHEAD: usize = 32;

/// All that the rule keeps between frames.
///
/// Only the flights and the clusters are state. Neighbours, queue and events follow from them: they
/// decide how fast the next event is found, never what it is.
#[derive(Debug, Clone, Default)]
pub(crate) struct Timeline {
    /// By slot: in the order of places, so that neighbours share memory.
    pub(super) bodies: Vec<Body>,
    /// What lies ahead of each sphere, by slot.
    pub(super) outlooks: Vec<Outlook>,
    pub(super) kinds: Vec<Kind>,
    /// Kinds without spheres.
    spare_kinds: Vec<u32>,
    /// Number of each sphere's flight at the start of the frame, by slot.
    flights_before: Vec<u32>,
    /// Work of the groups of each sphere in the frame, by slot, in flights; empty where there was none.
    group_work: Vec<u64>,
    /// Place of each slot in the arrays of the world, and back.
    pub(super) index_of: Vec<u32>,
    pub(super) slot_of: Vec<u32>,
    pub(super) neighbours: Neighbours,
    pub(super) queue: EventQueue,
    pub(super) clusters: Clusters,
    /// Surfaces that move: near every sphere.
    pub(super) moving_surfaces: Vec<u32>,
    /// When surfaces are where the system says, and until when that tells how they turn, on the
    /// world's clock \[s\]: the frame.
    pub(super) frame: [f64; 2],
    /// Whether spheres are under forces that are held constant over a frame.
    holds_forces: bool,
    /// By slot, where flights begin anew in each frame, near surfaces none of which moves; else empty.
    rooms: Vec<Room>,
    /// Since the spheres were put in order of place.
    events: u64,
    departures: u64,
}

impl Timeline {
    /// Starts a flight of every sphere from its state at `time` \[s\].
    pub fn new(system: &System, motion: &Motion, time: f64) -> Self {
        let mut timeline = Self { frame: [time; 2], ..Self::default() };
        timeline.take_in(system, motion, |_| Err(time));
        timeline.arrange(system, time);
        timeline.predict_all(system, time);
        timeline
    }

    /// Takes in, at `time` \[s\], the spheres that came since `before`, when these were the `ids`, and
    /// leaves out those that went; the others fly on. Spheres that came begin their flights at
    /// `time_of` them \[s\]. Lasting contacts are found anew. The next ones come at `next` \[s\].
    pub fn adopt(
        before: &Self,
        ids: &[SphereId],
        (system, motion): (&System, &Motion),
        [time, next]: [f64; 2],
        time_of: impl Fn(SphereId) -> f64,
    ) -> Self {
        let mut timeline = Self { frame: before.frame, ..Self::default() };
        timeline.take_in(system, motion, |id| match ids.binary_search(&id) {
            Ok(index) => Ok(before.free_flight_of(index, time)),
            Err(_) => Err(time_of(id)),
        });
        timeline.arrange(system, time);
        if timeline.holds_forces {
            hold::renew(&mut timeline, system, [time, next.min(before.frame[1])]);
        }
        timeline.predict_all(system, time);
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
    }

    /// Counts the flights of each sphere from here on.
    fn count_flights(&mut self) {
        self.group_work.clear();
        self.flights_before.clear();
        self.flights_before.extend(self.bodies.iter().map(|body| body.flights));
    }

    /// How many flights of a sphere began in this frame, and what its groups took besides.
    #[inline]
    pub fn work_in_frame(&self, slot: u32) -> u64 {
        let before = self.flights_before[slot as usize];
        // Each adds two, or one if an impact began the flight before it.
        let flights = self.bodies[slot as usize].flights.wrapping_sub(before).div_ceil(2);
        let of_groups = self.group_work.get(slot as usize).copied().unwrap_or(0);
        u64::from(flights) + of_groups
    }

    /// Counts the work of a group for each of its spheres.
    pub fn charge(&mut self, slots: impl Iterator<Item = u32>, work: u64) {
        if self.group_work.is_empty() {
            self.group_work.resize(self.bodies.len(), 0);
        }
        slots.for_each(|slot| self.group_work[slot as usize] += work);
    }

    /// How many other spheres are in persistent contact with a sphere, directly or through others.
    pub fn companions(&self, slot: u32) -> usize {
        let cluster = self.kind_of(slot).cluster;
        cluster.map_or(0, |number| self.clusters.get(number).members.len() - 1)
    }

    /// Gathers the spheres into kinds; gives the kind of each.
    fn find_kinds(&mut self, system: &System) -> Vec<u32> {
        let spheres = system.spheres;
        let levels = neighbours::levels_of(&spheres.radius);
        let has_own_forces = !spheres.applied_force.is_empty();
        self.holds_forces = has_own_forces;
        let mut known = BTreeMap::new();
        let mut kinds_of = Vec::with_capacity(levels.len());
        for (index, &level) in levels.iter().enumerate() {
            let (radius, mass) = (spheres.radius[index], spheres.mass[index]);
            let restitution = spheres.restitution[index];
            let (force, is_all) = forces::total_linear(system.forces, radius, mass);
            self.holds_forces |= !is_all;
            // Spheres under forces of their own are each of its own kind.
            let own = if is_all && !has_own_forces { 0 } else { index + 1 };
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

    /// Puts the spheres in the order of their places, and finds who is near whom, as of `time`
    /// \[s\]. What was predicted is void.
    fn arrange(&mut self, system: &System, time: f64) {
        self.moving_surfaces = (0u32..)
            .zip(system.surfaces)
            .filter(|(_, surface)| surface.role == Role::Deflects && !surface.motion.is_at_rest())
            .map(|(number, _)| number)
            .collect();
        // What is made anew must not be in memory twice.
        self.outlooks = Vec::new();
        self.queue = EventQueue::default();
        self.neighbours = Neighbours::default();
        let order = self.contents(system, time).curve_order();
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
        }
        self.neighbours = Neighbours::new(self.contents(system, time));
        self.rooms.clear();
        if self.holds_forces && self.moving_surfaces.is_empty() && !system.surfaces.is_empty() {
            self.rooms.resize(self.bodies.len(), Room::NONE);
        }
        (self.events, self.departures) = (0, 0);
        self.count_flights();
    }

    fn contents<'a>(&'a self, system: &System<'a>, time: f64) -> Contents<'a> {
        Contents {
            bodies: &self.bodies,
            kinds: &self.kinds,
            time,
            period: system.settings.boundary.period(),
            surfaces: system.surfaces,
            tree: system.tree,
            spheres_collide: system.settings.spheres_collide,
        }
    }

    /// Predicts the next event of every sphere, as of `time` \[s\].
    fn predict_all(&mut self, system: &System, time: f64) {
        self.queue = EventQueue::new(self.bodies.len());
        self.outlooks = parallel::map(self.bodies.len(), |around: &mut Surroundings, slot| {
            predict::outlook(self, system, slot as u32, around, time)
        });
        let horizon = self.horizon();
        for (slot, (outlook, &index)) in (0..).zip(self.outlooks.iter().zip(&self.index_of)) {
            if outlook.time() <= horizon {
                self.queue.push(Entry { time: outlook.time(), slot, index });
            }
        }
    }

    /// Prepares for a frame from and to these times \[s\]. The next
    /// spheres are emitted at `next` \[s\].
    ///
    /// # Errors
    /// A sphere on which a force is not finite.
    pub fn begin_frame(
        &mut self,
        system: &System,
        frame: [f64; 2],
        next: f64,
    ) -> Result<(), SphereId> {
        self.frame = frame;
        if self.holds_forces {
            // What is due already comes at the start of the frame, when this is done again.
            hold::renew(self, system, [frame[0], next.clamp(frame[0], frame[1])]);
            let is_lost = |body: &Body| !self.kinds[body.kind as usize].acceleration.is_finite();
            if let Some(slot) = self.bodies.iter().position(is_lost) {
                return Err(system.spheres.id[self.index_of[slot] as usize]);
            }
        }
        let is_due = self.is_arrangement_due(system.settings.boundary.period());
        if is_due {
            self.arrange(system, frame[0]);
        }
        if is_due || self.holds_forces || !self.moving_surfaces.is_empty() {
            self.predict_all(system, frame[0]);
        } else {
            self.queue.tidy(|entry| is_live(&self.outlooks, entry));
        }
        self.count_flights();
        Ok(())
    }

    /// Notes what a sphere meets next.
    pub(super) fn reschedule(&mut self, slot: u32, ahead: Ahead) {
        let departure = self.outlooks[slot as usize].departure;
        self.schedule(slot, Outlook { ahead, departure });
    }

    /// Notes what lies ahead of a sphere.
    #[inline]
    pub(super) fn schedule(&mut self, slot: u32, outlook: Outlook) {
        self.outlooks[slot as usize] = outlook;
        let index = self.index_of[slot as usize];
        self.queue.push(Entry { time: outlook.time(), slot, index });
    }

    /// The meeting with another sphere at this time \[s\], as far as is known now.
    #[inline(always)]
    pub(super) fn meeting(&self, time: f64, other: u32) -> Event {
        let flights = self.bodies[other as usize].flights;
        Event { time, target: Target::sphere(other), flights }
    }

    /// Whether a meeting with another sphere will not be, for that one began another flight.
    #[inline]
    pub(super) fn is_void(&self, event: &Event) -> bool {
        let other = event.target.slot();
        other.is_some_and(|other| self.bodies[other as usize].flights != event.flights)
    }

    /// What happens next, not later than `end` \[s\], and to which sphere.
    pub(super) fn next(&mut self, system: &System, end: f64) -> Option<(u32, Next)> {
        let entry = self.queue.pop(end, |entry| is_live(&self.outlooks, entry))?;
        self.anticipate(system);
        self.events += 1;
        let next = self.outlooks[entry.slot as usize].next();
        self.departures += u64::from(matches!(next, Next::Departure(_)));
        Some((entry.slot, next))
    }

    /// Whether the order of the spheres is out of date, in a box with these edges \[m\].
    fn is_arrangement_due(&self, period: DVec3) -> bool {
        let (done, per_sphere) = match (period.is_finite(), self.are_many()) {
            (true, true) => (self.departures, DEPARTURES_PER_ARRANGEMENT),
            (true, false) => (self.departures, DEPARTURES_OF_FEW),
            (false, _) => (self.events, EVENTS_PER_ARRANGEMENT),
        };
        done > per_sphere * self.bodies.len() as u64
    }

    /// Whether there are more spheres than the fast caches hold.
    #[inline(always)]
    pub fn are_many(&self) -> bool {
        self.bodies.len() > MANY
    }

    /// Has what the next events will need fetched into the cache, so that it is there by then.
    #[inline]
    fn anticipate(&self, system: &System) {
        if !self.are_many() {
            return;
        }
        let Self { outlooks, bodies, neighbours, queue, index_of, flights_before, .. } = self;
        // What is fetched in one step is found from what was fetched in the steps before.
        let at_work = |place: usize| {
            let slot = queue.upcoming(place);
            let next = slot.map(|slot| outlooks[slot as usize].next());
            let leaves = matches!(next, Some(Next::Departure(_)));
            let other = match next {
                Some(Next::Event(event)) => event.target.slot(),
                _ => None,
            };
            slot.into_iter().chain(other).map(move |slot| (slot, leaves))
        };
        if let Some(slot) = queue.upcoming(10) {
            prefetch_index(outlooks, slot as usize);
        }
        for (slot, _) in at_work(8) {
            let place = slot as usize;
            prefetch_index(bodies, place);
            prefetch_index(outlooks, place);
            prefetch_index(index_of, place);
            prefetch_index(flights_before, place);
            neighbours.prefetch_place(slot);
        }
        for (slot, leaves) in at_work(5) {
            prefetch_index(&system.spheres.id, index_of[slot as usize] as usize);
            neighbours.prefetch_cells(slot, leaves);
        }
        for (slot, leaves) in at_work(2) {
            neighbours.prefetch_near(slot, leaves, bodies);
        }
    }

    /// The kind of all spheres, if there is one, and they see each other move in straight lines.
    #[inline(always)]
    pub(super) fn only_kind(&self) -> Option<&Kind> {
        match &self.kinds[..] {
            [kind] if kind.drag_rate == 0.0 => Some(kind),
            _ => None,
        }
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

    /// Sets the acceleration of a sphere without the forces of its persistent contacts \[m/s²\].
    pub fn set_free_acceleration(&mut self, slot: u32, acceleration: DVec3) {
        let free = self.kind_of(slot).free;
        self.kinds[free as usize].acceleration = acceleration;
    }

    /// Takes away the contact forces on a sphere, and its cluster.
    pub fn set_free(&mut self, slot: u32) {
        let kind = *self.kind_of(slot);
        if let Some(cluster) = kind.cluster {
            self.leave_room(slot);
            self.clusters.remove(cluster);
            self.spare_kinds.push(self.bodies[slot as usize].kind);
            self.bodies[slot as usize].kind = kind.free;
        }
    }

    /// Whether two bodies are in lasting contact up to now.
    #[inline]
    pub fn has_lasted(&self, bodies: Bodies) -> bool {
        let (Bodies::Pair(sphere, _) | Bodies::Surface { sphere, .. }) = bodies;
        let cluster = self.kind_of(self.slot_of[sphere as usize]).cluster;
        cluster.is_some_and(|cluster| self.clusters.get(cluster).has(bodies))
    }

    /// Whether a surface is one of those that hold a sphere in lasting contact.
    #[inline]
    pub fn is_held_by(&self, slot: u32, surface: u32) -> bool {
        self.has_lasted(Bodies::Surface { sphere: self.index_of[slot as usize], surface })
    }

    /// Whether a sphere is certain to meet no surface in this frame, but those that hold it.
    #[inline]
    pub fn has_room(&self, slot: u32) -> bool {
        self.rooms.get(slot as usize).is_some_and(|room| {
            let body = &self.bodies[slot as usize];
            room.holds(&body.flight(self.kind_of(slot)), self.frame[1] - body.time)
        })
    }

    /// Finds out how much room a sphere has, if it leaves what it had.
    pub fn find_room(&mut self, system: &System, slot: u32) {
        if !self.rooms.is_empty() && !self.has_room(slot) {
            self.rooms[slot as usize] = Room::about(self, system, slot);
        }
    }

    /// Notes that a sphere may meet surfaces that it could not meet before.
    pub fn leave_room(&mut self, slot: u32) {
        if let Some(room) = self.rooms.get_mut(slot as usize) {
            *room = Room::NONE;
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

    /// Surfaces that a sphere may meet in its neighbourhood, with the shift \[m\] that brings them to
    /// where its position counts.
    pub fn surfaces_near(&self, slot: u32) -> impl Iterator<Item = (u32, DVec3)> {
        let level = self.kind_of(slot).level;
        let shift = self.neighbours.way_round(slot);
        let moving = self.moving_surfaces.iter().map(move |&surface| (surface, shift));
        self.neighbours.surfaces_near(slot, level).chain(moving)
    }

    /// Centre \[m\] and velocity \[m/s\] of a sphere at `time` \[s\].
    #[inline(always)]
    pub fn state_of(&self, slot: u32, time: f64) -> (DVec3, DVec3) {
        let body = &self.bodies[slot as usize];
        body.state_at(&self.kinds[body.kind as usize], time)
    }

    /// What rounding can resolve of a contact of spheres at `time` \[s\].
    pub(super) fn contact_scale(&self, slots: &[u32], time: f64) -> ContactScale {
        slots.iter().fold(ContactScale::default(), |scale, &slot| {
            let (position, velocity) = self.state_of(slot, time);
            scale.with(position, velocity, self.free_kind_of(slot))
        })
    }

    /// Begins another flight of a sphere from this state at `time` \[s\].
    pub fn begin_flight(&mut self, slot: u32, position: DVec3, velocity: DVec3, time: f64) {
        self.bodies[slot as usize].begin_flight(position, velocity, time);
        self.fold(slot);
    }

    /// Whether all flights begin anew at the start of each frame, for forces that are held over it.
    pub fn is_renewed_each_frame(&self) -> bool {
        self.holds_forces
    }

    /// Until when predictions are of use, on the world's clock \[s\]: until all flights begin anew.
    #[inline]
    pub fn horizon(&self) -> f64 {
        if self.holds_forces { self.frame[1] } else { f64::INFINITY }
    }

    /// Until when a sphere of this kind stays on its flight at most, on the world's clock \[s\]: until
    /// the forces of its persistent contacts are found anew, or all flights begin anew.
    #[inline]
    pub(super) fn flight_end(&self, kind: &Kind) -> f64 {
        let renewal = kind.cluster.map(|number| self.clusters.get(number).renewal);
        renewal.map_or(self.horizon(), |renewal| renewal.min(self.horizon()))
    }

    /// Puts the sphere at an index of the world's arrays elsewhere at `time` \[s\]. What was predicted
    /// is not predicted anew.
    pub fn place(&mut self, index: usize, position: DVec3, velocity: DVec3, time: f64) {
        let slot = self.slot_of[index];
        self.set_free(slot);
        self.bodies[slot as usize].begin_flight(position, velocity, time);
        self.relocate(slot, [position, velocity], &mut Vicinity::default());
        self.fold(slot);
    }

    /// Gives a sphere that is at a place \[m\] with a velocity \[m/s\] another neighbourhood, and finds
    /// those near it there.
    pub(super) fn relocate(&mut self, slot: u32, state: [DVec3; 2], near: &mut Vicinity) {
        let level = self.kind_of(slot).level;
        self.neighbours.relocate(slot, level, state, near);
        self.leave_room(slot);
    }

    /// Begins the flights that are at `now` \[s\] anew at another time \[s\]. What was predicted is not
    /// predicted anew.
    pub fn set_time(&mut self, now: f64, time: f64) {
        for slot in 0..self.bodies.len() as u32 {
            let (position, velocity) = self.state_of(slot, now);
            self.begin_flight(slot, position, velocity, time);
        }
    }

    /// Folds the place where a flight begins into the periodic box; whether it was elsewhere.
    #[inline(always)]
    pub fn fold(&mut self, slot: u32) -> bool {
        let is_elsewhere = !self.neighbours.is_in_box(self.bodies[slot as usize].position);
        is_elsewhere && self.fold_into_box(slot)
    }

    /// Folds the place where a flight begins into the periodic box, where it may be outside.
    #[inline(never)]
    fn fold_into_box(&mut self, slot: u32) -> bool {
        let body = &mut self.bodies[slot as usize];
        let level = self.kinds[body.kind as usize].level;
        let folded = self.neighbours.fold(slot, level, body.position);
        body.position = folded.unwrap_or(body.position);
        folded.is_some()
    }

    /// The flight of the sphere at an index of the world's arrays. Where forces of lasting contacts or
    /// forces held constant act on it, another flight begins at `time` \[s\], free of them.
    fn free_flight_of(&self, index: usize, time: f64) -> Body {
        let slot = self.slot_of[index];
        let mut body = self.bodies[slot as usize];
        if self.holds_forces || self.kind_of(slot).cluster.is_some() {
            let (position, velocity) = self.state_of(slot, time);
            body.begin_flight(position, velocity, time);
        }
        body
    }

    /// The first sphere, by index, that is not anywhere at `time` \[s\], and which of its quantities is
    /// not finite.
    pub fn lost(&self, time: f64) -> Option<(usize, &'static str)> {
        // As a rule no sphere can be that far, whatever drag does, and no path need be followed.
        let pull = self.kinds.iter().map(|kind| kind.acceleration.abs().element_sum()).sum();
        if dispatch!(Level::new(), simd => self.farthest(simd, time, pull)).is_finite() {
            return None;
        }
        self.slot_of.iter().enumerate().find_map(|(index, &slot)| {
            let (position, velocity) = self.state_of(slot, time);
            let quantities = [("velocity", velocity), ("position", position)];
            let lost = quantities.into_iter().find(|(_, value)| !value.is_finite());
            lost.map(|(quantity, _)| (index, quantity))
        })
    }

    /// More than how far anybody is from the origin \[m\] and how fast \[m/s\] at `time` \[s\], where
    /// no acceleration is larger than `pull` \[m/s²\].
    #[inline(always)]
    fn farthest<S: Simd>(&self, simd: S, time: f64, pull: f64) -> f64 {
        let [time, pull, one] = [time, pull, 1.0].map(|number| Lanes::all(simd, number));
        let (in_fours, rest) = self.bodies.as_chunks();
        let rest =
            rest.first().map(|&body| array::from_fn(|place| *rest.get(place).unwrap_or(&body)));
        let mut sum = Lanes::all(simd, 0.0);
        for bodies in in_fours.iter().chain(&rest) {
            let Flights { position, velocity, time: start } =
                Flights::of_each(simd, bodies.each_ref());
            let age = (time - start).abs();
            sum = sum + position.size() + (one + age) * (velocity.size() + age * pull);
        }
        sum.to_array().iter().sum()
    }

    /// Writes the states of all spheres at `time` \[s\].
    pub fn write_motion(&self, motion: &mut Motion, period: DVec3, time: f64) {
        parallel::fill((&mut motion.position, &mut motion.velocity), |first, run| {
            dispatch!(Level::new(), simd => self.write_states(simd, first, run, period, time));
        });
    }

    /// Writes centres \[m\] and velocities \[m/s\] of spheres at `time` \[s\], from the one with
    /// the index `first` on: side by side, where all are of one kind, else one by one.
    #[inline(always)]
    fn write_states<S: Simd>(
        &self,
        simd: S,
        first: usize,
        (positions, velocities): (&mut [DVec3], &mut [DVec3]),
        period: DVec3,
        time: f64,
    ) {
        let slots = &self.slot_of[first..];
        let fetch = |places: Range<usize>| {
            let slots = slots.get(places).unwrap_or_default();
            slots.iter().for_each(|&slot| prefetch_index(&self.bodies, slot as usize));
        };
        let mut done = 0;
        if let Some(kind) = self.only_kind() {
            let acceleration = Vector::all(simd, kind.acceleration);
            let states = positions.as_chunks_mut().0.iter_mut().zip(velocities.as_chunks_mut().0);
            for ((positions, velocities), slots) in states.zip(slots.as_chunks::<LANES>().0) {
                fetch(done + FETCHED_AHEAD..done + FETCHED_AHEAD + LANES);
                let flights = Flights::of_each(simd, slots.map(|slot| &self.bodies[slot as usize]));
                [*positions, *velocities] = flights.states_at(simd, acceleration, period, time);
                done += LANES;
            }
        }
        for place in done..positions.len() {
            fetch(place + FETCHED_AHEAD..place + FETCHED_AHEAD + 1);
            let (position, velocity) = self.state_of(slots[place], time);
            positions[place] = periodic::folded(position, period);
            velocities[place] = velocity;
        }
    }
}

/// Whether an entry of the queue still tells what happens next to its sphere.
fn is_live(outlooks: &[Outlook], entry: &Entry) -> bool {
    outlooks[entry.slot as usize].time() == entry.time
}
