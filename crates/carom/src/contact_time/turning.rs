//! Paths relative to a body that turns.

use glam::DVec3;

use super::path::{Path, State};
use super::roundoff::Magnitudes;
use crate::norm::Norm;

/// A steady rotation about an axis through the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Turns {
    /// ω \[rad/s\]
    angular_velocity: DVec3,
    /// |ω| \[rad/s\], > 0
    rate: f64,
    axis: DVec3,
}

impl Turns {
    /// Creates the rotation with this angular velocity \[rad/s\], which must not be zero.
    pub fn new(angular_velocity: DVec3) -> Self {
        let rate = angular_velocity.norm();
        Self { angular_velocity, rate, axis: angular_velocity / rate }
    }

    /// A vector turned for a time \[s\], which may be negative.
    ///
    /// Rodrigues' formula (1840), `v + sin θ k×v + (1 - cos θ) k×(k×v)`, in half angles, which
    /// keeps the digits of small turns.
    fn turned(&self, t: f64) -> impl Fn(DVec3) -> DVec3 + use<> {
        let (sin, cos) = libm::sincos(0.5 * self.rate * t);
        let axis = self.axis;
        move |vector| {
            let across = axis.cross(vector);
            vector + 2.0 * sin * (cos * across + sin * axis.cross(across))
        }
    }

    /// ω × (ω × vector)
    fn twice(&self, vector: DVec3) -> DVec3 {
        self.angular_velocity.cross(self.angular_velocity.cross(vector))
    }
}

/// A motion in a coordinate system that turns about the origin: with `y = R⁻¹ x`,
///
/// ```text
/// y'  = R⁻¹ (x' - ω×x)      y'' = R⁻¹ (x'' - 2 ω×x' + ω×(ω×x))
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Turning<P> {
    /// Path in a coordinate system that does not turn.
    pub flight: P,
    pub turns: Turns,
}

impl<P: Path> Path for Turning<P> {
    fn state_at(&self, t: f64) -> State {
        let Turns { angular_velocity: omega, rate, .. } = self.turns;
        let State { position: x, velocity: v, acceleration: a, size } = self.flight.state_at(t);
        let back = self.turns.turned(-t);
        let arm = x.norm();
        let swing = rate * arm;
        State {
            position: back(x),
            velocity: back(v - omega.cross(x)),
            acceleration: back(a - 2.0 * omega.cross(v) + self.turns.twice(x)),
            size: size
                + Magnitudes {
                    // The angle is rounded as the time is.
                    length: arm + swing * t,
                    speed: swing * (1.0 + rate * t),
                    acceleration: rate * (2.0 * v.norm() + swing) * (1.0 + rate * t),
                },
        }
    }

    /// With m = R n the direction in the frame that does not turn, and `m' = ω×m`,
    ///
    /// ```text
    /// n·y'' = m·x'' - 2 (m×ω)·x' - (m×ω)·(x×ω)
    /// ```
    ///
    /// and its derivative is at most `γ |m·x''| + J + |m×ω| (3 |x''| + 3 |ω| |x'| + |ω| |x×ω|)`;
    /// |m×ω| does not change. Where the direction is the axis, only drag is left.
    fn max_acceleration(&self, direction: DVec3, from: f64, to: f64) -> f64 {
        let Turns { angular_velocity: omega, rate, .. } = self.turns;
        let State { position: x, velocity: v, acceleration: a, .. } = self.flight.state_at(from);
        let m = self.turns.turned(from)(direction);
        let (m_turn, x_turn) = (m.cross(omega), x.cross(omega));
        let along = m.dot(a);
        let now = along - 2.0 * m_turn.dot(v) - m_turn.dot(x_turn);
        // Upper bounds over the interval.
        let (ahead, growth) = (to - from, self.flight.growth(to));
        let (turn, a) = (m_turn.norm(), a.norm() + growth * ahead);
        let v_max = v.norm() + a * ahead;
        let x_turn_max = x_turn.norm() + rate * ahead * (v.norm() + 0.5 * a * ahead);
        let along_max = along.abs() + turn * a * ahead + growth * ahead;
        let jerk = self.flight.decay_rate() * along_max
            + growth
            + turn * (3.0 * a + 3.0 * rate * v_max + rate * x_turn_max);
        let by_jerk = now + jerk * ahead;
        let by_size = along_max + turn * (2.0 * v_max + x_turn_max);
        by_jerk.min(by_size)
    }

    fn max_acceleration_anywhere(&self, from: f64, to: f64) -> f64 {
        let State { position: x, velocity: v, acceleration: a, .. } = self.flight.state_at(from);
        let (rate, ahead) = (self.turns.rate, to - from);
        let a = a.norm() + self.flight.growth(to) * ahead;
        let v_max = v.norm() + a * ahead;
        let x_max = x.norm() + ahead * (v.norm() + 0.5 * a * ahead);
        a + rate * (2.0 * v_max + rate * x_max)
    }

    fn window(&self) -> f64 {
        self.turns.rate.recip()
    }
}

/// A flight relative to a point that circles the origin, in a coordinate system that does not turn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Orbit<P> {
    pub flight: P,
    pub turns: Turns,
    /// Where the point is at time 0 \[m\].
    pub arm: DVec3,
}

impl<P: Path> Path for Orbit<P> {
    fn state_at(&self, t: f64) -> State {
        let Turns { angular_velocity: omega, rate, .. } = self.turns;
        let State { position, velocity, acceleration, size } = self.flight.state_at(t);
        let arm = self.turns.turned(t)(self.arm);
        let length = self.arm.norm();
        State {
            position: position - arm,
            velocity: velocity - omega.cross(arm),
            acceleration: acceleration - self.turns.twice(arm),
            size: size
                + Magnitudes {
                    length: length * (1.0 + rate * t),
                    speed: rate * length * (1.0 + rate * t),
                    acceleration: rate * rate * length * (1.0 + rate * t),
                },
        }
    }

    /// The flight's own bound, and that of `-ω×(ω×arm)`, which turns with ω.
    fn max_acceleration(&self, direction: DVec3, from: f64, to: f64) -> f64 {
        let rate = self.turns.rate;
        let pull = -self.turns.twice(self.turns.turned(from)(self.arm));
        let most = pull.norm();
        let circling = (direction.dot(pull) + rate * most * (to - from)).min(most);
        self.flight.max_acceleration(direction, from, to) + circling
    }

    fn max_acceleration_anywhere(&self, from: f64, to: f64) -> f64 {
        self.flight.max_acceleration_anywhere(from, to) + self.turns.twice(self.arm).norm()
    }

    fn window(&self) -> f64 {
        self.turns.rate.recip()
    }
}
