//! Free motion between impacts, in closed form.

use glam::DVec3;

use crate::real::{Real, Vector};

/// A sphere in free flight: under a constant acceleration and viscous drag, `x'' = a - γ x'`.
///
/// Without drag the path is a parabola. With it (Lamb, *Dynamics* (1914), "resisted motion"):
///
/// ```text
/// x(t) = x0 + v0 t f1(γt) + a t² f2(γt)       f1(z) = (1 - e^-z)/z
/// v(t) = v0 e^-γt + a t f1(γt)                f2(z) = (z - 1 + e^-z)/z²
/// ```
///
/// f1 -> 1 and f2 -> 1/2 as γ -> 0, where this is the parabola, to the last digit. The terminal
/// velocity is a/γ. Derived in `docs/physics/motion.md`, "Free flight".
///
/// ```
/// use carom::{DVec3, Flight};
///
/// let fall = Flight {
///     position: DVec3::ZERO,
///     velocity: DVec3::X,
///     acceleration: DVec3::new(0.0, -10.0, 0.0),
///     drag_rate: 0.0,
/// };
/// assert_eq!(fall.after(2.0), (DVec3::new(2.0, -20.0, 0.0), DVec3::new(1.0, -20.0, 0.0)));
/// let slowed = Flight { drag_rate: 5.0, ..fall };
/// assert!((slowed.velocity_at(10.0) - DVec3::new(0.0, -2.0, 0.0)).length() < 1e-12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flight {
    /// Centre at time 0, x0 \[m\].
    pub position: DVec3,
    /// Velocity at time 0, v0 \[m/s\].
    pub velocity: DVec3,
    /// Acceleration by everything but drag, a \[m/s²\].
    pub acceleration: DVec3,
    /// Drag coefficient over mass, γ = k/m \[1/s\], >= 0.
    pub drag_rate: f64,
}

impl Flight {
    /// Centre \[m\] at a time \[s\].
    pub fn position_at(&self, t: f64) -> DVec3 {
        self.after(t).0
    }

    /// Velocity \[m/s\] at a time \[s\].
    pub fn velocity_at(&self, t: f64) -> DVec3 {
        self.after(t).1
    }

    /// Centre \[m\] and velocity \[m/s\] at a time \[s\].
    #[inline]
    pub fn after(&self, t: f64) -> (DVec3, DVec3) {
        if self.drag_rate * t == 0.0 {
            let Self { position, velocity, acceleration, .. } = *self;
            let (position, velocity) =
                without_drag(t, position.into(), velocity.into(), acceleration.into());
            return (position.into(), velocity.into());
        }
        let Propagator { decay, drift, fall } = Propagator::over(t, self.drag_rate);
        let position = self.position + (drift * self.velocity + fall * self.acceleration);
        let velocity = decay * self.velocity + drift * self.acceleration;
        (position, velocity)
    }

    /// Largest displacement along each axis within a time \[s\] \[m\]: drag only slows the sphere down.
    #[inline]
    pub(crate) fn farthest(&self, t: f64) -> DVec3 {
        t * (self.velocity.abs() + 0.5 * t * self.acceleration.abs())
    }

    /// This flight in a coordinate system whose origin starts at `origin` \[m\] and moves with a
    /// constant velocity u \[m/s\]. The air stays at rest, so that `w = v - u` obeys
    /// `w' = (a - γu) - γw`.
    pub(crate) fn seen_from(&self, origin: DVec3, u: DVec3) -> Self {
        Self {
            position: self.position - origin,
            velocity: self.velocity - u,
            acceleration: self.acceleration - self.drag_rate * u,
            drag_rate: self.drag_rate,
        }
    }

    /// This flight relative to another with the same drag rate.
    pub(crate) fn relative_to(&self, other: &Self) -> Self {
        Self {
            position: self.position - other.position,
            velocity: self.velocity - other.velocity,
            acceleration: self.acceleration - other.acceleration,
            drag_rate: self.drag_rate,
        }
    }

    /// Acceleration with drag at time 0, `a - γ v0` \[m/s²\]; at time t it is e^-γt times that.
    pub(crate) fn initial_acceleration(&self) -> DVec3 {
        self.acceleration - self.drag_rate * self.velocity
    }
}

/// Centre \[m\] and velocity \[m/s\] after a time t \[s\] without drag, of one flight or of several
/// side by side, from those at its start and an acceleration \[m/s²\]: [`Propagator`] for γ t = 0.
#[inline(always)]
pub(crate) fn without_drag<N: Real>(
    t: N,
    position: Vector<N>,
    velocity: Vector<N>,
    acceleration: Vector<N>,
) -> (Vector<N>, Vector<N>) {
    let fall = (t * 0.5 * t).min(f64::MAX);
    (position + (velocity * t + acceleration * fall), velocity + acceleration * t)
}

/// The effect of a time on a flight: `x = x0 + drift v0 + fall a`, `v = decay v0 + drift a`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Propagator {
    /// e^-γt, dimensionless.
    pub decay: f64,
    /// t f1(γt) \[s\]: the time that counts for a velocity that drag uses up; at most 1/γ.
    pub drift: f64,
    /// t² f2(γt) \[s²\].
    pub fall: f64,
}

/// Derivatives of a [`Propagator`] by the drag rate.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DragSlopes {
    /// -t e^-γt \[s\].
    pub decay: f64,
    /// t² f1'(γt) \[s²\].
    pub drift: f64,
    /// t³ f2'(γt) \[s³\].
    pub fall: f64,
}

impl DragSlopes {
    /// Over a time t \[s\] with the drag rate γ \[1/s\], both >= 0.
    pub fn over(t: f64, drag_rate: f64) -> Self {
        let z = drag_rate * t;
        let decay = libm::exp(-z);
        let [drift, fall] = if z <= 1.0 {
            [slope_series(z, 1), slope_series(z, 2)]
        } else {
            let left = (1.0 + z) * decay - 1.0;
            [left / (z * z), (2.0 - z - (2.0 + z) * decay) / (z * z * z)]
        };
        Self { decay: -t * decay, drift: t * t * drift, fall: t * t * t * fall }
    }
}

/// Derivative of f1 or f2, by its `number`: the sum of `(-1)^k k z^(k-1) / (k + number)!` from k = 1 on, for z <= 1.
fn slope_series(z: f64, number: u32) -> f64 {
    let mut term = if number == 1 { -1.0 / 2.0 } else { -1.0 / 6.0 };
    let mut sum = term;
    for k in 1..20_u32 {
        let [now, next] = [k, k + 1].map(f64::from);
        term *= -z * next / (now * (next + f64::from(number)));
        sum += term;
    }
    sum
}

impl Propagator {
    /// Over a time t \[s\] with the drag rate γ \[1/s\], both >= 0.
    ///
    /// Nothing is infinite, so that an absent velocity or acceleration still adds zero after any
    /// time.
    #[inline]
    pub fn over(t: f64, drag_rate: f64) -> Self {
        let z = drag_rate * t;
        let Self { decay, drift, fall } = if z == 0.0 {
            Self { decay: 1.0, drift: t, fall: 0.5 * t * t }
        } else {
            Self::with_drag(t, drag_rate, z)
        };
        Self { decay, drift: drift.min(f64::MAX), fall: fall.min(f64::MAX) }
    }

    fn with_drag(t: f64, drag_rate: f64, z: f64) -> Self {
        if z <= SERIES_LIMIT {
            let lost = libm::expm1(-z);
            Self { decay: 1.0 + lost, drift: t * (-lost / z), fall: t * t * f2_series(z) }
        } else {
            let decay = libm::exp(-z);
            let drift = -libm::expm1(-z) / drag_rate;
            Self { decay, drift, fall: (t - drift) / drag_rate }
        }
    }
}

/// The time t \[s\] at which `t f1(γt) = s`; `None` if that is never reached, s >= 1/γ.
pub(crate) fn time_of_drift(s: f64, drag_rate: f64) -> Option<f64> {
    let spent = drag_rate * s;
    if spent < f64::EPSILON {
        // t/s = 1 + γs/2 + ... rounds to 1; the quotient below could underflow.
        return Some(s);
    }
    (spent < 1.0).then(|| -libm::log1p(-spent) / drag_rate)
}

/// Up to here f2 is taken from its series, beyond from `(t - drift)/γ`. At 1 the difference
/// `z - (1 - e^-z)` loses less than two bits; below it loses more, above the series needs more
/// terms.
const SERIES_LIMIT: f64 = 1.0;

/// f2(z) = Σ (-z)^k / (k + 2)! for 0 <= z <= [`SERIES_LIMIT`], to round-off.
///
/// The first term left out is below 1/20! = 4e-19, of a sum of at least 0.36.
fn f2_series(z: f64) -> f64 {
    const TERMS: u32 = 18;
    // Horner's rule: 1/2 (1 - z/3 (1 - z/4 (1 - ...))).
    (3..TERMS + 2).rev().fold(1.0, |sum, k| 1.0 - z / f64::from(k) * sum) * 0.5
}
