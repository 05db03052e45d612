//! Motion under forces, without contacts.
//!
//! One file per scheme. Each says at which states it needs the acceleration, and makes of these the state
//! at the end of an interval (`scheme`). Spheres move one by one, but for where forces act between them:
//! there they go through the stages of the scheme side by side (`together`). Where forces damp motion too fast for an
//! explicit scheme, a sphere takes an implicit step (`damped`).

mod acceleration;
pub(crate) mod crossing;
pub(crate) mod damped;
mod explicit_euler;
pub(crate) mod field;
pub(crate) mod gauss_legendre;
pub(crate) mod gauss_radau;
mod implicit;
mod interpolate;
mod kinematics;
mod linear_system;
mod radau_tables;
mod runge_kutta_4;
mod scheme;
mod semi_implicit_euler;
mod together;
mod velocity_verlet;
mod work;

pub(crate) use acceleration::{acceleration, acceleration_alone};
pub(crate) use together::Scratch;
pub(crate) use work::work;

use glam::DVec3;

use acceleration::acceleration_at;
use explicit_euler::ExplicitEuler;
use kinematics::Kinematics;
use runge_kutta_4::RungeKutta4;
use scheme::Scheme;
use semi_implicit_euler::SemiImplicitEuler;
use velocity_verlet::VelocityVerlet;

use crate::bodies::Motion;
use crate::interval::Interval;
use crate::settings::Integrator;
use crate::system::System;

/// The sphere at `index` at the end of `interval`, where no forces act between spheres.
fn advance_one<S: Scheme>(
    system: &System,
    motion: &Motion,
    index: usize,
    interval: Interval,
) -> Kinematics {
    let Interval { time, h } = interval;
    let start = Kinematics::of(motion, index);
    let a = |t: f64, at: Kinematics| acceleration_at(system, index, at, time + t);
    damped::step_if_damped(system, index, start, DVec3::ZERO, interval)
        .unwrap_or_else(|| scheme::advance::<S>(start, h, a))
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
