//! Numbers of two precisions, so that one formula serves to look around and to judge.

use std::ops::{Add, Div, Mul, Neg, Sub};

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use glam::DVec3;

use crate::flight::Propagator;

/// 256 bits, 77 digits: enough for second differences and for the cancellation in the closed
/// form of flights with little drag.
const PRECISION: usize = 256;

pub type Big = FBig<HalfEven, 2>;

pub trait Number:
    Clone
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    fn of(value: f64) -> Self;
    fn root(self) -> Self;
    /// Sine and cosine.
    fn turn(self) -> (Self, Self);
    /// `t f1(γt)` and `t² f2(γt)` of a [`crate::Flight`].
    fn drift_and_fall(t: &Self, drag_rate: f64) -> (Self, Self);
}

impl Number for f64 {
    fn of(value: f64) -> Self {
        value
    }

    fn root(self) -> Self {
        self.sqrt()
    }

    fn turn(self) -> (Self, Self) {
        libm::sincos(self)
    }

    fn drift_and_fall(t: &Self, drag_rate: f64) -> (Self, Self) {
        let Propagator { drift, fall, .. } = Propagator::over(*t, drag_rate);
        (drift, fall)
    }
}

impl Number for Big {
    fn of(value: f64) -> Self {
        Big::try_from(value).unwrap().with_precision(PRECISION).value()
    }

    fn root(self) -> Self {
        if self == Big::ZERO { self } else { self.sqrt() }
    }

    fn turn(self) -> (Self, Self) {
        if self == Big::ZERO { (Self::of(0.0), Self::of(1.0)) } else { self.sin_cos() }
    }

    fn drift_and_fall(t: &Self, drag_rate: f64) -> (Self, Self) {
        let gamma = Self::of(drag_rate);
        let z = gamma.clone() * t.clone();
        let square = t.clone() * t.clone();
        if z.clone().to_f64().value().abs() < 1e-12 {
            // Four terms of the series: the next is z⁴/5!, below 1e-50.
            let series = |d: [f64; 4]| {
                d.iter()
                    .rev()
                    .fold(Self::of(0.0), |sum, &d| (Self::of(1.0) - z.clone() * sum) / Self::of(d))
            };
            return (
                t.clone() * series([1.0, 2.0, 3.0, 4.0]),
                square * series([2.0, 3.0, 4.0, 5.0]),
            );
        }
        // e^-1000 has 434 zeros; dashu takes it by way of e^1000, which overflows at last.
        let decay = if z > Self::of(1000.0) { Self::of(0.0) } else { (-z).exp() };
        let drift = (Self::of(1.0) - decay) / gamma.clone();
        (drift.clone(), (t.clone() - drift) / gamma)
    }
}

/// A vector of three numbers.
#[derive(Clone)]
pub struct Vector<N>(pub [N; 3]);

impl<N: Number> Vector<N> {
    pub fn of(vector: DVec3) -> Self {
        Self(vector.to_array().map(N::of))
    }

    pub fn plus(&self, other: &Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i].clone() + other.0[i].clone()))
    }

    pub fn minus(&self, other: &Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i].clone() - other.0[i].clone()))
    }

    pub fn times(&self, factor: &N) -> Self {
        Self(std::array::from_fn(|i| self.0[i].clone() * factor.clone()))
    }

    pub fn dot(&self, other: &Self) -> N {
        let [x, y, z] = std::array::from_fn(|i| self.0[i].clone() * other.0[i].clone());
        x + y + z
    }

    pub fn cross(&self, other: &Self) -> Self {
        let minor = |i: usize, j: usize| {
            self.0[i].clone() * other.0[j].clone() - self.0[j].clone() * other.0[i].clone()
        };
        Self([minor(1, 2), minor(2, 0), minor(0, 1)])
    }

    pub fn length(&self) -> N {
        self.dot(self).root()
    }
}
