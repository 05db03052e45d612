use crate::error::InvalidValue;
use crate::validate;

/// A thermostat: it changes the velocities of all spheres, at times that do not depend on frames, so that they keep a
/// temperature or gain energy. Only under the rule `exact`.
///
/// Temperatures are energies k T \[J\]: the mean kinetic energy of a sphere along an axis, times 2. Spins do not change.
///
/// ```
/// use carom::{DVec3, Settings, Sphere, Thermostat, World};
///
/// let thermostat = Thermostat::Rescale { interval: 0.5, temperature: 1.0 };
/// let mut world = World::new(Settings::default().with_thermostat(Some(thermostat)))?;
/// world.add_sphere(Sphere::new(DVec3::ZERO, 0.5).with_velocity(DVec3::X))?;
/// let added = world.step(0.5)?.energy_account.thermostat;
/// assert!((world.kinetic_energy() - 1.5).abs() < 1e-15);
/// assert!((added - 1.0).abs() < 1e-15);
/// # Ok::<(), carom::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Thermostat {
    /// Each sphere gets a velocity of Maxwell's distribution at random times (Andersen, J. Chem. Phys. 72, 2384
    /// (1980)).
    Andersen {
        /// Mean frequency of these times for a sphere \[1/s\], > 0. The times between them are exponentially distributed.
        frequency: f64,
        /// Temperature k T \[J\], > 0.
        temperature: f64,
        /// Seed of the times and velocities.
        seed: u64,
    },
    /// All velocities are multiplied by one factor, so that their kinetic temperature is that of the thermostat
    /// (Woodcock, Chem. Phys. Lett. 10, 257 (1971)).
    Rescale {
        /// Time from one change to the next \[s\], > 0.
        interval: f64,
        /// Temperature k T \[J\], > 0: two thirds of the mean kinetic energy of a sphere.
        temperature: f64,
    },
    /// White noise: normally distributed changes of all velocities, without change of the total momentum. It drives a
    /// granular gas (van Noije and Ernst, Granular Matter 1, 57 (1998)).
    WhiteNoise {
        /// Time from one change to the next \[s\], > 0.
        interval: f64,
        /// Strength ξ₀² \[m²/s³\], > 0: the variance that a component of velocity gains in a second.
        strength: f64,
        /// Seed of the changes.
        seed: u64,
    },
}

/// Largest number of intervals from time 0 on, with which each has a number of its own.
const MOST_INTERVALS: f64 = 9_007_199_254_740_992.0;
/// Largest number of intervals in a step: more take longer than anyone waits.
const MOST_PER_STEP: f64 = 1e6;

impl Thermostat {
    /// Time from one change to the next, or its mean for a sphere \[s\].
    pub(crate) fn interval(self) -> f64 {
        match self {
            Self::Andersen { frequency, .. } => 1.0 / frequency,
            Self::Rescale { interval, .. } | Self::WhiteNoise { interval, .. } => interval,
        }
    }

    pub(super) fn validate(self) -> Result<(), InvalidValue> {
        let [first, second] = match self {
            Self::Andersen { frequency, temperature, .. } => {
                [("frequency", frequency), ("temperature", temperature)]
            }
            Self::Rescale { interval, temperature } => {
                [("interval", interval), ("temperature", temperature)]
            }
            Self::WhiteNoise { interval, strength, .. } => {
                [("interval", interval), ("strength", strength)]
            }
        };
        validate::positive(first.0, first.1)?;
        validate::positive(second.0, second.1)?;
        validate::positive("interval", self.interval())
    }

    /// Returns an error for a step of `h` \[s\] up to `end` \[s\] with more intervals than have exact numbers.
    pub(crate) fn check_step(self, h: f64, end: f64) -> Result<(), InvalidValue> {
        let interval = self.interval();
        let are_few = h / interval <= MOST_PER_STEP && end.abs() / interval <= MOST_INTERVALS;
        let requirement =
            "such that a step has at most a million intervals, or 1/frequency, of its thermostat";
        validate::require(are_few, "thermostat", requirement, format!("one of {interval:e} s"))
    }
}
