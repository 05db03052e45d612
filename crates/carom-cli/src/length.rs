//! Length of a run in the arguments of commands.

use crate::failure::Failure;

/// How long to run, in which frames.
#[derive(Debug, clap::Args)]
pub struct Length {
    /// Length of a frame, instead of the scene's own.
    #[arg(long, value_name = "SECONDS", value_parser = positive, allow_negative_numbers = true)]
    frame_time: Option<f64>,
    /// How long to run, instead of the scene's own duration; taken up to whole frames.
    #[arg(long, short, conflicts_with = "frames", value_parser = positive, allow_negative_numbers = true)]
    seconds: Option<f64>,
    /// How many frames to run.
    #[arg(long, short = 'n')]
    frames: Option<u64>,
}

impl Length {
    /// Override of the frame time, if one is given.
    pub fn overrides(&self) -> Option<String> {
        self.frame_time.map(|h| format!("simulation.frame_time={h:?}"))
    }

    /// Number of frames of a run that lasts `duration` by default, with frames of `h` \[s\].
    pub fn frames(&self, duration: f64, h: f64) -> Result<u64, Failure> {
        if let Some(frames) = self.frames {
            return Ok(frames);
        }
        whole_frames(self.seconds.unwrap_or(duration), h)
    }
}

/// Number of frames of `h` \[s\] in this time \[s\], rounded up.
pub fn whole_frames(seconds: f64, h: f64) -> Result<u64, Failure> {
    // 1e-9 of a frame is a rounding error.
    countable((seconds / h - 1e-9).ceil(), h)
}

/// Converts a number of frames of `h` \[s\]; refuses one that cannot be counted exactly.
pub fn countable(frames: f64, h: f64) -> Result<u64, Failure> {
    if frames < 2f64.powi(53) {
        Ok(frames as u64)
    } else {
        Err(Failure::Usage(format!("{frames:.3e} frames of {h} s are more than can be counted")))
    }
}

/// Reads a positive number.
pub fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value.is_finite() => Ok(value),
        _ => Err("a positive number is needed".to_owned()),
    }
}
