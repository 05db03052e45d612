//! Surface velocity: friction feels the material of a belt, which moves while the shape of its collider stays.
//!
//! Friction acts under `exact` and `contact`; under `bisect` and `discrete` a belt is a floor.

// What is expected need not have the same bits everywhere.
#![allow(clippy::disallowed_methods)]

mod accounts;
#[path = "../common/mod.rs"]
mod common;
mod laws;
mod several;

use carom::{
    Collider, Contact, DVec3, Error, Exact, Gravity, Pose, Rule, Shape, Sphere, SphereId, World,
};
use common::{G, assert_close, bisect, discrete, vec, world};

/// Rounding of some events, relative.
const ROUNDING: f64 = 1e-12;

const RADIUS: f64 = 0.1;
const MU: f64 = 0.3;

fn contact() -> Rule {
    Rule::Contact(Contact::default())
}

/// A level belt at y = 0 with this velocity along x \[m/s\].
fn belt(speed: f64) -> Collider {
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_restitution(0.0);
    floor.with_friction(MU).with_surface_velocity(speed * DVec3::X)
}

fn on(rule: impl Into<Rule>, floor: Collider) -> World {
    let mut world = world(rule);
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    world.add_collider(floor).unwrap();
    world
}

/// A ball that touches y = 0 at this place along x \[m\].
fn ball_at(x: f64) -> Sphere {
    Sphere::new(vec(x, RADIUS, 0.0), RADIUS).with_restitution(0.0)
}

fn ball(world: &World, id: SphereId) -> Sphere {
    world.sphere(id).unwrap()
}

/// Advances to a time \[s\] in frames of 1/60 s and a last, shorter one.
fn advance(world: &mut World, time: f64) {
    while time - world.time() > 1e-9 {
        world.step((time - world.time()).min(1.0 / 60.0)).unwrap();
    }
}

/// When a ball that is laid on a belt of speed u begins to roll \[s\]: the slip of `u` ends under 7/2 mu g.
fn rolls_after(speed: f64) -> f64 {
    2.0 * speed / (7.0 * MU * G)
}

#[test]
fn a_ball_laid_on_a_belt_slides_and_then_rolls_at_two_sevenths_of_its_speed() {
    for speed in [0.05, 1.0, -3.0] {
        let mut world = on(Exact::default(), belt(speed));
        let id = world.add_sphere(ball_at(0.0)).unwrap();
        let end = rolls_after(speed.abs());
        advance(&mut world, 0.6 * end);
        let sliding = ball(&world, id);
        assert_close(sliding.velocity.x, speed.signum() * MU * G * 0.6 * end, ROUNDING);
        advance(&mut world, 2.0 * end);
        let Sphere { position, velocity, angular_velocity, .. } = ball(&world, id);
        let final_speed = 2.0 / 7.0 * speed;
        assert_close(velocity.x, final_speed, ROUNDING);
        // The lowest point moves with the belt: v + w r = u for a turn about z.
        assert_close(angular_velocity.z, (speed - final_speed) / RADIUS, 10.0 * ROUNDING);
        // Half of the final speed while it slides, all of it then.
        assert_close(position.x, 1.5 * final_speed * end, ROUNDING);
        assert!(!world.was_stepped());
    }
}

#[test]
fn the_rule_contact_brings_a_ball_on_a_belt_to_the_same_motion() {
    let speed = 1.0;
    let mut world = on(contact(), belt(speed));
    let id = world.add_sphere(ball_at(0.0)).unwrap();
    advance(&mut world, 1.0);
    let Sphere { position, velocity, angular_velocity, .. } = ball(&world, id);
    // An impulse of friction stops the slip in the sub-step in which it ends.
    assert_close(velocity.x, 2.0 / 7.0 * speed, 1e-9);
    assert_close(angular_velocity.z, 5.0 / 7.0 * speed / RADIUS, 1e-7);
    // Places are those of sub-steps of 1/240 s: off by half of one at the final speed.
    let expected = 2.0 / 7.0 * speed * (1.0 - 0.5 * rolls_after(speed));
    assert_close(position.x, expected, 2.0 / 7.0 * speed / 480.0);
}

#[test]
fn rules_without_friction_take_a_belt_for_a_floor() {
    for rule in [bisect(), discrete()] {
        let moved = |speed: f64| {
            let mut world = on(rule, belt(speed));
            let id = world.add_sphere(ball_at(0.0).with_velocity(vec(0.2, 0.0, 0.1))).unwrap();
            advance(&mut world, 0.5);
            ball(&world, id)
        };
        assert_eq!(moved(2.0), moved(0.0), "{rule:?}");
    }
}

#[test]
fn without_friction_no_bit_changes() {
    for rule in [Exact::default().into(), contact(), bisect(), discrete()] {
        let run = |surface_velocity: DVec3| {
            let container = Shape::Container { size: 2.0 * DVec3::ONE, open: carom::Sides::NONE };
            let walls = Collider::new(container, Pose::at(DVec3::ZERO))
                .with_surface_velocity(surface_velocity);
            let mut world = on(rule, walls.with_restitution(0.8));
            for i in 0..12 {
                let x = -0.7 + 0.12 * f64::from(i);
                let sphere = Sphere::new(vec(x, 0.3, 0.2 * x), 0.05).with_friction(0.0);
                world.add_sphere(sphere.with_velocity(vec(1.0, -x, 2.0 * x))).unwrap();
            }
            advance(&mut world, 1.0);
            world.state_hash()
        };
        assert_eq!(run(DVec3::ZERO), run(vec(1.0, -2.0, 0.3)), "{rule:?}");
    }
}

#[test]
fn an_impact_gets_the_impulse_of_the_friction_law() {
    let (restitution, approach) = (0.5, 2.0);
    // Friction suffices to end a small slip, not a large one.
    for speed in [0.4, 20.0] {
        for rule in [Exact::default().into(), contact()] {
            let mut world = world(rule);
            world.add_collider(belt(speed).with_restitution(restitution)).unwrap();
            let sphere = ball_at(0.0).with_velocity(vec(0.0, -approach, 0.0)).with_mass(3.0);
            let sphere = sphere.with_position(vec(0.0, 1.5 * RADIUS, 0.0));
            let id = world.add_sphere(sphere.with_restitution(1.0)).unwrap();
            advance(&mut world, 0.1);
            // Coefficients of restitution multiply.
            let normal_impulse = 3.0 * (1.0 + restitution) * approach;
            let sticking = 3.0 * 2.0 / 7.0 * speed;
            let impulse = sticking.min(MU * normal_impulse);
            let after = ball(&world, id);
            assert_close(after.velocity.y, restitution * approach, ROUNDING);
            assert_close(after.velocity.x, impulse / 3.0, ROUNDING);
            // Turned about z by the impulse at the lowest point: w = J r / (2/5 m r²).
            assert_close(after.angular_velocity.z, impulse / (0.4 * 3.0 * RADIUS), 1e-11);
        }
    }
}

#[test]
fn a_superball_turns_its_slip_on_a_belt_round() {
    for rule in [Exact::default().into(), contact()] {
        let mut world = world(rule);
        let friction = carom::Friction::sliding(5.0).with_tangential_restitution(1.0);
        world.add_collider(belt(1.0).with_restitution(1.0).with_friction(friction)).unwrap();
        let sphere = ball_at(0.0).with_velocity(vec(0.0, -2.0, 0.0)).with_restitution(1.0);
        let id = world.add_sphere(sphere.with_position(vec(0.0, 0.15, 0.0))).unwrap();
        advance(&mut world, 0.1);
        let Sphere { velocity, angular_velocity, .. } = ball(&world, id);
        // The slip was -1 m/s beside the belt and is +1 m/s.
        assert_close(velocity.x + RADIUS * angular_velocity.z, 2.0, 1e-12);
    }
}

#[test]
fn the_part_along_the_normal_neither_pushes_nor_pulls() {
    for rule in [Exact::default().into(), contact()] {
        let run = |along: f64| {
            let mut world = on(rule, belt(0.0).with_surface_velocity(vec(0.7, along, 0.0)));
            let id = world.add_sphere(ball_at(0.0)).unwrap();
            advance(&mut world, 0.5);
            ball(&world, id)
        };
        let (plain, oblique) = (run(0.0), run(-0.3));
        assert!((plain.position - oblique.position).length() <= 1e-15, "{rule:?}");
        assert!((plain.velocity - oblique.velocity).length() <= 1e-15, "{rule:?}");
    }
}

#[test]
fn the_velocity_turns_with_the_collider() {
    let quarter = carom::DQuat::from_rotation_y(std::f64::consts::FRAC_PI_2);
    let floor = belt(1.0).with_pose(Pose::at(DVec3::ZERO).rotated(quarter));
    let mut world = on(Exact::default(), floor);
    let id = world.add_sphere(ball_at(0.0)).unwrap();
    advance(&mut world, 1.0);
    // Local x is -z of the world.
    assert_close(ball(&world, id).velocity.z, -2.0 / 7.0, ROUNDING);
    assert_close(ball(&world, id).velocity.x, 0.0, ROUNDING);
}

#[test]
fn a_belt_changed_while_it_runs_takes_the_ball_along() {
    for rule in [Exact::default().into(), contact()] {
        let mut world = on(rule, belt(0.0));
        let (floor, _) = world.colliders().next().unwrap();
        let id = world.add_sphere(ball_at(0.0)).unwrap();
        // Long enough to fall asleep under `contact`.
        advance(&mut world, 3.0);
        assert_eq!(ball(&world, id).velocity, DVec3::ZERO);
        world.set_collider(floor, belt(1.0)).unwrap();
        advance(&mut world, 4.0);
        assert_close(ball(&world, id).velocity.x, 2.0 / 7.0, 1e-9);
        world.set_collider(floor, belt(0.0)).unwrap();
        advance(&mut world, 5.0);
        // Rolling at 2/7 with a spin for u - v: the slip of u ends as it began.
        assert_close(ball(&world, id).velocity.x, 0.0, 1e-9);
    }
}

#[test]
fn a_velocity_that_is_not_finite_is_refused() {
    let mut world = World::default();
    let wrong = belt(f64::NAN);
    let error = world.add_collider(wrong).unwrap_err();
    assert!(matches!(error, Error::Invalid { .. }), "{error:?}");
    assert!(error.to_string().contains("surface_velocity"), "{error}");
}
