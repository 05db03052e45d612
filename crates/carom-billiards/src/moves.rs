//! What players do, and its text.

use std::fmt;
use std::str::FromStr;

use carom_scene::scene::Strike;

use crate::error::MoveError;

/// What a player does. Its text has one line.
#[derive(Debug, Clone, PartialEq)]
pub enum Move {
    /// Puts the cue ball, which is in hand, to another place \[m\].
    Place {
        /// Coordinate of its centre along x \[m\].
        x: f64,
        /// Coordinate of its centre along z \[m\].
        z: f64,
    },
    /// Declares the next shot a push-out.
    PushOut,
    /// Answers a push-out: shoots, or leaves the shot to the one who pushed out.
    Answer {
        /// Whether the player at the table shoots.
        shoots: bool,
    },
    /// Strikes the cue ball, with a cue of the usual mass.
    Strike(Strike),
}

impl fmt::Display for Move {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Place { x, z } => write!(f, "place {x} {z}"),
            Self::PushOut => f.write_str("push-out"),
            Self::Answer { shoots: true } => f.write_str("shoot"),
            Self::Answer { shoots: false } => f.write_str("leave"),
            Self::Strike(Strike { speed, azimuth_degrees, elevation_degrees, offset, .. }) => {
                let [right, up] = offset;
                write!(f, "strike {speed} {azimuth_degrees} {elevation_degrees} {right} {up}")
            }
        }
    }
}

impl FromStr for Move {
    type Err = MoveError;

    fn from_str(text: &str) -> Result<Self, MoveError> {
        let mut words = text.split_whitespace();
        let name = words.next().ok_or(MoveError::Text)?;
        let numbers: Vec<f64> =
            words.map(str::parse).collect::<Result<_, _>>().map_err(|_| MoveError::Text)?;
        match (name, numbers.as_slice()) {
            ("place", [x, z]) => Ok(Self::Place { x: *x, z: *z }),
            ("push-out", []) => Ok(Self::PushOut),
            ("shoot", []) => Ok(Self::Answer { shoots: true }),
            ("leave", []) => Ok(Self::Answer { shoots: false }),
            ("strike", [speed, azimuth, elevation, right, up]) => Ok(Self::Strike(Strike {
                azimuth_degrees: *azimuth,
                elevation_degrees: *elevation,
                offset: [*right, *up],
                ..Strike::new(*speed)
            })),
            _ => Err(MoveError::Text),
        }
    }
}
