//! Options of episodes, the same for all balls.

use carom::Rule;

use crate::error::EpisodeError;

/// Options of episodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EpisodeOptions {
    /// The rule that advances frames.
    pub rule: Rule,
    /// Length of a frame \[s\], > 0.
    pub frame_time: f64,
    /// Frames per step, at least 1; an action holds for one step.
    pub frames_per_step: u32,
    /// Coefficient of friction of the ball, >= 0. At 0 the ball slides without turning, as in the
    /// course's maze. Above 0 it rolls, and the rule `contact` takes all frames.
    pub friction: f64,
    /// Largest angle between the maze and level \[°\], in (0, 45].
    pub max_tilt_degrees: f64,
    /// Turning speed of the maze about each axis \[°/s\], > 0; infinite: at once.
    pub tilt_speed_degrees_per_second: f64,
    /// Height below which the ball has fallen, along the maze's own up \[m\]. It has also fallen
    /// when its centre passes the edge of the ground.
    pub reset_height: f64,
    /// Largest number of steps of an episode; `None`: no limit.
    pub max_steps: Option<u32>,
    /// Rewards.
    pub rewards: Rewards,
}

impl Default for EpisodeOptions {
    fn default() -> Self {
        Self {
            rule: Rule::default(),
            // As in the course.
            frame_time: 0.02,
            frames_per_step: 1,
            friction: 0.0,
            max_tilt_degrees: 20.0,
            // A quick hand: from level to the steepest tilt in a third of a second.
            tilt_speed_degrees_per_second: 60.0,
            reset_height: -5.0,
            max_steps: None,
            rewards: Rewards::default(),
        }
    }
}

/// Rewards of an episode.
///
/// Shaping rewards progress before anything is reached, and keeps the optimal policy optimal. With
/// the potential Φ = -`shaping` · (cost of the way to the nearest remaining collectible, or to the
/// end wall if none remains), each step adds `discount` · Φ(after) - Φ(before). Φ = 0 where an
/// episode ends won or fallen (A. Y. Ng, D. Harada, S. Russell, "Policy invariance under reward
/// transformations", ICML 1999).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rewards {
    /// For each collectible.
    pub collectible: f64,
    /// For the end wall.
    pub end_wall: f64,
    /// For falling out of the maze.
    pub fall: f64,
    /// For each step.
    pub step: f64,
    /// Per metre of the way, >= 0; 0: no shaping. A metre along a wall counts more.
    pub shaping: f64,
    /// The agent's discount, in \[0, 1\].
    pub discount: f64,
}

impl Default for Rewards {
    fn default() -> Self {
        Self {
            collectible: 1.0,
            end_wall: 1.0,
            fall: -1.0,
            step: 0.0,
            shaping: 0.0,
            discount: 0.99,
        }
    }
}

impl EpisodeOptions {
    /// Checks the options for a ball that starts at a height \[m\].
    pub(crate) fn validate(&self, start: f64) -> Result<(), EpisodeError> {
        let require = |good: bool, field, requirement, value| {
            if good { Ok(()) } else { Err(EpisodeError::Option { field, requirement, value }) }
        };
        let frame = self.frame_time;
        let is_length = frame > 0.0 && frame.is_finite();
        require(is_length, "frame_time", "positive and finite", frame)?;
        let frames = self.frames_per_step;
        require(frames > 0, "frames_per_step", "at least 1", frames.into())?;
        let tilt = self.max_tilt_degrees;
        let in_range = tilt > 0.0 && tilt <= 45.0;
        require(in_range, "max_tilt_degrees", "above 0 and at most 45", tilt)?;
        let speed = self.tilt_speed_degrees_per_second;
        require(speed > 0.0, "tilt_speed_degrees_per_second", "positive", speed)?;
        let friction = self.friction;
        let is_coefficient = friction >= 0.0 && friction.is_finite();
        require(is_coefficient, "friction", "zero or positive, and finite", friction)?;
        let height = self.reset_height;
        let is_below = height < start && height.is_finite();
        require(is_below, "reset_height", "finite, and below the ball's start", height)?;
        let steps = self.max_steps.unwrap_or(u32::MAX);
        require(steps > 0, "max_steps", "at least 1", steps.into())?;
        let Rewards { collectible, end_wall, fall, step, shaping, discount } = self.rewards;
        let values =
            [("collectible", collectible), ("end_wall", end_wall), ("fall", fall), ("step", step)];
        for (field, value) in values {
            require(value.is_finite(), field, "finite", value)?;
        }
        let is_price = shaping >= 0.0 && shaping.is_finite();
        require(is_price, "shaping", "zero or positive, and finite", shaping)?;
        require((0.0..=1.0).contains(&discount), "discount", "in [0, 1]", discount)
    }
}
