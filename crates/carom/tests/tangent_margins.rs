//! Constructed impacts that graze or come at one instant: they are reported with their margin or refused, and no number
//! is wrong.

mod common;

use carom::{
    Collider, DQuat, DVec3, DerivativeError, Pose, Shape, Sphere, SphereId, SphereTangent, Tape,
    World,
};
use common::{Numbers, vec};

/// Two balls of radius 1/2; the first flies along x past the centre of the second, at this distance.
fn passing(distance: f64, speed: f64) -> (World, [SphereId; 2]) {
    let mut world = World::default();
    let flying = Sphere::new(vec(-3.0, distance, 0.0), 0.5).with_velocity(vec(speed, 0.0, 0.0));
    let first = world.add_sphere(flying).unwrap();
    let second = world.add_sphere(Sphere::new(DVec3::ZERO, 0.5)).unwrap();
    (world, [first, second])
}

/// A ball of radius 1/2 that flies towards the edge of two walls, x = 0 and y = 0, which it reaches at times `first` and
/// `second` \[s\].
fn into_a_corner(first: f64, second: f64, speeds: [f64; 2]) -> (World, SphereId) {
    let mut world = World::default();
    let quarter = DQuat::from_xyzw(0.0, 0.0, -0.5_f64.sqrt(), 0.5_f64.sqrt());
    for pose in [Pose::at(DVec3::ZERO), Pose { rotation: quarter, ..Pose::at(DVec3::ZERO) }] {
        world.add_collider(Collider::new(Shape::HalfSpace, pose)).unwrap();
    }
    let place = vec(0.5 + speeds[0] * first, 0.5 + speeds[1] * second, 0.0);
    let ball = Sphere::new(place, 0.5).with_velocity(vec(-speeds[0], -speeds[1], 0.0));
    let ball = world.add_sphere(ball).unwrap();
    (world, ball)
}

fn along(position: DVec3) -> SphereTangent {
    SphereTangent { position, ..SphereTangent::default() }
}

#[test]
fn impacts_that_graze_are_reported_with_their_directness() {
    let mut numbers = Numbers(1);
    for case in 0..80 {
        let power = 1 + case % 10;
        let gap = numbers.between(1.0, 2.0) * (0..power).fold(1.0, |gap, _| 0.1 * gap);
        let (distance, speed) = (1.0 - gap, numbers.between(0.5, 2.0));
        let (mut world, [first, second]) = passing(distance, speed);
        let mut tape = Tape::start(&world).unwrap();
        tape.step(&mut world, 8.0 / speed).unwrap();
        let margin = tape.margin();
        // 1 - d² loses what d has of rounding.
        let expected = ((1.0 - distance) * (1.0 + distance)).sqrt();
        let rounding = 1e-14 / (expected * expected);
        assert!((margin.directness / expected - 1.0).abs() < rounding, "{case}: {margin:?}");
        let (sphere, time) = margin.most_grazing.unwrap();
        assert_eq!(sphere, second);
        assert!((time - (3.0 - expected) / speed).abs() < 1e-13 / expected, "{case}: {margin:?}");
        // The ball that is struck leaves along the normal, whose angle has the sine of the distance: its
        // velocity along x is v (1 - d²).
        let by = SphereTangent { velocity: DVec3::X, ..SphereTangent::default() };
        let by = tape.gradient(&[(second, by)]).unwrap().sphere(first);
        let (slope, rounding) = (-2.0 * distance * speed, 1e-13 / (expected * expected));
        assert!((by.position.y - slope).abs() < rounding * slope.abs(), "{case}: {by:?} {slope}");
    }
}

#[test]
fn balls_that_miss_have_no_impact_and_no_margin() {
    for power in 1..=12 {
        let gap = (0..power).fold(1.0, |gap, _| 0.1 * gap);
        let (mut world, [first, second]) = passing(1.0 + gap, 1.0);
        let mut tape = Tape::start(&world).unwrap();
        tape.step(&mut world, 8.0).unwrap();
        assert_eq!((tape.impacts(), tape.margin().directness), (0, 1.0));
        let by = tape.gradient(&[(second, along(DVec3::X))]).unwrap();
        assert_eq!(by.sphere(first).position, DVec3::ZERO);
    }
}

#[test]
fn impacts_of_one_ball_at_one_instant_are_refused() {
    let mut numbers = Numbers(2);
    for case in 0..60 {
        // Sums of few binary digits have no rounding.
        let eighths = |numbers: &mut Numbers| (8.0 * numbers.between(0.25, 3.0)).ceil() / 8.0;
        let time = eighths(&mut numbers);
        let speeds = [eighths(&mut numbers), eighths(&mut numbers)];
        let (mut world, ball) = into_a_corner(time, time, speeds);
        let mut tape = Tape::start(&world).unwrap();
        let error = tape.step(&mut world, 2.0 * time).unwrap_err();
        let DerivativeError::Simultaneous { sphere, time: found } = error else {
            panic!("{case}: {error}")
        };
        assert!(sphere == ball && (found - time).abs() < 1e-15 * time, "{case}: {found} {time}");
        assert_eq!(tape.gradient(&[]).unwrap_err(), error);
    }
    // Two balls meet one, or the ends of a row, from both sides.
    for case in 0..20 {
        let mut world = World::default();
        let speed = numbers.between(0.5, 2.0);
        let row = f64::from(case % 4);
        for (x, vx) in [(-3.0, speed), (3.0 + row, -speed)] {
            let flying = Sphere::new(vec(x, 0.0, 0.0), 0.5).with_velocity(vec(vx, 0.0, 0.0));
            world.add_sphere(flying).unwrap();
        }
        for number in 0..=case % 4 {
            world.add_sphere(Sphere::new(vec(f64::from(number), 0.0, 0.0), 0.5)).unwrap();
        }
        let mut tape = Tape::start(&world).unwrap();
        let error = tape.step(&mut world, 4.0 / speed).unwrap_err();
        assert!(matches!(error, DerivativeError::Simultaneous { .. }), "{case}: {error}");
    }
}

#[test]
fn impacts_at_almost_one_instant_are_right_or_refused() {
    let (mut numbers, mut right, mut refused) = (Numbers(3), 0, 0);
    for case in 0..60 {
        let apart = numbers.between(1.0, 2.0) * (0..1 + case % 15).fold(1.0, |it, _| 0.1 * it);
        let speeds = [numbers.between(0.5, 2.0), numbers.between(0.5, 2.0)];
        let (mut world, ball) = into_a_corner(1.0, 1.0 + apart, speeds);
        let mut tape = Tape::start(&world).unwrap();
        match tape.step(&mut world, 3.0) {
            Ok(()) => {
                // Rounding of places of the order of 1.
                let interval = tape.margin().interval;
                assert!((interval - apart).abs() < 1e-14, "{case}: {interval} {apart}");
                assert_eq!(tape.margin().closest.unwrap().0, ball);
                // Whatever comes first, both components turn round.
                let by = tape.gradient(&[(ball, along(DVec3::ONE))]).unwrap().sphere(ball);
                let off = (by.position - vec(-1.0, -1.0, 1.0)).length();
                assert!(off < 1e-12, "{case}: {by:?}");
                right += 1;
            }
            Err(error) => {
                assert!(matches!(error, DerivativeError::Simultaneous { .. }), "{case}: {error}");
                refused += 1;
            }
        }
    }
    assert!(right > 30 && refused > 0, "{right} {refused}");
}
