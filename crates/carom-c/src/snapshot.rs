//! Snapshots: states of worlds to return to, in this process or as bytes.

use carom::Snapshot;
use carom_scene::Checkpoint;

use crate::described::Described;
use crate::handle::Registry;
use crate::pointer::{Out, Room, Rows, Strided};
use crate::status::{CaromStatus, call};
use crate::world::CaromWorld;

/// The state of a world at one moment, by a handle that is never given twice. Zero is no snapshot.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct CaromSnapshot {
    /// The handle.
    pub id: u64,
}

/// All snapshots of this process.
static SNAPSHOTS: Registry<Held> = Registry::new("snapshot");

/// All that the future of a world depends on, and what is known of it besides.
struct Held {
    snapshot: Snapshot,
    described: Described,
}

/// Takes a snapshot: everything the future of a world depends on.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_snapshot(
    world: CaromWorld,
    snapshot: *mut CaromSnapshot,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let mut place = unsafe { Out::new(snapshot, "snapshot") }?;
        let held = world.with(|inner| {
            // Bytes have the colours of spheres that were emitted, too.
            let time = inner.world.time();
            inner.described.palette_mut().follow(time);
            let (snapshot, described) = (inner.world.snapshot(), inner.described.clone());
            Ok(Held { snapshot, described })
        })?;
        place.set(CaromSnapshot { id: SNAPSHOTS.add(held) });
        Ok(())
    })
}

/// Returns a world to a snapshot, of itself or of another world, bit for bit. What happened in the last step is
/// forgotten.
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

/// When a snapshot was taken [s].
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

/// Writes a snapshot as bytes, the same ones on every platform, and their number to `size`; null for `bytes` gives the
/// number only. The same version of Carom reads them, in Python and Rust, too. A force that is a function has no bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_snapshot_to_bytes(
    snapshot: CaromSnapshot,
    bytes: *mut u8,
    capacity: usize,
    size: *mut usize,
) -> CaromStatus {
    call(|| {
        let array = Strided { stride: 0, count: capacity };
        // SAFETY: the caller's array and pointer are null or lead there, as the header demands.
        let room = unsafe { Room::new(bytes, array, size, "bytes") }?;
        let held = SNAPSHOTS.get(snapshot.id)?;
        let Held { snapshot, described } = &*held;
        let written = Checkpoint::bytes_of(snapshot, described.scene(), described.palette())?;
        room.fill(written.into_iter())
    })
}

/// Makes the snapshot that carom_snapshot_to_bytes() wrote. A checksum notices damage, but not what was made to mislead: read
/// only bytes that you trust.
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
        // SAFETY: the caller's array is null or lies so, as the header demands.
        let bytes: Vec<u8> = unsafe { Rows::new(bytes, array, 1, "bytes") }?.values().collect();
        let Checkpoint { snapshot, scene, palette } = Checkpoint::from_bytes(&bytes)?;
        let described = Described::new(scene, palette);
        place.set(CaromSnapshot { id: SNAPSHOTS.add(Held { snapshot, described }) });
        Ok(())
    })
}
