//! Sums over all spheres that physics keeps: energies and momenta.

use std::sync::Arc;

use glam::DVec3;

use crate::bodies::Spheres;
use crate::forces::{Force, SphereState};
use crate::numbered::Numbered;
use crate::sum::Sum;

/// Kinetic energy \[J\], `Σ m v² / 2`.
pub fn kinetic_energy(spheres: &Spheres) -> f64 {
    let terms = spheres.masses().iter().zip(spheres.velocities());
    terms.map(|(m, v)| 0.5 * m * v.dot(*v)).collect::<Sum>().value()
}

/// Potential energy \[J\] of all spheres in all forces that have one, at `time` \[s\].
pub(crate) fn potential_energy(
    spheres: &Spheres,
    forces: &Numbered<Arc<dyn Force>>,
    time: f64,
) -> f64 {
    let mut sum = Sum::default();
    for (i, (&position, &velocity)) in
        spheres.positions().iter().zip(spheres.velocities()).enumerate()
    {
        let (radius, mass) = (spheres.radii()[i], spheres.masses()[i]);
        let state = SphereState { position, velocity, radius, mass };
        for (_, force) in forces.iter() {
            sum.add(force.potential_energy(&state, time));
        }
    }
    sum.value()
}

/// Momentum \[kg m/s\], `Σ m v`.
pub fn momentum(spheres: &Spheres) -> DVec3 {
    sum(spheres, |m, _, v| m * v)
}

/// Angular momentum about the origin \[kg m²/s\], `Σ m x × v`.
pub fn angular_momentum(spheres: &Spheres) -> DVec3 {
    sum(spheres, |m, x, v| m * x.cross(v))
}

fn sum(spheres: &Spheres, term: impl Fn(f64, DVec3, DVec3) -> DVec3) -> DVec3 {
    let mut sums = [Sum::default(); 3];
    for (i, &m) in spheres.masses().iter().enumerate() {
        let term = term(m, spheres.positions()[i], spheres.velocities()[i]).to_array();
        sums.iter_mut().zip(term).for_each(|(sum, part)| sum.add(part));
    }
    DVec3::from_array(sums.map(|sum| sum.value()))
}
