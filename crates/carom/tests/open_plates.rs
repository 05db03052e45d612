//! Rectangles and discs are open from behind: spheres pass them from there, and may turn back on the way.

use carom::{
    Bisect, Collider, Contact, DVec3, Discrete, Exact, Gravity, Pose, Rule, Settings, Shape,
    Sphere, Spring, World,
};

const GRAVITY: f64 = 10.0;
const RADIUS: f64 = 0.1;
const FRAME: f64 = 1.0 / 64.0;

/// The rules that keep spheres out of what they meet from the front.
fn rules() -> [Settings; 2] {
    let settings = Settings::default();
    [settings.with_rule(Exact::default()), settings.with_rule(Contact::default())]
}

fn shapes(size: f64) -> [Shape; 2] {
    let rectangle = Shape::Rectangle { size_x: 2.0 * size, size_z: 2.0 * size };
    [rectangle, Shape::Disc { radius: size }]
}

/// A world of this size with gravity and these balls, and the plate if there is one.
fn world(settings: Settings, size: f64, plate: Option<Collider>, balls: &[Sphere]) -> World {
    let mut world = World::new(settings).unwrap();
    world.add_force(Gravity::new(-GRAVITY * size * DVec3::Y)).unwrap();
    if let Some(plate) = plate {
        world.add_collider(plate).unwrap();
    }
    for ball in balls {
        world.add_sphere(*ball).unwrap();
    }
    world
}

/// A ball that is thrown up from below and turns back at a `height` of its centre.
fn thrown_to(height: f64, size: f64) -> Sphere {
    let from = -0.5;
    let speed = (2.0 * GRAVITY * (height - from)).sqrt();
    Sphere::new(from * size * DVec3::Y, RADIUS * size).with_velocity(speed * size * DVec3::Y)
}

/// Asserts that a world moves for two seconds as it does without its plate, to the bit, without an impact; and without
/// an overlap, under rules that let no ball sink in from the front.
fn assert_passes(mut with: World, mut without: World, what: &str) {
    let keeps_out = matches!(with.settings().rule, Rule::Exact(_) | Rule::Contact(_));
    for _ in 0..128 {
        assert!(with.step(FRAME).unwrap().impacts.is_empty(), "{what}");
        without.step(FRAME).unwrap();
        assert!(!keeps_out || with.overlaps(0.0).is_empty(), "{what}: {:?}", with.overlaps(0.0));
    }
    assert_eq!(with.spheres().positions(), without.spheres().positions(), "{what}");
    assert_eq!(with.spheres().velocities(), without.spheres().velocities(), "{what}");
}

#[test]
fn a_ball_that_turns_back_in_a_plate_falls_through_as_if_there_were_none() {
    for size in [1.0, libm::ldexp(1.0, -20), libm::ldexp(1.0, 20)] {
        for (settings, shape) in rules().into_iter().flat_map(|it| shapes(size).map(|s| (it, s))) {
            for height in [-0.05, 0.0, 0.03, 0.05, 0.09, 0.099] {
                let plate = Collider::new(shape.clone(), Pose::at(DVec3::ZERO));
                let ball = [thrown_to(height, size)];
                let both = [Some(plate), None].map(|it| world(settings, size, it, &ball));
                let [with, without] = both;
                let what = format!("{:?}, {shape:?}, height {height}", settings.rule);
                assert_passes(with, without, &what);
            }
        }
    }
}

#[test]
fn under_rules_of_frames_a_ball_turns_back_in_a_plate_as_if_there_were_none() {
    let rules: [Rule; 2] = [Discrete::default().into(), Bisect::default().into()];
    for (rule, shape) in rules.into_iter().flat_map(|it| shapes(1.0).map(|s| (it, s))) {
        for height in [-0.05, 0.0, 0.05, 0.09] {
            let plate = Collider::new(shape.clone(), Pose::at(DVec3::ZERO));
            let settings = Settings::default().with_rule(rule);
            let ball = [thrown_to(height, 1.0)];
            let [with, without] = [Some(plate), None].map(|it| world(settings, 1.0, it, &ball));
            assert_passes(with, without, &format!("{rule:?}, {shape:?}, height {height}"));
        }
    }
}

#[test]
fn a_ball_that_passes_a_plate_lands_on_its_front() {
    for settings in rules() {
        for shape in shapes(1.0) {
            let plate = Collider::new(shape, Pose::at(DVec3::ZERO)).with_restitution(0.0);
            let mut world = world(settings, 1.0, Some(plate), &[thrown_to(0.3, 1.0)]);
            for _ in 0..256 {
                world.step(FRAME).unwrap();
            }
            let height = world.spheres().positions()[0].y;
            // `contact` leaves overlaps of 1/2000 of the radius.
            assert!((height - RADIUS).abs() <= 1e-3 * RADIUS, "{:?}: {height}", settings.rule);
        }
    }
}

#[test]
fn a_ball_that_turns_back_in_a_plate_that_rises_falls_through() {
    for (settings, shape) in rules().into_iter().flat_map(|it| shapes(1.0).map(|s| (it, s))) {
        let plate =
            Collider::new(shape, Pose::at(-0.1 * DVec3::Y)).moving(0.25 * DVec3::Y, DVec3::ZERO);
        let ball = [thrown_to(0.05, 1.0)];
        let [with, without] = [Some(plate), None].map(|it| world(settings, 1.0, it, &ball));
        assert_passes(with, without, &format!("{:?}", settings.rule));
    }
}

#[test]
fn balls_on_a_spring_turn_back_in_a_plate_as_without_one() {
    for settings in rules() {
        let balls = [-0.2, 0.2].map(|x| {
            let ball = thrown_to(0.05, 1.0);
            Sphere::new(ball.position + x * DVec3::X, RADIUS).with_velocity(ball.velocity)
        });
        let both = shapes(1.0).map(Some).into_iter().chain([None]).map(|shape| {
            let plate = shape.map(|shape| Collider::new(shape, Pose::at(DVec3::ZERO)));
            let mut world = world(settings, 1.0, plate, &balls);
            let [first, second] = [0, 1].map(|number| world.spheres().ids()[number]);
            let spring = Spring::between(first, second, 0.3).with_stiffness(200.0);
            world.add_spring(spring).unwrap();
            for _ in 0..64 {
                world.step(FRAME).unwrap();
            }
            world.spheres().positions().to_vec()
        });
        let both: Vec<_> = both.collect();
        for with in &both[..2] {
            for (place, free) in with.iter().zip(&both[2]) {
                // Forces between spheres are evaluated at steps that the plate does not change.
                assert!((*place - *free).length() <= 1e-12, "{:?}", settings.rule);
            }
        }
    }
}

#[test]
fn a_ball_struck_within_a_plate_goes_back_through_it() {
    for settings in rules() {
        for shape in shapes(1.0) {
            let plate = Collider::new(shape, Pose::at(DVec3::ZERO));
            // They meet while the lower one is within the plate, its centre in front.
            let above = Sphere::new(0.5 * DVec3::Y, RADIUS).with_velocity(-2.0 * DVec3::Y);
            let balls = [thrown_to(0.2, 1.0), above];
            let [mut with, mut without] =
                [Some(plate), None].map(|it| world(settings, 1.0, it, &balls));
            for _ in 0..64 {
                with.step(FRAME).unwrap();
                without.step(FRAME).unwrap();
            }
            let lower = with.spheres().positions()[0].y;
            assert!(lower < -RADIUS, "{:?}: {lower}", settings.rule);
            assert_eq!(with.spheres().positions()[0], without.spheres().positions()[0]);
        }
    }
}
