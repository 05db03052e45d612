//! Gases in steady shear: viscosity of elastic spheres, steady temperature of inelastic ones.

use carom::{CombineRule, DVec3, Error, Exact, Rule, SphereMotion, Thermostat, World};

use super::claim::{Claim, Expected, Measured, Outcome, Tolerance};
use super::{dense_flow, equation};
use crate::gas::{Filling, Speeds, gas};

/// Dense enough for half of the stress to be that of impacts.
const VISCOUS: Filling = Filling { count: 2_048, packing_fraction: 0.2 };
/// Shear rate of the fluid, a twentieth of the collision rate.
const RATE: f64 = 0.2;
/// Collisions of each sphere before the stress is measured, and meanwhile.
const COLLISIONS: [f64; 2] = [20.0, 500.0];
/// A million spheres, and their collisions.
const MILLION: Filling = Filling { count: 1_000_000, ..VISCOUS };
const COLLISIONS_OF_MILLION: [f64; 2] = [5.0, 5.0];

/// Dilute, so that impacts move no momentum.
const DILUTE: Filling = Filling { count: 500, packing_fraction: 0.005 };
/// Restitution of the granular gas.
const E: f64 = 0.9;
/// Collisions of each sphere before the temperature is measured, and meanwhile.
const STEADY: [f64; 2] = [200.0, 800.0];

pub fn claims() -> Vec<Claim> {
    let by_enskog = |spheres: &str, statistics: &'static str, measure: fn() -> Outcome| {
        Claim::new(
            format!(
                "{spheres} of packing fraction 0.2 in steady shear: viscosity by that of Enskog"
            ),
            Expected::value(1.0, "Enskog's theory (Chapman and Cowling 1970, 16.41)"),
            Tolerance::relative(0.05, statistics),
            move |_| measure(),
        )
    };
    let viscosity_of_few = by_enskog(
        "elastic gas",
        "statistics 1.4 %, Enskog 2 % (Alder, Gass and Wainwright 1970), nonlinear 1 %",
        || viscosity(VISCOUS, COLLISIONS),
    );
    let viscosity_of_million = by_enskog(
        "a million spheres",
        "statistics 0.7 %, Enskog 2 % (Alder, Gass and Wainwright 1970), nonlinear 1 %",
        || viscosity(MILLION, COLLISIONS_OF_MILLION),
    );
    let temperature = Claim::new(
        format!("dilute gas, e = {E}, in steady shear: T by that of kinetic theory"),
        Expected::value(1.0, "Grad's moments (Santos, Garzó and Dufty 2004)"),
        Tolerance::relative(0.06, "density 3 %, statistics 1.5 %, higher moments 1 %"),
        |_| steady_temperature(),
    );
    let claims = [viscosity_of_few.slow(), viscosity_of_million.long(), temperature.slow()];
    let of_gases = claims.map(|claim| claim.about(Rule::Exact(Exact::default())));
    of_gases.into_iter().chain(dense_flow::claims()).collect()
}

/// Creates a gas of the temperature 1 about the mean flow of a shear.
fn sheared(filling: Filling, rate: f64) -> Result<World, Error> {
    let mut world = gas(filling, Speeds::Equilibrium, Rule::Exact(Exact::default()), 1)?;
    world.set_settings(world.settings().with_shear_rate(rate))?;
    let spheres = world.spheres();
    let motion = |index: usize| {
        let position = spheres.positions()[index];
        let flow = DVec3::new(rate * position.y, 0.0, 0.0);
        SphereMotion {
            id: spheres.ids()[index],
            position,
            velocity: spheres.velocities()[index] + flow,
        }
    };
    let motions: Vec<SphereMotion> = (0..spheres.len()).map(motion).collect();
    world.set_motions(&motions)?;
    Ok(world)
}

/// Stress by shear rate of the elastic gas at the temperature 1, divided by Enskog's viscosity.
fn viscosity(filling: Filling, [before, measured]: [f64; 2]) -> Outcome {
    let mut world = sheared(filling, RATE)?;
    let interval = filling.time_of(1.0);
    let thermostat = Thermostat::Rescale { interval, temperature: 1.0 };
    world.set_settings(world.settings().with_thermostat(Some(thermostat)))?;
    let mut work = 0.0;
    for frame in 0..(before + measured) as u32 {
        let account = world.step(interval)?.energy_account;
        work += if f64::from(frame) < before { 0.0 } else { account.shear };
    }
    let volume = libm::pow(filling.edge(), 3.0);
    let viscosity = work / (volume * RATE * RATE * measured * interval);
    let enskog = equation::viscosity(filling.packing_fraction);
    Ok(Measured::in_world(&world, viscosity / enskog))
}

/// Mean temperature of the inelastic gas, divided by that of Grad's moments.
fn steady_temperature() -> Outcome {
    let cooling = 5.0 / 12.0 * (1.0 - E) * (1.0 + E);
    let stress = 0.5 * (1.0 + E) * (1.0 - (1.0 - E) / 3.0);
    let reduced = (1.5 * cooling / stress).sqrt() * (stress + cooling);
    // The rate of which the viscosity is the inverse is 4/5 of that of collisions.
    let rate = reduced * 0.8 * DILUTE.collision_rate();
    let mut world = sheared(DILUTE, rate)?;
    world.set_settings(world.settings().with_combine_rule(CombineRule::Minimum))?;
    for id in world.spheres().ids().to_vec() {
        world.set_sphere(id, world.sphere(id)?.with_restitution(E))?;
    }
    let [before, measured] = STEADY;
    let mut sum = 0.0;
    for frame in 0..(before + measured) as u32 {
        world.step(DILUTE.time_of(1.0))?;
        sum += if f64::from(frame) < before { 0.0 } else { world.kinetic_energy() };
    }
    let temperature = sum / measured / (1.5 * DILUTE.count as f64);
    Ok(Measured::in_world(&world, temperature))
}
