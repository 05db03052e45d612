//! The rule `contact` under forces that are not linear: its order in the frame, and what it keeps.

// What is expected need not have the same bits everywhere.
#![allow(clippy::disallowed_methods)]

mod common;

use std::f64::consts::{PI, TAU};

use carom::{
    Contact, DVec3, Gravity, MutualGravity, PointAttractor, QuadraticDrag, Sphere, Spring, World,
};
use common::{G, assert_close, vec, world};

/// A scheme of second order has a quarter of the error in half the frame, but for terms of the fourth order: here
/// frames are short enough for these to be a hundredth of it.
fn assert_second_order(what: &str, error: impl Fn(u32) -> f64, frames: u32) {
    let errors = [1, 2, 4].map(|times| error(times * frames));
    for two in errors.windows(2) {
        let ratio = two[0] / two[1];
        assert!((ratio - 4.0).abs() < 0.2, "{what}: {errors:?}");
    }
}

/// Takes a number of frames to a time \[s\].
fn run(world: &mut World, time: f64, frames: u32) {
    for _ in 0..frames {
        world.step(time / f64::from(frames)).unwrap();
    }
}

#[test]
fn an_orbit_in_an_attractor_is_of_second_order() {
    let (e, start) = (0.3f64, vec(1.3, 0.0, 0.0));
    let error = |frames: u32| {
        let mut world = world(Contact::default());
        world.add_force(PointAttractor::new(DVec3::ZERO, 1.0)).unwrap();
        // At its apoapsis, with the semi-major axis 1.
        let velocity = vec(0.0, ((1.0 - e) / (1.0 + e)).sqrt(), 0.0);
        let ball = world.add_sphere(Sphere::new(start, 1e-3).with_velocity(velocity)).unwrap();
        run(&mut world, TAU, frames);
        (world.sphere(ball).unwrap().position - start).length()
    };
    assert_second_order("orbit", error, 64);
}

#[test]
fn an_orbit_keeps_its_energy_for_a_thousand_periods() {
    let mut world = world(Contact::default());
    world.add_force(PointAttractor::new(DVec3::ZERO, 1.0)).unwrap();
    let ball = Sphere::new(DVec3::X, 1e-3).with_velocity(vec(0.0, 1.1, 0.0));
    world.add_sphere(ball).unwrap();
    let energy = world.total_energy();
    // The leapfrog scheme swings by less than (w h)²/8, in 8 sub-steps of each of 16 frames, with the rate of 1/s at the
    // pericentre, and never drifts.
    let swing = (TAU / 128.0f64).powi(2) / 8.0;
    for _ in 0..1000 {
        run(&mut world, TAU, 16);
        assert_close(world.total_energy(), energy, swing);
    }
}

#[test]
fn quadratic_drag_is_of_second_order() {
    let (r, mass) = (0.05, 0.1);
    let k = 0.5 * 1.2 * 0.44 * PI * r * r / mass;
    let terminal = (G / k).sqrt();
    let error = |frames: u32| {
        let mut world = world(Contact::default());
        world.add_force(Gravity::new(-G * DVec3::Y)).unwrap();
        world.add_force(QuadraticDrag::new(1.2)).unwrap();
        let ball = world.add_sphere(Sphere::new(DVec3::ZERO, r).with_mass(mass)).unwrap();
        run(&mut world, 3.0, frames);
        let way = terminal * terminal / G * (G * 3.0 / terminal).cosh().ln();
        (world.sphere(ball).unwrap().position.y + way).abs()
    };
    assert_second_order("drag", error, 32);
}

#[test]
fn a_damped_spring_is_of_second_order() {
    let (k, c) = (40.0, 1.5f64);
    let error = |frames: u32| {
        let mut world = world(Contact::default());
        let balls = [-1.0, 1.0].map(|x| Sphere::new(vec(x, 0.0, 0.0), 0.1).with_mass(2.0));
        let [first, second] = balls.map(|ball| world.add_sphere(ball).unwrap());
        let spring = Spring::between(first, second, 1.5).with_stiffness(k).with_damping(c);
        world.add_spring(spring).unwrap();
        run(&mut world, 2.0, frames);
        assert!(world.momentum().length() < 1e-14);
        // With the reduced mass of 1 kg: y'' + c y' + k y = 0, y = 0.5 at rest.
        let (rate, decay) = ((k - 0.25 * c * c).sqrt(), 0.5 * c);
        let (sin, cos) = (2.0 * rate).sin_cos();
        let expected = 1.5 + 0.5 * (-2.0 * decay).exp() * (cos + decay / rate * sin);
        let [from, to] = [first, second].map(|it| world.sphere(it).unwrap().position);
        ((to - from).length() - expected).abs()
    };
    assert_second_order("spring", error, 32);
}

#[test]
fn a_double_star_is_of_second_order_and_keeps_its_momentum() {
    let error = |frames: u32| {
        let mut world = world(Contact::default());
        world.add_force(MutualGravity::new(1.0)).unwrap();
        let star = |x: f64, mass: f64, speed: f64| {
            let place = vec(x, 0.0, 0.0);
            Sphere::new(place, 1e-3).with_mass(mass).with_velocity(vec(0.0, speed, 0.0))
        };
        // About their centre of mass in a circle of the radius 1: the rate is 1.
        let heavy = world.add_sphere(star(-0.25, 0.75, -0.25)).unwrap();
        world.add_sphere(star(0.75, 0.25, 0.75)).unwrap();
        run(&mut world, TAU, frames);
        // A sum of some thousand kicks of order h.
        assert!(world.momentum().length() < 1e-13);
        (world.sphere(heavy).unwrap().position - vec(-0.25, 0.0, 0.0)).length()
    };
    assert_second_order("stars", error, 32);
}
