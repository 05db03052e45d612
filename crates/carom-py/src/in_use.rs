//! Locks of objects that one thread uses at a time.

use std::sync::{Mutex, MutexGuard};

use pyo3::PyResult;
use pyo3::exceptions::PyRuntimeError;

/// Locks an object. Does not wait: one that another thread uses is a `RuntimeError`.
pub fn lock<T>(mutex: &Mutex<T>) -> PyResult<MutexGuard<'_, T>> {
    let at_work = |_| PyRuntimeError::new_err("this is in use by another thread");
    mutex.try_lock().map_err(at_work)
}
