//! What sleeps under the rule `contact`, and what only moves slowly.

use std::f64::consts::SQRT_2;

use carom::{
    Collider, Contact, DQuat, DVec3, Gravity, Pose, Settings, Shape, Sphere, SphereId, World,
};

const FRAME: f64 = 1.0 / 60.0;

/// A world under gravity \[m/s²\] with a rough floor, y = 0.
fn on_a_floor(gravity: DVec3) -> World {
    let settings = Settings::default().with_rule(Contact::default());
    let mut world = World::new(settings).unwrap();
    world.add_force(Gravity::new(gravity)).unwrap();
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_friction(0.5);
    world.add_collider(floor.with_restitution(0.0)).unwrap();
    world
}

fn ball(position: DVec3, radius: f64) -> Sphere {
    Sphere::new(position, radius).with_restitution(0.0).with_friction(0.5)
}

/// The acceleration of gravity on a slope that goes down towards x.
fn tilted(g: f64, degrees: f64) -> DVec3 {
    let angle = degrees.to_radians();
    g * DVec3::new(libm::sin(angle), -libm::cos(angle), 0.0)
}

#[test]
fn a_ball_rolls_down_the_gentlest_slope_with_five_sevenths_of_its_weight() {
    for (g, radius) in [(9.81, 0.1), (0.01, 0.1), (9.81, 1e-5), (9.81, 100.0)] {
        for degrees in [0.003, 0.3, 1.0, 3.0, 7.0] {
            let gravity = tilted(g, degrees);
            let mut world = on_a_floor(gravity);
            world.add_sphere(ball(radius * DVec3::Y, radius)).unwrap();
            let frames = 600;
            for _ in 0..frames {
                world.step(FRAME).unwrap();
            }
            let expected = 5.0 / 7.0 * gravity.x * f64::from(frames) * FRAME;
            let speed = world.spheres().velocities()[0].x;
            // Rounding of 4,800 sub-steps; but for the ball's fall into the slop at the start.
            assert!(
                (speed / expected - 1.0).abs() < 1e-3,
                "{degrees} degrees, g {g}, r {radius}: {speed} m/s, not {expected}"
            );
            assert_eq!(world.report().contact_account.asleep, 0);
        }
    }
}

#[test]
fn a_ball_that_rolls_uphill_turns_and_comes_back_with_its_speed() {
    for (degrees, speed) in [(0.3, 0.05), (1.0, 0.2), (3.0, 0.5)] {
        let gravity = tilted(9.81, degrees);
        let mut world = on_a_floor(gravity);
        let spin = DVec3::new(0.0, 0.0, speed / 0.1);
        let ball = ball(0.1 * DVec3::Y, 0.1).with_velocity(-speed * DVec3::X);
        world.add_sphere(ball.with_angular_velocity(spin)).unwrap();
        let time = 2.0 * speed / (5.0 / 7.0 * gravity.x);
        let frames = (time / FRAME).round();
        for _ in 0..frames as u32 {
            world.step(time / frames).unwrap();
        }
        let back = world.spheres().velocities()[0].x;
        assert!((back / speed - 1.0).abs() < 1e-3, "{degrees} degrees: {back}, not {speed}");
    }
}

#[test]
fn a_ball_rolls_along_a_groove_however_slowly() {
    // Two planes at a right angle: the ball turns about an axis at r / sqrt(2) above where it touches them.
    let speed = 0.015;
    let settings = Settings::default().with_rule(Contact::default());
    let mut world = World::new(settings).unwrap();
    world.add_force(Gravity::new(-9.81 * DVec3::Y)).unwrap();
    for side in [-1.0, 1.0] {
        let rotation = DQuat::from_rotation_z(side * std::f64::consts::FRAC_PI_4);
        let pose = Pose { rotation, ..Pose::at(DVec3::ZERO) };
        let wall = Collider::new(Shape::HalfSpace, pose).with_restitution(0.0).with_friction(0.5);
        world.add_collider(wall).unwrap();
    }
    let ball = ball(0.1 * SQRT_2 * DVec3::Y, 0.1).with_velocity(speed * DVec3::Z);
    let spin = DVec3::new(speed / 0.1 * SQRT_2, 0.0, 0.0);
    world.add_sphere(ball.with_angular_velocity(spin)).unwrap();
    for _ in 0..600 {
        world.step(FRAME).unwrap();
    }
    let velocity = world.spheres().velocities()[0];
    assert!((velocity.z / speed - 1.0).abs() < 1e-3, "{velocity}");
}

#[test]
fn a_ball_at_rest_sleeps_and_two_that_lean_on_each_other_roll_down_together() {
    let mut world = on_a_floor(-9.81 * DVec3::Y);
    let id = world.add_sphere(ball(0.1 * DVec3::Y, 0.1)).unwrap();
    for _ in 0..90 {
        world.step(FRAME).unwrap();
    }
    assert_eq!(world.report().contact_account.asleep, 1);
    assert_eq!(world.sphere(id).unwrap().velocity, DVec3::ZERO);

    let mut world = on_a_floor(tilted(9.81, 0.3));
    for x in [0.0, 0.2] {
        world.add_sphere(ball(DVec3::new(x, 0.1, 0.0), 0.1).with_friction(0.0)).unwrap();
    }
    for _ in 0..300 {
        world.step(FRAME).unwrap();
    }
    assert_eq!(world.report().contact_account.asleep, 0);
    let speed = |number| world.sphere(SphereId::from_number(number)).unwrap().velocity.x;
    assert!(speed(0) > 0.1 && speed(1) > 0.1, "{} {}", speed(0), speed(1));
}

#[test]
fn a_ball_falls_asleep_after_a_time_that_goes_as_the_root_of_radius_over_gravity() {
    let frames_awake = |radius: f64, g: f64| {
        let mut world = on_a_floor(-g * DVec3::Y);
        world.add_sphere(ball(radius * DVec3::Y, radius)).unwrap();
        let frame = FRAME * (radius / 0.1 * 9.81 / g).sqrt();
        (1..1000).find(|_| world.step(frame).unwrap().contact_account.asleep == 1)
    };
    let usual = frames_awake(0.1, 9.81);
    assert!(usual.is_some());
    for (radius, g) in [(0.4, 9.81), (0.1, 0.0981), (0.1 * 2f64.powi(-20), 9.81)] {
        assert_eq!(frames_awake(radius, g), usual, "{radius} m, {g} m/s²");
    }
}
