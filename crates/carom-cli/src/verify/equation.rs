//! Equations of state and transport coefficients of hard spheres, by packing fraction.

use std::f64::consts::PI;

/// Compressibility factor P V/(N k T) of a fluid of equal spheres, 2·10⁻⁵ from molecular dynamics up to freezing.
///
/// Power series in x = p/(1 - p): Kolafa, Labík and Malijevský, Phys. Chem. Chem. Phys. 6, 2335 (2004).
pub fn kolafa(packing_fraction: f64) -> f64 {
    const TERMS: [(i32, f64); 12] = [
        (0, 1.0),
        (1, 4.0),
        (2, 6.0),
        (3, 2.364_768_4),
        (4, -0.869_855_1),
        (5, 1.106_280_3),
        (6, -1.101_422_1),
        (7, 0.666_058_66),
        (8, -0.036_334_31),
        (10, -0.209_651_64),
        (14, 0.105_555_69),
        (22, -0.008_723_80),
    ];
    let x = packing_fraction / (1.0 - packing_fraction);
    TERMS.iter().map(|&(power, factor)| factor * x.powi(power)).sum()
}

/// Compressibility factor of a mixture, given the diameter and the number density of each species.
///
/// Boublík, J. Chem. Phys. 53, 471 (1970); Mansoori, Carnahan, Starling and Leland, J. Chem. Phys. 54, 1523 (1971).
pub fn of_mixture(species: &[(f64, f64)]) -> f64 {
    let moment = |power: i32| {
        let terms = species.iter().map(|&(diameter, density)| density * diameter.powi(power));
        PI / 6.0 * terms.sum::<f64>()
    };
    let [n, one, two, p] = [0, 1, 2, 3].map(moment);
    let free = 1.0 - p;
    let pressure = n / free
        + 3.0 * one * two / (free * free)
        + (3.0 - p) * two * two * two / (free * free * free);
    pressure / n
}

/// Contact value of the pair correlation of equal spheres (Carnahan and Starling 1969).
pub fn contact_value(packing_fraction: f64) -> f64 {
    let free = 1.0 - packing_fraction;
    (1.0 - 0.5 * packing_fraction) / (free * free * free)
}

/// Viscosity of spheres with diameter, mass and k T of 1 by Enskog's theory (Chapman and Cowling 1970, 16.41).
pub fn viscosity(packing_fraction: f64) -> f64 {
    let (b, contact_value) = (4.0 * packing_fraction, contact_value(packing_fraction));
    let dilute = 1.016 * 5.0 / (16.0 * PI.sqrt());
    dilute * (1.0 / contact_value + 0.8 * b + 0.7615 * b * b * contact_value)
}

/// Self-diffusion of spheres with diameter, mass and k T of 1 at a number density (Speedy, Mol. Phys. 62, 509 (1987)).
pub fn diffusion(density: f64) -> f64 {
    let square = density * density;
    let dilute = 0.375 / (PI.sqrt() * density);
    dilute * (1.0 - density / 1.09) * (1.0 + square * (0.4 - 0.83 * square))
}
