//! Motion under forces, without contacts.
//!
//! One file per scheme. Each is a free function from the state at the start of an interval and
//! an acceleration `a(t, state)` (`t` \[s\] from the start of the interval) to the state at its end.

mod explicit_euler;
mod kinematics;
mod runge_kutta_4;
mod semi_implicit_euler;
mod velocity_verlet;

use glam::DVec3;
use kinematics::Kinematics;

use crate::bodies::Motion;
use crate::forces::{self, SphereState};
use crate::interval::Interval;
use crate::settings::Integrator;
use crate::system::System;

/// Acceleration \[m/s²\] of the sphere at `index` in the state `motion` at `time` \[s\].
pub(crate) fn acceleration(system: &System, motion: &Motion, index: usize, time: f64) -> DVec3 {
    let at = Kinematics { position: motion.position[index], velocity: motion.velocity[index] };
    acceleration_at(system, index, at, time)
}

fn acceleration_at(system: &System, index: usize, at: Kinematics, time: f64) -> DVec3 {
    let Kinematics { position, velocity } = at;
    let (radius, mass) = (system.spheres.radius[index], system.spheres.mass[index]);
    let state = SphereState { position, velocity, radius, mass };
    let common = forces::total(system.forces, &state, time) / mass;
    system.spheres.applied_acceleration(index).map_or(common, |own| common + own)
}

/// Position \[m\] and velocity \[m/s\] of the sphere at `index` at the end of `interval`, by an
/// `integrator` from its state in `start` at the interval's beginning.
pub(crate) fn advance(
    integrator: Integrator,
    system: &System,
    start: &Motion,
    index: usize,
    interval: Interval,
) -> (DVec3, DVec3) {
    let Interval { time, h } = interval;
    let a = |t: f64, at: Kinematics| acceleration_at(system, index, at, time + t);
    let from = Kinematics { position: start.position[index], velocity: start.velocity[index] };
    let end = match integrator {
        Integrator::SemiImplicitEuler => semi_implicit_euler::advance(from, h, a),
        Integrator::ExplicitEuler => explicit_euler::advance(from, h, a),
        Integrator::VelocityVerlet => velocity_verlet::advance(from, h, a),
        Integrator::RungeKutta4 => runge_kutta_4::advance(from, h, a),
    };
    (end.position, end.velocity)
}
