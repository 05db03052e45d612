//! How a game is played: values chosen per game.

use crate::error::GameError;

/// How a game is played.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// Length of a frame \[s\], > 0.
    pub frame_time: f64,
    /// How fast the maze turns about each axis \[°/s\], > 0.
    pub tilt_speed_degrees_per_second: f64,
    /// Coefficient of friction of the ball, >= 0. Without any it slides, as in the course's maze, and does
    /// not turn; with some it rolls, and the rule `contact` takes all frames.
    pub friction: f64,
    /// Largest tilt against level \[°\], in (0, 45].
    pub max_tilt_degrees: f64,
    /// Whether the maze turns back to level about an axis that is not steered.
    pub levels_back: bool,
    /// The ball starts again when it is below this, along the maze's own up \[m\].
    pub reset_height: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            frame_time: 1.0 / 60.0,
            // The course's 0.2° in each of 50 frames a second.
            tilt_speed_degrees_per_second: 10.0,
            friction: 0.0,
            // Twice as fast a ball as at 10°, and walls still hide little of the floor.
            max_tilt_degrees: 20.0,
            levels_back: true,
            // The course's.
            reset_height: -5.0,
        }
    }
}

impl Options {
    pub(crate) fn validate(&self) -> Result<(), GameError> {
        let positive = |value: f64| value > 0.0 && value.is_finite();
        let require = |good: bool, field, requirement, value| {
            if good { Ok(()) } else { Err(GameError::Option { field, requirement, value }) }
        };
        let (frame, speed) = (self.frame_time, self.tilt_speed_degrees_per_second);
        let tilt = self.max_tilt_degrees;
        require(positive(frame), "frame_time", "positive and finite", frame)?;
        let field = "tilt_speed_degrees_per_second";
        require(positive(speed), field, "positive and finite", speed)?;
        let in_range = tilt > 0.0 && tilt <= 45.0;
        require(in_range, "max_tilt_degrees", "above 0 and at most 45", tilt)?;
        let friction = self.friction;
        let is_coefficient = friction >= 0.0 && friction.is_finite();
        require(is_coefficient, "friction", "zero or positive, and finite", friction)?;
        let height = self.reset_height;
        require(height.is_finite(), "reset_height", "finite", height)
    }
}
