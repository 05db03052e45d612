use std::sync::Arc;

use glam::DVec3;

use super::{Force, Interaction, SphereStates, Spring};
use crate::numbered::Numbered;

/// The forces of a world that act between spheres.
#[derive(Clone, Copy)]
pub(crate) struct Interactions<'a> {
    forces: &'a Numbered<Arc<dyn Force>>,
    springs: &'a Numbered<Spring>,
}

impl<'a> Interactions<'a> {
    /// Those among all forces, and springs; `None` if there are none.
    pub fn of(forces: &'a Numbered<Arc<dyn Force>>, springs: &'a Numbered<Spring>) -> Option<Self> {
        let are_any = springs.iter().len() > 0
            || forces.iter().any(|(_, force)| force.interaction().is_some());
        are_any.then_some(Self { forces, springs })
    }

    fn list(&self) -> impl Iterator<Item = &'a dyn Interaction> {
        self.forces.iter().filter_map(|(_, force)| force.interaction())
    }

    /// Adds the forces \[N\] on all spheres: those among the forces in the order in which they entered the
    /// world, then springs in theirs.
    pub fn add_forces(&self, spheres: &SphereStates, time: f64, forces: &mut [DVec3]) {
        self.list().for_each(|interaction| interaction.add_forces(spheres, time, forces));
        self.springs.iter().for_each(|(_, spring)| spring.add_forces(spheres, forces));
    }

    /// Potential energies \[J\], one for each.
    pub fn potential_energies(
        &self,
        spheres: &SphereStates<'a>,
        time: f64,
    ) -> impl Iterator<Item = f64> {
        let of_forces = self.list().map(move |it| it.potential_energy(spheres, time));
        let of_springs = self.springs.iter().map(|(_, spring)| spring.potential_energy(spheres));
        of_forces.chain(of_springs)
    }

    /// Whether one of them depends on velocities.
    pub fn depend_on_velocity(&self) -> bool {
        self.list().any(|interaction| interaction.depends_on_velocity())
            || self.springs.iter().any(|(_, spring)| spring.damping > 0.0)
    }
}
