//! Invariants: sums over all spheres, the energies and momenta.

use std::sync::Arc;

use glam::DVec3;

use crate::bodies::Spheres;
use crate::forces::{Force, Interactions, SphereState, SphereStates, Spring};
use crate::numbered::Numbered;
use crate::shear::Shear;
use crate::sum::Sum;

/// Kinetic energy \[J\], `Σ m v² / 2 + I w² / 2`; in a box in steady shear of the motion relative to the mean flow.
pub fn kinetic_energy(spheres: &Spheres, shear: Option<Shear>) -> f64 {
    let energy = |m: &f64, v: DVec3| 0.5 * m * v.dot(v);
    let terms = spheres.masses().iter().zip(spheres.velocities());
    let Some(shear) = shear else {
        let of_motion = terms.map(|(m, v)| energy(m, *v));
        return of_motion.chain(rotational(spheres)).collect::<Sum>().value();
    };
    let terms = terms.zip(spheres.positions());
    let of_motion = terms.map(|((m, v), x)| energy(m, *v - shear.velocity_at(*x)));
    of_motion.chain(rotational(spheres)).collect::<Sum>().value()
}

/// Kinetic energy of rotation \[J\], `Σ I w² / 2`.
pub fn rotational_energy(spheres: &Spheres) -> f64 {
    rotational(spheres).collect::<Sum>().value()
}

fn rotational(spheres: &Spheres) -> impl Iterator<Item = f64> {
    let velocities = spheres.angular_velocities().iter().enumerate();
    velocities.map(|(i, w)| 0.5 * spheres.moment_of_inertia(i) * w.dot(*w))
}

/// Potential energy \[J\] of all spheres in all forces that have one, those between them included, at
/// `time` \[s\], in a box with edges `period` \[m\].
pub(crate) fn potential_energy(
    spheres: &Spheres,
    forces: &Numbered<Arc<dyn Force>>,
    springs: &Numbered<Spring>,
    period: DVec3,
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
    let states = SphereStates {
        ids: spheres.ids(),
        positions: spheres.positions(),
        velocities: spheres.velocities(),
        radii: spheres.radii(),
        masses: spheres.masses(),
        period,
    };
    if let Some(interactions) = Interactions::of(forces, springs) {
        interactions.potential_energies(&states, time).for_each(|energy| sum.add(energy));
    }
    sum.value()
}

/// Momentum \[kg m/s\], `Σ m v`.
pub fn momentum(spheres: &Spheres) -> DVec3 {
    sum(terms(spheres, |m, _, v| m * v))
}

/// Angular momentum about the origin \[kg m²/s\], `Σ m x × v + I w`.
pub fn angular_momentum(spheres: &Spheres) -> DVec3 {
    let velocities = spheres.angular_velocities().iter().enumerate();
    let of_spin = velocities.map(|(i, &w)| spheres.moment_of_inertia(i) * w);
    sum(terms(spheres, |m, x, v| m * x.cross(v)).chain(of_spin))
}

/// The term of each sphere of mass m at x with velocity v.
fn terms(
    spheres: &Spheres,
    term: impl Fn(f64, DVec3, DVec3) -> DVec3,
) -> impl Iterator<Item = DVec3> {
    let masses = spheres.masses().iter().enumerate();
    masses.map(move |(i, &m)| term(m, spheres.positions()[i], spheres.velocities()[i]))
}

fn sum(terms: impl Iterator<Item = DVec3>) -> DVec3 {
    let mut sums = [Sum::default(); 3];
    for term in terms {
        sums.iter_mut().zip(term.to_array()).for_each(|(sum, part)| sum.add(part));
    }
    DVec3::from_array(sums.map(|sum| sum.value()))
}
