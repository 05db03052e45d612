//! Steps that end at the next impact.

// Python shows these comments as docstrings: units in plain brackets, errors in Google's style.
#![allow(rustdoc::broken_intra_doc_links)]

use pyo3::prelude::*;

use crate::arguments;
use crate::engine::Engine;
use crate::failure::Failure;
use crate::inner::Inner;
use crate::threads;

#[pymethods]
impl Engine {
    /// Returns the time of the next impact on the world's clock [s], or None if there is none
    /// within `within` [s].
    ///
    /// Only under the rule `exact`. It costs as much as a copy of the world and the step to that
    /// impact. Other threads run meanwhile.
    ///
    /// Raises:
    ///     CaromError: Under another rule, or if `within` is not positive and finite.
    ///     StepError: If a number would overflow, or there are too many impacts.
    fn next_event_time(&self, within: &Bound<'_, PyAny>) -> PyResult<Option<f64>> {
        let py = within.py();
        let within = arguments::number("within", within)?;
        let mut guard = self.lock(py)?;
        let inner = &mut *guard;
        inner.heed_signals();
        let time = py.detach(|| inner.world.next_event_time(within));
        drop(guard);
        Ok(time.map_err(Failure::from)?)
    }

    /// Advances the world to its next impact and resolves it with all others at that time, at most
    /// by `within` [s]. `impacts` then has them.
    ///
    /// Only under the rule `exact`. Other threads run meanwhile. If the step is refused, the world
    /// keeps its state before the call.
    ///
    /// Raises:
    ///     CaromError: Under another rule, or if `within` is not positive and finite.
    ///     StepError: If a number would overflow, or there are too many impacts.
    fn step_to_next_event(&self, within: &Bound<'_, PyAny>) -> PyResult<()> {
        let py = within.py();
        let within = arguments::number("within", within)?;
        let mut guard = self.lock(py)?;
        let inner = &mut *guard;
        let taken = py.detach(|| step_to_next_event(inner, within));
        if taken.is_ok() {
            inner.arrays.write_motion(py, inner.world.spheres());
        }
        drop(guard);
        Ok(taken?)
    }
}

fn step_to_next_event(inner: &mut Inner, within: f64) -> Result<(), Failure> {
    let start = inner.world.time();
    let watch = inner.heed_signals();
    let world = &mut inner.world;
    let spheres = world.spheres().len();
    threads::among_all(spheres, &watch, || world.step_to_next_event(within).map(|_| ()))?;
    inner.frame_start = start;
    Ok(())
}
