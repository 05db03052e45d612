//! Upper bounds of the derivatives of a motion over a time.

use std::f64::consts::TAU;

use super::moment::Moment;
use super::{Keyframes, Kinematics, Motion, MotionPart};
use crate::norm::Norm;

/// Upper bounds of the derivatives of a motion over a time.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct MotionBounds {
    /// Largest distance of the origin from its position at the start \[m\].
    pub way: f64,
    /// Speed of the origin \[m/s\].
    pub speed: f64,
    /// Acceleration of the origin \[m/s²\].
    pub acceleration: f64,
    /// Third derivative of the position of the origin \[m/s³\].
    pub jerk: f64,
    /// Angular velocity \[rad/s\].
    pub spin: f64,
    /// Angular acceleration \[rad/s²\].
    pub spin_growth: f64,
    /// Second derivative of the angular velocity \[rad/s³\].
    pub spin_jerk: f64,
}

impl MotionBounds {
    /// Returns the bounds of a motion from a time on, for `length` \[s\].
    pub fn of(motion: &Motion, time: Moment, length: f64) -> Self {
        let (mut state, mut bounds) = (Kinematics::REST, Self::default());
        let last = motion.parts().len().saturating_sub(1);
        for (number, part) in motion.parts().iter().enumerate() {
            bounds = match *part {
                MotionPart::Keyframes(ref keyframes) => {
                    bounds.carried_through(keyframes, &state, (time, length))
                }
                MotionPart::Steady { velocity } => {
                    let speed = velocity.norm();
                    bounds.shifted(speed * length, [speed, 0.0, 0.0])
                }
                MotionPart::Oscillate { amplitude, frequency, .. } => {
                    let derivatives = sine(amplitude, frequency);
                    let way = (derivatives[0] * length).min(2.0 * amplitude.abs());
                    bounds.shifted(way, derivatives)
                }
                MotionPart::Turn { pivot, rate, .. } => {
                    let (arm, angle) = ((state.offset - pivot).norm(), rate.abs() * length);
                    bounds.turned(arm, angle, [rate.abs(), 0.0, 0.0])
                }
                MotionPart::Swing { pivot, amplitude, frequency, .. } => {
                    let derivatives = sine(amplitude, frequency);
                    let angle = (derivatives[0] * length).min(2.0 * amplitude.abs());
                    bounds.turned((state.offset - pivot).norm(), angle, derivatives)
                }
            };
            if number < last && motion.turns() {
                state = state.carried_by(part, time);
            }
        }
        bounds
    }

    /// Adds a motion by keyframes, from a state of the parts before it. Where it passes a keyframe, accelerations jump
    /// and their derivatives have no bound.
    fn carried_through(
        self,
        keyframes: &Keyframes,
        before: &Kinematics,
        (time, length): (Moment, f64),
    ) -> Self {
        let now = keyframes.way_at(time);
        let (mut way, mut derivatives, mut turns) = (0.0f64, [0.0; 3], [[0.0; 3]; 3]);
        let (pieces, passes) = keyframes.passed(time, length);
        for piece in pieces {
            let away = piece.places.iter().map(|&it| (it - now).norm());
            way = away.fold(way, f64::max);
            derivatives = largest(derivatives, piece.way_bounds());
            for (number, turn) in turns.iter_mut().enumerate() {
                *turn = largest(*turn, piece.turn_bounds(number));
            }
        }
        let jerk = |[rate, growth, jerk]: [f64; 3]| {
            [rate, growth, if passes { f64::INFINITY } else { jerk }]
        };
        let arm = (before.offset - keyframes.pivot()).norm();
        let turned = turns
            .into_iter()
            .rev()
            .fold(self, |bounds, turn| bounds.turned(arm, turn[0] * length, jerk(turn)));
        turned.shifted(way.min(derivatives[0] * length), jerk(derivatives))
    }

    /// Adds a translation of at most `way` \[m\] with these bounds of its derivatives.
    fn shifted(self, way: f64, [speed, acceleration, jerk]: [f64; 3]) -> Self {
        Self {
            way: self.way + way,
            speed: self.speed + speed,
            acceleration: self.acceleration + acceleration,
            jerk: self.jerk + jerk,
            ..self
        }
    }

    /// Adds a rotation by at most an angle \[rad\], with bounds of its derivatives; `arm` is the distance from the
    /// pivot at the start \[m\]. The bounds are the norms of the terms of [`Kinematics`] and of their derivatives.
    fn turned(self, arm: f64, angle: f64, [rate, growth, jerk]: [f64; 3]) -> Self {
        let Self { way, speed, acceleration, spin, spin_growth, .. } = self;
        // A chord is no longer than its arc, nor than the diameter.
        let (swept, arm) = (angle.min(2.0) * arm, arm + way);
        Self {
            way: way + swept,
            speed: speed + rate * arm,
            acceleration: acceleration + 2.0 * rate * speed + (growth + rate * rate) * arm,
            jerk: self.jerk
                + 3.0 * (rate * acceleration + (growth + rate * rate) * speed)
                + (jerk + 3.0 * rate * growth + rate * rate * rate) * arm,
            spin: spin + rate,
            spin_growth: spin_growth + rate * spin + growth,
            spin_jerk: self.spin_jerk
                + 2.0 * rate * spin_growth
                + (growth + rate * rate) * spin
                + jerk,
        }
    }
}

/// Returns the larger of each pair of values.
fn largest(first: [f64; 3], second: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|order| first[order].max(second[order]))
}

/// Returns the largest values of the derivatives of `A sin(2π f t + φ)`.
fn sine(amplitude: f64, frequency: f64) -> [f64; 3] {
    let (size, rate) = (amplitude.abs(), TAU * frequency);
    [size * rate, size * rate * rate, size * rate * rate * rate]
}

#[cfg(test)]
mod tests {
    use glam::{DQuat, DVec3};

    use super::super::Keyframe;
    use super::*;

    #[test]
    fn derivatives_between_keyframes_are_below_their_bounds() {
        let turned = |x: f64, y: f64, z: f64| DQuat::from_xyzw(x, y, z, 0.7).normalize();
        let keyframes = Keyframes::new([
            Keyframe::at(0.0, DVec3::ZERO),
            Keyframe::at(0.5, DVec3::new(0.3, 0.1, -0.2)).rotated(turned(0.5, -0.2, 0.4)),
            Keyframe::at(1.3, DVec3::new(-0.2, 0.6, 0.2)).rotated(turned(-0.3, 0.8, 0.1)),
            Keyframe::at(2.0, DVec3::ZERO),
        ]);
        let keyframes = keyframes.about(DVec3::new(0.3, -1.0, 0.7)).repeating();
        let swing = MotionPart::Swing {
            axis: DVec3::Z,
            pivot: DVec3::X,
            amplitude: 0.6,
            frequency: 0.2,
            phase: 1.0,
        };
        let motion = Motion::new([swing, MotionPart::Keyframes(keyframes)]);
        let (length, h) = (0.1, 1e-4);
        for begin in [0.1, 0.35, 0.45, 1.0, 1.25, 1.95, 7.4] {
            let bounds = MotionBounds::of(&motion, [begin, 0.0], length);
            let at = |t: f64| Kinematics::of(&motion, [begin, t]);
            let start = at(0.0);
            for step in 0..1000 {
                let [now, next] = [0.0, h].map(|t| at(f64::from(step) * h + t));
                let jerk = (next.acceleration - now.acceleration) / h;
                let spin_jerk = (next.angular_acceleration - now.angular_acceleration) / h;
                let limits = [
                    ((now.offset - start.offset).norm(), bounds.way),
                    (now.velocity.norm(), bounds.speed),
                    (now.acceleration.norm(), bounds.acceleration),
                    (jerk.norm(), bounds.jerk),
                    (now.angular_velocity.norm(), bounds.spin),
                    (now.angular_acceleration.norm(), bounds.spin_growth),
                    (spin_jerk.norm(), bounds.spin_jerk),
                ];
                for (value, bound) in limits {
                    // Differences carry the rounding of 1e-14 over h.
                    assert!(value <= bound + 1e-9, "{begin} {step}: {limits:?}");
                }
            }
        }
    }

    #[test]
    fn no_derivative_is_above_its_bound_and_some_come_near() {
        let (axis, pivot) = (DVec3::new(1.0, 2.0, -0.5), DVec3::new(0.3, -1.0, 0.7));
        let oscillate = MotionPart::Oscillate { axis, amplitude: 0.4, frequency: 0.3, phase: 0.2 };
        let turn = MotionPart::Turn { axis: DVec3::Y, pivot, rate: 1.3 };
        let swing = MotionPart::Swing { axis, pivot, amplitude: 0.6, frequency: 0.2, phase: 1.0 };
        let steady = MotionPart::Steady { velocity: DVec3::new(0.1, 0.2, 0.3) };
        for parts in [
            vec![oscillate.clone()],
            vec![turn.clone()],
            vec![steady, turn, swing.clone()],
            vec![swing, oscillate],
        ] {
            let motion = Motion::new(parts);
            let (length, h) = (10.0, 1e-3);
            let bounds = MotionBounds::of(&motion, [2.0, 0.0], length);
            let (mut most, mut way) = ([0.0f64; 6], 0.0f64);
            let start = Kinematics::of(&motion, [2.0, 0.0]).offset;
            for step in 0..10_000 {
                let [now, next] =
                    [0.0, h].map(|t| Kinematics::of(&motion, [2.0, f64::from(step) * h + t]));
                let jerk = (next.acceleration - now.acceleration) / h;
                let spin_jerk = (next.angular_acceleration - now.angular_acceleration) / h;
                way = way.max((now.offset - start).norm());
                let sizes = [now.velocity, now.acceleration, jerk, now.angular_velocity]
                    .into_iter()
                    .chain([now.angular_acceleration, spin_jerk]);
                most.iter_mut().zip(sizes).for_each(|(most, it)| *most = most.max(it.norm()));
            }
            let MotionBounds { speed, acceleration, jerk, spin, spin_growth, spin_jerk, .. } =
                bounds;
            assert!(way <= bounds.way, "{way} {bounds:?}");
            for (most, bound) in
                most.into_iter().zip([speed, acceleration, jerk, spin, spin_growth, spin_jerk])
            {
                // Differences carry the rounding of 1e-16 over h.
                assert!(most <= bound + 1e-11, "{most} {bounds:?}");
            }
            // The bound of a speed is the sum of the bounds of the parts.
            assert!(most[0] >= 0.2 * speed, "{most:?} {bounds:?}");
        }
    }
}
