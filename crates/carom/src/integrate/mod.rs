//! Motion under forces, without contacts.
//!
//! One file per scheme. Each says at which states it needs the acceleration, and makes of these the state
//! at the end of an interval (`scheme`). Spheres move one by one, but for where forces act between them:
//! there they go through the stages of the scheme side by side (`together`).

mod explicit_euler;
mod kinematics;
mod runge_kutta_4;
mod scheme;
mod semi_implicit_euler;
mod together;
mod velocity_verlet;

pub(crate) use together::Scratch;

use explicit_euler::ExplicitEuler;
use glam::DVec3;
use kinematics::Kinematics;
use runge_kutta_4::RungeKutta4;
use scheme::Scheme;
use semi_implicit_euler::SemiImplicitEuler;
use velocity_verlet::VelocityVerlet;

use crate::bodies::Motion;
use crate::forces::{self, SphereState};
use crate::interval::Interval;
use crate::settings::Integrator;
use crate::system::System;

/// Acceleration \[m/s²\] of the sphere at `index` in the state `motion` at `time` \[s\].
///
/// Where forces act between spheres, all of them are evaluated.
pub(crate) fn acceleration(system: &System, motion: &Motion, index: usize, time: f64) -> DVec3 {
    let alone = acceleration_at(system, index, Kinematics::of(motion, index), time);
    if !system.has_interactions() {
        return alone;
    }
    let mut between = Vec::new();
    system.forces_between([&motion.position, &motion.velocity], time, &mut between);
    alone + between[index] / system.spheres.mass[index]
}

/// Acceleration \[m/s²\] of a sphere with this centre \[m\] and velocity \[m/s\], without the forces between
/// spheres.
pub(crate) fn acceleration_alone(
    system: &System,
    index: usize,
    (position, velocity): (DVec3, DVec3),
    time: f64,
) -> DVec3 {
    acceleration_at(system, index, Kinematics { position, velocity }, time)
}

fn acceleration_at(system: &System, index: usize, at: Kinematics, time: f64) -> DVec3 {
    let Kinematics { position, velocity } = at;
    let (radius, mass) = (system.spheres.radius[index], system.spheres.mass[index]);
    let state = SphereState { position, velocity, radius, mass };
    let common = forces::total(system.forces, &state, time) / mass;
    system.spheres.applied_acceleration(index).map_or(common, |own| common + own)
}

/// The sphere at `index` at the end of `interval`, where no forces act between spheres.
fn advance_one<S: Scheme>(
    system: &System,
    motion: &Motion,
    index: usize,
    interval: Interval,
) -> Kinematics {
    let Interval { time, h } = interval;
    let a = |t: f64, at: Kinematics| acceleration_at(system, index, at, time + t);
    scheme::advance::<S>(Kinematics::of(motion, index), h, a)
}

/// Moves spheres over `interval` by an `integrator`. Where forces act between spheres, all of them move.
pub(crate) fn advance(
    integrator: Integrator,
    system: &System,
    motion: &mut Motion,
    spheres: impl Iterator<Item = u32>,
    interval: Interval,
    scratch: &mut Scratch,
) {
    let advance = match integrator {
        Integrator::SemiImplicitEuler => advance_by::<SemiImplicitEuler>,
        Integrator::ExplicitEuler => advance_by::<ExplicitEuler>,
        Integrator::VelocityVerlet => advance_by::<VelocityVerlet>,
        Integrator::RungeKutta4 => advance_by::<RungeKutta4>,
    };
    advance(system, motion, spheres, interval, scratch);
}

fn advance_by<S: Scheme>(
    system: &System,
    motion: &mut Motion,
    spheres: impl Iterator<Item = u32>,
    interval: Interval,
    scratch: &mut Scratch,
) {
    if system.has_interactions() {
        return together::advance::<S>(system, motion, interval, scratch);
    }
    for sphere in spheres {
        let index = sphere as usize;
        advance_one::<S>(system, motion, index, interval).write(motion, index);
    }
}
