//! Emitters: when, where and how spheres come into the world, and which leave for them.

mod common;

use carom::{DQuat, DVec3, Emitter, Sphere, World};
use common::{assert_close_vec, discrete, vec, world};

fn emitter(period: f64, max_spheres: Option<u32>) -> Emitter {
    let emitter = Emitter::new(Sphere::new(DVec3::ZERO, 0.5), period);
    emitter.with_position(vec(1.0, 2.0, 3.0)).with_max_spheres(max_spheres)
}

/// Steps the world and tells in which frames something was emitted.
fn frames_of_emission(world: &mut World, frames: usize, h: f64) -> Vec<usize> {
    (0..frames).filter(|_| !world.step(h).unwrap().emitted.is_empty()).collect()
}

#[test]
fn spheres_come_in_the_first_frame_that_starts_at_or_after_they_are_due() {
    let mut world = world(discrete());
    world.add_emitter(emitter(0.7, None)).unwrap();
    // 0.7 s are 35 frames of 0.02 s, whatever the rounding of the sum of 35 times 0.02.
    assert_eq!(frames_of_emission(&mut world, 200, 0.02), [0, 35, 70, 105, 140, 175]);
}

#[test]
fn emission_keeps_its_rhythm_for_hours() {
    let mut world = world(discrete());
    world.add_emitter(emitter(0.7, Some(1))).unwrap();
    let frames = frames_of_emission(&mut world, 500_000, 0.02);
    assert!(frames.iter().enumerate().all(|(i, &frame)| frame == 35 * i));
}

#[test]
fn all_spheres_due_in_a_long_frame_come_at_once() {
    let mut world = world(discrete());
    world.add_emitter(emitter(0.25, None)).unwrap();
    assert_eq!(world.step(1.0).unwrap().emitted.len(), 1);
    assert_eq!(world.step(1.0).unwrap().emitted.len(), 4);
}

#[test]
fn an_emitter_added_later_starts_then() {
    let mut world = world(discrete());
    frames_of_emission(&mut world, 10, 0.5);
    world.add_emitter(emitter(1.0, None)).unwrap();
    assert_eq!(frames_of_emission(&mut world, 5, 0.5), [0, 2, 4]);
}

#[test]
fn offset_and_velocity_turn_with_the_emitter() {
    let mut world = world(discrete());
    let sphere = Sphere::new(vec(0.0, 1.0, 0.0), 0.5).with_velocity(vec(2.0, 0.0, 0.0));
    // A quarter turn about z, given with length 2.
    let rotation = DQuat::from_xyzw(0.0, 0.0, 2f64.sqrt(), 2f64.sqrt());
    world.add_emitter(emitter(1.0, None).with_sphere(sphere).with_rotation(rotation)).unwrap();
    let id = world.step(0.5).unwrap().emitted[0];
    let emitted = world.sphere(id).unwrap();
    assert_close_vec(emitted.velocity, vec(0.0, 2.0, 0.0), 1e-15);
    assert_close_vec(emitted.position, vec(0.0, 3.0, 3.0), 1e-15);
}

#[test]
fn the_oldest_makes_place_when_max_spheres_are_alive() {
    let mut world = world(discrete());
    let bystander = world.add_sphere(Sphere::new(vec(50.0, 0.0, 0.0), 0.5)).unwrap();
    world.add_emitter(emitter(1.0, Some(3))).unwrap();
    let mut all = Vec::new();
    for frame in 0..6 {
        let report = world.step(1.0).unwrap();
        all.extend(report.emitted.clone());
        let expected = if frame < 3 { vec![] } else { vec![all[frame - 3]] };
        assert_eq!(report.retired, expected);
    }
    assert_eq!(world.spheres().ids(), [&[bystander], &all[3..]].concat());
}

#[test]
fn when_more_are_due_at_once_than_may_live_the_last_ones_live() {
    let mut world = world(discrete());
    world.add_emitter(emitter(0.001, Some(3))).unwrap();
    world.step(1.0).unwrap();
    let report = world.step(1.0).unwrap();
    assert_eq!((report.emitted.len(), report.retired.len()), (1000, 998));
    let numbers: Vec<u64> = world.spheres().ids().iter().map(|id| id.number()).collect();
    assert_eq!(numbers, [998, 999, 1000]);
}

#[test]
fn a_sphere_removed_by_hand_makes_place_too() {
    let mut world = world(discrete());
    world.add_emitter(emitter(1.0, Some(2))).unwrap();
    world.step(1.0).unwrap();
    let second = world.step(1.0).unwrap().emitted[0];
    world.remove_sphere(second).unwrap();
    assert!(world.step(1.0).unwrap().retired.is_empty());
    assert_eq!(world.spheres().len(), 2);
}

#[test]
fn a_runaway_emitter_is_an_error_that_names_the_period() {
    let mut world = world(discrete());
    // Shorter than the tolerance of when a sphere is due, it would emit without end at once.
    assert!(world.add_emitter(emitter(1e-10, None)).unwrap_err().to_string().contains("`period`"));
    world.add_emitter(emitter(1e-8, None)).unwrap();
    world.step(0.02).unwrap();
    let before = world.state_hash();
    let error = world.step(0.02).unwrap_err().to_string();
    assert!(error.contains("emitter 0") && error.contains("`period`"), "{error}");
    assert_eq!(world.state_hash(), before);
}
