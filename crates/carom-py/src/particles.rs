//! Particle files, from arrays and into arrays.

// Python shows these comments as docstrings, with units in plain brackets.
#![allow(rustdoc::broken_intra_doc_links)]

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

use carom_scene::recording::{
    ParticleError, ParticleFormat, ParticleFrame, ParticleTable, RecordingError, read_particles,
};
use numpy::{PyArray1, PyReadonlyArray1, PyReadonlyArray3};
use pyo3::prelude::*;

use crate::arrays::shaped;
use crate::failure::Failure;
use crate::quantity::Quantity;

/// States of spheres over time, as `Particles` of Python has them; NaN where a sphere is absent.
#[derive(FromPyObject)]
pub struct Particles<'py> {
    time: PyReadonlyArray1<'py, f64>,
    ids: PyReadonlyArray1<'py, u64>,
    radii: PyReadonlyArray1<'py, f64>,
    masses: PyReadonlyArray1<'py, f64>,
    sides: [f64; 3],
    slides: Option<PyReadonlyArray1<'py, f64>>,
    positions: PyReadonlyArray3<'py, f64>,
    velocities: Option<PyReadonlyArray3<'py, f64>>,
    orientations: Option<PyReadonlyArray3<'py, f64>>,
    angular_velocities: Option<PyReadonlyArray3<'py, f64>>,
}

/// Times, ids, radii and masses if the file has them, the sides of the box, how far the box above slid in each frame,
/// and what changes, by name.
type Arrays<'py> = (
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<u64>>,
    Option<Bound<'py, PyArray1<f64>>>,
    Option<Bound<'py, PyArray1<f64>>>,
    [f64; 3],
    Bound<'py, PyArray1<f64>>,
    Vec<(&'static str, Bound<'py, PyAny>)>,
);

/// Writes a particle file; its ending selects the format.
#[pyfunction]
pub fn write_particle_file(path: PathBuf, particles: Particles<'_>) -> PyResult<()> {
    let mut table =
        ParticleTable::create(&path, format_of(&path)?).map_err(|error| match error {
            RecordingError::Unwritable { path, source } => of_system(&path, &source),
            other => Failure::of_file(other).into(),
        })?;
    for (row, &time) in particles.time.as_slice()?.iter().enumerate() {
        let frame = frame(&particles, row, time)?;
        table.push(&frame).map_err(|error| of_system(&path, &error))?;
    }
    Ok(())
}

fn frame(particles: &Particles<'_>, row: usize, time: f64) -> PyResult<ParticleFrame> {
    let (ids, radii) = (particles.ids.as_slice()?, particles.radii.as_slice()?);
    let masses = particles.masses.as_slice()?;
    let count = ids.len();
    let all = vectors::<3>(&particles.positions, row, count)?;
    let there: Vec<usize> =
        (0..count).filter(|&index| all[index].iter().all(|it| !it.is_nan())).collect();
    let of = |values: &[f64]| there.iter().map(|&index| values[index]).collect();
    let three = |array: &PyReadonlyArray3<'_, f64>| {
        let all = vectors::<3>(array, row, count)?;
        PyResult::Ok(there.iter().map(|&index| all[index]).collect())
    };
    let four = |array: &PyReadonlyArray3<'_, f64>| {
        let all = vectors::<4>(array, row, count)?;
        PyResult::Ok(there.iter().map(|&index| all[index]).collect())
    };
    Ok(ParticleFrame {
        time: Some(time),
        sides: particles.sides,
        slide: match &particles.slides {
            Some(slides) => slides.as_slice()?.get(row).copied(),
            None => None,
        },
        ids: there.iter().map(|&index| ids[index]).collect(),
        positions: there.iter().map(|&index| all[index]).collect(),
        velocities: particles.velocities.as_ref().map(three).transpose()?,
        radii: Some(of(radii)),
        masses: Some(of(masses)),
        inertias: None,
        orientations: particles.orientations.as_ref().map(four).transpose()?,
        angular_velocities: particles.angular_velocities.as_ref().map(three).transpose()?,
    })
}

/// Returns a row of an array of shape (t, n, N).
fn vectors<'a, const N: usize>(
    array: &'a PyReadonlyArray3<'_, f64>,
    row: usize,
    count: usize,
) -> PyResult<&'a [[f64; N]]> {
    let (vectors, _) = array.as_slice()?.as_chunks::<N>();
    let row = vectors.get(row * count..(row + 1) * count);
    row.ok_or_else(|| Failure::value("particles", "must have arrays of one shape").into())
}

/// Reads all whole frames of a particle file. Times that it lacks are the numbers of the frames.
#[pyfunction]
pub fn read_particle_file(py: Python<'_>, path: PathBuf) -> PyResult<Arrays<'_>> {
    let format = format_of(&path)?;
    let frames = py.detach(|| read_particles(&path, format)).map_err(|error| match error {
        ParticleError::Unreadable { path, source } => of_system(&path, &source),
        other => Failure::of_file(other).into(),
    })?;
    let sides = frames.first().map_or([f64::INFINITY; 3], |frame| frame.sides);
    // Programs that write bounds of skewed boxes round them.
    let is_same = |one: f64, other: f64| one == other || (one - other).abs() <= 1e-12 * other;
    let is_changed = |frame: &ParticleFrame| (0..3).any(|i| !is_same(frame.sides[i], sides[i]));
    if frames.iter().any(is_changed) {
        let problem = format!("{}: its box changes from frame to frame", path.display());
        return Err(Failure::of_file(problem).into());
    }
    let times = frames.iter().enumerate().map(|(row, it)| it.time.unwrap_or(row as f64));
    let ids = frames.iter().flat_map(|frame| &frame.ids);
    let mut columns: BTreeMap<u64, usize> = ids.map(|&id| (id, 0)).collect();
    columns.values_mut().enumerate().for_each(|(column, place)| *place = column);
    let states = States { frames: &frames, columns: &columns };
    let vectors = [
        states.vectors(py, Quantity::Positions, |frame| Some(&frame.positions))?,
        states.vectors(py, Quantity::Velocities, |frame| frame.velocities.as_ref())?,
        states.vectors(py, Quantity::Orientations, |frame| frame.orientations.as_ref())?,
        states
            .vectors(py, Quantity::AngularVelocities, |frame| frame.angular_velocities.as_ref())?,
    ];
    let numbers = |values: Vec<f64>| PyArray1::from_vec(py, values);
    Ok((
        numbers(times.collect()),
        PyArray1::from_iter(py, columns.keys().copied()),
        states.numbers(|frame| frame.radii.as_ref()).map(numbers),
        states.numbers(|frame| frame.masses.as_ref()).map(numbers),
        sides,
        numbers(frames.iter().map(|frame| frame.slide.unwrap_or(0.0)).collect()),
        vectors.into_iter().flatten().collect(),
    ))
}

/// Frames, and the column of each sphere in arrays.
struct States<'a> {
    frames: &'a [ParticleFrame],
    columns: &'a BTreeMap<u64, usize>,
}

impl States<'_> {
    /// Returns a quantity of all frames as an array (t, n, N), NaN where a sphere is absent; `None`
    /// if a frame does not have it.
    fn vectors<'py, const N: usize>(
        &self,
        py: Python<'py>,
        quantity: Quantity,
        of: impl Fn(&ParticleFrame) -> Option<&Vec<[f64; N]>>,
    ) -> PyResult<Option<(&'static str, Bound<'py, PyAny>)>> {
        let [rows, count] = [self.frames.len(), self.columns.len()];
        let mut all = vec![[f64::NAN; N]; rows * count];
        for (row, frame) in self.frames.iter().enumerate() {
            let Some(values) = of(frame) else { return Ok(None) };
            for (id, value) in frame.ids.iter().zip(values) {
                all[row * count + self.columns[id]] = *value;
            }
        }
        let array = shaped(py, all.into_flattened(), vec![rows, count, N])?;
        Ok(Some((quantity.name(), array.into_any())))
    }

    /// Returns the last value of each sphere; `None` if a frame does not have them.
    fn numbers(&self, of: impl Fn(&ParticleFrame) -> Option<&Vec<f64>>) -> Option<Vec<f64>> {
        let mut all = vec![f64::NAN; self.columns.len()];
        for frame in self.frames {
            for (id, value) in frame.ids.iter().zip(of(frame)?) {
                all[self.columns[id]] = *value;
            }
        }
        Some(all)
    }
}

fn format_of(path: &Path) -> Result<ParticleFormat, Failure> {
    ParticleFormat::of(path)
        .ok_or_else(|| Failure::of_file(format!("{}: is no particle file", path.display())))
}

/// An error of the system, with the path.
fn of_system(path: &Path, error: &io::Error) -> PyErr {
    io::Error::new(error.kind(), format!("{}: {error}", path.display())).into()
}
