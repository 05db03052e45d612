//! States of all balls of a run, frame by frame.

use std::io::{self, Write};

use carom::DVec3;

use crate::contact::ContactKind;

/// State of a ball at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State {
    /// Position \[m\].
    pub position: DVec3,
    /// Velocity \[m/s\].
    pub velocity: DVec3,
}

impl State {
    /// Interpolates linearly between two states; `part` is in \[0, 1\].
    fn between(from: Self, to: Self, part: f64) -> Self {
        Self {
            position: from.position.lerp(to.position, part),
            velocity: from.velocity.lerp(to.velocity, part),
        }
    }
}

/// A contact that was answered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// Frame at whose end the contact occurred, from 1.
    pub frame: usize,
    /// Number of the ball in order of emission, from 0.
    pub ball: usize,
    /// Part of the collider.
    pub kind: ContactKind,
    /// Index of the collider in the list of surfaces.
    pub(crate) surface: usize,
}

/// States of one ball, from its emission to its end.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Track {
    /// Frame at whose end the first state is; the ball moves in the next one.
    pub birth: usize,
    pub states: Vec<State>,
}

impl Track {
    /// Last frame at whose end the ball exists.
    fn end(&self) -> usize {
        self.birth + self.states.len() - 1
    }

    fn at(&self, frame: usize) -> Option<State> {
        self.states.get(frame.checked_sub(self.birth)?).copied()
    }
}

/// States of all balls of a run.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tracks {
    /// Time at the end of each frame \[s\]; the first is 0, before the first frame.
    pub(crate) times: Vec<f64>,
    /// Tracks in the order of emission.
    pub(crate) balls: Vec<Track>,
    /// Balls of each slot, in order.
    pub(crate) slots: Vec<Vec<usize>>,
    /// Contacts in the order of frames.
    pub touches: Vec<Touch>,
}

/// Meaning of a label in a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Key {
    /// Number of the ball in the order of emission.
    Number(usize),
    /// Slot of the ball; an emitter with a limit gives the slot of the oldest ball to the next one.
    Slot(usize),
}

/// Fraction of a frame within which a time counts as the end of the frame: a time in single
/// precision has an error of 1e-6 s after 20 s.
const ON_FRAME: f64 = 0.02;

impl Tracks {
    /// Number of the last frame.
    pub fn frames(&self) -> usize {
        self.times.len().saturating_sub(1)
    }

    /// Time at the end of a frame \[s\]; 0 for frame 0, NaN for one that does not exist.
    pub fn time(&self, frame: usize) -> f64 {
        self.times.get(frame).copied().unwrap_or(f64::NAN)
    }

    /// Number of balls.
    pub fn len(&self) -> usize {
        self.balls.len()
    }

    /// Whether there are no balls.
    pub fn is_empty(&self) -> bool {
        self.balls.is_empty()
    }

    /// State of a ball at the end of a frame, or at its emission.
    pub fn state(&self, ball: usize, frame: usize) -> Option<State> {
        self.balls.get(ball)?.at(frame)
    }

    /// Balls that have moved before `time` \[s\], in the order of emission.
    pub(crate) fn births_until(&self, time: f64) -> impl Iterator<Item = usize> {
        let is_there = move |(_, track): &(usize, &Track)| self.times[track.birth] < time - 1e-6;
        self.balls.iter().enumerate().filter(is_there).map(|(ball, _)| ball)
    }

    /// Converts a time to a frame and the elapsed fraction of the next one.
    pub(crate) fn frame_at(&self, time: f64) -> Option<(usize, f64)> {
        let next = self.times.partition_point(|it| *it <= time);
        let before = next.checked_sub(1)?;
        let end = self.times.get(next);
        let usual = self.times.len().checked_sub(2).map(|it| self.times[it + 1] - self.times[it]);
        let length = end.map_or(usual.unwrap_or(1.0), |end| end - self.times[before]);
        let part = (time - self.times[before]) / length;
        match (part, end) {
            (part, _) if part < ON_FRAME => Some((before, 0.0)),
            (part, Some(_)) if part > 1.0 - ON_FRAME => Some((next, 0.0)),
            (part, Some(_)) => Some((before, part)),
            _ => None,
        }
    }

    /// Ball with this key at the end of a frame.
    pub(crate) fn ball(&self, key: Key, frame: usize) -> Option<usize> {
        match key {
            Key::Number(ball) => self.balls.get(ball)?.at(frame).map(|_| ball),
            Key::Slot(slot) => {
                let held = self.slots.get(slot)?;
                let is_there = |it: &&usize| {
                    let track = &self.balls[**it];
                    track.birth <= frame && frame <= track.end()
                };
                // At the end of the frame in which a ball is emitted, its predecessor in the slot
                // still counts.
                held.iter().find(is_there).copied()
            }
        }
    }

    /// State of the ball with this key at a time \[s\].
    pub(crate) fn sample(&self, key: Key, time: f64) -> Option<State> {
        let (frame, part) = self.frame_at(time)?;
        if part == 0.0 {
            return self.state(self.ball(key, frame)?, frame);
        }
        let ball = self.ball(key, frame + 1)?;
        let to = self.state(ball, frame + 1)?;
        let from = self.state(ball, frame).unwrap_or(to);
        Some(State::between(from, to, part))
    }

    /// Writes a table as `carom run --out` does: a row for each ball after each frame.
    ///
    /// # Errors
    /// [`io::Error`] if writing to `out` fails.
    pub fn write(&self, out: impl Write) -> io::Result<()> {
        let mut table = csv::Writer::from_writer(out);
        table.write_record(["t", "ball", "x", "y", "z", "vx", "vy", "vz"]).map_err(unwrapped)?;
        for frame in 1..self.times.len() {
            let time = digits(self.times[frame]);
            for (number, ball) in self.balls.iter().enumerate() {
                let Some(state) = ball.at(frame).filter(|_| ball.birth < frame) else { continue };
                let State { position, velocity } = state;
                let numbers =
                    position.to_array().into_iter().chain(velocity.to_array()).map(digits);
                let row = [time.clone(), number.to_string()].into_iter().chain(numbers);
                table.write_record(row).map_err(unwrapped)?;
            }
        }
        table.flush()
    }
}

/// Returns the error of the system with its kind, which the error of the table hides.
fn unwrapped(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(source) => source,
        other => io::Error::other(format!("{other:?}")),
    }
}

/// Writes a number with 17 significant digits, which distinguish any two doubles.
fn digits(value: f64) -> String {
    format!("{value:.16e}")
}
