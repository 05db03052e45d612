//! The tilt of the maze, and how steering changes it.

use carom::{DQuat, DVec3};

use crate::error::GameError;
use crate::options::Options;

/// Smallest turn of the maze in a frame \[rad\]. A smaller one is invisible, and without it the
/// floor is at rest.
const FINEST_TURN: f64 = 2e-5;

/// Action of the player in a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Steering {
    /// Turns the maze about the axes of the world, as keys do: each number is a part of the tilt
    /// speed in \[-1, 1\]; values outside are clamped.
    ///
    /// Right-handed: about_x > 0 lowers the maze at +z, and the ball rolls to +z, towards the
    /// viewer; about_z > 0 lowers it at -x, and the ball rolls to -x, to the left. See
    /// [`Self::roll`].
    Turn {
        /// About the x axis.
        about_x: f64,
        /// About the z axis.
        about_z: f64,
    },
    /// Turns towards this tilt, at most with the tilt speed: for mouse, gamepad, or a tilted
    /// device.
    Towards(Tilt),
}

impl Steering {
    /// No steering.
    pub const NONE: Self = Self::Turn { about_x: 0.0, about_z: 0.0 };

    /// Turns the maze so that the ball rolls to +x (the key "right") and to +z (the key "down");
    /// each number is a part of the tilt speed in \[-1, 1\].
    pub fn roll(to_x: f64, to_z: f64) -> Self {
        Self::Turn { about_x: to_z, about_z: -to_x }
    }

    /// Returns whether the player steers.
    pub(crate) fn is_active(self) -> bool {
        match self {
            Self::Turn { about_x, about_z } => about_x != 0.0 || about_z != 0.0,
            Self::Towards(tilt) => tilt != Tilt::LEVEL,
        }
    }

    pub(crate) fn validate(self) -> Result<(), GameError> {
        let (Self::Turn { about_x, about_z } | Self::Towards(Tilt { about_x, about_z })) = self;
        let bad = [about_x, about_z].into_iter().find(|value| !value.is_finite());
        bad.map_or(Ok(()), |value| Err(GameError::Steering { value }))
    }
}

/// A rotation of the maze about a level axis through the origin, without twist: the components of
/// its rotation vector \[rad\].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tilt {
    /// Along the x axis: positive lowers the maze at +z.
    pub about_x: f64,
    /// Along the z axis: positive lowers the maze at -x.
    pub about_z: f64,
}

impl Tilt {
    /// No tilt.
    pub const LEVEL: Self = Self { about_x: 0.0, about_z: 0.0 };

    /// Returns the tilt that lowers the maze by these angles \[rad\] at +x and +z, so that the ball
    /// rolls there.
    pub fn down(to_x: f64, to_z: f64) -> Self {
        Self { about_x: to_z, about_z: -to_x }
    }

    /// Returns the angle between the maze's up and the world's up \[rad\].
    pub fn angle(self) -> f64 {
        let Self { about_x, about_z } = self;
        (about_x * about_x + about_z * about_z).sqrt()
    }

    /// Returns the rotation from the maze to the world.
    pub fn rotation(self) -> DQuat {
        let angle = self.angle();
        if angle == 0.0 {
            return DQuat::IDENTITY;
        }
        let (sine, cosine) = libm::sincos(0.5 * angle);
        let part = sine / angle;
        DQuat::from_xyzw(self.about_x * part, 0.0, self.about_z * part, cosine)
    }

    /// Returns the tilt after a frame of steering.
    pub(crate) fn steered(self, steering: Steering, options: &Options) -> Self {
        let most = options.tilt_speed_degrees_per_second.to_radians() * options.frame_time;
        let turned = |angle: f64, part: f64| match part.clamp(-1.0, 1.0) {
            0.0 if options.levels_back => approached(angle, 0.0, most),
            part => angle + part * most,
        };
        let steepest = options.max_tilt_degrees.to_radians();
        match steering {
            Steering::Turn { about_x, about_z } => Self {
                about_x: turned(self.about_x, about_x),
                about_z: turned(self.about_z, about_z),
            }
            .limited(steepest),
            Steering::Towards(target) => self.towards(target, most, steepest),
        }
    }

    /// Returns the tilt turned towards a target by at most `most` about each axis, no steeper than
    /// `steepest` \[rad\].
    pub(crate) fn towards(self, target: Self, most: f64, steepest: f64) -> Self {
        let tilt = Self {
            about_x: approached(self.about_x, target.about_x, most),
            about_z: approached(self.about_z, target.about_z, most),
        };
        tilt.limited(steepest)
    }

    /// Returns the world's down direction along the axes of the maze.
    pub(crate) fn down_in_maze(self) -> DVec3 {
        let angle = self.angle();
        if angle == 0.0 {
            return DVec3::NEG_Y;
        }
        let (sine, cosine) = libm::sincos(angle);
        let part = sine / angle;
        DVec3::new(-self.about_z * part, -cosine, self.about_x * part)
    }

    /// Returns the tilt in the same direction, at most this steep \[rad\].
    fn limited(self, most: f64) -> Self {
        let angle = self.angle();
        if angle <= most {
            return self;
        }
        let part = most / angle;
        Self { about_x: self.about_x * part, about_z: self.about_z * part }
    }
}

/// Moves an angle \[rad\] towards a target by at most `most`. Turns smaller than [`FINEST_TURN`]
/// are skipped or added to the last one.
fn approached(value: f64, target: f64, most: f64) -> f64 {
    let way = target - value;
    match way.abs() {
        near if near < FINEST_TURN => value,
        near if near <= most + FINEST_TURN => target,
        _ => value + way.clamp(-most, most),
    }
}
