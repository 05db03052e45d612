//! The tilt of the maze, and how steering changes it.

use carom::{DQuat, DVec3};

use crate::error::GameError;
use crate::options::Options;

/// The maze is not turned by less than that in a frame \[rad\]: it cannot be seen, and a floor that
/// hardly turns looks like one at rest.
const FINEST_TURN: f64 = 2e-5;

/// What the player does in a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Steering {
    /// Turn the maze about the axes of the world, with keys: each a part of the tilt speed in
    /// \[-1, 1\]; more is cut off.
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
    /// Turn towards this tilt, with the tilt speed at most: mouse, gamepad, or a device that is
    /// tilted itself.
    Towards(Tilt),
}

impl Steering {
    /// No key is held.
    pub const NONE: Self = Self::Turn { about_x: 0.0, about_z: 0.0 };

    /// Turn so that the ball will roll to +x (the key "right") and to +z (the key "down"), each a
    /// part of the tilt speed in \[-1, 1\].
    pub fn roll(to_x: f64, to_z: f64) -> Self {
        Self::Turn { about_x: to_z, about_z: -to_x }
    }

    /// Whether the player does anything.
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

/// A rotation of the maze about a level axis through the origin, without any twist: the components
/// of its rotation vector \[rad\].
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

    /// The tilt that lowers the maze by these angles \[rad\] at +x and at +z, so that the ball
    /// rolls there.
    pub fn down(to_x: f64, to_z: f64) -> Self {
        Self { about_x: to_z, about_z: -to_x }
    }

    /// Angle between the maze's up and the world's \[rad\].
    pub fn angle(self) -> f64 {
        let Self { about_x, about_z } = self;
        (about_x * about_x + about_z * about_z).sqrt()
    }

    /// The rotation from the maze to the world.
    pub fn rotation(self) -> DQuat {
        let angle = self.angle();
        if angle == 0.0 {
            return DQuat::IDENTITY;
        }
        let (sine, cosine) = libm::sincos(0.5 * angle);
        let part = sine / angle;
        DQuat::from_xyzw(self.about_x * part, 0.0, self.about_z * part, cosine)
    }

    /// The tilt after a frame of steering.
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

    /// The tilt that is turned towards a target by at most `most` about each axis, and is at most so
    /// steep \[rad\].
    pub(crate) fn towards(self, target: Self, most: f64, steepest: f64) -> Self {
        let tilt = Self {
            about_x: approached(self.about_x, target.about_x, most),
            about_z: approached(self.about_z, target.about_z, most),
        };
        tilt.limited(steepest)
    }

    /// The world's direction down, along the axes of the maze.
    pub(crate) fn down_in_maze(self) -> DVec3 {
        let angle = self.angle();
        if angle == 0.0 {
            return DVec3::NEG_Y;
        }
        let (sine, cosine) = libm::sincos(angle);
        let part = sine / angle;
        DVec3::new(-self.about_z * part, -cosine, self.about_x * part)
    }

    /// The same direction, at most this steep \[rad\].
    fn limited(self, most: f64) -> Self {
        let angle = self.angle();
        if angle <= most {
            return self;
        }
        let part = most / angle;
        Self { about_x: self.about_x * part, about_z: self.about_z * part }
    }
}

/// An angle \[rad\] that goes towards a target by no more than `most`, but for [`FINEST_TURN`].
fn approached(value: f64, target: f64, most: f64) -> f64 {
    let way = target - value;
    match way.abs() {
        near if near < FINEST_TURN => value,
        near if near <= most + FINEST_TURN => target,
        _ => value + way.clamp(-most, most),
    }
}

/// The rotation vector \[rad\] of a rotation.
pub(crate) fn rotation_vector(rotation: DQuat) -> DVec3 {
    let imaginary = DVec3::new(rotation.x, rotation.y, rotation.z);
    let sine = imaginary.length();
    if sine == 0.0 {
        return DVec3::ZERO;
    }
    // A rotation and its negative are the same; this is the one of less than half a turn.
    let half = libm::atan2(sine, rotation.w.abs());
    imaginary * (2.0 * half / sine).copysign(rotation.w)
}
