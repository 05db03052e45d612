//! Changes of energy between two ticks of a zone.

use crate::report::EnergyAccount;

/// Changes of energy over a time in which velocities change steadily and positions along straight lines.
#[derive(Debug, Clone, Copy, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Changes {
    pub account: EnergyAccount,
    /// Kinetic energy of the changes of velocity \[J\].
    pub energy_of_changes: f64,
    /// Part of the account that is reported, 0 to 1.
    pub reported: f64,
}

impl Changes {
    /// Reports the changes up to a part of the time, 0 to 1. They grow linearly, as velocities do, whose energy is then
    /// less than that by a parabola.
    pub fn report(&mut self, part: f64, account: &mut EnergyAccount) {
        let part = part.max(self.reported);
        let missing = |part: f64| self.energy_of_changes * part * (1.0 - part);
        account.integration += missing(self.reported) - missing(part);
        *account += self.account.part(part - self.reported);
        self.reported = part;
    }
}
