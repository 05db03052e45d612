//! Worlds through the C interface have the bits of the engine's worlds: built-in scenes step by
//! step, and a world that is built by calls.

use std::ffi::CString;
use std::ptr;

use carom::{Collider, DVec3, Gravity, Pose, Settings, Shape, Sphere, World};
use carom_c::*;
use carom_scene::Library;

#[track_caller]
fn ok(status: CaromStatus) {
    // SAFETY: the message is a text that ends in a zero.
    let message = unsafe { std::ffi::CStr::from_ptr(carom_last_error()) };
    assert_eq!(status, CaromStatus::Ok, "{message:?}");
}

fn hash(world: CaromWorld) -> u64 {
    let mut hash = 0;
    // SAFETY: a place for a hash.
    ok(unsafe { carom_world_state_hash(world, &raw mut hash) });
    hash
}

fn from_scene(name: &str) -> CaromWorld {
    let (name, mut world) = (CString::new(name).unwrap(), CaromWorld::default());
    // SAFETY: a text, no overrides, and a place for a world.
    ok(unsafe { carom_world_from_scene(name.as_ptr(), ptr::null(), 0, &raw mut world) });
    world
}

#[test]
fn scenes_have_the_hashes_of_the_engine_in_every_frame() {
    // Scenes of each rule, with emitters, friction, a periodic box.
    let names = ["simtest1", "simtest3", "tutorial3", "cradle", "billiards", "masse", "pour"];
    for name in names {
        let (scene, _) = Library::new().find(name, &[]).unwrap();
        let (mut native, world) = (scene.world().unwrap(), from_scene(name));
        assert_eq!(hash(world), native.state_hash().0, "{name}");
        for frame in 0..20 {
            native.step(scene.simulation.frame_time).unwrap();
            ok(carom_world_step(world, scene.simulation.frame_time));
            assert_eq!(hash(world), native.state_hash().0, "{name}, frame {frame}");
        }
        ok(carom_world_free(world));
    }
}

#[test]
fn a_world_put_together_by_calls_has_the_hash_of_one_put_together_in_rust() {
    let mut native = World::new(Settings::default()).unwrap();
    native.add_force(Gravity::new(DVec3::new(0.0, -9.81, 0.0))).unwrap();
    native.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO))).unwrap();
    let mut world = CaromWorld::default();
    // SAFETY: a place for a world.
    ok(unsafe { carom_world_new(&raw mut world) });
    let gravity = [0.0, -9.81, 0.0];
    // SAFETY: three numbers.
    ok(unsafe { carom_world_add_gravity(world, gravity.as_ptr(), ptr::null_mut()) });
    let floor = carom_collider();
    // SAFETY: a collider.
    ok(unsafe { carom_world_add_collider(world, &raw const floor, ptr::null_mut()) });
    for i in 0..30 {
        let place = DVec3::new(0.1 * f64::from(i % 7), 1.0 + f64::from(i), 0.2 * f64::from(i % 3));
        let sphere = Sphere::new(place, 0.4).with_density(2.0).with_restitution(0.9);
        native.add_sphere(sphere).unwrap();
        let own = CaromSphere {
            position: place.to_array(),
            radius: 0.4,
            density: 2.0,
            restitution: 0.9,
            ..carom_sphere()
        };
        // SAFETY: a sphere.
        ok(unsafe { carom_world_add_sphere(world, &raw const own, ptr::null_mut()) });
    }
    for _ in 0..120 {
        native.step(1.0 / 60.0).unwrap();
        ok(carom_world_step(world, 1.0 / 60.0));
        assert_eq!(hash(world), native.state_hash().0);
    }
    ok(carom_world_free(world));
}

#[test]
fn bytes_of_c_are_snapshots_of_rust() {
    let world = from_scene("simtest3");
    // SAFETY: null is allowed there.
    ok(unsafe { carom_world_advance(world, 30, ptr::null_mut()) });
    let (mut snapshot, mut size) = (CaromSnapshot::default(), 0);
    // SAFETY: a place for a snapshot.
    ok(unsafe { carom_world_snapshot(world, &raw mut snapshot) });
    // SAFETY: a place for a size.
    ok(unsafe { carom_snapshot_to_bytes(snapshot, ptr::null_mut(), 0, &raw mut size) });
    let mut bytes = vec![0; size];
    // SAFETY: room for all bytes.
    ok(unsafe { carom_snapshot_to_bytes(snapshot, bytes.as_mut_ptr(), size, &raw mut size) });
    let checkpoint = carom_scene::Checkpoint::from_bytes(&bytes).unwrap();
    let mut native = World::default();
    native.restore(&checkpoint.snapshot);
    assert_eq!(native.state_hash().0, hash(world));
    assert_eq!(checkpoint.scene.name, "simtest3");
    assert_eq!(checkpoint.scene.colliders.len(), native.colliders().len());
    assert_eq!(checkpoint.scene.emitters.len(), native.emitters().len());
    ok(carom_snapshot_free(snapshot));
    ok(carom_world_free(world));
}

#[test]
fn a_snapshot_into_the_memory_of_another_continues_to_the_bit() {
    let [first, second] = ["pour", "cradle"].map(from_scene);
    let mut snapshot = CaromSnapshot::default();
    // SAFETY: a place for a snapshot.
    ok(unsafe { carom_world_snapshot(second, &raw mut snapshot) });
    ok(carom_world_step(first, 0.25));
    ok(carom_world_snapshot_into(first, snapshot));
    let taken = hash(first);
    ok(carom_world_step(first, 0.25));
    ok(carom_world_restore(second, snapshot));
    assert_eq!(hash(second), taken);
    ok(carom_world_step(second, 0.25));
    assert_eq!(hash(second), hash(first));
    ok(carom_snapshot_free(snapshot));
    assert_eq!(carom_world_snapshot_into(first, snapshot), CaromStatus::Handle);
    for world in [first, second] {
        ok(carom_world_free(world));
    }
}

#[test]
fn wells_report_the_events_of_the_engine() {
    let text = c"
        [simulation]
        pair_potential = { square-well = { depth = 1.0, range_ratio = 1.5 } }
        [[spheres]]
        radius = 0.5
        mass = 1.0
        [[spheres]]
        position = [2.0, 0.0, 0.0]
        velocity = [-1.0, 0.0, 0.0]
        radius = 0.5
        mass = 1.0";
    let mut world = CaromWorld::default();
    // SAFETY: a text, no overrides, and a place for a world.
    ok(unsafe { carom_world_from_toml(text.as_ptr(), ptr::null(), 0, &raw mut world) });
    ok(carom_world_step(world, 0.625));
    let (mut event, mut count) = (CaromWellEvent::default(), 0);
    // SAFETY: room for one event, and a place for the number.
    ok(unsafe { carom_world_well_events(world, &raw mut event, 0, 1, &raw mut count) });
    // The centres are 1.5 m apart after half a second.
    assert_eq!((count, event.kind, event.spheres), (1, 0, [0, 1]));
    assert_eq!((event.time, event.distance, event.normal), (0.5, 1.5, [1.0, 0.0, 0.0]));
    assert!(event.impulse < 0.0);
    ok(carom_world_free(world));
}
