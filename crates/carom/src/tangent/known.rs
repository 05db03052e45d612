//! Checks that the derivatives of a world are known.

use super::error::DerivativeError;
use crate::bodies::Motion;
use crate::detect::instant::Instant;
use crate::forces::{self, SphereState, Spring};
use crate::settings::Rule;
use crate::system::System;
use crate::world::World;

/// Returns an error if the derivatives of something in the world are not known.
pub(super) fn check(world: &World) -> Result<(), DerivativeError> {
    let Instant { system, motion, .. } = world.now();
    let refuse = |what| Err(DerivativeError::Unsupported(what));
    if !matches!(system.settings.rule, Rule::Exact(_)) {
        return refuse("a rule other than `exact`");
    }
    if system.holds_forces_of_all() {
        return refuse("forces between so many spheres that they are held for a time");
    }
    if !are_differentiable(&system, motion) {
        return refuse("a force without `derivatives`");
    }
    if system.settings.thermostat.is_some() {
        return refuse("a thermostat");
    }
    if system.settings.shear_rate != 0.0 {
        return refuse("a box in steady shear");
    }
    if system.settings.pair_potential.is_some() {
        return refuse("a pair potential");
    }
    if system.spheres.growth_speed.iter().any(|&speed| speed > 0.0) {
        return refuse("spheres that grow");
    }
    if !system.material_pairs.non_additivity.is_none() {
        return refuse("pairs of materials with a non-additivity");
    }
    Ok(())
}

/// Returns whether the derivatives of all forces are known, or not needed.
fn are_differentiable(system: &System, motion: &Motion) -> bool {
    let curved = curved(system);
    if !curved.contains(&true) {
        return true;
    }
    let states = [&motion.position[..], &motion.velocity[..]];
    let known_alone = (0..curved.len()).filter(|&place| curved[place]).all(|place| {
        let state = SphereState {
            position: motion.position[place],
            velocity: motion.velocity[place],
            radius: system.spheres.radius[place],
            mass: system.spheres.mass[place],
        };
        system.forces.iter().all(|(_, force)| force.derivatives(&state, 0.0).is_some())
    });
    let spheres = system.states(states);
    known_alone
        && system.interactions.is_none_or(|it| {
            it.list().all(|interaction| interaction.add_derivatives(&spheres, 0.0, &mut |_, _| {}))
        })
}

/// Returns whether forces without a closed form act on each sphere.
pub(super) fn curved(system: &System) -> Vec<bool> {
    let spheres = system.spheres;
    let is_curved = |place: usize| {
        let (radius, mass) = (spheres.radius[place], spheres.mass[place]);
        system.couples_all() || !forces::total_linear(system.forces, radius, mass).1
    };
    let mut all: Vec<bool> = (0..spheres.id.len()).map(is_curved).collect();
    for id in system.springs().flat_map(Spring::spheres) {
        if let Ok(place) = spheres.id.binary_search(&id) {
            all[place] = true;
        }
    }
    all
}
