//! The work of a step: counted, bounded, and stopped on request.

use std::cell::Cell;
use std::fmt::{self, Debug};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Units of work between two readings of a stop request: some milliseconds.
const UNITS_PER_LOOK: u64 = 50_000;

/// A request to end a step early: a signal came, a window closes, time is up.
///
/// A step reads it every few milliseconds, and ends with [`Error::Stopped`](crate::Error::Stopped) once it is made.
/// The world then keeps the state before the step.
///
/// ```
/// use std::sync::Arc;
/// use std::sync::atomic::{AtomicBool, Ordering};
///
/// use carom::{Error, Settings, StopRequest, World};
///
/// let is_stopping = Arc::new(AtomicBool::new(false));
/// let mut world = World::new(Settings::default())?;
/// world.set_stop_request(Some(StopRequest::from(is_stopping.clone())));
/// // As a signal handler or another thread would.
/// is_stopping.store(true, Ordering::Relaxed);
/// assert!(matches!(world.step(1.0), Err(Error::Stopped { .. })));
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone)]
pub struct StopRequest(Arc<dyn Fn() -> bool + Send + Sync>);

impl StopRequest {
    /// A request that is made whenever `is_made` returns true. It is called often and should be quick.
    pub fn new(is_made: impl Fn() -> bool + Send + Sync + 'static) -> Self {
        Self(Arc::new(is_made))
    }

    /// Whether the step should end.
    pub fn is_made(&self) -> bool {
        (self.0)()
    }
}

impl From<Arc<AtomicBool>> for StopRequest {
    /// A request that is made while the flag is set.
    fn from(flag: Arc<AtomicBool>) -> Self {
        Self::new(move || flag.load(Ordering::Relaxed))
    }
}

impl Debug for StopRequest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("StopRequest")
    }
}

/// The work done in a step so far. A unit is the cost of one contact in one iteration of a solver, some tens of
/// nanoseconds.
#[derive(Debug, Default)]
pub(crate) struct Work<'a> {
    stop: Option<&'a StopRequest>,
    /// Units done.
    done: Cell<u64>,
    /// Units at which the stop request is read next.
    next_look: Cell<u64>,
    /// Units after which the work ends in any case.
    limit: Cell<u64>,
    is_stopped: Cell<bool>,
}

impl<'a> Work<'a> {
    /// Work that a request may stop.
    pub fn new(stop: Option<&'a StopRequest>) -> Self {
        Self { stop, limit: Cell::new(u64::MAX), ..Self::default() }
    }

    /// Work without a limit.
    pub fn unlimited() -> Self {
        Self::new(None)
    }

    /// Units done so far.
    pub fn done(&self) -> u64 {
        self.done.get()
    }

    /// Limits the work from here on to a number of units.
    pub fn allow(&self, units: u64) {
        let limit = self.done.get().saturating_add(units);
        self.limit.set(limit);
        // Not later, since the end of the work may decide its result.
        self.next_look.set(self.next_look.get().min(limit));
    }

    /// Counts units of work. Returns whether to continue; if not, solvers end as soon as they can, with any result.
    #[inline]
    pub fn spend(&self, units: u64) -> bool {
        let done = self.done.get() + units;
        self.done.set(done);
        done < self.next_look.get() || self.look(done)
    }

    #[inline(never)]
    fn look(&self, done: u64) -> bool {
        let is_stopped = self.is_stopped.get() || self.stop.is_some_and(StopRequest::is_made);
        self.is_stopped.set(is_stopped);
        let is_over = is_stopped || done >= self.limit.get();
        if !is_over {
            self.next_look.set((done + UNITS_PER_LOOK).min(self.limit.get()));
        }
        !is_over
    }

    /// Whether a request has stopped the work.
    pub fn is_stopped(&self) -> bool {
        self.is_stopped.get()
    }
}
