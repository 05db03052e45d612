//! Bounces within a sub-step, and where they lead.

use glam::DVec3;

use super::contacts::swept::FAR;
use super::places::{Place, Places};
use super::slabs::{Slab, Slabs};
use super::slots::Slots;
use super::slots::row::Row;
use super::solver::{Bounce, Solver, Turn};
use super::sub_step::SubStep;
use crate::contact_time;
use crate::detect::{Separation, known_in_front, sphere_surface};
use crate::flight::Flight;

/// A change of velocity comes from a bounce alone, up to this part of it.
const ROUNDING: f64 = 1e-9;

/// A bounce of a sphere off one body, or off the walls of a corner at once.
#[derive(Clone, Copy)]
pub(super) struct OneBounce {
    slot: usize,
    /// The other sphere, if it is one.
    other: Option<usize>,
    /// Impulse on the sphere \[N s\].
    impulse: DVec3,
    /// When in the sub-step \[s\].
    time: f64,
}

impl OneBounce {
    /// The bounces of a sphere as one, if they are: off another sphere, or off surfaces at one time.
    fn of_all(bounces: &[Self]) -> Option<Self> {
        let (&first, others) = bounces.split_first()?;
        let is_same = |it: &Self| it.other.is_none() && it.time == first.time;
        if !others.is_empty() && !bounces.iter().all(is_same) {
            return None;
        }
        let impulse = others.iter().fold(first.impulse, |sum, it| sum + it.impulse);
        Some(Self { impulse, ..first })
    }
}

/// Finds the bounces of the sub-step, by slot.
pub(super) fn find(solver: &Solver, sub_step: &SubStep) -> Vec<OneBounce> {
    let Solver { slots, slabs, .. } = solver;
    let mut all = Vec::new();
    for slab in slabs.iter() {
        of_pairs(slots, slab, sub_step, &mut all);
        of_surfaces(slots, slab, &mut all);
    }
    all.sort_by_key(|bounce| bounce.slot);
    all
}

/// The slots of the bouncing spheres with further contacts: they, or the bodies off which they bounce, touch or
/// reach something else.
pub(super) fn entangled(solver: &Solver, bounces: &[OneBounce], sub_step: &SubStep) -> Vec<usize> {
    let Solver { slots, slabs, places, .. } = solver;
    let is_done = |of_sphere: &[OneBounce]| match of_sphere {
        [bounce] => alone(slots, bounce, sub_step)
            .is_some_and(|own| own.last.first_of_free(slots, slabs, places).is_none()),
        _ => false,
    };
    let spheres = bounces.chunk_by(|first, second| first.slot == second.slot);
    let awake = spheres.filter(|it| !slots.sleeps[it[0].slot]);
    awake.filter(|it| !is_done(it)).map(|it| it[0].slot).collect()
}

/// Notes the ends of the paths of bouncing spheres, without those of cascades.
///
/// One that nothing else touches in the sub-step moves until its bounce as if nothing were there. Any other
/// moves by its last velocity. Contacts know nothing of surfaces that a sphere comes to after a bounce, or
/// because of what hit it: one that goes far stops at the first of them, and bounces off it in the next
/// sub-step.
pub(super) fn note(solver: &mut Solver, mut all: Vec<OneBounce>, sub_step: &SubStep) {
    let Solver { slots, slabs, bounces, places, landings, .. } = solver;
    let has_landed = |slot: usize| landings.has(slot);
    all.retain(|bounce| !has_landed(bounce.slot) && !bounce.other.is_some_and(has_landed));
    bounces.clear();
    for of_sphere in all.chunk_by(|first, second| first.slot == second.slot) {
        let one = OneBounce::of_all(of_sphere);
        if let Some(own) = one.and_then(|bounce| alone(slots, &bounce, sub_step)) {
            let Way { bounce, last } = own;
            let stop = last.first_met(slots, slabs, places);
            let stopped = stop.map(|stop| last.stopped(slots, stop, sub_step, true));
            bounces.push(stopped.unwrap_or(bounce));
        } else if let Some(Way { bounce, last }) = among_others(slots, of_sphere, sub_step) {
            let passed = || last.first_passed(slots, slabs, places);
            let stop = last.goes_far(slots, slabs, places).then(passed).flatten();
            let stopped = stop.map(|stop| last.stopped(slots, stop, sub_step, false));
            bounces.push(stopped.unwrap_or(bounce));
        }
    }
    let is_alone = |slot: usize| bounces.binary_search_by_key(&slot, |it| it.slot as usize).is_ok();
    let near_surfaces = slabs.list.iter().flat_map(|slab| {
        let of_spheres = slab.surfaces.chunk_by(|first, second| first.slot == second.slot);
        of_spheres.map(|own| slab.start + own[0].slot as usize)
    });
    let stopped: Vec<_> = near_surfaces
        .filter(|&slot| !is_alone(slot) && !has_landed(slot))
        .filter_map(|slot| {
            let last = FinalFlight::straight(slots, slot, sub_step);
            let is_pushed = || slots.velocity[slot].vector() != slots.accelerated(slot, sub_step.h);
            let goes_far = last.goes_far(slots, slabs, places) && is_pushed();
            let stop = goes_far.then(|| last.first_passed(slots, slabs, places))??;
            Some(last.stopped(slots, stop, sub_step, false))
        })
        .collect();
    bounces.extend(stopped);
    bounces.sort_by_key(|bounce| bounce.slot);
}

fn of_pairs(slots: &Slots, slab: &Slab, sub_step: &SubStep, bounces: &mut Vec<OneBounce>) {
    for (number, lane, approach) in slab.batches.impacts() {
        let Some(impulse) = slab.batches.bounce(number, lane, approach) else { continue };
        let [first, second] = slab.slots_of(number, lane);
        let radius_sum = slab.batches.approaches[number].radius_sum[lane];
        let offset = slots.position[second].vector() - slots.position[first].vector();
        let offset = offset + slab.batches.shift(number, lane);
        let normal = slab.batches.normal(number, lane);
        let mut velocity = slots.before[second].vector() - slots.before[first].vector();
        velocity.x += slab.batches.slide(number, lane);
        // Forces may have changed the speed of approach until then.
        let mean = 0.5 * (approach - velocity.dot(normal));
        let time = ((offset.dot(normal) - radius_sum).max(0.0) / mean).min(sub_step.h);
        bounces.push(OneBounce { slot: first, other: Some(second), impulse: -impulse, time });
        bounces.push(OneBounce { slot: second, other: Some(first), impulse, time });
    }
}

fn of_surfaces(slots: &Slots, slab: &Slab, bounces: &mut Vec<OneBounce>) {
    for contact in &slab.surfaces {
        let slot = slab.start + contact.slot as usize;
        if let Some(impulse) = contact.bounce(1.0 / slots.velocity[slot].number()) {
            bounces.push(OneBounce { slot, other: None, impulse, time: contact.time });
        }
    }
}

/// The path of a bouncing sphere.
struct Way {
    bounce: Bounce,
    /// Path after the bounce.
    last: FinalFlight,
}

/// The bounce of a sphere; `None` if something else changed its velocity or the other sphere's. After a bounce at a
/// time t with the impulse P, the sphere is `t P / m` short of the place to which its last velocity leads in the
/// whole sub-step.
fn alone(slots: &Slots, bounce: &OneBounce, sub_step: &SubStep) -> Option<Way> {
    let &OneBounce { slot, other, impulse, time } = bounce;
    let own = own_change(slots, slot, impulse, sub_step)?;
    if let Some(other) = other {
        own_change(slots, other, -impulse, sub_step)?;
    }
    let [velocity, before] = [slots.velocity[slot], slots.before[slot]].map(Row::vector);
    let change = velocity - slots.accelerated(slot, sub_step.h);
    let flight = 0.5 * sub_step.h * (before - (velocity - change));
    let shift = flight - time * own;
    let start = Flight {
        position: slots.position[slot].vector(),
        velocity: before,
        acceleration: slots.acceleration[slot].vector(),
        drag_rate: 0.0,
    };
    let (position, arriving) = start.after(time);
    let flight = Flight { position, velocity: arriving + own, ..start };
    let last = FinalFlight { slot, start: time, flight, duration: sub_step.h - time };
    let (slot, is_at_surface) = (slot as u32, other.is_none());
    let turn = Some(Turn { time, place: position });
    let bounce = Bounce { slot, shift, velocity, is_alone: true, is_at_surface, turn };
    Some(Way { bounce, last })
}

/// The bounce of a sphere off a body that touches something else, or off several bodies at once; `None` if the
/// sphere pressed on something before: such a sphere, and all on which it presses, moves by its last velocity.
///
/// It flies until its first bounce and goes on from there, with all that impulses changed.
fn among_others(slots: &Slots, bounces: &[OneBounce], sub_step: &SubStep) -> Option<Way> {
    let slot = bounces[0].slot;
    if slots.bears[slot] || slots.sleeps[slot] {
        return None;
    }
    let time = bounces.iter().map(|bounce| bounce.time).min_by(f64::total_cmp)?;
    let [velocity, before] = [slots.velocity[slot], slots.before[slot]].map(Row::vector);
    let acceleration = (slots.accelerated(slot, sub_step.h) - before) / sub_step.h;
    let left = sub_step.h - time;
    let start = slots.position[slot].vector();
    let struck = start + time * before + 0.5 * time * time * acceleration;
    let leaving = velocity - left * acceleration;
    let flight = Flight { position: struck, velocity: leaving, acceleration, drag_rate: 0.0 };
    let shift = flight.after(left).0 - start - sub_step.h * velocity;
    let is_alone =
        matches!(bounces, [one] if own_change(slots, slot, one.impulse, sub_step).is_some());
    let is_at_surface = bounces.iter().any(|bounce| bounce.other.is_none());
    let turn = is_alone.then_some(Turn { time, place: struck });
    let bounce = Bounce { slot: slot as u32, shift, velocity, is_alone, is_at_surface, turn };
    Some(Way { bounce, last: FinalFlight { slot, start: time, flight, duration: left } })
}

/// The change of velocity by an impulse \[m/s\]; `None` if something else also changed the sphere's velocity.
fn own_change(slots: &Slots, slot: usize, impulse: DVec3, sub_step: &SubStep) -> Option<DVec3> {
    let own = slots.velocity[slot].number() * impulse;
    let change = slots.velocity[slot].vector() - slots.accelerated(slot, sub_step.h);
    let most = (ROUNDING * ROUNDING) * change.length_squared();
    ((change - own).length_squared() <= most).then_some(own)
}

/// The last flight of a sphere in a sub-step, after all its contacts.
#[derive(Clone, Copy)]
struct FinalFlight {
    slot: usize,
    /// When in the sub-step it begins \[s\].
    start: f64,
    flight: Flight,
    /// \[s\]
    duration: f64,
}

/// Where a final flight ends at a surface.
#[derive(Clone, Copy)]
struct Stop {
    /// Since the final flight began \[s\].
    time: f64,
    /// Place to which the surface, moving along its normal, carries the sphere by the end of the final flight
    /// \[m\].
    end: DVec3,
}

impl Stop {
    fn first(stops: impl Iterator<Item = Self>) -> Option<Self> {
        stops.min_by(|one, other| one.time.total_cmp(&other.time))
    }
}

impl FinalFlight {
    /// The path of a sphere that moves by its last velocity in the whole sub-step.
    fn straight(slots: &Slots, slot: usize, sub_step: &SubStep) -> Self {
        let [position, velocity] = [slots.position[slot], slots.velocity[slot]].map(Row::vector);
        let flight = Flight { position, velocity, acceleration: DVec3::ZERO, drag_rate: 0.0 };
        Self { slot, start: 0.0, flight, duration: sub_step.h }
    }

    /// Whether the sphere, or a surface near it, moves so far that the sphere may pass the surface.
    fn goes_far(&self, slots: &Slots, slabs: &Slabs, places: &Places) -> bool {
        let Flight { position, velocity, .. } = self.flight;
        let far = FAR * slots.position[self.slot].number();
        let is_far = |velocity: DVec3| self.duration * velocity.length() > far;
        is_far(velocity)
            || places.are_moving()
                && slabs.surfaces_of(self.slot).any(|contact| {
                    let (_, motion) = places.at_start(contact.surface);
                    is_far(velocity - motion.velocity_after(position, self.start))
                })
    }

    /// First stop of the sphere at a surface on which it does not press.
    fn first_met(&self, slots: &Slots, slabs: &Slabs, places: &Places) -> Option<Stop> {
        let is_far = self.goes_far(slots, slabs, places);
        is_far.then(|| self.first_of_free(slots, slabs, places))?
    }

    /// Returns where the sphere reaches a surface that bears nothing of it, also near where it is.
    fn first_of_free(&self, slots: &Slots, slabs: &Slabs, places: &Places) -> Option<Stop> {
        // A turning surface may catch up with a sphere that has just bounced off it.
        let stops = slabs.surfaces_of(self.slot).filter_map(|contact| {
            let place = places.at_start(contact.surface);
            let may_be_met = contact.impulses.normal == 0.0 || place.1.turns_form(place.0);
            (may_be_met && !contact.passes).then(|| self.meets(slots, place))?
        });
        Stop::first(stops)
    }

    /// First stop of the sphere at a surface that its centre would pass, even one on which it presses: the sweeps
    /// may leave it a part of its speed.
    fn first_passed(&self, slots: &Slots, slabs: &Slabs, places: &Places) -> Option<Stop> {
        let stops = slabs.surfaces_of(self.slot).filter_map(|contact| {
            let place = places.at_start(contact.surface);
            if contact.impulses.normal == 0.0 {
                return self.meets(slots, place);
            }
            let radius = slots.position[self.slot].number();
            let (form, motion) = place.1.carry(place.0, self.start);
            let Flight { position, velocity, .. } = self.flight;
            let Separation { distance, normal, point } = sphere_surface(&form, position, radius)?;
            let speed = -(velocity - motion.velocity_at(point)).dot(normal);
            let is_passed = speed > 0.0 && self.duration * speed > distance + radius;
            is_passed.then(|| self.stop(distance.max(0.0) / speed, radius, place))
        });
        Stop::first(stops)
    }

    /// Returns where the sphere reaches a surface.
    fn meets(&self, slots: &Slots, place: Place) -> Option<Stop> {
        let radius = slots.position[self.slot].number();
        let (form, motion) = place.1.carry(place.0, self.start);
        let time = contact_time::sphere_surface_in_reach(
            &self.flight,
            radius,
            &form.closed(),
            &motion,
            self.duration,
        );
        Some(self.stop(time?, radius, place))
    }

    /// The stop of the sphere after a time \[s\] of the final flight, at a surface.
    fn stop(&self, time: f64, radius: f64, (form, motion): Place) -> Stop {
        let (place, rest) = (self.flight.after(time).0, self.duration - time);
        let end = if motion.is_at_rest() {
            place
        } else if motion.turns() {
            let (form, _) = motion.carry(form, self.start + self.duration);
            let found = known_in_front(&form, place, radius);
            found.map_or(place, |it| place - it.distance * it.normal)
        } else {
            let (form, motion) = motion.carry(form, self.start + time);
            let found = sphere_surface(&form, place, radius);
            place
                + found.map_or(DVec3::ZERO, |it| rest * motion.velocity.dot(it.normal) * it.normal)
        };
        Stop { time, end }
    }

    /// The end of the sphere if it stops on this final flight and moves on with what stops it; `is_alone` if
    /// nothing else touches it in the sub-step.
    fn stopped(&self, slots: &Slots, stop: Stop, sub_step: &SubStep, is_alone: bool) -> Bounce {
        let Self { slot, start: start_time, flight, .. } = self;
        let [start, last] = [slots.position[*slot], slots.velocity[*slot]].map(Row::vector);
        let velocity = flight.velocity_at(stop.time);
        let shift = stop.end - start - sub_step.h * last;
        let turn = is_alone.then_some(Turn { time: *start_time, place: flight.position });
        Bounce { slot: *slot as u32, shift, velocity, is_alone, is_at_surface: true, turn }
    }
}
