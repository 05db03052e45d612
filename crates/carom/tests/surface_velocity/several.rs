//! Belts beside floors, walls and each other.

use carom::{Collider, Contact, DQuat, DVec3, Exact, Gravity, Pose, Shape, Sphere, World};

use super::common::{G, assert_close, vec, world};
use super::{MU, RADIUS, advance, ball, ball_at, belt, contact, on};

/// A tile of 4 m along x whose top is y = 0, about this place along x.
fn tile(x: f64, speed: f64) -> Collider {
    let size = vec(4.0, 1.0, 2.0);
    belt(speed).with_shape(Shape::Box { size }).with_pose(Pose::at(vec(x, -0.5, 0.0)))
}

#[test]
fn a_ball_that_rolls_over_a_belt_gains_two_sevenths_of_its_speed_and_loses_them_after_it() {
    for (rule, tolerance) in [(Exact::default().into(), 1e-11), (contact(), 1e-3)] {
        let mut world = on(rule, tile(-4.0, 0.0));
        world.add_collider(tile(0.0, 0.7)).unwrap();
        world.add_collider(tile(4.0, 0.0)).unwrap();
        let rolling = vec(0.0, 0.0, -2.0 / RADIUS);
        let sphere = ball_at(-3.0).with_velocity(2.0 * DVec3::X).with_angular_velocity(rolling);
        let id = world.add_sphere(sphere).unwrap();
        advance(&mut world, 0.4);
        assert_close(ball(&world, id).velocity.x, 2.0, tolerance);
        // On the belt from 0.5 s on, until about 2.3 s.
        advance(&mut world, 1.5);
        assert_close(ball(&world, id).velocity.x, 2.0 + 2.0 / 7.0 * 0.7, tolerance);
        advance(&mut world, 3.0);
        assert_close(ball(&world, id).velocity.x, 2.0, tolerance);
        assert_close(ball(&world, id).angular_velocity.z, -2.0 / RADIUS, 100.0 * tolerance);
        assert_close(ball(&world, id).position.y, RADIUS, 1e-3 * RADIUS);
    }
}

/// A ball in a groove of two planes of 45 degrees whose belts run with these speeds down the left plane and up the right.
fn in_a_groove(rule: impl Into<carom::Rule>, speeds: [f64; 2]) -> (World, carom::SphereId) {
    let mut world = world(rule);
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let eighth = std::f64::consts::FRAC_PI_4;
    // Local x is down to the right on the left plane, and up to the right on the right one.
    for (angle, speed) in [(-eighth, speeds[0]), (eighth, speeds[1])] {
        let pose = Pose::at(DVec3::ZERO).rotated(DQuat::from_rotation_z(angle));
        world.add_collider(belt(speed).with_pose(pose)).unwrap();
    }
    let height = RADIUS * 2.0f64.sqrt();
    let id = world.add_sphere(Sphere::new(vec(0.0, height, 0.0), RADIUS).with_restitution(0.0));
    (world, id.unwrap())
}

#[test]
fn a_ball_between_belts_of_opposite_directions_spins_in_place() {
    for rule in [Exact::default().into(), contact()] {
        let (mut world, id) = in_a_groove(rule, [0.4, 0.4]);
        advance(&mut world, 4.0);
        let Sphere { position, velocity, angular_velocity, .. } = ball(&world, id);
        assert!(velocity.length() < 1e-3, "{rule:?} {velocity}");
        assert_close(position.x, 0.0, 1e-2 * RADIUS);
        assert_close(angular_velocity.z, 0.4 / RADIUS, 1e-2 * 0.4 / RADIUS);
    }
}

#[test]
fn a_slow_belt_carries_a_ball_that_would_sleep_on_a_floor() {
    // 1 mm/s is below the speed at which a ball of 10 cm may sleep.
    let mut world = on(Contact::default(), belt(1e-3));
    let id = world.add_sphere(ball_at(0.0)).unwrap();
    advance(&mut world, 20.0);
    assert_close(ball(&world, id).position.x, 20.0 * 2.0 / 7.0 * 1e-3, 1e-4);
}

#[test]
fn a_ball_that_a_belt_presses_to_a_wall_keeps_spinning() {
    // It leans on the wall and turns with the belt if the wall is smooth.
    for rule in [Exact::default().into(), contact()] {
        let mut world = on(rule, belt(0.5));
        let wall = Shape::Box { size: vec(0.2, 1.0, 1.0) };
        let wall = Collider::new(wall, Pose::at(vec(0.3, 0.5, 0.0))).with_friction(0.0);
        world.add_collider(wall.with_restitution(0.0)).unwrap();
        let sphere = ball_at(0.0).with_friction(MU);
        let id = world.add_sphere(sphere).unwrap();
        advance(&mut world, 10.0);
        let Sphere { position, velocity, angular_velocity, .. } = ball(&world, id);
        if rule == contact() {
            // The last of some sweeps leaves about 1 mm/s away from the wall.
            assert!(velocity.length() < 2e-3, "{velocity}");
            assert_close(angular_velocity.z, 5.0, 2e-2);
        } else {
            assert_close(position.x, 0.1, 1e-12);
            assert_close(velocity.length(), 0.0, 1e-12);
            assert_close(angular_velocity.z, 5.0, 1e-11);
        }
    }
}
