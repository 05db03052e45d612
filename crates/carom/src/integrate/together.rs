//! Motion of all spheres side by side, where forces act between them.

use glam::DVec3;

use super::acceleration::acceleration_at;
use super::damped;
use super::kinematics::Kinematics;
use super::scheme::{MOST_STAGES, Scheme};
use crate::bodies::Motion;
use crate::interval::Interval;
use crate::system::System;

/// Working memory, with a place for each sphere.
#[derive(Debug, Clone, Default)]
pub(crate) struct Scratch {
    /// States at the stage at work.
    position: Vec<DVec3>,
    velocity: Vec<DVec3>,
    /// Forces between spheres there \[N\].
    force: Vec<DVec3>,
    /// The same at the start \[N\].
    first_force: Vec<DVec3>,
    /// Accelerations at the stages so far \[m/s²\].
    known: Vec<[DVec3; MOST_STAGES]>,
}

/// Moves all spheres over an interval, stage by stage: at each the forces between spheres follow from where
/// all of them are there.
pub(super) fn advance<S: Scheme>(
    system: &System,
    motion: &mut Motion,
    interval: Interval,
    scratch: &mut Scratch,
) {
    let Interval { time, h } = interval;
    let count = motion.position.len();
    let Scratch { position, velocity, force, first_force, known } = scratch;
    known.clear();
    known.resize(count, [DVec3::ZERO; MOST_STAGES]);
    position.resize(count, DVec3::ZERO);
    velocity.resize(count, DVec3::ZERO);
    for number in 0..S::STAGES {
        let mut t = 0.0;
        for (i, known) in known.iter().enumerate() {
            let (stage_time, at) = S::stage(Kinematics::of(motion, i), h, &known[..number]);
            (t, position[i], velocity[i]) = (stage_time, at.position, at.velocity);
        }
        system.forces_between([position, velocity], time + t, force);
        if number == 0 {
            first_force.clone_from(force);
        }
        for (i, known) in known.iter_mut().enumerate() {
            let at = Kinematics { position: position[i], velocity: velocity[i] };
            let alone = acceleration_at(system, i, at, time + t);
            known[number] = alone + force[i] / system.spheres.mass[i];
        }
    }
    for (i, known) in known.iter().enumerate() {
        let (start, between) = (Kinematics::of(motion, i), first_force[i] / system.spheres.mass[i]);
        damped::step_if_damped(system, i, start, between, interval)
            .unwrap_or_else(|| S::end(start, h, &known[..S::STAGES]))
            .write(motion, i);
    }
}
