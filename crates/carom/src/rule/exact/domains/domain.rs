//! A domain: a copy of the timeline, and the events that one thread takes of it.

use std::mem::take;

use super::change::{Change, Stamp};
use super::record::Records;
use super::territory::{Phase, Territory};
use crate::norm::Norm;
use crate::report::StageCounts;
use crate::rule::exact::answer;
use crate::rule::exact::context::StepContext;
use crate::rule::exact::events::UpcomingEvent;
use crate::rule::exact::neighbours::NeighbourBuffer;
use crate::rule::exact::pair_times::PairSearch;
use crate::rule::exact::span::Span;
use crate::rule::exact::timeline::Timeline;
use crate::rule::exact::zones::frame_work::UNITS_PER_FLIGHT;
use crate::system::System;
use crate::work::Work;

/// What rounding adds to a bound of speeds, and more.
const ROUNDING: f64 = 1.0 + 1e-6;

/// A phase of a window: the events up to some time in some cells.
#[derive(Debug, Clone, Copy)]
pub(super) struct Window {
    pub phase: Phase,
    /// The number of the phase in the segment, from 1 on.
    pub number: u32,
    /// Events up to this time were taken in earlier phases, but for those that were deferred \[s\].
    pub from: f64,
    /// End of the window on the world's clock \[s\].
    pub until: f64,
}

/// A sign that events must be taken in one order: one depends on another that was taken before it, or on more than
/// the flights of the spheres around it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Conflict;

/// A domain. Spheres that it does not know are somewhere in its timeline, but not where they are now.
#[derive(Debug)]
pub(super) struct Domain {
    pub timeline: Timeline,
    territory: Territory,
    /// The last event of each sphere in the segment, by slot.
    pub stamps: Vec<Stamp>,
    /// Slots of spheres that changed in the phase and that other domains know.
    shared: Vec<u32>,
    /// Slots of spheres whose events were deferred in the phase.
    deferred: Vec<u32>,
    /// Number of these in the slab of the domain.
    pub pending: usize,
    pub records: Records,
    pub counts: StageCounts,
    /// Units of [`Work`] done in the segment.
    pub units: u64,
    pub outcome: Result<(), Conflict>,
    /// Working memory: the neighbours of a sphere.
    near: NeighbourBuffer,
}

impl Domain {
    /// A domain with this territory and a timeline to be written over.
    pub fn new(territory: Territory, timeline: Timeline) -> Self {
        Self {
            timeline,
            territory,
            stamps: Vec::new(),
            shared: Vec::new(),
            deferred: Vec::new(),
            pending: 0,
            records: Records::default(),
            counts: StageCounts::default(),
            units: 0,
            outcome: Ok(()),
            near: NeighbourBuffer::default(),
        }
    }

    /// Copies a timeline.
    pub fn copy(&mut self, timeline: &Timeline) {
        self.timeline.clone_from(timeline);
        self.timeline.entered = Some(Vec::new());
    }

    /// Begins a segment of the frame of a timeline of which this is a copy.
    pub fn begin_segment(&mut self, timeline: &Timeline) {
        self.timeline.begin_segment_of(timeline);
        self.stamps.clear();
        self.stamps.resize(timeline.flights.bodies.len(), Stamp::NONE);
        self.territory.begin_segment();
        self.records.clear();
        (self.counts, self.units, self.pending) = Default::default();
    }

    /// Takes over what other domains changed; `own` is the number of this one.
    pub fn follow(&mut self, changes: &[Vec<Change>], own: usize) {
        for (_, changes) in changes.iter().enumerate().filter(|(number, _)| *number != own) {
            for change in changes {
                let before = self.timeline.neighbours.coarsest_cell(change.slot);
                let after = self.timeline.neighbours.coarsest_cell_of(&change.region);
                if self.territory.knows(before) || self.territory.knows(after) {
                    change.write_to(&mut self.timeline);
                    self.stamps[change.slot as usize] = change.stamp;
                }
            }
        }
        if let Some(entered) = &mut self.timeline.entered {
            entered.clear();
        }
    }

    /// Takes the events of a window. Returns what other domains must know.
    pub fn take_events(&mut self, system: &System, span: Span, window: Window) -> Vec<Change> {
        let work = Work::unlimited();
        let mut report = take(&mut self.records.report);
        let parameters = self.timeline.parameters.with_zone_tick(self.timeline.zone_tick());
        let mut context = StepContext::new(system, parameters, span, &work, &mut report);
        self.pending = 0;
        self.outcome = self.take_in_order(&mut context, window);
        let pair_tests = context.searches.iter().map(PairSearch::tests).sum();
        let units = work.done();
        self.counts += StageCounts { pair_tests, ..context.counts };
        self.counts.solver_iterations += units - UNITS_PER_FLIGHT * context.counts.events;
        self.units += units;
        self.records.report = report;
        self.put_deferred_back();
        self.shared_changes()
    }

    /// Takes the events of a window one after another, and defers those that may depend on other domains.
    fn take_in_order(&mut self, context: &mut StepContext, window: Window) -> Result<(), Conflict> {
        let Window { phase, number, from, until } = window;
        while let Some((slot, event)) = self.timeline.schedule.pop(until) {
            let cell = self.timeline.neighbours.coarsest_cell(slot);
            if !self.territory.knows(cell) {
                continue;
            }
            if !self.is_independent((slot, cell), event, window) {
                self.pending += usize::from(self.territory.owns(cell));
                self.defer(slot, event, window);
                continue;
            }
            let time = event.time();
            let may_be_late = phase == Phase::Borders || time <= from;
            let mut involved = [Some(slot), event.other_sphere()].into_iter().flatten();
            if may_be_late && involved.any(|it| self.is_late(it, time, number)) {
                return Err(Conflict);
            }
            self.take_event(context, slot, event)?;
            self.note_changes(context, (slot, cell), event, window)?;
        }
        Ok(())
    }

    /// Whether the domain takes an event of the sphere at `slot`, which is in this cell, and no event that was deferred
    /// may have changed what it reads.
    fn is_independent(
        &self,
        (slot, cell): (u32, [u16; 3]),
        event: UpcomingEvent,
        Window { phase, number, .. }: Window,
    ) -> bool {
        let Self { timeline, territory, .. } = self;
        if !territory.takes(cell, phase) {
            return false;
        }
        match (event, event.other_sphere()) {
            (UpcomingEvent::CellCrossing(time), _) => {
                territory.is_clear(cell, number)
                    && territory.is_clear(self.cell_at(slot, time), number)
            }
            (_, Some(other)) if other != slot => {
                let other = timeline.neighbours.coarsest_cell(other);
                territory.is_clear(cell, number) && territory.is_clear(other, number)
            }
            _ => territory.is_clear(cell, number),
        }
    }

    /// Defers an event of the sphere at `slot`, and notes what it may change until the end of the window: its spheres,
    /// those that they may hit then, and so on.
    fn defer(&mut self, slot: u32, event: UpcomingEvent, Window { number, until, .. }: Window) {
        self.deferred.push(slot);
        let time = event.time();
        if let UpcomingEvent::CellCrossing(time) = event {
            let next = self.cell_at(slot, time);
            self.territory.note_unknown(next, number);
        }
        let involved = [Some(slot), event.other_sphere()].into_iter().flatten();
        let speeds =
            involved.clone().map(|slot| self.timeline.flights.state_of(slot, time).1.norm());
        let speed = ROUNDING * speeds.sum::<f64>();
        let mut changed: Vec<(u32, f64)> = involved.map(|slot| (slot, speed)).collect();
        let mut next = 0;
        while let Some(&(slot, speed)) = changed.get(next) {
            next += 1;
            let cell = self.timeline.neighbours.coarsest_cell(slot);
            self.territory.note_unknown(cell, number);
            self.find_hit((slot, speed), [time, until], &mut changed);
        }
    }

    /// The cell in which the neighbour region of a sphere lies if it crosses into another at `time` \[s\].
    fn cell_at(&self, slot: u32, time: f64) -> [u16; 3] {
        let Timeline { flights, neighbours, .. } = &self.timeline;
        let level = flights.species_of(slot).level;
        let region = neighbours.region_at(slot, level, flights.state_of(slot, time).into());
        neighbours.coarsest_cell_of(&region)
    }

    /// Adds the spheres that the one at `slot` may hit between two times \[s\] at this speed \[m/s\], each with a bound of
    /// its speed then.
    fn find_hit(
        &mut self,
        (slot, speed): (u32, f64),
        [time, until]: [f64; 2],
        changed: &mut Vec<(u32, f64)>,
    ) {
        let Self { timeline, near, .. } = self;
        let Timeline { flights, neighbours, .. } = timeline;
        let species = flights.species_of(slot);
        neighbours.find(slot, species.level, near);
        let place = flights.state_of(slot, time).0;
        let duration = until - time;
        for other in near.others(slot) {
            if changed.iter().any(|&(slot, _)| slot == other.slot()) {
                continue;
            }
            let (other_place, velocity) = flights.state_of(other.slot(), time);
            let others = flights.species_of(other.slot());
            let offset = other_place + neighbours.shift_of(slot, other) - place;
            let gained = (species.acceleration.norm() + others.acceleration.norm()) * duration;
            let together = ROUNDING * (speed + velocity.norm() + gained);
            if offset.norm() <= species.radius + others.radius + together * duration {
                // An elastic impact turns the relative velocity round.
                let part = species.mass / (species.mass + others.mass);
                changed.push((other.slot(), velocity.norm() + gained + 2.0 * part * together));
            }
        }
    }

    /// Answers an event of the sphere at `slot`.
    fn take_event(
        &mut self,
        context: &mut StepContext,
        slot: u32,
        event: UpcomingEvent,
    ) -> Result<(), Conflict> {
        context.counts.events += 1;
        let is_crossing = matches!(event, UpcomingEvent::CellCrossing(_));
        context.counts.cell_crossings += u64::from(is_crossing);
        answer::event(&mut self.timeline, context, slot, event).map_err(|_| Conflict)?;
        let is_free = self.timeline.is_free() && context.unanswered.is_none();
        if is_free { Ok(()) } else { Err(Conflict) }
    }

    /// Notes what an event of the sphere at `slot`, which was in this cell, has changed.
    fn note_changes(
        &mut self,
        context: &StepContext,
        (slot, cell): (u32, [u16; 3]),
        event: UpcomingEvent,
        Window { phase, number, from, .. }: Window,
    ) -> Result<(), Conflict> {
        let stamp = Stamp { phase: number, time: event.time() };
        let may_be_late = phase == Phase::Borders || stamp.time <= from;
        let index = self.timeline.flights.index_of[slot as usize];
        self.records.note(index, stamp.time, context.report.groups.len());
        let was_shared = self.territory.shares(cell);
        let involved = [Some(slot), event.other_sphere()];
        let mut entered = self.timeline.entered.take().unwrap_or_default();
        for &changed in &entered {
            let now = self.timeline.neighbours.coarsest_cell(changed);
            // A group may reach beyond what its first sphere can meet.
            let is_known = involved.contains(&Some(changed))
                || self.territory.takes(now, phase) && self.territory.is_clear(now, number);
            if !is_known || may_be_late && self.is_late(changed, stamp.time, number) {
                return Err(Conflict);
            }
            self.stamps[changed as usize] = stamp;
            if was_shared || self.territory.shares(now) {
                self.shared.push(changed);
            }
        }
        entered.clear();
        self.timeline.entered = Some(entered);
        Ok(())
    }

    /// Whether an event of a sphere at `time` \[s\] reads a sphere that had a later one in an earlier phase.
    fn is_late(&mut self, slot: u32, time: f64, number: u32) -> bool {
        let Self { timeline, stamps, near, .. } = self;
        let level = timeline.flights.species_of(slot).level;
        timeline.neighbours.find(slot, level, near);
        let is_later = |slot: u32| {
            let stamp = stamps[slot as usize];
            stamp.phase < number && stamp.time >= time
        };
        is_later(slot) || near.others(slot).any(|other| is_later(other.slot()))
    }

    /// Puts the deferred events back into the queue.
    fn put_deferred_back(&mut self) {
        let Timeline { schedule, flights, .. } = &mut self.timeline;
        for slot in self.deferred.drain(..) {
            schedule.put_back(slot, flights.index_of[slot as usize]);
        }
    }

    /// The changes of the phase that other domains must know.
    fn shared_changes(&mut self) -> Vec<Change> {
        self.shared.sort_unstable();
        self.shared.dedup();
        let change = |slot: u32| Change::of(&self.timeline, slot, self.stamps[slot as usize]);
        let changes = self.shared.iter().map(|&slot| change(slot)).collect();
        self.shared.clear();
        changes
    }
}
