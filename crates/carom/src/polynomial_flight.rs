//! Motion under a force without a closed form, as a polynomial in time.

use glam::DVec3;

use crate::norm::Norm;

/// Coefficients of the acceleration: a Gauss-Radau step has eight nodes.
pub(crate) const TERMS: usize = 8;

/// A sphere in flight for a time h, with an acceleration that is a polynomial in `s = t/h`:
///
/// ```text
/// a(t) = Σ c_k s^k        v(t) = v0 + t Σ c_k s^k/(k + 1)
/// x(t) = x0 + v0 t + t² Σ c_k s^k/((k + 1)(k + 2))        k = 0, ..., 7
/// ```
///
/// Source: Everhart, in *Dynamics of Comets* (1985), 185; Rein and Spiegel, MNRAS 446, 1424 (2015), eq. 6 to 9.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PolynomialFlight {
    /// Centre at time 0 \[m\].
    pub position: DVec3,
    /// Velocity at time 0 \[m/s\].
    pub velocity: DVec3,
    pub acceleration: PolynomialAcceleration,
}

/// An acceleration that is a polynomial over a time.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct PolynomialAcceleration {
    /// Length of time over which it holds, h \[s\], > 0.
    pub length: f64,
    /// c_k \[m/s²\]
    pub coefficients: [DVec3; TERMS],
    /// Parts of the position \[m\] and of the velocity \[m/s\] at time 0 below their rounding.
    pub carried: [DVec3; 2],
}

impl PolynomialFlight {
    /// Centre \[m\] and velocity \[m/s\] at a time \[s\] in `[0, h]`.
    pub fn after(&self, t: f64) -> (DVec3, DVec3) {
        let (way, change) = self.acceleration.gained_until(t);
        (self.position + (t * self.velocity + way), self.velocity + change)
    }

    /// Parts of the position \[m\] and of the velocity \[m/s\] at a time \[s\] below their rounding (Knuth, *The Art of
    /// Computer Programming* 2, 4.2.2, theorem B).
    pub fn left_after(&self, t: f64) -> [DVec3; 2] {
        let (way, change) = self.acceleration.gained_until(t);
        let left = |first: DVec3, second: DVec3| {
            let sum = first + second;
            let rounded = sum - first;
            (first - (sum - rounded)) + (second - rounded)
        };
        [left(self.position, t * self.velocity + way), left(self.velocity, change)]
    }

    /// Upper bound of the speed along each axis in its time \[m/s\].
    pub fn fastest(&self) -> DVec3 {
        let PolynomialAcceleration { length, coefficients, .. } = &self.acceleration;
        let terms = coefficients.iter().zip(INTEGRALS);
        let gained: DVec3 = terms.map(|(c, [_, of_change])| c.abs() * of_change).sum();
        self.velocity.abs() + *length * gained
    }

    /// Largest displacement along each axis in its time \[m\].
    pub fn farthest(&self) -> DVec3 {
        let h = self.acceleration.length;
        h * (self.velocity.abs() + h * self.acceleration.most_way())
    }
}

impl PolynomialAcceleration {
    /// No acceleration for a time \[s\].
    pub fn none(length: f64) -> Self {
        Self { length, coefficients: [DVec3::ZERO; TERMS], carried: [DVec3::ZERO; 2] }
    }

    /// Acceleration at a time \[s\] \[m/s²\].
    pub fn at(&self, t: f64) -> DVec3 {
        let s = t / self.length;
        self.coefficients.iter().rev().fold(DVec3::ZERO, |sum, &c| sum * s + c)
    }

    /// The way \[m\] that it adds by a time \[s\] to that of a constant velocity, and the velocity \[m/s\].
    pub fn gained_until(&self, t: f64) -> (DVec3, DVec3) {
        let s = t / self.length;
        let (mut way, mut change) = (DVec3::ZERO, DVec3::ZERO);
        for (&c, [of_way, of_change]) in self.coefficients.iter().zip(&INTEGRALS).rev() {
            way = way * s + c * *of_way;
            change = change * s + c * *of_change;
        }
        let [place, velocity] = self.carried;
        (place + (t * velocity + t * t * way), velocity + t * change)
    }

    /// Returns the bounds of the acceleration along each axis over the whole flight \[m/s²\].
    pub fn bounds(&self) -> [DVec3; 2] {
        let [first, rest @ ..] = &self.coefficients;
        let spread: DVec3 = rest.iter().map(|c| c.abs()).sum();
        [*first - spread, *first + spread]
    }

    /// Upper bounds of the way that it adds, by its time squared \[m/s²\].
    fn most_way(&self) -> DVec3 {
        let terms = self.coefficients.iter().zip(INTEGRALS);
        terms.map(|(c, [of_way, _])| c.abs() * of_way).sum()
    }

    /// Largest distance in its time from the parabola of its first acceleration \[m\].
    pub fn beyond_parabola(&self) -> f64 {
        let terms = self.coefficients.iter().zip(INTEGRALS).skip(1);
        let way: f64 = terms.map(|(c, [of_way, _])| c.norm() * of_way).sum();
        self.length * self.length * way
    }

    /// Returns the rest of the flight from a time \[s\] within its length on.
    pub fn from(&self, time: f64) -> Self {
        self.within(time, self.length - time)
    }

    /// Returns the part of the flight from a time \[s\] within its length on, of some length \[s\].
    pub fn within(&self, time: f64, length: f64) -> Self {
        let rest = shifted(self.coefficients, time / self.length);
        let coefficients = scaled(rest, length / self.length);
        Self { length, coefficients, carried: [DVec3::ZERO; 2] }
    }

    /// Difference from another polynomial over the same time.
    pub fn minus(&self, other: &Self) -> Self {
        let mut coefficients = self.coefficients;
        coefficients.iter_mut().zip(&other.coefficients).for_each(|(c, other)| *c -= *other);
        let carried = [0, 1].map(|which| self.carried[which] - other.carried[which]);
        Self { length: self.length, coefficients, carried }
    }

    /// Whether all its numbers are finite.
    pub fn is_finite(&self) -> bool {
        self.coefficients.iter().all(|c| c.is_finite())
    }

    /// The same polynomial for the times from its end on, over a `length` \[s\]: a first guess of what follows.
    ///
    /// With `q` the ratio of the lengths, `Σ c_k (1 + q s)^k`.
    pub fn continued(&self, length: f64) -> [DVec3; TERMS] {
        scaled(shifted(self.coefficients, 1.0), length / self.length)
    }
}

/// `1/((k + 1)(k + 2))` and `1/(k + 1)`, by k.
const INTEGRALS: [[f64; 2]; TERMS] = {
    let mut table = [[0.0; 2]; TERMS];
    let mut k = 0;
    while k < TERMS {
        let order = ORDERS[k];
        table[k] = [1.0 / ((order + 1.0) * (order + 2.0)), 1.0 / (order + 1.0)];
        k += 1;
    }
    table
};

/// 0, 1, ..., 7
pub(crate) const ORDERS: [f64; TERMS] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

/// Coefficients in `u = s - start` of a polynomial in s: Horner's rule, repeated (Taylor shift).
pub(crate) fn shifted<T>(mut coefficients: [T; TERMS], start: f64) -> [T; TERMS]
where
    T: Copy + std::ops::Add<Output = T> + std::ops::Mul<f64, Output = T>,
{
    for first in 0..TERMS - 1 {
        for k in (first..TERMS - 1).rev() {
            coefficients[k] = coefficients[k] + coefficients[k + 1] * start;
        }
    }
    coefficients
}

/// Coefficients in `q s` of a polynomial in s, as those of one in s.
pub(crate) fn scaled<T>(coefficients: [T; TERMS], ratio: f64) -> [T; TERMS]
where
    T: std::ops::Mul<f64, Output = T>,
{
    let mut power = 1.0;
    coefficients.map(|c| {
        let scaled = c * power;
        power *= ratio;
        scaled
    })
}

/// The largest value of a polynomial for `s` in `[from, to]`, or a little more: the largest of its Bernstein
/// coefficients there (Farouki, Comput. Aided Geom. Des. 29, 379 (2012), section 3).
pub(crate) fn upper_bound(coefficients: [f64; TERMS], from: f64, to: f64) -> f64 {
    let mut terms = shifted(coefficients, from);
    let (width, mut power) = (to - from, 1.0);
    for term in &mut terms {
        *term *= power;
        power *= width;
    }
    // b_i = Σ_{k <= i} C(i, k)/C(7, k) d_k
    let bernstein = |i: usize| (0..=i).map(|k| BERNSTEIN[i][k] * terms[k]).sum::<f64>();
    (0..TERMS).map(bernstein).fold(f64::NEG_INFINITY, f64::max)
}

/// C(i, k)/C(7, k)
const BERNSTEIN: [[f64; TERMS]; TERMS] = {
    let mut table = [[0.0; TERMS]; TERMS];
    let mut i = 0;
    while i < TERMS {
        let mut k = 0;
        while k <= i {
            table[i][k] = binomial(i, k) / binomial(TERMS - 1, k);
            k += 1;
        }
        i += 1;
    }
    table
};

const fn binomial(n: usize, k: usize) -> f64 {
    let (mut value, mut i) = (1.0, 0);
    while i < k {
        value = value * (n - i) as f64 / (i + 1) as f64;
        i += 1;
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `1 - 3 s + 2 s^3 + s^7`
    const SOME: [f64; TERMS] = [1.0, -3.0, 0.0, 2.0, 0.0, 0.0, 0.0, 1.0];

    fn value(s: f64) -> f64 {
        SOME.iter().rev().fold(0.0, |sum, c| sum * s + c)
    }

    #[test]
    fn bound_is_above_all_values_and_tight_on_short_intervals() {
        for (from, to) in [(0.0, 1.0), (0.2, 0.7), (0.5, 0.5), (0.9, 1.0), (0.4, 0.41)] {
            let bound = upper_bound(SOME, from, to);
            let values = (0..=100).map(|i| value(from + (to - from) * f64::from(i) / 100.0));
            let most = values.fold(f64::NEG_INFINITY, f64::max);
            // Rounding of some tens of terms of size 1.
            assert!(bound >= most - 1e-14, "{bound} {most}");
            // The gap is of the second order in the width; |p''| <= 54.
            assert!(bound - most <= 54.0 * (to - from) * (to - from) + 1e-14, "{bound} {most}");
        }
    }

    #[test]
    fn shifted_polynomial_has_the_same_values() {
        let moved = shifted(SOME, 0.3);
        let at = |u: f64| moved.iter().rev().fold(0.0, |sum, c| sum * u + c);
        for u in [-0.3, 0.0, 0.4] {
            assert!((at(u) - value(u + 0.3)).abs() < 1e-14);
        }
    }

    #[test]
    fn velocity_and_position_are_integrals_of_the_acceleration() {
        let coefficients = SOME.map(|c| DVec3::new(c, 0.0, -c));
        let acceleration =
            PolynomialAcceleration { length: 2.0, coefficients, carried: [DVec3::ZERO; 2] };
        let flight = PolynomialFlight { position: DVec3::Y, velocity: DVec3::X, acceleration };
        let h = 1e-3;
        for t in [0.2, 1.0, 1.9] {
            let [before, after] = [t - h, t + h].map(|t| flight.after(t));
            // Differences in the middle are off by h² x''''/6 of at most 6.
            let slope = (after.0 - before.0) / (2.0 * h);
            assert!((slope - flight.after(t).1).length() < 1e-4);
            let slope = (after.1 - before.1) / (2.0 * h);
            assert!((slope - acceleration.at(t)).length() < 1e-4);
            let way = (flight.after(t).0 - flight.position).abs();
            assert!(way.cmple(flight.farthest()).all());
        }
    }
}
