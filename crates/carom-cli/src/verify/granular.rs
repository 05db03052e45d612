//! Inelastic spheres: cooling of a gas, and collapse.

use carom::{CombineRule, DVec3, Error, Exact, RestitutionLaw, Rule, Sphere, Thermostat, World};

use super::claim::{Claim, Expected, Measured, Outcome, Tolerance};
use super::setup::{FRAME, run_until, world};
use crate::gas::{COLLISIONS_TO_EQUILIBRIUM, Filling, Speeds, gas, run_collisions};

/// Restitution of the cooling gas.
const E: f64 = 0.95;
/// Collisions per sphere while it cools, long before clusters form.
const COLLISIONS: f64 = 20.0;
/// Dilute, so that the velocities of colliding spheres are independent, as in Haff's argument.
const FILLING: Filling = Filling { count: 16_384, packing_fraction: 0.05 };
/// Viscoelastic spheres, with e = 0.94 at the thermal speed.
const LAW: RestitutionLaw = RestitutionLaw::Viscoelastic { speed: 2.6e6 };
/// Gas that white noise drives to a temperature of about 1.
const DRIVEN: Filling = Filling { count: 2_048, packing_fraction: 0.05 };
/// Restitution of the driven gas.
const DRIVEN_E: f64 = 0.9;
/// Strength of the noise.
const STRENGTH: f64 = 0.045;
/// Frames until the driven gas is steady, and in which it is measured, of one collision of each sphere.
const DRIVEN_FRAMES: [u32; 2] = [60, 200];
const REASON: &str =
    "0.24 % as speeds are not quite Maxwell's (van Noije, Ernst 1998), statistics 0.25 %";

pub fn claims() -> Vec<Claim> {
    let dissipation = (1.0 - E) * (1.0 + E);
    let driven = Claim::new(
        format!("gas driven by white noise, e = {DRIVEN_E}: steady T by that of kinetic theory"),
        Expected::value(1.0, "van Noije and Ernst 1998, with their second Sonine coefficient"),
        Tolerance::relative(0.02, "statistics 0.7 %, correlated velocities 1 %"),
        |_| driven_temperature(),
    );
    let driven = driven.about(Rule::Exact(Exact::default()));
    vec![
        driven,
        Claim::new(
            format!("cooling gas, e = {E}: -ln(T/T0) for each collision of a sphere"),
            Expected::value(dissipation / 3.0, "Haff 1983, T = T0 exp(-(1-e²) n/3)"),
            Tolerance::relative(0.01, REASON),
            loss_per_collision,
        ),
        Claim::new(
            format!("cooling gas, e = {E}: T (1 + t/tau)²/T0 stays 1"),
            Expected::value(1.0, "Haff 1983, 1/tau = (1-e²) w0/6"),
            Tolerance::relative(0.01, REASON),
            temperature_by_time,
        ),
        Claim::new(
            "cooling gas of viscoelastic spheres: T^(-3/5) rises as much again in the same time",
            Expected::value(
                1.0,
                "Schwager and Pöschel 1998, T = T0 (1 + t/tau)^(-5/3); 1.07 for t^-2",
            ),
            Tolerance::relative(0.02, "statistics 1 %, second order of the law 0.5 %"),
            viscoelastic_cooling,
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

/// Creates a gas in elastic equilibrium whose spheres are inelastic from now on.
fn about_to_cool(rule: Rule, inelastic: impl Fn(Sphere) -> Sphere) -> Result<World, Error> {
    let mut world = gas(FILLING, Speeds::Equilibrium, rule, 1)?;
    run_collisions(&mut world, FILLING.frame_time(), COLLISIONS_TO_EQUILIBRIUM)?;
    let combine_rule = CombineRule::Minimum;
    let mut cooling = World::new(world.settings().with_combine_rule(combine_rule))?;
    for i in 0..world.spheres().len() {
        cooling.add_sphere(inelastic(world.spheres().get(i)))?;
    }
    Ok(cooling)
}

fn loss_per_collision(rule: Rule) -> Outcome {
    let mut cooling = about_to_cool(rule, |sphere| sphere.with_restitution(E))?;
    let before = cooling.kinetic_energy();
    let collisions = run_collisions(&mut cooling, FILLING.frame_time(), COLLISIONS)?;
    let loss = libm::log(before / cooling.kinetic_energy()) / collisions;
    Ok(Measured::in_world(&cooling, loss))
}

/// How much T^(-3/5) rises after the temperature has fallen to 0.44, by how much it rose before, in as many frames.
fn viscoelastic_cooling(rule: Rule) -> Outcome {
    let mut cooling = about_to_cool(rule, |sphere| sphere.with_restitution_law(LAW))?;
    let before = cooling.kinetic_energy();
    let risen = |world: &World| libm::pow(world.kinetic_energy() / before, -0.6);
    let mut frames = 0;
    while cooling.kinetic_energy() > 0.44 * before {
        cooling.step(FILLING.frame_time())?;
        frames += 1;
    }
    let half = risen(&cooling);
    for _ in 0..frames {
        cooling.step(FILLING.frame_time())?;
    }
    let ratio = (risen(&cooling) - half) / (half - 1.0);
    Ok(Measured::in_world(&cooling, ratio))
}

/// Mean temperature of a gas that white noise drives, divided by that of kinetic theory.
fn driven_temperature() -> Outcome {
    let mut world = gas(DRIVEN, Speeds::Equilibrium, Rule::Exact(Exact::default()), 1)?;
    let interval = 0.1 * DRIVEN.time_of(1.0);
    let noise = Thermostat::WhiteNoise { interval, strength: STRENGTH, seed: 1 };
    let settings = world.settings().with_combine_rule(CombineRule::Minimum);
    world.set_settings(settings.with_thermostat(Some(noise)))?;
    for id in world.spheres().ids().to_vec() {
        world.set_sphere(id, world.sphere(id)?.with_restitution(DRIVEN_E))?;
    }
    let [before, measured] = DRIVEN_FRAMES;
    let mut sum = 0.0;
    for frame in 0..before + measured {
        world.step(DRIVEN.time_of(1.0))?;
        sum += if frame < before { 0.0 } else { world.kinetic_energy() };
    }
    let count = DRIVEN.count as f64;
    let temperature = sum / f64::from(measured) / (1.5 * count);
    // The noise keeps the momentum, so one of all spheres does not count.
    let heating = STRENGTH * (1.0 - 1.0 / count);
    let (e, dissipation) = (DRIVEN_E, (1.0 - DRIVEN_E) * (1.0 + DRIVEN_E));
    // The rate of collisions at the temperature 1 is 4π χ n σ²/√π.
    let bare = 3.0 * heating / (dissipation * DRIVEN.collision_rate());
    let sonine =
        16.0 * (1.0 - e) * (1.0 - 2.0 * e * e) / (241.0 - 177.0 * e + 30.0 * (1.0 - e) * e * e);
    let expected = libm::pow(bare / (1.0 + 3.0 / 16.0 * sonine), 2.0 / 3.0);
    Ok(Measured::in_world(&world, temperature / expected))
}

/// Value farthest from 1 until the temperature has fallen to a half.
fn temperature_by_time(rule: Rule) -> Outcome {
    let mut cooling = about_to_cool(rule, |sphere| sphere.with_restitution(E))?;
    let before = cooling.kinetic_energy();
    let inverse_tau = (1.0 - E) * (1.0 + E) * FILLING.collision_rate() / 6.0;
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

/// Balls in a line that approach the middle; measures the time that is reached.
fn collapse(rule: Rule, count: usize, e: f64) -> Outcome {
    let rule = match rule {
        // A ball takes part in a few impacts, then in dozens at ever shorter intervals.
        Rule::Exact(parameters) => Rule::Exact(parameters.with_max_impacts(10_000)),
        other => other,
    };
    let mut world = world(rule)?;
    world.set_settings(world.settings().with_combine_rule(CombineRule::Minimum))?;
    for i in 0..count {
        // Velocities point to the middle and increase with the distance.
        let place = i as f64 - 0.5 * (count - 1) as f64;
        let sphere = Sphere::new(DVec3::new(1.5 * place, 0.0, 0.0), 0.5).with_restitution(e);
        world.add_sphere(sphere.with_velocity(DVec3::new(-place, 0.0, 0.0)))?;
    }
    run_until(&mut world, 5.0, FRAME)?;
    Ok(Measured::in_world(&world, world.time()))
}
