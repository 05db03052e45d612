//! Forces between all spheres of a world whose steps are taken together.

use glam::DVec3;

use crate::bodies::Properties;
use crate::forces::{Interactions, SphereStates};
use crate::integrate::gauss_radau::Values;
use crate::norm::Norm;
use crate::system::System;

/// Terms of a force may cancel, and leave their rounding: this part of the largest force of all counts as its size, too.
/// The terms of a step multiply rounding by less than 10⁴.
const CANCELLED: f64 = 1e-3;

/// Forces between all spheres, and where they are evaluated.
pub(super) struct ForcesBetween<'a> {
    interactions: Interactions<'a>,
    spheres: &'a Properties,
    /// Edges of the periodic box \[m\].
    period: DVec3,
    /// On each sphere, by index \[N\].
    forces: Vec<DVec3>,
}

impl<'a> ForcesBetween<'a> {
    /// Those of a world; `None` where its spheres do not move together.
    pub fn of(system: &System<'a>) -> Option<Self> {
        let interactions = system.interactions.filter(|_| system.moves_all_together())?;
        Some(Self {
            interactions,
            spheres: system.spheres,
            period: system.settings.boundary.period(),
            forces: vec![DVec3::ZERO; system.spheres.id.len()],
        })
    }

    /// Adds the accelerations of all spheres at a time \[s\], by index, which are here \[m\] and move with these
    /// velocities \[m/s\].
    pub fn add(&mut self, time: f64, [positions, velocities]: [&[DVec3]; 2], at: &mut Values) {
        let Properties { id, radius, mass, .. } = self.spheres;
        let period = self.period;
        let spheres =
            SphereStates { ids: id, positions, velocities, radii: radius, masses: mass, period };
        for interaction in self.interactions.list() {
            self.forces.fill(DVec3::ZERO);
            interaction.add_forces(&spheres, time, &mut self.forces);
            let sizes = self.forces.iter().map(|force| force.norm());
            let cancelled = CANCELLED * sizes.fold(0.0, f64::max);
            for (index, (&force, mass)) in self.forces.iter().zip(mass).enumerate() {
                at.accelerations[index] += force / mass;
                at.sizes[index] += (force.norm() + cancelled) / mass;
            }
        }
    }

    /// How much an evaluation of them takes, by that of the forces on one sphere.
    pub fn cost(&self) -> u64 {
        let count = self.forces.len() as u64;
        count * count / PAIRS_PER_SPHERE
    }
}

/// So many pairs of spheres take as long as the forces on one sphere by itself.
const PAIRS_PER_SPHERE: u64 = 32;
