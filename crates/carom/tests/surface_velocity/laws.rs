//! Symmetries of belts: other frames of reference, other units, other shapes with the same motion.

use carom::{Collider, DVec3, Exact, Gravity, Pose, Rule, Shape, Sphere, World};

use super::common::{G, assert_close, vec, world};
use super::{MU, RADIUS, advance, ball, ball_at, belt, contact, on};

#[test]
fn a_belt_seen_from_its_material_is_a_floor() {
    // The floor moves backwards and its material forwards: it is at rest.
    let speed = 0.8;
    for (rule, tolerance) in [(Exact::default().into(), 2e-3), (contact(), 1e-9)] {
        let run = |floor: Collider, velocity: f64| {
            let mut world = on(rule, floor);
            let id = world.add_sphere(ball_at(0.0).with_velocity(velocity * DVec3::X)).unwrap();
            advance(&mut world, 1.0);
            ball(&world, id)
        };
        let fixed = run(belt(0.0), 0.6);
        let moved = run(belt(speed).moving(-speed * DVec3::X, DVec3::ZERO), 0.6);
        assert_close(moved.velocity.x, fixed.velocity.x, tolerance);
        assert_close(moved.position.x, fixed.position.x, tolerance);
    }
}

#[test]
fn a_belt_in_a_moving_frame_is_the_same_belt() {
    let speed = 1.0;
    for rule in [Exact::default().into(), contact()] {
        let run = |beside: f64| {
            let floor = belt(speed).moving(beside * DVec3::X, DVec3::ZERO);
            let mut world = on(rule, floor);
            let id = world.add_sphere(ball_at(0.0).with_velocity(beside * DVec3::X)).unwrap();
            advance(&mut world, 1.0);
            ball(&world, id)
        };
        let (still, moved) = (run(0.0), run(0.5));
        // A floor that moves is stepped under `exact`.
        assert_close(moved.velocity.x - 0.5, still.velocity.x, 2e-3);
        assert_close(moved.position.x - 0.5, still.position.x, 2e-3);
    }
}

#[test]
fn units_do_not_matter() {
    for rule in [Exact::default().into(), contact()] {
        let run = |scale: f64| {
            let mut world = world(rule);
            world.add_force(Gravity::new(vec(0.0, -G * scale, 0.0))).unwrap();
            world.add_collider(belt(scale)).unwrap();
            let sphere = Sphere::new(scale * vec(0.0, 0.3, 0.0), scale * RADIUS);
            let id = world.add_sphere(sphere.with_restitution(0.4)).unwrap();
            advance(&mut world, 1.0);
            ball(&world, id)
        };
        let one = run(1.0);
        for scale in [2f64.powi(-20), 2f64.powi(20)] {
            let other = run(scale);
            assert_eq!(other.position, scale * one.position, "{rule:?} {scale}");
            assert_eq!(other.velocity, scale * one.velocity, "{rule:?} {scale}");
            assert_eq!(other.angular_velocity, one.angular_velocity, "{rule:?} {scale}");
        }
    }
}

/// A ball that falls onto the top of a shape, after a tenth of a second.
fn dropped(rule: Rule, solid: Collider) -> Sphere {
    let mut world = world(rule);
    let solid = solid.with_friction(MU).with_restitution(0.5);
    world.add_collider(solid).unwrap();
    let sphere = Sphere::new(vec(0.0, 1.15, 0.0), RADIUS).with_velocity(vec(0.0, -2.0, 0.0));
    let id = world.add_sphere(sphere.with_restitution(0.5)).unwrap();
    advance(&mut world, 0.1);
    ball(&world, id)
}

#[test]
fn a_belt_round_a_drum_strikes_as_the_drum_that_turns() {
    // The top of a drum of radius 1 m that turns about z moves by -w.
    let upright = carom::DQuat::from_rotation_x(std::f64::consts::FRAC_PI_2);
    let shapes = [
        (Shape::Cylinder { radius: 1.0, height: 2.0 }, upright),
        (Shape::Sphere { radius: 1.0 }, carom::DQuat::IDENTITY),
    ];
    for rule in [Exact::default().into(), contact()] {
        for (shape, rotation) in shapes.clone() {
            let pose = Pose::at(DVec3::ZERO).rotated(rotation);
            for spin in [0.5, -4.0] {
                let drum = Collider::new(shape.clone(), pose);
                let turning = dropped(rule, drum.clone().moving(DVec3::ZERO, spin * DVec3::Z));
                let belt = drum.with_surface_velocity(-spin * DVec3::X);
                // Local x is that of the world.
                let driven = dropped(rule, belt);
                assert!(driven.velocity.x * spin < 0.0, "{driven:?}");
                assert!((driven.velocity - turning.velocity).length() <= 1e-12);
                let turned = driven.angular_velocity - turning.angular_velocity;
                assert!(turned.length() <= 1e-11, "{rule:?} {turned}");
            }
        }
    }
}

#[test]
fn a_belt_up_a_slope_holds_a_ball_that_rolls_in_place() {
    // Rolling down an incline, a ball accelerates by 5/7 g sin a whatever the belt does once it rolls: so the speed at
    // which it starts up decides. It slides at first under mu g cos a > 7/2 of what rolling needs.
    let tilt: f64 = 0.2;
    let floor = belt(2.0);
    let mut world = World::default();
    world.add_force(Gravity::new(G * vec(-tilt.sin(), -tilt.cos(), 0.0))).unwrap();
    world.add_collider(floor).unwrap();
    let id = world.add_sphere(ball_at(0.0)).unwrap();
    let (push, pull) = (MU * G * tilt.cos(), G * tilt.sin());
    let rolls = 2.0 / (3.5 * push - pull);
    advance(&mut world, rolls + 0.5);
    let expected = (push - pull) * rolls - 5.0 / 7.0 * pull * 0.5;
    assert_close(ball(&world, id).velocity.x, expected, 1e-12);
    assert!(!world.was_stepped());
}
