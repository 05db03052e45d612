//! Energy balance of a run.

use carom::{EnergyAccount, Rule, World};
use carom_scene::scene::{Force, Scene};
use serde::Serialize;

/// Energy accounts of a run, as in JSON: the energy at the end is the energy at the start plus all
/// of these.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct EnergyBalance {
    /// Work of contacts \[J\]: energy lost by restitution and friction.
    contacts: f64,
    /// Work of moving colliders \[J\].
    colliders: f64,
    /// Work of the kicks of colliders \[J\].
    kicks: f64,
    /// Work of separating overlapping spheres \[J\].
    correction: f64,
    /// Energy of emitted spheres minus that of removed spheres \[J\].
    emission: f64,
    /// Change of energy in no other account \[J\]; `remainder_is` says where it comes from.
    remainder: f64,
    /// Origin of the remainder, in words.
    remainder_is: &'static str,
}

impl EnergyBalance {
    /// Creates the balance from the accounts and the total `change` of energy \[J\].
    pub fn new(account: EnergyAccount, change: f64, remainder_is: &'static str) -> Self {
        let EnergyAccount { contacts, colliders, kicks, correction, emission, .. } = account;
        let remainder = change - account.total();
        Self { contacts, colliders, kicks, correction, emission, remainder, remainder_is }
    }

    /// Lines of the summary. Zero entries are left out, except the first and the last.
    pub fn rows(&self) -> Vec<(&'static str, String)> {
        let entries = [
            ("  contacts", self.contacts, "taken by restitution and friction"),
            ("  colliders", self.colliders, "given by moving colliders"),
            ("  kicks", self.kicks, "given by colliders that kick"),
            ("  correction", self.correction, "given by the correction of overlaps"),
            ("  emission", self.emission, "of emitted balls, less those taken out"),
            ("  remainder", self.remainder, self.remainder_is),
        ];
        let is_shown = |&(name, energy, _): &(&str, f64, &str)| {
            energy != 0.0 || name == "  contacts" || name == "  remainder"
        };
        let row = |(name, energy, what)| (name, format!("{energy:+.3e} J {what}"));
        entries.into_iter().filter(is_shown).map(row).collect()
    }
}

/// Describes the origin of the energy that is in no account.
pub fn remainder_of(scene: &Scene, world: &World, edits: usize) -> &'static str {
    let has_potential = |force: &Force| {
        matches!(
            force,
            Force::Constant { .. }
                | Force::Gravity { .. }
                | Force::PointAttractor { .. }
                | Force::MutualGravity { .. }
                | Force::Buoyancy { .. }
        )
    };
    let is_linear = |force: &Force| matches!(force, Force::ViscousDrag { .. } | Force::Wind { .. });
    let is_damped = scene.springs.iter().any(|spring| spring.damping != 0.0);
    let (conserving, others): (Vec<_>, Vec<_>) =
        scene.forces.iter().partition(|force| has_potential(force));
    // Potentials jump at the faces of a periodic box.
    let jumps = world.settings().boundary.is_periodic() && !conserving.is_empty();
    if edits > 0 {
        return "by edits, forces without a potential, and errors of integration";
    }
    if others.is_empty() && !is_damped && !jumps {
        return "error of integration";
    }
    let is_closed_form = matches!(world.settings().rule, Rule::Exact(_))
        && scene.springs.is_empty()
        && scene.forces.iter().all(|force| {
            is_linear(force) || matches!(force, Force::Constant { .. } | Force::Gravity { .. })
        });
    if is_closed_form && !jumps {
        return "by drag";
    }
    "by forces without a potential, and error of integration"
}
