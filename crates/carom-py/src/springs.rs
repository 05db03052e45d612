//! Springs of a world, whose ends are ids of spheres, in JSON and in descriptions.

// Python shows these comments as docstrings: units in plain brackets, errors in Google's style.
#![allow(rustdoc::broken_intra_doc_links)]

use carom::SpringId;
use carom_scene::part;
use carom_scene::scene::Spring;
use pyo3::prelude::*;

use crate::arguments;
use crate::describing::json;
use crate::engine::Engine;
use crate::failure::Failure;

#[pymethods]
impl Engine {
    /// Returns the springs with their ids.
    #[pyo3(name = "_springs_json")]
    fn springs_json(&self, py: Python<'_>) -> PyResult<String> {
        let inner = &*self.lock(py)?;
        let springs = inner.world.springs();
        let springs = springs.filter_map(|(id, it)| Some((id.number(), Spring::by_ids(it)?)));
        json(&springs.collect::<Vec<_>>())
    }

    /// Adds the spring that `text` describes. Returns its id.
    #[pyo3(name = "_add_spring")]
    fn add_spring_of(&self, py: Python<'_>, text: &str) -> PyResult<u64> {
        self.change(py, |inner| {
            let spring = part::spring_of(text, &inner.world)?;
            Ok(inner.world.add_spring(spring)?.number())
        })
    }

    /// Replaces a spring by the one in `text`; it keeps its id.
    #[pyo3(name = "_set_spring")]
    fn set_spring_of(&self, py: Python<'_>, id: &Bound<'_, PyAny>, text: &str) -> PyResult<()> {
        let id = SpringId::from_number(arguments::id("spring", id)?);
        self.change(py, |inner| {
            inner.world.spring(id)?;
            let spring = part::spring_of(text, &inner.world)?;
            Ok(inner.world.set_spring(id, spring)?)
        })
    }

    /// Removes a spring; its spheres stay.
    ///
    /// Raises:
    ///     UnknownError: If the world does not (or no longer) contain it.
    fn remove_spring(&self, py: Python<'_>, id: &Bound<'_, PyAny>) -> PyResult<()> {
        let id = SpringId::from_number(arguments::id("spring", id)?);
        self.change(py, |inner| {
            inner.world.remove_spring(id)?;
            Ok(())
        })
    }
}

impl From<part::SpringError> for Failure {
    fn from(error: part::SpringError) -> Self {
        match error {
            part::SpringError::Part(error) => error.into(),
            part::SpringError::World(error) => error.into(),
        }
    }
}
