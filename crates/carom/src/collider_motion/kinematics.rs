//! Displacement of a collider by its motion, and its derivatives.

use std::f64::consts::TAU;

use glam::{DQuat, DVec3};

use super::keyframes::{Piece, Place};
use super::moment::Moment;
use super::{Keyframes, Motion, MotionPart};
use crate::norm::Norm;

/// Displacement of a collider from rest, with its derivatives in time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Kinematics {
    /// Vector from the origin at rest to the present origin \[m\].
    pub offset: DVec3,
    /// Velocity of the origin \[m/s\].
    pub velocity: DVec3,
    /// Acceleration of the origin \[m/s²\].
    pub acceleration: DVec3,
    /// Rotation from the orientation at rest.
    pub rotation: DQuat,
    /// Angular velocity \[rad/s\].
    pub angular_velocity: DVec3,
    /// Angular acceleration \[rad/s²\].
    pub angular_acceleration: DVec3,
}

impl Kinematics {
    /// State of a collider at rest.
    pub(super) const REST: Self = Self {
        offset: DVec3::ZERO,
        velocity: DVec3::ZERO,
        acceleration: DVec3::ZERO,
        rotation: DQuat::IDENTITY,
        angular_velocity: DVec3::ZERO,
        angular_acceleration: DVec3::ZERO,
    };

    /// Evaluates a motion at a time.
    pub fn of(motion: &Motion, time: Moment) -> Self {
        motion.parts().iter().fold(Self::REST, |state, part| state.carried_by(part, time))
    }

    /// Adds one more part, which carries the earlier ones along.
    pub(super) fn carried_by(self, part: &MotionPart, time: Moment) -> Self {
        match *part {
            MotionPart::Steady { velocity } => {
                self.shifted([velocity * time[0] + velocity * time[1], velocity, DVec3::ZERO])
            }
            MotionPart::Oscillate { axis, amplitude, frequency, phase } => {
                let axis = axis.normalize();
                self.shifted(sine(amplitude, frequency, phase, time).map(|it| it * axis))
            }
            MotionPart::Turn { axis, pivot, rate } => {
                let cycles = rate * time[0] / TAU;
                let angle = TAU * (cycles - libm::floor(cycles)) + rate * time[1];
                self.turned(axis.normalize(), pivot, [angle, rate, 0.0])
            }
            MotionPart::Swing { axis, pivot, amplitude, frequency, phase } => {
                self.turned(axis.normalize(), pivot, sine(amplitude, frequency, phase, time))
            }
            MotionPart::Keyframes(ref keyframes) => self.carried_through(keyframes, time),
        }
    }

    /// Adds a motion by keyframes.
    fn carried_through(self, keyframes: &Keyframes, time: Moment) -> Self {
        let pivot = keyframes.pivot();
        match keyframes.place_at(time) {
            Some(Place::Moves(piece, part)) => self.carried_on(piece, pivot, part),
            Some(Place::Rests(keyframe)) => {
                let rest = [keyframe.position, DVec3::ZERO, DVec3::ZERO];
                self.rotated(keyframe.rotation.normalize(), pivot).shifted(rest)
            }
            None => self,
        }
    }

    /// Adds the motion at a part s of a piece between keyframes: the rotation
    ///
    /// ```text
    /// q₀ exp(w₁ (1 - (1 - s)³)) exp(w₂ (3 s² - 2 s³)) exp(w₃ s³)
    /// ```
    ///
    /// (Kim, Kim and Shin, SIGGRAPH 1995, "Hermite quaternion curve"), then the displacement.
    pub(super) fn carried_on(self, piece: &Piece, pivot: DVec3, part: f64) -> Self {
        let (s, rest, rate) = (part, 1.0 - part, piece.length.recip());
        let [first, middle, last] = piece.turns;
        let in_time =
            |[value, slope, change]: [f64; 3]| [value, slope * rate, change * rate * rate];
        let weights = [
            [s * s * s, 3.0 * s * s, 6.0 * s],
            [s * s * (3.0 - 2.0 * s), 6.0 * s * rest, 6.0 - 12.0 * s],
            [1.0 - rest * rest * rest, 3.0 * rest * rest, -6.0 * rest],
        ];
        let turned = [last, middle, first].into_iter().zip(weights.map(in_time));
        let state = turned.fold(self, |state, (turn, weights)| {
            let angle = turn.norm();
            if angle == 0.0 {
                return state;
            }
            state.turned(turn / angle, pivot, weights.map(|it| angle * it))
        });
        state.rotated(piece.rotation, pivot).shifted(piece.way_at(part))
    }

    /// Adds a fixed rotation about a pivot.
    fn rotated(self, rotation: DQuat, pivot: DVec3) -> Self {
        Self {
            offset: pivot + rotation * (self.offset - pivot),
            velocity: rotation * self.velocity,
            acceleration: rotation * self.acceleration,
            rotation: rotation * self.rotation,
            angular_velocity: rotation * self.angular_velocity,
            angular_acceleration: rotation * self.angular_acceleration,
        }
    }

    /// Adds a translation, given by the displacement and its derivatives.
    fn shifted(self, [way, velocity, acceleration]: [DVec3; 3]) -> Self {
        Self {
            offset: self.offset + way,
            velocity: self.velocity + velocity,
            acceleration: self.acceleration + acceleration,
            ..self
        }
    }

    /// Adds a rotation Q about an axis k through a pivot by an angle θ, given with its derivatives. With r from the
    /// pivot and `w = θ' k`,
    ///
    /// ```text
    /// x'' = Q r'' + 2 w × Q r' + θ'' k × Q r + w × (w × Q r)        ω = Q ω₀ + w        ω' = Q ω₀' + w × Q ω₀ + θ'' k
    /// ```
    fn turned(self, axis: DVec3, pivot: DVec3, [angle, rate, change]: [f64; 3]) -> Self {
        let (sine, cosine) = libm::sincos(0.5 * angle);
        let turn = DQuat::from_xyzw(axis.x * sine, axis.y * sine, axis.z * sine, cosine);
        let (spin, growth) = (rate * axis, change * axis);
        let arm = turn * (self.offset - pivot);
        let (velocity, own) = (turn * self.velocity, turn * self.angular_velocity);
        let swept = spin.cross(arm);
        Self {
            offset: pivot + arm,
            velocity: velocity + swept,
            acceleration: turn * self.acceleration
                + 2.0 * spin.cross(velocity)
                + growth.cross(arm)
                + spin.cross(swept),
            rotation: turn * self.rotation,
            angular_velocity: own + spin,
            angular_acceleration: turn * self.angular_acceleration + spin.cross(own) + growth,
        }
    }
}

/// Returns `A sin(2π f t + φ)` and its first two derivatives.
fn sine(amplitude: f64, frequency: f64, phase: f64, [start, gone]: Moment) -> [f64; 3] {
    let cycles = frequency * start;
    let rate = TAU * frequency;
    let angle = TAU * (cycles - libm::floor(cycles)) + phase + rate * gone;
    let (sine, cosine) = libm::sincos(angle);
    [amplitude * sine, amplitude * rate * cosine, -amplitude * rate * rate * sine]
}

#[cfg(test)]
mod tests {
    use super::super::Keyframe;
    use super::*;
    use crate::rotation;

    fn keyframes(pivot: DVec3) -> Keyframes {
        let at = |time: f64, [x, y, z]: [f64; 3], turn: DQuat| {
            Keyframe::at(time, DVec3::new(x, y, z)).rotated(turn)
        };
        let turned = |vector: [f64; 3]| rotation::turned(DQuat::IDENTITY, vector.into(), 1.0);
        Keyframes::new([
            at(-1.0, [0.0; 3], turned([0.1, 0.2, -0.3])),
            at(0.5, [0.3, 0.1, -0.2], turned([0.9, -0.2, 0.4])),
            at(3.0, [-0.2, 0.6, 0.2], turned([0.3, 0.8, 0.4])),
            at(6.0, [0.0; 3], turned([0.1, 0.2, -0.3])),
        ])
        .about(pivot)
        .repeating()
    }

    #[test]
    fn derivatives_of_a_sum_are_those_of_its_places() {
        let axis = DVec3::new(1.0, 2.0, -0.5);
        let pivot = DVec3::new(0.3, -1.0, 0.7);
        let motion = Motion::new([
            MotionPart::Oscillate { axis, amplitude: 0.4, frequency: 0.3, phase: 0.2 },
            MotionPart::Turn { axis: DVec3::new(0.0, 1.0, 0.4), pivot, rate: 1.3 },
            MotionPart::Swing { axis, pivot, amplitude: 0.6, frequency: 0.2, phase: 1.0 },
            MotionPart::Keyframes(keyframes(pivot)),
            MotionPart::Steady { velocity: DVec3::new(0.1, 0.2, 0.3) },
        ]);
        let h = 1e-4;
        for time in [0.0, 0.7, 5.3] {
            let [before, now, after] = [-h, 0.0, h].map(|t| Kinematics::of(&motion, [time, t]));
            // Central differences are off by h²/6 of the third derivatives, which are about 10, and by rounding
            // over h.
            let slope = |a: DVec3, b: DVec3| (b - a) / (2.0 * h);
            assert!((slope(before.offset, after.offset) - now.velocity).length() < 1e-6);
            assert!((slope(before.velocity, after.velocity) - now.acceleration).length() < 1e-6);
            let growth = slope(before.angular_velocity, after.angular_velocity);
            assert!((growth - now.angular_acceleration).length() < 1e-6);
            // q' = ω q / 2
            let w = now.angular_velocity;
            let spun = DQuat::from_xyzw(w.x, w.y, w.z, 0.0) * now.rotation;
            let change = (after.rotation - before.rotation) * (1.0 / h);
            assert!((change - spun).length() < 1e-6);
        }
    }
}
