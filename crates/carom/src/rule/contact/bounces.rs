//! Where spheres that bounce within a sub-step come to.

use glam::DVec3;

use super::batch;
use super::row::Row;
use super::slab::{Slab, Slabs};
use super::slots::Slots;
use super::solver::{Bounce, Solver};
use super::sub_step::SubStep;
use super::surfaces::Place;
use super::swept::FAR;
use crate::contact_time;
use crate::flight::Flight;

/// A change of velocity is that of a bounce alone up to this part of it.
const ROUNDING: f64 = 1e-9;

/// A bounce of a sphere off one body.
struct OneBounce {
    slot: usize,
    /// The other sphere, if it is one.
    other: Option<usize>,
    /// On the sphere \[N s\].
    impulse: DVec3,
    /// When in the sub-step \[s\].
    time: f64,
}

/// Notes where spheres that bounce come to.
///
/// One that nothing else touches in the sub-step moves until its bounce as if nothing were there. Any other
/// moves by its last velocity. Contacts know nothing of surfaces that a sphere comes to after a bounce: one
/// that goes far stops at the first of them, and bounces off it in the next sub-step.
pub(super) fn note(solver: &mut Solver, sub_step: &SubStep) {
    let Solver { slots, slabs, bounces, places, has_other_forces, .. } = solver;
    let mut all = Vec::new();
    for slab in slabs.iter() {
        of_pairs(slots, slab, &mut all);
        of_surfaces(slots, slab, &mut all);
    }
    all.sort_by_key(|bounce| bounce.slot);
    bounces.clear();
    for of_sphere in all.chunk_by(|first, second| first.slot == second.slot) {
        let slot = of_sphere[0].slot;
        let own = match of_sphere {
            [bounce] if !*has_other_forces => alone(slots, bounce, sub_step),
            _ => None,
        };
        let leg = own.as_ref().map_or_else(|| Leg::straight(slots, slot, sub_step), |own| own.leg);
        let stopped = leg.first_met(slots, slabs, places).map(|time| {
            let [start, velocity] = [slots.position[slot], slots.velocity[slot]].map(Row::vector);
            let (end, velocity_there) = leg.flight.after(time);
            let shift = end - start - sub_step.h * velocity;
            let is_alone = own.is_some();
            Bounce { slot: slot as u32, shift, velocity: velocity_there, is_alone }
        });
        bounces.extend(stopped.or(own.map(|own| own.bounce)));
    }
}

fn of_pairs(slots: &Slots, slab: &Slab, bounces: &mut Vec<OneBounce>) {
    for (number, lane, approach) in slab.batches.impacts() {
        let Some(impulse) = slab.batches.bounce(number, lane, approach) else { continue };
        let [first, second] = slab.slots_of(number, lane);
        let radius_sum = slab.batches.approaches[number].radius_sum[lane];
        let offset = slots.position[second].vector() - slots.position[first].vector();
        let normal = DVec3::from_array(batch::get(&slab.batches.pairs[number].normal, lane));
        let time = (offset.dot(normal) - radius_sum).max(0.0) / approach;
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

/// A bounce of a sphere that nothing else touches in the sub-step, nor the other sphere.
struct Alone {
    bounce: Bounce,
    /// Its way from the bounce on.
    leg: Leg,
}

/// How a sphere bounces; `None` if something else changed its velocity, or the other sphere's. If it does after
/// a time t, with the impulse P, it is `t P / m` short of where its last velocity takes it in the whole sub-step.
fn alone(slots: &Slots, bounce: &OneBounce, sub_step: &SubStep) -> Option<Alone> {
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
    let leg = Leg { slot, flight, duration: sub_step.h - time };
    Some(Alone { bounce: Bounce { slot: slot as u32, shift, velocity, is_alone: true }, leg })
}

/// The change of velocity by an impulse \[m/s\]; `None` if something else changed the sphere's, too.
fn own_change(slots: &Slots, slot: usize, impulse: DVec3, sub_step: &SubStep) -> Option<DVec3> {
    let own = slots.velocity[slot].number() * impulse;
    let change = slots.velocity[slot].vector() - slots.accelerated(slot, sub_step.h);
    let most = (ROUNDING * ROUNDING) * change.length_squared();
    ((change - own).length_squared() <= most).then_some(own)
}

/// The last part of a sphere's way in a sub-step, on which no contact waits for it.
#[derive(Clone, Copy)]
struct Leg {
    slot: usize,
    flight: Flight,
    /// \[s\]
    duration: f64,
}

impl Leg {
    /// The whole way of a sphere that moves by its last velocity.
    fn straight(slots: &Slots, slot: usize, sub_step: &SubStep) -> Self {
        let [position, velocity] = [slots.position[slot], slots.velocity[slot]].map(Row::vector);
        let flight = Flight { position, velocity, acceleration: DVec3::ZERO, drag_rate: 0.0 };
        Self { slot, flight, duration: sub_step.h }
    }

    /// When the sphere comes to a surface at rest \[s\]; `None` also if it goes too little to come past one.
    fn first_met(&self, slots: &Slots, slabs: &Slabs, places: &[Place]) -> Option<f64> {
        let Self { slot, flight, duration } = self;
        let radius = slots.position[*slot].number();
        if duration * flight.velocity.length() <= FAR * radius {
            return None;
        }
        let times = slabs.free_surfaces_of(*slot).filter_map(|surface| {
            let (form, motion) = &places[surface as usize];
            let meets = || contact_time::sphere_surface(flight, radius, form, motion, *duration);
            motion.is_at_rest().then(meets)?
        });
        times.min_by(f64::total_cmp)
    }
}
