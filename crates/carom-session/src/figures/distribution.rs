//! Distribution of the speeds of all balls, compared with that of an ideal gas.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use carom::DVec3;

use super::figure::{Curve, Figure, Hue};
use crate::view::View;

/// Largest number of bars.
const MOST_BARS: usize = 40;
/// Number of points of a line.
const POINTS: usize = 120;

/// Returns the distribution of the speeds, and the Maxwell-Boltzmann distribution at the same
/// temperature.
pub fn speeds(view: &View) -> Figure {
    let spheres = &view.spheres;
    let drift = drift(&spheres.velocities, &spheres.masses);
    let speeds: Vec<f64> = spheres.velocities.iter().map(|it| (*it - drift).length()).collect();
    let fastest = speeds.iter().copied().fold(0.0, f64::max);
    let bars = (2.0 * (speeds.len() as f64).sqrt()).clamp(8.0, MOST_BARS as f64) as usize;
    let width = if fastest > 0.0 { 1.0001 * fastest / bars as f64 } else { 1.0 };
    let mut counts = vec![0_u32; bars];
    for speed in &speeds {
        counts[((speed / width) as usize).min(bars - 1)] += 1;
    }
    let heights = counts.iter().enumerate();
    let heights = heights.map(|(i, count)| ((i as f64 + 0.5) * width, f64::from(*count)));
    let mut curves = vec![Curve::bars("balls", Hue::Blue, width, heights)];
    let thermal_energy = view.now.thermal_energy;
    if thermal_energy > 0.0 {
        let masses = counted(&spheres.masses);
        let step = 1.1 * fastest / POINTS as f64;
        let places: Vec<f64> = (0..=POINTS).map(|i| i as f64 * step).collect();
        let expected = |speed: f64| {
            let of_mass = |(mass, count): (f64, usize)| {
                count as f64 * density(speed, mass, thermal_energy, view.now.directions)
            };
            (speed, width * masses.iter().copied().map(of_mass).sum::<f64>())
        };
        curves.push(Curve::line("Maxwell-Boltzmann", Hue::Red, &places, |speed| expected(*speed)));
    }
    Figure::over("Balls by speed", "", ("speed relative to the mean motion", "m/s"), curves)
}

/// Returns the mean velocity of all balls, weighted by mass \[m/s\].
fn drift(velocities: &[DVec3], masses: &[f64]) -> DVec3 {
    let momentum: DVec3 = velocities.iter().zip(masses).map(|(v, m)| *m * *v).sum();
    let mass: f64 = masses.iter().sum();
    if mass > 0.0 { momentum / mass } else { DVec3::ZERO }
}

/// Counts how often each number occurs.
fn counted(numbers: &[f64]) -> Vec<(f64, usize)> {
    let mut counts = BTreeMap::new();
    // The bits of positive numbers are in the order of the numbers.
    numbers.iter().for_each(|it| *counts.entry(it.to_bits()).or_insert(0) += 1);
    counts.into_iter().map(|(bits, count)| (f64::from_bits(bits), count)).collect()
}

/// Returns the Maxwell-Boltzmann probability density of a speed \[s/m\], for molecules of a mass
/// \[kg\] that move in this number of directions with `heat` = k T \[J\].
fn density(speed: f64, mass: f64, heat: f64, directions: u8) -> f64 {
    let along = mass / heat;
    let weight = (-0.5 * along * speed * speed).exp();
    match directions {
        0 | 1 => (2.0 * along / PI).sqrt() * weight,
        2 => along * speed * weight,
        _ => (2.0 / PI).sqrt() * along.powf(1.5) * speed * speed * weight,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_molecules_have_some_speed_and_their_energy_is_that_of_the_temperature() {
        let (mass, heat, step) = (0.3, 0.7, 1e-3);
        for directions in 1..=3 {
            let moment = |power: i32| -> f64 {
                let term = |i: u32| {
                    let speed = (f64::from(i) + 0.5) * step;
                    speed.powi(power) * density(speed, mass, heat, directions) * step
                };
                (0..20_000).map(term).sum()
            };
            // The error of a midpoint sum is proportional to the square of the step.
            assert!((moment(0) - 1.0).abs() < 1e-6, "{directions}");
            let energy = 0.5 * mass * moment(2);
            assert!((energy - 0.5 * heat * f64::from(directions)).abs() < 1e-6, "{directions}");
        }
    }

    #[test]
    fn masses_are_counted() {
        assert_eq!(counted(&[2.0, 0.5, 2.0]), [(0.5, 1), (2.0, 2)]);
    }
}
