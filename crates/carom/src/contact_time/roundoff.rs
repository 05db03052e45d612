//! Rounding: which distances, speeds and accelerations count as zero.

use std::ops::Add;

use crate::flight::Flight;
use crate::norm::Norm;

/// Rounding of a computed distance, relative to the lengths it is made of (coordinates, ways
/// and radii). Positions carry a few roundings each from being advanced, their distance a few
/// more; 16 covers them, and a bit to spare.
pub(super) const DISTANCE_ROUNDOFF: f64 = 16.0 * f64::EPSILON;

/// Rounding of a computed closing speed, relative to the speeds it is made of: as much as the impact
/// laws leave of one that they have answered ([`crate::respond`]). What is met by less would have no
/// answer, and be met again without end.
pub(super) const SPEED_ROUNDOFF: f64 = 64.0 * f64::EPSILON;

/// Rounding of a computed normal acceleration, relative to the accelerations it is made of.
pub(super) const ACCELERATION_ROUNDOFF: f64 = 16.0 * f64::EPSILON;

/// Sizes of the terms that a distance and its derivatives are made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Magnitudes {
    /// Length \[m\].
    pub length: f64,
    /// Speed \[m/s\].
    pub speed: f64,
    /// Acceleration \[m/s²\].
    pub acceleration: f64,
}

impl Magnitudes {
    /// Returns the magnitudes of a flight at its beginning.
    pub fn of(flight: &Flight) -> Self {
        let speed = flight.velocity.norm();
        Self {
            length: flight.position.norm(),
            speed,
            acceleration: flight.acceleration.norm() + flight.drag_rate * speed,
        }
    }

    /// Returns the magnitudes of a length \[m\] that does not change.
    pub fn of_length(length: f64) -> Self {
        Self { length, speed: 0.0, acceleration: 0.0 }
    }
}

impl Add for Magnitudes {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            length: self.length + other.length,
            speed: self.speed + other.speed,
            acceleration: self.acceleration + other.acceleration,
        }
    }
}

/// Distance of two surfaces at one instant, with its derivatives in time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Gap {
    /// d \[m\]
    pub distance: f64,
    /// d' \[m/s\], negative where they close.
    pub speed: f64,
    /// d'' \[m/s²\], negative where they press.
    pub acceleration: f64,
}

/// Phase of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Phase {
    /// The bodies do not touch.
    Apart,
    /// Touching or overlapping, and closing or about to.
    Contact,
    /// Touching or overlapping, but opening or at rest without pressing.
    Parting,
}

impl Gap {
    /// The phase, where values below `zero` count as zero.
    pub fn phase(&self, zero: &Zero) -> Phase {
        if self.distance > zero.distance {
            Phase::Apart
        } else if self.speed < -zero.speed || (self.is_at_rest(zero) && self.presses(zero)) {
            Phase::Contact
        } else {
            Phase::Parting
        }
    }

    /// Neither closing nor opening.
    pub fn is_at_rest(&self, zero: &Zero) -> bool {
        self.speed.abs() <= zero.speed
    }

    fn presses(&self, zero: &Zero) -> bool {
        self.acceleration < -zero.acceleration
    }
}

/// Bounds below which a distance and its derivatives count as zero: their rounding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Zero {
    /// Distance \[m\].
    pub distance: f64,
    /// Speed \[m/s\].
    pub speed: f64,
    /// Acceleration \[m/s²\].
    pub acceleration: f64,
}

impl Zero {
    /// Along a normal that is known exactly.
    pub fn flat(size: &Magnitudes) -> Self {
        Self {
            distance: DISTANCE_ROUNDOFF * size.length,
            speed: SPEED_ROUNDOFF * size.speed,
            acceleration: ACCELERATION_ROUNDOFF * size.acceleration,
        }
    }

    /// Along the normal of a point or an edge at the distance `from_core` \[m\]. The rounding of
    /// positions turns it by the angle `rounding / from_core`, which mixes some of the tangential
    /// motion into the normal one.
    ///
    /// - `speed` \[m/s\], relative; `turning` \[m/s²\]: the part of d'' that comes from the
    ///   curvature of the distance
    pub fn round(size: &Magnitudes, from_core: f64, speed: f64, turning: f64) -> Self {
        let flat = Self::flat(size);
        if from_core <= 0.0 {
            return flat;
        }
        let angle = flat.distance / from_core;
        Self {
            speed: flat.speed + angle * speed,
            acceleration: flat.acceleration + angle * (size.acceleration + turning.abs()),
            ..flat
        }
    }
}
