//! Energy balance of a run.

use carom::{EnergyAccount, World};
use carom_scene::scene::{Force, Scene};
use serde::Serialize;

/// An error of integration above this part of the largest energy is more than rounding.
const ROUNDING: f64 = 1e-9;

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
    /// Work of growing spheres \[J\].
    growth: f64,
    /// Work of the steady shear of a periodic box \[J\].
    shear: f64,
    /// Energy that a thermostat added \[J\].
    thermostat: f64,
    /// Work of forces without a potential \[J\].
    forces: f64,
    /// Work of forces applied to single spheres \[J\].
    applied: f64,
    /// Work of separating overlapping spheres \[J\].
    correction: f64,
    /// Energy of emitted spheres minus that of removed spheres \[J\].
    emission: f64,
    /// Change of energy in no other account \[J\]: the error of the integration, and what
    /// `integration_is` names besides.
    integration: f64,
    /// Size of the integration error as a part of the largest energy: of all entries, and of
    /// kinetic and potential energy at the start and the end.
    integration_part: f64,
    /// Origin of the entry before, in words.
    integration_is: &'static str,
}

/// Energies of a world at one time.
#[derive(Debug, Clone, Copy)]
pub struct Energies {
    /// Sum of kinetic and potential energy \[J\].
    pub total: f64,
    /// Size of the larger one of the two \[J\].
    largest: f64,
}

impl Energies {
    pub fn of(world: &World) -> Self {
        let [kinetic, potential] = [world.kinetic_energy(), world.potential_energy()];
        Self { total: world.total_energy(), largest: kinetic.abs().max(potential.abs()) }
    }
}

impl EnergyBalance {
    /// Creates the balance from the accounts and the energies at the start and the end.
    pub fn new(
        account: EnergyAccount,
        [start, end]: [Energies; 2],
        integration_is: &'static str,
    ) -> Self {
        let EnergyAccount { contacts, colliders, kicks, growth, forces, applied, .. } = account;
        let EnergyAccount { shear, thermostat, correction, emission, .. } = account;
        let integration = end.total - start.total - (account.total() - account.integration);
        let of_bodies = [contacts, colliders, kicks, growth, shear, thermostat];
        let given = [forces, applied, correction, emission];
        let largest = of_bodies
            .iter()
            .chain(&given)
            .fold(start.largest.max(end.largest), |most, it| most.max(it.abs()));
        let integration_part = if integration == 0.0 { 0.0 } else { integration.abs() / largest };
        Self {
            contacts,
            colliders,
            kicks,
            growth,
            shear,
            thermostat,
            forces,
            applied,
            correction,
            emission,
            integration,
            integration_part,
            integration_is,
        }
    }

    /// Lines of the summary. Zero entries are left out, except the first and the last.
    pub fn rows(&self) -> Vec<(&'static str, String)> {
        let part = match self.integration_part {
            part if part > ROUNDING => format!(": {part:.1e} of the largest energy"),
            _ => String::new(),
        };
        let integration = format!("{}{part}", self.integration_is);
        let entries = [
            ("  contacts", self.contacts, "taken by restitution and friction"),
            ("  colliders", self.colliders, "given by moving colliders"),
            ("  kicks", self.kicks, "given by colliders that kick"),
            ("  growth", self.growth, "given by growing balls"),
            ("  shear", self.shear, "given by steady shear"),
            ("  thermostat", self.thermostat, "given by the thermostat"),
            ("  forces", self.forces, "given by forces without a potential"),
            ("  applied", self.applied, "given by forces applied to single balls"),
            ("  correction", self.correction, "given by the correction of overlaps"),
            ("  emission", self.emission, "of emitted balls, less those taken out"),
            ("  integration", self.integration, &integration),
        ];
        let is_shown = |&(name, energy, _): &(&str, f64, &str)| {
            energy != 0.0 || name == "  contacts" || name == "  integration"
        };
        let row = |(name, energy, what)| (name, format!("{energy:+.3e} J {what}"));
        entries.into_iter().filter(is_shown).map(row).collect()
    }
}

/// Describes the origin of the energy that is in no account of its own.
pub fn rest_of(scene: &Scene, world: &World, edits: usize) -> &'static str {
    // Potentials jump at the faces of a periodic box.
    let jumps =
        world.settings().boundary.is_periodic() && scene.forces.iter().any(Force::has_potential);
    match (edits > 0, jumps) {
        (true, _) => "by edits, and error of integration",
        (false, true) => "by potentials at the faces of the box, and error of integration",
        (false, false) => "error of integration",
    }
}
