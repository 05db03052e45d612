//! Films of scenes.

// Python shows these comments as docstrings, with units in plain brackets.
#![allow(rustdoc::broken_intra_doc_links)]

use std::path::PathBuf;
use std::time::Instant;

use carom_cli::pictures::{Filming, Order, Stepped, Studio};
use carom_render::FilmError;
use carom_scene::Scene;
use pyo3::prelude::*;

use crate::arguments;
use crate::failure::Failure;
use crate::graphics_failure::raised;
use crate::picture_settings::{PictureSettings, View};
use crate::running::whole_frames;
use crate::scenes;
use crate::stop::PATIENCE;

/// Films the scene that `text` describes in TOML for `seconds` [s], or for the scene's duration,
/// rounded up to a whole frame. Returns the number of frames.
///
/// After an error or an interruption the frames so far make the film. If that fails, the error's
/// cause says where the frames are.
#[pyfunction]
pub fn film_scene(
    py: Python<'_>,
    text: &str,
    path: PathBuf,
    seconds: Option<&Bound<'_, PyAny>>,
    frame_rate: &Bound<'_, PyAny>,
    view: View<'_>,
) -> PyResult<u64> {
    let settings = PictureSettings::read(&view)?;
    let seconds = arguments::optional_number("seconds", seconds)?;
    // A rate that does not fit is refused with the message for all invalid rates.
    let fps = u32::try_from(arguments::count("frame_rate", frame_rate)?).unwrap_or(u32::MAX);
    let mut scene = scenes::in_code(text).map_err(Failure::of_part)?;
    let seconds = seconds.unwrap_or(scene.simulation.duration);
    settings.apply(&mut scene);
    let order = Order { path: &path, fps };
    py.detach(|| film(scene, order, seconds, settings))
}

/// Makes the film while other threads of Python run.
fn film(scene: Scene, order: Order, seconds: f64, settings: PictureSettings) -> PyResult<u64> {
    let fps = f64::from(order.fps);
    let mut stepped = Stepped::new(scene).map_err(Failure::from)?;
    let mut studio = Studio::new(settings.look).map_err(|error| raised(error.into()))?;
    let mut filming = Filming::begin(order, &mut stepped, &mut studio).map_err(raised)?;
    // A film needs at least one frame.
    let frames = whole_frames(seconds, 1.0 / fps)?.max(1);
    let taken = take_frames(&mut filming, frames);
    match (taken, filming.finish()) {
        (Ok(()), finished) => Ok(finished.map_err(|error| raised(error.into()))?.frames),
        (Err(error), Ok(_) | Err(FilmError::Empty { .. })) => Err(error),
        (Err(error), Err(lost)) => {
            Python::attach(|py| error.set_cause(py, Some(raised(lost.into()))));
            Err(error)
        }
    }
}

fn take_frames(filming: &mut Filming, frames: u64) -> PyResult<()> {
    let mut asked = Instant::now();
    for _ in 0..frames {
        filming.take_frame().map_err(raised)?;
        if asked.elapsed() > PATIENCE {
            Python::attach(|py| py.check_signals())?;
            asked = Instant::now();
        }
    }
    Ok(())
}
