//! The stress of spheres over a time.

// Python shows these comments as docstrings, with units in plain brackets.
#![allow(rustdoc::broken_intra_doc_links)]

use std::sync::Mutex;

use carom::DMat3;
use pyo3::prelude::*;

use crate::engine::Engine;
use crate::failure::Failure;
use crate::in_use::lock;

/// Rows of a tensor [Pa].
type Rows = [[f64; 3]; 3];

/// Measures the stress of a world, behind `carom.StressMeter`.
#[pyclass(frozen, module = "carom._carom")]
#[derive(Debug)]
pub struct StressEngine(Mutex<carom::StressMeter>);

#[pymethods]
impl StressEngine {
    /// Begins with a world as it is.
    #[new]
    fn new(py: Python<'_>, world: &Engine) -> PyResult<Self> {
        let guard = world.lock(py)?;
        Ok(Self(Mutex::new(carom::StressMeter::new(&guard.world))))
    }

    /// Advances the world, and measures each frame.
    fn step(
        &self,
        py: Python<'_>,
        world: &Engine,
        dt: Option<&Bound<'_, PyAny>>,
        frames: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let mut meter = lock(&self.0)?;
        let meter = &mut *meter;
        world.follow(py, (dt, frames), |world, dt| {
            world.step(dt).map(drop)?;
            meter.add_frame(world);
            Ok::<(), carom::Error>(())
        })
    }

    /// Time measured so far [s].
    #[getter]
    fn time(&self) -> PyResult<f64> {
        Ok(lock(&self.0)?.time())
    }

    /// Returns the kinetic, the collisional and the contact stress.
    fn stress(&self, volume: Option<f64>) -> PyResult<[Rows; 3]> {
        let stress = lock(&self.0)?.stress(volume).map_err(Failure::from)?;
        let rows = |tensor: DMat3| tensor.transpose().to_cols_array_2d();
        Ok([stress.kinetic, stress.collisional, stress.contact].map(rows))
    }
}
