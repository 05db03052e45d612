//! Python's signals, while a step is at work: Ctrl-C raises `KeyboardInterrupt` there.

use std::cell::Cell;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use carom::StopRequest;
use pyo3::prelude::*;

/// How long frames go on before they look at the signals, and between two looks: each waits for the
/// interpreter.
const PATIENCE: Duration = Duration::from_millis(50);

/// What a handler of a signal raised while a step was at work.
static RAISED: Mutex<Option<PyErr>> = Mutex::new(None);

thread_local! {
    /// Whether a step of this thread is running the handlers of signals.
    static RUNS_HANDLERS: Cell<bool> = const { Cell::new(false) };
}

/// A request of the frames that begin now: it stands once a handler of a signal has raised an
/// exception. Python runs handlers in its main thread only.
pub fn on_signal() -> StopRequest {
    let last_look = Mutex::new(Instant::now());
    StopRequest::new(move || {
        let mut last_look = last_look.lock().unwrap_or_else(PoisonError::into_inner);
        if last_look.elapsed() < PATIENCE {
            return false;
        }
        let handled = Python::attach(check);
        *last_look = Instant::now();
        let Err(error) = handled else { return false };
        *RAISED.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
        true
    })
}

/// Runs the handlers of signals that have come.
///
/// # Errors
/// What one of them raised.
pub fn check(py: Python<'_>) -> PyResult<()> {
    RUNS_HANDLERS.set(true);
    let handled = py.check_signals();
    RUNS_HANDLERS.set(false);
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
