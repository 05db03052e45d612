//! How long a contact lasts: a setting, and what rounding can resolve.

use glam::DVec3;

use crate::norm::Norm;
pub(in crate::rule::exact) use crate::rule::exact::features::TOUCHING;
use crate::rule::exact::flights::{Flights, Species};

/// Relative rounding of the time of a contact: that of the clock and of the sums that lead to the time.
pub(crate) const CLOCK_ROUNDING: f64 = 4.0 * f64::EPSILON;
/// A persistent contact of spheres, or on a curve, is followed to this part of the radius: the error
/// of the third order in the turn of its normal.
const CURVE_RESOLUTION: f64 = 1e-9;
/// Part of a radius by which a piece of path along a curve may miss its contacts at its end, before that
/// is corrected. A bounce that is lower cannot be distinguished from it.
pub(crate) const MOST_MISSED: f64 = 1e-7;
/// Impacts between which the bodies move by more than this part of a radius count as separate, however
/// short the time between them is.
pub(crate) const RESOLVED_PATH: f64 = 1e-6;

/// What can be resolved of the motion of two bodies near contact.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct ContactScale {
    /// Coordinates and radii that the gap is computed from \[m\].
    pub length: f64,
    /// Accelerations that may press the bodies together \[m/s²\].
    pub acceleration: f64,
    /// Radius of the smallest sphere \[m\].
    pub radius: f64,
    /// Whether the contact is part of a path along a curve, which has an error of its own.
    pub is_curved: bool,
    /// Whether impacts are elastic: their bounces never end, however low they are.
    pub is_elastic: bool,
    /// Whether all spheres fly on curves of an integrator, also in persistent contact.
    pub is_on_curves: bool,
}

impl ContactScale {
    /// The scale of a contact of spheres at `time` \[s\].
    pub fn from_spheres(flights: &Flights, slots: &[u32], time: f64) -> Self {
        slots.iter().fold(Self::default(), |scale, &slot| {
            let (position, velocity) = flights.state_of(slot, time);
            scale.with(position, velocity, &flights.free_species_at(slot, time))
        })
    }

    /// The scale with one more sphere, at a place \[m\] with a velocity \[m/s\].
    pub fn with(self, position: DVec3, velocity: DVec3, species: &Species) -> Self {
        let free = species.acceleration - species.drag_rate * velocity;
        let is_first = self.radius == 0.0;
        Self {
            length: self.length + position.norm() + species.radius,
            acceleration: self.acceleration + free.norm(),
            radius: if is_first { species.radius } else { self.radius.min(species.radius) },
            is_curved: self.is_curved || !is_first,
            ..self
        }
    }

    /// A gap \[m\] that cannot be distinguished from none.
    pub fn resolved_gap(&self) -> f64 {
        let rounding = TOUCHING * self.length;
        let is_in_pieces = self.is_curved && !(self.is_elastic && self.is_on_curves);
        if is_in_pieces { rounding.max(CURVE_RESOLUTION * self.radius) } else { rounding }
    }

    /// How long a contact lasts \[s\]: at least the setting, and the rounding of the clock at `time`
    /// \[s\].
    ///
    /// A bounce of the duration t under the acceleration A is `A t²/8` high: `t = √(8 h/A)` is the
    /// shortest one, where h is the lowest bounce that can be distinguished from a contact that persists.
    pub fn duration(&self, setting: f64, time: f64) -> f64 {
        let least = setting.max(CLOCK_ROUNDING * time.abs());
        if self.acceleration <= 0.0 {
            return least;
        }
        least.max((8.0 * self.lowest_bounce() / self.acceleration).sqrt())
    }

    /// Height \[m\] of the lowest bounce that can be distinguished from a contact that persists.
    fn lowest_bounce(&self) -> f64 {
        let gap = self.resolved_gap();
        let is_missed = self.is_curved && !self.is_elastic;
        if is_missed { gap.max(MOST_MISSED * self.radius) } else { gap }
    }

    /// The time \[s\] after which impacts of bodies with this relative speed \[m/s\] count as separate.
    pub fn resolved_time(&self, speed: f64) -> f64 {
        RESOLVED_PATH * self.radius / speed
    }
}
