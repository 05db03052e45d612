//! Forces that depend on positions: springs, pendulums, orbits, drag.

use std::f64::consts::{PI, TAU};

use carom::{
    DVec3, Discrete, Gravity, Integrator, MutualGravity, PointAttractor, QuadraticDrag, Rule,
    Settings, Sphere, Spring, World,
};

use super::claim::{Claim, Expected, Measured, Outcome, Tolerance};
use super::coupled_flights;
use super::curved_flights;
use super::mutual_gravity;
use super::setup::{FRAME, G, run_until, world, world_with};

pub fn claims() -> Vec<Claim> {
    let verlet = Discrete::default().with_integrator(Integrator::VelocityVerlet);
    let mut claims = vec![
        frames_of_oscillator("velocity Verlet", verlet.into()),
        energy_of_two_bodies("velocity Verlet", verlet.into()),
    ];
    claims.extend([
        oscillator(0.0, "oscillator: x = A cos(w t) after ten periods and a quarter [A]"),
        oscillator(0.1, "damped oscillator: x = A e^(-b t) (cos w' t + b/w' sin w' t) [A]"),
        kepler_period(),
        kepler_energy(),
        pendulum(),
        terminal_velocity(),
        curved_flights::kepler_energy(),
        curved_flights::kepler_phase(),
        curved_flights::quadratic_drag(),
        curved_flights::energy_of_hits(),
        curved_flights::bits_of_frames(),
        coupled_flights::pair_on_spring(),
        coupled_flights::energy_of_impacts(),
        coupled_flights::bungee(),
        coupled_flights::pendulum(),
        coupled_flights::cradle(),
        coupled_flights::normal_modes(),
        coupled_flights::bits_of_frames(),
        mutual_gravity::kepler_energy(100, 1e-13),
        mutual_gravity::kepler_phase(100, 1e-10),
        mutual_gravity::kepler_energy(1000, 1e-13).slow(),
        mutual_gravity::kepler_phase(1000, 1e-9).slow(),
        mutual_gravity::pythagorean(),
        chain(100, "energy of a chain of 100 spheres on springs over 100,000 frames [start]"),
        chain(1000, "energy of a chain of 1,000 spheres on springs over 100,000 frames [start]")
            .slow(),
    ]);
    claims
}

/// Rule `discrete` with this integrator.
fn by(integrator: Integrator) -> Rule {
    Discrete::default().with_integrator(integrator).into()
}

/// Creates a sphere of 2 kg on a spring of 50 N/m, displaced by 1 m.
fn on_spring(rule: Rule, damping: f64) -> Result<World, carom::Error> {
    let mut world = world(rule)?;
    let ball = world.add_sphere(Sphere::new(DVec3::X, 0.1).with_mass(2.0))?;
    let spring = Spring::to_point(ball, DVec3::new(-2.0, 0.0, 0.0), 2.0);
    world.add_spring(spring.with_stiffness(50.0).with_damping(damping))?;
    Ok(world)
}

/// Frequency of [`on_spring`] without damping \[1/s\].
const W: f64 = 5.0;

fn frames_of_oscillator(name: &str, rule: Rule) -> Claim {
    let claim = Claim::new(
        format!("oscillator by {name}: x = A cos(n q), cos q = 1 - (w h)²/2, frame by frame [A]"),
        Expected::no_error("closed form of the leapfrog scheme"),
        Tolerance::absolute(1e-11, "rounding of 1,000 frames, a few units each"),
        |rule| {
            let mut world = on_spring(rule, 0.0)?;
            let wh = W * FRAME;
            let angle = libm::acos(1.0 - 0.5 * wh * wh);
            let mut largest = 0.0_f64;
            for n in 1..=1000 {
                world.step(FRAME)?;
                let expected = libm::cos(f64::from(n) * angle);
                largest = largest.max((world.spheres().positions()[0].x - expected).abs());
            }
            Ok(Measured::in_world(&world, largest))
        },
    );
    claim.about(rule)
}

/// Sphere on a spring with this damping ratio, after ten and a quarter periods by Runge-Kutta.
fn oscillator(ratio: f64, name: &'static str) -> Claim {
    let claim = Claim::new(
        name,
        Expected::no_error("closed form"),
        Tolerance::absolute(
            1e-9,
            "(w h)^4 / 120 of the phase, of 64 rad, at 1,000 frames a period",
        ),
        move |rule| {
            let mut world = on_spring(rule, ratio * 2.0 * 2.0 * W)?;
            let (b, w) = (ratio * W, W * libm::sqrt(1.0 - ratio * ratio));
            let h = TAU / W / 1000.0;
            // At a quarter period, an error of the phase has the largest effect.
            run_until(&mut world, 10_250.0 * h, h)?;
            let phase = w * world.time();
            let swing = libm::cos(phase) + b / w * libm::sin(phase);
            let expected = libm::exp(-b * world.time()) * swing;
            let found = world.spheres().positions()[0].x;
            Ok(Measured::in_world(&world, (found - expected).abs()))
        },
    );
    claim.about(by(Integrator::RungeKutta4))
}

/// Semi-major axis of the ellipse \[m\], eccentricity, and gravitational parameter \[m³/s²\].
const ORBIT: [f64; 3] = [1.5, 0.5, 3.0];

/// Creates a sphere at the pericentre of its ellipse about a point.
fn in_pericentre() -> Result<World, carom::Error> {
    let [a, e, mu] = ORBIT;
    let mut world = world_with(Integrator::RungeKutta4)?;
    world.add_force(PointAttractor::new(DVec3::ZERO, mu))?;
    let speed = libm::sqrt(mu / a * (1.0 + e) / (1.0 - e));
    let start = Sphere::new(DVec3::new(a * (1.0 - e), 0.0, 0.0), 0.01);
    world.add_sphere(start.with_velocity(DVec3::new(0.0, 0.0, speed)).with_mass(2.0))?;
    Ok(world)
}

fn period() -> f64 {
    let [a, _, mu] = ORBIT;
    TAU * libm::sqrt(a * a * a / mu)
}

fn kepler_period() -> Claim {
    let claim = Claim::new(
        "Kepler: the period of an ellipse is 2 pi sqrt(a³/mu) [s]",
        Expected::value(period(), "Kepler's third law"),
        Tolerance::relative(1e-9, "Runge-Kutta of 10,000 frames an orbit"),
        |_| {
            let mut world = in_pericentre()?;
            let h = period() / 10_000.0;
            run_until(&mut world, 9_990.0 * h, h)?;
            // At the pericentre, z changes its sign.
            let mut before = f64::NAN;
            while world.spheres().positions()[0].z < 0.0 {
                before = world.spheres().positions()[0].z;
                world.step(h)?;
            }
            let after = world.spheres().positions()[0].z;
            let found = world.time() - h * after / (after - before);
            Ok(Measured::in_world(&world, found))
        },
    );
    claim.about(by(Integrator::RungeKutta4))
}

fn kepler_energy() -> Claim {
    let [a, _, mu] = ORBIT;
    let claim = Claim::new(
        "Kepler: the energy of an ellipse is -m mu / 2 a, all the way [J]",
        Expected::value(-2.0 * mu / (2.0 * a), "vis-viva equation"),
        Tolerance::relative(1e-11, "Runge-Kutta of 10,000 frames an orbit"),
        |_| {
            let mut world = in_pericentre()?;
            let (h, expected) = (period() / 10_000.0, -ORBIT[2] / ORBIT[0]);
            let mut farthest = expected;
            for _ in 0..10_000 {
                world.step(h)?;
                let energy = world.total_energy();
                if (energy - expected).abs() > (farthest - expected).abs() {
                    farthest = energy;
                }
            }
            Ok(Measured::in_world(&world, farthest))
        },
    );
    claim.about(by(Integrator::RungeKutta4))
}

/// A thousandth of the period of a circular orbit in [`energy_of_two_bodies`] \[s\].
const ORBIT_FRAME: f64 = PI / 1000.0;

/// Two bodies of equal mass on elliptical orbits about each other, for more than a hundred orbits.
fn energy_of_two_bodies(name: &str, rule: Rule) -> Claim {
    let claim = Claim::new(
        format!("gravity between spheres by {name}: energy over 100 orbits [start]"),
        Expected::no_error("a symplectic scheme has no drift"),
        Tolerance::absolute(
            1.3e-4,
            "(w h)² / 4 in the pericentre, where w = 7.2/s, h = pi / 1000 s",
        ),
        |rule| {
            let mut world = world(rule)?;
            world.add_force(MutualGravity::new(2.0))?;
            // A circular orbit would have speed 1.
            for side in [1.0, -1.0] {
                let start = Sphere::new(DVec3::new(0.5 * side, 0.0, 0.0), 0.01);
                world.add_sphere(start.with_velocity(DVec3::new(0.0, 0.8 * side, 0.0)))?;
            }
            let before = world.total_energy();
            let mut largest = 0.0_f64;
            for _ in 0..100_000 {
                world.step(ORBIT_FRAME)?;
                largest = largest.max((world.total_energy() / before - 1.0).abs());
            }
            Ok(Measured::in_world(&world, largest))
        },
    );
    claim.about(rule)
}

/// A pendulum on a spring so stiff that its extension hardly matters.
fn pendulum() -> Claim {
    let (angle, stiffness) = (0.1, 1e10);
    let square = angle * angle;
    let series = 1.0 + square / 16.0 + 11.0 / 3072.0 * square * square;
    let claim = Claim::new(
        "pendulum: the period is 2 pi sqrt(l/g) (1 + q²/16 + 11 q⁴/3072) [s]",
        Expected::value(TAU * libm::sqrt(1.0 / G) * series, "series of the elliptic integral"),
        Tolerance::relative(3e-9, "stretch of the spring, 1e-9; next term 2e-10"),
        move |rule| {
            let mut world = world(rule)?;
            world.add_force(Gravity::new(DVec3::new(0.0, -G, 0.0)))?;
            let (sin, cos) = (libm::sin(angle), libm::cos(angle));
            // Stretched by the weight, so that it does not oscillate along the spring.
            let length = 1.0 + G * cos / stiffness;
            let ball = world.add_sphere(Sphere::new(length * DVec3::new(-sin, -cos, 0.0), 0.1))?;
            world.add_spring(Spring::to_point(ball, DVec3::ZERO, 1.0).with_stiffness(stiffness))?;
            let h = 1e-5;
            let mut before = f64::NAN;
            while world.spheres().positions()[0].x < 0.0 {
                before = world.spheres().positions()[0].x;
                world.step(h)?;
            }
            let after = world.spheres().positions()[0].x;
            let quarter = world.time() - h * after / (after - before);
            Ok(Measured::in_world(&world, 4.0 * quarter))
        },
    );
    claim.about(by(Integrator::RungeKutta4))
}

fn terminal_velocity() -> Claim {
    let (mass, density, coefficient, radius) = (2.0, 1.2, 0.5, 0.25);
    let area = PI * radius * radius;
    Claim::new(
        "terminal velocity under quadratic drag is sqrt(2 m g / (rho c A)) [m/s]",
        Expected::value(
            libm::sqrt(2.0 * mass * G / (density * coefficient * area)),
            "weight and drag in balance",
        ),
        Tolerance::relative(1e-13, "rounding; e^(-40) is left of the start"),
        move |rule| {
            let mut world = world(rule)?;
            world.add_force(Gravity::new(DVec3::new(0.0, -G, 0.0)))?;
            let drag = QuadraticDrag::new(density).with_drag_coefficient(coefficient);
            world.add_force(drag)?;
            world.add_sphere(Sphere::new(DVec3::ZERO, radius).with_mass(mass))?;
            run_until(&mut world, 40.0, FRAME)?;
            Ok(Measured::in_world(&world, -world.spheres().velocities()[0].y))
        },
    )
}

/// Largest change of energy of a chain between two fixed points, after every sphere was struck.
fn chain(count: u32, name: &'static str) -> Claim {
    let claim = Claim::new(
        name,
        Expected::no_error("a symplectic scheme has no drift"),
        Tolerance::absolute(1e-6, "(w h)² / 4 of the fastest mode, w = 2 sqrt(k/m)"),
        move |rule| chain_energy(rule, count),
    );
    claim.about(by(Integrator::VelocityVerlet))
}

fn chain_energy(rule: Rule, count: u32) -> Outcome {
    let mut world = World::new(Settings::default().with_rule(rule).with_spheres_collide(false))?;
    let stiffness = 100.0;
    let mut balls = Vec::new();
    for i in 0..count {
        let at = f64::from(i);
        // Irregular velocities, different for each sphere.
        let blow = DVec3::new(libm::sin(7.1 * at * at), libm::sin(3.3 * at * at), 0.0);
        let start = Sphere::new(DVec3::new(at, 0.0, 0.0), 0.1).with_velocity(blow);
        balls.push(world.add_sphere(start)?);
    }
    for pair in balls.windows(2) {
        world.add_spring(Spring::between(pair[0], pair[1], 0.9).with_stiffness(stiffness))?;
    }
    for (ball, x) in [(balls[0], -1.0), (balls[balls.len() - 1], f64::from(count))] {
        let end = Spring::to_point(ball, DVec3::new(x, 0.0, 0.0), 0.9);
        world.add_spring(end.with_stiffness(stiffness))?;
    }
    let before = world.total_energy();
    let mut largest = 0.0_f64;
    for frame in 0..100_000 {
        world.step(1e-4)?;
        if frame % 10 == 0 {
            largest = largest.max((world.total_energy() / before - 1.0).abs());
        }
    }
    Ok(Measured::in_world(&world, largest))
}
