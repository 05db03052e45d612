//! The motion of a collider from a time on.

use glam::{DQuat, DVec3};

use super::moment::Moment;
use super::{Kinematics, Motion, MotionBounds};
use crate::pose::Pose;
use crate::rotation;
use crate::surface_motion::{Drive, SurfaceMotion};

/// The motion of a collider from a time on.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Course {
    motion: Motion,
    rest: Pose,
    /// Start on the world's clock \[s\].
    time: Moment,
}

/// Displacement and motion of a collider after some time.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Carriage {
    /// Position of its origin \[m\].
    pub to: DVec3,
    /// Rotation since the start; `None` if it never turns.
    pub turn: Option<DQuat>,
    /// Motion of the surface, without that of a belt.
    pub motion: SurfaceMotion,
}

impl Course {
    /// Starts at `time` \[s\] with the present pose of a collider. If the pose was set from outside, the pose at
    /// rest changes to match it.
    pub fn new(motion: Motion, pose: Pose, time: f64) -> Self {
        let rest = motion.rest().unwrap_or(pose);
        let is_elsewhere = motion.rest().is_some() && !motion.has_put(pose);
        let course = Self { motion, rest, time: [time, 0.0] };
        let rest = if is_elsewhere { course.rest_for(pose) } else { rest };
        Self { rest, ..course }
    }

    /// Returns the motion from `h` \[s\] later on.
    pub fn after(&self, h: f64) -> Self {
        Self { time: self.moment(h), ..self.clone() }
    }

    fn moment(&self, h: f64) -> Moment {
        [self.time[0], self.time[1] + h]
    }

    /// Returns the displacement from rest and its derivatives after `h` \[s\].
    pub fn state(&self, h: f64) -> Kinematics {
        Kinematics::of(&self.motion, self.moment(h))
    }

    /// Returns the pose of the collider after `h` \[s\], and the motion of its surfaces then, without a belt.
    pub fn place(&self, h: f64) -> (Pose, SurfaceMotion) {
        self.place_in(h, &self.state(h))
    }

    /// Returns the displacement and motion of the collider after `h` \[s\].
    pub fn carriage(&self, h: f64) -> Carriage {
        let state = self.state(h);
        let (pose, motion) = self.place_in(h, &state);
        Carriage { to: pose.position, turn: self.turn_in(&state), motion }
    }

    fn place_in(&self, h: f64, state: &Kinematics) -> (Pose, SurfaceMotion) {
        let rotation = if self.turns() {
            state.rotation * self.rest.rotation.normalize()
        } else {
            self.rest.rotation
        };
        let origin = self.rest.position + state.offset;
        let drive = Drive {
            acceleration: state.acceleration,
            angular_acceleration: state.angular_acceleration,
            rate: self.rate(),
            smooth_for: self.motion.smooth_for(self.moment(h)),
            turns: self.turns(),
        };
        let motion = SurfaceMotion {
            origin,
            velocity: state.velocity,
            angular_velocity: state.angular_velocity,
            belt: DVec3::ZERO,
            drive: Some(drive),
        };
        (Pose { position: origin, rotation }, motion)
    }

    /// Returns the rotation from the present orientation to that of a state.
    fn turn_in(&self, state: &Kinematics) -> Option<DQuat> {
        self.turns().then(|| state.rotation * self.state(0.0).rotation.conjugate())
    }

    /// Returns the steady motion that takes the collider from its pose after `from` \[s\] to its pose after `to`
    /// \[s\].
    pub fn mean_motion(&self, [from, to]: [f64; 2]) -> SurfaceMotion {
        let (start, motion) = self.place(from);
        let (end, _) = self.place(to);
        let h = to - from;
        let velocity = (end.position - start.position) / h;
        let angular_velocity = if self.turns() {
            rotation::rotation_vector(end.rotation * start.rotation.conjugate()) / h
        } else {
            DVec3::ZERO
        };
        SurfaceMotion { velocity, angular_velocity, ..motion }
    }

    /// Returns bounds of the derivatives from `from` \[s\] on, for `length` \[s\].
    pub fn bounds(&self, from: f64, length: f64) -> MotionBounds {
        MotionBounds::of(&self.motion, self.moment(from), length)
    }

    /// Returns whether the orientation changes.
    pub fn turns(&self) -> bool {
        self.motion.turns()
    }

    /// Returns an upper bound of the angular frequency of oscillations and rotations \[rad/s\].
    pub fn rate(&self) -> f64 {
        self.motion.rate()
    }

    /// Returns the pose of the collider at rest.
    pub fn rest(&self) -> Pose {
        self.rest
    }

    /// Returns the pose at rest for which the motion gives this present pose.
    fn rest_for(&self, pose: Pose) -> Pose {
        let state = self.state(0.0);
        let rotation = if self.turns() {
            state.rotation.conjugate() * pose.rotation.normalize()
        } else {
            pose.rotation
        };
        Pose { position: pose.position - state.offset, rotation }
    }
}
