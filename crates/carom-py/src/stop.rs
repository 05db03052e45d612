//! Python's signals during a step: Ctrl-C raises `KeyboardInterrupt` there.

use std::cell::Cell;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, ThreadId};
use std::time::{Duration, Instant};

use carom::StopRequest;
use pyo3::prelude::*;

/// Time before the first check of signals, and between two checks; each check waits for the
/// interpreter.
pub const PATIENCE: Duration = Duration::from_millis(50);

/// The exception that a signal handler raised during a step.
static RAISED: Mutex<Option<PyErr>> = Mutex::new(None);

thread_local! {
    /// Whether a step of this thread is running signal handlers.
    static RUNS_HANDLERS: Cell<bool> = const { Cell::new(false) };
}

/// Stops frames when a signal handler raises an exception. Python runs handlers only in its main
/// thread, so the calling thread checks, whichever threads take the frames.
#[derive(Debug, Clone)]
pub struct Watch(Arc<Looks>);

#[derive(Debug)]
struct Looks {
    last: Mutex<Instant>,
    has_raised: AtomicBool,
    /// The thread that called.
    caller: ThreadId,
}

impl Watch {
    /// Makes a watch for the frames that this thread takes next.
    pub fn begin() -> Self {
        let (last, has_raised) = (Mutex::new(Instant::now()), AtomicBool::new(false));
        Self(Arc::new(Looks { last, has_raised, caller: thread::current().id() }))
    }

    /// Returns the stop request for a step.
    pub fn request(&self) -> StopRequest {
        let watch = self.clone();
        StopRequest::new(move || {
            if thread::current().id() == watch.0.caller {
                watch.look_if_due();
            }
            watch.0.has_raised.load(Ordering::Relaxed)
        })
    }

    /// Waits for the result of other threads and checks signals meanwhile. `None` if they panic.
    pub fn wait<T>(&self, done: &Receiver<T>) -> Option<T> {
        loop {
            // Stops a run of many short frames, too.
            self.look_if_due();
            match done.recv_timeout(PATIENCE) {
                Ok(value) => return Some(value),
                Err(RecvTimeoutError::Disconnected) => return None,
                Err(RecvTimeoutError::Timeout) => {}
            }
        }
    }

    fn look_if_due(&self) {
        let mut last = self.0.last.lock().unwrap_or_else(PoisonError::into_inner);
        if last.elapsed() < PATIENCE || self.0.has_raised.load(Ordering::Relaxed) {
            return;
        }
        let handled = Python::attach(check);
        *last = Instant::now();
        if let Err(error) = handled {
            *RAISED.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
            self.0.has_raised.store(true, Ordering::Relaxed);
        }
    }
}

/// Runs the handlers of pending signals.
///
/// # Errors
/// The exception that a handler raised.
pub fn check(py: Python<'_>) -> PyResult<()> {
    // A handler may step another world and be interrupted there.
    let before = RUNS_HANDLERS.replace(true);
    let handled = py.check_signals();
    RUNS_HANDLERS.set(before);
    handled
}

/// Returns whether a signal handler is running during a step of this thread.
pub fn is_in_handler() -> bool {
    RUNS_HANDLERS.get()
}

/// Removes and returns the exception that stopped a step.
pub fn raised() -> Option<PyErr> {
    RAISED.lock().unwrap_or_else(PoisonError::into_inner).take()
}
