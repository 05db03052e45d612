//! Several threads: a world in use refuses other calls, and can be stopped and freed; different
//! worlds are independent.

#![allow(
    clippy::multiple_unsafe_ops_per_block,
    reason = "what makes one call of a block sound makes all of them sound"
)]

use std::ptr::{null, null_mut};
use std::thread;
use std::time::{Duration, Instant};

use carom_c::*;

fn scene(name: &std::ffi::CStr) -> CaromWorld {
    let mut world = CaromWorld::default();
    // SAFETY: a text, and a place for a world.
    let made = unsafe { carom_world_from_scene(name.as_ptr(), null(), 0, &raw mut world) };
    assert_eq!(made, CaromStatus::Ok);
    world
}

/// Waits until a world is being stepped.
fn wait_for_work(world: CaromWorld) {
    // Limits a hang.
    let end = Instant::now() + Duration::from_secs(60);
    let mut time = 0.0;
    // SAFETY: a place for a time.
    while unsafe { carom_world_time(world, &raw mut time) } != CaromStatus::Busy {
        assert!(Instant::now() < end, "the step never begins");
        thread::yield_now();
    }
}

/// Steps a world until a call ends with another status than busy.
fn step_for_days(world: CaromWorld) -> CaromStatus {
    loop {
        match carom_world_step(world, 1e6) {
            CaromStatus::Busy => thread::yield_now(),
            ended => break ended,
        }
    }
}

#[test]
fn a_step_at_work_is_stopped_from_another_thread_and_changes_nothing() {
    let world = scene(c"gas");
    let (mut before, mut after) = (0, 0);
    // SAFETY: a place for a hash.
    unsafe { carom_world_state_hash(world, &raw mut before) };
    // Days of a gas: the step does not end by itself in time.
    let step = thread::spawn(move || step_for_days(world));
    wait_for_work(world);
    assert_eq!(carom_world_set_stop(world, 1), CaromStatus::Ok);
    assert_eq!(step.join().unwrap(), CaromStatus::Stopped);
    // SAFETY: a place for a hash.
    unsafe { carom_world_state_hash(world, &raw mut after) };
    assert_eq!(before, after);
    assert_eq!(carom_world_set_stop(world, 0), CaromStatus::Ok);
    assert_eq!(carom_world_step(world, 0.01), CaromStatus::Ok);
    assert_eq!(carom_world_free(world), CaromStatus::Ok);
}

#[test]
fn a_world_that_is_freed_in_the_middle_of_a_step_stops_it() {
    let world = scene(c"gas");
    let step = thread::spawn(move || step_for_days(world));
    wait_for_work(world);
    assert_eq!(carom_world_free(world), CaromStatus::Ok);
    assert_eq!(carom_world_is_valid(world), 0);
    assert_eq!(step.join().unwrap(), CaromStatus::Stopped);
    assert_eq!(carom_world_step(world, 0.1), CaromStatus::Handle);
}

#[test]
fn worlds_of_several_threads_have_the_hashes_that_they_have_alone() {
    let run = || {
        let (world, mut hash) = (scene(c"simtest3"), 0);
        // SAFETY: a place for a hash.
        unsafe {
            assert_eq!(carom_world_advance(world, 120, null_mut()), CaromStatus::Ok);
            assert_eq!(carom_world_state_hash(world, &raw mut hash), CaromStatus::Ok);
        }
        assert_eq!(carom_world_free(world), CaromStatus::Ok);
        hash
    };
    let alone = run();
    let threads = [(); 4].map(|()| thread::spawn(run));
    for thread in threads {
        assert_eq!(thread.join().unwrap(), alone);
    }
}
