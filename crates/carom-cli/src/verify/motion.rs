//! Motion between impacts: closed forms of the exact motion, and of the integration schemes.

use carom::{
    Bisect, ConstantForce, DVec3, Discrete, Error, Gravity, Integrator, Rule, Sphere, ViscousDrag,
    World,
};

use super::claim::{Claim, Expected, Measured, Outcome, Tolerance};
use super::setup::{FRAME, G, run_until, world, world_with};

const FROM: DVec3 = DVec3::new(3.0, 100.0, -2.0);
const SPEED: DVec3 = DVec3::new(1.5, 20.0, -0.5);
/// Duration of the flights \[s\].
const DURATION: f64 = 10.0;

pub fn claims() -> Vec<Claim> {
    let mut claims = vec![
        Claim::new(
            "free flight under gravity follows x0 + v0 t + a t²/2 [m]",
            Expected::no_error("closed form"),
            Tolerance::absolute(1e-12, "rounding of positions of 500 m, ten units"),
            free_flight,
        ),
        Claim::new(
            "drag: v approaches F/k as exp(-k t/m), and x its integral [m, m/s]",
            Expected::no_error("closed form"),
            Tolerance::absolute(1e-12, "rounding of positions of 100 m, 70 units"),
            |rule| drag(rule, 0.8),
        ),
        Claim::new(
            "drag of next to nothing keeps the digits of free flight [m, m/s]",
            Expected::no_error("series in k t/m to the second order"),
            Tolerance::absolute(1e-12, "rounding of positions of 500 m; next term 1e-15"),
            |rule| drag(rule, 1e-9),
        ),
        Claim::new(
            "terminal velocity under drag is F/k [m/s]",
            Expected::value(-2.0 * G / 3.0, "F/k, m = 2 kg, k = 3 kg/s"),
            Tolerance::relative(1e-14, "rounding; exp(-150) is left of the start"),
            terminal_velocity,
        ),
        bisection_error(8),
        bisection_error(20),
    ];
    let (n, h) = (600.0, FRAME);
    for (name, integrator, fall) in [
        ("semi-implicit Euler, a h² n(n+1)/2", Integrator::SemiImplicitEuler, n * (n + 1.0)),
        ("explicit Euler, a h² n(n-1)/2", Integrator::ExplicitEuler, n * (n - 1.0)),
    ] {
        let (fall, speed) = (0.5 * G * h * h * fall, G * h * n);
        claims.push(scheme(format!("{name}: fall in 600 steps [m]"), fall, integrator, |world| {
            -world.spheres().positions()[0].y
        }));
        claims.push(scheme(
            format!("{name}: speed then n h a [m/s]"),
            speed,
            integrator,
            |world| -world.spheres().velocities()[0].y,
        ));
    }
    claims
}

fn free_flight(rule: Rule) -> Outcome {
    let mut world = world(rule)?;
    let acceleration = DVec3::new(0.0, -G, 0.0);
    world.add_force(Gravity::new(acceleration))?;
    world.add_sphere(Sphere::new(FROM, 0.5).with_velocity(SPEED))?;
    run_until(&mut world, DURATION, FRAME)?;
    let t = world.time();
    let expected = FROM + t * SPEED + 0.5 * t * t * acceleration;
    let error = (world.spheres().positions()[0] - expected).length();
    Ok(Measured::in_world(&world, error))
}

/// Error of a flight under gravity and drag of coefficient `k` \[kg/s\].
fn drag(rule: Rule, k: f64) -> Outcome {
    let mass = 2.0;
    let mut world = world(rule)?;
    let force = DVec3::new(1.0, -mass * G, 0.0);
    world.add_force(ConstantForce::new(force))?;
    world.add_force(ViscousDrag::new(k))?;
    world.add_sphere(Sphere::new(FROM, 0.5).with_velocity(SPEED).with_mass(mass))?;
    run_until(&mut world, DURATION, FRAME)?;
    let (x, v) = under_drag(force / mass, k / mass, world.time());
    let spheres = world.spheres();
    let error = (spheres.positions()[0] - x).length().max((spheres.velocities()[0] - v).length());
    Ok(Measured::in_world(&world, error))
}

/// Position and velocity after `t` \[s\] for `x'' = a - c x'`.
fn under_drag(a: DVec3, c: f64, t: f64) -> (DVec3, DVec3) {
    let s = c * t;
    if s < 1e-6 {
        // Series in c t; the first omitted term is of the order of (c t)².
        let x = FROM + t * SPEED * (1.0 - s / 2.0) + 0.5 * t * t * a * (1.0 - s / 3.0);
        return (x, SPEED * (1.0 - s) + t * a * (1.0 - s / 2.0));
    }
    let terminal = a / c;
    let part = -libm::expm1(-s);
    let v = SPEED + (terminal - SPEED) * part;
    (FROM + terminal * t + (SPEED - terminal) * (part / c), v)
}

fn terminal_velocity(rule: Rule) -> Outcome {
    let mut world = world(rule)?;
    world.add_force(Gravity::new(DVec3::new(0.0, -G, 0.0)))?;
    world.add_force(ViscousDrag::new(3.0))?;
    world.add_sphere(Sphere::new(FROM, 0.5).with_velocity(SPEED).with_mass(2.0))?;
    run_until(&mut world, 100.0, FRAME)?;
    Ok(Measured::in_world(&world, world.spheres().velocities()[0].y))
}

/// Claim about a fall from rest at the origin over 600 frames.
fn scheme(
    name: String,
    expected: f64,
    integrator: Integrator,
    measure: fn(&World) -> f64,
) -> Claim {
    let tolerance =
        Tolerance::relative(600.0 * f64::EPSILON, "a rounding in each of the 600 steps");
    let expected = Expected::value(expected, "closed form of the scheme");
    let claim = Claim::new(name, expected, tolerance, move |_| {
        let mut world = world_with(integrator)?;
        world.add_force(Gravity::new(DVec3::new(0.0, -G, 0.0)))?;
        world.add_sphere(Sphere::new(DVec3::ZERO, 0.5))?;
        for _ in 0..600 {
            world.step(FRAME)?;
        }
        Ok(Measured::in_world(&world, measure(&world)))
    });
    claim.about(Rule::Discrete(Discrete::default()))
}

/// Claim about times of contact found by halving a frame; the error is relative to the final
/// bracket.
fn bisection_error(halvings: u32) -> Claim {
    // The tolerance is so small that no search ends before the last halving.
    let parameters = Bisect::default().with_tolerance(1e-14);
    let rule = Rule::Bisect(parameters.with_max_halvings(halvings));
    let claim = Claim::new(
        format!("bisect: {halvings} halvings find a contact to h/2^{halvings} [h/2^{halvings}]"),
        Expected::no_error("length of the bracket"),
        Tolerance::absolute(1.0 + 1e-6, "the bound itself, and rounding of times"),
        move |rule| {
            let gaps = (1..100).map(|i| 0.01 * f64::from(i) * FRAME);
            let errors: Result<Vec<Measured>, Error> =
                gaps.map(|time| contact_time_error(rule, time)).collect();
            let largest = Measured::largest(errors?);
            let bracket = FRAME / f64::from(1 << halvings);
            Ok(Measured { value: largest.value / bracket, ..largest })
        },
    );
    claim.about(rule)
}

/// Error of the time of an impact that occurs at `time` \[s\] within the first frame.
fn contact_time_error(rule: Rule, time: f64) -> Result<Measured, Error> {
    let mut world = world(rule)?;
    let speed = 1.5;
    let apart = DVec3::new(1.0 + 2.0 * speed * time, 0.0, 0.0);
    world.add_sphere(Sphere::new(DVec3::ZERO, 0.5).with_velocity(DVec3::new(speed, 0.0, 0.0)))?;
    world.add_sphere(Sphere::new(apart, 0.5).with_velocity(DVec3::new(-speed, 0.0, 0.0)))?;
    let found = world.step(FRAME)?.impacts.first().map_or(f64::INFINITY, |impact| impact.time);
    Ok(Measured::in_world(&world, (found - time).abs()))
}
