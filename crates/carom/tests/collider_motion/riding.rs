//! Balls that ride a collider that moves.

use std::f64::consts::{PI, TAU};

use carom::{Collider, DVec3, MotionPart, Pose, Shape, Sides, Sphere};

use crate::common::{G, assert_close, vec};
use crate::{SIZES, contact, exact, first_root, heavy_world, impacts, oscillate, plate};

#[test]
fn ball_rides_a_plate_and_lifts_off_where_it_accelerates_down_with_g() {
    for size in SIZES {
        for frame in [1.0 / 60.0, 1.0 / 240.0, 0.07] {
            let (frequency, gamma) = (5.0, 1.3);
            let omega = TAU * frequency;
            let amplitude = gamma * G / (omega * omega);
            let mut world = heavy_world(exact(), size);
            // Begins at the lowest place, at rest.
            let motion = oscillate(DVec3::Y, amplitude * size, frequency, -0.5 * PI);
            world.add_collider(plate([motion]).with_restitution(0.0)).unwrap();
            let start = vec(0.0, 0.1 - amplitude, 0.0) * size;
            world.add_sphere(Sphere::new(start, 0.1 * size)).unwrap();
            let height = |t: f64| -amplitude * (omega * t).cos();
            // Down with g: A ω² cos = -g.
            let lift_off = (-1.0 / gamma).acos() / omega;
            let speed = amplitude * omega * (omega * lift_off).sin();
            let flight = |t: f64| {
                let h = t - lift_off;
                height(lift_off) + speed * h - 0.5 * G * h * h
            };
            let landing = first_root(|t| flight(t) - height(t) + 1e-12, lift_off + 0.02, 1e-5);
            let mut landed = f64::NAN;
            while world.time() < 0.3 {
                let before = world.time();
                let report = world.step(frame).unwrap();
                if let Some(impact) = report.impacts.first() {
                    landed = before + impact.time;
                }
                let t = world.time();
                let expected = match t {
                    t if t < lift_off || t > landing => height(t),
                    t => flight(t),
                };
                let found = world.spheres().positions()[0].y / size - 0.1;
                // Pieces of path are right to 1e-7 of the radius.
                assert!((found - expected).abs() < 1e-8, "{t} s: {found} {expected}");
                if landed > 0.0 {
                    break;
                }
            }
            assert_close(landed, landing, 1e-6);
        }
    }
}

#[test]
fn vibrated_ball_comes_to_rest_between_bounces_without_end() {
    // Short bounces of little restitution: a few hundred impacts in a period would be a hang.
    let mut world = heavy_world(exact(), 1.0);
    world
        .add_collider(plate([oscillate(DVec3::Y, 1e-4, 50.0, 0.0)]).with_restitution(0.3))
        .unwrap();
    world.add_sphere(Sphere::new(vec(0.0, 0.0105, 0.0), 0.01)).unwrap();
    let found = impacts(&mut world, 1.0 / 60.0, 1.0);
    let height = world.spheres().positions()[0].y - 0.01;
    assert!(height < 3e-3 && height > -1e-4 - 1e-9, "{height}");
    assert!(found.len() < 2000, "{}", found.len());
}

/// Six balls in a closed box with one corner that gravity and the turning press them into.
fn events_in_half_a_second(move_box: impl FnOnce(Collider) -> Collider) -> u64 {
    let mut world = heavy_world(exact(), 1.0);
    let shape = Shape::Container { size: DVec3::splat(0.214), open: Sides::NONE };
    let hollow = Collider::new(shape, Pose::at(DVec3::ZERO)).with_restitution(0.3);
    let id = world.add_collider(move_box(hollow)).unwrap();
    let pose = world.collider(id).unwrap().pose;
    for number in 0..6 {
        let [column, row] = [number % 3, number / 3].map(f64::from);
        let local = vec(0.06 * (column - 1.0), 0.05 * row, 0.01 * f64::from(number));
        world.add_sphere(Sphere::new(pose.position + pose.rotation * local, 0.015)).unwrap();
    }
    (0..5).map(|_| world.step(0.1).unwrap().work.events).sum()
}

#[test]
fn balls_ride_a_box_that_turns_fast_in_few_pieces_of_path() {
    let axis = vec(0.0, 4.0, 25.0);
    let steady = events_in_half_a_second(|hollow| hollow.moving(DVec3::ZERO, axis));
    // Twelve radians in pieces of 0.005, for each of six balls.
    assert!(steady < 15_000, "{steady}");
    let turn = MotionPart::Turn { axis, pivot: DVec3::ZERO, rate: axis.length() };
    let same = events_in_half_a_second(|hollow| hollow.with_motion([turn]));
    assert!(same < 15_000, "{same}");
    // The acceleration at the end of an arm of 0.4 m changes by up to 6000 m/s³: pieces of 2e-4 s are right to 1e-7 of
    // the radius.
    let pivot = vec(0.1, -0.4, 0.1);
    let motion = MotionPart::Swing { axis, pivot, amplitude: 1.19, frequency: 3.4, phase: 0.48 };
    let swung = events_in_half_a_second(|hollow| hollow.with_motion([motion]));
    assert!(swung < 17_000, "{swung}");
}

#[test]
fn balls_stay_in_a_box_that_swings_under_all_rules_that_promise_it() {
    for rule in [exact(), contact()] {
        for friction in [0.0, 0.5] {
            let mut world = heavy_world(rule, 1.0);
            let shape = Shape::Container { size: vec(0.2, 0.2, 0.2), open: Sides::NONE };
            let motion = [
                MotionPart::Turn { axis: vec(0.2, 1.0, 0.1), pivot: vec(0.1, 0.0, 0.0), rate: 9.0 },
                oscillate(vec(1.0, 2.0, 0.0), 0.1, 8.0, 0.0),
            ];
            let hollow = Collider::new(shape, Pose::at(DVec3::ZERO)).with_motion(motion);
            let id =
                world.add_collider(hollow.with_restitution(0.4).with_friction(friction)).unwrap();
            for number in 0..4 {
                let center = vec(0.05 * f64::from(number) - 0.075, 0.0, 0.0);
                world.add_sphere(Sphere::new(center, 0.02)).unwrap();
            }
            for _ in 0..90 {
                world.step(1.0 / 60.0).unwrap();
                let pose = world.collider(id).unwrap().pose;
                for &center in world.spheres().positions() {
                    let local = pose.rotation.inverse() * (center - pose.position);
                    assert!((local.abs() - 0.1).max_element() < 0.0, "{rule:?} {friction} {local}");
                }
            }
        }
    }
}
