//! The energy account of belts: their work is that of colliders, what slips is lost in contacts.

use carom::{DVec3, EnergyAccount, Exact, Pose, Shape, Sides, Sphere};

use super::common::{G, Numbers, account_of_run, assert_close, vec};
use super::{MU, RADIUS, ROUNDING, advance, ball_at, belt, contact, on};

const FRAME: f64 = 1.0 / 60.0;

#[test]
fn a_belt_does_the_work_of_friction_at_its_speed() {
    let (speed, mass) = (1.0, 2.0);
    let end = 2.0 * speed / (7.0 * MU * G);
    // Force times way of the belt; half of the slip is lost on the mean.
    let work = MU * mass * G * speed * end;
    for (rule, tolerance) in [(Exact::default().into(), ROUNDING), (contact(), 1e-9)] {
        let mut world = on(rule, belt(speed));
        world.add_sphere(ball_at(0.0).with_mass(mass)).unwrap();
        let (account, rest) = account_of_run(&mut world, 60, FRAME);
        assert_close(account.colliders, work, tolerance);
        assert_close(account.contacts, -0.5 * work, 10.0 * tolerance);
        assert_close(rest, 0.0, ROUNDING);
    }
}

#[test]
fn an_impact_on_a_belt_is_accounted_for() {
    for rule in [Exact::default().into(), contact()] {
        let mut world = on(rule, belt(3.0).with_restitution(0.6));
        let ball = ball_at(0.0).with_position(vec(0.0, 0.5, 0.0)).with_restitution(0.6);
        world.add_sphere(ball.with_angular_velocity(vec(1.0, 2.0, 3.0))).unwrap();
        let (account, rest) = account_of_run(&mut world, 120, FRAME);
        assert!(account.colliders > 0.0, "{account:?}");
        assert!(account.contacts < 0.0, "{account:?}");
        assert_close(rest, 0.0, ROUNDING);
    }
}

#[test]
fn accounts_of_balls_in_a_box_of_belts_close() {
    for rule in [Exact::default().into(), contact()] {
        let container = Shape::Container { size: vec(2.0, 1.0, 2.0), open: Sides::NONE };
        let walls = belt(0.8).with_shape(container).with_pose(Pose::at(DVec3::Y * 0.5));
        let mut world = on(rule, walls.with_restitution(0.5));
        let mut numbers = Numbers(7);
        for i in 0..12 {
            let place = vec(-0.8 + 0.14 * f64::from(i), 0.4, numbers.between(-0.5, 0.5));
            let sphere = Sphere::new(place, 0.05).with_restitution(0.5).with_friction(0.4);
            world.add_sphere(sphere.with_velocity(numbers.vector())).unwrap();
        }
        let (account, rest) = account_of_run(&mut world, 180, FRAME);
        let EnergyAccount { colliders, contacts, .. } = account;
        assert!(colliders > 0.0, "{account:?}");
        // Under `exact`, some 1e-10 J of what a contact takes as it begins to persist are in no entry.
        let tolerance = if rule == contact() { ROUNDING } else { 1e-9 };
        assert_close(rest, 0.0, tolerance * (colliders.abs() + contacts.abs()));
    }
}

#[test]
fn a_ball_carried_along_a_wall_is_accounted_for() {
    // The belt presses the ball to the wall, where it spins.
    for rule in [Exact::default().into(), contact()] {
        let mut world = on(rule, belt(1.0));
        let wall = Shape::Box { size: vec(0.2, 1.0, 1.0) };
        world
            .add_collider(belt(0.0).with_shape(wall).with_pose(Pose::at(vec(0.4, 0.5, 0.0))))
            .unwrap();
        let id = world.add_sphere(ball_at(0.0)).unwrap();
        let (account, rest) = account_of_run(&mut world, 120, FRAME);
        assert!(account.colliders > 0.0, "{account:?}");
        assert_close(rest, 0.0, 10.0 * ROUNDING);
        advance(&mut world, 4.0);
        let sphere = world.sphere(id).unwrap();
        // The last of some sweeps leaves about 1 mm/s away from the wall.
        assert_close(sphere.position.x, 0.3 - RADIUS, if rule == contact() { 5e-3 } else { 1e-12 });
    }
}
