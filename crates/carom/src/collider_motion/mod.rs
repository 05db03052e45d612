//! How a collider moves: a sum of parts in closed form, evaluated at any time on the world's clock.

mod bounds;
mod course;
mod keyframes;
mod kinematics;
mod moment;
mod tangents;

use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;

use glam::DVec3;

pub(crate) use bounds::MotionBounds;
pub(crate) use course::{Carriage, Course};
pub use keyframes::{Keyframe, Keyframes};
pub(crate) use kinematics::Kinematics;
use moment::Moment;

use crate::error::InvalidValue;
use crate::norm::Norm;
use crate::pose::Pose;
use crate::validate;

/// A part of the motion of a collider.
///
/// Axes are directions in the world, of any length but zero. A pivot is a point of the axis, relative to the
/// position of the collider at rest, in the coordinates of the world. `t` is the time on the world's clock.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum MotionPart {
    /// Moves by `velocity t`.
    Steady {
        /// Velocity \[m/s\].
        velocity: DVec3,
    },
    /// Moves along an axis by `amplitude sin(2π frequency t + phase)`.
    Oscillate {
        /// Direction of the axis.
        axis: DVec3,
        /// Amplitude \[m\].
        amplitude: f64,
        /// Frequency \[Hz\], >= 0.
        frequency: f64,
        /// Phase \[rad\].
        phase: f64,
    },
    /// Turns about an axis by `rate t`.
    Turn {
        /// Direction of the axis.
        axis: DVec3,
        /// Point of the axis, relative to the position at rest \[m\].
        pivot: DVec3,
        /// Angular velocity \[rad/s\].
        rate: f64,
    },
    /// Turns about an axis by `amplitude sin(2π frequency t + phase)`.
    Swing {
        /// Direction of the axis.
        axis: DVec3,
        /// Point of the axis, relative to the position at rest \[m\].
        pivot: DVec3,
        /// Amplitude \[rad\].
        amplitude: f64,
        /// Frequency \[Hz\], >= 0.
        frequency: f64,
        /// Phase \[rad\].
        phase: f64,
    },
    /// Moves and turns through poses at given times.
    Keyframes(Keyframes),
}

/// How a collider moves, as a function of the time on the world's clock.
///
/// Its parts act one after the other: each carries all parts before it along. So `[turn, oscillate]` is a wheel
/// that is shaken, and `[oscillate, turn]` a piston that goes round.
///
/// ```
/// use carom::{Collider, DVec3, Motion, MotionPart, Pose, Shape, World};
///
/// let shaken = MotionPart::Oscillate { axis: DVec3::Y, amplitude: 0.01, frequency: 25.0, phase: 0.0 };
/// let plate = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_motion([shaken]);
/// let mut world = World::default();
/// let id = world.add_collider(plate)?;
/// world.step(0.01)?; // a quarter of a period
/// let plate = world.collider(id)?;
/// assert!((plate.pose.position.y - 0.01).abs() < 1e-15);
/// assert!(plate.velocity.y.abs() < 1e-12);
/// # Ok::<(), carom::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Motion {
    parts: Arc<[MotionPart]>,
    /// Poses of a collider that is in a world: at rest, and as the motion last set it.
    poses: Option<[Pose; 2]>,
}

impl Motion {
    /// Creates a motion from its parts, which act one after the other.
    pub fn new(parts: impl IntoIterator<Item = MotionPart>) -> Self {
        Self { parts: parts.into_iter().collect(), poses: None }
    }

    /// Returns the parts in the order in which they act.
    pub fn parts(&self) -> &[MotionPart] {
        &self.parts
    }

    /// Returns the same motion for a clock that shows 0 when the present clock shows `time` \[s\].
    pub fn beginning_at(&self, time: f64) -> Self {
        let parts = self.parts.iter().flat_map(|part| part.beginning_at(time));
        Self { parts: parts.collect(), poses: self.poses }
    }

    /// Returns whether it has no parts. Such a collider moves by its velocity and angular velocity.
    pub fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }

    /// Returns the pose of the collider at rest, once it is in a world.
    pub fn rest(&self) -> Option<Pose> {
        self.poses.map(|[rest, _]| rest)
    }

    /// Returns whether the motion set this pose of the collider, not a call from outside.
    pub(crate) fn has_put(&self, pose: Pose) -> bool {
        self.poses.is_some_and(|[_, put]| put == pose)
    }

    /// Returns the same motion with the pose at rest and the pose that it last set.
    pub(crate) fn about(&self, rest: Pose, put: Pose) -> Self {
        Self { parts: self.parts.clone(), poses: Some([rest, put]) }
    }

    /// Returns an upper bound of the angular frequency of oscillations and rotations \[rad/s\].
    pub(crate) fn rate(&self) -> f64 {
        self.parts.iter().map(MotionPart::rate).sum()
    }

    /// Returns whether the orientation changes.
    pub(crate) fn turns(&self) -> bool {
        self.parts.iter().any(|part| match part {
            MotionPart::Steady { .. } | MotionPart::Oscillate { .. } => false,
            MotionPart::Turn { .. } | MotionPart::Swing { .. } => true,
            MotionPart::Keyframes(keyframes) => keyframes.turns(),
        })
    }

    /// Returns how long accelerations stay continuous after a time \[s\]; infinite but for keyframes.
    fn smooth_for(&self, time: Moment) -> f64 {
        let of = |part: &MotionPart| match part {
            MotionPart::Keyframes(keyframes) => keyframes.piece_left(time),
            _ => f64::INFINITY,
        };
        self.parts.iter().map(of).fold(f64::INFINITY, f64::min)
    }

    pub(crate) fn validate(&self) -> Result<(), InvalidValue> {
        self.parts.iter().try_for_each(MotionPart::validate)
    }
}

impl<I: IntoIterator<Item = MotionPart>> From<I> for Motion {
    fn from(parts: I) -> Self {
        Self::new(parts)
    }
}

impl MotionPart {
    /// Returns the same part for a clock that begins at `time` \[s\], and a constant part for the displacement at
    /// that time.
    fn beginning_at(&self, time: f64) -> impl Iterator<Item = Self> + use<> {
        // A sine of frequency 0 and phase π/2 is 1.
        let (frequency, phase) = (0.0, FRAC_PI_2);
        let at_start = match *self {
            Self::Steady { velocity } if velocity * time != DVec3::ZERO => {
                let amplitude = velocity.norm() * time;
                Some(Self::Oscillate { axis: velocity, amplitude, frequency, phase })
            }
            Self::Turn { axis, pivot, rate } => {
                let amplitude = libm::fmod(rate * time, TAU);
                Some(Self::Swing { axis, pivot, amplitude, frequency, phase })
                    .filter(|_| amplitude != 0.0)
            }
            _ => None,
        };
        let mut part = self.clone();
        if let Self::Keyframes(keyframes) = &mut part {
            *keyframes = keyframes.beginning_at(time);
        }
        if let Self::Oscillate { frequency, phase, .. } | Self::Swing { frequency, phase, .. } =
            &mut part
        {
            *phase += libm::fmod(TAU * *frequency * time, TAU);
        }
        at_start.into_iter().chain([part])
    }

    fn rate(&self) -> f64 {
        match *self {
            Self::Steady { .. } => 0.0,
            Self::Oscillate { frequency, .. } => TAU * frequency,
            Self::Swing { amplitude, frequency, .. } => TAU * frequency * amplitude.abs().max(1.0),
            Self::Turn { rate, .. } => rate.abs(),
            Self::Keyframes(ref keyframes) => keyframes.rate(),
        }
    }

    fn validate(&self) -> Result<(), InvalidValue> {
        match *self {
            Self::Steady { velocity } => validate::finite("velocity", velocity),
            Self::Oscillate { axis, amplitude, frequency, phase } => {
                validate::direction("axis", axis)?;
                validate_sine(amplitude, frequency, phase)
            }
            Self::Turn { axis, pivot, rate } => {
                validate::direction("axis", axis)?;
                validate::finite("pivot", pivot)?;
                validate::finite_number("rate", rate)
            }
            Self::Swing { axis, pivot, amplitude, frequency, phase } => {
                validate::direction("axis", axis)?;
                validate::finite("pivot", pivot)?;
                validate_sine(amplitude, frequency, phase)
            }
            Self::Keyframes(ref keyframes) => keyframes.validate(),
        }
    }
}

fn validate_sine(amplitude: f64, frequency: f64, phase: f64) -> Result<(), InvalidValue> {
    validate::finite_number("amplitude", amplitude)?;
    validate::non_negative("frequency", frequency)?;
    validate::finite_number("phase", phase)
}
