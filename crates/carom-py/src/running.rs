//! Many recorded frames in one call.

// Python shows these comments as docstrings, with units in plain brackets.
#![allow(rustdoc::broken_intra_doc_links)]

use std::ops::Range;
use std::time::Instant;

use carom::Boundary;
use carom_scene::recording::slide;
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::arguments;
use crate::arrays::{self, shaped};
use crate::engine::Engine;
use crate::failure::Failure;
use crate::inner::Inner;
use crate::quantity::Quantity;
use crate::recording::{Numbers, Recording, Selection};
use crate::snapshot::State;
use crate::stop::PATIENCE;

/// Times, ids, radii, masses, impacts and events of sensors as words, the changing quantities with
/// their names, and the exception that ended the run early.
type Arrays<'py> = (
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<u64>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<f64>>,
    [Bound<'py, PyArray1<u64>>; 2],
    Vec<(&'static str, Bound<'py, PyAny>)>,
    Option<PyErr>,
);

/// Length of frames, and which of them are recorded.
#[derive(Clone, Copy)]
struct Rhythm {
    /// Frame time \[s\]; `None` for the scene's own.
    dt: Option<f64>,
    /// Number of frames from one recorded state to the next.
    every: u64,
}

#[pymethods]
impl Engine {
    /// Returns the number of frames of `dt` [s], or of the scene's frame time, in `seconds` [s], or
    /// in the scene's duration, rounded up.
    #[pyo3(name = "_count_frames", signature = (seconds, dt))]
    fn count_frames(
        &self,
        py: Python<'_>,
        seconds: Option<&Bound<'_, PyAny>>,
        dt: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<u64> {
        let seconds = arguments::optional_number("seconds", seconds)?;
        let dt = arguments::optional_number("dt", dt)?;
        let inner = &*self.lock(py)?;
        let seconds = seconds.unwrap_or(inner.described.simulation.duration);
        Ok(whole_frames(seconds, inner.frame_time(dt))?)
    }

    /// Sides of the periodic box [m], infinite along open axes; `None` if nothing is periodic.
    #[getter]
    fn _box_sides(&self, py: Python<'_>) -> PyResult<Option<[f64; 3]>> {
        Ok(match self.lock(py)?.world.settings().boundary {
            Boundary::Periodic { size } => Some(size.to_array()),
            Boundary::Open => None,
        })
    }

    /// How far the box above has slid along x at each of some times [m]; `None` without shear.
    fn _slides<'py>(
        &self,
        py: Python<'py>,
        times: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Option<Bound<'py, PyArray1<f64>>>> {
        let inner = self.lock(py)?;
        let slides = times.as_slice()?.iter().map(|&time| slide(inner.world.settings(), time));
        let slides: Option<Vec<f64>> = slides.collect();
        Ok(slides.filter(|all| !all.is_empty()).map(|all| PyArray1::from_vec(py, all)))
    }

    /// Takes `frames` frames of `dt` [s]. Records the selected parts of the present state and of
    /// the state after every `every` frames.
    #[pyo3(name = "_record", signature = (frames, dt, every, selection))]
    fn record<'py>(
        &self,
        py: Python<'py>,
        frames: &Bound<'py, PyAny>,
        dt: Option<&Bound<'py, PyAny>>,
        every: &Bound<'py, PyAny>,
        selection: Named,
    ) -> PyResult<Arrays<'py>> {
        let frames = arguments::count("frames", frames)?;
        let dt = arguments::optional_number("dt", dt)?;
        let every = arguments::count("every", every)?;
        if every == 0 {
            return Err(Failure::value("every", "must be at least 1, not 0").into());
        }
        let selection = selection.selection()?;
        let rhythm = Rhythm { dt, every };
        let (mut recording, before) = {
            let inner = &*self.lock(py)?;
            let mut recording =
                Recording::new(&inner.world, &selection, (frames / every).saturating_add(1))?;
            recording.push(&inner.world)?;
            (recording, inner.snapshot())
        };
        let (mut frame, mut stopped) = (0, None);
        while frame < frames && stopped.is_none() {
            match self.take_frames(py, frame..frames, rhythm, &before, &mut recording) {
                Ok(number) => frame = number,
                Err(Refused::Stopped(error)) => stopped = Some(error),
                Err(Refused::Failed(error)) => return Err(error),
            }
            // A signal handler may read the time of the world, so the lock must be free here.
            stopped = stopped.or(py.check_signals().err());
        }
        arrays_of(py, recording, stopped)
    }
}

/// [`Selection`], read from the attributes of Python's `Selection`.
#[derive(FromPyObject)]
struct Named {
    quantities: Option<Vec<String>>,
    is_single: bool,
    has_impacts: bool,
    has_sensor_events: bool,
}

impl Named {
    fn selection(self) -> Result<Selection, Failure> {
        let known = |names: Vec<String>| names.iter().map(|name| recorded(name)).collect();
        let quantities = self.quantities.map(known).transpose()?;
        let Self { is_single, has_impacts, has_sensor_events, .. } = self;
        Ok(Selection { quantities, is_single, has_impacts, has_sensor_events })
    }
}

/// Why the frames ended.
enum Refused {
    /// A signal handler raised an exception; the world keeps its state before that frame.
    Stopped(PyErr),
    Failed(PyErr),
}

/// Returns the quantity with this name, if it can be recorded.
fn recorded(name: &str) -> Result<Quantity, Failure> {
    let known = Quantity::MOTION.into_iter().find(|quantity| quantity.name() == name);
    known.ok_or_else(|| {
        let names = Quantity::MOTION.map(Quantity::name).join(", ");
        Failure::value("quantities", format_args!("must be of {names}, not {name:?}"))
    })
}

impl Engine {
    /// Takes and records frames for a limited time. Returns the number of the next frame. If a
    /// frame is refused, restores the state `before`.
    fn take_frames(
        &self,
        py: Python<'_>,
        frames: Range<u64>,
        rhythm: Rhythm,
        before: &State,
        recording: &mut Recording,
    ) -> Result<u64, Refused> {
        let mut guard = self.lock(py).map_err(Refused::Failed)?;
        let inner = &mut *guard;
        let taken = py.detach(|| take_frames(inner, frames, rhythm, recording));
        let is_stop = matches!(&taken, Err(failure) if failure.is_stop());
        if taken.is_err() && !is_stop {
            inner.restore(before);
        }
        inner.arrays.write_motion(py, inner.world.spheres());
        drop(guard);
        let refused = if is_stop { Refused::Stopped } else { Refused::Failed };
        taken.map_err(|failure| refused(failure.into()))
    }
}

/// Takes and records frames for a limited time. Returns the number of the next frame.
fn take_frames(
    inner: &mut Inner,
    frames: Range<u64>,
    rhythm: Rhythm,
    recording: &mut Recording,
) -> Result<u64, Failure> {
    let (began, end) = (Instant::now(), frames.end);
    let watch = inner.heed_signals();
    for frame in frames {
        inner.take_frame(inner.frame_time(rhythm.dt), &watch)?;
        recording.push_events(inner.frame_start, inner.world.report())?;
        if (frame + 1).is_multiple_of(rhythm.every) {
            recording.push(&inner.world)?;
        }
        if began.elapsed() > PATIENCE {
            return Ok(frame + 1);
        }
    }
    Ok(end)
}

fn arrays_of(py: Python<'_>, recording: Recording, stopped: Option<PyErr>) -> PyResult<Arrays<'_>> {
    let (times, states, events) = py.detach(|| recording.finish())?;
    let rows = [times.len(), states.ids.len()];
    let named = |(quantity, numbers): (Quantity, Numbers)| {
        let shape = vec![rows[0], rows[1], quantity.width()];
        let array = match numbers {
            Numbers::Double(numbers) => shaped(py, numbers, shape)?.into_any(),
            Numbers::Single(numbers) => shaped(py, numbers, shape)?.into_any(),
        };
        Ok((quantity.name(), array))
    };
    let motion = states.motion.into_iter().map(named).collect::<PyResult<_>>()?;
    Ok((
        PyArray1::from_vec(py, times),
        arrays::numbers(py, &states.ids),
        PyArray1::from_vec(py, states.radii),
        PyArray1::from_vec(py, states.masses),
        events.map(|table| PyArray1::from_vec(py, table.into_words())),
        motion,
        stopped,
    ))
}

/// Returns the number of frames of `dt` \[s\] in `seconds` \[s\], rounded up.
pub fn whole_frames(seconds: f64, dt: f64) -> Result<u64, Failure> {
    let is_duration = seconds.is_finite() && seconds >= 0.0;
    if !is_duration {
        let problem = format_args!("must be zero or positive, and finite, not {seconds}");
        return Err(Failure::value("seconds", problem));
    }
    if !(dt.is_finite() && dt > 0.0) {
        return Err(Failure::value("dt", format_args!("must be positive and finite, not {dt}")));
    }
    // A billionth of a frame is rounding.
    let frames = (seconds / dt - 1e-9).ceil();
    // Larger numbers cannot be counted in steps of one.
    if frames >= 2f64.powi(53) {
        let problem = format_args!("{frames} frames of {dt} s are more than can be counted");
        return Err(Failure::value("seconds", problem));
    }
    Ok(frames as u64)
}
