//! Steps under forces that damp motion in less than their length, where an explicit scheme would reverse a velocity or
//! make it grow without bound: the implicit Euler scheme, `v' = v + h a(v')`.
//!
//! Source: Hairer and Wanner, *Solving Ordinary Differential Equations II* (1996), IV.3. The scheme is stable however
//! fast the damping is, and leads to the velocity at which forces balance.

use glam::{DMat3, DVec3};

use super::acceleration::acceleration_at;
use super::kinematics::Kinematics;
use crate::interval::Interval;
use crate::norm::Norm;
use crate::system::System;

/// Largest number of iterations of Newton's method. Under quadratic drag the first ones halve the velocity.
const MOST_ITERATIONS: u32 = 64;
/// The iteration has converged when the velocity changes by less than this part.
const CONVERGED: f64 = 1e-12;
/// Change of a velocity by which derivatives are computed, as a part of it.
const SMALL_PART: f64 = 1e-6;

/// Whether forces damp motion in less than a time `h` \[s\]: whether they damp the change Δv of an explicit step of that
/// length at a rate `Δv·(a(v) − a(v + Δv))/|Δv|²` above 1/h.
///
/// - `velocity` \[m/s\] and acceleration `first` \[m/s²\] at which the explicit step begins
/// - `acceleration` \[m/s²\] as a function of the velocity
pub(crate) fn is_damped(
    h: f64,
    (velocity, first): (DVec3, DVec3),
    acceleration: impl Fn(DVec3) -> DVec3,
) -> bool {
    let change = h * first;
    let size = change.norm();
    let opposing = (first - acceleration(velocity + change)).dot(change / size);
    // What is not a number comes from a step that went far too far.
    let goes_too_far = h * opposing > size || opposing.is_nan();
    size > 0.0 && goes_too_far
}

/// Returns the velocity at the end of a step of `h` \[s\] from a velocity `before` \[m/s\], by Newton's method; `None` if
/// that does not converge.
///
/// - `acceleration` \[m/s²\] as a function of the velocity
pub(crate) fn velocity_after(
    h: f64,
    before: DVec3,
    acceleration: impl Fn(DVec3) -> DVec3,
) -> Option<DVec3> {
    let mut velocity = before;
    for _ in 0..MOST_ITERATIONS {
        let there = acceleration(velocity);
        let missing = before + h * there - velocity;
        let scale = if velocity == DVec3::ZERO { h * there.norm() } else { velocity.norm() };
        let slope = |axis: DVec3| {
            let next = velocity + SMALL_PART * scale * axis;
            (acceleration(next) - there) / (next - velocity).dot(axis)
        };
        let slopes = DMat3::from_cols(slope(DVec3::X), slope(DVec3::Y), slope(DVec3::Z));
        let change = (DMat3::IDENTITY - h * slopes).inverse() * missing;
        velocity += change;
        if !velocity.is_finite() {
            return None;
        }
        if change.norm() <= CONVERGED * velocity.norm() {
            return Some(velocity);
        }
    }
    None
}

/// Returns the state of the sphere at an index at the end of an interval, if forces damp its motion in less than that.
///
/// - `between` \[m/s²\]: acceleration by forces between spheres at the start
pub(super) fn step_if_damped(
    system: &System,
    index: usize,
    start: Kinematics,
    between: DVec3,
    interval: Interval,
) -> Option<Kinematics> {
    if !system.has_nonconservative_forces() {
        return None;
    }
    let Interval { time, h } = interval;
    let acceleration = |velocity: DVec3| {
        acceleration_at(system, index, Kinematics { velocity, ..start }, time) + between
    };
    let first = acceleration(start.velocity);
    let is_damped = is_damped(h, (start.velocity, first), acceleration);
    let velocity = is_damped.then(|| velocity_after(h, start.velocity, acceleration))??;
    Some(Kinematics { position: start.position + h * velocity, velocity })
}
