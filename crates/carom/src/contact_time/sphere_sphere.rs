//! Contact of two spheres, and of a sphere and a fixed one.

use glam::DVec3;

use super::obstacle::Obstacle;
use super::path::FlightPair;
use super::roundoff::{DISTANCE_ROUNDOFF, Gap, Magnitudes, Phase, SPEED_ROUNDOFF, Zero};
use super::search;
use crate::flight::{self, Flight};
use crate::norm::Norm;
use crate::real::{Real, Vector};

/// Time \[s\] at which two spheres come into contact whose relative velocity is constant: both
/// fly under the same acceleration, without drag.
///
/// Smaller root of `|r + v t| = R`, in a form without cancellation:
///
/// ```text
/// b = r·v    c = (|r| - R)(|r| + R)    D = v² R² - |r × v|²    t = c / (-b + √D)
/// ```
///
/// D is `b² - v²c`, by Lagrange's identity; the difference of the squares would lose (|r|/R)² in
/// precision. Overlapping and closing spheres are in contact at 0. `None` if they miss or do not
/// close, and if they touch with a closing speed that is zero but for rounding.
///
/// Source: Alder and Wainwright, J. Chem. Phys. 31, 459 (1959); for the quotient, Press et al.,
/// *Numerical Recipes* (2007), 5.6.
///
/// - `offset` r = x2 - x1 \[m\], `relative_velocity` v = v2 - v1 \[m/s\]
/// - `radius_sum` R \[m\], > 0
#[inline]
pub fn sphere_sphere_linear(
    offset: DVec3,
    relative_velocity: DVec3,
    radius_sum: f64,
) -> Option<f64> {
    let approach = Approach::of(offset.into(), relative_velocity.into(), radius_sum);
    if !(approach.closing < 0.0 && approach.discriminant >= 0.0) {
        return None;
    }
    let distance = offset.norm();
    let gap = distance - radius_sum;
    if gap <= DISTANCE_ROUNDOFF * radius_sum {
        let closes = -approach.closing > SPEED_ROUNDOFF * distance * relative_velocity.norm();
        return closes.then(|| approach.time(gap.max(0.0), distance + radius_sum));
    }
    Some(approach.time(gap, distance + radius_sum))
}

/// How two spheres come near each other whose relative velocity is constant; of one pair, or of
/// several side by side. They meet if both close and D >= 0.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Approach<N> {
    /// b of [`sphere_sphere_linear`] \[m²/s\], negative where they close.
    pub closing: N,
    /// D there \[m⁴/s²\].
    pub discriminant: N,
}

impl<N: Real> Approach<N> {
    /// Prepares the equation from the offset r \[m\] and the relative velocity v \[m/s\], for
    /// spheres whose radii have the sum R \[m\].
    #[inline(always)]
    pub fn of(r: Vector<N>, v: Vector<N>, radius_sum: N) -> Self {
        let discriminant = v.dot(v) * radius_sum * radius_sum - r.cross(v).length_squared();
        Self { closing: r.dot(v), discriminant }
    }

    /// When they meet \[s\], from |r| - R and |r| + R \[m\].
    #[inline(always)]
    pub fn time(&self, gap: N, sum: N) -> N {
        gap * sum / (self.discriminant.sqrt() - self.closing)
    }
}

/// Time \[s\] at which two spheres in free flight come into contact.
///
/// With the same drag rate γ and the same acceleration, the relative path is a straight line in
/// the time `s = t f1(γt)`, so [`sphere_sphere_linear`] has the answer, without drag too. In
/// other cases it is searched for; `docs/physics/contact-times.md` describes how.
///
/// - `radius_sum` \[m\], > 0; `horizon` \[s\], >= 0, may be infinite
/// - returns \[s\] in `[0, horizon]`; `None` if there is no contact
pub fn sphere_sphere(
    first: &Flight,
    second: &Flight,
    radius_sum: f64,
    horizon: f64,
) -> Option<f64> {
    let size = Magnitudes::of(first) + Magnitudes::of(second) + Magnitudes::of_length(radius_sum);
    if first.drag_rate == second.drag_rate {
        return sphere_point(&second.relative_to(first), radius_sum, size, horizon);
    }
    let path = FlightPair { first: *first, second: *second };
    let obstacle = Obstacle::Point { radius: radius_sum };
    search::first_contact(&path, &obstacle, size, horizon)
}

/// Time \[s\] at which a centre in flight comes closer than `radius` \[m\] to the origin.
///
/// - `size` of the coordinates, speeds and accelerations that `flight` is the difference of
pub(super) fn sphere_point(
    flight: &Flight,
    radius: f64,
    size: Magnitudes,
    horizon: f64,
) -> Option<f64> {
    if flight.acceleration != DVec3::ZERO {
        return search::first_contact(flight, &Obstacle::Point { radius }, size, horizon);
    }
    match linear_phase(flight, radius, &size) {
        Phase::Contact => Some(0.0),
        // On a straight path, what parts does not return.
        Phase::Parting => None,
        Phase::Apart => {
            let s = sphere_sphere_linear(flight.position, flight.velocity, radius)?;
            flight::time_of_drift(s, flight.drag_rate).filter(|&t| t <= horizon)
        }
    }
}

fn linear_phase(flight: &Flight, radius: f64, size: &Magnitudes) -> Phase {
    let from_core = flight.position.norm();
    let speed = flight.velocity.norm();
    let normal_speed =
        if from_core > 0.0 { flight.position.dot(flight.velocity) / from_core } else { speed };
    // Nothing presses without an acceleration.
    let gap = Gap { distance: from_core - radius, speed: normal_speed, acceleration: 0.0 };
    gap.phase(&Zero::round(size, from_core, speed, 0.0))
}
