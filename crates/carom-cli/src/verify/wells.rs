//! The fluid of spheres with square wells, against its virial series.

use std::f64::consts::PI;

use carom::{Exact, PairPotential, Rule, StressMeter, Thermostat, World};

use super::claim::{Claim, Expected, Fault, Measured, Shared, Tolerance};
use crate::gas::{Filling, Speeds, gas, run_collisions};

/// Number density of the gas.
const DENSITY: f64 = 0.05;
const FILLING: Filling = Filling { count: 2_048, packing_fraction: PI / 6.0 * DENSITY };
/// Depth of the wells in k T at the start, which the wells heat to about 1.2.
const DEPTH: f64 = 0.55;
const RANGE: f64 = 1.5;
/// Frames in which the gas is measured, of one collision of each sphere without wells, and such collisions before.
const FRAMES: u32 = 300;
const COLLISIONS: f64 = 20.0;

pub fn claims() -> Vec<Claim> {
    let source = "B2 and B3 of Kihara, Rev. Mod. Phys. 25, 831 (1953), in closed form";
    let pressure = Claim::new(
        "gas with square wells of range 1.5 at the density 0.05: pressure by its virial series",
        Expected::value(1.0, source),
        Tolerance::relative(0.003, "statistics 0.1 %, further terms 0.05 %"),
        |_| gas_by_series().map(|[pressure, _]| pressure),
    );
    let energy = Claim::new(
        "gas with square wells of range 1.5 at the density 0.05: potential energy by its virial series",
        Expected::value(1.0, source),
        Tolerance::relative(0.01, "statistics 0.3 %, further terms 0.3 %"),
        |_| gas_by_series().map(|[_, energy]| energy),
    );
    let rule = Rule::Exact(Exact::default());
    [pressure, energy].into_iter().chain(dense()).map(|claim| claim.about(rule)).collect()
}

/// Packing fraction of the dense fluid, whose wells have a depth of k T/2.
const DENSE: Filling = Filling { count: 4_000, packing_fraction: PI / 6.0 * DENSE_DENSITY };
const DENSE_DENSITY: f64 = 0.668_482;
/// Pressure and potential energy of a sphere in that fluid \[k T\]; its runs had 2·10⁹ steps.
const OF_ETOMICA: [f64; 2] = [1.8072, -2.4729];

/// Claims about a dense fluid.
fn dense() -> [Claim; 2] {
    let source = "molecular dynamics of etomica (Schultz and Kofke), TestSWMD3D";
    let pressure = Claim::new(
        "fluid with square wells of range 1.5 and depth k T/2 at the density 0.6685: pressure",
        Expected::value(OF_ETOMICA[0], source),
        Tolerance::relative(0.01, "statistics 0.4 %, those of the source 0.2 %"),
        |_| Ok(dense_fluid()?[0]),
    );
    let energy = Claim::new(
        "fluid with square wells of range 1.5 and depth k T/2 at the density 0.6685: potential energy",
        Expected::value(OF_ETOMICA[1], source),
        Tolerance::relative(0.002, "statistics 0.05 %, those of the source 0.03 %"),
        |_| Ok(dense_fluid()?[1]),
    );
    [pressure, energy].map(Claim::slow)
}

/// Pressure and potential energy of a sphere in the dense fluid, for k T = 1.
fn dense_fluid() -> Result<&'static [Measured; 2], Fault> {
    static FLUID: Shared<[Measured; 2]> = Shared::new();
    FLUID.get(run_dense_fluid)
}

fn run_dense_fluid() -> Result<[Measured; 2], Fault> {
    let mut world = gas(DENSE, Speeds::Equilibrium, Rule::Exact(Exact::default()), 1)?;
    let well = PairPotential::SquareWell { depth: 0.5, range_ratio: RANGE };
    let interval = DENSE.time_of(1.0);
    let thermostat = Thermostat::Rescale { interval, temperature: 1.0 };
    let settings = world.settings().with_pair_potential(Some(well));
    world.set_settings(settings.with_thermostat(Some(thermostat)))?;
    for _ in 0..FRAMES {
        world.step(interval)?;
    }
    let (mut meter, mut potential) = (StressMeter::new(&world), 0.0);
    for _ in 0..FRAMES {
        world.step(interval)?;
        meter.add_frame(&world);
        potential += world.potential_energy() / f64::from(FRAMES);
    }
    let pressure = meter.stress(None)?.pressure();
    let values = [pressure, potential / DENSE.count as f64];
    Ok(values.map(|value| Measured::in_world(&world, value)))
}

/// Coefficients of the virial series at a temperature, for spheres of diameter 1.
struct Series {
    /// B2 and B3.
    virial: [f64; 2],
    /// Derivatives of the coefficients by x = exp(ε/kT) - 1.
    by_x: [f64; 2],
    x: f64,
}

impl Series {
    fn at(temperature: f64) -> Self {
        let x = libm::expm1(DEPTH / temperature);
        let core = 2.0 * PI / 3.0;
        let power = |exponent: i32| RANGE.powi(exponent);
        let shell = power(3) - 1.0;
        let a = power(6) - 18.0 * power(4) + 32.0 * power(3) - 15.0;
        let b = 2.0 * power(6) - 36.0 * power(4) + 32.0 * power(3) + 18.0 * power(2) - 16.0;
        let c = 6.0 * power(6) - 18.0 * power(4) + 18.0 * power(2) - 6.0;
        let square = core * core / 8.0;
        Self {
            virial: [core * (1.0 - shell * x), square * (5.0 - a * x - b * x * x - c * x * x * x)],
            by_x: [-core * shell, -square * (a + 2.0 * b * x + 3.0 * c * x * x)],
            x,
        }
    }

    /// Compressibility factor p V/(N k T).
    fn pressure(&self) -> f64 {
        let [second, third] = self.virial;
        1.0 + DENSITY * (second + DENSITY * third)
    }

    /// Potential energy of a sphere, in the depth of the wells.
    fn energy(&self) -> f64 {
        let [second, third] = self.by_x;
        (1.0 + self.x) * DENSITY * (second + 0.5 * DENSITY * third)
    }
}

/// Pressure and potential energy of the gas, each divided by that of the series at its temperature.
fn gas_by_series() -> Result<[Measured; 2], Fault> {
    let rule = Rule::Exact(Exact::default());
    let mut world = gas(FILLING, Speeds::Equilibrium, rule, 1)?;
    let well = PairPotential::SquareWell { depth: DEPTH, range_ratio: RANGE };
    world.set_settings(world.settings().with_pair_potential(Some(well)))?;
    run_collisions(&mut world, FILLING.frame_time(), COLLISIONS)?;
    let (count, mut kinetic, mut potential) = (FILLING.count as f64, 0.0, 0.0);
    let mut meter = StressMeter::new(&world);
    for _ in 0..FRAMES {
        world.step(FILLING.time_of(1.0))?;
        meter.add_frame(&world);
        kinetic += world.kinetic_energy() / f64::from(FRAMES);
        potential += world.potential_energy() / f64::from(FRAMES);
    }
    // The momentum is zero, so three of all coordinates are not free.
    let temperature = 2.0 * kinetic / (3.0 * (count - 1.0));
    let series = Series::at(temperature);
    let volume = meter.volume().unwrap_or(f64::NAN);
    let pressure = meter.stress(None)?.pressure() * volume / (count * temperature);
    let energy = potential / (count * DEPTH);
    let of = |world: &World, value: f64| Measured::in_world(world, value);
    Ok([of(&world, pressure / series.pressure()), of(&world, energy / series.energy())])
}
