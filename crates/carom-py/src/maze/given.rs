//! Reads a maze and its options from Python.

use std::{fs, io};

use carom::{Discrete, Rule};
use carom_maze::{Arena, BUILT_IN_DRAWINGS, EpisodeOptions, Maze, Rewards, Start};
use carom_scene::text_of;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::team::Autoreset;
use crate::arguments;
use crate::failure::Failure;

/// The arguments of an environment, by name.
pub struct Given<'py>(pub Bound<'py, PyDict>);

impl<'py> Given<'py> {
    fn item(&self, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let missing = || PyTypeError::new_err(format!("{name}: is missing"));
        self.0.get_item(name)?.ok_or_else(missing)
    }

    fn number(&self, name: &str) -> PyResult<f64> {
        arguments::number(name, &self.item(name)?)
    }

    fn count(&self, name: &str) -> PyResult<u32> {
        let count = arguments::count(name, &self.item(name)?)?;
        let too_large = |_| Failure::value(name, format_args!("must be below 2^32, not {count}"));
        Ok(u32::try_from(count).map_err(too_large)?)
    }

    fn text(&self, name: &str) -> PyResult<String> {
        let wrong = |_| PyTypeError::new_err(format!("{name}: must be a text"));
        self.item(name)?.extract().map_err(wrong)
    }

    /// Returns the prepared maze.
    ///
    /// # Errors
    /// An exception that names the invalid argument.
    pub fn arena(&self) -> PyResult<Arena> {
        let options = self.options()?;
        let maze = match self.text("maze")?.as_str() {
            "random" => {
                let seed = arguments::count("maze_seed", &self.item("maze_seed")?)?;
                let wrong = |_| {
                    let message = "maze_size: must be two whole numbers, columns and rows";
                    PyTypeError::new_err(message)
                };
                let (columns, rows) = self.item("maze_size")?.extract().map_err(wrong)?;
                Maze::random(seed, columns, rows).map_err(Failure::from)?
            }
            name => named(name)?,
        };
        Ok(Arena::new(maze, options).map_err(Failure::from)?)
    }

    fn options(&self) -> PyResult<EpisodeOptions> {
        let rule = match self.text("rule")?.as_str() {
            "exact" => Rule::default(),
            "discrete" => Discrete::default().into(),
            other => {
                let problem = format_args!("must be \"exact\" or \"discrete\", not \"{other}\"");
                return Err(Failure::value("rule", problem).into());
            }
        };
        let has_limit = !self.item("max_episode_steps")?.is_none();
        let rewards = Rewards {
            collectible: self.number("collectible_reward")?,
            end_wall: self.number("end_wall_reward")?,
            fall: self.number("fall_reward")?,
            step: self.number("step_reward")?,
            shaping: self.number("shaping")?,
            discount: self.number("discount")?,
        };
        Ok(EpisodeOptions {
            rule,
            frame_time: self.number("frame_time")?,
            frames_per_step: self.count("frames_per_step")?,
            friction: self.number("friction")?,
            max_tilt_degrees: self.number("max_tilt_degrees")?,
            tilt_speed_degrees_per_second: self.number("tilt_speed_degrees_per_second")?,
            max_steps: has_limit.then(|| self.count("max_episode_steps")).transpose()?,
            rewards,
            ..EpisodeOptions::default()
        })
    }
}

/// Returns the course's maze, a built-in one, one drawn in a file, or one drawn in the text itself.
fn named(name: &str) -> Result<Maze, Failure> {
    if name == "course" {
        return Ok(Maze::course()?);
    }
    if let Some((name, text)) = BUILT_IN_DRAWINGS.iter().find(|(it, _)| *it == name) {
        return Ok(Maze::from_text(text, name)?);
    }
    if name.contains('\n') {
        return Ok(Maze::from_text(name, "drawing")?);
    }
    let text = fs::read(name).and_then(|bytes| text_of(bytes).map_err(io::Error::other));
    let text = text.map_err(|error| {
        let built_in: Vec<String> =
            BUILT_IN_DRAWINGS.iter().map(|(name, _)| format!("\"{name}\"")).collect();
        let built_in = built_in.join(", ");
        Failure::value(
            "maze",
            format_args!(
                "must be \"course\", {built_in}, \"random\", a drawing, or the path of one, not \
                 \"{name}\" ({error})"
            ),
        )
    })?;
    Ok(Maze::from_text(&text, name)?)
}

/// Parses where episodes start.
///
/// # Errors
/// [`Failure`] for another word than `"maze"` or `"random"`.
pub fn start(word: &str) -> Result<Start, Failure> {
    match word {
        "maze" => Ok(Start::Maze),
        "random" => Ok(Start::Random),
        other => {
            let problem = format_args!("must be \"maze\" or \"random\", not \"{other}\"");
            Err(Failure::value("start", problem))
        }
    }
}

/// Parses what happens after an episode ends, by the words of Gymnasium.
///
/// # Errors
/// [`Failure`] for another word.
pub fn autoreset(word: &str) -> Result<Autoreset, Failure> {
    match word {
        "NextStep" => Ok(Autoreset::NextStep),
        "SameStep" => Ok(Autoreset::SameStep),
        "Disabled" => Ok(Autoreset::Disabled),
        other => {
            let problem =
                format_args!("must be \"NextStep\", \"SameStep\" or \"Disabled\", not \"{other}\"");
            Err(Failure::value("autoreset_mode", problem))
        }
    }
}
