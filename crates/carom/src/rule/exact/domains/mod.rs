//! Domains: the events of a gas on several threads, with the bits of one thread.
//!
//! The box is cut into slabs, one for each thread, and each thread has a copy of the timeline. Within a short window of
//! time it takes the events of its slab in their order, but for those near a border; then those about one border. An
//! event that comes near one that was deferred is deferred, too. Then each copy takes over what the others changed.
//!
//! What an event does follows from the flights of the spheres around it. So the order among events far from each
//! other changes nothing, and an event may be taken before an earlier one that neither reads what it changes nor the
//! other way round. Each sphere has a stamp, the time of its last event: an event that reads a sphere with a later one
//! is a conflict. After a conflict, the events of the whole segment are taken in one order, by one thread, from the
//! timeline itself, which no domain has touched. So results, counts of work among them, never depend on threads.
//!
//! Source: domains with windows of time as in Miller and Luding, J. Comput. Phys. 193, 306 (2004).

mod change;
mod conditions;
mod domain;
mod record;
mod territory;

use std::mem::take;

use change::{Change, Stamp};
use domain::{Conflict, Domain, Window};
use record::append_in_order;
use territory::{Cut, Phase, Territory};

use super::answer::unfinished::Unfinished;
use super::frame::arrange::ArrangementDue;
use super::span::Span;
use super::timeline::Timeline;
use super::zones::budget::{Budget, Charge};
use super::zones::frame_work::UNITS_PER_FLIGHT;
use crate::parallel;
use crate::report::{StageCounts, StepReport};
use crate::system::System;
use crate::work::Work;

/// Events of each sphere in a window: so few that hardly an event depends on a deferred one far away, so many that
/// threads seldom wait for each other.
const EVENTS_PER_WINDOW: f64 = 0.01;
/// Events of each sphere in a segment: so many that bringing the timeline up to date costs little.
const EVENTS_PER_SEGMENT: f64 = 16.0;
/// Events that a thread must have to do in a window.
const LEAST_EVENTS: f64 = 40.0;
/// Events of each sphere in a step that are worth copies of the timeline.
const WORTH_COPIES: f64 = 4.0;
/// Pairs of phases in which all deferred events of a window must be taken.
const MOST_ROUNDS: usize = 16;
/// The revision of no timeline.
const NONE: u64 = u64::MAX;
/// More spheres than this would take too much memory on several threads.
const MOST_SPHERES: usize = 4_000_000;

/// The domains of a timeline. A copy of the timeline has none until they are of use.
#[derive(Debug, Default)]
pub(super) struct Domains {
    all: Vec<Domain>,
    /// The budget after the segment.
    budget: Option<Budget>,
    /// The state of the timeline that they have copied, by [`Timeline::revision`].
    revision: u64,
}

impl Clone for Domains {
    fn clone(&self) -> Self {
        Self::default()
    }

    /// Keeps its own memory.
    fn clone_from(&mut self, _: &Self) {}
}

/// How far a segment came.
enum Reached {
    /// All events up to this time were taken \[s\].
    Time(f64),
    /// The events up to this time must be taken in one order \[s\].
    InOrder(f64),
}

/// Takes the events of a span on several threads as far as that is possible and of use. Returns the time up to which
/// the next ones must be taken in one order \[s\].
pub(super) fn advance(
    system: &System,
    timeline: &mut Timeline,
    span: Span,
    work: &Work,
    report: &mut StepReport,
) -> Result<f64, Unfinished> {
    while let Some(pace) = Pace::of(timeline, system, span.end) {
        let mut domains = take(&mut timeline.domains);
        let known = &*timeline;
        let segment = || domains.segment((system, span), known, pace);
        let reached = parallel::among_threads(usize::MAX, segment);
        let is_stopped = !work.spend(domains.units());
        match reached {
            Reached::Time(_) if !is_stopped => domains.commit(timeline, report),
            _ => domains.revision = NONE,
        }
        timeline.domains = domains;
        match reached {
            _ if is_stopped => return Err(Unfinished::Stopped),
            Reached::Time(time) if time >= span.end => break,
            Reached::Time(_) => {}
            Reached::InOrder(time) => return Ok(time),
        }
    }
    Ok(span.end)
}

/// How far a segment is.
#[derive(Debug, Default)]
struct Progress {
    /// The number of the last phase.
    phase: u32,
    /// What each domain must know of the others.
    changes: Vec<Vec<Change>>,
}

/// How fast events follow each other.
#[derive(Debug, Clone, Copy)]
struct Pace {
    /// When the first event comes, on the world's clock \[s\].
    first: f64,
    /// Length of a window \[s\].
    window: f64,
    threads: usize,
}

impl Pace {
    /// The pace of a timeline up to the `end` of a span \[s\]; `None` if events are better taken on one thread.
    fn of(timeline: &Timeline, system: &System, end: f64) -> Option<Self> {
        let threads = parallel::threads();
        let count = timeline.flights.bodies.len();
        let is_of_use = threads > 1
            && count as f64 * EVENTS_PER_WINDOW >= LEAST_EVENTS * 2.0
            && count <= MOST_SPHERES
            && timeline.has_only_free_flights(system);
        if !is_of_use {
            return None;
        }
        let [first, median] = timeline.schedule.first_and_median();
        // Half of the spheres have an event until then.
        let of_each = 0.5 / (median - first);
        let worth = match timeline.domains.revision == timeline.revision {
            true => 2.0 * EVENTS_PER_WINDOW,
            false => WORTH_COPIES,
        };
        let window = EVENTS_PER_WINDOW / of_each;
        let is_worth = window > 0.0 && (end - first) * of_each >= worth;
        is_worth.then_some(Self { first, window, threads })
    }
}

impl Domains {
    /// Takes the events of a segment; nothing is written to the timeline.
    fn segment(
        &mut self,
        (system, span): (&System, Span),
        timeline: &Timeline,
        pace: Pace,
    ) -> Reached {
        self.prepare(timeline, pace.threads);
        let (mut from, mut until) = (f64::NEG_INFINITY, pace.first);
        if self.all.len() < 2 {
            return Reached::InOrder(span.end);
        }
        let due = ArrangementDue::of(timeline, system);
        let most_events = (EVENTS_PER_SEGMENT * timeline.flights.bodies.len() as f64) as u64;
        let mut progress = Progress::default();
        let mut before = StageCounts::default();
        loop {
            until = (until + pace.window).min(span.end);
            if self.take_window((system, span), [from, until], &mut progress).is_err() {
                return Reached::InOrder(until);
            }
            let now = self.counts();
            let ahead = |all: u64, before: u64| all + 2 * (all - before);
            let [events, crossings] = [
                ahead(now.events, before.events),
                ahead(now.cell_crossings, before.cell_crossings),
            ];
            let is_due = due.is_after(timeline, events, crossings);
            if is_due || now.events >= most_events || until >= span.end {
                break;
            }
            (from, before) = (until, now);
        }
        self.share(&progress.changes);
        let counts = self.counts();
        let is_due = due.is_after(timeline, counts.events, counts.cell_crossings);
        let have_worked =
            |domain: &Domain| !domain.timeline.flights.has_worked_as(&timeline.flights);
        self.budget = self.budget_after(timeline);
        let is_whole = !is_due && !self.all.iter().any(have_worked);
        if is_whole && self.budget.is_some() {
            Reached::Time(until)
        } else {
            Reached::InOrder(until)
        }
    }

    /// Takes all events of a window, from one time to another \[s\], phase after phase.
    fn take_window(
        &mut self,
        (system, span): (&System, Span),
        [from, until]: [f64; 2],
        progress: &mut Progress,
    ) -> Result<(), Conflict> {
        let mut done = from;
        for _ in 0..MOST_ROUNDS {
            for phase in [Phase::Slabs, Phase::Borders] {
                progress.phase += 1;
                let window = Window { phase, number: progress.phase, from: done, until };
                progress.changes = self.take_phase(system, span, window, &progress.changes)?;
                if phase == Phase::Slabs && self.all.iter().all(|domain| domain.pending == 0) {
                    return Ok(());
                }
            }
            done = until;
        }
        Err(Conflict)
    }

    /// Takes the events of a phase in all domains. Returns what each must know of the others.
    fn take_phase(
        &mut self,
        system: &System,
        span: Span,
        window: Window,
        changes: &[Vec<Change>],
    ) -> Result<Vec<Vec<Change>>, Conflict> {
        let mut shared: Vec<Vec<Change>> = self.all.iter().map(|_| Vec::new()).collect();
        let tasks = self.all.iter_mut().zip(&mut shared).enumerate();
        parallel::for_each(tasks.collect(), |(number, (domain, shared))| {
            domain.follow(changes, number);
            *shared = domain.take_events(system, span, window);
        });
        self.all.iter().try_for_each(|domain| domain.outcome)?;
        Ok(shared)
    }

    /// Shares changes among all domains.
    fn share(&mut self, changes: &[Vec<Change>]) {
        let tasks = self.all.iter_mut().enumerate().collect();
        parallel::for_each(tasks, |(number, domain): (usize, &mut Domain)| {
            domain.follow(changes, number);
        });
    }

    /// Makes the domains of a timeline, or keeps them while they are copies of it.
    fn prepare(&mut self, timeline: &Timeline, threads: usize) {
        if self.revision != timeline.revision || self.all.is_empty() {
            let Some(layout) = timeline.neighbours.coarsest_layout() else {
                return self.all.clear();
            };
            let slots = 0..timeline.flights.bodies.len() as u32;
            let cells = slots.map(|slot| timeline.neighbours.coarsest_cell(slot));
            let cut = Cut::of(layout, cells, threads);
            if cut.slabs() < 2 {
                return self.all.clear();
            }
            let mut used = take(&mut self.all).into_iter().map(|domain| domain.timeline);
            let domain = |territory| Domain::new(territory, used.next().unwrap_or_default());
            self.all = Territory::all(layout, &cut).into_iter().map(domain).collect();
            let tasks = self.all.iter_mut().collect();
            parallel::for_each(tasks, |domain: &mut Domain| domain.copy(timeline));
        }
        let tasks = self.all.iter_mut().collect();
        parallel::for_each(tasks, |domain: &mut Domain| domain.begin_segment(timeline));
        self.revision = timeline.revision;
    }

    /// What the groups and short flights of a segment leave of the budget of a timeline; `None` if a sphere has worked
    /// too much.
    fn budget_after(&self, timeline: &Timeline) -> Option<Budget> {
        let (mut budget, parameters) = (timeline.budget.clone(), timeline.parameters);
        let is_spent = self.charges().into_iter().any(|it| budget.repeat(parameters, it));
        (!is_spent).then_some(budget)
    }

    /// The charges of all domains, in order of time.
    fn charges(&self) -> Vec<&Charge> {
        let mut all: Vec<&Charge> = Vec::new();
        for domain in &self.all {
            all.extend(domain.timeline.budget.charges.iter().flatten());
        }
        all.sort_by(|one, other| one.tick.total_cmp(&other.tick));
        all
    }

    /// Work of all domains in the segment.
    fn counts(&self) -> StageCounts {
        let mut all = StageCounts::default();
        self.all.iter().for_each(|domain| all += domain.counts);
        all
    }

    /// Units of work of all domains in the segment.
    fn units(&self) -> u64 {
        self.all.iter().map(|domain| domain.units).sum()
    }

    /// Writes a segment to the timeline and the report.
    fn commit(&mut self, timeline: &mut Timeline, report: &mut StepReport) {
        for slot in 0..timeline.flights.bodies.len() {
            let stamp = |domain: &&Domain| domain.stamps[slot].phase;
            if let Some(latest) = self.all.iter().max_by_key(stamp)
                && latest.stamps[slot] != Stamp::NONE
            {
                Change::of(&latest.timeline, slot as u32, Stamp::NONE).write_to(timeline);
            }
        }
        for charge in self.charges().into_iter().filter(|it| it.is_of_group()) {
            let slots =
                charge.spheres.iter().map(|&index| timeline.flights.slot_of[index as usize]);
            timeline.work.charge(slots, charge.units[0] / UNITS_PER_FLIGHT);
        }
        timeline.budget = self.budget.take().unwrap_or_default();
        let counts = self.counts();
        timeline.events += counts.events;
        timeline.cell_crossings += counts.cell_crossings;
        report.work += counts;
        let records: Vec<_> = self.all.iter().map(|domain| &domain.records).collect();
        append_in_order(&records, report);
        self.revision = timeline.revision;
    }
}
