//! The engine's own threads.

use std::num::NonZero;
use std::sync::{Arc, Mutex, PoisonError, mpsc};
use std::{mem, process, thread};

use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

use crate::arguments;
use crate::failure::Failure;
use crate::stop::Watch;

/// Reads the number of threads, if it is given.
///
/// # Errors
/// As [`arguments::count`], and [`Failure`] for 0.
pub fn wanted(threads: Option<&Bound<'_, PyAny>>) -> PyResult<Option<usize>> {
    let threads = threads.map(|threads| arguments::count("threads", threads)).transpose()?;
    if threads == Some(0) {
        return Err(Failure::value("threads", "must be at least 1, not 0").into());
    }
    Ok(threads.map(|threads| threads as usize))
}

/// A world with fewer spheres is stepped in the calling thread: waking another would take longer.
const FEW: usize = 1024;

/// Threads that share work, started at the first use.
///
/// A forked process has no threads of its parent, and would wait for them forever; it starts its
/// own.
#[derive(Debug)]
pub struct Pool {
    /// Number of threads; 0 for as many as processors.
    threads: usize,
    /// The threads, and the id of the process that started them.
    started: Mutex<Option<(u32, Arc<ThreadPool>)>>,
}

impl Pool {
    const fn new(threads: usize) -> Self {
        Self { threads, started: Mutex::new(None) }
    }

    /// Runs work on the threads; if they cannot be started, in the calling thread.
    pub fn install<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        match self.started() {
            Ok(threads) => threads.install(work),
            Err(_) => work(),
        }
    }

    /// Runs long work on the threads while the calling thread watches for signals; if they cannot
    /// be started, in the calling thread.
    pub fn watch<T: Send>(&self, watch: &Watch, work: impl FnOnce() -> T + Send) -> T {
        match self.started() {
            Ok(threads) => watched(&threads, watch, work),
            Err(_) => work(),
        }
    }

    /// Returns the threads of this process.
    fn started(&self) -> Result<Arc<ThreadPool>, ThreadPoolBuildError> {
        let mut started = self.started.lock().unwrap_or_else(PoisonError::into_inner);
        let process = process::id();
        if let Some((owner, threads)) = &*started
            && *owner == process
        {
            return Ok(Arc::clone(threads));
        }
        let threads = Arc::new(ThreadPoolBuilder::new().num_threads(self.threads).build()?);
        // Threads of a parent process cannot be ended here.
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

/// The threads that share the work of a single world.
static SHARED: Pool = Pool::new(0);

/// Runs work on one world. If it has many spheres, all processors share it while the calling thread
/// watches for signals.
pub fn among_all<T: Send>(spheres: usize, watch: &Watch, work: impl FnOnce() -> T + Send) -> T {
    let is_shared = spheres >= FEW && rayon::current_thread_index().is_none();
    let threads = if is_shared { SHARED.started().ok() } else { None };
    match threads {
        Some(threads) => watched(&threads, watch, work),
        None => work(),
    }
}

/// Runs work on threads while the calling thread watches for signals.
fn watched<T: Send>(threads: &ThreadPool, watch: &Watch, work: impl FnOnce() -> T + Send) -> T {
    let done = threads.in_place_scope(|scope| {
        let (send, done) = mpsc::channel();
        scope.spawn(move |_| {
            // The receiver waits for it.
            let _ = send.send(work());
        });
        watch.wait(&done)
    });
    match done {
        Some(value) => value,
        // A panic of the work has already been passed on.
        None => unreachable!("work that ends tells so"),
    }
}

/// Returns a pool with this number of threads, by default one per processor, at most `most`; `None`
/// if one thread does everything.
///
/// # Errors
/// [`Failure`] if the threads cannot be started.
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
