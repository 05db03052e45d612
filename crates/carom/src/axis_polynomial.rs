//! Motion along one axis under an acceleration that is a polynomial in time.

use glam::DVec3;

use crate::axis_motion::AlongAxis;
use crate::integrate::crossing::first_positive;
use crate::polynomial_flight::{ORDERS, PolynomialFlight, TERMS};

/// The motion of a [`PolynomialFlight`] along an axis, for its time.
pub(crate) struct AxisPolynomial {
    /// Velocity at the start \[m/s\].
    velocity: f64,
    /// Length of time over which it holds, h \[s\].
    length: f64,
    /// c_k \[m/s²\]
    coefficients: [f64; TERMS],
}

impl AxisPolynomial {
    /// The motion of a flight along a unit vector.
    pub fn of(flight: &PolynomialFlight, axis: DVec3) -> Self {
        Self {
            velocity: flight.velocity.dot(axis),
            length: flight.acceleration.length,
            coefficients: flight.acceleration.coefficients.map(|c| c.dot(axis)),
        }
    }

    /// Displacement \[m\] and velocity \[m/s\] after a time \[s\].
    fn after(&self, time: f64) -> [f64; 2] {
        let s = time / self.length;
        let (mut way, mut change) = (0.0, 0.0);
        for (&c, k) in self.coefficients.iter().zip(ORDERS).rev() {
            way = way * s + c / ((k + 1.0) * (k + 2.0));
            change = change * s + c / (k + 1.0);
        }
        [time * (self.velocity + time * way), self.velocity + time * change]
    }
}

impl AlongAxis for AxisPolynomial {
    fn leaves(&self, low: f64, high: f64) -> f64 {
        let strongest: f64 = self.coefficients.iter().map(|c| c.abs()).sum();
        let farthest = self.length * (self.velocity.abs() + 0.5 * self.length * strongest);
        let reaches = |distance: f64, sign: f64| {
            if farthest < distance {
                return f64::INFINITY;
            }
            let beyond = |time: f64| {
                let [way, velocity] = self.after(time);
                [sign * way - distance.max(0.0), sign * velocity]
            };
            first_positive(beyond, strongest, self.length).unwrap_or(f64::INFINITY)
        };
        reaches(high, 1.0).min(reaches(-low, -1.0))
    }

    fn way(&self, time: f64) -> Option<f64> {
        Some(self.after(time.min(self.length))[0])
    }
}
