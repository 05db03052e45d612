//! A motion through given poses at given times: pieces of cubic curves whose velocities are continuous.

use std::sync::Arc;

use glam::{DQuat, DVec3};

use super::moment::Moment;
use super::tangents;
use crate::error::InvalidValue;
use crate::norm::Norm;
use crate::rotation;
use crate::validate;

/// A change of time below this part of its terms is rounding \[1\].
const ROUNDING: f64 = 8.0 * f64::EPSILON;
/// Largest distance of the first from the last rotation of a repeated motion, in parts of a quaternion: rounding.
const CLOSED: f64 = 1e-12;

/// A pose that a collider has at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Keyframe {
    /// Time on the world's clock \[s\].
    pub time: f64,
    /// Displacement from the position at rest \[m\].
    pub position: DVec3,
    /// Rotation from the orientation at rest, of any length but zero; it is followed on the shorter way.
    pub rotation: DQuat,
}

impl Keyframe {
    /// A displacement \[m\] without rotation at a time \[s\].
    pub fn at(time: f64, position: DVec3) -> Self {
        Self { time, position, rotation: DQuat::IDENTITY }
    }

    /// Returns the keyframe with a rotation.
    pub fn rotated(self, rotation: DQuat) -> Self {
        Self { rotation, ..self }
    }
}

/// A motion through poses at given times, with continuous velocities.
///
/// Between two keyframes the displacement is a cubic Hermite polynomial. The velocity at a keyframe is the derivative
/// of the parabola through it and its neighbours, without the part that would lead back along a neighbouring piece,
/// and at most three times the mean velocity of either: along a line the motion passes no keyframe beyond its own
/// range, and rests between equal ones (Fritsch and Carlson, SIAM J. Numer. Anal. 17, 238 (1980)). Rotations follow
/// the Hermite curve of Kim, Kim and Shin (SIGGRAPH 1995), with angular velocities chosen in the same way.
///
/// The collider rests before the first and after the last keyframe, unless the motion repeats.
///
/// ```
/// use carom::{Collider, DVec3, Keyframe, Keyframes, MotionPart, Pose, Shape};
///
/// let lift = [(0.0, 0.0), (2.0, 1.0), (3.0, 1.0), (5.0, 0.0)];
/// let lift = lift.map(|(time, height)| Keyframe::at(time, height * DVec3::Y));
/// let lift = MotionPart::Keyframes(Keyframes::new(lift).repeating());
/// let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_motion([lift]);
/// assert_eq!(floor.pose_at(12.5).position.y, 1.0);
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(from = "Given", into = "Given"))]
pub struct Keyframes {
    given: Given,
    /// Pieces between the keyframes.
    pieces: Arc<[Piece]>,
}

/// What a motion by keyframes is given by.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Given {
    keyframes: Arc<[Keyframe]>,
    pivot: DVec3,
    repeats: bool,
}

/// The motion from one keyframe to the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Piece {
    /// \[s\]
    pub length: f64,
    /// Control points of the displacement as a Bézier curve \[m\].
    pub places: [DVec3; 4],
    /// Rotation at the start.
    pub rotation: DQuat,
    /// The factors of the rotation in the order of their product, as rotation vectors of the body \[rad\].
    pub turns: [DVec3; 3],
}

/// Where a motion by keyframes is at a time.
pub(super) enum Place<'a> {
    /// The motion rests at the first or the last keyframe, for good.
    Rests(&'a Keyframe),
    /// The motion is on a piece, at a part of it.
    Moves(&'a Piece, f64),
}

impl From<Given> for Keyframes {
    fn from(given: Given) -> Self {
        Self { pieces: pieces(&given), given }
    }
}

impl From<Keyframes> for Given {
    fn from(motion: Keyframes) -> Self {
        motion.given
    }
}

impl Keyframes {
    /// Creates a motion through keyframes in the order of their times. Rotations are about the position at rest.
    pub fn new(keyframes: impl IntoIterator<Item = Keyframe>) -> Self {
        let keyframes = keyframes.into_iter().collect();
        Given { keyframes, pivot: DVec3::ZERO, repeats: false }.into()
    }

    /// Returns the motion repeated before and after. The last keyframe must have the pose of the
    /// first.
    pub fn repeating(self) -> Self {
        Given { repeats: true, ..self.given }.into()
    }

    /// Returns the motion with rotations about a point, relative to the position at rest \[m\].
    pub fn about(self, pivot: DVec3) -> Self {
        Self { given: Given { pivot, ..self.given }, ..self }
    }

    /// Returns the keyframes.
    pub fn keyframes(&self) -> &[Keyframe] {
        &self.given.keyframes
    }

    /// Returns the centre of rotations, relative to the position at rest \[m\].
    pub fn pivot(&self) -> DVec3 {
        self.given.pivot
    }

    /// Returns whether the motion repeats.
    pub fn repeats(&self) -> bool {
        self.given.repeats
    }

    /// Returns the same motion for a clock that shows 0 when the present clock shows `time` \[s\].
    pub(super) fn beginning_at(&self, time: f64) -> Self {
        let back = self.period().map_or(time, |period| libm::fmod(time, period));
        let keyframes = self.keyframes().iter();
        let keyframes = keyframes.map(|it| Keyframe { time: it.time - back, ..*it }).collect();
        Given { keyframes, ..self.given.clone() }.into()
    }

    /// Returns whether the orientation changes.
    pub(super) fn turns(&self) -> bool {
        self.keyframes().iter().any(|it| it.rotation != DQuat::IDENTITY)
    }

    /// Returns the time after which it repeats \[s\]; `None` if it does not.
    fn period(&self) -> Option<f64> {
        let [first, .., last] = self.keyframes() else { return None };
        self.repeats().then_some(last.time - first.time)
    }

    /// Returns a time on the clock of the keyframes, as a sum \[s\].
    fn local(&self, [start, gone]: Moment) -> Moment {
        let Some(period) = self.period() else { return [start, gone] };
        let first = self.keyframes()[0].time;
        let since = libm::fmod(libm::fmod(start - first, period) + gone, period);
        [first, if since < 0.0 { since + period } else { since }]
    }

    /// Returns the place at a time; `None` without keyframes.
    pub(super) fn place_at(&self, time: Moment) -> Option<Place<'_>> {
        let [start, gone] = self.local(time);
        let keyframes = self.keyframes();
        let since = |it: &Keyframe| (start - it.time) + gone;
        let begun = keyframes.partition_point(|it| since(it) >= 0.0);
        let number = begun.saturating_sub(1);
        match self.pieces.get(number) {
            Some(piece) if begun > 0 => {
                Some(Place::Moves(piece, since(&keyframes[number]) / piece.length))
            }
            _ => keyframes.get(number).map(Place::Rests),
        }
    }

    /// Returns the displacement at a time \[m\].
    pub(super) fn way_at(&self, time: Moment) -> DVec3 {
        match self.place_at(time) {
            Some(Place::Moves(piece, part)) => piece.way_at(part)[0],
            Some(Place::Rests(keyframe)) => keyframe.position,
            None => DVec3::ZERO,
        }
    }

    /// Returns the pieces on which it is within `length` \[s\] from a time on, and whether it passes a keyframe.
    pub(super) fn passed(&self, time: Moment, length: f64) -> (impl Iterator<Item = &Piece>, bool) {
        let [start, gone] = self.local(time);
        let first = self.keyframes().partition_point(|it| (start - it.time) + gone >= 0.0);
        let last = self.keyframes().partition_point(|it| (start - it.time) + gone + length > 0.0);
        let last = last.max(first);
        let wraps = self.repeats() && last == self.keyframes().len();
        let range = if wraps {
            0..self.pieces.len()
        } else {
            first.saturating_sub(1)..last.min(self.pieces.len())
        };
        (self.pieces[range].iter(), wraps || last > first)
    }

    /// Returns how long the motion lasts on its piece after a time \[s\]; infinite where it rests for good.
    pub(super) fn piece_left(&self, time: Moment) -> f64 {
        let [start, gone] = self.local(time);
        let least = ROUNDING * (time[0].abs() + time[1].abs() + start.abs() + gone.abs());
        let left = self.keyframes().iter().map(|it| (it.time - start) - gone);
        let next = left.filter(|&left| left > least).fold(f64::INFINITY, f64::min);
        match self.period() {
            // It is at the last keyframe, which is the first.
            Some(_) if next == f64::INFINITY => self.pieces.first().map_or(next, |it| it.length),
            _ => next,
        }
    }

    /// Returns an upper bound of the rate at which it changes \[rad/s\].
    pub(super) fn rate(&self) -> f64 {
        self.pieces.iter().map(Piece::rate).fold(0.0, f64::max)
    }

    pub(super) fn validate(&self) -> Result<(), InvalidValue> {
        let keyframes = self.keyframes();
        validate::finite("pivot", self.pivot())?;
        validate::require(keyframes.len() >= 2, "times", "at least two", keyframes.len())?;
        for it in keyframes {
            validate::finite_number("times", it.time)?;
            validate::finite("positions", it.position)?;
            validate::rotation("rotations", it.rotation)?;
        }
        for two in keyframes.windows(2) {
            let [before, after] = [two[0].time, two[1].time];
            let ascends = (after - before).is_normal() && after > before;
            validate::require(ascends, "times", "ascending", after)?;
        }
        let (first, last) = (&keyframes[0], &keyframes[keyframes.len() - 1]);
        let returns = !self.repeats() || first.position == last.position;
        let back = "the first position again at the end, since the motion repeats";
        validate::require(returns, "positions", back, last.position)?;
        let away = 1.0 - first.rotation.normalize().dot(last.rotation.normalize()).abs();
        let back = "the first rotation again at the end, since the motion repeats";
        validate::require(!self.repeats() || away <= CLOSED, "rotations", back, last.rotation)
    }
}

impl Piece {
    /// Returns the displacement at a part of the piece \[m\], and its first two derivatives in time.
    pub fn way_at(&self, part: f64) -> [DVec3; 3] {
        let (s, rest, rate) = (part, 1.0 - part, self.length.recip());
        let start = self.places[0];
        // From the start, so that equal control points give themselves.
        let [leave, arrive, end] = [1, 2, 3].map(|number| self.places[number] - start);
        let way = 3.0 * s * rest * (rest * leave + s * arrive) + s * s * s * end;
        let slopes = self.slopes();
        let velocity = rest * (rest * slopes[0] + 2.0 * s * slopes[1]) + s * s * slopes[2];
        let changes = [slopes[1] - slopes[0], slopes[2] - slopes[1]].map(|it| 2.0 * it);
        let acceleration = rest * changes[0] + s * changes[1];
        [start + way, rate * velocity, rate * rate * acceleration]
    }

    /// Returns the control points of the derivative of the displacement by the part \[m\].
    fn slopes(&self) -> [DVec3; 3] {
        let [a, b, c, d] = self.places;
        [b - a, c - b, d - c].map(|it| 3.0 * it)
    }

    /// Returns upper bounds of the first three derivatives of the displacement \[m/s, m/s², m/s³\]: a Bézier curve stays
    /// within its control points.
    pub fn way_bounds(&self) -> [f64; 3] {
        let (slopes, rate) = (self.slopes(), self.length.recip());
        let changes = [slopes[1] - slopes[0], slopes[2] - slopes[1]].map(|it| 2.0 * it);
        let largest = |of: &[DVec3]| of.iter().map(|it| it.norm()).fold(0.0, f64::max);
        let jerk = (changes[1] - changes[0]).norm();
        [largest(&slopes) * rate, largest(&changes) * rate * rate, jerk * rate * rate * rate]
    }

    /// Returns upper bounds of the first three derivatives of the angle of one of its turns \[rad/s, rad/s², rad/s³\].
    pub fn turn_bounds(&self, number: usize) -> [f64; 3] {
        let (angle, rate) = (self.turns[number].norm(), self.length.recip());
        let [slope, change, jerk] = if number == 1 { [1.5, 6.0, 12.0] } else { [3.0, 6.0, 6.0] };
        [slope * angle * rate, change * angle * rate * rate, jerk * angle * rate * rate * rate]
    }

    /// Returns an upper bound of the rate at which it changes \[rad/s\]: that of `s³` and of the rotation.
    fn rate(&self) -> f64 {
        let [first, middle, last] = self.turns.map(Norm::norm);
        (3.0 * first.max(last) + 1.5 * middle).max(4.0) / self.length
    }
}

/// Returns the pieces between keyframes.
fn pieces(given: &Given) -> Arc<[Piece]> {
    let keyframes = &given.keyframes;
    let lengths: Vec<f64> = keyframes.windows(2).map(|two| two[1].time - two[0].time).collect();
    let ways: Vec<DVec3> =
        keyframes.windows(2).map(|two| two[1].position - two[0].position).collect();
    let velocities = tangents::of(&ways, &lengths, given.repeats);
    let rotations: Vec<DQuat> = keyframes.iter().map(|it| it.rotation.normalize()).collect();
    let turn = |two: &[DQuat]| rotation::rotation_vector(two[0].conjugate() * two[1]);
    let turns: Vec<DVec3> = rotations.windows(2).map(turn).collect();
    let spins = tangents::of(&turns, &lengths, given.repeats);
    let piece = |(number, &length): (usize, &f64)| {
        let [start, end] = [number, number + 1].map(|it| keyframes[it].position);
        let third = length / 3.0;
        let [start_turn, end_turn] = [number, number + 1].map(|it| third * spins[it]);
        let [inverse, other] =
            [start_turn, end_turn].map(|it| rotation::turned(DQuat::IDENTITY, it, -1.0));
        // exp(-w₁) q₀⁻¹ q₁ exp(-w₃)
        let middle = inverse * (rotations[number].conjugate() * rotations[number + 1]) * other;
        Piece {
            length,
            places: [
                start,
                start + third * velocities[number],
                end - third * velocities[number + 1],
                end,
            ],
            rotation: rotations[number],
            turns: [start_turn, rotation::rotation_vector(middle), end_turn],
        }
    };
    lengths.iter().enumerate().map(piece).collect()
}
