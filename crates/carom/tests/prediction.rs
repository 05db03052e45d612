//! The path of a sphere, predicted without a step: it is what then happens, to the bit, while nothing else
//! interferes.

mod common;

use carom::{
    BodyPair, Boundary, Collider, Contact, DQuat, DVec3, Gravity, PathEnd, Pose, Rule, Settings,
    Shape, Sides, Sphere, SphereId, Spring, ViscousDrag, World,
};
use common::{Numbers, assert_close_vec, discrete, vec};

/// Steps the world through a path of it, in frames of `dt` \[s\], and demands the same bits.
fn check(world: &mut World, sphere: SphereId, horizon: f64, dt: f64) -> usize {
    let path = world.predict(sphere, horizon, usize::MAX).unwrap();
    assert_eq!(path.end, PathEnd::Horizon);
    let (start, mut impacts) = (world.time(), Vec::new());
    while world.time() + dt <= path.end_time() {
        let before = world.time();
        let report = world.step(dt).unwrap();
        let own = report.impacts.iter().filter(|impact| match impact.between {
            BodyPair::Spheres(first, second) => first == sphere || second == sphere,
            BodyPair::Collider { sphere: met, .. } => met == sphere,
        });
        impacts.extend(own.map(|impact| (before - start + impact.time, *impact)));
        let now = world.time();
        let found = world.sphere(sphere).unwrap();
        assert_eq!(path.position_at(now), Some(found.position), "at {now}");
        assert_eq!(path.velocity_at(now), Some(found.velocity), "at {now}");
    }
    assert!(path.impacts.len() >= impacts.len());
    for ((time, found), expected) in impacts.iter().zip(&path.impacts) {
        // Times since the start of a frame round differently.
        assert!((time - expected.time).abs() < 1e-14 * horizon);
        assert_eq!((found.between, found.impulse), (expected.between, expected.impulse));
        assert_eq!((found.point, found.normal), (expected.point, expected.normal));
    }
    impacts.len()
}

fn in_container(world: &mut World, edge: f64) {
    let shape = Shape::Container { size: DVec3::splat(edge), open: Sides::NONE };
    let walls = Collider::new(shape, Pose::at(DVec3::ZERO)).with_restitution(0.9);
    world.add_collider(walls).unwrap();
}

#[test]
fn a_ball_in_a_container_takes_the_path_that_was_predicted() {
    for drag in [0.0, 0.4] {
        let mut world = World::default();
        world.add_force(Gravity::new(vec(0.0, -9.81, 0.0))).unwrap();
        if drag > 0.0 {
            world.add_force(ViscousDrag::new(drag)).unwrap();
        }
        in_container(&mut world, 3.0);
        let ball = Sphere::new(vec(0.3, 0.2, -0.4), 0.1).with_velocity(vec(4.0, 3.0, -5.0));
        let ball = world.add_sphere(ball).unwrap();
        assert!(check(&mut world, ball, 2.0, 1.0 / 64.0) > 5);
        // Again from the middle of a flight.
        assert!(check(&mut world, ball, 1.0, 0.013) > 0);
    }
}

#[test]
fn a_ball_among_others_at_rest_takes_the_path_that_was_predicted_in_a_periodic_box_too() {
    for boundary in [Boundary::Open, Boundary::Periodic { size: DVec3::splat(6.0) }] {
        let mut world = World::new(Settings::default().with_boundary(boundary)).unwrap();
        let mut numbers = Numbers(3);
        let ball = Sphere::new(DVec3::ZERO, 0.15).with_velocity(vec(7.0, 2.0, 1.0));
        let ball = world.add_sphere(ball).unwrap();
        for _ in 0..120 {
            let sphere = Sphere::new(3.0 * numbers.vector(), 0.2).with_mass(1e4);
            if world.overlapping(sphere.position, 0.25, &Default::default()).unwrap().is_empty() {
                world.add_sphere(sphere).unwrap();
            }
        }
        if boundary == Boundary::Open {
            in_container(&mut world, 6.5);
        }
        // Those that it strikes are so heavy that they come to no other within the time.
        let path = world.predict(ball, 10.0, 8).unwrap();
        assert_eq!((path.end, path.impacts.len()), (PathEnd::Impacts, 8));
        let horizon = path.impacts[7].time * 0.999;
        assert!(check(&mut world, ball, horizon, horizon / 17.0) >= 7);
    }
}

#[test]
fn a_ball_is_met_by_others_that_come_from_far() {
    let mut world = World::default();
    let ball = world.add_sphere(Sphere::new(DVec3::ZERO, 0.1)).unwrap();
    let mut numbers = Numbers(5);
    // These are between, and are passed on the way: others keep to their flights.
    for _ in 0..200 {
        let place = numbers.vector() * 4.0 + vec(20.0, 0.0, 0.0);
        world.add_sphere(Sphere::new(place, 0.05)).unwrap();
    }
    let comes = Sphere::new(vec(60.0, 0.0, 0.0), 0.1).with_velocity(vec(-10.0, 0.0, 0.0));
    let comes = world.add_sphere(comes).unwrap();
    let path = world.predict(ball, 10.0, 1).unwrap();
    assert_eq!(path.impacts[0].between, BodyPair::Spheres(ball, comes));
    // 59.8 m at 10 m/s.
    assert!((path.impacts[0].time - 5.98).abs() < 1e-13);
    assert_eq!(path.velocity_at(path.end_time()), Some(vec(-10.0, 0.0, 0.0)));
}

#[test]
fn a_ball_at_rest_and_one_that_slides_keep_to_their_paths() {
    let mut world = World::default();
    world.add_force(Gravity::new(vec(0.0, -9.81, 0.0))).unwrap();
    let slope = DQuat::from_rotation_z(0.3);
    let slope = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO).rotated(slope));
    world.add_collider(slope.clone().with_restitution(0.0)).unwrap();
    let up = slope.pose.rotation * DVec3::Y;
    let ball = world.add_sphere(Sphere::new(0.5 * up, 0.5)).unwrap();
    world.step(0.1).unwrap();
    check(&mut world, ball, 1.0, 0.06);
}

#[test]
fn a_prediction_changes_nothing() {
    let mut world = World::default();
    in_container(&mut world, 3.0);
    let mut numbers = Numbers(9);
    let add =
        |_| world.add_sphere(Sphere::new(numbers.vector(), 0.05).with_velocity(numbers.vector()));
    let ids: Vec<_> = (0..20).map(add).map(Result::unwrap).collect();
    let (mut other, before) = (world.clone(), world.state_hash());
    for id in ids {
        world.predict(id, 2.0, 5).unwrap();
    }
    assert_eq!(world.state_hash(), before);
    for _ in 0..20 {
        world.step(0.1).unwrap();
        other.step(0.1).unwrap();
    }
    assert_eq!(world.state_hash(), other.state_hash());
}

#[test]
fn under_other_rules_the_path_is_that_of_exact() {
    let rules = [discrete(), Rule::Contact(Contact::default())];
    for rule in rules {
        let mut world = World::new(Settings::default().with_rule(rule)).unwrap();
        world.add_force(Gravity::new(vec(0.0, -8.0, 0.0))).unwrap();
        world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO))).unwrap();
        let ball = world.add_sphere(Sphere::new(vec(0.0, 2.0, 0.0), 1.0)).unwrap();
        let path = world.predict(ball, 1.0, 9).unwrap();
        assert_eq!(path.impacts.len(), 1);
        assert_eq!(path.impacts[0].time, 0.5);
        assert_close_vec(path.position_at(1.0).unwrap(), vec(0.0, 2.0, 0.0), 1e-14);
    }
}

#[test]
fn a_wall_that_moves_is_met_where_it_will_be() {
    let mut world = World::default();
    let facing = DQuat::from_rotation_arc(DVec3::Y, DVec3::NEG_X);
    let wall = Collider::new(Shape::HalfSpace, Pose::at(vec(3.0, 0.0, 0.0)).rotated(facing));
    world.add_collider(wall.moving(DVec3::NEG_X, DVec3::ZERO)).unwrap();
    let ball = world.add_sphere(Sphere::new(DVec3::ZERO, 1.0).with_velocity(DVec3::X)).unwrap();
    let path = world.predict(ball, 5.0, 1).unwrap();
    assert!((path.impacts[0].time - 1.0).abs() < 1e-15);
    // A few roundings of the speeds.
    assert_close_vec(path.velocity_at(path.end_time()).unwrap(), vec(-3.0, 0.0, 0.0), 1e-14);
}

#[test]
fn what_has_no_closed_form_is_refused() {
    let mut world = World::default();
    let one = world.add_sphere(Sphere::new(DVec3::ZERO, 0.1)).unwrap();
    let other = world.add_sphere(Sphere::new(DVec3::X, 0.1)).unwrap();
    assert!(world.predict(one, -1.0, 1).unwrap_err().to_string().contains("`horizon`"));
    assert!(world.predict(SphereId::from_number(7), 1.0, 1).is_err());
    world.add_spring(Spring::between(one, other, 1.0).with_stiffness(9.0)).unwrap();
    let error = world.predict(one, 1.0, 1).unwrap_err().to_string();
    assert!(error.starts_with("query: `path` must be such that"), "{error}");
}

#[test]
fn a_ball_in_a_bowl_takes_the_path_that_was_predicted() {
    for friction in [0.0, 0.3] {
        let mut world = World::default();
        world.add_force(Gravity::new(vec(0.0, -9.81, 0.0))).unwrap();
        let bowl = Shape::Bowl { radius: 1.0, opening: 1.0 };
        let bowl = Collider::new(bowl, Pose::at(DVec3::ZERO)).with_restitution(0.5);
        world.add_collider(bowl.with_friction(friction)).unwrap();
        let ball = Sphere::new(vec(0.5, 0.2, 0.1), 0.1).with_velocity(vec(0.0, 0.0, 1.0));
        let ball = world.add_sphere(ball).unwrap();
        let path = world.predict(ball, 3.0, usize::MAX).unwrap();
        assert_eq!(path.end, PathEnd::Horizon);
        assert!(path.impacts.len() > 3);
        for _ in 0..192 {
            world.step(1.0 / 64.0).unwrap();
            let found = world.sphere(ball).unwrap();
            let [position, velocity] =
                [path.position_at(world.time()), path.velocity_at(world.time())];
            // A frame removes rounding from the gap.
            assert_close_vec(position.unwrap(), found.position, 1e-14);
            assert_close_vec(velocity.unwrap(), found.velocity, 1e-13);
        }
    }
}
