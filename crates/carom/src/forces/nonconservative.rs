//! Nonconservative forces: those whose potential energy does not account for all of their work.

use std::sync::Arc;

use glam::DVec3;

use super::{Force, LinearForce, SphereState, linear_form, sum_of_linear};
use crate::numbered::Numbered;

/// The nonconservative forces, in the order in which they entered the world.
fn nonconservative(forces: &Numbered<Arc<dyn Force>>) -> impl Iterator<Item = &dyn Force> {
    forces.iter().map(|(_, force)| &**force).filter(|force| !force.is_conservative())
}

/// The conservative forces, in the order in which they entered the world.
fn conservative(forces: &Numbered<Arc<dyn Force>>) -> impl Iterator<Item = &dyn Force> {
    forces.iter().map(|(_, force)| &**force).filter(|force| force.is_conservative())
}

/// Whether all forces are conservative.
pub(crate) fn are_conservative(forces: &Numbered<Arc<dyn Force>>) -> bool {
    nonconservative(forces).next().is_none()
}

/// Sum of the nonconservative forces \[N\] on a sphere.
pub(crate) fn total_nonconservative(
    forces: &Numbered<Arc<dyn Force>>,
    sphere: &SphereState,
    time: f64,
) -> DVec3 {
    nonconservative(forces).fold(DVec3::ZERO, |sum, force| sum + force.on(sphere, time))
}

/// Sum of those nonconservative forces that are linear for spheres of this `radius` \[m\] and `mass` \[kg\], and
/// whether there are no others.
pub(crate) fn nonconservative_linear(
    forces: &Numbered<Arc<dyn Force>>,
    radius: f64,
    mass: f64,
) -> (LinearForce, bool) {
    sum_of_linear(nonconservative(forces), radius, mass)
}

/// Sum of the nonconservative forces \[N\] on a sphere that are not linear.
pub(crate) fn nonconservative_others(
    forces: &Numbered<Arc<dyn Force>>,
    sphere: &SphereState,
    time: f64,
) -> DVec3 {
    nonconservative(forces)
        .filter(|force| linear_form(*force, sphere.radius, sphere.mass).is_none())
        .fold(DVec3::ZERO, |sum, force| sum + force.on(sphere, time))
}

/// Potential energy \[J\] of a sphere in the conservative forces.
pub(crate) fn conservative_potential(
    forces: &Numbered<Arc<dyn Force>>,
    sphere: &SphereState,
    time: f64,
) -> f64 {
    conservative(forces).map(|force| force.potential_energy(sphere, time)).sum()
}

/// Sum of the conservative forces \[N\] on a sphere.
pub(crate) fn total_conservative(
    forces: &Numbered<Arc<dyn Force>>,
    sphere: &SphereState,
    time: f64,
) -> DVec3 {
    conservative(forces).fold(DVec3::ZERO, |sum, force| sum + force.on(sphere, time))
}

/// Potential energy \[J\] of a sphere in the nonconservative forces: it accounts for a part of their work.
pub(crate) fn nonconservative_potential(
    forces: &Numbered<Arc<dyn Force>>,
    sphere: &SphereState,
    time: f64,
) -> f64 {
    nonconservative(forces).map(|force| force.potential_energy(sphere, time)).sum()
}
