//! Sleep: spheres that have been at rest for a while, with all that they touch, are left alone until
//! something comes near.
//!
//! An island is what bearing contacts of spheres connect. It falls asleep as a whole, at the end of a
//! frame, and wakes as a whole, before something touches it.

use glam::DVec3;

use super::dormant::{Dormant, Partner};
use super::slots::{AWAKE, GONE, Slots};
use super::solver::Solver;
use super::sub_step::SubStep;

/// A sphere is calm below this part of the speed `sqrt(a r)` that it would have after falling through half
/// its radius.
const CALM: f64 = 0.02;
/// A spin is steady that a sub-step changes by less than this part of the speed of free fall over it: that
/// of a ball about the normal on which it lies, without spinning friction.
const STEADY: f64 = 1e-3;
/// Time that all spheres of an island are calm before it sleeps \[s\].
const PATIENCE: f64 = 0.5;
/// Islands are looked for once in so many frames: to find them costs as much as a sweep.
const FRAMES: u32 = 16;
/// A sphere that comes nearer than this part of the sum of radii touches.
const TOUCH: f64 = 1e-3;

/// Has islands fall asleep that have been calm for long enough, at the end of a frame of this length \[s\].
pub(super) fn fall_asleep(solver: &mut Solver, frame: f64) {
    if !solver.may_sleep {
        return;
    }
    let longest = note_calm(&mut solver.slots, frame, solver.h);
    solver.frames = (solver.frames + 1) % FRAMES;
    if longest < PATIENCE || solver.frames != 0 {
        return;
    }
    let islands = Islands::of(solver);
    let slots = &mut solver.slots;
    let mut calm = vec![f64::INFINITY; slots.len()];
    for slot in 0..slots.len() {
        let root = islands.root(slot);
        calm[root] = calm[root].min(slots.calm[slot]);
    }
    let mut has_changed = false;
    for slot in 0..slots.len() {
        let root = islands.root(slot);
        if slots.island[slot] == AWAKE && calm[root] >= PATIENCE {
            slots.island[slot] = slots.index[root];
            slots.velocity[slot] = slots.velocity[slot].with_vector(DVec3::ZERO);
            let slow = calm_speed_squared(slots, slot);
            if let Some(spin) = slots.spin.get_mut(slot)
                && spin.vector().length_squared() < slow
            {
                *spin = spin.with_vector(DVec3::ZERO);
            }
            has_changed = true;
        }
    }
    if has_changed {
        keep_contacts(solver);
        solver.is_stale = true;
    }
}

/// Square of the speed below which a sphere is calm \[m²/s²\].
fn calm_speed_squared(slots: &Slots, slot: usize) -> f64 {
    let acceleration = slots.acceleration[slot].vector().length();
    CALM * CALM * acceleration * slots.position[slot].number()
}

/// Whether a sphere has no spin that does anything: it is slow, or steady over a sub-step of `h` \[s\].
fn turns_calmly(slots: &Slots, slot: usize, h: f64) -> bool {
    let (Some(spin), Some(before)) = (slots.spin.get(slot), slots.spin_before.get(slot)) else {
        return true;
    };
    let change = (spin.vector() - before.vector()).length();
    let steady = STEADY * h * slots.acceleration[slot].vector().length();
    spin.vector().length_squared() < calm_speed_squared(slots, slot) || change < steady
}

/// Counts for how long each sphere has been calm \[s\], in sub-steps of `h` \[s\]. Gives the longest time of
/// one that is awake.
fn note_calm(slots: &mut Slots, frame: f64, h: f64) -> f64 {
    let mut longest = 0.0_f64;
    for slot in 0..slots.len() {
        if slots.island[slot] != AWAKE {
            continue;
        }
        let speed_squared = slots.velocity[slot].vector().length_squared();
        let is_calm = speed_squared < calm_speed_squared(slots, slot)
            && turns_calmly(slots, slot, h)
            && slots.bears[slot];
        slots.calm[slot] = if is_calm { slots.calm[slot] + frame } else { 0.0 };
        longest = longest.max(slots.calm[slot]);
    }
    longest
}

/// Notes the contacts of spheres that sleep.
fn keep_contacts(solver: &mut Solver) {
    let Solver { slots, slabs, dormant, .. } = solver;
    for slab in slabs.iter() {
        for (number, lane, [first, second]) in slab.batches.contacts() {
            let impulses = slab.batches.impulses(number, lane);
            let [first, second] = [first, second].map(|slot| slab.start + slot as usize);
            if impulses.is_some() && slots.island[first] != AWAKE && slots.island[second] != AWAKE {
                let (sphere, partner) = (slots.id[second], Partner::Sphere(slots.id[first]));
                let friction = slab.batches.frictions.get(number);
                let sliding = friction.map_or(0.0, |it| it.sliding[lane]);
                dormant.push(Dormant { sphere, partner, impulses, sliding });
            }
        }
        for contact in &slab.surfaces {
            let slot = slab.start + contact.slot as usize;
            if contact.kept().is_some() && slots.island[slot] != AWAKE {
                let partner = Partner::Surface(contact.surface);
                let (sphere, impulses) = (slots.id[slot], contact.kept());
                let sliding = contact.friction.sliding;
                dormant.push(Dormant { sphere, partner, impulses, sliding });
            }
        }
    }
}

/// Wakes islands that something is about to touch in this sub-step.
pub(super) fn wake_touched(solver: &mut Solver, sub_step: &SubStep) {
    let Slots { position, velocity, island, calm, .. } = &solver.slots;
    let mut touched: Vec<u32> = Vec::new();
    for &[sleeper, other] in &solver.watched {
        let [sleeper, other] = [sleeper, other].map(|slot| slot as usize);
        if calm[other] > 0.0 {
            // Near, but at rest: two that only just touch would wake each other in turn.
            continue;
        }
        let radius_sum = position[sleeper].number() + position[other].number();
        let offset = position[other].vector() - position[sleeper].vector();
        let way = sub_step.h * (velocity[other].vector() - velocity[sleeper].vector());
        // The nearest point of the way.
        let length_squared = way.length_squared();
        let along = if length_squared > 0.0 {
            (-offset.dot(way) / length_squared).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let reach = radius_sum * (1.0 + TOUCH);
        if (offset + along * way).length_squared() < reach * reach {
            touched.push(island[sleeper]);
        }
    }
    wake(solver, touched);
}

/// Wakes islands that something has moved.
pub(super) fn wake_moved(solver: &mut Solver) {
    let Slots { velocity, island, .. } = &solver.slots;
    let islands = velocity.iter().zip(island).filter(|(row, _)| row.vector() != DVec3::ZERO);
    let moved = islands.map(|(_, &island)| island).filter(|&island| island != AWAKE).collect();
    wake(solver, moved);
}

/// Wakes islands of which a sphere was taken out of the world: it may have borne others.
pub(super) fn wake_incomplete(solver: &mut Solver) {
    let Slots { index, island, .. } = &solver.slots;
    let islands = index.iter().zip(island).filter(|(index, _)| **index == GONE);
    let incomplete = islands.map(|(_, &island)| island).filter(|&island| island != AWAKE).collect();
    wake(solver, incomplete);
}

/// Wakes all islands.
pub(super) fn wake_all(solver: &mut Solver) {
    let all = solver.slots.island.iter().copied().filter(|&island| island != AWAKE).collect();
    wake(solver, all);
}

/// Wakes islands.
fn wake(solver: &mut Solver, mut islands: Vec<u32>) {
    if islands.is_empty() {
        return;
    }
    islands.sort_unstable();
    islands.dedup();
    let Slots { island, calm, .. } = &mut solver.slots;
    for (island, calm) in island.iter_mut().zip(calm) {
        if islands.binary_search(island).is_ok() {
            (*island, *calm) = (AWAKE, 0.0);
        }
    }
    solver.is_stale = true;
}

/// Islands of slots, as a forest: each slot leads to another one of its island, the root to itself.
struct Islands(Vec<u32>);

impl Islands {
    /// What bearing contacts connect. Of two roots the one in the smaller slot remains.
    fn of(solver: &Solver) -> Self {
        let mut islands = Self((0..solver.slots.len() as u32).collect());
        for slab in solver.slabs.iter() {
            for (number, lane, slots) in slab.batches.contacts() {
                if slab.batches.pairs[number].impulse[lane] > 0.0 {
                    let [first, second] =
                        slots.map(|slot| islands.shorten(slab.start + slot as usize));
                    islands.0[first.max(second)] = first.min(second) as u32;
                }
            }
        }
        for slot in 0..islands.0.len() {
            islands.0[slot] = islands.shorten(slot) as u32;
        }
        islands
    }

    /// The root of a slot; the way there is half as long from now on.
    fn shorten(&mut self, mut slot: usize) -> usize {
        while self.0[slot] as usize != slot {
            let next = self.0[slot] as usize;
            self.0[slot] = self.0[next];
            slot = next;
        }
        slot
    }

    /// The root of a slot.
    fn root(&self, slot: usize) -> usize {
        self.0[slot] as usize
    }
}
