//! Sleep: spheres that have been at rest for a while are not simulated, with what they lie on, until something
//! comes near or the load on them changes.
//!
//! A heap need not be at rest everywhere: what moves keeps awake what it touches, a few contacts far. One
//! that sleeps is immovable, and bears what lies on it.

pub(crate) mod rest;
pub(crate) mod wake;

use glam::DVec3;

use self::rest::note_moving;
use crate::report::StepReport;
use crate::rule::contact::contacts::dormant::{self, Dormant, Partner};
use crate::rule::contact::slots::Slots;
use crate::rule::contact::slots::row::Row;
use crate::rule::contact::solver::Solver;
use crate::rule::contact::sub_step::SLOP;

/// A spin is steady if a sub-step changes it by less than this part of the speed of free fall over it. A ball that
/// spins about the normal without spinning friction has one.
const STEADY: f64 = 1e-3;
/// A sphere is supported if it accelerates by less than this part of the acceleration by forces alone.
const UNBORNE: f64 = 0.1;
/// How long a sphere, and all spheres up to [`NEAR`] contacts around it, must be calm before it sleeps, in units of
/// the time sqrt(r / a), with a the acceleration by forces.
pub(crate) const PATIENCE: f64 = 5.0;
/// Spheres that overlap by more than this part of the sum of their radii stay awake, for the overlap to be
/// corrected.
const DEEP: f64 = 4.0 * SLOP;
/// Number of contacts up to which a moving sphere keeps others awake.
pub(crate) const NEAR: u32 = 2;
/// Frames between two searches for spheres that may sleep: a search costs as much as a sweep.
const FRAMES: u32 = 16;

/// Puts spheres to sleep that have been calm for long enough, at the end of a frame of this length \[s\].
pub(crate) fn fall_asleep(solver: &mut Solver, frame: f64, report: &mut StepReport) {
    if !solver.may_sleep || solver.sleep_speed == 0.0 {
        return;
    }
    let longest = note_calm(&mut solver.slots, solver.sleep_speed, frame, solver.h);
    solver.frames = (solver.frames + 1) % FRAMES;
    if longest < PATIENCE || solver.frames != 0 {
        return;
    }
    let stays_awake = near_restless(solver);
    let Solver { slots, sleep_speed, .. } = &mut *solver;
    let falls: Vec<bool> =
        slots.sleeps.iter().zip(stays_awake).map(|(sleeps, stays)| !sleeps && !stays).collect();
    if !falls.contains(&true) {
        return;
    }
    for slot in (0..slots.len()).filter(|&slot| falls[slot]) {
        slots.sleeps[slot] = true;
        let slow = calm_speed_squared(slots, *sleep_speed, slot);
        let velocity = &mut slots.velocity[slot];
        report.energy_account.contacts -= stop(velocity);
        if let Some(spin) = slots.spin.get_mut(slot)
            && spin.vector().length_squared() < slow
        {
            report.energy_account.contacts -= stop(spin);
        }
    }
    keep_contacts(solver, &falls);
    solver.is_stale = true;
}

/// Sets a velocity or a spin to zero. Returns its kinetic energy \[J\].
fn stop(row: &mut Row) -> f64 {
    let (twice, inverse_mass) = (row.vector().length_squared(), row.number());
    *row = row.with_vector(DVec3::ZERO);
    if inverse_mass > 0.0 { 0.5 * twice / inverse_mass } else { 0.0 }
}

/// Square of the speed below which a sphere is calm \[m²/s²\], with the parameter `sleep_speed`.
pub(crate) fn calm_speed_squared(slots: &Slots, sleep_speed: f64, slot: usize) -> f64 {
    let acceleration = slots.acceleration[slot].vector().length();
    sleep_speed * sleep_speed * acceleration * slots.position[slot].number()
}

/// Whether a sphere is slower than the speed below which it is calm.
fn is_slow(slots: &Slots, sleep_speed: f64, slot: usize) -> bool {
    slots.velocity[slot].vector().length_squared() < calm_speed_squared(slots, sleep_speed, slot)
}

/// Whether contacts cancel the forces on a sphere in a sub-step of `h` \[s\].
fn is_borne(slots: &Slots, slot: usize, h: f64) -> bool {
    let change = slots.velocity[slot].vector() - slots.before[slot].vector();
    let most = UNBORNE * h * slots.acceleration[slot].vector().length();
    change.length_squared() < most * most
}

/// Whether the spin of a sphere has no effect: it is slow, or steady over a sub-step of `h` \[s\].
fn turns_calmly(slots: &Slots, sleep_speed: f64, slot: usize, h: f64) -> bool {
    let (Some(spin), Some(before)) = (slots.spin.get(slot), slots.spin_before.get(slot)) else {
        return true;
    };
    let change = (spin.vector() - before.vector()).length();
    let steady = STEADY * h * slots.acceleration[slot].vector().length();
    let slow = calm_speed_squared(slots, sleep_speed, slot);
    spin.vector().length_squared() < slow || change < steady
}

/// Counts how long each sphere has been calm, in units of sqrt(r / a), over a frame in sub-steps of `h` \[s\].
/// Returns the longest time of an awake sphere.
fn note_calm(slots: &mut Slots, sleep_speed: f64, frame: f64, h: f64) -> f64 {
    let mut longest = 0.0_f64;
    for slot in 0..slots.len() {
        if slots.sleeps[slot] {
            continue;
        }
        let is_calm = slots.bears[slot]
            && is_slow(slots, sleep_speed, slot)
            && is_borne(slots, slot, h)
            && turns_calmly(slots, sleep_speed, slot, h);
        let unit =
            (slots.position[slot].number() / slots.acceleration[slot].vector().length()).sqrt();
        slots.calm[slot] = if is_calm { slots.calm[slot] + frame / unit } else { 0.0 };
        longest = longest.max(slots.calm[slot]);
    }
    longest
}

/// Returns for each slot whether its sphere has not been calm for long enough, overlaps another
/// one, lies on a belt, moves with all that it touches, or is [`NEAR`] such a sphere.
fn near_restless(solver: &Solver) -> Vec<bool> {
    let Slots { sleeps, calm, position, .. } = &solver.slots;
    let is_restless = |(&sleeps, &calm): (&bool, &f64)| !sleeps && calm < PATIENCE;
    let mut is_near: Vec<bool> = sleeps.iter().zip(calm).map(is_restless).collect();
    for slab in solver.slabs.iter() {
        for (number, lane, _) in slab.batches.contacts() {
            let [first, second] = slab.slots_of(number, lane);
            let offset = solver.slots.offset([first, second]);
            let reach = (1.0 - DEEP) * (position[first].number() + position[second].number());
            if offset.length_squared() < reach * reach {
                (is_near[first], is_near[second]) = (true, true);
            }
        }
    }
    let mut bearing = Vec::new();
    for slab in solver.slabs.iter() {
        let on_belts =
            slab.surfaces.iter().filter(|it| it.belt != DVec3::ZERO && it.impulses.normal > 0.0);
        on_belts.for_each(|it| is_near[slab.start + it.slot as usize] = true);
        for (number, lane, _) in slab.batches.contacts() {
            if slab.batches.pairs[number].impulse[lane] > 0.0 {
                bearing.push(slab.slots_of(number, lane));
            }
        }
    }
    note_moving(&solver.slots, &bearing, solver.h, &mut is_near);
    spread(&mut is_near, &bearing, Some(NEAR));
    is_near
}

/// Spreads a flag from each sphere to its contacts, up to `far` contacts away, or through all that
/// are connected.
pub(crate) fn spread(flags: &mut Vec<bool>, contacts: &[[usize; 2]], far: Option<u32>) {
    let mut rounds = 0;
    while far.is_none_or(|most| rounds < most) {
        let before = flags.clone();
        for &[first, second] in contacts {
            if before[first] || before[second] {
                (flags[first], flags[second]) = (true, true);
            }
        }
        rounds += 1;
        if *flags == before {
            return;
        }
    }
}

/// Notes the contacts of spheres that fall asleep.
fn keep_contacts(solver: &mut Solver, falls: &[bool]) {
    let Solver { slots, slabs, dormant, h, .. } = solver;
    // Its loads before it slept count as present ones.
    dormant.retain(|contact| match contact.partner {
        Partner::Awake(other) => falls.get(other as usize) != Some(&true),
        _ => true,
    });
    for slab in slabs.iter() {
        for (number, lane, _) in slab.batches.contacts() {
            let impulses = slab.batches.impulses(number, lane);
            let both = slab.slots_of(number, lane);
            if !impulses.is_some() || !both.iter().any(|&slot| falls[slot]) {
                continue;
            }
            let [first, second] = both.map(|slot| slot as u32);
            let friction = slab.batches.frictions.get(number);
            let contact = Dormant {
                sphere: second,
                partner: Partner::Sphere(first),
                impulses,
                sliding: friction.map_or(0.0, |it| it.sliding[lane]),
                force: slab.batches.impulse(number, lane) / *h,
            };
            dormant.push(contact);
        }
        for contact in &slab.surfaces {
            let slot = slab.start + contact.slot as usize;
            let impulses = contact.kept();
            if impulses.is_some() && falls[slot] {
                dormant.push(Dormant {
                    sphere: slot as u32,
                    partner: Partner::Surface(contact.surface),
                    impulses,
                    sliding: contact.friction.sliding,
                    force: contact.impulse() / *h,
                });
            }
        }
    }
    dormant::renew(dormant, &slots.sleeps);
}
