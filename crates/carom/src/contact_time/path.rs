//! Paths of a centre relative to an obstacle.

use glam::DVec3;

use super::roundoff::Magnitudes;
use crate::flight::{Flight, Propagator};
use crate::norm::Norm;

/// A path relative to an obstacle at rest.
pub(super) trait Path {
    /// State of the centre at a time \[s\] >= 0.
    fn state_at(&self, t: f64) -> State;

    /// An upper bound of the acceleration along a unit vector \[m/s²\] over `[from, to]` \[s\];
    /// `to` may be infinite. It may be negative. A smaller interval gives no larger bound.
    fn max_acceleration(&self, direction: DVec3, from: f64, to: f64) -> f64;

    /// An upper bound of the acceleration along all unit vectors \[m/s²\], as above.
    fn max_acceleration_anywhere(&self, from: f64, to: f64) -> f64;

    /// An upper bound of the rate \[m/s³\] at which the size of the acceleration grows up to a time \[s\]; none
    /// (the default) where it never does.
    fn growth(&self, _to: f64) -> f64 {
        0.0
    }

    /// Speed at which the radius about the centre grows \[m/s\], 0 (the default) where it does not.
    fn growth_speed(&self) -> f64 {
        0.0
    }

    /// The rate \[1/s\] at which the acceleration decays, 0 (the default) where it does not.
    fn decay_rate(&self) -> f64 {
        0.0
    }

    /// The longest time \[s\] for which [`Self::max_acceleration`] is worth computing at first.
    fn window(&self) -> f64 {
        f64::INFINITY
    }
}

/// State on a path at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct State {
    pub position: DVec3,
    pub velocity: DVec3,
    pub acceleration: DVec3,
    /// Sizes of the terms by which this state differs from that at time 0.
    pub size: Magnitudes,
}

impl Path for Flight {
    fn state_at(&self, t: f64) -> State {
        let Propagator { decay, drift, fall } = Propagator::over(t, self.drag_rate);
        let (speed, pull) = (self.velocity.norm(), self.acceleration.norm());
        let travel = drift * self.velocity + fall * self.acceleration;
        State {
            position: self.position + travel,
            velocity: decay * self.velocity + drift * self.acceleration,
            acceleration: decay * self.initial_acceleration(),
            size: Magnitudes {
                length: drift * speed + fall * pull,
                speed: decay * speed + drift * pull,
                acceleration: decay * (pull + self.drag_rate * speed),
            },
        }
    }

    /// The acceleration is `(a - γ v0) e^-γt`, so its extremes are at the ends.
    fn max_acceleration(&self, direction: DVec3, from: f64, to: f64) -> f64 {
        let initial = direction.dot(self.initial_acceleration());
        let when = if initial > 0.0 { from } else { to };
        if self.drag_rate == 0.0 { initial } else { initial * libm::exp(-self.drag_rate * when) }
    }

    fn max_acceleration_anywhere(&self, from: f64, _to: f64) -> f64 {
        libm::exp(-self.drag_rate * from) * self.initial_acceleration().norm()
    }

    fn decay_rate(&self) -> f64 {
        self.drag_rate
    }
}

/// The second of two flights relative to the first, for any drag rates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FlightPair {
    pub first: Flight,
    pub second: Flight,
}

impl Path for FlightPair {
    fn state_at(&self, t: f64) -> State {
        // Paths are subtracted before places: the difference of the starting points is rounded once.
        let way = |flight: &Flight| Flight { position: DVec3::ZERO, ..*flight }.state_at(t);
        let (first, second) = (way(&self.first), way(&self.second));
        let offset = self.second.position - self.first.position;
        State {
            position: offset + (second.position - first.position),
            velocity: second.velocity - first.velocity,
            acceleration: second.acceleration - first.acceleration,
            size: first.size + second.size,
        }
    }

    fn max_acceleration(&self, direction: DVec3, from: f64, to: f64) -> f64 {
        self.second.max_acceleration(direction, from, to)
            + self.first.max_acceleration(-direction, from, to)
    }

    fn max_acceleration_anywhere(&self, from: f64, to: f64) -> f64 {
        self.second.max_acceleration_anywhere(from, to)
            + self.first.max_acceleration_anywhere(from, to)
    }
}
