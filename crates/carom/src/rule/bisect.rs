//! The rule `bisect`: wind back what intersects, find the time of contact, answer it there.

use super::islands::{Island, Islands};
use super::{Bisect, Scratch, WindBack, discrete};
use crate::bodies::Motion;
use crate::contact_time::{self, Probe};
use crate::detect::ContactState;
use crate::detect::contacts::{self, Bodies, Contact, Instant, Search};
use crate::integrate;
use crate::report::{StepReport, TriggerContact};
use crate::respond;
use crate::system::{Interval, System};

/// Working memory of the rule. Each [`Motion`] has a place for every sphere.
#[derive(Debug, Clone, Default)]
pub(super) struct Buffers {
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
    /// Spheres of islands, ascending.
    moved: Vec<u32>,
    /// Spheres that take part in the intersections of the island at work, ascending.
    involved: Vec<u32>,
}

/// Advances all spheres by one frame (`docs/physics.md`, rule `bisect`).
///
/// Spheres that intersect at the end of the frame form islands, and each island goes through the
/// frame again by [`wind`]. Where an island then meets a sphere outside, the two join and go
/// through the frame together, until nothing intersects any more.
pub(super) fn step(
    (system, parameters): (&System, &Bisect),
    motion: &mut Motion,
    frame: Interval,
    scratch: &mut Scratch,
    report: &mut StepReport,
) {
    let Scratch { near, search, contacts, islands, bisect: buffers } = scratch;
    let everyone = 0..system.spheres.id.len() as u32;
    islands.reset(everyone.len());
    buffers.reset(motion);
    advance(system, (motion, &mut buffers.end), everyone, frame);
    contacts::of_everyone(
        &at_end(system, &buffers.end, frame),
        parameters.tolerance,
        search,
        contacts,
    );

    if parameters.wind_back == WindBack::All && contacts.iter().any(is_intersecting) {
        islands.join_all();
    }
    islands.join(contacts);
    while islands.any_unsettled() {
        for island in islands.unsettled() {
            wind((system, parameters), island, (motion, frame), buffers, search);
        }
        renew_contacts((system, parameters), (islands, frame), buffers, search, contacts);
        islands.join(contacts);
    }

    islands.report(report);
    contacts::of_triggers(
        &at_end(system, &buffers.end, frame),
        parameters.tolerance,
        near,
        |contact| {
            report.triggers.extend(TriggerContact::of(&contact, system));
        },
    );
    let colliding = contacts.iter().filter(|contact| contact.state == ContactState::Colliding);
    respond::sequentially(colliding, system, &mut buffers.end, (frame.h, &mut report.impacts));
    std::mem::swap(motion, &mut buffers.end);
}

/// Takes an island through the frame: finds the first contact, advances the island to it, answers
/// it, and goes on with the remaining time until nothing intersects at the end of the frame.
///
/// The states of its spheres at the end of the frame, before the answer to contacts that begin
/// there, are left in `buffers.end`.
fn wind(
    (system, parameters): (&System, &Bisect),
    island: &mut Island,
    (start, frame): (&Motion, Interval),
    buffers: &mut Buffers,
    search: &mut Search,
) {
    let members = &island.members;
    for &i in members {
        buffers.current.copy(start, i as usize);
    }
    let mut elapsed = 0.0;
    for _ in 0..parameters.max_substeps as usize * members.len() {
        let rest = Interval { time: frame.time + elapsed, h: frame.h - elapsed };
        advance(system, (&buffers.current, &mut buffers.end), members.iter().copied(), rest);
        let end = at_end(system, &buffers.end, frame);
        contacts::of_some(&end, members, parameters.tolerance, search, &mut buffers.late_contacts);
        if !buffers.late_contacts.iter().any(is_intersecting) {
            island.settled = true;
            return;
        }
        let until_contact = find_first_contact((system, parameters), rest, buffers, search);
        let piece = Interval { time: rest.time, h: until_contact };
        advance_in_place(system, &mut buffers.current, members, piece);
        elapsed += until_contact;
        respond::sequentially(
            buffers.trial_contacts.iter(),
            system,
            &mut buffers.current,
            (elapsed, &mut island.impacts),
        );
    }
    let rest = Interval { time: frame.time + elapsed, h: frame.h - elapsed };
    give_up((system, parameters), island, (rest, frame), buffers, search);
}

/// Time \[s\] from the beginning of `rest` to the first contact in it, by bisection, moving only
/// the spheres that take part in an intersection at its end (`late_contacts`).
///
/// The contacts to be answered there are left in `buffers.trial_contacts`.
fn find_first_contact(
    (system, parameters): (&System, &Bisect),
    rest: Interval,
    buffers: &mut Buffers,
    search: &mut Search,
) -> f64 {
    let Buffers { current, trial, trial_contacts, late_contacts, involved, .. } = buffers;
    involved.clear();
    involved.extend(late_contacts.iter().filter(|c| is_intersecting(c)).flat_map(Contact::spheres));
    involved.sort_unstable();
    involved.dedup();
    let found = contact_time::bisect(rest.h, parameters.max_halvings, |t| {
        let piece = Interval { time: rest.time, h: t };
        advance(system, (current, trial), involved.iter().copied(), piece);
        let instant = Instant { system: *system, motion: trial, time: rest.time + t };
        contacts::of_some(&instant, involved, parameters.tolerance, search, trial_contacts);
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
        let instant = Instant { system: *system, motion: trial, time: rest.time + found.time };
        let late = late_contacts.iter().filter(|c| is_intersecting(c));
        trial_contacts.clear();
        trial_contacts.extend(late.filter_map(|c| instant.contact(c.bodies, parameters.tolerance)));
    }
    found.time
}

/// Ends the way of an island that went through its bound of substeps: takes the rest of the frame
/// in one piece and answers what then overlaps as the rule `discrete` does.
fn give_up(
    (system, parameters): (&System, &Bisect),
    island: &mut Island,
    (rest, frame): (Interval, Interval),
    buffers: &mut Buffers,
    search: &mut Search,
) {
    let Buffers { current, end, late_contacts, .. } = buffers;
    advance(system, (current, end), island.members.iter().copied(), rest);
    let instant = at_end(system, end, frame);
    contacts::of_some(&instant, &island.members, parameters.tolerance, search, late_contacts);
    for late in late_contacts.iter().filter(|c| is_intersecting(c)) {
        // The answers before this one may have moved the sphere.
        let now = at_end(system, end, frame).contact(late.bodies, parameters.tolerance);
        let Some(contact) = now.filter(is_intersecting) else { continue };
        let Some(impact) = respond::answer(&contact, system, end, frame.h) else { continue };
        island.impacts.push(impact);
        if let Bodies::Surface { sphere, surface } = contact.bodies {
            let form = &system.surfaces[surface as usize].form;
            let i = sphere as usize;
            let radius = system.spheres.radius[i];
            discrete::put_on_surface((form, &contact.separation), radius, &mut end.position[i]);
        }
    }
    island.settled = true;
    island.unfinished = true;
}

/// Brings the contacts at the end of the frame up to date after islands went through it: those of
/// lone spheres stand.
fn renew_contacts(
    (system, parameters): (&System, &Bisect),
    (islands, frame): (&Islands, Interval),
    buffers: &mut Buffers,
    search: &mut Search,
    contacts: &mut Vec<Contact>,
) {
    let Buffers { end, moved, trial_contacts, .. } = buffers;
    moved.clear();
    moved.extend(islands.members());
    let instant = at_end(system, end, frame);
    let is_moved = |sphere| islands.contain(sphere);
    let tolerance = parameters.tolerance;
    contacts::of_moved(&instant, (moved, is_moved), tolerance, search, trial_contacts);
    contacts.retain(|contact| !contact.spheres().any(is_moved));
    contacts.append(trial_contacts);
    contacts.sort_unstable_by_key(|contact| contact.bodies);
}

impl Buffers {
    /// Makes place for every sphere.
    fn reset(&mut self, motion: &Motion) {
        for buffer in [&mut self.end, &mut self.current, &mut self.trial] {
            buffer.copy_all(motion);
        }
    }
}

fn is_intersecting(contact: &Contact) -> bool {
    contact.state == ContactState::Intersecting
}

fn at_end<'a>(system: &System<'a>, end: &'a Motion, frame: Interval) -> Instant<'a> {
    Instant { system: *system, motion: end, time: frame.time + frame.h }
}

/// Moves spheres without contacts over `interval`, from `start` to `end`.
fn advance(
    system: &System,
    (start, end): (&Motion, &mut Motion),
    spheres: impl Iterator<Item = u32>,
    interval: Interval,
) {
    for sphere in spheres {
        let i = sphere as usize;
        (end.position[i], end.velocity[i]) = integrate::advance(system, start, i, interval);
    }
}

/// Moves spheres without contacts over `interval`.
fn advance_in_place(system: &System, motion: &mut Motion, spheres: &[u32], interval: Interval) {
    for &sphere in spheres {
        let i = sphere as usize;
        (motion.position[i], motion.velocity[i]) = integrate::advance(system, motion, i, interval);
    }
}
