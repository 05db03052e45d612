//! Predicted paths of spheres.

// Python shows these comments as docstrings: units in plain brackets, errors in Google's style.
#![allow(rustdoc::broken_intra_doc_links)]

use carom::{DVec3, PathEnd, SphereId};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::arguments;
use crate::engine::Engine;
use crate::failure::Failure;
use crate::tables::Table;

/// A predicted path, behind `carom.PredictedPath`.
#[pyclass(frozen, module = "carom._carom")]
#[derive(Debug)]
pub struct Path {
    path: carom::PredictedPath,
    /// Time of the prediction, on the world's clock \[s\].
    now: f64,
}

#[pymethods]
impl Engine {
    /// Predicts the path of a sphere for `horizon` [s], or up to its impact number `most_impacts`.
    #[pyo3(name = "_predict")]
    fn predict(
        &self,
        py: Python<'_>,
        id: &Bound<'_, PyAny>,
        horizon: &Bound<'_, PyAny>,
        most_impacts: &Bound<'_, PyAny>,
    ) -> PyResult<Path> {
        let id = SphereId::from_number(arguments::id("sphere", id)?);
        let horizon = arguments::number("horizon", horizon)?;
        let most = arguments::count("most_impacts", most_impacts)?;
        let most = usize::try_from(most).unwrap_or(usize::MAX);
        let mut guard = self.lock(py)?;
        let inner = &mut *guard;
        inner.heed_signals();
        let now = inner.world.time();
        let path = py.detach(|| inner.world.predict(id, horizon, most));
        drop(guard);
        Ok(Path { path: path.map_err(Failure::from)?, now })
    }
}

#[pymethods]
impl Path {
    /// Where it ends: "horizon", "impacts" or "no closed form".
    #[getter]
    fn end(&self) -> &'static str {
        match self.path.end {
            PathEnd::Impacts => "impacts",
            PathEnd::NoClosedForm => "no closed form",
            // `PathEnd` may get further ends.
            _ => "horizon",
        }
    }

    /// Time of its end, on the world's clock [s].
    #[getter]
    fn end_time(&self) -> f64 {
        self.path.end_time()
    }

    /// Returns the impacts as words.
    fn impact_words<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u64>> {
        let mut table = Table::default();
        table.push_impacts(self.now, &self.path.impacts);
        PyArray1::from_vec(py, table.into_words())
    }

    /// Returns the legs as words.
    fn leg_words<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u64>> {
        let mut table = Table::default();
        table.push_legs(&self.path.legs);
        PyArray1::from_vec(py, table.into_words())
    }

    /// Returns the centres [m] at times on the world's clock [s], three numbers for each; NaN
    /// outside of the path.
    fn positions_at<'py>(
        &self,
        py: Python<'py>,
        times: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        vectors(py, &times, |time| self.path.position_at(time))
    }

    /// Returns the velocities [m/s] at times on the world's clock [s], three numbers for each; NaN
    /// outside of the path.
    fn velocities_at<'py>(
        &self,
        py: Python<'py>,
        times: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        vectors(py, &times, |time| self.path.velocity_at(time))
    }
}

fn vectors<'py>(
    py: Python<'py>,
    times: &PyReadonlyArray1<'py, f64>,
    at: impl Fn(f64) -> Option<DVec3>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let vector = |&time: &f64| at(time).unwrap_or(DVec3::NAN).to_array();
    let vectors: Vec<f64> = times.as_slice()?.iter().flat_map(vector).collect();
    Ok(PyArray1::from_vec(py, vectors))
}
