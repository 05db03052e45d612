//! Motion without contacts, against the closed forms of the schemes themselves (to round-off)
//! and against the continuous solution (to measure the order). Says nothing about contacts.

// What is expected need not have the same bits everywhere.
#![allow(clippy::disallowed_methods)]

mod common;

use carom::{ConstantForce, Gravity, Integrator, Sphere, ViscousDrag, World};
use common::{G, assert_close, vec, world_with};

const ALL: [Integrator; 4] = [
    Integrator::SemiImplicitEuler,
    Integrator::ExplicitEuler,
    Integrator::VelocityVerlet,
    Integrator::RungeKutta4,
];

/// Rounding of n additions of numbers of this size.
fn round_off(n: usize, size: f64) -> f64 {
    n as f64 * f64::EPSILON * size.abs().max(1.0)
}

fn run(world: &mut World, steps: usize, h: f64) {
    for _ in 0..steps {
        world.step(h).unwrap();
    }
}

#[test]
fn free_fall_matches_the_closed_form_of_each_scheme() {
    let (n, h) = (500, 0.01);
    for integrator in ALL {
        let mut world = world_with(integrator);
        world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
        let ball = world.add_sphere(Sphere::new(vec(1.0, 0.0, 2.0), 0.1)).unwrap();
        run(&mut world, n, h);
        let ball = world.sphere(ball).unwrap();
        let steps = n as f64;
        let distance = match integrator {
            Integrator::SemiImplicitEuler => G * h * h * steps * (steps + 1.0) / 2.0,
            Integrator::ExplicitEuler => G * h * h * steps * (steps - 1.0) / 2.0,
            _ => G * h * h * steps * steps / 2.0,
        };
        assert_close(ball.velocity.y, -steps * h * G, round_off(n, steps * h * G));
        assert_close(ball.position.y, -distance, round_off(n, distance));
        assert_eq!((ball.position.x, ball.position.z), (1.0, 2.0));
    }
}

#[test]
fn drag_approaches_the_terminal_velocity_by_the_stability_function_of_each_scheme() {
    let (n, h, k, m) = (40, 0.05, 1.5, 2.0);
    let z: f64 = h * k / m;
    for integrator in ALL {
        let mut world = world_with(integrator);
        world.add_force(ConstantForce::new(vec(3.0, 0.0, 0.0))).unwrap();
        world.add_force(ViscousDrag::new(k)).unwrap();
        let ball = world.add_sphere(Sphere::new(vec(0.0, 0.0, 0.0), 0.1).with_mass(m)).unwrap();
        run(&mut world, n, h);
        // Each step multiplies the distance to the terminal velocity F/k by this.
        let factor = match integrator {
            Integrator::SemiImplicitEuler | Integrator::ExplicitEuler => 1.0 - z,
            Integrator::VelocityVerlet => 1.0 - z + z * z / 2.0,
            _ => 1.0 - z + z * z / 2.0 - z.powi(3) / 6.0 + z.powi(4) / 24.0,
        };
        let expected = 3.0 / k * (1.0 - factor.powi(n as i32));
        assert_close(world.sphere(ball).unwrap().velocity.x, expected, round_off(n, expected));
        run(&mut world, 3000, h);
        assert_close(world.sphere(ball).unwrap().velocity.x, 3.0 / k, 1e-14);
    }
}

#[test]
fn forces_add_up_and_act_by_their_own_laws() {
    let mut world = world_with(Integrator::SemiImplicitEuler);
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    world.add_force(ConstantForce::new(vec(4.0, 0.0, 0.0))).unwrap();
    let light = world.add_sphere(Sphere::new(vec(0.0, 0.0, 0.0), 0.1).with_mass(0.5)).unwrap();
    let heavy = world.add_sphere(Sphere::new(vec(5.0, 0.0, 0.0), 0.1).with_mass(8.0)).unwrap();
    world.step(0.5).unwrap();
    // Gravity is the same acceleration for both, the push the same force.
    assert_eq!(world.sphere(light).unwrap().velocity, vec(4.0, -0.5 * G, 0.0));
    assert_eq!(world.sphere(heavy).unwrap().velocity, vec(0.25, -0.5 * G, 0.0));
}

#[test]
fn a_changed_drag_coefficient_acts_from_the_next_step_on() {
    let mut world = world_with(Integrator::SemiImplicitEuler);
    let drag = world.add_force(ViscousDrag::new(0.0)).unwrap();
    let start = Sphere::new(vec(0.0, 0.0, 0.0), 0.1).with_velocity(vec(1.0, 0.0, 0.0));
    let ball = world.add_sphere(start).unwrap();
    world.step(0.25).unwrap();
    assert_eq!(world.sphere(ball).unwrap().velocity.x, 1.0);
    world.set_force(drag, ViscousDrag::new(2.0)).unwrap();
    world.step(0.25).unwrap();
    assert_eq!(world.sphere(ball).unwrap().velocity.x, 0.5);
}

/// Position error after 2 s of falling with drag, against the exact solution.
fn error_of(integrator: Integrator, h: f64) -> f64 {
    let (k, m) = (0.8, 1.0);
    let mut world = world_with(integrator);
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    world.add_force(ViscousDrag::new(k)).unwrap();
    let start = Sphere::new(vec(0.0, 0.0, 0.0), 0.1).with_velocity(vec(0.0, 7.0, 0.0));
    let ball = world.add_sphere(start.with_mass(m)).unwrap();
    run(&mut world, (2.0 / h).round() as usize, h);
    let (t, terminal): (f64, f64) = (2.0, -m * G / k);
    let exact = terminal * t + (7.0 - terminal) * m / k * (1.0 - (-k * t / m).exp());
    (world.sphere(ball).unwrap().position.y - exact).abs()
}

#[test]
fn each_scheme_converges_with_its_order() {
    for (integrator, order) in ALL.into_iter().zip([1.0, 1.0, 2.0, 4.0]) {
        // Halving the step divides the error by 2^order; 0.1 covers the next term of the series
        // at these steps, and is far from the next whole order.
        let measured = (error_of(integrator, 1.0 / 32.0) / error_of(integrator, 1.0 / 64.0)).log2();
        assert_close(measured, order, 0.1);
    }
}

#[test]
fn energy_of_a_throw_is_kinetic_plus_potential() {
    let mut world = world_with(Integrator::VelocityVerlet);
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    world.add_force(ConstantForce::new(vec(0.3, 0.0, -0.2))).unwrap();
    let start = Sphere::new(vec(1.0, 2.0, 3.0), 0.1).with_velocity(vec(3.0, 4.0, 0.0));
    world.add_sphere(start.with_mass(2.0)).unwrap();
    let before = world.total_energy();
    assert_close(before, 25.0 + 2.0 * G * 2.0 - 0.3 + 0.6, 1e-12);
    run(&mut world, 100, 0.01);
    // Velocity Verlet is exact under a constant force.
    assert_close(world.total_energy(), before, 1e-11);
}

#[test]
fn time_does_not_drift_over_a_million_steps() {
    let mut world = world_with(Integrator::SemiImplicitEuler);
    run(&mut world, 1_000_000, 0.1);
    // A plain sum of 0.1 is off by 1e-6 here.
    assert_eq!(world.time(), 100_000.0);
}
