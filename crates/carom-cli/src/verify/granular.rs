//! Inelastic spheres: cooling of a gas, and collapse.

use std::f64::consts::PI;

use carom::{DVec3, Error, Exact, RestitutionRule, Rule, Settings, Sphere, World};

use super::claim::{Claim, Expected, Measured, Outcome, Tolerance};
use super::setup::{FRAME, run_until, world};
use crate::gas::{COLLISIONS_TO_EQUILIBRIUM, Filling, Speeds, gas, run_collisions};

/// Restitution of the cooling gas.
const E: f64 = 0.95;
/// Collisions per sphere while it cools, long before clusters form.
const COLLISIONS: f64 = 20.0;
const FILLING: Filling = Filling { count: 4_000, packing_fraction: 0.5 * PI / 6.0 };
const SONINE: &str =
    "0.2 % for speeds that are not quite Maxwell's (van Noije and Ernst 1998), statistics 0.2 %";

pub fn claims() -> Vec<Claim> {
    let dissipation = (1.0 - E) * (1.0 + E);
    vec![
        Claim::new(
            format!("cooling gas, e = {E}: T/T0 after {COLLISIONS} collisions per sphere"),
            Expected::value(libm::exp(-dissipation * COLLISIONS / 3.0), "Haff 1983, exp(-(1-e²)n/3)"),
            Tolerance::relative(0.01, SONINE),
            temperature_after_collisions,
        ),
        Claim::new(
            format!("cooling gas, e = {E}: T (1 + t/tau)²/T0 stays 1"),
            Expected::value(1.0, "Haff 1983, 1/tau = (1-e²) w0/6"),
            Tolerance::relative(0.01, SONINE),
            temperature_by_time,
        ),
        Claim::new(
            "collapse of three balls in line, e = 0.05: the clock goes on [s]",
            Expected::value(5.0, "McNamara and Young 1992: e < 7 - 4 sqrt(3) = 0.0718"),
            Tolerance::absolute(1e-9, "rounding of 300 frames"),
            |rule| collapse(rule, 3, 0.05),
        ),
        Claim::new(
            "collapse of twelve balls in line, e = 0.5: the clock goes on [s]",
            Expected::value(5.0, "McNamara and Young 1992"),
            Tolerance::absolute(1e-9, "rounding of 300 frames"),
            |rule| collapse(rule, 12, 0.5),
        ),
    ]
}

/// A gas in elastic equilibrium at temperature 1, and its rate of collisions per sphere.
fn elastic(rule: Rule) -> Result<(World, f64), Error> {
    let h = FILLING.frame_time();
    let mut world = gas(FILLING, Speeds::Equilibrium, rule, 1)?;
    run_collisions(&mut world, h, COLLISIONS_TO_EQUILIBRIUM)?;
    let begin = world.time();
    run_collisions(&mut world, h, 50.0)?;
    let rate = 50.0 / (world.time() - begin);
    Ok((world, rate))
}

/// The same spheres, from now on with this restitution.
fn inelastic(world: &World) -> Result<World, Error> {
    let restitution_rule = RestitutionRule::Minimum;
    let mut cooling = World::new(Settings { restitution_rule, ..*world.settings() })?;
    for i in 0..world.spheres().len() {
        cooling.add_sphere(world.spheres().get(i).with_restitution(E))?;
    }
    Ok(cooling)
}

fn temperature_after_collisions(rule: Rule) -> Outcome {
    let (world, _) = elastic(rule)?;
    let mut cooling = inelastic(&world)?;
    let before = cooling.kinetic_energy();
    // A tenth of the frame: so that the count ends within 0.02 collisions of what is asked.
    run_collisions(&mut cooling, 0.1 * FILLING.frame_time(), COLLISIONS)?;
    Ok(Measured::in_world(&cooling, cooling.kinetic_energy() / before))
}

/// The value farthest from 1, over as long as it takes to cool to a half.
fn temperature_by_time(rule: Rule) -> Outcome {
    let (world, rate) = elastic(rule)?;
    let mut cooling = inelastic(&world)?;
    let before = cooling.kinetic_energy();
    let inverse_tau = (1.0 - E) * (1.0 + E) * rate / 6.0;
    let mut farthest = 1.0_f64;
    while cooling.time() * inverse_tau < 2.0_f64.sqrt() - 1.0 {
        cooling.step(FILLING.frame_time())?;
        let factor = 1.0 + cooling.time() * inverse_tau;
        let value = cooling.kinetic_energy() / before * factor * factor;
        if (value - 1.0).abs() > (farthest - 1.0).abs() {
            farthest = value;
        }
    }
    Ok(Measured::in_world(&cooling, farthest))
}

/// Balls in a line at rest, the outermost two coming in; gives the time that is reached.
fn collapse(rule: Rule, count: usize, e: f64) -> Outcome {
    let rule = match rule {
        // A ball takes part in a few impacts, and then in some dozens that become ever shorter.
        Rule::Exact(parameters) => Rule::Exact(Exact { max_impacts: 10_000, ..parameters }),
        other => other,
    };
    let mut world = world(rule)?;
    world.set_settings(Settings {
        restitution_rule: RestitutionRule::Minimum,
        ..*world.settings()
    })?;
    for i in 0..count {
        // Towards the middle, the faster the farther.
        let place = i as f64 - 0.5 * (count - 1) as f64;
        let sphere = Sphere::new(DVec3::new(1.5 * place, 0.0, 0.0), 0.5).with_restitution(e);
        world.add_sphere(sphere.with_velocity(DVec3::new(-place, 0.0, 0.0)))?;
    }
    run_until(&mut world, 5.0, FRAME)?;
    Ok(Measured::in_world(&world, world.time()))
}
