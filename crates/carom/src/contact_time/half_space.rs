//! Contact with a plane at rest, in closed form or by Newton's method from the safe side.

use glam::DVec3;

use super::roundoff::{Gap, Magnitudes, Phase, Zero};
use super::search::time_to_fall;
use crate::flight::{self, Flight, Propagator};

/// Newton's method doubles its digits near a root, gains a time of 1/γ per step on a drag that
/// is dying down (36 of those use up all digits) and a bit per step on a grazing root (27).
const MAX_NEWTON_STEPS: u32 = 200;

/// Time \[s\] at which a sphere in flight comes into contact with a half-space at rest.
///
/// - `plane`: a point \[m\] of it and its unit normal; `radius` \[m\] of the sphere
/// - `size` of the coordinates, speeds and accelerations that `flight` is the difference of
pub(super) fn sphere_half_space(
    flight: &Flight,
    radius: f64,
    plane: (DVec3, DVec3),
    size: &Magnitudes,
    horizon: f64,
) -> Option<f64> {
    let (point, normal) = plane;
    let height = Height {
        distance: (flight.position - point).dot(normal) - radius,
        speed: flight.velocity.dot(normal),
        acceleration: flight.acceleration.dot(normal),
        drag_rate: flight.drag_rate,
    };
    let zero = Zero::flat(size);
    let gap = Gap {
        distance: height.distance,
        speed: height.speed,
        acceleration: height.initial_acceleration(),
    };
    let fall = match gap.phase(&zero) {
        Phase::Contact => Some(0.0),
        Phase::Apart => height.first_fall(),
        Phase::Parting => height.settled(&gap, &zero).first_fall(),
    };
    fall.filter(|&t| t <= horizon)
}

/// Distance of a sphere in flight from a plane: one component of a [`Flight`].
#[derive(Debug, Clone, Copy, PartialEq)]
struct Height {
    /// Distance at time 0 \[m\]; the next two are of the same time.
    distance: f64,
    /// Speed \[m/s\].
    speed: f64,
    /// Acceleration by everything but drag \[m/s²\].
    acceleration: f64,
    /// γ \[1/s\]
    drag_rate: f64,
}

impl Height {
    /// The height with values set to zero that are zero up to rounding, so that a parting sphere starts at the
    /// surface and a resting one starts at rest.
    fn settled(self, gap: &Gap, zero: &Zero) -> Self {
        let distance = if gap.distance < -zero.distance { gap.distance } else { 0.0 };
        let speed = if gap.is_at_rest(zero) { 0.0 } else { self.speed };
        Self { distance, speed, ..self }
    }

    /// d''(0); the later ones have its sign.
    fn initial_acceleration(&self) -> f64 {
        self.acceleration - self.drag_rate * self.speed
    }

    fn at(&self, t: f64) -> f64 {
        let Propagator { drift, fall, .. } = Propagator::over(t, self.drag_rate);
        self.distance + (drift * self.speed + fall * self.acceleration)
    }

    fn speed_at(&self, t: f64) -> f64 {
        let Propagator { decay, drift, .. } = Propagator::over(t, self.drag_rate);
        decay * self.speed + drift * self.acceleration
    }

    /// First time \[s\] at which the height is <= 0 and about to fall, for a height that is not so at the start:
    /// the distance is > 0, or the speed is >= 0.
    fn first_fall(&self) -> Option<f64> {
        if self.drag_rate == 0.0 {
            return self.ballistic_fall();
        }
        let bend = self.initial_acceleration();
        if bend > 0.0 { self.fall_on_the_way_up(bend) } else { self.fall_on_the_way_down(bend) }
    }

    /// Returns the root of a parabola.
    fn ballistic_fall(&self) -> Option<f64> {
        let Self { distance, speed, acceleration, .. } = *self;
        if distance < 0.0 && speed * speed < 2.0 * acceleration * distance {
            // Never out: it turns at the top.
            return Some(-speed / acceleration);
        }
        Some(time_to_fall(distance, speed, -acceleration)).filter(|t| t.is_finite())
    }

    /// Where d'' > 0: d is convex, and falls at the beginning or not at all.
    fn fall_on_the_way_up(&self, bend: f64) -> Option<f64> {
        if self.speed >= 0.0 {
            return None;
        }
        // d' = speed + bend s(t), with s = t f1(γt), is zero at the turn.
        let turn = flight::time_of_drift(-self.speed / bend, self.drag_rate);
        let latest = turn.unwrap_or(f64::MAX);
        if turn.is_some_and(|turn| self.at(turn) > 0.0) {
            return None;
        }
        if self.acceleration == 0.0 {
            return flight::time_of_drift(self.distance / -self.speed, self.drag_rate);
        }
        // A tangent of a convex function meets zero before the function does.
        let mut t = 0.0;
        for _ in 0..MAX_NEWTON_STEPS {
            let next = (t - self.at(t) / self.speed_at(t)).min(latest);
            if next.is_nan() || next <= t {
                break;
            }
            t = next;
        }
        (t < f64::MAX).then_some(t)
    }

    /// Where d'' <= 0: d is concave, and falls from some time on for ever, or from none.
    fn fall_on_the_way_down(&self, bend: f64) -> Option<f64> {
        if self.speed >= 0.0 {
            if self.acceleration >= 0.0 {
                return None;
            }
            let turn = flight::time_of_drift(-self.speed / bend, self.drag_rate)?;
            if self.at(turn) <= 0.0 {
                return Some(turn);
            }
        }
        let mut t = self.falling_time(bend);
        for step in 0..MAX_NEWTON_STEPS {
            let next = t - self.at(t) / self.speed_at(t);
            // The first step may be forward, to after the contact; the others come back to it.
            if next.is_nan() || (step > 0 && next >= t) {
                break;
            }
            t = next.max(0.0);
        }
        t.is_finite().then_some(t)
    }

    /// A time \[s\] at which a concave path falls, not far from zero.
    fn falling_time(&self, bend: f64) -> f64 {
        // The parabola with the curvature of the beginning is below, and falls earlier.
        let parabola = time_to_fall(self.distance, self.speed, -bend);
        if self.speed_at(parabola) < 0.0 {
            return parabola;
        }
        // Under strong drag that is still before the turn. There is a time at which half the
        // terminal speed is reached.
        let spent = (0.5 * self.acceleration - self.drag_rate * self.speed) / bend;
        -libm::log1p(-spent) / self.drag_rate
    }
}
