//! Forces that are functions equal those of the engine under every rule; a force that is not a
//! number is an error.

use std::ffi::{CString, c_void};
use std::ptr::{null, null_mut};

use carom::{DVec3, Force, SphereState};
use carom_c::*;
use carom_scene::Library;

const RULES: [&str; 4] = ["exact", "contact", "bisect", "discrete"];

/// A spring to the origin, of 3 N/m.
#[derive(Debug)]
struct Spring;

impl Force for Spring {
    fn on(&self, sphere: &SphereState, _time: f64) -> DVec3 {
        -3.0 * sphere.position
    }
}

unsafe extern "C" fn spring(
    sphere: *const CaromSphereState,
    _time: f64,
    force: *mut f64,
    _user_data: *mut c_void,
) {
    // SAFETY: the state of a sphere.
    let position = unsafe { (*sphere).position };
    let pull = -3.0 * DVec3::from_array(position);
    // SAFETY: a place for three numbers.
    unsafe { force.cast::<[f64; 3]>().write(pull.to_array()) }
}

/// Writes the number that `user_data` points to.
unsafe extern "C" fn constant(
    _sphere: *const CaromSphereState,
    _time: f64,
    force: *mut f64,
    user_data: *mut c_void,
) {
    // SAFETY: a number.
    let number = unsafe { *user_data.cast::<f64>() };
    // SAFETY: a place for three numbers.
    unsafe { force.cast::<[f64; 3]>().write([number; 3]) }
}

fn world(rule: &str) -> CaromWorld {
    let rule = CString::new(format!("simulation.rule={rule}")).unwrap();
    let (overrides, mut world) = ([rule.as_ptr()], CaromWorld::default());
    // SAFETY: texts, and a place for a world.
    let made = unsafe {
        carom_world_from_scene(c"tutorial1".as_ptr(), overrides.as_ptr(), 1, &raw mut world)
    };
    assert_eq!(made, CaromStatus::Ok);
    world
}

fn hash(world: CaromWorld) -> u64 {
    let mut hash = 0;
    // SAFETY: a place for a hash.
    unsafe { carom_world_state_hash(world, &raw mut hash) };
    hash
}

fn add(world: CaromWorld, force: CaromForceFunction, user_data: *mut c_void) {
    let force = CaromForce { force, potential_energy: None, user_data, destroy: None };
    // SAFETY: a force.
    let added = unsafe { carom_world_add_force(world, &raw const force, null_mut()) };
    assert_eq!(added, CaromStatus::Ok);
}

#[test]
fn a_function_moves_spheres_as_the_same_force_in_rust_does() {
    for rule in RULES {
        let world = world(rule);
        add(world, Some(spring), null_mut());
        let override_ = format!("simulation.rule={rule}").parse().unwrap();
        let (scene, _) = Library::new().find("tutorial1", &[override_]).unwrap();
        let mut native = scene.world().unwrap();
        native.add_force(Spring).unwrap();
        for _ in 0..30 {
            native.step(0.01).unwrap();
            assert_eq!(carom_world_step(world, 0.01), CaromStatus::Ok);
            assert_eq!(hash(world), native.state_hash().0, "{rule}");
        }
        assert_eq!(carom_world_free(world), CaromStatus::Ok);
    }
}

#[test]
fn a_function_that_writes_no_number_has_the_step_refused() {
    for rule in RULES {
        for mut number in [f64::NAN, f64::INFINITY] {
            let world = world(rule);
            add(world, Some(constant), (&raw mut number).cast());
            let before = hash(world);
            let status = carom_world_step(world, 1.0);
            assert_eq!(status, CaromStatus::Step, "{rule}, {number}");
            assert_eq!(hash(world), before, "{rule}, {number}");
            assert_eq!(carom_world_free(world), CaromStatus::Ok);
        }
    }
}

#[test]
fn applied_forces_are_taken_away_by_no_rows() {
    let world = world("exact");
    let mut count = 0;
    // SAFETY: a place for a count.
    unsafe { carom_world_count(world, &raw mut count) };
    let (quantity, forces) = (CaromQuantity::AppliedForces as i32, vec![1.0; 3 * count]);
    // SAFETY: as many rows as stated.
    let written = unsafe { carom_world_write(world, quantity, forces.as_ptr(), 0, count) };
    assert_eq!(written, CaromStatus::Ok);
    // SAFETY: no rows.
    let written = unsafe { carom_world_write(world, quantity, null(), 0, 0) };
    assert_eq!(written, CaromStatus::Ok);
    let mut read = vec![7.0; 3 * count];
    // SAFETY: as many rows as stated.
    unsafe { carom_world_read(world, quantity, read.as_mut_ptr(), 0, count) };
    assert_eq!(read, vec![0.0; 3 * count]);
    assert_eq!(carom_world_free(world), CaromStatus::Ok);
}
