//! Python's signals, while a step is at work: Ctrl-C raises `KeyboardInterrupt` there.

use std::cell::Cell;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, ThreadId};
use std::time::{Duration, Instant};

use carom::StopRequest;
use pyo3::prelude::*;

/// How long frames go on before they look at the signals, and between two looks: each waits for the
/// interpreter.
pub const PATIENCE: Duration = Duration::from_millis(50);

/// What a handler of a signal raised while a step was at work.
static RAISED: Mutex<Option<PyErr>> = Mutex::new(None);

thread_local! {
    /// Whether a step of this thread is running the handlers of signals.
    static RUNS_HANDLERS: Cell<bool> = const { Cell::new(false) };
}

/// What stops frames: a handler of a signal that has raised an exception. Python runs handlers in its main
/// thread only: the one that has called looks, wherever the frames are taken.
#[derive(Debug, Clone)]
pub struct Watch(Arc<Looks>);

#[derive(Debug)]
struct Looks {
    last: Mutex<Instant>,
    has_raised: AtomicBool,
    /// The thread that has called.
    caller: ThreadId,
}

impl Watch {
    /// For the frames that begin now, called from this thread.
    pub fn begin() -> Self {
        let (last, has_raised) = (Mutex::new(Instant::now()), AtomicBool::new(false));
        Self(Arc::new(Looks { last, has_raised, caller: thread::current().id() }))
    }

    /// What a step is to look at.
    pub fn request(&self) -> StopRequest {
        let watch = self.clone();
        StopRequest::new(move || {
            if thread::current().id() == watch.0.caller {
                watch.look_if_due();
            }
            watch.0.has_raised.load(Ordering::Relaxed)
        })
    }

    /// Waits for what other threads are at work on, and looks meanwhile. `None` if they panic.
    pub fn wait<T>(&self, done: &Receiver<T>) -> Option<T> {
        loop {
            // Many short frames are to be stopped, too.
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

/// Runs the handlers of signals that have come.
///
/// # Errors
/// What one of them raised.
pub fn check(py: Python<'_>) -> PyResult<()> {
    // A handler may step another world, and be interrupted there.
    let before = RUNS_HANDLERS.replace(true);
    let handled = py.check_signals();
    RUNS_HANDLERS.set(before);
    handled
}

/// Whether a handler of a signal is being run in the middle of a step of this thread.
pub fn is_in_handler() -> bool {
    RUNS_HANDLERS.get()
}

/// The exception that stopped a step.
pub fn raised() -> Option<PyErr> {
    RAISED.lock().unwrap_or_else(PoisonError::into_inner).take()
}
