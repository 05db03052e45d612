//! Wake: something hits sleeping spheres, changes the load on them, or takes away what they touch.

use glam::DVec3;

use crate::rule::contact::contacts::dormant::{Dormant, Partner};
use crate::rule::contact::slots::{self, GONE, Slots};
use crate::rule::contact::solver::Solver;
use crate::system::System;

/// A sphere touches within this part of the sum of radii.
const TOUCH: f64 = 1e-3;
/// An impact wakes the sphere that it hits, and those near it, if its impulse would make that sphere faster than
/// calm ones. Above this many times that speed, it wakes all that are connected by contacts.
const HARD: f64 = 50.0;
/// A struck sphere passes the impact on to those that it reaches within the sub-step, at up to this many times its
/// speed.
const PASSED_ON: f64 = 2.0;
const MOST_IN_REACH: usize = 48;
/// A sphere wakes when the force of awake spheres on it has changed by this part of that force and of its weight.
const LOAD_CHANGE: f64 = 0.3;
/// Frames between two searches for such changes.
const FRAMES: u32 = 8;
/// A sphere supports another one if it takes this part of its weight.
const BORNE: f64 = 0.1;
/// How long spheres woken by a load stay awake at least, if they are calm, in units of sqrt(r / a).
const REST: f64 = 1.0;

/// Wakes spheres that something is about to hit in a sub-step of `h` \[s\], and those around them.
pub(crate) fn touched(system: &System, solver: &mut Solver, h: f64) {
    let Slots { velocity, index, acceleration, .. } = &solver.slots;
    let (mut felt, mut hard) = (Vec::new(), Vec::new());
    let mut farthest = 0.0_f64;
    for &[sleeper, other] in &solver.watched {
        let [sleeper, other] = [sleeper, other].map(|slot| slot as usize);
        let radius_sum: f64 =
            solver.slots.contact_radii([sleeper, other], system).into_iter().sum();
        let offset = solver.slots.offset([sleeper, other]);
        let way = h * slots::accelerated(velocity[other], acceleration[other], h);
        // The nearest point of the way.
        let length_squared = way.length_squared();
        let along = if length_squared > 0.0 {
            (-offset.dot(way) / length_squared).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let reach = radius_sum * (1.0 + TOUCH);
        if (offset + along * way).length_squared() >= reach * reach {
            continue;
        }
        let [own, others] = [sleeper, other].map(|slot| system.spheres.mass[index[slot] as usize]);
        // Without its fall in the sub-step, which resting spheres do not have.
        let gain = others / (own + others) * velocity[other].vector().length();
        let calm = super::calm_speed_squared(&solver.slots, solver.sleep_speed, sleeper);
        if gain * gain > HARD * HARD * calm {
            hard.push(sleeper);
            farthest = farthest.max(way.length());
        } else if gain * gain > calm {
            felt.push(sleeper);
        }
    }
    if felt.is_empty() && hard.is_empty() {
        return;
    }
    wake(solver, felt, Some(super::NEAR), 0.0);
    let others = in_reach(&solver.slots, &hard, PASSED_ON * farthest);
    wake(solver, hard, None, 0.0);
    wake(solver, others, Some(0), 0.0);
    solver.slots.read_masses(system);
}

/// The sleeping spheres within a distance \[m\] of these, or of others found so: a cascade may reach them within
/// the sub-step.
fn in_reach(slots: &Slots, struck: &[usize], distance: f64) -> Vec<usize> {
    let Slots { position, sleeps, .. } = slots;
    let mut found = struck.to_vec();
    let mut next = 0;
    while next < found.len() && found.len() < MOST_IN_REACH {
        let from = position[found[next]];
        for slot in (0..sleeps.len()).filter(|&slot| sleeps[slot]) {
            let to = position[slot];
            let reach = from.number() + to.number() + distance;
            let is_near = slots.offset([found[next], slot]).length_squared() < reach * reach;
            if is_near && !found.contains(&slot) {
                found.push(slot);
            }
        }
        next += 1;
    }
    found
}

/// Wakes spheres whose support is gone, and, once in some frames, those on which awake spheres press differently
/// than when they fell asleep.
pub(crate) fn loaded(system: &System, solver: &mut Solver) {
    if solver.dormant.is_empty() {
        return;
    }
    let mut loaded = left_alone(system, &solver.slots, &solver.dormant);
    if solver.frames.is_multiple_of(FRAMES) {
        loaded.extend(pressed_otherwise(system, solver));
    }
    wake(solver, loaded, Some(super::NEAR), super::PATIENCE - REST);
}

/// The spheres of whose weight a part was supported by an awake sphere that is gone.
fn left_alone(system: &System, slots: &Slots, dormant: &[Dormant]) -> Vec<usize> {
    let has_gone = |contact: &&Dormant| {
        let Partner::Awake(other) = contact.partner else { return false };
        let (own, place) = (slots.position[contact.sphere as usize], other as usize);
        slots.position.get(place).is_none_or(|other| {
            let reach = (1.0 + TOUCH) * (own.number() + other.number());
            slots.offset([contact.sphere as usize, place]).length_squared() > reach * reach
        })
    };
    let bore = |contact: &&Dormant| {
        let weight = weight(system, slots, contact.sphere as usize);
        -contact.force.dot(weight) > BORNE * weight.length_squared()
    };
    dormant.iter().filter(has_gone).filter(bore).map(|it| it.sphere as usize).collect()
}

/// The sleeping spheres on which awake ones press differently than before.
fn pressed_otherwise(system: &System, solver: &Solver) -> Vec<usize> {
    let Solver { slots, slabs, dormant, .. } = solver;
    let mut change = vec![DVec3::ZERO; slots.len()];
    let mut known = change.clone();
    for slab in slabs.iter() {
        for (number, lane, _) in slab.batches.contacts() {
            let force = slab.batches.impulse(number, lane) / solver.h;
            let [first, second] = slab.slots_of(number, lane);
            change[first] -= force;
            change[second] += force;
        }
    }
    for contact in dormant.iter().filter(|it| matches!(it.partner, Partner::Awake(_))) {
        change[contact.sphere as usize] -= contact.force;
        known[contact.sphere as usize] += contact.force;
    }
    let is_otherwise = |&slot: &usize| {
        let weight = weight(system, slots, slot).length();
        let most = LOAD_CHANGE * (weight + known[slot].length());
        slots.sleeps[slot] && change[slot].length_squared() > most * most
    };
    (0..slots.len()).filter(is_otherwise).collect()
}

/// \[N\]
fn weight(system: &System, slots: &Slots, slot: usize) -> DVec3 {
    system.spheres.mass[slots.index[slot] as usize] * slots.acceleration[slot].vector()
}

/// Wakes the neighbours of a sphere that was removed from the world.
pub(crate) fn bereft(solver: &mut Solver) {
    let index = &solver.slots.index;
    let gone = (0..index.len()).filter(|&slot| index[slot] == GONE).collect();
    wake(solver, gone, Some(super::NEAR), 0.0);
}

/// Wakes all spheres.
pub(crate) fn all(solver: &mut Solver) {
    let sleeps = &solver.slots.sleeps;
    let all = (0..sleeps.len()).filter(|&slot| sleeps[slot]).collect();
    wake(solver, all, Some(0), 0.0);
}

/// Wakes spheres and those up to `contacts` contacts around them, or all connected ones. They count as calm for
/// `calm_for`, in units of sqrt(r / a).
fn wake(solver: &mut Solver, from: Vec<usize>, contacts: Option<u32>, calm_for: f64) {
    if from.is_empty() {
        return;
    }
    let Slots { sleeps, calm, .. } = &mut solver.slots;
    let mut wakes = vec![false; sleeps.len()];
    from.into_iter().for_each(|slot| wakes[slot] = true);
    let sleepers: Vec<_> = solver.dormant.iter().filter_map(Dormant::sleepers).collect();
    super::spread(&mut wakes, &sleepers, contacts);
    for (slot, _) in wakes.iter().enumerate().filter(|(_, wakes)| **wakes) {
        (sleeps[slot], calm[slot]) = (false, calm_for);
    }
    solver.is_stale = true;
}
