//! Ties: springs within one step of an integrator, over which they are smooth.

use glam::DVec3;

use crate::flight::Flight;
use crate::forces::Spring;
use crate::integrate::crossing::first_positive;
use crate::norm::Norm;
use crate::polynomial_flight::{ORDERS, PolynomialFlight};
use crate::settings::nearest_image;

/// In a periodic box a spring changes its image this part of an edge beyond half of it.
const BEYOND: f64 = 1e-13;
/// Relative error of positions and velocities: some roundings of this step and of earlier ones.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// A spring from the beginning of a step on, between bodies at two places.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tie<'a> {
    pub spring: &'a Spring,
    /// Place of the sphere at its first end.
    pub first: usize,
    pub second: TieEnd,
    /// Shift from the second end to its nearest image \[m\].
    shift: DVec3,
    phase: Phase,
    resolution: Resolution,
}

/// Rounding of a thread at its rest length: a smaller stretch or tension counts as none.
#[derive(Debug, Clone, Copy)]
struct Resolution {
    /// Rounding of `l² - l0²` \[m²\].
    length: f64,
    /// Rounding of the tension times the length \[N m\].
    tension: f64,
}

/// The second end of a tie.
#[derive(Debug, Clone, Copy)]
pub(super) enum TieEnd {
    /// The sphere at a place.
    Sphere(usize),
    /// \[m\]
    Point(DVec3),
}

/// How a spring acts, until it changes that.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Phase {
    /// The spring pulls and pushes; nothing changes.
    Smooth,
    /// A thread that is not longer than its rest length.
    Slack,
    /// A thread longer than its rest length that shortens so fast that its damper cancels the pull.
    Idle,
    /// A thread that pulls.
    Taut,
    /// Any of these, as the state says.
    Any,
}

impl<'a> Tie<'a> {
    /// A spring between a first end and a second one, with their centres \[m\] and velocities \[m/s\] at the beginning
    /// of a step, in a periodic box with these edges \[m\].
    pub fn begin(
        spring: &'a Spring,
        (first, second): (usize, TieEnd),
        states: [[DVec3; 2]; 2],
        period: DVec3,
    ) -> Self {
        let [[from, velocity], [to, other_velocity]] = states;
        let (offset, velocity) = (to - from, other_velocity - velocity);
        let mut shift = DVec3::ZERO;
        if period != DVec3::INFINITY {
            // Half an edge away, the image in the direction of motion becomes the nearest.
            let beyond = BEYOND * velocity.signum() * period;
            let is_periodic = period.is_finite_mask();
            let along = offset + DVec3::select(is_periodic, beyond, DVec3::ZERO);
            shift = nearest_image(along, period) - along;
        }
        let resolution = Resolution::of(spring, states, shift);
        let phase = Phase::at(spring, [offset + shift, velocity], resolution);
        Self { spring, first, second, shift, phase, resolution }
    }

    /// The tie with changes of its phase inside the step.
    pub fn with_changes(self) -> Self {
        Self { phase: Phase::Any, ..self }
    }

    /// The force on the first end \[N\], for these positions \[m\] and velocities \[m/s\] of both ends.
    pub fn pull(&self, [from, to]: [DVec3; 2], [velocity, other]: [DVec3; 2]) -> DVec3 {
        let (offset, velocity) = (to + self.shift - from, other - velocity);
        match self.phase {
            Phase::Smooth | Phase::Taut => self.spring.pull_or_push(offset, velocity),
            Phase::Slack | Phase::Idle => DVec3::ZERO,
            Phase::Any => self.spring.pull(offset, velocity),
        }
    }

    /// When the spring changes how it acts within `length` \[s\], along the paths of its ends, in a periodic box
    /// with these edges \[m\]; `None` if it does not.
    pub fn change(&self, ends: [TiePath; 2], period: DVec3, length: f64) -> Option<f64> {
        let apart = Apart { ends: relative(ends), shift: self.shift, length };
        let (rest, Resolution { length, tension }) = (self.spring.rest_length, self.resolution);
        // The next phase begins at half of this, so that rounding does not end it at once.
        let (longer, more) = (2.0 * length, 2.0 * tension);
        let of_image = (period != DVec3::INFINITY).then(|| apart.leaves_image(period)).flatten();
        let of_thread = match self.phase {
            Phase::Smooth | Phase::Any => None,
            Phase::Slack => apart.passes_length(rest, (1.0, longer)),
            Phase::Taut if self.spring.damping == 0.0 => apart.passes_length(rest, (-1.0, 0.0)),
            Phase::Taut => apart.passes_tension(self.spring, (-1.0, 0.0)),
            Phase::Idle => {
                let slack = apart.passes_length(rest, (-1.0, 0.0));
                earlier(slack, apart.passes_tension(self.spring, (1.0, more)))
            }
        };
        earlier(of_image, of_thread)
    }
}

fn earlier(first: Option<f64>, second: Option<f64>) -> Option<f64> {
    [first, second].into_iter().flatten().reduce(f64::min)
}

impl Resolution {
    /// Resolution of a spring whose ends have these centres \[m\] and velocities \[m/s\], the second at a shift \[m\].
    fn of(spring: &Spring, [first, second]: [[DVec3; 2]; 2], shift: DVec3) -> Self {
        let rest = spring.rest_length;
        let place = ROUNDING * (first[0].norm() + second[0].norm() + shift.norm() + rest);
        let speed = ROUNDING * (first[1].norm() + second[1].norm());
        let damper = rest * speed + place * (second[1] - first[1]).norm();
        Self {
            length: place * (2.0 * rest + place),
            tension: spring.stiffness * place * (rest + place) + spring.damping * damper,
        }
    }
}

impl Phase {
    /// How a spring acts at this offset of its ends \[m\] and relative velocity \[m/s\].
    fn at(spring: &Spring, [offset, velocity]: [DVec3; 2], resolution: Resolution) -> Self {
        if !spring.only_pulls {
            Self::Smooth
        } else if beyond_length(spring.rest_length, offset) <= resolution.length {
            Self::Slack
        } else if spring.damping > 0.0
            && tension_by_length(spring, offset, velocity) <= resolution.tension
        {
            Self::Idle
        } else {
            Self::Taut
        }
    }
}

/// `l² - l0²` \[m²\]
fn beyond_length(rest_length: f64, offset: DVec3) -> f64 {
    offset.length_squared() - rest_length * rest_length
}

/// The tension of a spring, by its length: `k (l² - l0 l) + c l dl/dt` \[N m\].
fn tension_by_length(spring: &Spring, offset: DVec3, velocity: DVec3) -> f64 {
    let length = offset.norm();
    let stretch = length * length - spring.rest_length * length;
    spring.stiffness * stretch + spring.damping * offset.dot(velocity)
}

/// The path of one end of a spring over a step.
// Two of them at a time, on the stack.
#[allow(clippy::large_enum_variant)]
#[derive(Debug, Clone, Copy)]
pub(super) enum TiePath {
    Polynomial(PolynomialFlight),
    Flight(Flight),
    /// A fixed point \[m\].
    Point(DVec3),
}

impl TiePath {
    /// Place \[m\] and velocity \[m/s\] at a time \[s\].
    fn at(&self, t: f64) -> [DVec3; 2] {
        match self {
            Self::Polynomial(flight) => flight.after(t).into(),
            Self::Flight(flight) => flight.after(t).into(),
            Self::Point(place) => [*place, DVec3::ZERO],
        }
    }

    /// Acceleration \[m/s²\] at a time \[s\] at which it moves with this velocity \[m/s\].
    fn acceleration_at(&self, t: f64, velocity: DVec3) -> DVec3 {
        match self {
            Self::Polynomial(flight) => flight.acceleration.at(t),
            Self::Flight(flight) => flight.acceleration - flight.drag_rate * velocity,
            Self::Point(_) => DVec3::ZERO,
        }
    }

    /// Upper bounds of its speed \[m/s\], its acceleration \[m/s²\] and the rate of change of that \[m/s³\] within a
    /// time \[s\].
    fn bounds(&self, length: f64) -> [f64; 3] {
        match self {
            Self::Polynomial(PolynomialFlight { velocity, acceleration, .. }) => {
                let norms = acceleration.coefficients.map(Norm::norm);
                let sum = |weight: fn(f64) -> f64| -> f64 {
                    norms.iter().zip(ORDERS).map(|(norm, k)| norm * weight(k)).sum()
                };
                let change = acceleration.length * sum(|k| 1.0 / (k + 1.0));
                [velocity.norm() + change, sum(|_| 1.0), sum(|k| k) / acceleration.length]
            }
            Self::Flight(flight) => {
                let acceleration = flight.initial_acceleration().norm();
                let speed = flight.velocity.norm() + length * acceleration;
                [speed, acceleration, flight.drag_rate * acceleration]
            }
            Self::Point(_) => [0.0; 3],
        }
    }
}

/// The ends of a spring without their common motion, where both fly by polynomials over one step. Bounds of the rest are
/// closer.
fn relative(ends: [TiePath; 2]) -> [TiePath; 2] {
    match ends {
        [TiePath::Polynomial(first), TiePath::Polynomial(second)]
            if first.acceleration.length == second.acceleration.length =>
        {
            let flight = PolynomialFlight {
                position: second.position - first.position,
                velocity: second.velocity - first.velocity,
                acceleration: second.acceleration.minus(&first.acceleration),
            };
            [TiePath::Point(DVec3::ZERO), TiePath::Polynomial(flight)]
        }
        others => others,
    }
}

/// The second end of a spring relative to the first, over a step.
struct Apart {
    ends: [TiePath; 2],
    shift: DVec3,
    /// Length of the step \[s\].
    length: f64,
}

impl Apart {
    /// Offset \[m\] and relative velocity \[m/s\] at a time \[s\].
    fn at(&self, t: f64) -> [DVec3; 2] {
        let [first, second] = self.ends.each_ref().map(|end| end.at(t));
        [second[0] + self.shift - first[0], second[1] - first[1]]
    }

    /// Relative acceleration at a time \[s\] \[m/s²\].
    fn acceleration_at(&self, t: f64) -> DVec3 {
        let [first, second] = self.ends.each_ref().map(|end| {
            let [_, velocity] = end.at(t);
            end.acceleration_at(t, velocity)
        });
        second - first
    }

    /// Upper bounds of the distance \[m\], the relative speed \[m/s\], the relative acceleration \[m/s²\] and its rate of
    /// change \[m/s³\].
    fn bounds(&self) -> [f64; 4] {
        let [first, second] = self.ends.each_ref().map(|end| end.bounds(self.length));
        let speed = first[0] + second[0];
        let distance = self.at(0.0)[0].norm() + self.length * speed;
        [distance, speed, first[1] + second[1], first[2] + second[2]]
    }

    /// When the square of the distance is more (`sign` 1) or less (-1) than that of a length \[m\], by more than an
    /// amount \[m²\].
    fn passes_length(&self, rest: f64, (sign, amount): (f64, f64)) -> Option<f64> {
        let [distance, speed, acceleration, _] = self.bounds();
        let curvature = 2.0 * (speed * speed + distance * acceleration);
        let function = |t| {
            let [offset, velocity] = self.at(t);
            let beyond = sign * beyond_length(rest, offset) - amount;
            [beyond, sign * 2.0 * offset.dot(velocity)]
        };
        first_positive(function, curvature, self.length)
    }

    /// When the tension times the length, of a spring longer than its rest length, is above 0 (`sign` 1) or below it (-1)
    /// by more than an amount \[N m\].
    fn passes_tension(&self, spring: &Spring, (sign, amount): (f64, f64)) -> Option<f64> {
        let Spring { rest_length: rest, stiffness, damping, .. } = *spring;
        let [distance, speed, acceleration, jerk] = self.bounds();
        // |l''| <= v²/l + a, and l >= l0.
        let of_pull = 3.0 * speed * speed + (2.0 * distance + rest) * acceleration;
        let of_damper = 3.0 * speed * acceleration + distance * jerk;
        let curvature = stiffness * of_pull + damping * of_damper;
        let function = |t| {
            let ([offset, velocity], acceleration) = (self.at(t), self.acceleration_at(t));
            let along = offset.dot(velocity);
            let length = offset.norm();
            let lengthening = if length > 0.0 { along / length } else { 0.0 };
            let pull = stiffness * (2.0 * along - rest * lengthening);
            let damper = damping * (velocity.length_squared() + offset.dot(acceleration));
            let tension = tension_by_length(spring, offset, velocity);
            [sign * tension - amount, sign * (pull + damper)]
        };
        first_positive(function, curvature, self.length)
    }

    /// When another image of the second end becomes the nearest one.
    fn leaves_image(&self, period: DVec3) -> Option<f64> {
        let [_, _, acceleration, _] = self.bounds();
        let axes = (0..3).filter(|&axis| period[axis].is_finite());
        let sides = axes.flat_map(|axis| [(axis, 1.0), (axis, -1.0)]);
        let leaves = |(axis, side): (usize, f64)| {
            let bound = (0.5 + 2.0 * BEYOND) * period[axis];
            let function = |t| {
                let [offset, velocity] = self.at(t);
                [side * offset[axis] - bound, side * velocity[axis]]
            };
            first_positive(function, acceleration, self.length)
        };
        sides.filter_map(leaves).reduce(f64::min)
    }
}
