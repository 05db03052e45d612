//! A world at one moment, to return to.

// What is said of methods here is read in Python, where units stand in plain brackets.
#![allow(rustdoc::broken_intra_doc_links)]

use std::sync::Arc;

use carom_scene::{Palette, Scene};
use pyo3::prelude::*;

/// The state of a world at one moment: what `World.snapshot` gives and `World.restore` takes.
#[pyclass(frozen, module = "carom")]
#[derive(Debug, Clone)]
pub struct Snapshot {
    pub(crate) world: carom::Snapshot,
    pub(crate) described: Arc<Scene>,
    pub(crate) palette: Arc<Palette>,
    /// \[s\]
    pub(crate) time: f64,
}

#[pymethods]
impl Snapshot {
    /// When it was taken [s].
    #[getter]
    fn time(&self) -> f64 {
        self.time
    }

    fn __repr__(&self) -> String {
        format!("<carom.Snapshot at {} s>", self.time)
    }
}
