//! Emitters: when, where and how spheres come into the world, and which leave for them.

mod common;

use std::f64::consts::TAU;

use carom::{
    Bisect, Boundary, Contact, DQuat, DVec3, Emitter, Exact, PointAttractor, Rule, Settings,
    Sphere, SphereId, World,
};
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
fn spheres_are_emitted_in_the_same_frames_however_short_frames_are() {
    let rules: [Rule; 3] = [discrete(), Bisect::default().into(), Contact::default().into()];
    for rule in rules {
        for scale in [1.0, 1.0 / 16_384.0, 1.0 / 1_099_511_627_776.0, 1_048_576.0] {
            let mut world = World::new(Settings::default().with_rule(rule)).unwrap();
            // The third one is due some microseconds after the 47th frame has begun.
            let emitter = emitter(0.1835965290786 * scale, None).with_needs_room(false);
            let fast = emitter.sphere.with_velocity(vec(1e3 / scale, 0.0, 0.0));
            world.add_emitter(emitter.with_sphere(fast)).unwrap();
            let frames = frames_of_emission(&mut world, 64, 3.0 / 256.0 * scale);
            assert_eq!(frames, [0, 16, 32, 48, 63], "{rule:?}, {scale}");
        }
    }
}

#[test]
fn a_runaway_emitter_is_an_error_that_names_the_period() {
    let mut world = world(discrete());
    assert!(world.add_emitter(emitter(0.0, None)).unwrap_err().to_string().contains("`period`"));
    // So many are due within the rounding of a frame that the first one would not end.
    let runaway = world.add_emitter(emitter(1e-16, None)).unwrap();
    assert!(world.step(0.02).unwrap_err().to_string().contains("`period`"));
    world.set_emitter(runaway, emitter(1e-8, None)).unwrap();
    world.step(0.02).unwrap();
    let before = world.state_hash();
    let error = world.step(0.02).unwrap_err().to_string();
    assert!(error.contains("emitter 0") && error.contains("`period`"), "{error}");
    assert_eq!(world.state_hash(), before);
}

/// A world by the rule `exact`, whose emitter is due every second.
fn exact_world(boundary: Boundary, emitter: Emitter) -> World {
    let mut world = World::new(Settings::default().with_boundary(boundary)).unwrap();
    world.add_emitter(emitter).unwrap();
    world
}

#[test]
fn one_that_needs_room_leaves_spheres_out_until_there_is_some() {
    let mut world = exact_world(Boundary::Open, emitter(1.0, None).with_needs_room(true));
    // Those at 0, 1, 2 and 3 s: the first one stays where it is.
    let report = world.step(3.5).unwrap();
    let numbers = |ids: &[SphereId]| ids.iter().map(|id| id.number()).collect::<Vec<_>>();
    assert_eq!(numbers(&report.emitted), [0]);
    assert_eq!(numbers(&report.left_out), [1, 2, 3]);
    // Moved away, it makes room between two frames; and, moving, within one.
    let [first] = world.spheres().ids()[..] else { panic!("one sphere") };
    let moving = world.sphere(first).unwrap().with_velocity(vec(2.0, 0.0, 0.0));
    world.set_sphere(first, moving).unwrap();
    let report = world.step(2.0).unwrap();
    assert_eq!((numbers(&report.emitted), numbers(&report.left_out)), (vec![4], vec![5]));
    // 0.5 s after 3.5 s it has moved by a metre, the sum of the radii.
    let place = world.sphere(first).unwrap().position;
    assert_close_vec(place, vec(5.0, 2.0, 3.0), 1e-15);
}

#[test]
fn one_that_says_nothing_overlaps_but_under_the_rule_contact() {
    let contact = Rule::Contact(Contact::default());
    // Each goes by half the sum of two radii until the next is due.
    let slow = emitter(1.0, None);
    let slow = slow.with_sphere(slow.sphere.with_velocity(vec(0.5, 0.0, 0.0)));
    for (rule, collide, expected) in [
        (Rule::Exact(Exact::default()), true, 4),
        (discrete(), true, 4),
        (contact, true, 2),
        (contact, false, 4),
    ] {
        let settings = Settings::default().with_rule(rule).with_spheres_collide(collide);
        let mut world = World::new(settings).unwrap();
        world.add_emitter(slow).unwrap();
        assert_eq!(frames_of_emission(&mut world, 4, 1.0).len(), expected, "{rule:?}");
    }
}

#[test]
fn one_with_a_count_ends_and_goes_on_with_a_larger_one() {
    for rule in [discrete(), Rule::Exact(Exact::default()), Rule::Contact(Contact::default())] {
        let settings = Settings::default().with_rule(rule).with_spheres_collide(false);
        let mut world = World::new(settings).unwrap();
        let three = emitter(0.25, None).with_count(3);
        let id = world.add_emitter(three).unwrap();
        assert_eq!(frames_of_emission(&mut world, 40, 0.125), [0, 2, 4], "{rule:?}");
        // At 5 s: two more, as far apart as the others, and not those that were due long ago.
        world.set_emitter(id, three.with_count(5)).unwrap();
        assert_eq!(frames_of_emission(&mut world, 40, 0.125), [0, 2], "{rule:?}");
        assert_eq!(world.spheres().len(), 5);
        // What changes nothing changes no state, and one more within a period comes at its end.
        let hash = world.state_hash();
        world.set_emitter(id, three.with_count(5)).unwrap();
        assert_eq!(world.state_hash(), hash);
        let again = world.add_emitter(three.with_count(1)).unwrap();
        assert_eq!(frames_of_emission(&mut world, 1, 0.125), [0]);
        world.set_emitter(again, three.with_count(2)).unwrap();
        assert_eq!(frames_of_emission(&mut world, 8, 0.125), [1], "{rule:?}");
    }
}

#[test]
fn what_is_left_out_counts_and_what_gave_way_does_too() {
    let mut world =
        exact_world(Boundary::Open, emitter(1.0, None).with_count(3).with_needs_room(true));
    let report = world.step(9.0).unwrap();
    assert_eq!((report.emitted.len(), report.left_out.len()), (1, 2));
    let mut world = exact_world(Boundary::Open, emitter(1.0, Some(1)).with_count(3));
    let report = world.step(9.0).unwrap();
    assert_eq!((report.emitted.len(), report.retired.len()), (3, 2));
}

#[test]
fn a_count_bounds_what_a_short_period_asks_for() {
    let mut world = world(discrete());
    world.add_emitter(emitter(1e-8, None).with_count(7)).unwrap();
    world.step(0.02).unwrap();
    assert_eq!(world.step(0.02).unwrap().emitted.len(), 6);
    let none = world.add_emitter(emitter(1.0, None).with_count(0)).unwrap_err();
    assert_eq!(none.to_string(), "emitter 1: `count` must be at least 1, not 0");
}

#[test]
fn the_oldest_sphere_makes_room_for_the_next() {
    let mut world = exact_world(Boundary::Open, emitter(1.0, Some(1)).with_needs_room(true));
    let report = world.step(3.5).unwrap();
    assert_eq!((report.emitted.len(), report.retired.len(), report.left_out.len()), (4, 3, 0));
}

#[test]
fn images_across_the_faces_of_a_periodic_box_take_room() {
    let periodic = Boundary::Periodic { size: vec(10.0, f64::INFINITY, 10.0) };
    let near_face = emitter(1.0, None).with_needs_room(true).with_position(vec(4.9, 0.0, 0.0));
    for (x, expected) in [(-4.9, 0), (-3.9, 1)] {
        let mut world = exact_world(periodic, near_face);
        world.add_sphere(Sphere::new(vec(x, 0.0, 0.0), 0.5)).unwrap();
        assert_eq!(world.step(0.5).unwrap().emitted.len(), expected, "{x}");
    }
}

#[test]
fn what_is_emitted_into_nothing_flies_under_forces_without_closed_form() {
    // A circular orbit at 2 m: the speed √(10 / 2), the period 2π 2 / √5.
    let (speed, period) = (5f64.sqrt(), TAU * 2.0 / 5f64.sqrt());
    let sphere = Sphere::new(DVec3::ZERO, 0.1).with_velocity(vec(0.0, 0.0, speed));
    let emitter = Emitter::new(sphere, 0.5).with_position(vec(2.0, 0.0, 0.0)).with_count(1);
    let settings = [Exact::default(), Exact::default().with_force_tick(1.0 / 960.0)];
    let miss = settings.map(|exact| {
        let mut world = world(Rule::Exact(exact));
        world.add_force(PointAttractor::new(DVec3::ZERO, 10.0)).unwrap();
        world.add_emitter(emitter).unwrap();
        for _ in 0..100 {
            world.step(period / 100.0).unwrap();
        }
        (world.spheres().positions()[0] - vec(2.0, 0.0, 0.0)).length()
    });
    // Some tens of steps, each to rounding, whatever the force tick.
    assert!(miss[0] < 1e-12 && miss[1] == miss[0], "{miss:?}");
}
