//! Number types of the course's rule, and vectors of them.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use carom::DVec3;

/// A number in single or double precision.
pub trait Real:
    Copy
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Converts from double precision.
    fn of(value: f64) -> Self;
    /// Converts to double precision.
    fn to_f64(self) -> f64;
    /// Square root.
    fn sqrt(self) -> Self;
}

impl Real for f64 {
    fn of(value: f64) -> Self {
        value
    }

    fn to_f64(self) -> f64 {
        self
    }

    fn sqrt(self) -> Self {
        self.sqrt()
    }
}

/// The number type of Unity.
impl Real for f32 {
    fn of(value: f64) -> Self {
        value as Self
    }

    fn to_f64(self) -> f64 {
        f64::from(self)
    }

    fn sqrt(self) -> Self {
        self.sqrt()
    }
}

/// A vector x, y, z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vec3<N> {
    pub x: N,
    pub y: N,
    pub z: N,
}

impl<N: Real> Vec3<N> {
    pub fn new(x: N, y: N, z: N) -> Self {
        Self { x, y, z }
    }

    pub fn zero() -> Self {
        Self::of(DVec3::ZERO)
    }

    /// Converts from double precision.
    pub fn of(value: DVec3) -> Self {
        Self::new(N::of(value.x), N::of(value.y), N::of(value.z))
    }

    /// Converts to double precision.
    pub fn to_f64(self) -> DVec3 {
        DVec3::new(self.x.to_f64(), self.y.to_f64(), self.z.to_f64())
    }

    pub fn dot(self, other: Self) -> N {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    pub fn length(self) -> N {
        self.dot(self).sqrt()
    }
}

impl<N: Real> Add for Vec3<N> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl<N: Real> AddAssign for Vec3<N> {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<N: Real> Sub for Vec3<N> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<N: Real> Mul<N> for Vec3<N> {
    type Output = Self;

    fn mul(self, factor: N) -> Self {
        Self::new(self.x * factor, self.y * factor, self.z * factor)
    }
}

impl<N: Real> Div<N> for Vec3<N> {
    type Output = Self;

    fn div(self, divisor: N) -> Self {
        Self::new(self.x / divisor, self.y / divisor, self.z / divisor)
    }
}
