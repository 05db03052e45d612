//! The work of steady shear in a sub-step.

use super::slots::row::Row;
use super::solver::Solver;
use crate::report::StepReport;
use crate::shear::Shear;

/// Energies beside which the work of shear is found.
///
/// With velocities c = v − γ y relative to the flow, Σ m c²/2 changes by the work of contacts and by that of shear, for
/// the flow at a sphere changes with its place, and impulses on two spheres act where the flow differs.
pub(super) struct Shearing {
    shear: Shear,
    /// Σ m c²/2 and the energy of spins \[J\].
    energy: f64,
    /// Work of contacts so far in the frame \[J\].
    contacts: f64,
}

impl Shearing {
    /// Begins a sub-step; `None` in a box without shear.
    pub fn begin(solver: &Solver, report: &StepReport) -> Option<Self> {
        let shear = solver.slots.shear?;
        Some(Self::now(shear, solver, report))
    }

    fn now(shear: Shear, solver: &Solver, report: &StepReport) -> Self {
        let contacts = report.energy_account.contacts;
        Self { shear, energy: energy(solver, shear), contacts }
    }

    /// Accounts for the work of shear once spheres are where the sub-step leads them.
    pub fn account(self, solver: &Solver, report: &mut StepReport) -> Self {
        let now = Self::now(self.shear, solver, report);
        report.energy_account.shear += now.energy - self.energy - (now.contacts - self.contacts);
        now
    }

    /// Accounts for spheres that were moved into faster or slower flow since.
    pub fn account_for_correction(self, solver: &Solver, report: &mut StepReport) {
        report.energy_account.correction += energy(solver, self.shear) - self.energy;
    }
}

/// Σ m c²/2 and the energy of spins \[J\].
fn energy(solver: &Solver, shear: Shear) -> f64 {
    let slots = &solver.slots;
    let twice = |vector: glam::DVec3, row: &Row| vector.length_squared() / row.number();
    let of_motion = slots.velocity.iter().zip(&slots.position).map(|(velocity, place)| {
        twice(velocity.vector() - shear.velocity_at(place.vector()), velocity)
    });
    let of_spin = slots.spin.iter().map(|spin| twice(spin.vector(), spin));
    0.5 * of_motion.chain(of_spin).sum::<f64>()
}
