//! Work of nonconservative forces over an interval.
//!
//! The work is `h Σ b F·v` over the stages of a scheme, with their weights b. Schemes of the first and second order
//! change the velocity by `h Σ b F / m`: with the mean of the first and the last velocity for v, the work is the change
//! of the kinetic energy. In an implicit step it is the change of the kinetic energy, less the work of all other forces.

use glam::DVec3;

use super::acceleration::acceleration_at;
use super::damped;
use super::kinematics::Kinematics;
use super::scheme::{MOST_STAGES, Scheme};
use super::{ExplicitEuler, RungeKutta4, SemiImplicitEuler, VelocityVerlet};
use crate::bodies::Motion;
use crate::force_work::ForceWork;
use crate::forces::{self, SphereState};
use crate::interval::Interval;
use crate::settings::Integrator;
use crate::system::System;

/// Work of the nonconservative forces on spheres that an `integrator` moves over `interval` from the states in
/// `motion`. With forces between spheres, the list must contain all of them, or none.
pub(crate) fn work(
    integrator: Integrator,
    system: &System,
    motion: &Motion,
    spheres: impl Iterator<Item = u32>,
    interval: Interval,
) -> ForceWork {
    if !system.has_nonconservative_forces() {
        return ForceWork::default();
    }
    let spheres: Vec<Way> = spheres.map(|sphere| Way::begin(motion, sphere as usize)).collect();
    if spheres.is_empty() {
        return ForceWork::default();
    }
    match integrator {
        Integrator::SemiImplicitEuler => work_by::<SemiImplicitEuler>(system, spheres, interval),
        Integrator::ExplicitEuler => work_by::<ExplicitEuler>(system, spheres, interval),
        Integrator::VelocityVerlet => work_by::<VelocityVerlet>(system, spheres, interval),
        Integrator::RungeKutta4 => work_by::<RungeKutta4>(system, spheres, interval),
    }
}

/// A sphere on its way through the stages of a scheme.
struct Way {
    index: usize,
    start: Kinematics,
    /// State at the current stage.
    at: Kinematics,
    /// Accelerations at the stages so far \[m/s²\].
    known: [DVec3; MOST_STAGES],
    /// Nonconservative forces at the stages so far \[N\].
    forces: [DVec3; MOST_STAGES],
    /// Velocities at the stages so far \[m/s\].
    velocities: [DVec3; MOST_STAGES],
    /// Accelerations at the start by all forces between spheres, and by conservative ones \[m/s²\].
    between: [DVec3; 2],
}

impl Way {
    fn begin(motion: &Motion, index: usize) -> Self {
        let start = Kinematics::of(motion, index);
        let none = [DVec3::ZERO; MOST_STAGES];
        let between = [DVec3::ZERO; 2];
        Self { index, start, at: start, known: none, forces: none, velocities: none, between }
    }
}

fn work_by<S: Scheme>(system: &System, mut spheres: Vec<Way>, interval: Interval) -> ForceWork {
    let Interval { time, h } = interval;
    let mut between = [Vec::new(), Vec::new()];
    for number in 0..S::STAGES {
        let mut t = 0.0;
        for way in &mut spheres {
            (t, way.at) = S::stage(way.start, h, &way.known[..number]);
        }
        if system.has_interactions() {
            let positions: Vec<DVec3> = spheres.iter().map(|way| way.at.position).collect();
            let velocities: Vec<DVec3> = spheres.iter().map(|way| way.at.velocity).collect();
            let states = [&positions[..], &velocities[..]];
            system.forces_between(states, time + t, &mut between[0]);
            system.nonconservative_forces_between(states, time + t, &mut between[1]);
        }
        for (place, way) in spheres.iter_mut().enumerate() {
            let Kinematics { position, velocity } = way.at;
            let (radius, mass) = (system.spheres.radius[way.index], system.spheres.mass[way.index]);
            let state = SphereState { position, velocity, radius, mass };
            let [all, own] =
                [0, 1].map(|which| between[which].get(place).copied().unwrap_or(DVec3::ZERO));
            if number == 0 {
                way.between = [all / mass, (all - own) / mass];
            }
            way.known[number] = acceleration_at(system, way.index, way.at, time + t) + all / mass;
            way.forces[number] =
                own + forces::total_nonconservative(system.forces, &state, time + t);
            way.velocities[number] = velocity;
        }
    }
    let mut work = ForceWork::default();
    for way in &spheres {
        let Way { index, start, between: [all, _], .. } = *way;
        match damped::step_if_damped(system, index, start, all, interval) {
            Some(end) => work += work_of_damped(system, way, end, interval),
            None => add_work_of_stages::<S>(system, way, h, &mut work),
        }
    }
    work
}

/// Adds the work on a sphere that goes through the stages of a scheme.
fn add_work_of_stages<S: Scheme>(system: &System, way: &Way, h: f64, work: &mut ForceWork) {
    let end = S::end(way.start, h, &way.known[..S::STAGES]);
    let mean = 0.5 * (way.start.velocity + end.velocity);
    let mut path = DVec3::ZERO;
    for number in 0..S::STAGES {
        let velocity = if S::ORDER > 2 { way.velocities[number] } else { mean };
        let part = h * S::WEIGHTS[number] * velocity;
        work.forces += way.forces[number].dot(part);
        path += part;
    }
    work.applied += applied_force(system, way.index).dot(path);
}

/// Work on a sphere that an implicit step takes to a state at the end of an interval.
fn work_of_damped(system: &System, way: &Way, end: Kinematics, interval: Interval) -> ForceWork {
    let (radius, mass) = (system.spheres.radius[way.index], system.spheres.mass[way.index]);
    let energy = |Kinematics { position, velocity }: Kinematics, time: f64| {
        let state = SphereState { position, velocity, radius, mass };
        let potential = forces::conservative_potential(system.forces, &state, time);
        0.5 * mass * velocity.length_squared() + potential
    };
    let gained = energy(end, interval.time + interval.h) - energy(way.start, interval.time);
    let path = end.position - way.start.position;
    let [_, conservative] = way.between;
    let applied = applied_force(system, way.index).dot(path);
    let forces = gained - mass * conservative.dot(path) - applied;
    ForceWork { forces, applied, ..ForceWork::default() }
}

/// The force applied to a single sphere \[N\].
fn applied_force(system: &System, index: usize) -> DVec3 {
    system.spheres.applied_force.get(index).copied().unwrap_or(DVec3::ZERO)
}
