//! Colliders that move by keyframes: they pass them, meet balls where their curves do, and carry them.

use carom::{
    Collider, DQuat, DVec3, Keyframe, Keyframes, MotionPart, Pose, Rule, Shape, Sides, Sphere,
    World,
};

use crate::common::{
    G, Numbers, account_of_run, assert_close, assert_close_vec, discrete, vec, world,
};
use crate::{SIZES, contact, exact, first_root, heavy_world, impacts, plate, run};

/// Heights \[m\] at times \[s\].
fn heights<const N: usize>(keys: [(f64, f64); N]) -> Keyframes {
    Keyframes::new(keys.map(|(time, height)| Keyframe::at(time, height * DVec3::Y)))
}

fn moved_by(keyframes: &Keyframes) -> Collider {
    plate([MotionPart::Keyframes(keyframes.clone())])
}

fn place(keyframes: &Keyframes, time: f64) -> Pose {
    moved_by(keyframes).pose_at(time)
}

/// A loop in space with rotations, at uneven times.
fn tour() -> Keyframes {
    let turned = |axis: DVec3, angle: f64| DQuat::from_axis_angle(axis.normalize(), angle);
    Keyframes::new([
        Keyframe::at(0.5, vec(0.0, 0.0, 0.0)),
        Keyframe::at(1.0, vec(0.4, 0.1, 0.0)).rotated(turned(vec(0.0, 1.0, 0.3), 1.2)),
        Keyframe::at(2.5, vec(0.3, 0.5, -0.2)).rotated(turned(vec(1.0, 0.2, 0.0), 2.2)),
        Keyframe::at(2.75, vec(-0.1, 0.2, 0.1)).rotated(turned(vec(0.4, 0.2, 1.0), -0.4)),
        Keyframe::at(4.0, vec(0.0, 0.0, 0.0)),
    ])
    .about(vec(0.1, -0.2, 0.3))
}

#[test]
fn keyframes_are_passed_at_their_times_with_continuous_velocities() {
    let pivot = tour().pivot();
    for keyframes in [tour(), tour().repeating()] {
        for key in keyframes.keyframes() {
            let at = |h: f64| place(&keyframes, key.time + h);
            let expected = key.position + pivot - key.rotation * pivot;
            // A rounding of the coordinates.
            assert_close_vec(at(0.0).position, expected, 1e-15);
            assert!((at(0.0).rotation - key.rotation).length() < 1e-15);
            let h = 1e-6;
            let rates = [-h, 0.0].map(|from| {
                let [before, after] = [at(from), at(from + h)];
                let turn = (after.rotation - before.rotation) / h;
                ((after.position - before.position) / h, turn)
            });
            // Half the accelerations of both sides, of up to 100 a second squared, times h.
            assert_close_vec(rates[0].0, rates[1].0, 1e-4);
            assert!((rates[0].1 - rates[1].1).length() < 1e-4, "{rates:?}");
        }
    }
}

#[test]
fn motion_along_a_line_stays_between_its_keyframes_and_rests_between_equal_ones() {
    let lift = heights([(0.0, 0.0), (2.0, 1.0), (2.1, 0.2), (3.0, 0.2), (3.5, 0.1), (5.0, 0.0)]);
    let keys = lift.keyframes().to_vec();
    for two in keys.windows(2) {
        let [from, to] = [two[0].position.y, two[1].position.y];
        let mut before = from;
        for step in 0..=100 {
            let part = f64::from(step) / 100.0;
            let height = place(&lift, two[0].time + part * (two[1].time - two[0].time)).position.y;
            // A rounding of the heights.
            assert!((height - before) * (to - from).signum() > -1e-15, "{height} {before}");
            assert!(from != to || height == from);
            before = height;
        }
    }
    for (time, height) in [(-3.0, 0.0), (0.0, 0.0), (5.0, 0.0), (1e9, 0.0)] {
        assert_eq!(place(&lift, time).position.y, height);
    }
}

#[test]
fn repeated_keyframes_are_those_of_a_longer_list() {
    let once = tour();
    let repeated = tour().repeating();
    let copies = (-2..4).flat_map(|lap| {
        let laps = once.keyframes()[..4].iter();
        laps.map(move |it| Keyframe { time: it.time + 3.5 * f64::from(lap), ..*it })
    });
    let listed = Keyframes::new(copies).about(once.pivot());
    for number in 0..200 {
        let time = 0.5 + 0.05 * f64::from(number);
        let [a, b] = [&repeated, &listed].map(|it| place(it, time));
        // Roundings of times of up to ten seconds.
        assert_close_vec(a.position, b.position, 1e-13);
        assert!((a.rotation - b.rotation).length().min((a.rotation + b.rotation).length()) < 1e-13);
        // 10⁶ laps later the time is rounded to 5e-10 s.
        let later = place(&repeated, time + 3.5e6);
        assert_close_vec(later.position, a.position, 1e-8);
    }
}

#[test]
fn motion_that_begins_later_goes_on_with_the_same_poses() {
    for keyframes in [tour(), tour().repeating()] {
        let part = MotionPart::Keyframes(keyframes.clone());
        let gate = plate([part]);
        let later = plate(gate.motion.beginning_at(1.7).parts().to_vec());
        for number in 0..50 {
            let time = 0.1 * f64::from(number);
            let [a, b] = [gate.pose_at(1.7 + time), later.pose_at(time)];
            // Roundings of the times.
            assert_close_vec(a.position, b.position, 1e-14);
            assert!((a.rotation - b.rotation).length() < 1e-14);
        }
    }
}

/// `3 s² - 2 s³`, by which two keyframes are joined.
fn smooth_step(s: f64) -> f64 {
    let s = s.clamp(0.0, 1.0);
    s * s * (3.0 - 2.0 * s)
}

#[test]
fn impact_times_on_a_keyframed_floor_are_roots_of_its_curve() {
    let radius = 0.1;
    let mut numbers = Numbers(3);
    for size in SIZES {
        for case in 0..40 {
            let (begin, length) = (numbers.between(0.0, 0.3), numbers.between(0.05, 0.5));
            let (rise, speed) = (numbers.between(-0.5, 0.5), numbers.between(0.0, 5.0));
            let frame = [1.0 / 60.0, 0.11, 5.0][case % 3];
            let mut world = heavy_world(exact(), size);
            let floor = heights([(begin, 0.0), (begin + length, rise * size)]);
            world.add_collider(moved_by(&floor)).unwrap();
            let ball = Sphere::new(vec(0.0, 0.7, 0.0) * size, radius * size);
            world.add_sphere(ball.with_velocity(vec(0.3, -speed, 0.0) * size)).unwrap();
            let found = impacts(&mut world, frame, 2.0)[0].time;
            let height = |t: f64| rise * smooth_step((t - begin) / length);
            let gap = |t: f64| 0.7 - speed * t - 0.5 * G * t * t - radius - height(t);
            let root = first_root(gap, 0.0, 1e-5);
            // Rounding of lengths of up to 1 over the closing speed.
            let rate = (gap(root + 1e-7) - gap(root - 1e-7)).abs() / 2e-7;
            assert_close(found, root, 1e-14 + 2e-15 / rate.max(1e-2));
        }
    }
}

#[test]
fn impact_times_on_a_keyframed_flipper_are_roots_of_its_turning() {
    for size in SIZES {
        let mut world = world(exact());
        let turned = |time: f64, angle: f64| {
            Keyframe::at(time, DVec3::ZERO).rotated(DQuat::from_rotation_z(angle))
        };
        let beat = Keyframes::new([turned(0.1, -0.4), turned(0.16, 0.5), turned(0.3, -0.4)]);
        // Its top side passes through the pivot.
        let shape = Shape::Box { size: vec(0.3, 0.02, 0.1) * size };
        let beat = beat.about(vec(-0.15, 0.01, 0.0) * size);
        let flipper = Collider::new(shape, Pose::at(vec(0.15, -0.01, 0.0) * size));
        world.add_collider(flipper.with_motion([MotionPart::Keyframes(beat)])).unwrap();
        let ball = Sphere::new(vec(0.2, 0.06, 0.0) * size, 0.02 * size);
        world.add_sphere(ball).unwrap();
        let found = impacts(&mut world, 1.0 / 60.0, 0.3)[0].time;
        // The middle keyframe is a turning point, where the angular velocity is zero.
        let angle = |t: f64| 0.9 * smooth_step((t - 0.1) / 0.06) - 0.4;
        let root = first_root(|t| 0.06 * angle(t).cos() - 0.2 * angle(t).sin() - 0.02, 0.1, 1e-6);
        // Some roundings of 0.2 m over the closing speed of 4 m/s.
        assert_close(found, root, 1e-15 * 8.0);
    }
}

#[test]
fn ball_rides_a_lift_over_its_keyframes_and_lifts_off_where_it_drops_with_more_than_g() {
    let rise = |t: f64| smooth_step((t - 0.2) / 0.8);
    for size in SIZES {
        // Accelerations of 6 h/T² at the ends of a piece: 9.4 m/s² up to 1.2 s, then 96 m/s².
        let lift = heights([(0.2, 0.0), (1.0, size), (1.5, size), (1.75, 0.0)]);
        for (rule, close) in [(exact(), 1e-8), (contact(), 1e-3)] {
            let mut world = heavy_world(rule, size);
            world.add_collider(moved_by(&lift).with_restitution(0.0)).unwrap();
            let id = world.add_sphere(Sphere::new(vec(0.0, 0.1, 0.0) * size, 0.1 * size)).unwrap();
            for frame in 1..=100 {
                world.step(1.0 / 60.0).unwrap();
                let height = world.sphere(id).unwrap().position.y / size - 0.1;
                let fallen = (world.time() - 1.5).max(0.0);
                let expected = rise(world.time()) - 0.5 * G * fallen * fallen;
                // Pieces of path are right to 1e-7 of the radius; sub-steps to their length.
                assert!((height - expected).abs() < close, "{frame}: {height} {expected}");
            }
        }
    }
}

/// Balls in a closed box with a floor and a paddle that move by keyframes.
fn busy_box(rule: Rule, size: f64) -> World {
    let mut world = heavy_world(rule, size);
    let walls = Shape::Container { size: vec(1.0, 1.5, 1.0) * size, open: Sides::NONE };
    world.add_collider(Collider::new(walls, Pose::at(DVec3::ZERO)).with_restitution(0.7)).unwrap();
    let floor = heights([(0.0, 0.0), (0.3, 0.3 * size), (0.5, 0.3 * size), (0.9, 0.0)]).repeating();
    let shape = Shape::Box { size: vec(0.9, 0.1, 0.9) * size };
    let floor = Collider::new(shape, Pose::at(vec(0.0, -0.6, 0.0) * size))
        .with_motion([MotionPart::Keyframes(floor)]);
    world.add_collider(floor.with_restitution(0.8).with_friction(0.3)).unwrap();
    let key = |time: f64, angle: f64| {
        Keyframe::at(time, angle * 0.1 * size * DVec3::X).rotated(DQuat::from_rotation_y(angle))
    };
    let beat = Keyframes::new([key(0.0, 0.0), key(0.2, 1.2), key(0.5, -0.9), key(1.1, 0.0)]);
    let paddle = Shape::Box { size: vec(0.4, 0.1, 0.05) * size };
    let beat = MotionPart::Keyframes(beat.about(vec(0.1, 0.0, 0.0) * size).repeating());
    let paddle = Collider::new(paddle, Pose::at(DVec3::ZERO)).with_motion([beat]);
    world.add_collider(paddle.with_restitution(0.8)).unwrap();
    let mut numbers = Numbers(5);
    for number in 0..6 {
        let (x, z) = (0.3 * f64::from(number % 3 - 1), 0.3 * f64::from(number / 3) - 0.15);
        let ball = Sphere::new(vec(x, 0.4, z) * size, 0.08 * size).with_restitution(0.8);
        world.add_sphere(ball.with_velocity(numbers.vector() * size).with_friction(0.3)).unwrap();
    }
    world
}

#[test]
fn energy_account_closes_beside_keyframes_under_exact_and_contact() {
    for (rule, part) in [(exact(), 1e-7), (contact(), 1e-12)] {
        let mut world = busy_box(rule, 1.0);
        let (account, remainder) = account_of_run(&mut world, 180, 1.0 / 60.0);
        assert!(account.colliders.abs() > 0.1, "{account:?}");
        // Pieces of path on what accelerates; in sub-steps all paths are straight or parabolas.
        let most = part * account.colliders.abs();
        assert!(remainder.abs() < most, "{rule:?}: {remainder} {account:?}");
    }
}

#[test]
fn worlds_with_keyframes_have_the_same_bits_at_sizes_that_are_powers_of_two() {
    // The tolerance of `bisect` is a length.
    for rule in [exact(), contact(), discrete()] {
        let states = [-20, 0, 20].map(|power| {
            let size = 2f64.powi(power);
            let mut world = busy_box(rule, size);
            run(&mut world, 60);
            world.spheres().positions().iter().map(|&it| it / size).collect::<Vec<_>>()
        });
        assert_eq!(states[0], states[1], "{rule:?}");
        assert_eq!(states[1], states[2], "{rule:?}");
    }
}

#[test]
fn snapshot_between_keyframes_goes_on_with_the_same_bits() {
    let mut world = busy_box(exact(), 1.0);
    run(&mut world, 20);
    let mut other = World::default();
    other.restore(&world.snapshot());
    for world in [&mut world, &mut other] {
        run(world, 40);
    }
    assert_eq!(world.state_hash(), other.state_hash());
}

#[test]
fn impossible_keyframes_are_refused_with_the_field() {
    let refused = |keyframes: Keyframes| {
        let error = World::default().add_collider(moved_by(&keyframes)).unwrap_err();
        error.to_string()
    };
    assert!(refused(Keyframes::new([])).contains("times"));
    assert!(refused(heights([(0.0, 0.0)])).contains("times"));
    assert!(refused(heights([(0.0, 0.0), (0.0, 1.0)])).contains("ascending"));
    assert!(refused(heights([(0.0, 0.0), (f64::NAN, 1.0)])).contains("times"));
    assert!(refused(heights([(0.0, 0.0), (1.0, f64::INFINITY)])).contains("positions"));
    assert!(refused(heights([(0.0, 0.0), (1.0, 1.0)]).repeating()).contains("positions"));
    let key = |time: f64, rotation| Keyframe::at(time, DVec3::ZERO).rotated(rotation);
    let zero = DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0);
    assert!(refused(Keyframes::new([key(0.0, zero), key(1.0, zero)])).contains("rotations"));
    let open = [key(0.0, DQuat::IDENTITY), key(1.0, DQuat::from_rotation_x(0.1))];
    assert!(refused(Keyframes::new(open).repeating()).contains("rotations"));
    let about = heights([(0.0, 0.0), (1.0, 1.0)]).about(DVec3::NAN);
    assert!(refused(about).contains("pivot"));
    // Poses of what no world has checked.
    assert_eq!(moved_by(&Keyframes::new([])).pose_at(1.0), Pose::at(DVec3::ZERO));
}
