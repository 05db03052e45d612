//! Dense fluids and jammed packings of spheres that grow (Lubachevsky and Stillinger).

use std::f64::consts::PI;

use carom::packing::{self, Compression, Start, Until};
use carom::{Error, Exact, Rule, StressMeter, World};
use carom_scene::Scene;

use super::claim::{Claim, Expected, Measured, Outcome, Tolerance};
use super::equation;

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
    let by_stress = Claim::new(
        "pressure of a fluid of the generator `dense-fluid` at 0.45, by its stress tensor [N k T/V]",
        Expected::value(9.3847, "Carnahan and Starling 1969"),
        Tolerance::relative(0.01, "statistics 0.3 %, the equation itself 0.3 %"),
        |_| pressure_by_stress(),
    );
    let mixtures = [(0.5, 0.3), (0.5, 0.45), (0.3, 0.4)].map(mixture);
    let claims = fluids.into_iter().map(claim).chain([by_stress]).chain(mixtures);
    claims.map(|claim| claim.about(Rule::Exact(Exact::default()))).collect()
}

/// Claim about a mixture of as many large spheres as small ones, by the ratio of their diameters.
fn mixture((ratio, packing_fraction): (f64, f64)) -> Claim {
    let z = equation::of_mixture(&species(ratio, packing_fraction));
    Claim::new(
        format!(
            "compressibility factor of a mixture of diameters 1 and {ratio} at {packing_fraction}"
        ),
        Expected::value(z, "Boublík 1970; Mansoori, Carnahan, Starling and Leland 1971"),
        Tolerance::relative(0.01, "statistics 0.3 %, the equation itself 0.5 %"),
        move |_| {
            let halves = [vec![0.5; COUNT / 2], vec![0.5 * ratio; COUNT / 2]];
            let start = Start::of(halves.concat(), 1).with_packing_fraction(packing_fraction);
            pressure_after_growth(&start, packing_fraction)
        },
    )
}

/// Diameter and number density of each species of such a mixture.
fn species(ratio: f64, packing_fraction: f64) -> [(f64, f64); 2] {
    let density = 6.0 / PI * packing_fraction / (1.0 + ratio * ratio * ratio);
    [(1.0, density), (ratio, density)]
}

/// Claims about packings.
pub fn packings() -> Vec<Claim> {
    let source = "isotropic, without friction: Agnolin and Roux, Phys. Rev. E 76, 061302 (2007); 0.64: Torquato et al., Phys. Rev. Lett. 84, 2064 (2000)";
    let reason = "0.003 between seeds and speeds of growth; the density itself is known to 0.01";
    let jammed = Claim::new(
        "spheres that grow jam: packing fraction",
        Expected::value(0.639, source),
        Tolerance::absolute(0.01, reason),
        |_| jamming(),
    );
    vec![jammed.slow().about(Rule::Exact(Exact::default()))]
}

fn equal_spheres(packing_fraction: f64) -> Start {
    Start::of(vec![0.5; COUNT], 1).with_packing_fraction(packing_fraction)
}

fn grown(start: &Start, until: Until, growth: f64) -> Result<(World, f64), Error> {
    let mut world = packing::start(start)?;
    let compression = Compression::until(until).with_growth(growth);
    let compressed = packing::compress(&mut world, &compression)?;
    Ok((world, compressed.packing_fraction))
}

fn compressibility(packing_fraction: f64) -> Outcome {
    pressure_after_growth(&equal_spheres(packing_fraction), packing_fraction)
}

fn pressure_after_growth(start: &Start, packing_fraction: f64) -> Outcome {
    let (mut world, _) = grown(start, Until::PackingFraction(packing_fraction), 0.05)?;
    // It measures over the second half.
    let fluid = packing::equilibrate(&mut world, 2.0 * COLLISIONS, None)?;
    Ok(Measured::in_world(&world, fluid.pressure))
}

/// A periodic box with the fluid of a scene file, whose k T is 1 J.
const FLUID: &str = r#"
name = "fluid"
simulation = { boundary = { periodic = { size = [13.25, 13.25, 13.25] } } }
[[generators]]
[generators.dense-fluid]
count = 2000
packing_fraction = 0.45
temperature = "1 J"
seed = 1
sphere = { mass = 1.0 }
"#;

/// Frames in which the stress of that fluid is measured, and their length \[s\]: some 80 collisions of each sphere.
const FRAMES: u32 = 100;
const FRAME: f64 = 0.05;

fn pressure_by_stress() -> Outcome {
    let scene = Scene::from_toml(FLUID, "fluid").expect("its fields are right");
    let mut world = scene.world().expect("a scene that was read has a world");
    let mut meter = StressMeter::new(&world);
    for _ in 0..FRAMES {
        world.step(FRAME)?;
        meter.add_frame(&world);
    }
    let stress = meter.stress(None)?;
    let volume = meter.volume().unwrap_or(f64::NAN);
    let pressure = stress.pressure() * volume / world.spheres().len() as f64;
    Ok(Measured::in_world(&world, pressure))
}

fn jamming() -> Outcome {
    let (world, packing_fraction) = grown(&equal_spheres(0.64), Until::Pressure(1e6), 0.02)?;
    Ok(Measured::in_world(&world, packing_fraction))
}
