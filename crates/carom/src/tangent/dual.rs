//! Dual numbers: a value and its derivative in one direction.

use std::ops::{Add, Div, Mul, Sub};

use glam::DVec3;

use crate::real::{Real, Vector};

/// A number and its derivative in one direction: `(v + d ε)` with ε² = 0 (Clifford, Proc. London Math. Soc. 4, 381
/// (1873)). A formula evaluated with such numbers gives its own derivative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Dual {
    pub value: f64,
    pub change: f64,
}

impl Dual {
    #[inline]
    pub const fn new(value: f64, change: f64) -> Self {
        Self { value, change }
    }

    /// Returns a number whose derivative is zero.
    #[inline]
    pub const fn constant(value: f64) -> Self {
        Self { value, change: 0.0 }
    }
}

/// A number with or without a derivative.
pub(super) trait Number: Real {
    fn new(value: f64, change: f64) -> Self;

    fn value(self) -> f64;

    /// Returns the derivative; zero for a plain number.
    fn change(self) -> f64;

    /// Returns a number whose derivative is zero.
    #[inline]
    fn constant(value: f64) -> Self {
        Self::new(value, 0.0)
    }
}

impl Number for f64 {
    #[inline]
    fn new(value: f64, _: f64) -> Self {
        value
    }

    #[inline]
    fn value(self) -> f64 {
        self
    }

    #[inline]
    fn change(self) -> f64 {
        0.0
    }
}

impl Number for Dual {
    #[inline]
    fn new(value: f64, change: f64) -> Self {
        Self { value, change }
    }

    #[inline]
    fn value(self) -> f64 {
        self.value
    }

    #[inline]
    fn change(self) -> f64 {
        self.change
    }
}

impl Add for Dual {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        Self::new(self.value + other.value, self.change + other.change)
    }
}

impl Sub for Dual {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        Self::new(self.value - other.value, self.change - other.change)
    }
}

impl Mul for Dual {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        let change = self.change * other.value + self.value * other.change;
        Self::new(self.value * other.value, change)
    }
}

impl Mul<f64> for Dual {
    type Output = Self;

    #[inline]
    fn mul(self, factor: f64) -> Self {
        Self::new(self.value * factor, self.change * factor)
    }
}

impl Div for Dual {
    type Output = Self;

    #[inline]
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self::new(value, (self.change - value * other.change) / other.value)
    }
}

impl Real for Dual {
    #[inline]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        Self::new(root, 0.5 * self.change / root)
    }

    #[inline]
    fn max(self, other: Self) -> Self {
        if other.value > self.value { other } else { self }
    }

    #[inline]
    fn min(self, bound: f64) -> Self {
        if self.value > bound { Self::constant(bound) } else { self }
    }
}

/// Returns a vector with its derivative.
#[inline]
pub(super) fn vector(value: DVec3, change: DVec3) -> Vector<Dual> {
    Vector {
        x: Dual::new(value.x, change.x),
        y: Dual::new(value.y, change.y),
        z: Dual::new(value.z, change.z),
    }
}

impl Vector<Dual> {
    #[inline]
    pub(super) fn value(self) -> DVec3 {
        DVec3::new(self.x.value, self.y.value, self.z.value)
    }

    #[inline]
    pub(super) fn change(self) -> DVec3 {
        DVec3::new(self.x.change, self.y.change, self.z.change)
    }

    /// Returns the unit vector along this one.
    pub(super) fn direction(self) -> Self {
        self * (Dual::constant(1.0) / self.length_squared().sqrt())
    }
}
