//! Worlds by handle: made, copied, freed.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, TryLockError};

use carom::{StopRequest, World};
use carom_scene::Scene;

use crate::described::Described;
use crate::handle::Registry;
use crate::pointer::Out;
use crate::status::{CaromStatus, Failure, call};

/// A world, by a handle that is never given twice. Zero is no world.
///
/// One thread at a time may use a world: a call while another is at work on it ends in CAROM_STATUS_BUSY. Different
/// worlds are independent.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct CaromWorld {
    /// The handle.
    pub id: u64,
}

/// All worlds of this process.
static WORLDS: Registry<Held> = Registry::new("world");

/// A world, and what stops it.
struct Held {
    stop: Arc<AtomicBool>,
    inner: Mutex<Inner>,
}

/// A world, and what is known of it besides.
pub(crate) struct Inner {
    pub world: World,
    pub described: Described,
}

impl CaromWorld {
    /// Holds a world, and says by which handle.
    pub(crate) fn hold(mut inner: Inner) -> Self {
        let stop = Arc::new(AtomicBool::new(false));
        inner.world.set_stop_request(Some(StopRequest::from(Arc::clone(&stop))));
        Self { id: WORLDS.add(Held { stop, inner: Mutex::new(inner) }) }
    }

    /// Works on the world, unless another call is at it.
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

    /// Writes what is measured of the world to a place.
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

/// Makes an empty world at time 0, stepped by the rule `exact`.
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

/// Makes a copy of a world, which goes on from the same state by itself. Forces that are functions act on
/// both.
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

/// Frees a world. A step that is at work on it in another thread is stopped.
#[unsafe(no_mangle)]
pub extern "C" fn carom_world_free(world: CaromWorld) -> CaromStatus {
    call(|| {
        WORLDS.take(world.id)?.stop.store(true, Ordering::Relaxed);
        Ok(())
    })
}

/// Whether a handle is that of a world: 1, or 0.
#[unsafe(no_mangle)]
pub extern "C" fn carom_world_is_valid(world: CaromWorld) -> i32 {
    i32::from(WORLDS.get(world.id).is_ok())
}

/// Stops the step that is at work on a world, within milliseconds under the rule `exact`, and refuses further ones
/// with CAROM_STATUS_STOPPED: 1. Lets it step again: 0. This can be called from any thread, at any time.
#[unsafe(no_mangle)]
pub extern "C" fn carom_world_set_stop(world: CaromWorld, stop: i32) -> CaromStatus {
    call(|| {
        WORLDS.get(world.id)?.stop.store(stop != 0, Ordering::Relaxed);
        Ok(())
    })
}
