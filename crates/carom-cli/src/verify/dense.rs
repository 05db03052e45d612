//! Dense fluids and jammed packings of spheres that grow (Lubachevsky and Stillinger).

use carom::packing::{self, Compression, Start, Until};
use carom::{Error, Exact, Rule, World};

use super::claim::{Claim, Expected, Measured, Outcome, Tolerance};

/// Number of spheres.
const COUNT: usize = 2_000;
/// Collisions of each sphere in equilibrium before the measurement, and in it.
const COLLISIONS: f64 = 200.0;

/// Claims about fluids.
pub fn fluids() -> Vec<Claim> {
    let claim = |(packing_fraction, z): (f64, f64)| {
        let name = format!("compressibility factor of a fluid that grew to {packing_fraction}");
        let reason = "statistics 0.3 %, the equation itself 0.3 %";
        let expected = Expected::value(z, "Carnahan and Starling 1969");
        Claim::new(name, expected, Tolerance::relative(0.01, reason), move |_| {
            compressibility(packing_fraction)
        })
    };
    let fluids = [(0.3, 3.9738), (0.4, 6.9259), (0.49, 12.1556)];
    fluids.into_iter().map(claim).map(|claim| claim.about(Rule::Exact(Exact::default()))).collect()
}

/// Claims about packings.
pub fn packings() -> Vec<Claim> {
    let source = "random close packing: Torquato, Truskett and Debenedetti, Phys. Rev. Lett. 84, 2064 (2000)";
    let reason = "0.003 between seeds and speeds of growth; the density itself is known to 0.01";
    let jammed = Claim::new(
        "spheres that grow jam: packing fraction",
        Expected::value(0.64, source),
        Tolerance::absolute(0.01, reason),
        |_| jamming(),
    );
    vec![jammed.slow().about(Rule::Exact(Exact::default()))]
}

fn grown(until: Until, packing_fraction: f64, growth: f64) -> Result<(World, f64), Error> {
    let start = Start::of(vec![0.5; COUNT], 1).with_packing_fraction(packing_fraction);
    let mut world = packing::start(&start)?;
    let compression = Compression::until(until).with_growth(growth);
    let compressed = packing::compress(&mut world, &compression)?;
    Ok((world, compressed.packing_fraction))
}

fn compressibility(packing_fraction: f64) -> Outcome {
    let (mut world, _) = grown(Until::PackingFraction(packing_fraction), packing_fraction, 0.05)?;
    // It measures over the second half.
    let fluid = packing::equilibrate(&mut world, 2.0 * COLLISIONS, None)?;
    Ok(Measured::in_world(&world, fluid.pressure))
}

fn jamming() -> Outcome {
    let (world, packing_fraction) = grown(Until::Pressure(1e6), 0.64, 0.02)?;
    Ok(Measured::in_world(&world, packing_fraction))
}
