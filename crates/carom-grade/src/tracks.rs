//! Where all balls of a run are, frame by frame.

use std::io::{self, Write};

use carom::DVec3;

use crate::contact::ContactKind;

/// A ball at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State {
    /// In m.
    pub position: DVec3,
    /// In m/s.
    pub velocity: DVec3,
}

impl State {
    /// On the straight way from one state to another; `part` in \[0, 1\].
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
    /// The frame at whose end it was, from 1.
    pub frame: usize,
    /// Number of the ball in order of emission, from 0.
    pub ball: usize,
    /// Part of the collider.
    pub kind: ContactKind,
    /// Place of the collider in the list of surfaces.
    pub(crate) surface: usize,
}

/// The states of one ball, from its emission to its end.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Track {
    /// The frame before its first movement, at whose end the first state is.
    pub birth: usize,
    pub states: Vec<State>,
}

impl Track {
    /// The last frame at whose end it is there.
    fn end(&self) -> usize {
        self.birth + self.states.len() - 1
    }

    fn at(&self, frame: usize) -> Option<State> {
        self.states.get(frame.checked_sub(self.birth)?).copied()
    }
}

/// All balls of a run.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tracks {
    /// Time at the end of each frame \[s\]; the first is 0, before the first frame.
    pub(crate) times: Vec<f64>,
    /// In order of emission.
    pub(crate) balls: Vec<Track>,
    /// The balls that each slot holds one after the other.
    pub(crate) slots: Vec<Vec<usize>>,
    /// In order of frames.
    pub touches: Vec<Touch>,
}

/// What a table calls a ball.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Key {
    /// Its number in order of emission.
    Number(usize),
    /// The slot that it has, which it shares with earlier and later ones.
    Slot(usize),
}

/// Times that are nearer to the end of a frame than this part of one are that end: a time in single
/// precision is off by 1e-6 s after 20 s.
const ON_FRAME: f64 = 0.02;

impl Tracks {
    /// Number of the last frame.
    pub fn frames(&self) -> usize {
        self.times.len().saturating_sub(1)
    }

    /// Time at the end of a frame \[s\]; 0 of the frame 0, NaN of one that is not there.
    pub fn time(&self, frame: usize) -> f64 {
        self.times.get(frame).copied().unwrap_or(f64::NAN)
    }

    /// How many balls there were.
    pub fn len(&self) -> usize {
        self.balls.len()
    }

    /// Whether there was no ball.
    pub fn is_empty(&self) -> bool {
        self.balls.is_empty()
    }

    /// The state of a ball at the end of a frame; at its emission, too.
    pub fn state(&self, ball: usize, frame: usize) -> Option<State> {
        self.balls.get(ball)?.at(frame)
    }

    /// The balls that have moved before a time \[s\], in order of emission.
    pub(crate) fn births_until(&self, time: f64) -> impl Iterator<Item = usize> {
        let is_there = move |(_, track): &(usize, &Track)| self.times[track.birth] < time - 1e-6;
        self.balls.iter().enumerate().filter(is_there).map(|(ball, _)| ball)
    }

    /// The frame at whose end a time is, and the part of a frame that it is later.
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

    /// The ball of this key at the end of a frame.
    pub(crate) fn ball(&self, key: Key, frame: usize) -> Option<usize> {
        match key {
            Key::Number(ball) => self.balls.get(ball)?.at(frame).map(|_| ball),
            Key::Slot(slot) => {
                let held = self.slots.get(slot)?;
                let is_there = |it: &&usize| {
                    let track = &self.balls[**it];
                    track.birth <= frame && frame <= track.end()
                };
                // At the end of the frame before its first movement, the one before is still there.
                held.iter().find(is_there).copied()
            }
        }
    }

    /// The state of the ball of this key at a time \[s\].
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
    /// What `out` refuses.
    pub fn write(&self, out: impl Write) -> io::Result<()> {
        let mut table = csv::Writer::from_writer(out);
        table.write_record(["t", "ball", "x", "y", "z", "vx", "vy", "vz"])?;
        for frame in 1..self.times.len() {
            let time = digits(self.times[frame]);
            for (number, ball) in self.balls.iter().enumerate() {
                let Some(state) = ball.at(frame).filter(|_| ball.birth < frame) else { continue };
                let State { position, velocity } = state;
                let numbers =
                    position.to_array().into_iter().chain(velocity.to_array()).map(digits);
                let row = [time.clone(), number.to_string()].into_iter().chain(numbers);
                table.write_record(row)?;
            }
        }
        table.flush()
    }
}

/// A number with 17 significant digits: as many as distinguish any two doubles.
fn digits(value: f64) -> String {
    format!("{value:.16e}")
}
