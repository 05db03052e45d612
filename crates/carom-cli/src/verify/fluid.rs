//! The fluid of elastic hard spheres in equilibrium: diameter 1, m = kT = 1, in a periodic box.

use std::f64::consts::PI;

use carom::{BodyPair, Rule, World};

use super::claim::{Claim, Expected, Measured, Outcome, Tolerance};
use super::{dense, diffusion, equation, non_additive};
use crate::gas::{COLLISIONS_TO_EQUILIBRIUM, Filling, Speeds, gas, run_collisions};

/// Number of spheres: fills a face-centred cubic lattice of 10 cells along an edge.
const COUNT: usize = 4_000;
/// Number of spheres for the full verification, with 20 cells along an edge.
const LARGE_COUNT: usize = 32_000;
/// Collisions per sphere for averages: with 4,000 spheres, the standard error of the pressure is
/// about 0.2 %.
const COLLISIONS: f64 = 200.0;

pub fn claims() -> Vec<Claim> {
    let mut claims = Vec::new();
    for (packing_fraction, z) in [(0.2, 2.4063), (0.3, 3.9738), (0.4, 6.9259)] {
        let reason = "as demanded; statistics 0.2 %, the equation itself 0.3 %";
        claims.push(pressure(packing_fraction, z, COUNT, Tolerance::relative(0.01, reason)));
        let reason = "the equation itself 0.3 % (virial series), statistics 0.1 %";
        let tolerance = Tolerance::relative(0.005, reason);
        claims.push(pressure(packing_fraction, z, LARGE_COUNT, tolerance).slow());
    }
    claims.extend([
        Claim::new(
            "mean free time per sphere at number density 0.5",
            Expected::value(0.1303, "Lue 2005, molecular dynamics"),
            Tolerance::relative(0.005, "statistics 0.1 %, the published digits 0.04 %, N 0.03 %"),
            mean_free_time,
        ),
        Claim::new(
            "equal speeds relax to Maxwell-Boltzmann: <v^4>/<v^2>^2",
            Expected::value(5.0 / 3.0, "moments of a normal distribution"),
            Tolerance::relative(0.01, "statistics of 100 looks at 4,000 spheres: 0.2 %"),
            fourth_moment,
        ),
    ]);
    claims.extend(dense::fluids());
    claims.extend(non_additive::claims());
    claims.extend(diffusion::claims());
    claims.extend([0.2, 0.4, 0.6, 0.7, 0.8, 0.9].map(accurate_pressure));
    claims
}

/// Number of spheres for accurate pressures: fills a face-centred cubic lattice of 14 cells along an edge.
const ACCURATE_COUNT: usize = 10_976;
/// Impacts of an accurate pressure, whose standard error is about their inverse square root.
const ACCURATE_IMPACTS: f64 = 1e8;

/// Claim about the pressure at a number density.
fn accurate_pressure(density: f64) -> Claim {
    let packing_fraction = PI / 6.0 * density;
    let filling = Filling { count: ACCURATE_COUNT, packing_fraction };
    Claim::new(
        format!("compressibility factor at number density {density}, 10^8 impacts"),
        Expected::value(equation::kolafa(packing_fraction), "Kolafa, Labík and Malijevský 2004"),
        Tolerance::relative(3e-4, "three standard errors of 1e-4"),
        move |rule| {
            let outcome = virial(rule, filling, ACCURATE_IMPACTS)?;
            Ok(Measured { value: unbounded(filling, outcome.value), ..outcome })
        },
    )
    .long()
}

/// Compressibility factor of an infinite number of spheres, given `1 + Σ r·Δp / (2 K t)` of some in a periodic box.
///
/// Without a total momentum, k T is `2 K / 3 (N - 1)`. With a fixed number, the mean of f = n² χ lacks
/// `s n²/(2 N) d²f/dn²`, with the isothermal compressibility s = n k T κ (Lebowitz and Percus, Phys. Rev. 122, 1675
/// (1961)).
fn unbounded(filling: Filling, z: f64) -> f64 {
    let Filling { count, packing_fraction: p } = filling;
    let count = count as f64;
    let excess = |p: f64| equation::kolafa(p) - 1.0;
    // A thousandth balances the errors of rounding and of the finite differences.
    let h = 1e-3 * p;
    // f is proportional to p times the excess.
    let second =
        ((p + h) * excess(p + h) - 2.0 * p * excess(p) + (p - h) * excess(p - h)) / (h * h);
    let slope = (excess(p + h) - excess(p - h)) / (2.0 * h);
    let compressibility = 1.0 / (1.0 + excess(p) + p * slope);
    let lacks = compressibility * p * second / (2.0 * count * excess(p));
    1.0 + (z - 1.0) * (1.0 - 1.0 / count) / (1.0 - lacks)
}

/// Claim about the pressure at a packing fraction, where the compressibility factor is `z`.
fn pressure(packing_fraction: f64, z: f64, count: usize, tolerance: Tolerance) -> Claim {
    Claim::new(
        format!("compressibility factor at packing fraction {packing_fraction}, N = {count}"),
        Expected::value(z, "Carnahan and Starling 1969"),
        tolerance,
        move |rule| compressibility(rule, Filling { count, packing_fraction }),
    )
}

fn filling(packing_fraction: f64) -> Filling {
    Filling { count: COUNT, packing_fraction }
}

/// `Z = 1 + Σ r·Δp / (3 N kT t)`, the virial of the impacts: for each, the distance of the centres
/// times the impulse along it. `3 N kT` is twice the kinetic energy. Alder and Wainwright, J. Chem.
/// Phys. 33, 1439 (1960).
fn compressibility(rule: Rule, filling: Filling) -> Outcome {
    virial(rule, filling, 0.5 * COLLISIONS * filling.count as f64)
}

/// [`compressibility`] over at least this number of impacts.
fn virial(rule: Rule, filling: Filling, least: f64) -> Outcome {
    let h = filling.frame_time();
    let mut world = equilibrium(filling, rule)?;
    let (mut virial, mut impacts, begin) = (0.0, 0, world.time());
    while (impacts as f64) < least {
        let report = world.step(h)?;
        impacts += report.impacts.len();
        // The spheres touch, so the distance of their centres is the diameter.
        virial += report.impacts.iter().map(|impact| impact.impulse).sum::<f64>();
    }
    let time = world.time() - begin;
    let z = 1.0 + virial / (2.0 * world.kinetic_energy() * time);
    Ok(Measured::in_world(&world, z))
}

fn mean_free_time(rule: Rule) -> Outcome {
    let filling = filling(0.5 * PI / 6.0);
    let h = filling.frame_time();
    let mut world = equilibrium(filling, rule)?;
    let (mut collisions, begin) = (0, world.time());
    while (collisions as f64) < COLLISIONS * COUNT as f64 {
        let impacts = &world.step(h)?.impacts;
        let spheres = impacts.iter().map(|impact| match impact.between {
            BodyPair::Spheres(..) => 2,
            BodyPair::Collider { .. } => 0,
        });
        collisions += spheres.sum::<usize>();
    }
    let mean = (world.time() - begin) * COUNT as f64 / collisions as f64;
    Ok(Measured::in_world(&world, mean))
}

fn fourth_moment(rule: Rule) -> Outcome {
    let filling = filling(0.2);
    let h = filling.frame_time();
    let mut world = gas(filling, Speeds::Equal, rule, 1)?;
    run_collisions(&mut world, h, COLLISIONS_TO_EQUILIBRIUM)?;
    let looks = 100;
    let mut sum = 0.0;
    for _ in 0..looks {
        run_collisions(&mut world, h, 1.0)?;
        sum += moment(&world);
    }
    Ok(Measured::in_world(&world, sum / f64::from(looks)))
}

/// Present value of `<v^4>/<v^2>^2`.
fn moment(world: &World) -> f64 {
    let squares = || world.spheres().velocities().iter().map(|v| v.length_squared());
    let count = world.spheres().len() as f64;
    let mean = squares().sum::<f64>() / count;
    squares().map(|square| square * square).sum::<f64>() / count / (mean * mean)
}

/// Creates a gas in equilibrium.
fn equilibrium(filling: Filling, rule: Rule) -> Result<World, carom::Error> {
    let mut world = gas(filling, Speeds::Equilibrium, rule, 1)?;
    run_collisions(&mut world, filling.frame_time(), COLLISIONS_TO_EQUILIBRIUM)?;
    Ok(world)
}
