//! Snapshots of worlds, in this process or as bytes.

use std::sync::{PoisonError, RwLock};

use carom::Snapshot;
use carom_scene::Checkpoint;

use crate::described::Described;
use crate::handle::Registry;
use crate::pointer::{Out, Room, Rows, Strided};
use crate::status::{CaromStatus, Failure, call};
use crate::world::CaromWorld;

/// A handle of a snapshot, the state of a world at one time. It is never reused; zero is no
/// snapshot.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct CaromSnapshot {
    /// The handle.
    pub id: u64,
}

/// All snapshots of this process.
static SNAPSHOTS: Registry<RwLock<Held>> = Registry::new("snapshot");

/// Everything that the future of a world depends on, and its description.
struct Held {
    snapshot: Snapshot,
    described: Described,
}

impl CaromSnapshot {
    /// Stores a snapshot. Returns its handle.
    fn hold(held: Held) -> Self {
        Self { id: SNAPSHOTS.add(RwLock::new(held)) }
    }

    /// Runs `work` on the snapshot.
    fn with<T>(self, work: impl FnOnce(&Held) -> Result<T, Failure>) -> Result<T, Failure> {
        let held = SNAPSHOTS.get(self.id)?;
        let held = held.read().unwrap_or_else(PoisonError::into_inner);
        work(&held)
    }
}

/// Takes a snapshot of everything that the future of a world depends on.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_snapshot(
    world: CaromWorld,
    snapshot: *mut CaromSnapshot,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let mut place = unsafe { Out::new(snapshot, "snapshot") }?;
        let held = world.with(|inner| {
            // Bytes contain the colours of emitted spheres, too.
            let time = inner.world.time();
            inner.described.palette_mut().follow(time);
            let (snapshot, described) = (inner.world.snapshot(), inner.described.clone());
            Ok(Held { snapshot, described })
        })?;
        place.set(CaromSnapshot::hold(held));
        Ok(())
    })
}

/// Takes a snapshot into the memory of an earlier one, which is overwritten and keeps its handle: for a
/// game that goes back, and takes one in each frame.
#[unsafe(no_mangle)]
pub extern "C" fn carom_world_snapshot_into(
    world: CaromWorld,
    snapshot: CaromSnapshot,
) -> CaromStatus {
    call(|| {
        let held = SNAPSHOTS.get(snapshot.id)?;
        world.with(|inner| {
            let mut held = held.write().unwrap_or_else(PoisonError::into_inner);
            let time = inner.world.time();
            inner.described.palette_mut().follow(time);
            inner.world.snapshot_into(&mut held.snapshot);
            held.described.clone_from(&inner.described);
            Ok(())
        })
    })
}

/// Restores a snapshot of this or another world, bit for bit. The report of the last step is
/// removed.
#[unsafe(no_mangle)]
pub extern "C" fn carom_world_restore(world: CaromWorld, snapshot: CaromSnapshot) -> CaromStatus {
    call(|| {
        world.with(|inner| {
            snapshot.with(|held| {
                inner.world.restore(&held.snapshot);
                inner.described = held.described.clone();
                Ok(())
            })
        })
    })
}

/// Frees a snapshot.
#[unsafe(no_mangle)]
pub extern "C" fn carom_snapshot_free(snapshot: CaromSnapshot) -> CaromStatus {
    call(|| SNAPSHOTS.take(snapshot.id).map(drop))
}

/// Reads the time of a snapshot [s].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_snapshot_time(
    snapshot: CaromSnapshot,
    time: *mut f64,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let mut time = unsafe { Out::new(time, "time") }?;
        time.set(snapshot.with(|held| Ok(held.snapshot.time()))?);
        Ok(())
    })
}

/// Writes a snapshot as bytes, which are the same on every platform, and their number to `size`. If
/// `bytes` is null, only the number is written. The same version of Carom can read them, in Python
/// and Rust, too. A snapshot with a force that is a function cannot be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_snapshot_to_bytes(
    snapshot: CaromSnapshot,
    bytes: *mut u8,
    capacity: usize,
    size: *mut usize,
) -> CaromStatus {
    call(|| {
        let array = Strided { stride: 0, count: capacity };
        // SAFETY: the caller's array and pointer are null or valid, as the header demands.
        let room = unsafe { Room::new(bytes, array, size, "bytes") }?;
        let written = snapshot.with(|Held { snapshot, described }| {
            Ok(Checkpoint::bytes_of(snapshot, described.scene(), described.palette())?)
        })?;
        room.fill(written.into_iter())
    })
}

/// Makes a snapshot from bytes of carom_snapshot_to_bytes(). A checksum detects damage, but not
/// malicious bytes: read only bytes that you trust.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_snapshot_from_bytes(
    bytes: *const u8,
    size: usize,
    snapshot: *mut CaromSnapshot,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let mut place = unsafe { Out::new(snapshot, "snapshot") }?;
        let array = Strided { stride: 0, count: size };
        // SAFETY: the caller's array is null or has this layout, as the header demands.
        let bytes: Vec<u8> = unsafe { Rows::new(bytes, array, 1, "bytes") }?.values().collect();
        let Checkpoint { snapshot, scene, palette } = Checkpoint::from_bytes(&bytes)?;
        let described = Described::new(scene, palette);
        place.set(CaromSnapshot::hold(Held { snapshot, described }));
        Ok(())
    })
}
