//! How spheres turn, where friction acts.

use glam::{DQuat, DVec3};

use crate::bodies::Motion;
use crate::norm::Norm;
use crate::rotation::turned;

/// Step of the angle \[rad\] with which orientations are computed where the axis of rotation turns.
const STEP: f64 = 0.1;
/// Largest number of steps; beyond it they are longer.
const MOST_STEPS: f64 = 1e4;
/// An axis counts as fixed if the angular acceleration is along it but for this part.
const SAME_AXIS: f64 = 1e-14;

/// Rotation of one sphere since a start time, with constant angular acceleration.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Rotation {
    orientation: DQuat,
    /// Angular velocity at the start \[rad/s\].
    angular_velocity: DVec3,
    /// Angular acceleration \[rad/s²\].
    angular_acceleration: DVec3,
    /// Start on the world's clock \[s\].
    time: f64,
}

impl Rotation {
    /// The rotation of a sphere without torque, from its state in `motion` at `time` \[s\].
    pub fn of(motion: &Motion, index: usize, time: f64) -> Self {
        let spin = &motion.spin;
        Self {
            orientation: spin.orientation.get(index).copied().unwrap_or(DQuat::IDENTITY),
            angular_velocity: spin.angular_velocity.get(index).copied().unwrap_or(DVec3::ZERO),
            angular_acceleration: DVec3::ZERO,
            time,
        }
    }

    /// The rotation of a sphere from one time to another \[s\], with its angular velocities \[rad/s\] at both.
    pub fn between(orientation: DQuat, velocities: [DVec3; 2], [from, to]: [f64; 2]) -> Self {
        let [angular_velocity, after] = velocities;
        let change = after - angular_velocity;
        let angular_acceleration =
            if change == DVec3::ZERO { change } else { change / (to - from) };
        Self { orientation, angular_velocity, angular_acceleration, time: from }
    }

    /// Angular velocity at `time` \[rad/s\].
    pub fn angular_velocity_at(&self, time: f64) -> DVec3 {
        self.angular_velocity + (time - self.time) * self.angular_acceleration
    }

    /// \[rad/s²\]
    pub fn angular_acceleration(&self) -> DVec3 {
        self.angular_acceleration
    }

    /// Orientation at `time` \[s\]: exact where the axis is fixed, else to the fifth order in steps of
    /// [`STEP`] by the expansion of Magnus (Iserles and Nørsett, Phil. Trans. R. Soc. A 357, 983 (1999)).
    pub fn orientation_at(&self, time: f64) -> DQuat {
        let Self { orientation, angular_velocity: w, angular_acceleration: a, .. } = *self;
        let h = time - self.time;
        let twist = a.cross(w);
        if twist.norm() <= SAME_AXIS * a.norm() * w.norm() {
            return turned(orientation, w + 0.5 * h * a, h);
        }
        let fastest = w.norm() + h.abs() * a.norm();
        let steps = (fastest * h.abs() / STEP).ceil().clamp(1.0, MOST_STEPS);
        let step = h / steps;
        (0..steps as u32).fold(orientation, |orientation, number| {
            let middle = w + (f64::from(number) + 0.5) * step * a;
            turned(orientation, middle + step * step / 12.0 * twist, step)
        })
    }

    /// Begins another rotation at `time` \[s\], with this angular velocity \[rad/s\] and angular acceleration
    /// \[rad/s²\].
    pub fn begin(&mut self, [angular_velocity, angular_acceleration]: [DVec3; 2], time: f64) {
        let orientation = self.orientation_at(time);
        *self = Self { orientation, angular_velocity, angular_acceleration, time };
    }

    /// Ends the torque at `time` \[s\].
    pub fn end_torque(&mut self, time: f64) {
        self.begin([self.angular_velocity_at(time), DVec3::ZERO], time);
    }

    /// Shifts the rotation from `now` \[s\] to another time \[s\].
    pub fn set_time(&mut self, now: f64, time: f64) {
        self.end_torque(now);
        self.time = time;
    }
}

/// Writes the orientations and angular velocities of all spheres at `time` \[s\].
pub(crate) fn write_spin(all: &[Rotation], motion: &mut Motion, time: f64) {
    if all.is_empty() {
        return;
    }
    motion.spin.make_room(all.len());
    let spin = motion.spin.orientation.iter_mut().zip(&mut motion.spin.angular_velocity);
    for (rotation, (orientation, angular_velocity)) in all.iter().zip(spin) {
        *orientation = rotation.orientation_at(time);
        *angular_velocity = rotation.angular_velocity_at(time);
    }
}
