//! Steps and time of a world.

use crate::pointer::{Out, tell};
use crate::status::{CaromStatus, call};
use crate::world::CaromWorld;

/// Advances a world by `dt` [s], > 0. If the step is refused, the state before it is kept.
#[unsafe(no_mangle)]
pub extern "C" fn carom_world_step(world: CaromWorld, dt: f64) -> CaromStatus {
    call(|| world.with(|inner| Ok(inner.world.step(dt).map(drop)?)))
}

/// Advances a world by `frames` frames of its frame time (carom_world_frame_time()). If a frame is
/// refused, those before it are kept. Writes the number of frames taken to `taken`, which may be
/// null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_advance(
    world: CaromWorld,
    frames: u64,
    taken: *mut u64,
) -> CaromStatus {
    call(|| {
        let mut done = 0;
        let ended = world.with(|inner| {
            let dt = inner.described.scene().simulation.frame_time;
            while done < frames {
                inner.world.step(dt)?;
                done += 1;
            }
            Ok(())
        });
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        unsafe { tell(taken, done) };
        ended
    })
}

/// Advances a world to its next impact and resolves it with all others at that time, at most by
/// `within` [s]. Only under the rule `exact`.
#[unsafe(no_mangle)]
pub extern "C" fn carom_world_step_to_next_event(world: CaromWorld, within: f64) -> CaromStatus {
    call(|| world.with(|inner| Ok(inner.world.step_to_next_event(within).map(drop)?)))
}

/// Reads the time of the next impact [s]; infinity if none comes within `within` [s]. Only under
/// the rule `exact`; the world does not change.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_next_event_time(
    world: CaromWorld,
    within: f64,
    time: *mut f64,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let mut time = unsafe { Out::new(time, "time") }?;
        let next = world.with(|inner| Ok(inner.world.next_event_time(within)?))?;
        time.set(next.unwrap_or(f64::INFINITY));
        Ok(())
    })
}

/// Reads the time since the start [s]: the sum of all steps.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_time(world: CaromWorld, time: *mut f64) -> CaromStatus {
    // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
    world.measure(unsafe { Out::new(time, "time") }, |inner| inner.world.time())
}

/// Sets the time [s], for forces that depend on it. Refused for a world with emitters.
#[unsafe(no_mangle)]
pub extern "C" fn carom_world_set_time(world: CaromWorld, time: f64) -> CaromStatus {
    call(|| world.with(|inner| Ok(inner.world.set_time(time)?)))
}

/// Reads the frame time [s] of the scene; the default is 1/60 s.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_frame_time(
    world: CaromWorld,
    frame_time: *mut f64,
) -> CaromStatus {
    // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
    let place = unsafe { Out::new(frame_time, "frame_time") };
    world.measure(place, |inner| inner.described.scene().simulation.frame_time)
}

/// Reads the longest frame [s] in which motion on springs is certainly stable; infinity without
/// springs, and under the rule `exact`. The other rules refuse longer frames.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_longest_stable_frame(
    world: CaromWorld,
    longest: *mut f64,
) -> CaromStatus {
    // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
    let place = unsafe { Out::new(longest, "longest") };
    world.measure(place, |inner| inner.world.longest_stable_frame())
}

/// Reads the state hash of a world, equal for equal states on every platform and in every language.
/// `carom run` prints it in hexadecimal digits.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_state_hash(world: CaromWorld, hash: *mut u64) -> CaromStatus {
    // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
    world.measure(unsafe { Out::new(hash, "hash") }, |inner| inner.world.state_hash().0)
}
