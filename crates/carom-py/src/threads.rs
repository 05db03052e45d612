//! Threads of the engine's own.

use std::num::NonZero;
use std::sync::{Arc, Mutex, PoisonError};
use std::{process, thread};

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

/// A world of fewer spheres than this is stepped where it is: that takes less time than to wake a thread.
const FEW: usize = 1024;

/// The threads that share the work of one world, of the process with this number.
static SHARED: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// Does work on so many spheres of one world, which all processors share where there are many.
pub fn among_all<T: Send>(spheres: usize, work: impl FnOnce() -> T + Send) -> T {
    if spheres < FEW || rayon::current_thread_index().is_some() {
        return work();
    }
    match shared() {
        Some(pool) => pool.install(work),
        None => work(),
    }
}

/// The threads of this process. One that was forked has none of those of its parent, and starts its own.
fn shared() -> Option<Arc<ThreadPool>> {
    let mut shared = SHARED.lock().unwrap_or_else(PoisonError::into_inner);
    let process = process::id();
    if let Some((owner, pool)) = &*shared
        && *owner == process
    {
        return Some(Arc::clone(pool));
    }
    let pool = Arc::new(ThreadPoolBuilder::new().build().ok()?);
    // Threads of a parent cannot be ended here.
    std::mem::forget(shared.replace((process, Arc::clone(&pool))));
    Some(pool)
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
