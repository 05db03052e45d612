//! The motion of a collider from some time on.

use glam::{DQuat, DVec3};

use super::kinematics::Moment;
use super::{Kinematics, Motion, MotionBounds};
use crate::pose::Pose;
use crate::rotation;
use crate::surface_motion::{Drive, SurfaceMotion};

/// The motion of a collider from some time on.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Course {
    motion: Motion,
    rest: Pose,
    /// When it begins, on the world's clock \[s\].
    time: Moment,
}

/// Motion of a collider since an earlier time.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Carriage {
    /// Place of its origin \[m\].
    pub to: DVec3,
    /// Rotation since then, if it turns at all.
    pub turn: Option<DQuat>,
    pub motion: SurfaceMotion,
}

impl Course {
    /// Of a collider that is in a pose now, at `time` \[s\]. If its motion has not put it there, its pose at rest is
    /// elsewhere, so that it is there.
    pub fn new(motion: Motion, pose: Pose, time: f64) -> Self {
        let rest = motion.rest().unwrap_or(pose);
        let is_elsewhere = motion.rest().is_some() && !motion.has_put(pose);
        let course = Self { motion, rest, time: [time, 0.0] };
        let rest = if is_elsewhere { course.rest_for(pose) } else { rest };
        Self { rest, ..course }
    }

    /// The same motion from `h` \[s\] later on.
    pub fn after(&self, h: f64) -> Self {
        Self { time: self.moment(h), ..self.clone() }
    }

    fn moment(&self, h: f64) -> Moment {
        [self.time[0], self.time[1] + h]
    }

    /// How far it has brought the collider from rest after `h` \[s\].
    pub fn state(&self, h: f64) -> Kinematics {
        Kinematics::of(&self.motion, self.moment(h))
    }

    /// Where the collider is after `h` \[s\], and how its surfaces move there.
    pub fn place(&self, h: f64) -> (Pose, SurfaceMotion) {
        self.place_in(&self.state(h))
    }

    /// Motion of the collider within `h` \[s\].
    pub fn carriage(&self, h: f64) -> Carriage {
        let state = self.state(h);
        let (pose, motion) = self.place_in(&state);
        Carriage { to: pose.position, turn: self.turn_in(&state), motion }
    }

    fn place_in(&self, state: &Kinematics) -> (Pose, SurfaceMotion) {
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
            turns: self.turns(),
        };
        let motion = SurfaceMotion {
            origin,
            velocity: state.velocity,
            angular_velocity: state.angular_velocity,
            drive: Some(drive),
        };
        (Pose { position: origin, rotation }, motion)
    }

    /// Rotation from the present directions to those of a state.
    fn turn_in(&self, state: &Kinematics) -> Option<DQuat> {
        self.turns().then(|| state.rotation * self.state(0.0).rotation.conjugate())
    }

    /// The steady motion that takes the collider from where it is after `from` \[s\] to where it is after `to` \[s\].
    pub fn mean_motion(&self, [from, to]: [f64; 2]) -> SurfaceMotion {
        let (start, motion) = self.place(from);
        let (end, _) = self.place(to);
        let h = to - from;
        let velocity = (end.position - start.position) / h;
        let angular_velocity = if self.turns() {
            rotation::vector_of(end.rotation * start.rotation.conjugate()) / h
        } else {
            DVec3::ZERO
        };
        SurfaceMotion { velocity, angular_velocity, ..motion }
    }

    /// Bounds from `from` \[s\] on, for `length` \[s\].
    pub fn bounds(&self, from: f64, length: f64) -> MotionBounds {
        MotionBounds::of(&self.motion, self.moment(from), length)
    }

    /// Whether directions change with it.
    pub fn turns(&self) -> bool {
        self.motion.turns()
    }

    /// A bound of the rate at which something of it repeats or turns \[rad/s\].
    pub fn rate(&self) -> f64 {
        self.motion.rate()
    }

    /// The pose of the collider without its motion.
    pub fn rest(&self) -> Pose {
        self.rest
    }

    /// The pose at rest that has the collider in this pose now.
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
