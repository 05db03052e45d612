//! Levers: colliders that a key moves from rest to a pressed pose and back, flippers and plungers.

use carom::{Collider, ColliderId, DQuat, DVec3, Motion, MotionPart, Pose, rotation_vector};
use carom_scene::scene;

use crate::role::Role;

/// How a lever moves: from rest to pressed within a second, and how long that takes.
#[derive(Debug, Clone)]
pub(crate) struct Stroke {
    /// Rotation vector from rest to pressed \[rad\].
    turn: DVec3,
    /// Point of its axis, from the position at rest \[m\].
    pivot: DVec3,
    /// Displacement from rest to pressed \[m\].
    shift: DVec3,
    /// Time from rest to pressed \[s\], > 0.
    out: f64,
    /// Time from pressed to rest \[s\], > 0.
    back: f64,
}

impl Stroke {
    /// Reads a stroke from the first three keyframes of a motion: at rest, pressed, and back.
    pub fn of(motion: &[scene::Motion]) -> Option<Self> {
        let [scene::Motion::Keyframes { times, positions, rotations, pivot, .. }] = motion else {
            return None;
        };
        let [rest, pressed, back] = times.get(..3)? else { return None };
        let place = |i: usize| positions.get(i).map_or(DVec3::ZERO, |it| DVec3::from_array(*it));
        let rotation = |i: usize| {
            let given = rotations.get(i).map(|it| DQuat::from_array(*it));
            given.filter(|it| it.length_squared() > 0.0).map_or(DQuat::IDENTITY, DQuat::normalize)
        };
        let begins_at_rest = place(0) == DVec3::ZERO && rotation_vector(rotation(0)) == DVec3::ZERO;
        let (turn, shift) = (rotation_vector(rotation(1)), place(1));
        let moves = turn != DVec3::ZERO || shift != DVec3::ZERO;
        (begins_at_rest && moves && rest < pressed && pressed < back).then(|| Self {
            turn,
            pivot: DVec3::from_array(*pivot),
            shift,
            out: pressed - rest,
            back: back - pressed,
        })
    }

    /// Returns the motion that covers `rate` strokes in a second and is at the part `at` of the stroke at `time` \[s\].
    fn motion(&self, rate: f64, at: f64, time: f64) -> Motion {
        let angle = self.turn.length();
        let turn = MotionPart::Turn { axis: self.turn, pivot: self.pivot, rate: rate * angle };
        let shift = MotionPart::Steady { velocity: rate * self.shift };
        let parts = [(angle > 0.0).then_some(turn), (self.shift != DVec3::ZERO).then_some(shift)];
        Motion::new(parts.into_iter().flatten()).beginning_at(at / rate - time)
    }
}

/// A flipper or a plunger of a game.
#[derive(Debug, Clone)]
pub(crate) struct Lever {
    pub role: Role,
    id: ColliderId,
    /// The collider at rest, without a motion.
    rest: Collider,
    stroke: Stroke,
    /// Part of the stroke at which it is, in \[0, 1\]: 0 at rest, 1 pressed.
    at: f64,
    /// Strokes in a second in the last frame; < 0 on the way back.
    rate: f64,
}

impl Lever {
    /// Creates a lever at rest.
    pub fn new(role: Role, id: ColliderId, rest: Collider, stroke: Stroke) -> Self {
        Self { role, id, rest, stroke, at: 0.0, rate: 0.0 }
    }

    /// Puts the lever to rest.
    pub fn release(&mut self) {
        (self.at, self.rate) = (0.0, 0.0);
    }

    /// Moves the lever by a frame that begins at `time` \[s\] on the world's clock. Returns the collider for this frame,
    /// `None` if it stays as it is.
    pub fn press(
        &mut self,
        pressed: bool,
        frame_time: f64,
        time: f64,
    ) -> Option<(ColliderId, Collider)> {
        let Stroke { out, back, .. } = self.stroke;
        let next = if pressed {
            (self.at + frame_time / out).min(1.0)
        } else {
            (self.at - frame_time / back).max(0.0)
        };
        let rate = (next - self.at) / frame_time;
        let rested = self.rate == 0.0;
        let at = std::mem::replace(&mut self.at, next);
        self.rate = rate;
        match rate {
            0.0 if rested => None,
            0.0 => Some((self.id, self.rest.clone().with_pose(self.pose()))),
            _ => Some((self.id, self.rest.clone().with_motion(self.stroke.motion(rate, at, time)))),
        }
    }

    /// Returns the pose that the lever has reached.
    fn pose(&self) -> Pose {
        if self.at == 0.0 {
            return self.rest.pose;
        }
        self.rest.clone().with_motion(self.stroke.motion(1.0, 0.0, 0.0)).pose_at(self.at)
    }
}
