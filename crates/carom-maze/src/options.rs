//! Options of a game.

use crate::error::GameError;

/// Options of a game.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// Length of a frame \[s\], > 0.
    pub frame_time: f64,
    /// Turning speed of the maze about each axis \[°/s\], > 0.
    pub tilt_speed_degrees_per_second: f64,
    /// Coefficient of friction of the ball, >= 0. At 0 the ball slides without turning, as in the
    /// course's maze. Above 0 it rolls, and the rule `contact` takes all frames.
    pub friction: f64,
    /// Largest angle between the maze and level \[°\], in (0, 45].
    pub max_tilt_degrees: f64,
    /// Whether the maze turns back to level about an axis without steering.
    pub levels_back: bool,
    /// Height below which the ball returns to the start, along the maze's own up \[m\].
    pub reset_height: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            frame_time: 1.0 / 60.0,
            // In the course: 0.2° in each of 50 frames a second.
            tilt_speed_degrees_per_second: 10.0,
            friction: 0.0,
            // The ball is twice as fast as at 10°, and walls still hide little of the floor.
            max_tilt_degrees: 20.0,
            levels_back: true,
            // As in the course.
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
