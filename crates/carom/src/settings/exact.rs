use super::{ImpactLaw, Zones};
use crate::error::InvalidValue;
use crate::validate;

/// Parameters of the rule `exact`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Exact {
    /// How impacts at one instant in one group of touching bodies are answered.
    pub impact_law: ImpactLaw,
    /// Least duration of a contact \[s\], > 0. Two bodies that would be back in contact sooner, under the forces
    /// that press them together, stay in contact. An impact of two spheres that were both hit within that time is
    /// answered with the restitution 0, unless it is elastic. So no sequence of ever shorter bounces stops the
    /// clock. A contact lasts longer where bounces of that length cannot be resolved:
    /// `docs/physics/persistent-contacts.md`, "Contact duration".
    pub contact_duration: f64,
    /// Largest work of one sphere in a frame: its impacts, other events of its flight, and the work of its groups,
    /// in units of an impact. A sphere with more joins a stepped zone, or, without zones, ends the step with an
    /// error.
    pub max_impacts: u32,
    /// Whether spheres in contact that take too much work are stepped.
    pub zones: Zones,
    /// Largest work of the groups of one sphere in a tick, in contacts times iterations of a solver. A group with
    /// more joins a stepped zone.
    pub zone_budget: u32,
    /// Time between two ticks, at which zones are stepped \[s\], > 0. Ticks are at its multiples on the
    /// world's clock. The tick adapts to the frame: doubled while a frame holds more than 128 ticks, halved
    /// while it is longer than four frames.
    pub zone_tick: f64,
    /// Time between two force ticks \[s\], > 0: forces that are not linear on spheres in persistent contact, and all
    /// such forces where mutual gravity or another [`Interaction`](crate::Interaction) acts between more than 32
    /// spheres, are held constant from one to the next. Spheres in flight under other forces, on springs among them, do
    /// not need it. Ticks are at its multiples on the world's clock, whatever the frames; where springs need it, it is
    /// halved until they are stable. The tick adapts to the frame: doubled while a frame holds more than 64 ticks,
    /// halved while it is longer than four frames.
    pub force_tick: f64,
}

impl Default for Exact {
    fn default() -> Self {
        Self {
            impact_law: ImpactLaw::default(),
            // A bounce of this length under gravity is 1e-20 m high, far below the rounding of a
            // position, and yet it is far above the rounding of a clock that shows hours.
            contact_duration: 1e-10,
            // More than a sphere at a third of the speed of light needs between walls 1 m apart in a
            // sixtieth of a second; some seconds of work.
            max_impacts: 5_000_000,
            zones: Zones::default(),
            // Some milliseconds; twice what a single impact of any validation case takes.
            zone_budget: 300_000,
            // A sub-step of the rule `contact` at 60 frames a second.
            zone_tick: 1.0 / 480.0,
            // The error of a frame of a course is a sixteenth, and usual frames are whole numbers of ticks.
            force_tick: 1.0 / 240.0,
        }
    }
}

impl Exact {
    /// Returns the parameters with this impact law.
    pub fn with_impact_law(self, impact_law: ImpactLaw) -> Self {
        Self { impact_law, ..self }
    }

    /// Returns the parameters with this least duration of a contact \[s\].
    pub fn with_contact_duration(self, contact_duration: f64) -> Self {
        Self { contact_duration, ..self }
    }

    /// Returns the parameters with this bound for the work of a sphere in a frame.
    pub fn with_max_impacts(self, max_impacts: u32) -> Self {
        Self { max_impacts, ..self }
    }

    /// Returns the parameters with stepped zones, or without.
    pub fn with_zones(self, zones: Zones) -> Self {
        Self { zones, ..self }
    }

    /// Returns the parameters with this [`Self::zone_budget`].
    pub fn with_zone_budget(self, zone_budget: u32) -> Self {
        Self { zone_budget, ..self }
    }

    /// Returns the parameters with this [`Self::zone_tick`] \[s\].
    pub fn with_zone_tick(self, zone_tick: f64) -> Self {
        Self { zone_tick, ..self }
    }

    /// Returns the parameters with this [`Self::force_tick`] \[s\].
    pub fn with_force_tick(self, force_tick: f64) -> Self {
        Self { force_tick, ..self }
    }

    pub(super) fn validate(&self) -> Result<(), InvalidValue> {
        validate::positive("contact_duration", self.contact_duration)?;
        validate::at_least_one("max_impacts", self.max_impacts)?;
        validate::at_least_one("zone_budget", self.zone_budget)?;
        validate::positive("zone_tick", self.zone_tick)?;
        validate::positive("force_tick", self.force_tick)
    }
}
