//! Written values are read back, through every quantity and every structure; a snapshot of a world
//! after every kind of change describes its contents.

use std::ffi::{CStr, c_void};
use std::ptr::{null, null_mut};

use carom::{Collider, World};
use carom_c::*;
use carom_scene::Checkpoint;

#[track_caller]
fn ok(status: CaromStatus) {
    // SAFETY: the message is a text that ends in a zero.
    let message = unsafe { std::ffi::CStr::from_ptr(carom_last_error()) };
    assert_eq!(status, CaromStatus::Ok, "{message:?}");
}

fn empty() -> CaromWorld {
    let mut world = CaromWorld::default();
    // SAFETY: a place for a world.
    ok(unsafe { carom_world_new(&raw mut world) });
    world
}

/// Returns five spheres that differ in every property.
fn spheres() -> [CaromSphere; 5] {
    [0.0, 1.0, 2.0, 3.0, 4.0].map(|i| CaromSphere {
        position: [3.0 * i, 0.25 * i, -i],
        velocity: [i, -i, 0.5],
        radius: 0.5 + 0.125 * i,
        mass: 1.0 + i,
        density: 0.0,
        restitution: 0.5 + 0.125 * i,
        friction: if i == 1.0 { 0.5 } else { f64::NAN },
        rolling_friction: if i == 2.0 { 0.25 } else { f64::NAN },
        spinning_friction: if i == 3.0 { 0.125 } else { f64::NAN },
        tangential_restitution: if i == 4.0 { 0.75 } else { f64::NAN },
        orientation: if i == 2.0 { [0.0, 1.0, 0.0, 0.0] } else { [0.0, 0.0, 0.0, 1.0] },
        angular_velocity: [0.0, i, 2.0 * i],
        inertia_factor: if i == 1.0 { 0.5 } else { 0.375 },
    })
}

/// Returns the numbers of a quantity of a sphere.
fn numbers(sphere: &CaromSphere, quantity: i32) -> Vec<f64> {
    match quantity {
        0 => sphere.position.to_vec(),
        1 => sphere.velocity.to_vec(),
        2 => vec![sphere.radius],
        3 => vec![sphere.mass],
        4 => vec![sphere.restitution],
        5 => sphere.orientation.to_vec(),
        6 => sphere.angular_velocity.to_vec(),
        7 => vec![sphere.inertia_factor],
        8 => vec![sphere.friction],
        9 => vec![sphere.rolling_friction],
        10 => vec![sphere.spinning_friction],
        _ => vec![sphere.tangential_restitution],
    }
}

/// Returns the bits of numbers, by which NaN equals itself.
fn bits(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|number| number.to_bits()).collect()
}

#[test]
fn spheres_are_read_as_they_were_added() {
    let (world, all) = (empty(), spheres());
    let mut ids = [9; 5];
    // SAFETY: five spheres, and places for five ids.
    ok(unsafe { carom_world_add_spheres(world, all.as_ptr(), 0, 5, ids.as_mut_ptr()) });
    assert_eq!(ids, [0, 1, 2, 3, 4]);
    for (id, sphere) in ids.into_iter().zip(&all) {
        let mut read = carom_sphere();
        // SAFETY: a place for a sphere.
        ok(unsafe { carom_world_sphere(world, id, &raw mut read) });
        for quantity in 0..12 {
            assert_eq!(bits(&numbers(&read, quantity)), bits(&numbers(sphere, quantity)));
        }
    }
    ok(carom_world_free(world));
}

#[test]
fn every_quantity_is_read_as_it_was_written_and_gaps_are_left_alone() {
    const GAP: f64 = -77.0;
    let (world, all) = (empty(), spheres());
    for sphere in [carom_sphere(); 5] {
        // SAFETY: a sphere.
        ok(unsafe { carom_world_add_sphere(world, &raw const sphere, null_mut()) });
    }
    for quantity in 0..12 {
        let rows: Vec<f64> =
            all.iter().flat_map(|it| [numbers(it, quantity), vec![GAP]].concat()).collect();
        let (width, mut read) = (rows.len() / 5, vec![GAP; rows.len()]);
        // SAFETY: five rows of this layout.
        ok(unsafe { carom_world_write(world, quantity, rows.as_ptr(), 8 * width, 5) });
        // SAFETY: room for five rows of this layout.
        ok(unsafe { carom_world_read(world, quantity, read.as_mut_ptr(), 8 * width, 5) });
        assert_eq!(bits(&read), bits(&rows), "quantity {quantity}");
        // All numbers above fit into 32 bits.
        let mut narrow = vec![GAP as f32; rows.len()];
        // SAFETY: room for five rows of this layout.
        ok(unsafe { carom_world_read_f32(world, quantity, narrow.as_mut_ptr(), 4 * width, 5) });
        // SAFETY: five rows of this layout.
        ok(unsafe { carom_world_write_f32(world, quantity, narrow.as_ptr(), 4 * width, 5) });
        let narrow: Vec<f64> = narrow.into_iter().map(f64::from).collect();
        assert_eq!(bits(&narrow), bits(&rows), "quantity {quantity}");
    }
    // The last write of each quantity is in the spheres.
    for (id, sphere) in (0..).zip(&all) {
        let mut read = carom_sphere();
        // SAFETY: a place for a sphere.
        ok(unsafe { carom_world_sphere(world, id, &raw mut read) });
        for quantity in 0..12 {
            assert_eq!(bits(&numbers(&read, quantity)), bits(&numbers(sphere, quantity)));
        }
    }
    ok(carom_world_free(world));
}

unsafe extern "C" fn nothing(
    _sphere: *const CaromSphereState,
    _time: f64,
    _force: *mut f64,
    _user_data: *mut c_void,
) {
}

/// Returns colliders of every shape with unusual values.
fn colliders() -> [CaromCollider; 5] {
    let usual = CaromCollider {
        size: [1.0, 2.0, 3.0],
        radius: 0.75,
        position: [0.0, -9.0, 1.0],
        rotation: [0.0, 0.6, 0.0, 0.8],
        velocity: [0.0, 0.5, 0.0],
        restitution: 0.5,
        rolling_friction: 0.25,
        ..carom_collider()
    };
    let open_sides = CaromSide::Top as u32 | CaromSide::Left as u32;
    [
        CaromCollider { shape: CaromShape::Sphere as i32, size: [1.0; 3], ..usual },
        CaromCollider { shape: CaromShape::Box as i32, radius: 1.0, trigger: 1, ..usual },
        CaromCollider { shape: CaromShape::Container as i32, radius: 1.0, open_sides, ..usual },
        CaromCollider {
            shape: CaromShape::Rectangle as i32,
            radius: 1.0,
            size: [1.0, 1.0, 3.0],
            ..usual
        },
        CaromCollider { radius: 1.0, size: [1.0; 3], ..usual },
    ]
}

/// Returns a collider without the fields that are not a number.
fn comparable(collider: CaromCollider) -> CaromCollider {
    assert!(collider.friction.is_nan() && collider.spinning_friction.is_nan());
    let (friction, spinning_friction, tangential_restitution) = (0.0, 0.0, 0.0);
    CaromCollider { friction, spinning_friction, tangential_restitution, ..collider }
}

/// Returns the state hash after a step of a world from `text` with `more` added.
fn hash_after_a_step(text: &std::ffi::CStr, more: &std::ffi::CStr) -> u64 {
    let (mut world, mut hash) = (CaromWorld::default(), 0);
    // SAFETY: a text, and a place for a world.
    ok(unsafe { carom_world_from_toml(text.as_ptr(), null(), 0, &raw mut world) });
    // SAFETY: a text.
    ok(unsafe { carom_world_add_toml(world, more.as_ptr(), null_mut()) });
    ok(carom_world_step(world, 0.125));
    // SAFETY: a place for a hash.
    ok(unsafe { carom_world_state_hash(world, &raw mut hash) });
    ok(carom_world_free(world));
    hash
}

#[test]
fn springs_of_an_added_text_join_its_own_spheres() {
    let first = c"name = \"s\"\nspheres = [{ position = [9, 0, 0], radius = 0.5 }]";
    let pair = c"spheres = [{ radius = 0.5 }, { position = [2, 0, 0], radius = 0.5 }]\nsprings = \
                 [{ spheres = [0, 1], rest_length = 3, stiffness = 8 }, { sphere = 1, anchor = [2, 1, 0], stiffness = 4 }]";
    let apart = c"spheres = [{ radius = 0.5 }, { position = [2, 0, 0], radius = 0.5 }]";
    let all = c"name = \"s\"\nspheres = [{ position = [9, 0, 0], radius = 0.5 }, { radius = 0.5 }, { position = [2, 0, 0], \
                radius = 0.5 }]\nsprings = [{ spheres = [1, 2], rest_length = 3, stiffness = 8 }, { sphere = 2, \
                anchor = [2, 1, 0], stiffness = 4 }]";
    assert_eq!(hash_after_a_step(first, pair), hash_after_a_step(all, c""));
    assert_ne!(hash_after_a_step(first, pair), hash_after_a_step(first, apart));
}

#[test]
fn a_snapshot_of_an_edited_world_describes_what_is_in_it() {
    let world = empty();
    let toml = c"colliders = [{ name = \"lost\", shape = { sphere = { radius = 1 } } }, { name = \"kept\", \
                 color = \"tomato\", shape = \"half-space\" }]\nforces = [{ viscous-drag = { coefficient = 2 } }]\n\
                 emitters = [{ name = \"a\", period = 1, sphere = { radius = 1 } }, { name = \"b\", period = 2, \
                 position = [0, 99, 0], sphere = { radius = 0.5 } }]\nspheres = [{ position = [50, 0, 0], radius = 1 }]";
    // SAFETY: a text.
    ok(unsafe { carom_world_add_toml(world, toml.as_ptr(), null_mut()) });
    let function = CaromForce {
        force: Some(nothing),
        potential_energy: None,
        user_data: null_mut(),
        destroy: None,
    };
    let (mut id, gravity) = (0, [0.0, -9.81, 0.0]);
    // SAFETY: a force, and a place for an id.
    ok(unsafe { carom_world_add_force(world, &raw const function, &raw mut id) });
    // SAFETY: three numbers.
    ok(unsafe { carom_world_add_gravity(world, gravity.as_ptr(), null_mut()) });
    ok(carom_world_remove_force(world, id));
    ok(carom_world_remove_emitter(world, 0));
    ok(carom_world_remove_collider(world, 0));
    for collider in colliders() {
        // SAFETY: a collider, and a place for an id.
        ok(unsafe { carom_world_add_collider(world, &raw const collider, &raw mut id) });
        let mut read = carom_collider();
        // SAFETY: a place for a collider.
        ok(unsafe { carom_world_collider(world, id, &raw mut read) });
        assert_eq!(comparable(read), comparable(collider));
    }
    let changed = CaromCollider { restitution: 0.125, ..colliders()[2] };
    // SAFETY: a collider.
    ok(unsafe { carom_world_set_collider(world, 1, &raw const changed) });
    let mut snapshot = CaromSnapshot::default();
    // SAFETY: a place for a snapshot.
    ok(unsafe { carom_world_snapshot(world, &raw mut snapshot) });
    let checkpoint = read(snapshot);
    let mut native = World::default();
    native.restore(&checkpoint.snapshot);
    // The world of the description has the colliders, forces and emitters of the world.
    let described = checkpoint.scene.world().unwrap();
    let all =
        |world: &World| world.colliders().map(|(_, it)| it.clone()).collect::<Vec<Collider>>();
    assert_eq!(all(&described), all(&native));
    let all = |world: &World| {
        let forces: Vec<String> = world.forces().map(|(_, it)| format!("{it:?}")).collect();
        let emitters = world.emitters().map(|(_, it)| *it).collect::<Vec<_>>();
        (forces, emitters)
    };
    assert_eq!(all(&described), all(&native));
    assert_eq!(checkpoint.scene.colliders[0].name, "kept");
    assert!(checkpoint.scene.colliders[0].color.is_some());
    assert_eq!(checkpoint.scene.emitters[0].name, "b");
    ok(carom_snapshot_free(snapshot));
    ok(carom_world_free(world));
}

/// Returns a snapshot by way of its bytes.
fn read(snapshot: CaromSnapshot) -> Checkpoint {
    let mut size = 0;
    // SAFETY: a place for a size.
    ok(unsafe { carom_snapshot_to_bytes(snapshot, null_mut(), 0, &raw mut size) });
    let mut bytes = vec![0; size];
    // SAFETY: room for all bytes.
    ok(unsafe { carom_snapshot_to_bytes(snapshot, bytes.as_mut_ptr(), size, &raw mut size) });
    Checkpoint::from_bytes(&bytes).unwrap()
}

#[test]
fn a_collider_moves_through_its_keyframes_and_a_snapshot_describes_them() {
    let world = empty();
    let (mut id, mut lift) = (0, carom_collider());
    (lift.shape, lift.position) = (CaromShape::Box as i32, [0.0, 2.0, 0.0]);
    // SAFETY: both are there.
    ok(unsafe { carom_world_add_collider(world, &raw const lift, &raw mut id) });
    let (level, half_turn) = ([0.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 0.0]);
    let keyframes = [(0.0, [0.0; 3], level), (2.0, [0.0, 1.0, 0.0], level)]
        .map(|(time, position, rotation)| CaromKeyframe { time, position, rotation });
    let set = |keyframes: &[CaromKeyframe], repeats| {
        let pivot = [0.0; 3];
        // SAFETY: the keyframes and three numbers are there.
        unsafe {
            let (first, count) = (keyframes.as_ptr(), keyframes.len());
            carom_world_set_keyframes(world, id, first, count, pivot.as_ptr(), repeats)
        }
    };
    ok(set(&keyframes, 0));
    let height = |world| {
        let mut lift = carom_collider();
        // SAFETY: a place for a collider.
        ok(unsafe { carom_world_collider(world, id, &raw mut lift) });
        lift.position[1]
    };
    let heights = [0, 1, 2].map(|_| {
        ok(carom_world_step(world, 1.0));
        height(world)
    });
    // Half of the way at half of the time, as the curve is symmetric; then it rests.
    assert_eq!(heights, [2.5, 3.0, 3.0]);
    let mut snapshot = CaromSnapshot::default();
    // SAFETY: a place for a snapshot.
    ok(unsafe { carom_world_snapshot(world, &raw mut snapshot) });
    let checkpoint = read(snapshot);
    assert_eq!(checkpoint.scene.colliders[0].motion.len(), 1);
    // The last pose of a motion that repeats is the first.
    assert_eq!(set(&keyframes, 1), CaromStatus::Invalid);
    let turned = CaromKeyframe { rotation: half_turn, ..keyframes[1] };
    assert_eq!(set(&[keyframes[0], turned], 2), CaromStatus::Invalid);
    assert_eq!(height(world), 3.0);
    ok(set(&[], 0));
    assert_eq!(height(world), 2.0);
    ok(carom_world_free(world));
}

/// Returns the box in a world, one metre above the origin, that a test moves.
fn lift(world: CaromWorld) -> u64 {
    let (mut id, mut lift) = (0, carom_collider());
    (lift.shape, lift.position) = (CaromShape::Box as i32, [0.0, 1.0, 0.0]);
    // SAFETY: both are there.
    ok(unsafe { carom_world_add_collider(world, &raw const lift, &raw mut id) });
    id
}

/// Returns a collider in its present pose.
fn now(world: CaromWorld, id: u64) -> CaromCollider {
    let mut collider = carom_collider();
    // SAFETY: a place for a collider.
    ok(unsafe { carom_world_collider(world, id, &raw mut collider) });
    collider
}

#[test]
fn every_motion_of_scene_files_moves_a_collider() {
    let world = empty();
    let id = lift(world);
    // SAFETY: the text ends in a zero.
    let set = |text: &CStr| unsafe { carom_world_set_motion(world, id, text.as_ptr()) };
    // A quarter of a period after the middle.
    ok(set(c"{ oscillate = { amplitude = 0.5, frequency = 0.25 } }"));
    ok(carom_world_step(world, 1.0));
    assert!((now(world, id).position[1] - 1.5).abs() < 1e-15);
    ok(set(c"[{ turn = { rate = 0.5 } }, { steady = { velocity = [3.0, 0.0, 0.0] } }]"));
    let moved = now(world, id);
    assert_eq!(moved.position[0], 3.0);
    // A rotation by half a radian: y of its quaternion is sin(1/4).
    assert!((moved.rotation[1] - 0.247_403_959_254_522_94).abs() < 1e-15);
    assert_eq!(set(c"{ turn = { rate = \"fast\" } }"), CaromStatus::Scene);
    assert_eq!(now(world, id).position[0], 3.0);
    ok(set(c"[]"));
    assert_eq!(now(world, id).position, [0.0, 1.0, 0.0]);
    ok(carom_world_free(world));
}

#[test]
fn a_collider_is_in_its_next_pose_after_the_time_to_it() {
    let world = empty();
    let id = lift(world);
    let (position, level) = ([0.25, 2.0, 0.0], [0.0, 0.0, 0.0, 1.0]);
    // SAFETY: three and four numbers are there.
    ok(unsafe { carom_world_set_next_pose(world, id, position.as_ptr(), level.as_ptr(), 0.25) });
    assert_eq!(now(world, id).velocity, [1.0, 4.0, 0.0]);
    ok(carom_world_step(world, 0.25));
    assert_eq!(now(world, id).position, position);
    ok(carom_world_free(world));
}

#[test]
fn no_rows_are_no_pointer() {
    let world = empty();
    // SAFETY: nothing is read.
    ok(unsafe { carom_world_write(world, 0, null(), 0, 0) });
    // SAFETY: nothing is written.
    ok(unsafe { carom_world_read(world, 0, null_mut(), 0, 0) });
    // SAFETY: nothing is read.
    ok(unsafe { carom_world_add_spheres(world, null(), 0, 0, null_mut()) });
    // SAFETY: nothing is read.
    ok(unsafe { carom_world_remove_spheres(world, null(), 0) });
    ok(carom_world_free(world));
}
