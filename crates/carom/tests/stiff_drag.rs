//! The rule `exact` under drag that stops a ball in much less than a frame: against closed forms, at rates up to 1e12
//! per frame, each of which ends. Proves nothing of balls that touch.

// What is expected need not have the same bits everywhere.
#![allow(clippy::disallowed_methods)]

mod common;

use std::f64::consts::{LN_2, PI};

use carom::{Collider, DVec3, Gravity, Pose, QuadraticDrag, Shape, Sphere, Spring, Vortex, World};
use common::{AirDrag, G, account_of_run, assert_close, assert_close_vec, exact, run, vec};

const FRAME: f64 = 1.0 / 64.0;
const RATES: [f64; 6] = [1.0, 1e2, 1e4, 1e6, 1e9, 1e12];

fn falling_world() -> World {
    let mut world = exact();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    world
}

/// Quadratic drag under which a ball of 1 kg and 1 m falls with this terminal velocity \[m/s\].
fn drag_to(terminal: f64) -> QuadraticDrag {
    QuadraticDrag::new(2.0 * G / (0.44 * PI * terminal * terminal))
}

#[test]
fn quadratic_drag_leads_to_the_logarithm_of_the_hyperbolic_cosine() {
    // At the last rate a ball at rest passes the terminal velocity in the shortest step.
    for &rate in &RATES[..5] {
        // Motion about the terminal velocity is damped with 2 g/v.
        let terminal = 2.0 * G * FRAME / rate;
        let mut world = falling_world();
        world.add_force(drag_to(terminal)).unwrap();
        let ball = world.add_sphere(Sphere::new(DVec3::ZERO, 1.0).with_mass(1.0)).unwrap();
        for frame in 1..=64 {
            world.step(FRAME).unwrap();
            let z = G * f64::from(frame) * FRAME / terminal;
            let fall = terminal * terminal / G * (z - LN_2 + libm::log1p(libm::exp(-2.0 * z)));
            let height = world.sphere(ball).unwrap().position.y;
            // Rounding of some tens of steps.
            assert_close(-height, fall, 1e-13 * fall);
        }
    }
}

#[test]
fn drag_of_a_program_leads_to_the_exponential() {
    for per_frame in RATES {
        let rate = per_frame / FRAME;
        let mut world = falling_world();
        world.add_force(AirDrag { rate, wind: DVec3::ZERO }).unwrap();
        let start = vec(3.0, 2.0, -1.0);
        let ball = Sphere::new(DVec3::ZERO, 1.0).with_mass(1.0).with_velocity(start);
        let ball = world.add_sphere(ball).unwrap();
        let (_, rest) = account_of_run(&mut world, 64, FRAME);
        let terminal = vec(0.0, -G / rate, 0.0);
        let lost = -libm::expm1(-rate) / rate;
        let way = terminal + (start - terminal) * lost;
        let state = world.sphere(ball).unwrap();
        // What steps leave out, as a part of the way in which the drag stops the ball.
        assert_close_vec(state.position, way, 1e-11 * (start.length() / rate));
        assert_close_vec(
            state.velocity,
            terminal,
            1e-12 * terminal.length() + 3.8 * libm::exp(-rate),
        );
        assert_close(rest, 0.0, 1e-12 * 7.0);
    }
}

#[test]
fn strong_drag_takes_a_ball_along_with_the_wind() {
    for per_frame in RATES {
        let rate = per_frame / FRAME;
        let wind = vec(5.0, 0.0, 2.0);
        let mut world = exact();
        world.add_force(AirDrag { rate, wind }).unwrap();
        let ball = world.add_sphere(Sphere::new(DVec3::ZERO, 1.0).with_mass(1.0)).unwrap();
        run(&mut world, 1.0, FRAME);
        let way = wind * (1.0 + libm::expm1(-rate) / rate);
        // Rounding of 64 frames and some tens of steps.
        assert_close_vec(world.sphere(ball).unwrap().position, way, 1e-13 * way.length());
    }
}

#[test]
fn strong_drag_takes_a_ball_around_with_a_vortex() {
    for per_frame in [1e4, 1e6, 1e8] {
        let rate = per_frame / FRAME;
        let mut world = exact();
        world.add_force(Vortex::new(DVec3::ZERO, 9.0, rate).with_core_radius(1.0)).unwrap();
        let ball = Sphere::new(DVec3::X, 0.1).with_mass(1.0);
        let ball = world.add_sphere(ball).unwrap();
        run(&mut world, 1.0, FRAME);
        let place = world.sphere(ball).unwrap().position;
        // The air turns with u/r, and a ball slips out of its circle with (u/r)² r/γ.
        let speed = 9.0 / (4.0 * PI);
        assert_close(place.length(), 1.0, 2.0 * speed * speed / rate);
        let angle = libm::atan2(-place.z, place.x);
        assert_close(angle, speed, 4.0 * speed * (1.0 + speed * speed) / rate);
    }
}

#[test]
fn frames_do_not_change_the_motion_of_a_ball_that_strong_drag_brings_to_rest() {
    let place_after = |frames: u32| {
        let mut world = falling_world();
        world.add_force(drag_to(1e-3)).unwrap();
        world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO))).unwrap();
        let ball = Sphere::new(vec(0.0, 1.0002, 0.0), 1.0).with_mass(1.0);
        let ball = ball.with_velocity(vec(2.0, 0.0, 0.0)).with_restitution(0.5);
        let ball = world.add_sphere(ball).unwrap();
        let (_, rest) = account_of_run(&mut world, frames as usize, 1.0 / f64::from(frames));
        let energy = 2.0 + G * 1.0002;
        assert_close(rest, 0.0, 1e-12 * energy);
        let ball = world.sphere(ball).unwrap();
        // It fell for 0.2 s, and rests.
        assert_close(ball.position.y, 1.0, 1e-13);
        assert_close(ball.velocity.y, 0.0, 0.0);
        ball.position.x.to_bits()
    };
    let of_some = place_after(16);
    assert_eq!(of_some, place_after(64));
    assert_eq!(of_some, place_after(256));
}

#[test]
fn a_chain_of_balls_on_springs_creeps_back_by_its_normal_mode() {
    // In the mode of number n, q'' = -l q - c q' with l = 4 k/m sin²(pi n / (2 N)) for a chain.
    let (count, mode, distance, amplitude) = (12, 3, 0.5, 0.02);
    for rate in [1e3, 1e6] {
        let wave = PI * f64::from(mode) / f64::from(count);
        let shape = |number: i32| libm::cos(wave * (f64::from(number) + 0.5));
        // So stiff that the mode creeps back in a second or so.
        let square = 4.0 * libm::pow(libm::sin(0.5 * wave), 2.0);
        let (stiffness, strength) = (rate / square, rate);
        let mut world = exact();
        world.add_force(AirDrag { rate, wind: DVec3::ZERO }).unwrap();
        let place = |number: i32, part: f64| {
            distance * f64::from(number) + amplitude * part * shape(number)
        };
        let ball = |number: i32| Sphere::new(vec(place(number, 1.0), 0.0, 0.0), 0.1).with_mass(1.0);
        let balls: Vec<_> =
            (0..count).map(|number| world.add_sphere(ball(number)).unwrap()).collect();
        for pair in balls.windows(2) {
            let spring = Spring::between(pair[0], pair[1], distance).with_stiffness(stiffness);
            world.add_spring(spring).unwrap();
        }
        let root = (rate * rate - 4.0 * strength).sqrt();
        let (slow, fast) = (-2.0 * strength / (rate + root), -0.5 * (rate + root));
        for frame in 1..=16 {
            world.step(FRAME).unwrap();
            let time = f64::from(frame) * FRAME;
            let part = fast * libm::exp(slow * time) - slow * libm::exp(fast * time);
            let part = part / (fast - slow);
            for (number, &ball) in (0..).zip(&balls) {
                let x = world.sphere(ball).unwrap().position.x;
                // Rounding of places of 6 m, of some tens of steps.
                assert_close(x, place(number, part), 1e-13 * distance * f64::from(count));
            }
        }
    }
}
