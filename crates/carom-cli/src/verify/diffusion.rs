//! Self-diffusion in the fluid of hard spheres, and its dependence on the size of the periodic box.

use std::f64::consts::PI;

use carom::{DVec3, Error, Exact, Rule, World};

use super::claim::{Claim, Expected, Fault, Measured, Outcome, Shared, Tolerance};
use super::equation;
use crate::gas::{COLLISIONS_TO_EQUILIBRIUM, Filling, Speeds, gas, run_collisions};

/// Number density of the fluid.
const DENSITY: f64 = 0.5;
/// Collisions of each sphere in an interval between two records: the flow around a sphere has then spread over the
/// box, and on to its images.
const INTERVAL: u32 = 80;
/// Intervals between which the growth of the spread is measured.
const LAGS: [usize; 2] = [1, 4];
/// A small box, and a box with twice the edge, with the number of intervals in each.
const SMALL: (usize, usize) = (500, 400);
const LARGE: (usize, usize) = (4_000, 50);
/// ξ of a cubic lattice of images, in the slowing ξ k T/(6π η L) of a sphere by the flow around its images.
const LATTICE: f64 = 2.837_297;

pub fn claims() -> Vec<Claim> {
    let speed = Claim::new(
        "self-diffusion at number density 0.5, N = 500, by Speedy's formula",
        Expected::value(1.0, "Speedy 1987; for N = 500: Sigurgeirsson and Heyes 2003"),
        Tolerance::relative(0.02, "statistics 0.5 %, the formula itself 1 %"),
        |_| {
            let diffusion = in_small_box()?;
            Ok(Measured { value: diffusion.value / equation::diffusion(DENSITY), ..*diffusion })
        },
    );
    let size = Claim::new(
        "self-diffusion at number density 0.5, extrapolated from N = 500 by that from N = 4,000",
        Expected::value(1.0, "Dünweg and Kremer 1993; Yeh and Hummer 2004"),
        Tolerance::relative(
            0.02,
            "statistics 1 %, viscosity 0.2 %; without extrapolation it is 4 % less",
        ),
        |_| extrapolated(),
    );
    [speed, size].map(|it| it.slow().about(Rule::Exact(Exact::default()))).into()
}

/// Diffusion in a small box, divided by that in a large one, both freed of the flow around images.
fn extrapolated() -> Outcome {
    let slowing = |(count, _): (usize, usize)| {
        let filling = filling(count);
        let viscosity = equation::viscosity(filling.packing_fraction);
        LATTICE / (6.0 * PI * viscosity * filling.edge())
    };
    let (small, large) = (in_small_box()?, measured(LARGE)?);
    let value = (small.value + slowing(SMALL)) / (large.value + slowing(LARGE));
    Ok(Measured { value, ..large })
}

fn in_small_box() -> Result<&'static Measured, Fault> {
    static MEASURED: Shared<Measured> = Shared::new();
    MEASURED.get(|| measured(SMALL))
}

fn filling(count: usize) -> Filling {
    Filling { count, packing_fraction: PI / 6.0 * DENSITY }
}

/// Slope of the mean square displacement by time, divided by 6.
fn measured((count, intervals): (usize, usize)) -> Outcome {
    let filling = filling(count);
    let mut world = gas(filling, Speeds::Equilibrium, Rule::Exact(Exact::default()), 1)?;
    run_collisions(&mut world, filling.frame_time(), COLLISIONS_TO_EQUILIBRIUM)?;
    let mut ways = vec![DVec3::ZERO; count];
    let mut records = vec![ways.clone()];
    for _ in 0..intervals {
        follow(&mut world, filling, &mut ways)?;
        records.push(ways.clone());
    }
    let [short, long] = LAGS;
    let time = filling.time_of(f64::from(INTERVAL)) * (long - short) as f64;
    // The momentum is zero, so k T is 1 for one sphere less.
    let thermal = (count as f64 / (count - 1) as f64).sqrt();
    let growth = spread(&records, long) - spread(&records, short);
    Ok(Measured::in_world(&world, growth / (6.0 * time * thermal)))
}

/// Adds the displacements of an interval.
fn follow(world: &mut World, filling: Filling, ways: &mut [DVec3]) -> Result<(), Error> {
    let edge = filling.edge();
    for _ in 0..INTERVAL {
        let before = world.spheres().positions().to_vec();
        world.step(filling.time_of(1.0))?;
        let after = world.spheres().positions();
        for (way, (from, to)) in ways.iter_mut().zip(before.iter().zip(after)) {
            // A sphere flies far less than half of the box in a frame.
            let step = *to - *from;
            *way += step - edge * (step / edge).round();
        }
    }
    Ok(())
}

/// Mean square displacement over a number of intervals, of all spheres, from each record on.
fn spread(records: &[Vec<DVec3>], lag: usize) -> f64 {
    let pairs = records.iter().zip(&records[lag..]);
    let squares = pairs.flat_map(|(from, to)| from.iter().zip(to));
    let squares = squares.map(|(from, to)| (*to - *from).length_squared());
    let count = (records.len() - lag) * records[0].len();
    squares.sum::<f64>() / count as f64
}
