//! The rules with frames under drag that stops a ball in much less than a frame: against closed forms, at rates from
//! 1e-3 to 1e12 per frame. Proves nothing of forces between spheres that damp.

// What is expected need not have the same bits everywhere.
#![allow(clippy::disallowed_methods)]

mod common;

use std::f64::consts::PI;

use carom::{
    Bisect, Buoyancy, Collider, Contact, DVec3, Discrete, Gravity, Integrator, Motion, MotionPart,
    Pose, QuadraticDrag, Rule, Shape, Sphere, ViscousDrag, Vortex,
};
use common::{AirDrag, G, account_of_run, assert_close, assert_close_vec, vec, world};

const FRAME: f64 = 1.0 / 64.0;
const RATES: [f64; 9] = [1e-3, 0.1, 1.5, 3.0, 1e2, 1e4, 1e6, 1e9, 1e12];
const INTEGRATORS: [Integrator; 4] = [
    Integrator::SemiImplicitEuler,
    Integrator::ExplicitEuler,
    Integrator::VelocityVerlet,
    Integrator::RungeKutta4,
];

fn rules() -> Vec<Rule> {
    let discrete = |it| Rule::Discrete(Discrete::default().with_integrator(it));
    let bisect = |it| Rule::Bisect(Bisect::default().with_integrator(it));
    let [of_discrete, of_bisect] =
        [INTEGRATORS.map(discrete), INTEGRATORS.map(bisect)].map(Vec::from);
    [vec![Rule::Contact(Contact::default())], of_discrete, of_bisect].concat()
}

fn is_contact(rule: Rule) -> bool {
    matches!(rule, Rule::Contact(_))
}

fn is_of_fourth_order(rule: Rule) -> bool {
    match rule {
        Rule::Discrete(it) => it.integrator == Integrator::RungeKutta4,
        Rule::Bisect(it) => it.integrator == Integrator::RungeKutta4,
        _ => false,
    }
}

/// Every rule with frames, at every rate.
fn all_cases() -> impl Iterator<Item = (Rule, f64)> {
    rules().into_iter().flat_map(|rule| RATES.map(|rate| (rule, rate)))
}

/// Quadratic drag `-k |v| v` on a ball of 1 kg and 1 m, with k \[1/m\].
fn quadratic_drag(k: f64) -> QuadraticDrag {
    QuadraticDrag::new(2.0 * k / (0.44 * PI))
}

fn ball(velocity: DVec3) -> Sphere {
    Sphere::new(DVec3::ZERO, 1.0).with_mass(1.0).with_velocity(velocity)
}

/// Speed after an implicit step of Euler's under quadratic drag, as a part of the speed v before, for `z = k v h`.
fn left_by_quadratic_drag(z: f64) -> f64 {
    2.0 / (1.0 + (1.0 + 4.0 * z).sqrt())
}

#[test]
fn quadratic_drag_slows_a_ball_without_turning_it_round() {
    for (rule, per_frame) in all_cases() {
        let mut world = world(rule);
        let speed = 3.0;
        let k = per_frame / (FRAME * speed);
        world.add_force(quadratic_drag(k)).unwrap();
        let ball = world.add_sphere(ball(vec(0.0, 0.0, speed))).unwrap();
        let mut last = speed;
        for frame in 1..=64 {
            let (_, rest) = account_of_run(&mut world, 1, FRAME);
            let now = world.sphere(ball).unwrap().velocity;
            assert!(now.z > 0.0 && now.z < last, "{rule:?} {per_frame} {frame}: {now} of {last}");
            last = now.z;
            if frame == 1 && per_frame > 1.0 && !is_contact(rule) {
                let expected = speed * left_by_quadratic_drag(per_frame);
                // Newton's method ends within 1e-12.
                assert_close(now.z, expected, 1e-11 * expected);
            }
            if !is_of_fourth_order(rule) {
                assert_close(rest, 0.0, 1e-14 * 4.5);
            }
        }
        let expected = speed / (1.0 + k * speed * 64.0 * FRAME);
        // Steps of first order; the fastest drag takes six frames to stop the ball that it should stop in one.
        assert!((last / expected - 1.0).abs() < 0.25, "{rule:?} {per_frame}: {last} {expected}");
    }
}

#[test]
fn linear_drag_that_is_faster_than_a_frame_follows_the_implicit_scheme() {
    for (rule, per_frame) in all_cases() {
        if per_frame <= 1.0 || is_contact(rule) {
            continue;
        }
        let rate = per_frame / FRAME;
        for is_known in [true, false] {
            let mut world = world(rule);
            if is_known {
                world.add_force(ViscousDrag::new(rate)).unwrap();
            } else {
                world.add_force(AirDrag { rate, wind: DVec3::ZERO }).unwrap();
            }
            world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
            let start = vec(3.0, 2.0, -1.0);
            let ball = world.add_sphere(ball(start)).unwrap();
            let (_, rest) = account_of_run(&mut world, 1, FRAME);
            let state = world.sphere(ball).unwrap();
            let velocity = (start + vec(0.0, -G, 0.0) * FRAME) / (1.0 + per_frame);
            assert_close_vec(state.velocity, velocity, 1e-11 * velocity.length());
            assert_close_vec(state.position, velocity * FRAME, 1e-11 * velocity.length() * FRAME);
            assert_close(rest, 0.0, 1e-14 * 7.0);
        }
    }
}

#[test]
fn balls_fall_with_their_terminal_velocity() {
    for (rule, per_frame) in all_cases() {
        if per_frame < 1.0 {
            continue;
        }
        let mut world = world(rule);
        world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
        // Motion about the terminal velocity is damped with 2 g/v.
        let terminal = 2.0 * G * FRAME / per_frame;
        world.add_force(quadratic_drag(G / (terminal * terminal))).unwrap();
        let ball = world.add_sphere(ball(vec(2.0, 1.0, 0.0))).unwrap();
        let mut fastest: f64 = 5.0;
        for _ in 0..256 {
            let (_, rest) = account_of_run(&mut world, 1, FRAME);
            let speed = world.sphere(ball).unwrap().velocity.length();
            // An explicit step just below the rate of implicit ones may pass the terminal velocity a little.
            assert!(speed <= fastest.max(terminal) * 1.01, "{rule:?} {per_frame}: {speed}");
            fastest = fastest.min(speed);
            // Explicit schemes leave an error of gravity.
            if is_contact(rule) {
                assert_close(rest, 0.0, 1e-12 * (2.5 + G));
            }
        }
        let velocity = world.sphere(ball).unwrap().velocity;
        assert_close_vec(velocity / terminal, vec(0.0, -1.0, 0.0), 0.02);
    }
}

#[test]
fn strong_drag_takes_a_ball_along_with_the_wind() {
    for (rule, per_frame) in all_cases() {
        let (rate, wind) = (per_frame / FRAME, vec(5.0, 0.0, 2.0));
        let mut world = world(rule);
        world.add_force(AirDrag { rate, wind }).unwrap();
        let ball = world.add_sphere(ball(DVec3::ZERO)).unwrap();
        account_of_run(&mut world, 256, FRAME);
        let velocity = world.sphere(ball).unwrap().velocity;
        let left = libm::exp(-256.0 * per_frame);
        assert_close_vec(velocity / wind.length(), wind.normalize() * (1.0 - left), 1e-3);
    }
}

#[test]
fn strong_drag_takes_a_ball_around_with_a_vortex() {
    for (rule, per_frame) in
        rules().into_iter().flat_map(|it| [1e4, 1e6, 1e9].map(|rate| (it, rate)))
    {
        let mut world = world(rule);
        let vortex = Vortex::new(DVec3::ZERO, 9.0, per_frame / FRAME).with_core_radius(1.0);
        world.add_force(vortex).unwrap();
        let ball = Sphere::new(DVec3::X, 0.1).with_mass(1.0);
        let ball = world.add_sphere(ball).unwrap();
        account_of_run(&mut world, 64, FRAME);
        let place = world.sphere(ball).unwrap().position;
        let speed = 9.0 / (4.0 * PI);
        // A frame goes along a tangent, or begins with half a frame of rest.
        assert_close(place.length(), 1.0, speed * speed * FRAME);
        assert_close(libm::atan2(-place.z, place.x), speed, 2.0 * speed * FRAME);
    }
}

#[test]
fn balls_of_any_size_bounce_to_rest_in_a_heavy_fluid() {
    for (rule, size) in rules()
        .into_iter()
        .flat_map(|it| [-20, 0, 20].map(|it| libm::ldexp(1.0, it)).map(|size| (it, size)))
    {
        if matches!(rule, Rule::Bisect(_)) && size < 1.0 {
            // Its tolerance is a length.
            continue;
        }
        let time = size.sqrt();
        let mut world = world(rule);
        world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
        let fluid = QuadraticDrag::new(3000.0).with_drag_coefficient(0.47);
        world.add_force(fluid).unwrap();
        world.add_force(Buoyancy::new(1.0, 1.0 * size)).unwrap();
        let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_restitution(0.9);
        let swing = MotionPart::Oscillate {
            axis: DVec3::Y,
            amplitude: 0.02 * size,
            frequency: 3.0 / time,
            phase: 0.0,
        };
        world.add_collider(floor.with_friction(0.2).with_motion(Motion::new([swing]))).unwrap();
        let mass = |of: f64| of * size * size * size;
        let sphere = |place: DVec3| {
            Sphere::new(place * size, 0.1 * size).with_restitution(0.9).with_friction(0.2)
        };
        let light = sphere(vec(0.0, 1.0, 0.0)).with_velocity(vec(3.0, 0.0, 0.0) * time);
        let light = world.add_sphere(light.with_mass(mass(0.001))).unwrap();
        let heavy = world.add_sphere(sphere(vec(0.05, 2.0, 0.0)).with_mass(mass(4.0))).unwrap();
        let (account, rest) = account_of_run(&mut world, 180, FRAME * time);
        let weight = mass(4.0) * G * size;
        if is_contact(rule) {
            assert!(rest.abs() < 1e-2 * weight, "{size}: {rest} {account:?}");
        }
        for ball in [light, heavy] {
            let state = world.sphere(ball).unwrap();
            assert!(state.velocity.length() < 3.0 * time, "{rule:?} {size}: {state:?}");
            assert!(state.position.y > 0.0, "{rule:?} {size}: {state:?}");
        }
    }
}
