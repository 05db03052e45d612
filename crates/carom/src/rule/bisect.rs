//! The rule `bisect`: wind back what intersects, find the time of contact, answer it there.

use std::collections::BTreeMap;

use super::islands::{Island, Islands};
use crate::bodies::Motion;
use crate::contact_time::{self, Probe};
use crate::detect::ContactState;
use crate::detect::contact::{Bodies, Contact};
use crate::detect::contacts::{self, Moved, Search};
use crate::detect::instant::Instant;
use crate::detect::passage::FrameStart;
use crate::force_work::ForceWork;
use crate::integrate;
use crate::interval::Interval;
use crate::report::{StepReport, TriggerContact};
use crate::respond;
use crate::settings::{Bisect, WindBack};
use crate::system::System;
use crate::work::{StopRequest, Work};

/// What every part of the rule reads: the world, and the frame that it takes.
#[derive(Clone, Copy)]
struct Frame<'a> {
    system: System<'a>,
    parameters: Bisect,
    interval: Interval,
    /// States at the beginning.
    start: &'a Motion,
}

/// Work of a piece of an island's way, with the search for its end, for each member.
const UNITS_PER_MEMBER: u64 = 500;

/// Working memory of the rule, kept from step to step only to spare its allocation.
#[derive(Debug, Clone, Default)]
pub(crate) struct Scratch {
    contacts: Vec<Contact>,
    islands: Islands,
    buffers: Buffers,
}

/// Working memory of islands. Each [`Motion`] has a place for every sphere.
#[derive(Debug, Clone, Default)]
struct Buffers {
    /// States at the end of the frame.
    end: Motion,
    /// States after the last answered contact, for the spheres of the island at work.
    current: Motion,
    /// States at an instant on trial, for the spheres that take part in intersections.
    trial: Motion,
    /// Contacts of the island at work: at the instant on trial, and at the latest that was seen
    /// to be too late.
    trial_contacts: Vec<Contact>,
    late_contacts: Vec<Contact>,
    /// How often each two bodies of the island at work were to be answered.
    meetings: BTreeMap<Bodies, u32>,
    /// Spheres of islands, ascending.
    moved: Vec<u32>,
    /// Spheres that take part in the intersections of the island at work, ascending.
    involved: Vec<u32>,
    search: Search,
    integrate: integrate::Scratch,
}

/// Advances all spheres by one frame (`docs/physics/bisect-and-discrete.md`). Returns whether the frame
/// came to its end, or a request stopped it.
///
/// Spheres that intersect at the end of the frame form islands, and each island goes through the
/// frame again by [`settle`]. Where an island then meets a sphere outside, the two join and go
/// through the frame together, until nothing intersects any more.
pub(crate) fn step(
    system: &System,
    parameters: Bisect,
    motion: &mut Motion,
    interval: Interval,
    scratch: &mut Scratch,
    report: &mut StepReport,
    stop_request: Option<&StopRequest>,
) -> bool {
    let work = Work::new(stop_request);
    let Scratch { contacts, islands, buffers } = scratch;
    let frame_start = Some(FrameStart { centers: &motion.position });
    let from_start = System { frame_start, ..*system };
    let frame = Frame { system: from_start, parameters, interval, start: motion };
    let everyone = 0..system.spheres.id.len() as u32;
    islands.reset(everyone.len());
    buffers.reset(motion);
    let Buffers { end, integrate, .. } = &mut *buffers;
    advance(&frame, (motion, end), everyone, interval, integrate);
    let end = frame.end(&buffers.end);
    contacts::find_all(&end, parameters.tolerance, &mut buffers.search, contacts);

    // Where forces act between spheres, none goes through a piece of the frame without the others.
    let is_one = parameters.wind_back == WindBack::All || system.has_interactions();
    if is_one && contacts.iter().any(is_intersecting) {
        islands.join_all();
    }
    islands.join(contacts);
    while islands.any_unsettled() {
        for island in islands.unsettled() {
            settle(&frame, island, buffers, &work);
        }
        if work.is_stopped() {
            return false;
        }
        renew_contacts(&frame, islands, buffers, contacts);
        islands.join(contacts);
    }

    islands.report(report);
    let lone = (0..system.spheres.id.len() as u32).filter(|&sphere| !islands.contain(sphere));
    report.energy_account.add_force_work(work_of_forces(&frame, frame.start, lone, interval));
    report.work.pair_tests += buffers.search.take_pair_tests();
    report_triggers(&frame, buffers, report);
    let colliding = contacts.iter().filter(|contact| contact.state == ContactState::Colliding);
    report.impacts.extend(respond::sequentially(colliding, system, &mut buffers.end, interval.h));
    std::mem::swap(motion, &mut buffers.end);
    true
}

/// Takes an island through the frame: finds the first contact, advances the island to it, answers
/// it, and goes on with the remaining time until nothing intersects at the end of the frame.
///
/// The states of its spheres at the end of the frame, before the answer to contacts that begin
/// there, are left in `buffers.end`.
fn settle(frame: &Frame, island: &mut Island, buffers: &mut Buffers, work: &Work) {
    let Frame { system, parameters, interval, start } = frame;
    for &i in &island.members {
        buffers.current.copy(start, i as usize);
    }
    let mut elapsed = 0.0;
    let mut idle_pieces = 0;
    buffers.meetings.clear();
    loop {
        if !work.spend(UNITS_PER_MEMBER * island.members.len() as u64) {
            island.settled = true;
            return;
        }
        let rest = interval.after(elapsed);
        let Buffers { end, current, late_contacts, search, integrate, .. } = buffers;
        advance(frame, (current, end), island.members.iter().copied(), rest, integrate);
        let tolerance = parameters.tolerance;
        contacts::find_among(&frame.end(end), &island.members, tolerance, search, late_contacts);
        if !late_contacts.iter().any(is_intersecting) {
            island.work += work_of_forces(frame, current, island.members.iter().copied(), rest);
            island.settled = true;
            return;
        }
        let until_contact = find_first_contact(frame, rest, buffers);
        let Buffers { current, trial_contacts, integrate, .. } = buffers;
        let piece = Interval { time: rest.time, h: until_contact };
        let members = island.members.iter().copied();
        island.work += work_of_forces(frame, current, members.clone(), piece);
        integrate::advance(parameters.integrator, system, current, members, piece, integrate);
        elapsed += until_contact;
        let answered = respond::sequentially(trial_contacts.iter(), system, current, elapsed);
        island.impacts.extend(answered);
        // Every piece counts towards one bound or the other, so the loop ends.
        idle_pieces += u32::from(trial_contacts.is_empty());
        if buffers.met_too_often(parameters.max_impacts) || idle_pieces >= parameters.max_impacts {
            return give_up(frame, island, interval.after(elapsed), buffers);
        }
    }
}

/// Time \[s\] from the beginning of `rest` to the first contact in it, by bisection, moving only
/// the spheres that take part in an intersection at its end (`late_contacts`).
///
/// The contacts to be answered there are left in `buffers.trial_contacts`.
fn find_first_contact(frame: &Frame, rest: Interval, buffers: &mut Buffers) -> f64 {
    let Frame { system, parameters: Bisect { tolerance, max_halvings, .. }, .. } = *frame;
    let Buffers { current, trial, trial_contacts, late_contacts, involved, .. } = buffers;
    let Buffers { search, integrate, .. } = buffers;
    involved.clear();
    involved.extend(late_contacts.iter().filter(|c| is_intersecting(c)).flat_map(Contact::spheres));
    involved.sort_unstable();
    involved.dedup();
    // Should there be no room for a probe, the contacts at the end are answered there.
    trial_contacts.clone_from(late_contacts);
    let found = contact_time::bisect(rest.h, max_halvings, |t| {
        let piece = Interval { time: rest.time, h: t };
        advance(frame, (current, trial), involved.iter().copied(), piece, integrate);
        let instant = Instant { system, motion: trial, time: rest.time + t };
        contacts::find_among(&instant, involved, tolerance, search, trial_contacts);
        if trial_contacts.iter().any(is_intersecting) {
            late_contacts.clone_from(trial_contacts);
            Probe::After
        } else if trial_contacts.iter().any(|c| c.state == ContactState::Colliding) {
            Probe::At
        } else {
            Probe::Before
        }
    });
    if found.last == Probe::Before {
        // The halvings are used up just before the contact. It is answered here, for the bodies
        // that were seen to intersect just after it.
        let instant = Instant { system, motion: trial, time: rest.time + found.time };
        let late = late_contacts.iter().filter(|c| is_intersecting(c));
        trial_contacts.clear();
        trial_contacts.extend(late.filter_map(|c| instant.contact(c.bodies, tolerance)));
    }
    found.time
}

/// Ends the way of an island in which two bodies met more often than they may in one frame, as
/// bodies at rest on each other do without end: takes the rest of the frame
/// in one piece and answers what then overlaps as the rule `discrete` does. The bodies that met too
/// often have come to rest on each other: what bounces without end has no speed left.
fn give_up(frame: &Frame, island: &mut Island, rest: Interval, buffers: &mut Buffers) {
    let Frame { system, parameters, interval, .. } = *frame;
    let Bisect { tolerance, max_impacts, .. } = parameters;
    let Buffers { current, end, late_contacts, search, meetings, integrate, .. } = buffers;
    let rests = |bodies: Bodies| meetings.get(&bodies).is_some_and(|&met| met >= max_impacts);
    advance(frame, (current, end), island.members.iter().copied(), rest, integrate);
    island.work += work_of_forces(frame, current, island.members.iter().copied(), rest);
    contacts::find_among(&frame.end(end), &island.members, tolerance, search, late_contacts);
    for late in late_contacts.iter().filter(|c| is_intersecting(c)) {
        // The answers before this one may have moved the sphere.
        let now = frame.end(end).contact(late.bodies, tolerance);
        let Some(contact) = now.filter(is_intersecting) else { continue };
        let answer =
            if rests(contact.bodies) { respond::answer_plastically } else { respond::answer };
        let Some(impact) = answer(&contact, &system, end, interval.h) else { continue };
        island.impacts.push(impact);
        let lift = respond::put_on_surface(&contact, &system, end, interval.time + interval.h);
        island.correction += lift.unwrap_or(0.0);
    }
    island.settled = true;
    island.unfinished = true;
}

/// Brings the contacts at the end of the frame up to date after islands went through it: those of
/// lone spheres stand.
fn renew_contacts(
    frame: &Frame,
    islands: &Islands,
    buffers: &mut Buffers,
    contacts: &mut Vec<Contact>,
) {
    let Buffers { end, moved, trial_contacts, search, .. } = buffers;
    moved.clear();
    moved.extend(islands.members());
    let is_moved = |sphere| islands.contain(sphere);
    let moved = Moved { list: moved, contains: &is_moved };
    let tolerance = frame.parameters.tolerance;
    contacts::find_of_moved(&frame.end(end), &moved, tolerance, search, trial_contacts);
    contacts.retain(|contact| !contact.spheres().any(is_moved));
    contacts.append(trial_contacts);
    contacts.sort_unstable_by_key(|contact| contact.bodies);
}

fn report_triggers(frame: &Frame, buffers: &mut Buffers, report: &mut StepReport) {
    let Buffers { end, search, .. } = buffers;
    let end = frame.end(end);
    contacts::visit_triggers(&end, frame.parameters.tolerance, search, |contact| {
        report.triggers.extend(TriggerContact::of(&contact, &frame.system));
    });
}

impl Buffers {
    /// Makes place for every sphere.
    fn reset(&mut self, motion: &Motion) {
        for buffer in [&mut self.end, &mut self.current, &mut self.trial] {
            buffer.copy_all(motion);
        }
    }

    /// Counts the contacts just answered; returns whether two bodies met as often as the bound
    /// allows.
    fn met_too_often(&mut self, max_impacts: u32) -> bool {
        let mut too_often = false;
        for contact in &self.trial_contacts {
            let meetings = self.meetings.entry(contact.bodies).or_insert(0);
            *meetings += 1;
            too_often |= *meetings >= max_impacts;
        }
        too_often
    }
}

impl<'a> Frame<'a> {
    /// Returns the instant at the end of the frame, with all spheres in the states `end`.
    fn end<'b>(&'b self, end: &'b Motion) -> Instant<'b>
    where
        'a: 'b,
    {
        let Interval { time, h } = self.interval;
        Instant { system: self.system, motion: end, time: time + h }
    }
}

fn is_intersecting(contact: &Contact) -> bool {
    contact.state == ContactState::Intersecting
}

/// Work of nonconservative forces on spheres that [`advance`] moves over `interval` from `start`.
fn work_of_forces(
    frame: &Frame,
    start: &Motion,
    spheres: impl Iterator<Item = u32>,
    interval: Interval,
) -> ForceWork {
    integrate::work(frame.parameters.integrator, &frame.system, start, spheres, interval)
}

/// Moves spheres without contacts over `interval`, from `start` to `end`; all of them, where forces act
/// between spheres.
fn advance(
    frame: &Frame,
    (start, end): (&Motion, &mut Motion),
    spheres: impl Iterator<Item = u32> + Clone,
    interval: Interval,
    scratch: &mut integrate::Scratch,
) {
    if frame.system.has_interactions() {
        end.copy_all(start);
    } else {
        spheres.clone().for_each(|sphere| end.copy(start, sphere as usize));
    }
    integrate::advance(frame.parameters.integrator, &frame.system, end, spheres, interval, scratch);
}
