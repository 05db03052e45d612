//! A world at one moment, to return to.

// What is said of methods here is read in Python, where units stand in plain brackets.
#![allow(rustdoc::broken_intra_doc_links)]

use std::sync::Arc;

use carom_scene::{Checkpoint, CheckpointError, Palette, Scene};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::failure::Failure;

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

    /// The snapshot as bytes, the same ones on every platform: what `from_bytes` takes.
    ///
    /// The same version of Carom reads them; pickles of snapshots, worlds and batches hold them.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let written =
            py.detach(|| Checkpoint::bytes_of(&self.world, &self.described, &self.palette));
        let written = written.map_err(|error| refused("snapshot", error))?;
        PyBytes::new_with(py, written.len(), |bytes| {
            bytes.copy_from_slice(&written);
            Ok(())
        })
    }

    /// The snapshot that `to_bytes` made these bytes of: a world that is restored from it goes on as the
    /// one that it was taken of, bit for bit.
    ///
    /// A checksum notices damage, but not what was made to mislead: read only bytes that you trust.
    ///
    /// Raises:
    ///     MemoryError: If there is not enough for the snapshot.
    ///     CaromError: For bytes that are no snapshot, of another version of Carom, or damaged.
    #[staticmethod]
    fn from_bytes(py: Python<'_>, data: &[u8]) -> PyResult<Self> {
        let read = py.detach(|| Checkpoint::from_bytes(data));
        let Checkpoint { snapshot, scene, palette } =
            read.map_err(|error| refused("data", error))?;
        let time = snapshot.time();
        let (described, palette) = (Arc::new(scene), Arc::new(palette));
        Ok(Self { world: snapshot, described, palette, time })
    }

    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyBytes>,))> {
        let bytes = slf.get().to_bytes(slf.py())?;
        Ok((slf.getattr("from_bytes")?, (bytes,)))
    }

    fn __repr__(&self) -> String {
        format!("<carom.Snapshot at {} s>", self.time)
    }
}

/// Why the bytes of `field` are refused, or there are none.
fn refused(field: &str, error: CheckpointError) -> Failure {
    match error {
        CheckpointError::NoMemory => Failure::memory(error),
        _ => Failure::value(field, error),
    }
}
