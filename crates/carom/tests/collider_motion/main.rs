//! Colliders that oscillate, turn and swing: spheres meet them where they are, and ride them.

// Sines as each machine has them: tolerances are above their rounding.
#![allow(clippy::disallowed_methods)]

#[path = "../common/mod.rs"]
mod common;
mod keyframes;
mod on_curves;
mod riding;

use std::f64::consts::{PI, TAU};

use carom::{
    BodyPair, Collider, Contact, DQuat, DVec3, Exact, Gravity, Impact, Motion, MotionPart, Pose,
    Rule, Shape, Sides, Sphere, World,
};
use common::{G, Numbers, account_of_run, assert_close, bisect, discrete, vec, world};

const SIZES: [f64; 3] = [1e-6, 1.0, 1e6];

fn exact() -> Rule {
    Exact::default().into()
}

fn contact() -> Rule {
    Contact::default().into()
}

/// A world with gravity in units of this length.
fn heavy_world(rule: Rule, size: f64) -> World {
    let mut world = world(rule);
    world.add_force(Gravity::new(vec(0.0, -G * size, 0.0))).unwrap();
    world
}

fn oscillate(axis: DVec3, amplitude: f64, frequency: f64, phase: f64) -> MotionPart {
    MotionPart::Oscillate { axis, amplitude, frequency, phase }
}

fn swing(axis: DVec3, pivot: DVec3, amplitude: f64, frequency: f64) -> MotionPart {
    MotionPart::Swing { axis, pivot, amplitude, frequency, phase: 0.0 }
}

fn plate(motion: impl Into<Motion>) -> Collider {
    Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_motion(motion)
}

/// Impacts up to a time, with their times on the world's clock.
fn impacts(world: &mut World, frame: f64, until: f64) -> Vec<Impact> {
    let mut impacts = Vec::new();
    while world.time() < until {
        let start = world.time();
        let report = world.step(frame.min(until - start)).unwrap();
        impacts.extend(report.impacts.iter().cloned().map(|mut impact| {
            impact.time += start;
            impact
        }));
    }
    impacts
}

fn run(world: &mut World, frames: usize) {
    for _ in 0..frames {
        world.step(1.0 / 60.0).unwrap();
    }
}

/// The first root of a function in steps of `step` from `from` on, by halving.
fn first_root(f: impl Fn(f64) -> f64, from: f64, step: f64) -> f64 {
    let mut low = from;
    while f(low + step) > 0.0 {
        low += step;
    }
    let mut high = low + step;
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if f(middle) > 0.0 { low = middle } else { high = middle }
    }
    high
}

fn ball_state(world: &World) -> (DVec3, DVec3) {
    (world.spheres().positions()[0], world.spheres().velocities()[0])
}

#[test]
fn impact_times_on_an_oscillating_wall_are_roots_of_its_motion() {
    let (radius, amplitude, frequency) = (0.1, 0.05, 3.0);
    let mut numbers = Numbers(1);
    for size in SIZES {
        for case in 0..40 {
            let (phase, speed) = (numbers.between(0.0, TAU), numbers.between(0.2, 20.0));
            let (height, frame) = (numbers.between(0.2, 3.0), [1.0 / 60.0, 0.11, 5.0][case % 3]);
            let mut world = heavy_world(exact(), size);
            let motion = oscillate(DVec3::Y, amplitude * size, frequency, phase);
            world.add_collider(plate([motion])).unwrap();
            let velocity = vec(0.3, -speed, 0.0) * size;
            let ball = Sphere::new(vec(0.0, height, 0.0) * size, radius * size);
            world.add_sphere(ball.with_velocity(velocity)).unwrap();
            let found = impacts(&mut world, frame, 2.0)[0].time;
            let plate = |t: f64| amplitude * (TAU * frequency * t + phase).sin();
            let gap = |t: f64| height - speed * t - 0.5 * G * t * t - radius - plate(t);
            let root = first_root(gap, 0.0, 1e-5);
            // Rounding of lengths of up to 3 over the closing speed.
            let rate = (gap(root + 1e-7) - gap(root - 1e-7)).abs() / 2e-7;
            assert_close(found, root, 1e-14 + 2e-15 / rate.max(1e-3));
        }
    }
}

#[test]
fn impacts_do_not_depend_on_the_length_of_frames() {
    let run = |frame: f64| {
        let mut world = heavy_world(exact(), 1.0);
        world.add_collider(plate([oscillate(DVec3::Y, 0.02, 7.0, 0.5)])).unwrap();
        let size = vec(0.6, 0.1, 0.6);
        let turned = [swing(DVec3::Z, vec(-0.5, 0.0, 0.0), 0.4, 0.8)];
        let gate = Collider::new(Shape::Box { size }, Pose::at(vec(0.3, 0.8, 0.0)));
        world.add_collider(gate.with_motion(turned).with_restitution(0.8)).unwrap();
        world.add_sphere(Sphere::new(vec(0.2, 1.5, 0.0), 0.1)).unwrap();
        impacts(&mut world, frame, 2.0)
    };
    let long = run(0.5);
    assert!(long.len() > 2, "{long:?}");
    for frame in [1.0 / 60.0, 0.013, 2.0] {
        let short = run(frame);
        assert_eq!(short.len(), long.len());
        // Each impact multiplies the rounding of the one before.
        for (a, b) in long.iter().zip(&short) {
            assert_close(a.time, b.time, 1e-9);
        }
    }
}

/// The times of the impacts of a ball that begins close to the cycle of one impact in a period.
fn bounces_near_one_cycle(gamma: f64, restitution: f64, size: f64) -> Vec<f64> {
    let period = 0.05;
    let omega = TAU / period;
    let amplitude = gamma * G / (omega * omega);
    // It meets the plate, and leaves it, with g T/2 at the phase where the plate has the speed to make up for e.
    let cosine = PI / gamma * (1.0 - restitution) / (1.0 + restitution);
    let phase = cosine.acos();
    let mut world = heavy_world(exact(), size);
    let motion = oscillate(DVec3::Y, amplitude * size, period.recip(), phase);
    world.add_collider(plate([motion]).with_restitution(restitution)).unwrap();
    let height = 0.01 + amplitude * phase.sin();
    let velocity = vec(0.0, 0.5 * G * period * 1.001, 0.0) * size;
    world
        .add_sphere(Sphere::new(vec(0.0, height, 0.0) * size, 0.01 * size).with_velocity(velocity))
        .unwrap();
    impacts(&mut world, 1.0 / 60.0, 400.0 * period).iter().map(|it| it.time / period).collect()
}

/// Linear stability of the cycle of one impact in k periods: from
/// `Γ = k π (1-e)/(1+e)` to `Γ² = (k π (1-e)/(1+e))² + (2 (1+e²)/(1+e)²)²`
/// (Luck and Mehta, Phys. Rev. E 48, 3988 (1993)); the determinant of its map is e².
#[test]
fn one_cycle_of_a_bouncing_ball_is_stable_up_to_the_published_acceleration() {
    for (restitution, size) in [(0.5, 1.0), (0.8, 1.0), (0.5, 1e-6), (0.5, 1e6)] {
        let e: f64 = restitution;
        let least = PI * (1.0 - e) / (1.0 + e);
        let most = least.hypot(2.0 * (1.0 + e * e) / ((1.0 + e) * (1.0 + e)));
        let intervals = |gamma: f64| {
            let times = bounces_near_one_cycle(gamma, e, size);
            let last = &times[times.len() - 9..];
            last.windows(2).map(|two| two[1] - two[0]).collect::<Vec<f64>>()
        };
        for gamma in [least + 0.1, 0.5 * (least + most), most - 0.03] {
            // What is left of a start that is 0.1 % off after 400 periods.
            for interval in intervals(gamma) {
                assert_close(interval, 1.0, 1e-4);
            }
        }
        // Above, two impacts take two periods, one longer than the other.
        let above = intervals(most + 0.03);
        for two in above.windows(2) {
            assert_close(two[0] + two[1], 2.0, 1e-3);
            assert!((two[0] - two[1]).abs() > 0.02, "{above:?}");
        }
    }
}

/// Fermi's ball between a wall at rest and one that oscillates: the speed stays below a bound of the order of the
/// square root of the ratio of length and amplitude (Lichtenberg and Lieberman, *Regular and Chaotic Dynamics*, 3.4),
/// where kicks at random would make it grow as the square root of their number.
#[test]
fn speed_between_a_fixed_and_an_oscillating_wall_has_a_bound() {
    let (length, amplitude, frequency) = (1.0, 0.01, 1.0);
    let wall_speed = TAU * frequency * amplitude;
    let mut world = world(exact());
    let towards = |normal: DVec3| DQuat::from_rotation_arc(DVec3::Y, normal);
    let fixed = Pose::at(vec(length, 0.0, 0.0)).rotated(towards(DVec3::NEG_X));
    world.add_collider(Collider::new(Shape::HalfSpace, fixed)).unwrap();
    let moving = Pose::at(DVec3::ZERO).rotated(towards(DVec3::X));
    let motion = [oscillate(DVec3::X, amplitude, frequency, 0.0)];
    world.add_collider(Collider::new(Shape::HalfSpace, moving).with_motion(motion)).unwrap();
    let ball = Sphere::new(vec(0.5, 0.0, 0.0), 0.1).with_velocity(vec(wall_speed, 0.0, 0.0));
    let id = world.add_sphere(ball).unwrap();
    let (mut fastest, mut count) = (0.0f64, 0);
    for _ in 0..3000 {
        count += world.step(5.0).unwrap().impacts.len();
        fastest = fastest.max(world.sphere(id).unwrap().velocity.length());
    }
    // A change of 2 V in each flight shifts the phase of the next impact by 2 ω L 2 V/v²: below one radian kicks are
    // in step. Bounds of the first barrier that is not broken are between one and three times that speed.
    let barrier = (4.0 * TAU * frequency * length * wall_speed).sqrt();
    let at_random = 2.0 * wall_speed * (0.25 * f64::from(count as u32)).sqrt();
    assert!(fastest > 0.3 * barrier && fastest < 1.5 * barrier, "{fastest} {barrier} {at_random}");
    assert!(at_random > 2.0 * fastest, "{fastest} {at_random}");
}

/// A ball without gravity in a closed box that swings: seen from the box, each impact turns the velocity of its
/// surface round, and happens where the ball touches a wall.
#[test]
fn ball_in_a_swinging_box_bounces_as_seen_from_the_box() {
    let (amplitude, frequency, radius) = (0.7, 0.4, 0.1);
    for size in SIZES {
        for frame in [1.0 / 60.0, 0.37] {
            let mut world = world(exact());
            let shape = Shape::Container { size: DVec3::splat(size), open: Sides::NONE };
            let pivot = vec(0.4, 1.3, -0.2) * size;
            let motion = [swing(DVec3::Z, pivot, amplitude, frequency)];
            world
                .add_collider(Collider::new(shape, Pose::at(DVec3::ZERO)).with_motion(motion))
                .unwrap();
            let ball = Sphere::new(vec(0.1, -0.05, 0.2) * size, radius * size);
            world.add_sphere(ball.with_velocity(vec(0.9, 0.4, -0.3) * size)).unwrap();
            let (mut last, mut count) = ([ball_state(&world), (DVec3::ZERO, DVec3::ZERO)][0], 0);
            let mut since = 0.0;
            for impact in impacts(&mut world, frame, 6.0) {
                let (place, velocity) = last;
                let place = place + (impact.time - since) * velocity;
                let angle = amplitude * (TAU * frequency * impact.time).sin();
                let rate = amplitude * TAU * frequency * (TAU * frequency * impact.time).cos();
                let back = DQuat::from_rotation_z(-angle);
                let local = pivot + back * (place - pivot);
                let depth = (local.abs() + radius * size).max_element() - 0.5 * size;
                // Rounding of the way of up to 6 s at this speed, in each impact.
                assert_close(depth, 0.0, 1e-12 * size);
                let surface = vec(0.0, 0.0, rate).cross(impact.point - pivot);
                let along = (velocity - surface).dot(impact.normal);
                let after = velocity - 2.0 * along * impact.normal;
                assert_close(impact.approach_speed, -along, 1e-11 * size);
                (last, since, count) = ((place, after), impact.time, count + 1);
            }
            assert!(count > 8, "{count}");
            let center = ball_state(&world).0;
            let expected = last.0 + (world.time() - since) * last.1;
            assert!((center - expected).length() < 1e-9 * size);
        }
    }
}

#[test]
fn energy_account_closes_beside_all_motions_under_exact_and_contact() {
    for rule in [exact(), contact()] {
        let mut world = heavy_world(rule, 1.0);
        let shape = Shape::Container { size: vec(1.0, 1.0, 1.0), open: Sides::NONE };
        let motion = [
            swing(DVec3::Z, vec(0.0, 0.5, 0.0), 0.3, 0.7),
            oscillate(vec(1.0, 0.3, 0.0), 0.1, 1.1, 0.4),
        ];
        let hollow = Collider::new(shape, Pose::at(DVec3::ZERO)).with_motion(motion);
        world.add_collider(hollow.with_restitution(0.7)).unwrap();
        let mut numbers = Numbers(5);
        for number in 0..8 {
            let place =
                vec(f64::from(number % 2), f64::from(number / 2 % 2), f64::from(number / 4));
            let center = 0.4 * place - DVec3::splat(0.2);
            let ball = Sphere::new(center, 0.08).with_velocity(numbers.vector());
            world.add_sphere(ball.with_restitution(0.8)).unwrap();
        }
        let (account, remainder) = account_of_run(&mut world, 180, 1.0 / 60.0);
        assert!(account.colliders.abs() > 0.1, "{account:?}");
        // Pieces of path on what accelerates; in sub-steps all paths are straight or parabolas.
        let part = if matches!(rule, Rule::Exact(_)) { 1e-7 } else { 1e-12 };
        assert!(
            remainder.abs() < part * account.colliders.abs(),
            "{rule:?}: {remainder} {account:?}"
        );
    }
}

#[test]
fn energy_account_closes_for_rough_balls_on_a_vibrating_plate() {
    for (rule, friction) in [(contact(), 0.0), (contact(), 0.4), (exact(), 0.0), (exact(), 0.4)] {
        let mut world = heavy_world(rule, 1.0);
        let shape = Shape::Container { size: vec(1.0, 2.0, 1.0), open: Sides::NONE };
        let walls = Collider::new(shape, Pose::at(vec(0.0, 0.9, 0.0))).with_friction(friction);
        world.add_collider(walls.with_restitution(0.7)).unwrap();
        let shaken = Shape::Box { size: vec(0.98, 0.1, 0.98) };
        let shaken = Collider::new(shaken, Pose::at(vec(0.0, 0.1, 0.0))).with_friction(friction);
        let shaken = shaken.with_motion([oscillate(DVec3::Y, 0.02, 8.0, 0.0)]);
        world.add_collider(shaken.with_restitution(0.7)).unwrap();
        let mut numbers = Numbers(5);
        for number in 0..20 {
            let place =
                vec(f64::from(number % 4), f64::from(number / 16), f64::from(number / 4 % 4));
            let center = 0.2 * place + vec(-0.3, 0.4, -0.3) + 0.01 * numbers.vector();
            let ball = Sphere::new(center, 0.06).with_restitution(0.8).with_friction(friction);
            world.add_sphere(ball).unwrap();
        }
        let (account, rest) = account_of_run(&mut world, 120, 1.0 / 60.0);
        assert!(account.colliders > 1.0, "{account:?}");
        // Rounding of some ten thousand impulses.
        assert!(rest.abs() < 1e-13 * account.colliders, "{friction}: {rest} {account:?}");
    }
}

#[test]
fn rules_of_frames_bounce_balls_off_an_oscillating_wall() {
    for rule in [discrete(), bisect(), contact()] {
        let mut world = world(rule);
        let towards = DQuat::from_rotation_arc(DVec3::Y, DVec3::X);
        let wall = Pose::at(DVec3::ZERO).rotated(towards);
        // At its fastest towards the ball when they meet, after a period.
        let motion = [oscillate(DVec3::X, 0.01, 10.0, 0.0)];
        world.add_collider(Collider::new(Shape::HalfSpace, wall).with_motion(motion)).unwrap();
        let ball = Sphere::new(vec(1.1, 0.0, 0.0), 0.1).with_velocity(vec(-1.0, 0.0, 0.0));
        let id = world.add_sphere(ball).unwrap();
        for _ in 0..1500 {
            world.step(1e-3).unwrap();
        }
        // 1 + 2 A ω, to the change of the wall's speed in some milliseconds.
        let expected = 1.0 + 2.0 * 0.01 * TAU * 10.0;
        assert_close(world.sphere(id).unwrap().velocity.x, expected, 0.02);
    }
}

#[test]
fn motion_is_a_function_of_the_clock() {
    let motion = [
        swing(DVec3::Z, vec(0.3, 0.0, 0.0), 0.5, 0.4),
        oscillate(vec(0.0, 2.0, 0.0), 0.1, 0.3, 1.0),
        MotionPart::Steady { velocity: vec(0.0, 0.0, 0.2) },
    ];
    let gate = || {
        Collider::new(Shape::HalfSpace, Pose::at(vec(1.0, 2.0, 3.0))).with_motion(motion.clone())
    };
    let mut stepped = world(exact());
    let id = stepped.add_collider(gate()).unwrap();
    run(&mut stepped, 90);
    let mut at_once = world(exact());
    at_once.add_collider(gate()).unwrap();
    at_once.set_time(1.5).unwrap();
    let [a, b] = [&stepped, &at_once].map(|it| it.collider(id).unwrap());
    assert!((a.pose.position - b.pose.position).length() < 1e-14);
    assert!((a.velocity - b.velocity).length() < 1e-14);
    let sine = |frequency: f64, phase: f64| (TAU * frequency * 1.5 + phase).sin();
    let angle = 0.5 * sine(0.4, 0.0);
    let turned = vec(0.3, 0.0, 0.0) - 0.3 * vec(angle.cos(), angle.sin(), 0.0);
    let expected = vec(1.0, 2.0 + 0.1 * sine(0.3, 1.0), 3.3) + turned;
    assert!((a.pose.position - expected).length() < 1e-14, "{:?} {expected}", a.pose);
    // The same on a clock that begins then.
    let mut later = world(exact());
    let again = gate().with_motion(gate().motion.beginning_at(1.5));
    later.add_collider(again).unwrap();
    let same = later.collider(id).unwrap().pose;
    assert!((same.position - a.pose.position).length() < 1e-14);
    assert!((same.rotation - a.pose.rotation).length() < 1e-14);
    // Put elsewhere, it takes its motion along.
    let by = vec(5.0, 0.0, 0.0);
    let moved = Pose { position: a.pose.position + by, ..a.pose };
    stepped.set_pose(id, moved).unwrap();
    run(&mut stepped, 30);
    at_once.set_time(2.0).unwrap();
    let [a, b] = [&stepped, &at_once].map(|it| it.collider(id).unwrap().pose);
    assert!((a.position - b.position - by).length() < 1e-13);
    assert!((a.rotation - b.rotation).length() < 1e-14);
}

#[test]
fn sensors_that_swing_report_what_they_pass() {
    let mut world = world(exact());
    let size = vec(0.01, 0.4, 0.4);
    let motion = [oscillate(DVec3::X, 1.0, 1.0, 0.0)];
    let gate = Collider::new(Shape::Box { size }, Pose::at(DVec3::ZERO)).as_trigger();
    world.add_collider(gate.with_motion(motion)).unwrap();
    world.add_sphere(Sphere::new(vec(0.5, 0.0, 0.0), 0.01)).unwrap();
    let mut times = Vec::new();
    for _ in 0..10 {
        let start = world.time();
        let report = world.step(0.1).unwrap();
        times.extend(report.sensor_events.iter().map(|it| (it.enters, start + it.time)));
    }
    // The near and the far side of the gate come to the near and the far side of the ball.
    let at = |x: f64| x.asin() / TAU;
    let expected =
        [(true, at(0.485)), (false, at(0.515)), (true, 0.5 - at(0.515)), (false, 0.5 - at(0.485))];
    assert_eq!(times.len(), 4, "{times:?}");
    for ((enters, time), (is_entry, at)) in times.into_iter().zip(expected) {
        assert_eq!(enters, is_entry);
        assert_close(time, at, 1e-12);
    }
}

#[test]
fn impossible_motions_are_refused_with_the_field() {
    let refused = |part: MotionPart| {
        let error = World::default().add_collider(plate([part])).unwrap_err();
        error.to_string()
    };
    assert!(refused(oscillate(DVec3::ZERO, 1.0, 1.0, 0.0)).contains("axis"));
    assert!(refused(oscillate(DVec3::Y, 1.0, -1.0, 0.0)).contains("frequency"));
    assert!(refused(oscillate(DVec3::Y, f64::NAN, 1.0, 0.0)).contains("amplitude"));
    let turn = MotionPart::Turn { axis: DVec3::Y, pivot: DVec3::ZERO, rate: f64::INFINITY };
    assert!(refused(turn).contains("rate"));
    let mut twice = plate([oscillate(DVec3::Y, 1.0, 1.0, 0.0)]);
    twice.velocity = DVec3::Y;
    assert!(World::default().add_collider(twice).unwrap_err().to_string().contains("velocity"));
}

#[test]
fn snapshot_goes_on_with_the_same_bits() {
    let mut world = heavy_world(exact(), 1.0);
    world.add_collider(plate([oscillate(DVec3::Y, 0.01, 20.0, 0.3)])).unwrap();
    world.add_sphere(Sphere::new(vec(0.0, 0.5, 0.0), 0.1)).unwrap();
    run(&mut world, 20);
    let mut other = World::default();
    other.restore(&world.snapshot());
    for world in [&mut world, &mut other] {
        run(world, 60);
    }
    assert_eq!(world.state_hash(), other.state_hash());
    assert!(matches!(impacts(&mut world, 1.0 / 60.0, 3.0)[0].between, BodyPair::Collider { .. }));
}

#[test]
fn step_takes_a_collider_to_its_next_pose_and_hits_with_the_speed_of_that() {
    let mut world = world(exact());
    let size = vec(1.0, 0.1, 0.2);
    let id = world.add_collider(Collider::new(Shape::Box { size }, Pose::at(DVec3::ZERO))).unwrap();
    let ball = world.add_sphere(Sphere::new(vec(0.4, 0.2, 0.0), 0.1)).unwrap();
    let turned = DQuat::from_rotation_z(0.5);
    let pose = Pose::at(vec(0.0, 0.02, 0.0)).rotated(turned);
    world.set_next_pose(id, pose, 0.1).unwrap();
    let report = world.step(0.1).unwrap();
    let impact = report.impacts[0];
    let surface = vec(0.0, 0.2, 0.0)
        + vec(0.0, 0.0, 5.0).cross(impact.point - impact.time * vec(0.0, 0.2, 0.0));
    assert_close(impact.approach_speed, surface.dot(impact.normal), 1e-12);
    let there = world.collider(id).unwrap().pose;
    assert!((there.position - pose.position).length() < 1e-15, "{there:?}");
    assert!((there.rotation - turned).length() < 1e-15, "{there:?}");
    assert!(world.sphere(ball).unwrap().velocity.y > 2.0);
    assert!(world.set_next_pose(id, pose, 0.0).unwrap_err().to_string().contains("dt"));
    let mut driven = world.collider(id).unwrap().with_motion([oscillate(DVec3::Y, 1.0, 1.0, 0.0)]);
    driven.restitution = 0.5;
    world.set_collider(id, driven).unwrap();
    assert!(world.set_next_pose(id, pose, 0.1).unwrap_err().to_string().contains("motion"));
}
