//! Velocities gain what forces give them.

use glam::DVec3;

use super::row::Row;
use super::slots::{self, AWAKE, Run, Slots};
use super::solver::Solver;
use super::sub_step::SubStep;
use crate::forces::{self, SphereState};
use crate::interval::Interval;
use crate::settings::Contact;
use crate::system::System;

/// The world and the time on its clock \[s\], where some forces are not linear.
pub(super) type Others<'a> = Option<(&'a System<'a>, f64)>;

/// Changes velocities over a sub-step by all forces, `v' = (v + h a) / (1 + h c)` with the rate c of
/// linear drag, which so slows down and never turns round.
pub(super) fn accelerate(
    system: &System,
    parameters: Contact,
    frame: Interval,
    number: u32,
    solver: &mut Solver,
) -> SubStep {
    let h = frame.h / f64::from(parameters.sub_steps);
    let time = f64::from(number) * h;
    solver.h = h;
    let others = solver.has_other_forces.then_some((system, frame.time + time));
    solver.slabs.each(&mut solver.slots, |mut run, slab| {
        accelerate_run(&mut run, h, others);
        slab.found.energy = run.kinetic_energy();
    });
    solver.energy_before = solver.slabs.energy();
    let (fall, difference) = match solver.common_acceleration {
        Some(acceleration) => (h * acceleration.length(), 0.0),
        None => {
            let fall = largest_change(&solver.slots);
            (fall, 2.0 * fall)
        }
    };
    SubStep::new(time, h, [fall, difference])
}

/// The largest change of a velocity \[m/s\].
fn largest_change(slots: &Slots) -> f64 {
    let velocities = slots.velocity.iter().zip(&slots.before);
    let changes = velocities.map(|(now, before)| now.vector() - before.vector());
    changes.map(DVec3::length_squared).fold(0.0, f64::max).sqrt()
}

fn accelerate_run(run: &mut Run, h: f64, others: Others) {
    run.before.copy_from_slice(run.velocity);
    run.spin_before.copy_from_slice(run.spin);
    for slot in 0..run.velocity.len() {
        run.velocity[slot] = accelerated(run, slot, h, others);
    }
}

/// The velocity of a sphere at the end of the sub-step, without contacts. One that sleeps stays at rest.
pub(super) fn accelerated(run: &Run, slot: usize, h: f64, others: Others) -> Row {
    let (before, mut acceleration) = (run.before[slot], run.acceleration[slot]);
    if run.island[slot] != AWAKE {
        return before;
    }
    if let Some((system, time)) = others {
        let more = of_others(system, run.position[slot], before, time);
        acceleration = acceleration.with_vector(acceleration.vector() + more);
    }
    slots::accelerated(before, acceleration, h)
}

/// Acceleration \[m/s²\] by the forces that are not linear.
fn of_others(system: &System, position: Row, velocity: Row, time: f64) -> DVec3 {
    let (radius, inverse_mass) = (position.number(), velocity.number());
    let (position, velocity) = (position.vector(), velocity.vector());
    let state = SphereState { position, velocity, radius, mass: 1.0 / inverse_mass };
    forces::total_of_others(system.forces, &state, time) * inverse_mass
}
