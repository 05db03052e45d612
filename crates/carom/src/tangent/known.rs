//! Checks that the derivatives of a world are known.

use glam::DVec3;

use super::error::DerivativeError;
use crate::detect::instant::Instant;
use crate::forces;
use crate::settings::Rule;
use crate::world::World;

/// Returns an error if the derivatives of something in the world are not known.
pub(super) fn check(world: &World) -> Result<(), DerivativeError> {
    let Instant { system, .. } = world.now();
    let refuse = |what| Err(DerivativeError::Unsupported(what));
    if !matches!(system.settings.rule, Rule::Exact(_)) {
        return refuse("a rule other than `exact`");
    }
    if system.has_interactions() {
        return refuse("forces between spheres");
    }
    if !forces::are_linear(system.forces) {
        return refuse("forces that depend on places, or not linearly on velocities");
    }
    if world.emitters().len() > 0 {
        return refuse("emitters");
    }
    if world.colliders().any(|(_, collider)| !collider.motion.is_empty()) {
        return refuse("colliders that do not move steadily");
    }
    if world.colliders().any(|(_, collider)| collider.surface_velocity != DVec3::ZERO) {
        return refuse("colliders with a surface velocity");
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
    Ok(())
}
