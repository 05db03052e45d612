//! Handles: numbers with which a program refers to its objects.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, PoisonError, RwLock};

use crate::status::{CaromStatus, Failure};

/// The next handle of any type: no handle is used twice, and that of a snapshot is no handle of a
/// world.
static NEXT: AtomicU64 = AtomicU64::new(1);

/// Objects of one type that programs hold, by handle.
pub(crate) struct Registry<T> {
    /// Name of the type in messages.
    kind: &'static str,
    held: RwLock<BTreeMap<u64, Arc<T>>>,
}

impl<T> Registry<T> {
    pub const fn new(kind: &'static str) -> Self {
        Self { kind, held: RwLock::new(BTreeMap::new()) }
    }

    /// Stores an object. Returns its handle.
    pub fn add(&self, it: T) -> u64 {
        let handle = NEXT.fetch_add(1, Ordering::Relaxed);
        let mut held = self.held.write().unwrap_or_else(PoisonError::into_inner);
        held.insert(handle, Arc::new(it));
        handle
    }

    pub fn get(&self, handle: u64) -> Result<Arc<T>, Failure> {
        let held = self.held.read().unwrap_or_else(PoisonError::into_inner);
        held.get(&handle).cloned().ok_or_else(|| self.nothing(handle))
    }

    /// Removes and returns an object. The caller drops it after all locks, because that may run
    /// code of the program.
    pub fn take(&self, handle: u64) -> Result<Arc<T>, Failure> {
        let mut held = self.held.write().unwrap_or_else(PoisonError::into_inner);
        held.remove(&handle).ok_or_else(|| self.nothing(handle))
    }

    fn nothing(&self, handle: u64) -> Failure {
        let kind = self.kind;
        match handle {
            0 => Failure::new(CaromStatus::Null, format!("the handle of the {kind} is zero")),
            given if given < NEXT.load(Ordering::Relaxed) => Failure::new(
                CaromStatus::Handle,
                format!("handle {given} is of no {kind}, or of one that was freed"),
            ),
            other => Failure::new(
                CaromStatus::Handle,
                format!("handle {other} was never given to anything"),
            ),
        }
    }
}
