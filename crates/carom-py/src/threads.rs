//! Threads of the engine's own.

use std::num::NonZero;
use std::thread;

use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::arguments;
use crate::failure::Failure;

/// Reads how many threads are wanted, if that is said.
///
/// # Errors
/// As [`arguments::count`], and [`Failure`] for none.
pub fn wanted(threads: Option<&Bound<'_, PyAny>>) -> PyResult<Option<usize>> {
    let threads = threads.map(|threads| arguments::count("threads", threads)).transpose()?;
    if threads == Some(0) {
        return Err(Failure::value("threads", "must be at least 1, not 0").into());
    }
    Ok(threads.map(|threads| threads as usize))
}

/// So many threads, by default as many as there are processors, but no more than `most`; `None`
/// where one does everything.
///
/// # Errors
/// [`Failure`] if they cannot be started.
pub fn pool(threads: Option<usize>, most: usize) -> Result<Option<ThreadPool>, Failure> {
    let processors = || thread::available_parallelism().map_or(1, NonZero::get);
    let threads = threads.unwrap_or_else(processors).min(most);
    if threads <= 1 {
        return Ok(None);
    }
    let built = ThreadPoolBuilder::new().num_threads(threads).build();
    built.map(Some).map_err(|error| Failure::value("threads", error))
}
