//! Fluids of spheres that touch at other distances than the sums of their radii: against equations of state of the
//! diameters that these distances amount to, and against the virial series.

use std::f64::consts::PI;

use carom::{Exact, MaterialPair, Rule, StressMeter, World};

use super::claim::{Claim, Expected, Fault, Measured, Outcome, Tolerance};
use super::equation;
use crate::gas::{COLLISIONS_TO_EQUILIBRIUM, Filling, Speeds, gas, run_collisions};

/// Number of spheres, of diameter 1.
const COUNT: usize = 2_048;
/// Frames in which a fluid is measured, each of one collision of a sphere.
const FRAMES: u32 = 800;
/// Number density of the gases for which three terms of the virial series suffice.
const DILUTE: f64 = 0.03;

/// Diameters in units of the distances of spheres of radius 1/2: of materials 1, both, and 2.
type Distances = [f64; 3];

/// Claims about fluids.
pub fn claims() -> Vec<Claim> {
    let swollen = Claim::new(
        "non-additive spheres, all distances 1.2 times the sums of radii, at 0.4: compressibility factor of their diameters",
        Expected::value(equation::kolafa(0.4), "Kolafa, Labík and Malijevský 2004"),
        Tolerance::relative(0.01, "statistics 0.3 %"),
        |_| compressibility([1.2; 3], 0.4 * 6.0 / PI / 1.2f64.powi(3)),
    );
    let density = 0.4 * 6.0 / PI / (0.5 * (1.0 + 0.6f64.powi(3)));
    let halves = [(1.0, 0.5 * density), (0.6, 0.5 * density)];
    let mixture = Claim::new(
        "non-additive spheres whose distances are those of diameters 1 and 0.6, at 0.4: compressibility factor",
        Expected::value(equation::of_mixture(&halves), "Boublík 1970"),
        Tolerance::relative(0.01, "statistics 0.3 %, the equation itself 0.3 %"),
        move |_| compressibility([1.0, 0.8, 0.6], density),
    );
    let source = "B2 and B3 of non-additive spheres (Kihara 1943; Hamad 1996), in closed form";
    let dilute = [-0.5, 0.2, 0.6].map(|non_additivity: f64| {
        let distances = [1.0, 1.0 + non_additivity, 1.0];
        Claim::new(
            format!(
                "gas of spheres with the non-additivity {non_additivity}: pressure beyond N k T/V"
            ),
            Expected::value(virial(distances), source),
            Tolerance::relative(0.015, "statistics 0.4 %, further terms 0.5 %"),
            move |_| Ok(beyond_ideal(compressibility(distances, DILUTE)?)),
        )
    });
    let rule = Rule::Exact(Exact::default());
    [swollen, mixture].into_iter().chain(dilute).map(|claim| claim.slow().about(rule)).collect()
}

fn beyond_ideal(measured: Measured) -> Measured {
    Measured { value: measured.value - 1.0, ..measured }
}

/// Second and third term of the virial series of as many spheres of one material as of the other.
fn virial([first, both, second]: Distances) -> f64 {
    let distance = [[first, both], [both, second]];
    let (mut of_pairs, mut of_triples) = (0.0, 0.0);
    for i in 0..2 {
        for j in 0..2 {
            of_pairs += 0.25 * 2.0 * PI / 3.0 * distance[i][j].powi(3);
            for k in 0..2 {
                of_triples += 0.125 * triple([distance[i][j], distance[i][k], distance[j][k]]);
            }
        }
    }
    DILUTE * (of_pairs + DILUTE * of_triples)
}

/// Third virial coefficient of three spheres with these contact distances, none of which is larger than the sum of the
/// other two (Hamad, J. Chem. Phys. 105, 3222 (1996)).
fn triple([a, b, c]: Distances) -> f64 {
    let term = |own: f64, one: f64, other: f64| {
        let [x, y, z] = [one + other - own, own + other - one, own + one - other];
        own * own * x * x * (own * x + 1.5 * y * z)
    };
    PI * PI / 27.0 * (term(a, b, c) + term(b, a, c) + term(c, a, b))
}

/// Compressibility factor of a fluid at a number density.
fn compressibility(distances: Distances, density: f64) -> Outcome {
    let filling = Filling { count: COUNT, packing_fraction: PI / 6.0 * density };
    let (mut world, frame) = (fluid(filling, distances)?, filling.time_of(1.0));
    run_collisions(&mut world, filling.frame_time(), 3.0 * COLLISIONS_TO_EQUILIBRIUM)?;
    let mut meter = StressMeter::new(&world);
    for _ in 0..FRAMES {
        world.step(frame)?;
        meter.add_frame(&world);
    }
    let volume = meter.volume().unwrap_or(f64::NAN);
    let temperature = world.kinetic_energy() / (1.5 * (COUNT as f64 - 1.0));
    let stress = meter.stress(None)?.collisional;
    let virial = volume * (stress.x_axis.x + stress.y_axis.y + stress.z_axis.z) / 3.0;
    Ok(Measured::in_world(&world, 1.0 + virial / (COUNT as f64 * temperature)))
}

fn fluid(filling: Filling, [first, both, second]: Distances) -> Result<World, Fault> {
    let mut world = gas(filling, Speeds::Equilibrium, Rule::Exact(Exact::default()), 1)?;
    let of = |one, other, distance: f64| {
        MaterialPair::new(one, other).with_non_additivity(distance - 1.0)
    };
    world.set_material_pairs([of(1, 1, first), of(1, 2, both), of(2, 2, second)])?;
    let ids = world.spheres().ids().to_vec();
    for (number, id) in (0..).zip(ids) {
        let sphere = world.sphere(id)?;
        world.set_sphere(id, sphere.with_material(1 + (number % 2) as u8))?;
    }
    Ok(world)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_spheres_have_the_known_third_coefficient() {
        // 5/8 of the square of the second, to the rounding of a few sums.
        let known = 0.625 * (2.0 * PI / 3.0).powi(2);
        assert!((triple([1.0; 3]) / known - 1.0).abs() < 1e-14);
    }

    #[test]
    fn the_third_coefficient_is_the_integral_over_the_overlap_of_two_spheres() {
        let overlap = |r: f64, [first, second]: [f64; 2]| {
            let (sum, difference) = (first + second, first - second);
            if r <= difference.abs() {
                return 4.0 * PI / 3.0 * first.min(second).powi(3);
            }
            let rest = (sum - r).max(0.0);
            PI * rest * rest * (r * r + 2.0 * r * sum - 3.0 * difference * difference) / (12.0 * r)
        };
        for all @ [pair, first, second] in
            [[1.0, 1.0, 1.6], [1.6, 1.0, 1.6], [1.0, 0.8, 0.6], [0.5, 1.0, 0.5], [1.0, 0.5, 0.5]]
        {
            let step = pair / 1e5;
            let terms = (0..100_000).map(|number| {
                let r = (f64::from(number) + 0.5) * step;
                4.0 * PI * r * r * overlap(r, [first, second]) * step / 3.0
            });
            // The midpoint rule, whose error is the square of the step.
            let ratio = triple(all) / terms.sum::<f64>();
            assert!((ratio - 1.0).abs() < 1e-9, "{all:?}: {ratio}");
        }
    }
}
