//! Balls that ride a collider that moves.

use std::f64::consts::{PI, TAU};

use carom::{Collider, DQuat, DVec3, Motion, MotionPart, Pose, Shape, Sides, Sphere};

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

/// The way of a smooth ball along a swing, by Runge and Kutta's scheme in its frame: `s'' = φ'' d + φ'² s - g sin φ` at
/// the height d above the pivot.
fn along_swing(start: f64, height: f64, [amplitude, omega]: [f64; 2], end: f64) -> f64 {
    let rate = |t: f64, [s, v]: [f64; 2]| {
        let (angle, turn) = (amplitude * (omega * t).sin(), amplitude * omega * (omega * t).cos());
        let faster = -omega * omega * angle;
        [v, faster * height + turn * turn * s - G * angle.sin()]
    };
    let steps = 20_000;
    let h = end / f64::from(steps);
    let mut state = [start, 0.0];
    let after = |state: [f64; 2], h: f64, rate: [f64; 2]| [0, 1].map(|i| state[i] + h * rate[i]);
    for step in 0..steps {
        let t = f64::from(step) * h;
        let first = rate(t, state);
        let second = rate(t + 0.5 * h, after(state, 0.5 * h, first));
        let third = rate(t + 0.5 * h, after(state, 0.5 * h, second));
        let fourth = rate(t + h, after(state, h, third));
        let mean = [0, 1].map(|i| (first[i] + 2.0 * second[i] + 2.0 * third[i] + fourth[i]) / 6.0);
        state = after(state, h, mean);
    }
    state[0]
}

#[test]
fn smooth_ball_on_a_swing_slides_as_its_equation_in_the_frame_of_the_swing_says() {
    let (amplitude, frequency, length, radius) = (0.2, 0.3, 1.0, 0.1);
    let omega = TAU * frequency;
    for size in SIZES {
        let mut world = heavy_world(exact(), size);
        let pivot = vec(0.0, length, 0.0) * size;
        let motion = MotionPart::Swing { axis: DVec3::Z, pivot, amplitude, frequency, phase: 0.0 };
        world.add_collider(plate([motion]).with_restitution(0.0)).unwrap();
        let (start, height) = (0.05, radius - length);
        let velocity = amplitude * omega * vec(-height, start, 0.0);
        let ball = Sphere::new(vec(start, radius, 0.0) * size, radius * size);
        world.add_sphere(ball.with_velocity(velocity * size)).unwrap();
        let mut off: f64 = 0.0;
        for frame in 1..=60 {
            world.step(1.0 / 60.0).unwrap();
            let t = f64::from(frame) / 60.0;
            let angle = amplitude * (omega * t).sin();
            let along = along_swing(start, height, [amplitude, omega], t);
            let place = world.spheres().positions()[0] / size;
            let expected =
                vec(0.0, length, 0.0) + DQuat::from_rotation_z(angle) * vec(along, height, 0.0);
            off = off.max((place - expected).length());
        }
        // Rounding of the steps, and of the reference.
        assert!(!world.was_stepped() && off < 1e-10, "{off}");
    }
}

#[test]
fn ball_on_a_turning_platform_circles_at_two_sevenths_of_its_rate() {
    // Weltner, Am. J. Phys. 47, 984 (1979): a circle, at 2/7 of the rate.
    let (rate, radius) = (3.0, 0.1);
    for size in SIZES {
        let mut world = heavy_world(exact(), size);
        let floor = plate(Motion::default()).with_restitution(0.0).with_friction(1.0);
        world.add_collider(floor.moving(DVec3::ZERO, rate * DVec3::Y)).unwrap();
        let (start, velocity) = (vec(0.5, radius, 0.0), vec(0.3, 0.0, 0.4));
        let beside = velocity - rate * DVec3::Y.cross(start);
        let ball = Sphere::new(start * size, radius * size)
            .with_velocity(velocity * size)
            .with_angular_velocity(DVec3::Y.cross(beside) / radius);
        world.add_sphere(ball).unwrap();
        let mut off: f64 = 0.0;
        for frame in 1..=120 {
            world.step(1.0 / 60.0).unwrap();
            let turned = 2.0 / 7.0 * rate * f64::from(frame) / 60.0;
            let expected = DQuat::from_rotation_y(turned) * velocity;
            off = off.max((world.spheres().velocities()[0] / size - expected).length());
        }
        // Rounding of the steps of two seconds.
        assert!(!world.was_stepped() && off < 1e-10, "{off}");
    }
}

#[test]
fn rough_ball_bounces_off_a_turning_platform_as_off_one_at_rest_in_its_frame() {
    let (rate, radius, friction, restitution) = (7.0, 0.1, 0.15, 0.8);
    let mut world = heavy_world(exact(), 1.0);
    let floor = plate(Motion::default()).with_restitution(restitution);
    let floor = floor.with_friction(friction).moving(DVec3::ZERO, rate * DVec3::Y);
    world.add_collider(floor).unwrap();
    let ball = Sphere::new(vec(0.4, 0.5, -0.2), radius).with_velocity(vec(0.3, 0.0, 0.4));
    let id = world.add_sphere(ball.with_angular_velocity(vec(3.0, 2.0, -9.0))).unwrap();
    let mut count = 0;
    while count < 12 {
        let before = world.sphere(id).unwrap();
        let report = world.step_to_next_event(1.0).unwrap();
        let [impact] = &report.impacts[..] else { continue };
        let time = impact.time;
        let platform = rate * DVec3::Y;
        let place = before.position + time * before.velocity - 0.5 * G * time * time * DVec3::Y;
        // Seen from the platform it flies and turns relative to it.
        let velocity = before.velocity - G * time * DVec3::Y - platform.cross(place);
        let spin = before.angular_velocity - platform;
        let slip = (velocity + spin.cross(-radius * DVec3::Y)).with_y(0.0);
        let most = friction * (1.0 + restitution) * -velocity.y;
        let pushed = -slip.normalize() * (2.0 / 7.0 * slip.length()).min(most);
        let bounced = velocity.with_y(-restitution * velocity.y) + pushed;
        let turned = spin - 2.5 / radius * DVec3::Y.cross(pushed);
        let after = world.sphere(id).unwrap();
        let off = after.velocity - platform.cross(place) - bounced;
        let off_turning = radius * (after.angular_velocity - platform - turned);
        // Rounding of one flight.
        assert!(off.length().max(off_turning.length()) < 1e-12, "{off} {off_turning}");
        count += 1;
    }
}
