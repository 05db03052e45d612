//! Converts motions of colliders.

use carom::{DQuat, DVec3, Keyframe, Keyframes, MotionPart, Pose, World};

use crate::error::Problem;
use crate::scene::values::vector;
use crate::scene::{Collider, Motion, Vector};

impl Motion {
    /// Converts the motion without checking its numbers.
    pub(crate) fn physical(&self) -> MotionPart {
        match *self {
            Self::Steady { velocity } => MotionPart::Steady { velocity: vector(velocity) },
            Self::Oscillate { axis, amplitude, frequency, phase_degrees } => {
                let phase = phase_degrees.to_radians();
                MotionPart::Oscillate { axis: vector(axis), amplitude, frequency, phase }
            }
            Self::Turn { axis, pivot, rate } => {
                MotionPart::Turn { axis: vector(axis), pivot: vector(pivot), rate }
            }
            Self::Swing { axis, pivot, amplitude_degrees, frequency, phase_degrees } => {
                MotionPart::Swing {
                    axis: vector(axis),
                    pivot: vector(pivot),
                    amplitude: amplitude_degrees.to_radians(),
                    frequency,
                    phase: phase_degrees.to_radians(),
                }
            }
            Self::Keyframes { ref times, ref positions, ref rotations, pivot, repeat } => {
                let keyframes = times.iter().enumerate().map(|(number, &time)| {
                    let position = positions.get(number).map_or(DVec3::ZERO, |&it| vector(it));
                    let rotation = rotations.get(number).copied().map(DQuat::from_array);
                    Keyframe { time, position, rotation: rotation.unwrap_or(DQuat::IDENTITY) }
                });
                let keyframes = Keyframes::new(keyframes).about(vector(pivot));
                let repeated = if repeat { keyframes.repeating() } else { keyframes };
                MotionPart::Keyframes(repeated)
            }
        }
    }

    /// Returns an error for a list of poses that is not as long as that of their times.
    fn check_lengths(&self, path: &str) -> Result<(), Problem> {
        let Self::Keyframes { times, positions, rotations, .. } = self else { return Ok(()) };
        for (field, count) in [("positions", positions.len()), ("rotations", rotations.len())] {
            if count != 0 && count != times.len() {
                let wanted =
                    format!("must have one for each of the {} times, not {count}", times.len());
                return Err(Problem::new(format!("{path}.{field}"), wanted));
            }
        }
        Ok(())
    }

    /// Returns the same motion with every vector turned.
    pub(crate) fn turned(&self, turn: &impl Fn(Vector) -> Vector) -> Self {
        let mut part = self.clone();
        match &mut part {
            Self::Steady { velocity } => *velocity = turn(*velocity),
            Self::Oscillate { axis, .. } => *axis = turn(*axis),
            Self::Turn { axis, pivot, .. } | Self::Swing { axis, pivot, .. } => {
                (*axis, *pivot) = (turn(*axis), turn(*pivot));
            }
            Self::Keyframes { positions, rotations, pivot, .. } => {
                *pivot = turn(*pivot);
                positions.iter_mut().for_each(|it| *it = turn(*it));
                for [x, y, z, _] in rotations {
                    [*x, *y, *z] = turn([*x, *y, *z]);
                }
            }
        }
        part
    }

    /// Converts a part of a motion of `carom` to the fields of a scene file; `None` for one that they cannot say.
    pub fn of(part: &MotionPart) -> Option<Self> {
        Some(match *part {
            MotionPart::Steady { velocity } => Self::Steady { velocity: velocity.to_array() },
            MotionPart::Oscillate { axis, amplitude, frequency, phase } => Self::Oscillate {
                axis: axis.to_array(),
                amplitude,
                frequency,
                phase_degrees: phase.to_degrees(),
            },
            MotionPart::Turn { axis, pivot, rate } => {
                Self::Turn { axis: axis.to_array(), pivot: pivot.to_array(), rate }
            }
            MotionPart::Swing { axis, pivot, amplitude, frequency, phase } => Self::Swing {
                axis: axis.to_array(),
                pivot: pivot.to_array(),
                amplitude_degrees: amplitude.to_degrees(),
                frequency,
                phase_degrees: phase.to_degrees(),
            },
            MotionPart::Keyframes(ref keyframes) => Self::of_keyframes(keyframes),
            _ => return None,
        })
    }

    fn of_keyframes(keyframes: &Keyframes) -> Self {
        let list = keyframes.keyframes();
        let moves = list.iter().any(|it| it.position != DVec3::ZERO);
        let turns = list.iter().any(|it| it.rotation != DQuat::IDENTITY);
        let positions = list.iter().filter(|_| moves).map(|it| it.position.to_array());
        let rotations = list.iter().filter(|_| turns).map(|it| it.rotation.to_array());
        Self::Keyframes {
            times: list.iter().map(|it| it.time).collect(),
            positions: positions.collect(),
            rotations: rotations.collect(),
            pivot: keyframes.pivot().to_array(),
            repeat: keyframes.repeats(),
        }
    }
}

impl Collider {
    /// Returns the description of the collider as it is in a world now, but for its motion: of one with a motion, in the
    /// pose at rest.
    pub fn now(&self, collider: &carom::Collider) -> Self {
        let Pose { position, rotation } = collider.motion.rest().unwrap_or(collider.pose);
        let (position, rotation) = (position.to_array(), rotation.to_array());
        let friction = collider.friction;
        let now = Self {
            position,
            rotation,
            restitution: collider.restitution,
            friction: friction.sliding,
            rolling_friction: friction.rolling,
            spinning_friction: friction.spinning,
            tangential_restitution: friction.tangential_restitution,
            ..self.clone()
        };
        if !collider.motion.is_empty() {
            return now;
        }
        // The motion sets the velocities of others.
        let velocity = collider.velocity.to_array();
        let angular_velocity = collider.angular_velocity.to_array();
        Self { velocity, angular_velocity, ..now }
    }

    /// Returns the same description for a scene that begins at `time` \[s\] of this one.
    pub fn beginning_at(&self, time: f64) -> Self {
        if self.motion.is_empty() || time == 0.0 {
            return self.clone();
        }
        let parts: Vec<MotionPart> = self.motion.iter().map(Motion::physical).collect();
        let later = carom::Motion::new(parts).beginning_at(time);
        Self { motion: later.parts().iter().filter_map(Motion::of).collect(), ..self.clone() }
    }
}

/// Converts the motion of the collider at `path`, and checks its numbers.
pub(crate) fn motion(collider: &Collider, path: &str) -> Result<carom::Motion, Problem> {
    for (i, part) in collider.motion.iter().enumerate() {
        let number = if collider.motion.len() == 1 { String::new() } else { format!("[{i}]") };
        let path = format!("{path}.motion{number}.{}", part.kind());
        part.check_lengths(&path)?;
        // Adding it to an empty world checks it.
        let alone = carom::Collider::new(carom::Shape::HalfSpace, Pose::at(DVec3::ZERO));
        let added = World::default().add_collider(alone.with_motion([part.physical()]));
        added.map_err(|error| in_degrees(part, Problem::of_physics(&path, error)))?;
    }
    Ok(collider.motion.iter().map(Motion::physical).collect::<Vec<_>>().into())
}

/// Names the fields that scene files have in degrees.
fn in_degrees(part: &Motion, mut problem: Problem) -> Problem {
    let is_angle = problem.field.ends_with(".phase")
        || (matches!(part, Motion::Swing { .. }) && problem.field.ends_with(".amplitude"));
    if is_angle {
        problem.field.push_str("_degrees");
    }
    problem
}
