//! Bounds of the motion of a collider within a short time.

use glam::DVec3;

use crate::collider_motion::MotionBounds;
use crate::norm::Norm;
use crate::surface::SurfaceMotion;

/// Bounds of the motion of a collider within a short time.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MovingBounds {
    /// Velocity of the origin at the start \[m/s\].
    pub velocity: DVec3,
    /// Longest way of the origin \[m\].
    pub way: f64,
    /// Longest distance of the origin from where that velocity takes it \[m\].
    pub beside: f64,
    /// Largest angle by which the collider turns \[rad\].
    pub angle: f64,
}

impl MovingBounds {
    /// No bounds at all.
    pub const UNKNOWN: Self = Self {
        velocity: DVec3::ZERO,
        way: f64::INFINITY,
        beside: f64::INFINITY,
        angle: f64::INFINITY,
    };

    /// The bounds of a steady motion for a `length` of time \[s\].
    pub fn steady(motion: &SurfaceMotion, length: f64) -> Self {
        let [way, angle] = [motion.velocity, motion.angular_velocity].map(|it| length * it.norm());
        Self { velocity: motion.velocity, way, beside: 0.0, angle }
    }

    /// The bounds for a `length` of time \[s\] with this velocity at the start \[m/s\].
    pub fn within(length: f64, velocity: DVec3, bounds: &MotionBounds) -> Self {
        let MotionBounds { way, acceleration, jerk, spin, .. } = *bounds;
        // Where the third derivative has no bound, a motion passes from one piece to another.
        let is_smooth = jerk < f64::INFINITY;
        let beside = if is_smooth { 0.5 * acceleration * length * length } else { f64::INFINITY };
        // More by far than rounding.
        Self { velocity, way, beside: beside * (1.0 + 1e-9), angle: spin * length }
    }
}
