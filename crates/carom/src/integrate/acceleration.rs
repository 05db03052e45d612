//! Acceleration of one sphere.

use glam::DVec3;

use super::kinematics::Kinematics;
use crate::bodies::Motion;
use crate::forces::{self, SphereState};
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

pub(super) fn acceleration_at(system: &System, index: usize, at: Kinematics, time: f64) -> DVec3 {
    let Kinematics { position, velocity } = at;
    let (radius, mass) = (system.spheres.radius[index], system.spheres.mass[index]);
    let state = SphereState { position, velocity, radius, mass };
    let common = forces::total(system.forces, &state, time) / mass;
    system.spheres.applied_acceleration(index).map_or(common, |own| common + own)
}
