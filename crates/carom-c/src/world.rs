//! Worlds by handle: make, copy, free.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, TryLockError};

use carom::{StopRequest, World};
use carom_scene::Scene;

use crate::described::Described;
use crate::handle::Registry;
use crate::pointer::Out;
use crate::status::{CaromStatus, Failure, call};

/// A handle of a world. It is never reused; zero is no world.
///
/// Only one thread at a time may use a world: a call during another one returns CAROM_STATUS_BUSY.
/// Different worlds are independent.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct CaromWorld {
    /// The handle.
    pub id: u64,
}

/// All worlds of this process.
static WORLDS: Registry<Held> = Registry::new("world");

/// A world, and the flag that stops it.
struct Held {
    stop: Arc<AtomicBool>,
    inner: Mutex<Inner>,
}

/// A world and its description.
pub(crate) struct Inner {
    pub world: World,
    pub described: Described,
}

impl CaromWorld {
    /// Stores a world. Returns its handle.
    pub(crate) fn hold(mut inner: Inner) -> Self {
        let stop = Arc::new(AtomicBool::new(false));
        inner.world.set_stop_request(Some(StopRequest::from(Arc::clone(&stop))));
        Self { id: WORLDS.add(Held { stop, inner: Mutex::new(inner) }) }
    }

    /// Runs `work` on the world, unless another call is using it.
    pub(crate) fn with<T>(
        self,
        work: impl FnOnce(&mut Inner) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        let held = WORLDS.get(self.id)?;
        let mut inner = held.inner.try_lock().map_err(|error| match error {
            TryLockError::WouldBlock => {
                let problem = format!("world {} is in the middle of another call", self.id);
                Failure::new(CaromStatus::Busy, problem)
            }
            TryLockError::Poisoned(_) => {
                let problem = "the engine of this world has failed before: it can only be freed";
                Failure::new(CaromStatus::Panic, problem)
            }
        })?;
        work(&mut inner)
    }

    /// Writes a measured value of the world to memory of the program.
    pub(crate) fn measure<T: Copy>(
        self,
        out: Result<Out<'_, T>, Failure>,
        measure: impl FnOnce(&Inner) -> T,
    ) -> CaromStatus {
        call(|| {
            out?.set(self.with(|inner| Ok(measure(inner)))?);
            Ok(())
        })
    }
}

/// Makes an empty world at time 0 under the rule `exact`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_new(world: *mut CaromWorld) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let mut world = unsafe { Out::new(world, "world") }?;
        let (made, described) = Described::of(Scene::new("world"))?;
        world.set(CaromWorld::hold(Inner { world: made, described }));
        Ok(())
    })
}

/// Makes an independent copy of a world in the same state. Forces that are functions act on both.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_copy(world: CaromWorld, copy: *mut CaromWorld) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let mut copy = unsafe { Out::new(copy, "copy") }?;
        let inner = world.with(|inner| {
            Ok(Inner { world: inner.world.clone(), described: inner.described.clone() })
        })?;
        copy.set(CaromWorld::hold(inner));
        Ok(())
    })
}

/// Frees a world, and stops a step of another thread on it.
#[unsafe(no_mangle)]
pub extern "C" fn carom_world_free(world: CaromWorld) -> CaromStatus {
    call(|| {
        WORLDS.take(world.id)?.stop.store(true, Ordering::Relaxed);
        Ok(())
    })
}

/// Returns 1 if a handle is that of a world, else 0.
#[unsafe(no_mangle)]
pub extern "C" fn carom_world_is_valid(world: CaromWorld) -> i32 {
    i32::from(WORLDS.get(world.id).is_ok())
}

/// With `stop` 1, stops the step in progress on a world, within milliseconds under the rule
/// `exact`, and refuses further ones with CAROM_STATUS_STOPPED. With 0, allows steps again. Any
/// thread can call this at any time.
#[unsafe(no_mangle)]
pub extern "C" fn carom_world_set_stop(world: CaromWorld, stop: i32) -> CaromStatus {
    call(|| {
        WORLDS.get(world.id)?.stop.store(stop != 0, Ordering::Relaxed);
        Ok(())
    })
}
