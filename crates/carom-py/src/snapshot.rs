//! Snapshots of a world.

// Python shows these comments as docstrings, with units in plain brackets.
#![allow(rustdoc::broken_intra_doc_links)]

use std::sync::{Arc, PoisonError, RwLock, RwLockReadGuard};

use carom_scene::{Checkpoint, CheckpointError, Palette, Scene};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::failure::Failure;

/// The state of a world at one time: everything that the future depends on, and its description.
#[derive(Debug, Clone)]
pub struct State {
    pub world: carom::Snapshot,
    pub described: Arc<Scene>,
    pub palette: Arc<Palette>,
    /// Time \[s\].
    pub time: f64,
}

/// The state of a world at one time, returned by `World.snapshot` and restored by `World.restore`.
#[pyclass(frozen, module = "carom")]
#[derive(Debug)]
pub struct Snapshot(RwLock<State>);

impl From<State> for Snapshot {
    fn from(state: State) -> Self {
        Self(RwLock::new(state))
    }
}

impl Snapshot {
    /// Returns the state for reading. A thread that waits for Python's lock must not hold the guard: threads with
    /// that lock wait for the state.
    pub fn state(&self) -> RwLockReadGuard<'_, State> {
        self.0.read().unwrap_or_else(PoisonError::into_inner)
    }

    /// Overwrites the state; `write` must not wait for Python's lock.
    pub fn overwrite(&self, write: impl FnOnce(&mut State)) {
        write(&mut self.0.write().unwrap_or_else(PoisonError::into_inner));
    }
}

#[pymethods]
impl Snapshot {
    /// Time of the snapshot [s].
    #[getter]
    fn time(&self) -> f64 {
        self.state().time
    }

    /// Returns the snapshot as bytes for `from_bytes`, the same ones on every platform.
    ///
    /// Only the same version of Carom can read them. Pickles of snapshots, worlds and batches
    /// contain them.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let written = py.detach(|| {
            let state = self.state();
            Checkpoint::bytes_of(&state.world, &state.described, &state.palette)
        });
        let written = written.map_err(|error| refused("snapshot", error))?;
        PyBytes::new_with(py, written.len(), |bytes| {
            bytes.copy_from_slice(&written);
            Ok(())
        })
    }

    /// Returns the snapshot from bytes of `to_bytes`. A world restored from it continues like the
    /// original one, bit for bit.
    ///
    /// A checksum detects damage, but not malicious bytes: read only bytes that you trust.
    ///
    /// Raises:
    ///     MemoryError: If there is not enough memory for the snapshot.
    ///     CaromError: If the bytes are no snapshot, come from another version of Carom, or are damaged.
    #[staticmethod]
    fn from_bytes(py: Python<'_>, data: &[u8]) -> PyResult<Self> {
        let read = py.detach(|| Checkpoint::from_bytes(data));
        let Checkpoint { snapshot, scene, palette } =
            read.map_err(|error| refused("data", error))?;
        let time = snapshot.time();
        let (described, palette) = (Arc::new(scene), Arc::new(palette));
        Ok(State { world: snapshot, described, palette, time }.into())
    }

    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyBytes>,))> {
        let bytes = slf.get().to_bytes(slf.py())?;
        Ok((slf.getattr("from_bytes")?, (bytes,)))
    }

    fn __repr__(&self) -> String {
        format!("<carom.Snapshot at {} s>", self.time())
    }
}

/// Returns the failure if the bytes of `field` are refused or cannot be made.
fn refused(field: &str, error: CheckpointError) -> Failure {
    match error {
        CheckpointError::NoMemory => Failure::memory(error),
        _ => Failure::value(field, error),
    }
}
