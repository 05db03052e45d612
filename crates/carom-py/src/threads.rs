//! Threads of the engine's own.

use std::num::NonZero;
use std::sync::{Arc, Mutex, PoisonError, mpsc};
use std::{mem, process, thread};

use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

use crate::arguments;
use crate::failure::Failure;
use crate::stop::Watch;

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

/// Threads that share work, started with the first of it.
///
/// A process that was forked has none of the threads of its parent, and would wait for them for ever: it
/// starts its own.
#[derive(Debug)]
pub struct Pool {
    /// How many; 0 for as many as there are processors.
    threads: usize,
    /// With the number of the process that they are of.
    started: Mutex<Option<(u32, Arc<ThreadPool>)>>,
}

impl Pool {
    const fn new(threads: usize) -> Self {
        Self { threads, started: Mutex::new(None) }
    }

    /// Has the threads do work; where they cannot be started, the calling one does it.
    pub fn install<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        match self.started() {
            Ok(threads) => threads.install(work),
            Err(_) => work(),
        }
    }

    /// Has the threads do work that may take long, while this one watches for signals; where they cannot be
    /// started, this one does it.
    pub fn watch<T: Send>(&self, watch: &Watch, work: impl FnOnce() -> T + Send) -> T {
        match self.started() {
            Ok(threads) => watched(&threads, watch, work),
            Err(_) => work(),
        }
    }

    /// The threads of this process.
    fn started(&self) -> Result<Arc<ThreadPool>, ThreadPoolBuildError> {
        let mut started = self.started.lock().unwrap_or_else(PoisonError::into_inner);
        let process = process::id();
        if let Some((owner, threads)) = &*started
            && *owner == process
        {
            return Ok(Arc::clone(threads));
        }
        let threads = Arc::new(ThreadPoolBuilder::new().num_threads(self.threads).build()?);
        // Threads of a parent cannot be ended here.
        mem::forget(started.replace((process, Arc::clone(&threads))));
        Ok(threads)
    }
}

impl Drop for Pool {
    fn drop(&mut self) {
        let started = self.started.get_mut().unwrap_or_else(PoisonError::into_inner);
        if started.as_ref().is_some_and(|(owner, _)| *owner != process::id()) {
            mem::forget(started.take());
        }
    }
}

/// The threads that share the work of one world.
static SHARED: Pool = Pool::new(0);

/// Does work on so many spheres of one world, which all processors share where there are many. Meanwhile this
/// thread watches for signals.
pub fn among_all<T: Send>(spheres: usize, watch: &Watch, work: impl FnOnce() -> T + Send) -> T {
    let is_shared = spheres >= FEW && rayon::current_thread_index().is_none();
    let threads = if is_shared { SHARED.started().ok() } else { None };
    match threads {
        Some(threads) => watched(&threads, watch, work),
        None => work(),
    }
}

/// Has threads do work, while this one watches for signals.
fn watched<T: Send>(threads: &ThreadPool, watch: &Watch, work: impl FnOnce() -> T + Send) -> T {
    let done = threads.in_place_scope(|scope| {
        let (send, done) = mpsc::channel();
        scope.spawn(move |_| {
            // It is waited for.
            let _ = send.send(work());
        });
        watch.wait(&done)
    });
    match done {
        Some(value) => value,
        // A panic of the work has come here before.
        None => unreachable!("work that ends tells so"),
    }
}

/// So many threads, by default as many as there are processors, but no more than `most`; `None`
/// where one does everything.
///
/// # Errors
/// [`Failure`] if they cannot be started.
pub fn pool(threads: Option<usize>, most: usize) -> Result<Option<Pool>, Failure> {
    let processors = || thread::available_parallelism().map_or(1, NonZero::get);
    let threads = threads.unwrap_or_else(processors).min(most);
    if threads <= 1 {
        return Ok(None);
    }
    let pool = Pool::new(threads);
    pool.started().map_err(|error| Failure::value("threads", error))?;
    Ok(Some(pool))
}
