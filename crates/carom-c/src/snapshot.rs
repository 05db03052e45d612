//! Snapshots of worlds, in this process or as bytes.

use carom::Snapshot;
use carom_scene::Checkpoint;

use crate::described::Described;
use crate::handle::Registry;
use crate::pointer::{Out, Room, Rows, Strided};
use crate::status::{CaromStatus, call};
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
static SNAPSHOTS: Registry<Held> = Registry::new("snapshot");

/// Everything that the future of a world depends on, and its description.
struct Held {
    snapshot: Snapshot,
    described: Described,
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
        place.set(CaromSnapshot { id: SNAPSHOTS.add(held) });
        Ok(())
    })
}

/// Restores a snapshot of this or another world, bit for bit. The report of the last step is
/// removed.
#[unsafe(no_mangle)]
pub extern "C" fn carom_world_restore(world: CaromWorld, snapshot: CaromSnapshot) -> CaromStatus {
    call(|| {
        let held = SNAPSHOTS.get(snapshot.id)?;
        world.with(|inner| {
            inner.world.restore(&held.snapshot);
            inner.described = held.described.clone();
            Ok(())
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
        time.set(SNAPSHOTS.get(snapshot.id)?.snapshot.time());
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
        let held = SNAPSHOTS.get(snapshot.id)?;
        let Held { snapshot, described } = &*held;
        let written = Checkpoint::bytes_of(snapshot, described.scene(), described.palette())?;
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
        place.set(CaromSnapshot { id: SNAPSHOTS.add(Held { snapshot, described }) });
        Ok(())
    })
}
