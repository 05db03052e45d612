//! What impacts did to momentum and energy.

use glam::DVec3;

use crate::norm::Norm;
use crate::report::ImpactGroup;
use crate::respond::reduced_mass;
use crate::sum::Sum;

/// Momentum and energy of the spheres before and after.
pub(super) fn account_of([before, after]: [&[DVec3]; 2], masses: &[f64]) -> ImpactGroup {
    let momentum = |velocities: &[DVec3]| {
        let part = |axis: usize| {
            masses.iter().zip(velocities).map(|(m, v)| m * v[axis]).collect::<Sum>().value()
        };
        DVec3::new(part(0), part(1), part(2))
    };
    let energy = |velocities: &[DVec3]| {
        let terms = masses.iter().zip(velocities).map(|(m, v)| 0.5 * m * v.length_squared());
        terms.collect::<Sum>().value()
    };
    let size = |velocities: &[DVec3]| {
        masses.iter().zip(velocities).map(|(m, v)| m * v.norm()).collect::<Sum>().value()
    };
    ImpactGroup {
        momentum_before: momentum(before),
        momentum_after: momentum(after),
        momentum_scale: size(before).max(size(after)),
        energy_before: energy(before),
        energy_after: energy(after),
        ..ImpactGroup::default()
    }
}

/// What an impact of two spheres did to momentum and energy.
pub(super) fn account_of_pair(
    before: [DVec3; 2],
    after: [DVec3; 2],
    masses: [f64; 2],
    approach_speed: f64,
    restitution: f64,
) -> ImpactGroup {
    let [m1, m2] = masses;
    let energy = |[v1, v2]: [DVec3; 2]| 0.5 * (m1 * v1.length_squared() + m2 * v2.length_squared());
    let lost = (1.0 - restitution) * (1.0 + restitution);
    ImpactGroup {
        momentum_before: m1 * before[0] + m2 * before[1],
        momentum_after: m1 * after[0] + m2 * after[1],
        momentum_scale: m1 * before[0].norm() + m2 * before[1].norm(),
        energy_before: energy(before),
        energy_after: energy(after),
        energy_demanded: -0.5 * reduced_mass(masses) * lost * approach_speed * approach_speed,
        ..ImpactGroup::default()
    }
}
