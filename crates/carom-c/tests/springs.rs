//! Springs by calls: the same bits as in a scene, read as they were added, and refused if invalid.

#![allow(
    clippy::multiple_unsafe_ops_per_block,
    reason = "what makes one call of a block sound makes all of them sound"
)]

use std::ffi::{CStr, CString};
use std::ptr::{null, null_mut};

use carom_c::*;

const BALLS: &str = "name = \"springs\"\nspheres = [{ radius = 0.1 }, { position = [1, 0, 0], radius = 0.1 }, \
                     { position = [2.5, 0, 0], radius = 0.1 }]\n";
const SPRINGS: &str = "springs = [{ spheres = [0, 1], rest_length = 0.5, stiffness = 10, damping = 0.25 }, \
                       { sphere = 2, anchor = [4, 0, 0], rest_length = 1.25, stiffness = 20, only_pulls = true }]";

/// Returns the springs that `SPRINGS` describes.
fn springs() -> [CaromSpring; 2] {
    let pair = CaromSpring {
        to_point: 0,
        other: 1,
        rest_length: 0.5,
        stiffness: 10.0,
        damping: 0.25,
        ..carom_spring()
    };
    let thread = CaromSpring {
        sphere: 2,
        point: [4.0, 0.0, 0.0],
        rest_length: 1.25,
        stiffness: 20.0,
        only_pulls: 1,
        ..carom_spring()
    };
    [pair, thread]
}

#[track_caller]
fn ok(status: CaromStatus) {
    assert_eq!(status, CaromStatus::Ok, "{}", message());
}

fn message() -> String {
    // SAFETY: the message is a text that ends in a zero.
    unsafe { CStr::from_ptr(carom_last_error()) }.to_str().unwrap().to_owned()
}

fn of_text(text: &str) -> CaromWorld {
    let (text, mut world) = (CString::new(text).unwrap(), CaromWorld::default());
    // SAFETY: a text, no overrides, and a place for a world.
    ok(unsafe { carom_world_from_toml(text.as_ptr(), null(), 0, &raw mut world) });
    world
}

fn hash(world: CaromWorld) -> u64 {
    let mut hash = 0;
    // SAFETY: a place for a hash.
    ok(unsafe { carom_world_state_hash(world, &raw mut hash) });
    hash
}

fn ids(world: CaromWorld) -> Vec<u64> {
    let (mut ids, mut count) = (vec![0; 9], 0);
    let list = CaromList::Springs as i32;
    // SAFETY: room for nine ids, and a place for their number.
    ok(unsafe { carom_world_ids(world, list, ids.as_mut_ptr(), 0, 9, &raw mut count) });
    ids.truncate(count);
    ids
}

fn read(world: CaromWorld, id: u64) -> CaromSpring {
    let mut spring = carom_spring();
    // SAFETY: a place for a spring.
    ok(unsafe { carom_world_spring(world, id, &raw mut spring) });
    spring
}

/// Makes a world with the balls, and adds both springs by calls.
fn joined() -> CaromWorld {
    let world = of_text(BALLS);
    for (number, spring) in (0..).zip(springs()) {
        let mut id = 9;
        // SAFETY: a spring, and a place for an id.
        ok(unsafe { carom_world_add_spring(world, &raw const spring, &raw mut id) });
        assert_eq!(id, number);
    }
    world
}

#[test]
fn springs_that_are_added_make_the_bits_of_a_scene_with_them() {
    let (scene, calls, free) = (of_text(&format!("{BALLS}{SPRINGS}")), joined(), of_text(BALLS));
    for _ in 0..50 {
        for world in [scene, calls, free] {
            ok(carom_world_step(world, 1.0 / 60.0));
        }
        assert_eq!(hash(scene), hash(calls));
    }
    assert_ne!(hash(scene), hash(free));
    for world in [scene, calls, free] {
        ok(carom_world_free(world));
    }
}

#[test]
fn springs_are_read_as_they_were_added_by_call_or_text() {
    for world in [joined(), of_text(&format!("{BALLS}{SPRINGS}"))] {
        assert_eq!(ids(world), [0, 1]);
        assert_eq!([0, 1].map(|id| read(world, id)), springs());
        ok(carom_world_free(world));
    }
}

#[test]
fn a_spring_goes_when_it_or_a_sphere_of_it_is_removed() {
    let (world, spring) = (joined(), springs()[1]);
    ok(carom_world_remove_spring(world, 1));
    // SAFETY: a spring.
    ok(unsafe { carom_world_add_spring(world, &raw const spring, null_mut()) });
    assert_eq!(ids(world), [0, 2]);
    // SAFETY: an id.
    ok(unsafe { carom_world_remove_spheres(world, &raw const spring.sphere, 1) });
    assert_eq!(ids(world), [0]);
    for stale in [1, 2] {
        assert_eq!(carom_world_remove_spring(world, stale), CaromStatus::Unknown);
        assert_eq!(message(), format!("there is no spring {stale} in this world"));
    }
    ok(carom_world_free(world));
}

#[test]
fn a_spring_that_is_changed_pulls_otherwise() {
    let (world, mut totals) = (joined(), CaromTotals::default());
    let stiff = CaromSpring { stiffness: 30.0, ..springs()[0] };
    // SAFETY: a spring, and a place for totals.
    unsafe {
        ok(carom_world_set_spring(world, 0, &raw const stiff));
        ok(carom_world_remove_spring(world, 1).max(carom_world_totals(world, &raw mut totals)));
    }
    // k x² / 2, stretched by 0.5 m.
    assert_eq!((read(world, 0), totals.potential_energy), (stiff, 0.5 * 30.0 * 0.25));
    ok(carom_world_free(world));
}

#[test]
fn springs_that_make_no_sense_are_refused_and_change_nothing() {
    let world = joined();
    let [pair, thread] = springs();
    let wrong = [
        (CaromSpring { stiffness: f64::NAN, ..pair }, CaromStatus::Invalid),
        (CaromSpring { stiffness: -1.0, ..pair }, CaromStatus::Invalid),
        (CaromSpring { rest_length: f64::INFINITY, ..pair }, CaromStatus::Invalid),
        (CaromSpring { rest_length: -0.5, ..thread }, CaromStatus::Invalid),
        (CaromSpring { damping: -0.5, ..pair }, CaromStatus::Invalid),
        (CaromSpring { point: [0.0, f64::NAN, 0.0], ..thread }, CaromStatus::Invalid),
        (CaromSpring { to_point: 2, ..pair }, CaromStatus::Invalid),
        (CaromSpring { only_pulls: u32::MAX, ..pair }, CaromStatus::Invalid),
        (CaromSpring { other: 0, ..pair }, CaromStatus::Invalid),
        (CaromSpring { other: 3, ..pair }, CaromStatus::Unknown),
        (CaromSpring { sphere: u64::MAX, ..thread }, CaromStatus::Unknown),
    ];
    let mut id = 77;
    for (spring, status) in wrong {
        // SAFETY: a spring, and a place for an id.
        let added = unsafe { carom_world_add_spring(world, &raw const spring, &raw mut id) };
        assert_eq!((added, id), (status, 77), "{spring:?}: {}", message());
        assert!(!message().is_empty() && !message().contains('\n'));
        // SAFETY: a spring.
        let set = unsafe { carom_world_set_spring(world, 0, &raw const spring) };
        assert_eq!(set, status, "{spring:?}: {}", message());
    }
    assert_eq!([0, 1].map(|id| read(world, id)), springs());
    // SAFETY: null and unknown ids are refused.
    unsafe {
        assert_eq!(carom_world_add_spring(world, null(), null_mut()), CaromStatus::Null);
        assert_eq!(carom_world_set_spring(world, 0, null()), CaromStatus::Null);
        assert_eq!(carom_world_spring(world, 0, null_mut()), CaromStatus::Null);
        assert_eq!(carom_world_set_spring(world, 7, &raw const pair), CaromStatus::Unknown);
        let (none, mut place) = (CaromWorld::default(), pair);
        assert_eq!(carom_world_spring(none, 0, &raw mut place), CaromStatus::Null);
    }
    ok(carom_world_free(world));
}

#[test]
fn a_snapshot_has_the_springs() {
    let (world, mut snapshot) = (joined(), CaromSnapshot::default());
    // SAFETY: a place for a snapshot.
    ok(unsafe { carom_world_snapshot(world, &raw mut snapshot) });
    ok(carom_world_remove_spring(world, 0));
    ok(carom_world_restore(world, snapshot));
    assert_eq!(ids(world), [0, 1]);
    ok(carom_snapshot_free(snapshot));
    ok(carom_world_free(world));
}
