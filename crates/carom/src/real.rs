//! Numbers for formulas that hold for one number and for several lanes ([`Lanes`](crate::lanes::Lanes)), with the
//! same bits.

use std::ops::{Add, Div, Mul, Sub};

use glam::DVec3;

/// A number, or several side by side that are treated alike.
pub(crate) trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Mul<f64, Output = Self>
    + Div<Output = Self>
{
    fn sqrt(self) -> Self;
    /// Returns the larger number of each two, neither of them NaN.
    fn max(self, other: Self) -> Self;
    /// Returns the smaller of the number and `bound`; neither is NaN.
    fn min(self, bound: f64) -> Self;
}

impl Real for f64 {
    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if other > self { other } else { self }
    }

    #[inline(always)]
    fn min(self, bound: f64) -> Self {
        if self > bound { bound } else { self }
    }
}

/// A vector of three numbers, or several side by side. Sums are taken in the order of `glam`'s.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Vector<N> {
    pub x: N,
    pub y: N,
    pub z: N,
}

impl From<DVec3> for Vector<f64> {
    #[inline(always)]
    fn from(DVec3 { x, y, z }: DVec3) -> Self {
        Self { x, y, z }
    }
}

impl From<Vector<f64>> for DVec3 {
    #[inline(always)]
    fn from(Vector { x, y, z }: Vector<f64>) -> Self {
        Self { x, y, z }
    }
}

impl<N: Real> Vector<N> {
    #[inline(always)]
    pub fn dot(self, other: Self) -> N {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// Each component times that of another.
    #[inline(always)]
    pub fn scaled(self, by: Self) -> Self {
        Self { x: self.x * by.x, y: self.y * by.y, z: self.z * by.z }
    }

    #[inline(always)]
    pub fn length_squared(self) -> N {
        self.dot(self)
    }

    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - other.y * self.z,
            y: self.z * other.x - other.z * self.x,
            z: self.x * other.y - other.x * self.y,
        }
    }
}

impl<N: Real> Add for Vector<N> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}

impl<N: Real> Sub for Vector<N> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

impl<N: Real> Mul<N> for Vector<N> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: N) -> Self {
        Self { x: self.x * factor, y: self.y * factor, z: self.z * factor }
    }
}
