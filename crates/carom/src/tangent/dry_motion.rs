//! A velocity that dry friction slows down, in dual numbers.

use super::dual::Dual;
use crate::real::{Real, Vector};

/// Fraction of pull and loss below which the part of a pull across the velocity is rounding, so that the pull
/// counts as parallel to the velocity.
const SAME_DIRECTION: f64 = 1e-12;
/// Number of Runge-Kutta steps in the time in which friction alone would end the speed.
const STEPS_PER_SPEED: f64 = 24.0;
/// Largest number of steps.
const MOST_STEPS: f64 = 256.0;
/// Width below which the derivative at the middle replaces a difference quotient.
const NARROW: f64 = 1e-4;

/// The motion `u' = p - c u/|u|` of a slip or of a rolling ball.
#[derive(Debug, Clone, Copy)]
pub(super) struct DryMotion {
    /// u at the start \[m/s\].
    pub velocity: Vector<Dual>,
    /// p \[m/s²\]
    pub pull: Vector<Dual>,
    /// c \[m/s²\], >= 0
    pub loss: Dual,
}

/// State of a motion after a time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moved {
    /// Velocity \[m/s\].
    pub velocity: Vector<Dual>,
    /// Integral of the velocity \[m\].
    pub way: Vector<Dual>,
}

impl DryMotion {
    /// Returns the time at which friction ends the velocity \[s\]: `|u| (c + p cos)` falls at the rate c² - p², with the angle between u
    /// and p.
    pub fn stopping_time(&self) -> Dual {
        let Self { velocity, pull, loss } = *self;
        let speed = velocity.length_squared().sqrt();
        let room = loss * loss - pull.length_squared();
        (loss * speed + velocity.dot(pull)) / room
    }

    /// Returns the motion after a time \[s\]. `ends` says that friction has ended the velocity by then.
    pub fn after(&self, time: Dual, ends: bool) -> Moved {
        let Self { velocity, pull, loss } = *self;
        let speed = velocity.length_squared();
        if loss.value == 0.0 || speed.value == 0.0 {
            return self.straight(time);
        }
        let speed = speed.sqrt();
        let direction = velocity * (Dual::constant(1.0) / speed);
        let along = pull.dot(direction);
        let aside = pull - direction * along;
        let deceleration = loss - along;
        let is_straight =
            aside.value().length() <= SAME_DIRECTION * (pull.value().length() + loss.value);
        if !is_straight && !ends {
            return self.stepped(time);
        }
        // The part across the velocity is small, so its response is linear.
        let [velocity_aside, way_aside] = if ends {
            let twice = deceleration * 2.0;
            let way = speed * speed / (twice * (twice + along));
            [Dual::constant(0.0), way]
        } else {
            response_aside([speed, deceleration, along, time].map(|it| it.value))
                .map(Dual::constant)
        };
        let left = if ends { Dual::constant(0.0) } else { speed - deceleration * time };
        let way = speed * time - deceleration * time * time * 0.5;
        Moved {
            velocity: direction * left + aside * velocity_aside,
            way: direction * way + aside * way_aside,
        }
    }

    /// Returns the motion along a straight line: under friction against the velocity at the start, or against the
    /// pull if the velocity is zero.
    fn straight(&self, time: Dual) -> Moved {
        let Self { velocity, pull, loss } = *self;
        let way = [velocity, pull].into_iter().find(|it| it.length_squared().value > 0.0);
        let rate = way.map_or(pull, |way| pull - way.direction() * loss);
        Moved {
            velocity: velocity + rate * time,
            way: velocity * time + rate * (time * time * 0.5),
        }
    }

    /// Returns the motion by steps of the Runge-Kutta method.
    fn stepped(&self, time: Dual) -> Moved {
        let Self { velocity, pull, loss } = *self;
        let fall = loss.value * time.value / velocity.value().length();
        let steps = (STEPS_PER_SPEED * fall).clamp(1.0, MOST_STEPS) as u32 + 1;
        let h = time * (1.0 / f64::from(steps));
        let half = h * 0.5;
        let rate = |velocity: Vector<Dual>| pull - velocity.direction() * loss;
        let nothing = velocity * Dual::constant(0.0);
        let mut moved = Moved { velocity, way: nothing };
        for _ in 0..steps {
            let u = moved.velocity;
            let first = rate(u);
            let second = rate(u + first * half);
            let third = rate(u + second * half);
            let fourth = rate(u + third * h);
            let mean =
                (first + (second + third) * Dual::constant(2.0) + fourth) * (h * (1.0 / 6.0));
            let bend = (first + second + third) * (h * h * (1.0 / 6.0));
            moved.way = moved.way + u * h + bend;
            moved.velocity = u + mean;
        }
        moved
    }
}

/// Returns velocity and displacement across the motion under a unit pull across it: `w' = 1 - c w/s` with the speed
/// `s = s0 - k t`.
///
/// With `m = ln(s0/s)/k` and q = c - k: `w = s (1 - e^-qm)/q`, and the displacement is `s0² m² (f(2km) - f(2km +
/// qm))/(qm)` with `f(z) = (1 - e^-z)/z`.
fn response_aside([speed, deceleration, along, time]: [f64; 4]) -> [f64; 2] {
    let spent = (deceleration * time / speed).min(1.0 - f64::EPSILON);
    let log = if spent.abs() < 1e-300 { 1.0 } else { -libm::log1p(-spent) / spent };
    let m = time / speed * log;
    let (z, l) = (2.0 * spent * log, along * m);
    let velocity = speed * (1.0 - spent) * m * mean_decay(l);
    let quotient = if l.abs() < NARROW {
        decay_slope(z + 0.5 * l)
    } else {
        (mean_decay(z) - mean_decay(z + l)) / l
    };
    [velocity, speed * speed * m * m * quotient]
}

/// `(1 - e^-z)/z`
fn mean_decay(z: f64) -> f64 {
    if z == 0.0 { 1.0 } else { -libm::expm1(-z) / z }
}

/// Negative derivative of [`mean_decay`]: `(1 - e^-z (1 + z))/z²`.
fn decay_slope(z: f64) -> f64 {
    if z.abs() < 0.01 {
        return 0.5 + z * (-1.0 / 3.0 + z * (1.0 / 8.0 + z * (-1.0 / 30.0 + z / 144.0)));
    }
    (-libm::expm1(-z) - z * libm::exp(-z)) / (z * z)
}
