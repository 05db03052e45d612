//! What became of the energy in a run.

use carom::{EnergyAccount, Rule, World};
use carom_scene::scene::{Force, Scene};
use serde::Serialize;

/// The energy accounts of all frames of a run, as JSON has them: the energy at the end is that at the start and
/// all of these.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct EnergyBalance {
    /// Work of contacts \[J\]: what restitution and friction took.
    contacts: f64,
    /// Work of moving colliders \[J\].
    colliders: f64,
    /// Work of moving spheres out of what they overlap \[J\].
    correction: f64,
    /// Energy of emitted spheres, less that of those taken out \[J\].
    emission: f64,
    /// What is left \[J\]: see `remainder_is`.
    remainder: f64,
    /// What the remainder is, in words.
    remainder_is: &'static str,
}

impl EnergyBalance {
    /// The balance of a run with these accounts, and this change of energy \[J\].
    pub fn new(account: EnergyAccount, change: f64, remainder_is: &'static str) -> Self {
        let EnergyAccount { contacts, colliders, correction, emission, .. } = account;
        let remainder = change - account.total();
        Self { contacts, colliders, correction, emission, remainder, remainder_is }
    }

    /// The lines of a summary. Entries that are zero are left out, but for the first and the last.
    pub fn rows(&self) -> Vec<(&'static str, String)> {
        let entries = [
            ("  contacts", self.contacts, "taken by restitution and friction"),
            ("  colliders", self.colliders, "given by moving colliders"),
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

/// What of the change of energy in a run is in no account, in words.
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
    // Across the faces of a box potentials jump.
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
