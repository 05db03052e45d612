//! Every misuse is an error: ten thousand wrong calls from a fixed seed each return a status with a
//! message and leave the world unchanged.

#![allow(
    clippy::multiple_unsafe_ops_per_block,
    reason = "what makes one call of a block sound makes all of them sound"
)]

mod texts;

use std::ffi::CStr;
use std::ptr::{null, null_mut};

use carom_c::*;
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg32;
use texts::{no_bytes, no_scene, no_text};

/// Values for wrong calls.
struct Bench {
    random: Pcg32,
    world: CaromWorld,
    /// Handles that are no world: zero, freed, of a snapshot, never used.
    bad: [CaromWorld; 4],
    /// Handles that are no snapshot.
    bad_snapshots: [CaromSnapshot; 4],
}

impl Bench {
    fn new() -> Self {
        let (mut world, mut freed) = (CaromWorld::default(), CaromWorld::default());
        let (mut snapshot, mut freed_snapshot) =
            (CaromSnapshot::default(), CaromSnapshot::default());
        // SAFETY: places for worlds, and a text.
        unsafe {
            ok(carom_world_from_scene(c"simtest3".as_ptr(), null(), 0, &raw mut world));
            ok(carom_world_new(&raw mut freed));
            ok(carom_world_advance(world, 40, null_mut()));
            ok(carom_world_snapshot(world, &raw mut snapshot));
            ok(carom_world_snapshot(world, &raw mut freed_snapshot));
        }
        ok(carom_world_free(freed));
        ok(carom_snapshot_free(freed_snapshot));
        let never = u64::MAX / 3;
        let bad = [0, freed.id, snapshot.id, never].map(|id| CaromWorld { id });
        let bad_snapshots = [0, freed_snapshot.id, world.id, never].map(|id| CaromSnapshot { id });
        Self { random: Pcg32::seed_from_u64(17), world, bad, bad_snapshots }
    }

    fn below(&mut self, count: u32) -> u32 {
        self.random.next_u32() % count
    }

    fn pick<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len() as u32) as usize]
    }

    /// Returns a number that is allowed nowhere.
    fn no_number(&mut self) -> f64 {
        self.pick(&[f64::NAN, f64::INFINITY, f64::NEG_INFINITY])
    }

    /// Returns an unknown id.
    fn no_id(&mut self) -> u64 {
        let far = u64::from(self.random.next_u32()) << 20;
        self.pick(&[u64::MAX, 1 << 40, far + 1_000_000])
    }

    fn count(&self) -> usize {
        let mut count = 0;
        // SAFETY: a place for a count.
        ok(unsafe { carom_world_count(self.world, &raw mut count) });
        count
    }
}

#[track_caller]
fn ok(status: CaromStatus) {
    assert_eq!(status, CaromStatus::Ok, "{}", message());
}

fn message() -> String {
    // SAFETY: the message is a text that ends in a zero.
    unsafe { CStr::from_ptr(carom_last_error()) }.to_str().unwrap().to_owned()
}

fn hash(world: CaromWorld) -> u64 {
    let mut hash = 0;
    // SAFETY: a place for a hash.
    ok(unsafe { carom_world_state_hash(world, &raw mut hash) });
    hash
}

/// A wrong call with the statuses that it may return.
type Misuse = fn(&mut Bench) -> (CaromStatus, &'static [CaromStatus]);

const HANDLE: &[CaromStatus] = &[CaromStatus::Null, CaromStatus::Handle];
const NULL: &[CaromStatus] = &[CaromStatus::Null];
const LENGTH: &[CaromStatus] = &[CaromStatus::Length];
const ARGUMENT: &[CaromStatus] = &[CaromStatus::Argument];
const INVALID: &[CaromStatus] = &[CaromStatus::Invalid];
const UNKNOWN: &[CaromStatus] = &[CaromStatus::Unknown];
const SCENE: &[CaromStatus] = &[CaromStatus::Scene];

const MISUSES: &[Misuse] = &[
    bad_handle,
    bad_handle,
    bad_snapshot,
    null_result,
    null_argument,
    wrong_count,
    wrong_stride,
    no_room,
    no_constant,
    no_number_in_a_step,
    no_number_in_a_sphere,
    no_number_in_a_collider,
    no_number_in_an_array,
    no_number_in_a_force,
    no_such_id,
    no_text,
    no_scene,
    no_bytes,
];

#[test]
fn ten_thousand_wrong_calls_are_errors_and_change_nothing() {
    let mut bench = Bench::new();
    let before = hash(bench.world);
    let mut seen = [0; 15];
    for call in 0..10_000 {
        let misuse = call % MISUSES.len();
        let (status, allowed) = MISUSES[misuse](&mut bench);
        assert!(allowed.contains(&status), "misuse {misuse}: {status:?}, {}", message());
        assert!(!message().is_empty());
        seen[status as usize] += 1;
        if call % 100 == 0 {
            assert_eq!(hash(bench.world), before, "misuse {misuse}");
        }
    }
    assert_eq!(hash(bench.world), before);
    assert_eq!(seen[CaromStatus::Ok as usize] + seen[CaromStatus::Panic as usize], 0);
    // The world still works.
    ok(carom_world_step(bench.world, 0.01));
    ok(carom_world_free(bench.world));
}

/// Passes a handle that is no world to any function.
fn bad_handle(bench: &mut Bench) -> (CaromStatus, &'static [CaromStatus]) {
    let world = bench.pick(&bench.bad.clone());
    let (mut number, mut count, mut id) = (0.0, 0_usize, 0_u64);
    let (sphere, collider) = (carom_sphere(), carom_collider());
    let (ray, mut hit, mut path) = (CaromRay::default(), CaromHit::default(), CaromPath::default());
    let function = bench.below(20);
    // SAFETY: all places are there.
    let status = unsafe {
        match function {
            0 => carom_world_free(world),
            1 => carom_world_step(world, 0.1),
            2 => carom_world_advance(world, 1, &raw mut id),
            3 => carom_world_time(world, &raw mut number),
            4 => carom_world_count(world, &raw mut count),
            5 => carom_world_read(world, 0, &raw mut number, 0, 0),
            6 => carom_world_write(world, 2, &raw const number, 0, 1),
            7 => carom_world_add_sphere(world, &raw const sphere, &raw mut id),
            8 => carom_world_add_collider(world, &raw const collider, &raw mut id),
            9 => carom_world_state_hash(world, &raw mut id),
            10 => carom_world_set_stop(world, 1),
            11 => carom_world_add_drag(world, 1.0, &raw mut id),
            12 => carom_world_ids(world, 0, null_mut(), 0, 0, &raw mut count),
            13 => carom_world_add_toml(world, c"".as_ptr(), null_mut()),
            14 => carom_world_remove_spheres(world, &raw const id, 1),
            15 => carom_world_cast_rays(world, &raw const ray, 1, null(), &raw mut hit),
            16 => carom_world_predict(world, 0, 1.0, 1, &raw mut path),
            17 => carom_world_sensor_events(world, null_mut(), 0, 0, &raw mut count),
            18 => carom_path_free(CaromPath { id: world.id }),
            _ => carom_world_impacts(world, null_mut(), 0, 0, &raw mut count),
        }
    };
    (status, HANDLE)
}

/// Passes a handle that is no snapshot.
fn bad_snapshot(bench: &mut Bench) -> (CaromStatus, &'static [CaromStatus]) {
    let snapshot = bench.pick(&bench.bad_snapshots.clone());
    let (mut time, mut size) = (0.0, 0);
    let function = bench.below(4);
    // SAFETY: all places are there.
    let status = unsafe {
        match function {
            0 => carom_world_restore(bench.world, snapshot),
            1 => carom_snapshot_free(snapshot),
            2 => carom_snapshot_time(snapshot, &raw mut time),
            _ => carom_snapshot_to_bytes(snapshot, null_mut(), 0, &raw mut size),
        }
    };
    (status, HANDLE)
}

/// Passes null for a result.
fn null_result(bench: &mut Bench) -> (CaromStatus, &'static [CaromStatus]) {
    let (world, function) = (bench.world, bench.below(18));
    let (ray, point) = (CaromRay::default(), [0.0; 3]);
    // SAFETY: null is refused.
    let status = unsafe {
        match function {
            0 => carom_world_new(null_mut()),
            1 => carom_world_copy(world, null_mut()),
            2 => carom_world_time(world, null_mut()),
            3 => carom_world_count(world, null_mut()),
            4 => carom_world_state_hash(world, null_mut()),
            5 => carom_world_totals(world, null_mut()),
            6 => carom_world_report(world, null_mut()),
            7 => carom_world_sphere(world, 0, null_mut()),
            8 => carom_world_collider(world, 0, null_mut()),
            9 => carom_world_ids(world, 0, null_mut(), 0, 0, null_mut()),
            10 => carom_world_snapshot(world, null_mut()),
            11 => carom_world_read(world, 0, null_mut(), 0, bench.count()),
            12 => carom_world_index_of(world, 0, null_mut()),
            13 => carom_world_predict(world, 0, 1.0, 1, null_mut()),
            14 => carom_world_cast_rays(world, &raw const ray, 1, null(), null_mut()),
            15 => carom_world_nearest(world, point.as_ptr(), 1.0, null(), null_mut()),
            16 => carom_world_user_data(world, 0, null_mut()),
            _ => carom_world_next_event_time(world, 1.0, null_mut()),
        }
    };
    (status, NULL)
}

/// Passes null for an argument.
fn null_argument(bench: &mut Bench) -> (CaromStatus, &'static [CaromStatus]) {
    let (world, function, mut made) = (bench.world, bench.below(15), CaromWorld::default());
    let (mut snapshot, mut hit) = (CaromSnapshot::default(), CaromHit::default());
    let (mut near, mut count) = (CaromNearBody::default(), 0);
    let none =
        CaromForce { force: None, potential_energy: None, user_data: null_mut(), destroy: None };
    // SAFETY: null is refused.
    let status = unsafe {
        match function {
            0 => carom_world_add_sphere(world, null(), null_mut()),
            1 => carom_world_add_spheres(world, null(), 0, 3, null_mut()),
            2 => carom_world_set_sphere(world, 0, null()),
            3 => carom_world_add_collider(world, null(), null_mut()),
            4 => carom_world_add_gravity(world, null(), null_mut()),
            5 => carom_world_add_force(world, null(), null_mut()),
            6 => carom_world_add_force(world, &raw const none, null_mut()),
            7 => carom_world_write(world, 1, null(), 0, bench.count()),
            8 => carom_world_from_toml(null(), null(), 0, &raw mut made),
            9 => carom_world_from_scene(c"cradle".as_ptr(), null(), 1, &raw mut made),
            10 => carom_snapshot_from_bytes(null(), 9, &raw mut snapshot),
            11 => carom_world_cast_rays(world, null(), 1, null(), &raw mut hit),
            12 => carom_world_nearest(world, null(), 1.0, null(), &raw mut near),
            13 => carom_world_overlapping(world, null(), null(), null_mut(), 0, &raw mut count),
            _ => carom_world_add_toml(world, null(), null_mut()),
        }
    };
    (status, NULL)
}

/// Passes a number of rows that is not that of the spheres.
fn wrong_count(bench: &mut Bench) -> (CaromStatus, &'static [CaromStatus]) {
    let (world, count) = (bench.world, bench.count());
    let mut rows = vec![0.0; 4 * (count + 40)];
    let wrong = match bench.below(3) {
        0 => count + 1 + bench.below(30) as usize,
        1 => count - 1,
        // No array is that long.
        _ => usize::MAX - bench.below(9) as usize,
    };
    // Writing no rows would remove the applied forces.
    let (quantity, is_read) = (bench.below(12) as i32, bench.below(2) == 0);
    // SAFETY: the rows are longer than the stated count, or the count is refused.
    let status = unsafe {
        if is_read {
            carom_world_read(world, quantity, rows.as_mut_ptr(), 0, wrong)
        } else {
            carom_world_write(world, quantity, rows.as_ptr(), 0, wrong)
        }
    };
    (status, LENGTH)
}

/// Passes a stride with which rows would overlap.
fn wrong_stride(bench: &mut Bench) -> (CaromStatus, &'static [CaromStatus]) {
    let (world, count) = (bench.world, bench.count());
    let mut rows = vec![0.0; 4 * count];
    let stride = 1 + bench.below(7) as usize;
    let (sphere, mut length, quantity) = (carom_sphere(), 0, bench.below(13) as i32);
    let function = bench.below(4);
    // SAFETY: all places are there.
    let status = unsafe {
        match function {
            0 => carom_world_read(world, quantity, rows.as_mut_ptr(), stride, count),
            1 => carom_world_write(world, quantity, rows.as_ptr(), stride, count),
            2 => carom_world_add_spheres(world, &raw const sphere, stride + 160, 1, null_mut()),
            _ => {
                let mut ids = vec![0; count];
                carom_world_ids(world, 0, ids.as_mut_ptr(), stride, count, &raw mut length)
            }
        }
    };
    (status, LENGTH)
}

/// Passes too little memory for a list, or too many spheres.
fn no_room(bench: &mut Bench) -> (CaromStatus, &'static [CaromStatus]) {
    let (world, sphere, function) = (bench.world, carom_sphere(), bench.below(3));
    let (mut id, mut length) = (0, 0);
    let many = 10_000_001 + bench.below(1000) as usize;
    // SAFETY: all places are there, or are refused before they are read.
    let status = unsafe {
        match function {
            0 => carom_world_ids(world, 0, &raw mut id, 0, 1, &raw mut length),
            1 => carom_world_add_spheres(world, &raw const sphere, 0, many, null_mut()),
            _ => carom_world_remove_spheres(world, &raw const id, many),
        }
    };
    (status, LENGTH)
}

/// Passes a number that is no constant of an enumeration.
fn no_constant(bench: &mut Bench) -> (CaromStatus, &'static [CaromStatus]) {
    let (world, mut length, mut number) = (bench.world, 0, 0.0);
    let wrong = bench.pick(&[-1, 13, 99, i32::MIN, i32::MAX]);
    let collider = CaromCollider { shape: wrong, ..carom_collider() };
    let function = bench.below(4);
    // SAFETY: all places are there.
    let status = unsafe {
        match function {
            0 => carom_world_read(world, wrong, &raw mut number, 0, 1),
            1 => carom_world_write(world, wrong, &raw const number, 0, 1),
            2 => carom_world_ids(world, wrong, null_mut(), 0, 0, &raw mut length),
            _ => carom_world_add_collider(world, &raw const collider, null_mut()),
        }
    };
    (status, ARGUMENT)
}

fn no_number_in_a_step(bench: &mut Bench) -> (CaromStatus, &'static [CaromStatus]) {
    let (world, number) = (bench.world, bench.no_number());
    let number = bench.pick(&[number, 0.0, -0.0, -1.0]);
    let (mut time, function) = (0.0, bench.below(3));
    let mut path = CaromPath::default();
    // SAFETY: places for a time and a path.
    let status = unsafe {
        match function {
            0 => carom_world_step(world, number),
            1 => carom_world_predict(world, 0, number, 9, &raw mut path),
            _ => carom_world_next_event_time(world, number, &raw mut time),
        }
    };
    (status, INVALID)
}

fn no_number_in_a_sphere(bench: &mut Bench) -> (CaromStatus, &'static [CaromStatus]) {
    let number = bench.no_number();
    let mut sphere = carom_sphere();
    match bench.below(11) {
        0 => sphere.position[bench.below(3) as usize] = number,
        1 => sphere.velocity[bench.below(3) as usize] = number,
        2 => sphere.radius = bench.pick(&[number, 0.0, -1.0]),
        3 => sphere.mass = bench.pick(&[number, 0.0, -1.0]),
        4 => sphere.density = bench.pick(&[number, -1.0]),
        5 => sphere.restitution = bench.pick(&[number, -0.1, 1.1]),
        6 => sphere.friction = bench.pick(&[f64::INFINITY, -1.0]),
        7 => sphere.orientation = [bench.pick(&[number, 0.0]), 0.0, 0.0, 0.0],
        8 => sphere.angular_velocity[bench.below(3) as usize] = number,
        9 => sphere.inertia_factor = bench.pick(&[number, 0.0]),
        _ => sphere.tangential_restitution = bench.pick(&[f64::INFINITY, 2.0]),
    }
    let (mut ids, spheres) = ([0; 2], [carom_sphere(), sphere]);
    let function = bench.below(3);
    // SAFETY: spheres, and places for ids.
    let status = unsafe {
        match function {
            0 => carom_world_add_sphere(bench.world, &raw const sphere, ids.as_mut_ptr()),
            1 => carom_world_add_spheres(bench.world, spheres.as_ptr(), 0, 2, ids.as_mut_ptr()),
            _ => carom_world_set_sphere(bench.world, first_id(bench.world), &raw const sphere),
        }
    };
    (status, INVALID)
}

fn first_id(world: CaromWorld) -> u64 {
    let (mut ids, mut length) = (vec![0; 1000], 0);
    // SAFETY: as many places as stated.
    ok(unsafe { carom_world_ids(world, 0, ids.as_mut_ptr(), 0, 1000, &raw mut length) });
    ids[0]
}

fn no_number_in_a_collider(bench: &mut Bench) -> (CaromStatus, &'static [CaromStatus]) {
    let number = bench.no_number();
    let mut collider = carom_collider();
    match bench.below(9) {
        0 => collider.position[bench.below(3) as usize] = number,
        1 => collider.velocity[bench.below(3) as usize] = number,
        2 => collider.rotation = [bench.pick(&[number, 0.0]), 0.0, 0.0, 0.0],
        3 => collider.restitution = bench.pick(&[number, 2.0]),
        4 => collider.trigger = 2,
        5 => collider.reserved = 1,
        6 => (collider.shape, collider.radius) = (CaromShape::Sphere as i32, number),
        7 => (collider.shape, collider.size[1]) = (CaromShape::Box as i32, number),
        _ => (collider.shape, collider.open_sides) = (CaromShape::Container as i32, 63),
    }
    // SAFETY: a collider.
    let status = unsafe { carom_world_add_collider(bench.world, &raw const collider, null_mut()) };
    (status, INVALID)
}

fn no_number_in_an_array(bench: &mut Bench) -> (CaromStatus, &'static [CaromStatus]) {
    let (count, quantity) = (bench.count(), bench.below(13) as i32);
    let is_friction = (8..12).contains(&quantity);
    // NaN is valid there: a sphere without its own friction.
    let number = if is_friction { f64::INFINITY } else { bench.no_number() };
    let width = match quantity {
        0 | 1 | 6 | 12 => 3,
        5 => 4,
        _ => 1,
    };
    let mut rows = vec![0.5; width * count];
    rows[bench.below((width * count) as u32) as usize] = number;
    let narrow: Vec<f32> = rows.iter().map(|&number| number as f32).collect();
    let is_narrow = bench.below(2) == 0;
    // SAFETY: as many rows as stated.
    let status = unsafe {
        if is_narrow {
            carom_world_write_f32(bench.world, quantity, narrow.as_ptr(), 0, count)
        } else {
            carom_world_write(bench.world, quantity, rows.as_ptr(), 0, count)
        }
    };
    (status, INVALID)
}

fn no_number_in_a_force(bench: &mut Bench) -> (CaromStatus, &'static [CaromStatus]) {
    let number = bench.no_number();
    let (gravity, is_gravity) = ([0.0, number, 0.0], bench.below(2) == 0);
    // SAFETY: three numbers.
    let status = unsafe {
        if is_gravity {
            carom_world_add_gravity(bench.world, gravity.as_ptr(), null_mut())
        } else {
            carom_world_add_drag(bench.world, number, null_mut())
        }
    };
    (status, INVALID)
}

fn no_such_id(bench: &mut Bench) -> (CaromStatus, &'static [CaromStatus]) {
    let (world, id, function) = (bench.world, bench.no_id(), bench.below(12));
    let (impulse, mut path) = ([0.0; 3], CaromPath::default());
    let (mut sphere, mut collider, mut index) = (carom_sphere(), carom_collider(), 0);
    // SAFETY: all places are there.
    let status = unsafe {
        match function {
            0 => carom_world_sphere(world, id, &raw mut sphere),
            1 => carom_world_set_sphere(world, id, &raw const sphere),
            2 => carom_world_remove_spheres(world, &raw const id, 1),
            3 => carom_world_collider(world, id, &raw mut collider),
            4 => carom_world_set_collider(world, id, &raw const collider),
            5 => carom_world_remove_collider(world, id),
            6 => carom_world_remove_force(world, id),
            7 => carom_world_predict(world, id, 1.0, 9, &raw mut path),
            8 => carom_world_apply_impulse(world, id, impulse.as_ptr()),
            9 => carom_world_set_groups(world, id, 1, 1),
            10 => carom_world_set_keyframes(world, id, null(), 0, impulse.as_ptr(), 0),
            _ => carom_world_index_of(world, id, &raw mut index),
        }
    };
    (status, UNKNOWN)
}
