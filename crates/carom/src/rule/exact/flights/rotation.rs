//! How spheres turn, where friction acts.

use glam::{DQuat, DVec3};

use crate::bodies::Motion;
use crate::norm::Norm;
use crate::polynomial_flight::PolynomialAcceleration;
use crate::rotation::turned;

/// Step of the angle \[rad\] with which orientations are computed where the axis of rotation turns.
const STEP: f64 = 0.1;
/// Largest number of steps; beyond it they are longer.
const MOST_STEPS: f64 = 1e4;
/// An axis counts as fixed if the angular acceleration is along it but for this part.
const SAME_AXIS: f64 = 1e-14;
/// Distance of the nodes of Gauss and Legendre from the middle of a step, as a part of it: √3/6.
const NODE: f64 = 0.288_675_134_594_812_9;

/// Rotation of one sphere since a start time.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Rotation {
    orientation: DQuat,
    /// Angular velocity at the start \[rad/s\].
    angular_velocity: DVec3,
    angular_acceleration: AngularAcceleration,
    /// Start on the world's clock \[s\].
    time: f64,
}

/// \[rad/s²\]
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
enum AngularAcceleration {
    Constant(DVec3),
    /// Angular acceleration of a sphere on a curve: a polynomial over a step.
    Step(Box<PolynomialAcceleration>),
}

impl AngularAcceleration {
    const NONE: Self = Self::Constant(DVec3::ZERO);

    /// The angular velocity that it adds in a time \[s\] \[rad/s\].
    fn change(&self, time: f64) -> DVec3 {
        match self {
            Self::Constant(constant) => time * *constant,
            Self::Step(step) => step.gained_until(time).1,
        }
    }

    /// The mean of that over the time \[rad/s\].
    fn mean_change(&self, time: f64) -> DVec3 {
        match self {
            Self::Constant(constant) => 0.5 * time * *constant,
            Self::Step(_) if time == 0.0 => DVec3::ZERO,
            Self::Step(step) => step.gained_until(time).0 / time,
        }
    }

    /// The constant angular velocity \[rad/s\] that turns as much in a step \[s\] about its `middle` \[s\] as that
    /// which is `w` at the start.
    fn mean_velocity(&self, w: DVec3, middle: f64, step: f64) -> DVec3 {
        match self {
            Self::Constant(a) => w + middle * *a + step * step / 12.0 * a.cross(w),
            Self::Step(_) => {
                let [before, after] =
                    [-NODE, NODE].map(|node| w + self.change(middle + node * step));
                0.5 * (before + after) + 0.5 * NODE * step * after.cross(before)
            }
        }
    }

    /// Returns the angular acceleration at the start.
    fn first(&self) -> DVec3 {
        match self {
            Self::Constant(constant) => *constant,
            Self::Step(step) => step.coefficients[0],
        }
    }

    /// Whether it leaves the axis of an angular velocity \[rad/s\] as it is.
    fn keeps_axis(&self, angular_velocity: DVec3) -> bool {
        let is_along = |acceleration: &DVec3| {
            let twist = acceleration.cross(angular_velocity).norm();
            twist <= SAME_AXIS * acceleration.norm() * angular_velocity.norm()
        };
        match self {
            Self::Constant(constant) => is_along(constant),
            Self::Step(step) => step.coefficients.iter().all(is_along),
        }
    }
}

impl Rotation {
    /// The rotation of a sphere without torque, from its state in `motion` at `time` \[s\].
    pub fn of(motion: &Motion, index: usize, time: f64) -> Self {
        let spin = &motion.spin;
        Self {
            orientation: spin.orientation.get(index).copied().unwrap_or(DQuat::IDENTITY),
            angular_velocity: spin.angular_velocity.get(index).copied().unwrap_or(DVec3::ZERO),
            angular_acceleration: AngularAcceleration::NONE,
            time,
        }
    }

    /// The rotation of a sphere from one time to another \[s\], with its angular velocities \[rad/s\] at both.
    pub fn between(orientation: DQuat, velocities: [DVec3; 2], [from, to]: [f64; 2]) -> Self {
        let [angular_velocity, after] = velocities;
        let change = after - angular_velocity;
        let angular_acceleration =
            if change == DVec3::ZERO { change } else { change / (to - from) };
        let angular_acceleration = AngularAcceleration::Constant(angular_acceleration);
        Self { orientation, angular_velocity, angular_acceleration, time: from }
    }

    /// Angular velocity at `time` \[rad/s\].
    pub fn angular_velocity_at(&self, time: f64) -> DVec3 {
        self.angular_velocity + self.angular_acceleration.change(time - self.time)
    }

    /// Angular acceleration at the start \[rad/s²\].
    pub fn angular_acceleration(&self) -> DVec3 {
        self.angular_acceleration.first()
    }

    /// The angular acceleration over the last step, of this length \[s\]; `None` if it was no step of a curve.
    pub fn last_step(&self, length: f64) -> Option<&PolynomialAcceleration> {
        match &self.angular_acceleration {
            AngularAcceleration::Step(step) if step.length == length => Some(step),
            _ => None,
        }
    }

    /// Orientation at `time` \[s\]: exact where the axis is fixed, else to the fifth order in steps of
    /// [`STEP`] by the expansion of Magnus (Iserles and Nørsett, Phil. Trans. R. Soc. A 357, 983 (1999)).
    pub fn orientation_at(&self, time: f64) -> DQuat {
        let h = time - self.time;
        let Self { orientation, angular_velocity: w, ref angular_acceleration, .. } = *self;
        if angular_acceleration.keeps_axis(w) {
            return turned(orientation, w + angular_acceleration.mean_change(h), h);
        }
        let fastest = w.norm() + angular_acceleration.change(h).norm();
        let steps = (fastest * h.abs() / STEP).ceil().clamp(1.0, MOST_STEPS);
        let step = h / steps;
        (0..steps as u32).fold(orientation, |orientation, number| {
            let middle = (f64::from(number) + 0.5) * step;
            turned(orientation, angular_acceleration.mean_velocity(w, middle, step), step)
        })
    }

    /// Begins another rotation at `time` \[s\], with this angular velocity \[rad/s\] and angular acceleration
    /// \[rad/s²\].
    pub fn begin(&mut self, [angular_velocity, angular_acceleration]: [DVec3; 2], time: f64) {
        let orientation = self.orientation_at(time);
        let angular_acceleration = AngularAcceleration::Constant(angular_acceleration);
        *self = Self { orientation, angular_velocity, angular_acceleration, time };
    }

    /// Begins the rotation of a sphere on a curve over a step from `time` \[s\] on, with this angular acceleration
    /// \[rad/s²\].
    pub fn begin_step(&mut self, angular_acceleration: PolynomialAcceleration, time: f64) {
        self.begin([self.angular_velocity_at(time), DVec3::ZERO], time);
        self.angular_acceleration = AngularAcceleration::Step(Box::new(angular_acceleration));
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
