//! Random numbers that are the same on every platform.

use carom::DVec3;
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;

/// A sequence of random numbers; the same seed gives the same sequence.
pub struct Numbers(Pcg64);

impl Numbers {
    pub fn new(seed: u64) -> Self {
        Self(Pcg64::seed_from_u64(seed))
    }

    /// Returns a number in [0, 1).
    pub fn unit(&mut self) -> f64 {
        // The top 53 bits: every value is a multiple of 2^-53, so this is exact.
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Returns a number in [low, high).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Returns an index in 0 .. count.
    pub fn index(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }

    /// Returns a unit vector, uniformly distributed: a random point of the unit ball, normalized.
    pub fn direction(&mut self) -> DVec3 {
        loop {
            let point = 2.0 * DVec3::new(self.unit(), self.unit(), self.unit()) - 1.0;
            let length_squared = point.length_squared();
            if (1e-6..=1.0).contains(&length_squared) {
                return point / length_squared.sqrt();
            }
        }
    }

    /// Returns a unit vector perpendicular to `axis`.
    pub fn direction_across(&mut self, axis: DVec3) -> DVec3 {
        loop {
            let across = self.direction().cross(axis);
            if across.length_squared() > 1e-2 {
                return across / across.length();
            }
        }
    }

    /// Returns a vector of normally distributed components with mean 0 and variance 1. Polar method
    /// of Marsaglia and Bray, SIAM Review 6, 260 (1964).
    pub fn normal_vector(&mut self) -> DVec3 {
        let ([x, y], [z, _]) = (self.normal_pair(), self.normal_pair());
        DVec3::new(x, y, z)
    }

    fn normal_pair(&mut self) -> [f64; 2] {
        loop {
            let [x, y] = [self.between(-1.0, 1.0), self.between(-1.0, 1.0)];
            let square = x * x + y * y;
            if square > 0.0 && square < 1.0 {
                let factor = (-2.0 * libm::log(square) / square).sqrt();
                return [factor * x, factor * y];
            }
        }
    }
}
