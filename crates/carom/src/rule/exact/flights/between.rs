//! Forces between all spheres of a world whose steps are taken together.

use glam::DVec3;

use crate::bodies::Properties;
use crate::forces::{Interactions, SphereStates};
use crate::integrate::field::Values;
use crate::norm::Norm;
use crate::system::System;

/// Part of the largest force of all that counts as a size of each force: its terms may cancel and leave their rounding,
/// which the terms of a step multiply by less than 10⁴.
const CANCELLED: f64 = 1e-3;

/// Forces between all spheres, and where they are evaluated.
pub(super) struct ForcesBetween<'a> {
    interactions: Interactions<'a>,
    spheres: &'a Properties,
    /// Edges of the periodic box \[m\].
    period: DVec3,
    /// Forces on the spheres, by index \[N\].
    forces: Vec<DVec3>,
}

impl<'a> ForcesBetween<'a> {
    /// Forces of a world; `None` where its spheres do not move together.
    pub fn of(system: &System<'a>) -> Option<Self> {
        let interactions = system.interactions.filter(|_| system.moves_all_together())?;
        Some(Self {
            interactions,
            spheres: system.spheres,
            period: system.settings.boundary.period(),
            forces: vec![DVec3::ZERO; system.spheres.id.len()],
        })
    }

    /// Adds the accelerations of all spheres, by index, at a time \[s\] with these positions \[m\] and velocities \[m/s\].
    pub fn add(&mut self, time: f64, [positions, velocities]: [&[DVec3]; 2], at: &mut Values) {
        let Properties { id, radius, mass, .. } = self.spheres;
        let period = self.period;
        let spheres =
            SphereStates { ids: id, positions, velocities, radii: radius, masses: mass, period };
        for interaction in self.interactions.list() {
            self.forces.fill(DVec3::ZERO);
            interaction.add_forces(&spheres, time, &mut self.forces);
            let squares = self.forces.iter().map(|force| force.length_squared());
            let cancelled = CANCELLED * squares.fold(0.0, f64::max).sqrt();
            for (index, (&force, mass)) in self.forces.iter().zip(mass).enumerate() {
                at.accelerations[index] += force / mass;
                at.sizes[index] += (force.norm() + cancelled) / mass;
            }
        }
    }

    /// Cost of an evaluation, in evaluations of the forces on one sphere.
    pub fn cost(&self) -> u64 {
        let count = self.forces.len() as u64;
        count * count / PAIRS_PER_SPHERE
    }
}

/// Pairs of spheres that cost as much as the forces on one sphere by itself.
const PAIRS_PER_SPHERE: u64 = 32;
