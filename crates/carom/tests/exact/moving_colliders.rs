//! Colliders that move: they throw, carry and turn spheres.

use carom::{Collider, DQuat, DVec3, Pose, Shape, Sphere};

use crate::common::{assert_close, assert_close_vec, vec};
use crate::{exact, run, under_gravity};

#[test]
fn a_moving_wall_throws_a_ball_at_twice_its_speed() {
    let mut world = exact();
    let wall = Shape::Rectangle { size_x: 4.0, size_z: 4.0 };
    let pose = Pose::at(vec(-2.0, 0.0, 0.0)).rotated(DQuat::from_rotation_arc(DVec3::Y, DVec3::X));
    let wall = Collider::new(wall, pose).moving(vec(3.0, 0.0, 0.0), DVec3::ZERO);
    let wall = world.add_collider(wall).unwrap();
    let ball = world.add_sphere(Sphere::new(DVec3::ZERO, 0.5)).unwrap();
    let mut hits = Vec::new();
    for _ in 0..60 {
        let start = world.time();
        hits.extend(world.step(1.0 / 60.0).unwrap().impacts.iter().map(|it| start + it.time));
    }
    assert_eq!(hits.len(), 1);
    // The wall's position is added up over frames.
    assert_close(hits[0], 0.5, 1e-14);
    assert_close_vec(world.sphere(ball).unwrap().velocity, vec(6.0, 0.0, 0.0), 1e-14);
    assert_close(world.collider(wall).unwrap().pose.position.x, 1.0, 1e-14);
}

#[test]
fn a_turning_paddle_hits_with_the_speed_of_its_surface() {
    let mut world = exact();
    let paddle = Shape::Rectangle { size_x: 4.0, size_z: 1.0 };
    let spin = vec(0.0, 0.0, 2.0);
    let paddle = Collider::new(paddle, Pose::at(DVec3::ZERO)).moving(DVec3::ZERO, spin);
    world.add_collider(paddle).unwrap();
    // It sweeps upwards on the side of positive x; the ball waits above.
    let ball = world.add_sphere(Sphere::new(vec(1.0, 0.8, 0.0), 0.1)).unwrap();
    let mut impacts = Vec::new();
    for _ in 0..40 {
        impacts.extend(world.step(0.01).unwrap().impacts.clone());
    }
    assert_eq!(impacts.len(), 1);
    let arm = (1.0f64 + 0.64 - 0.01).sqrt();
    // Where the ball touches, the paddle moves along its normal at w times the arm.
    assert_close(impacts[0].approach_speed, 2.0 * arm, 1e-9);
    assert_close(world.sphere(ball).unwrap().velocity.length(), 4.0 * arm, 1e-9);
}

#[test]
fn a_ball_rides_on_a_platform_that_rises() {
    let mut world = under_gravity();
    let platform = Shape::Rectangle { size_x: 2.0, size_z: 2.0 };
    let platform = Collider::new(platform, Pose::at(DVec3::ZERO)).with_restitution(0.0);
    world.add_collider(platform.moving(vec(0.0, 1.5, 0.0), DVec3::ZERO)).unwrap();
    let ball = Sphere::new(vec(0.0, 0.25, 0.0), 0.25).with_velocity(vec(0.0, 1.5, 0.0));
    let ball = world.add_sphere(ball).unwrap();
    run(&mut world, 1.0 / 60.0, 120);
    let end = world.sphere(ball).unwrap();
    assert_close(end.position.y, 0.25 + 1.5 * world.time(), 1e-12);
    assert_close(end.velocity.y, 1.5, 1e-12);
}

#[test]
fn a_moving_trigger_reports_and_lets_pass() {
    let mut world = exact();
    let gate = Collider::new(Shape::Sphere { radius: 1.0 }, Pose::at(vec(3.0, 0.0, 0.0)));
    world.add_collider(gate.as_trigger().moving(vec(-1.0, 0.0, 0.0), DVec3::ZERO)).unwrap();
    let ball = Sphere::new(DVec3::ZERO, 0.5).with_velocity(DVec3::X);
    let ball = world.add_sphere(ball).unwrap();
    let (mut impacts, mut inside) = (0, 0);
    for _ in 0..40 {
        let report = world.step(0.1).unwrap();
        impacts += report.impacts.len();
        inside += report.triggers.len();
    }
    assert_eq!(impacts, 0);
    // They touch from 0.75 to 2.25 s.
    assert_eq!(inside, 15);
    assert_eq!(world.sphere(ball).unwrap().velocity, DVec3::X);
}

#[test]
fn a_ball_slides_on_a_plate_that_turns_in_its_own_plane() {
    let mut world = under_gravity();
    let plate = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_restitution(0.0);
    world.add_collider(plate.moving(DVec3::ZERO, vec(0.0, 3.0, 0.0))).unwrap();
    let ball = Sphere::new(vec(1.0, 0.25, 0.0), 0.25).with_velocity(vec(0.0, 0.0, 1.0));
    let ball = world.add_sphere(ball).unwrap();
    // Without friction the plate may turn as it likes.
    assert_eq!(run(&mut world, 0.05, 40), 0);
    let end = world.sphere(ball).unwrap();
    assert_close_vec(end.position, vec(1.0, 0.25, 2.0), 1e-12);
    assert_close_vec(end.velocity, vec(0.0, 0.0, 1.0), 1e-12);
}

#[test]
fn a_ball_that_slides_on_a_floor_stays_on_it_however_slowly_that_turns() {
    for exponent in 0..20 {
        let mut world = under_gravity();
        let rate = libm::pow(10.0, -f64::from(exponent));
        let floor = Shape::Rectangle { size_x: 10.0, size_z: 10.0 };
        let floor = Collider::new(floor, Pose::at(DVec3::ZERO)).with_restitution(0.0);
        let floor = world.add_collider(floor.moving(DVec3::ZERO, vec(0.0, 0.0, rate))).unwrap();
        let ball = Sphere::new(vec(2.0, 0.5, 0.5), 0.5).with_velocity(vec(-2.0, 0.0, 0.0));
        let ball = world.add_sphere(ball).unwrap();
        world.step(1.0 / 60.0).unwrap();
        let into_floor = world.collider(floor).unwrap().pose.rotation.inverse();
        let height = (into_floor * world.sphere(ball).unwrap().position).y;
        // Turning surfaces are followed to 1e-10 of the radius of the curve, here some 10 m.
        assert_close(height, 0.5, 1e-8);
    }
}

#[test]
fn a_ball_that_slides_over_the_edge_of_a_turning_box_goes_no_farther_than_its_speed_takes_it() {
    // In the edge, two faces of the box have normals that differ by rounding only.
    let frame = 1.0 / 60.0;
    let turned = |angle: f64| {
        let (sine, cosine) = libm::sincos(0.5 * angle);
        DQuat::from_xyzw(0.0, 0.0, sine, cosine)
    };
    let (before, after) = (0.0931, 0.0931 - 0.1745 * frame);
    for step in 0..100 {
        let mut world = under_gravity();
        let mut add = |shape, place: DVec3, restitution| {
            let position = turned(before) * place;
            let velocity = (turned(after) * place - position) / frame;
            let spin = vec(0.0, 0.0, (after - before) / frame);
            let pose = Pose::at(position).rotated(turned(before));
            let collider = Collider::new(shape, pose).with_restitution(restitution);
            world.add_collider(collider.moving(velocity, spin)).unwrap();
        };
        let floor = Shape::Rectangle { size_x: 10.0, size_z: 10.0 };
        add(floor, vec(0.0, -0.2672, 0.0), 0.0);
        let wall = Shape::Box { size: vec(1.665, 1.6, 0.25) };
        add(wall, vec(-2.4, 0.4, 1.68), 0.2);
        let place = turned(before) * vec(-1.0675, 0.2328, 1.8 + 5e-5 * f64::from(step));
        let velocity = turned(before) * vec(0.04, 0.186, 0.437);
        let ball = Sphere::new(place, 0.5).with_velocity(velocity);
        let ball = world.add_sphere(ball).unwrap();
        world.step(frame).unwrap();
        let way = world.sphere(ball).unwrap().position.distance(place);
        assert!(way < 0.6 * frame, "{way} m from {place}");
    }
}
