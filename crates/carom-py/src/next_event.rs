//! Steps that end at the next impact.

// What is said of methods here is read in Python: units in plain brackets, errors in Google's style.
#![allow(rustdoc::broken_intra_doc_links)]

use pyo3::prelude::*;

use crate::arguments;
use crate::engine::{Engine, Inner};
use crate::failure::Failure;
use crate::threads;

#[pymethods]
impl Engine {
    /// The time of the next impact on the world's clock [s], if one comes within so many seconds;
    /// else None.
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

    /// Advances the world to its next impact, and answers it with all others at that instant; by
    /// `within` [s] if none comes before. `impacts` tells which it was.
    ///
    /// Only under the rule `exact`. Other threads run meanwhile. If the step is refused, the world is
    /// as it was before the call.
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
