use std::sync::Arc;

use glam::DVec3;

use super::{Force, Interaction, SphereStates, Spring};
use crate::id::{SphereId, SpringId};
use crate::numbered::Numbered;

/// The forces of a world that act between spheres.
#[derive(Clone, Copy)]
pub(crate) struct Interactions<'a> {
    forces: &'a Numbered<Arc<dyn Force>>,
    springs: &'a Numbered<Spring>,
}

impl<'a> Interactions<'a> {
    /// The interactions among all forces, with the springs; `None` if there are none.
    pub fn of(forces: &'a Numbered<Arc<dyn Force>>, springs: &'a Numbered<Spring>) -> Option<Self> {
        let are_any = springs.iter().len() > 0
            || forces.iter().any(|(_, force)| force.interaction().is_some());
        are_any.then_some(Self { forces, springs })
    }

    /// Interactions among the forces, in the order in which they entered the world.
    pub fn list(&self) -> impl Iterator<Item = &'a dyn Interaction> + use<'a> {
        self.forces.iter().filter_map(|(_, force)| force.interaction())
    }

    /// The nonconservative interactions, without springs.
    fn nonconservative(&self) -> impl Iterator<Item = &'a dyn Interaction> {
        let forces = self.forces.iter().filter(|(_, force)| !force.is_conservative());
        forces.filter_map(|(_, force)| force.interaction())
    }

    /// Whether all interactions are conservative, apart from the dampers of springs.
    pub fn are_conservative_but_for_dampers(&self) -> bool {
        self.nonconservative().next().is_none()
    }

    /// Whether all interactions are conservative.
    pub fn are_conservative(&self) -> bool {
        self.are_conservative_but_for_dampers()
            && self.springs().all(|spring| spring.damping == 0.0)
    }

    /// Adds the nonconservative forces \[N\], without dampers.
    pub fn add_nonconservative(&self, spheres: &SphereStates, time: f64, forces: &mut [DVec3]) {
        self.nonconservative().for_each(|it| it.add_forces(spheres, time, forces));
    }

    /// Adds the forces \[N\] of the dampers of springs.
    pub fn add_damping(&self, spheres: &SphereStates, forces: &mut [DVec3]) {
        self.springs().for_each(|spring| spring.add_damping(spheres, forces));
    }

    /// Potential energy \[J\] of the nonconservative interactions.
    pub fn nonconservative_potential(&self, spheres: &SphereStates, time: f64) -> f64 {
        self.nonconservative().map(|it| it.potential_energy(spheres, time)).sum()
    }

    /// The conservative interactions, without springs.
    fn conservative(&self) -> impl Iterator<Item = &'a dyn Interaction> {
        let forces = self.forces.iter().filter(|(_, force)| force.is_conservative());
        forces.filter_map(|(_, force)| force.interaction())
    }

    /// Adds the conservative forces \[N\], without those of springs.
    pub fn add_conservative(&self, spheres: &SphereStates, time: f64, forces: &mut [DVec3]) {
        self.conservative().for_each(|it| it.add_forces(spheres, time, forces));
    }

    /// Potential energy \[J\] of the conservative interactions, without springs.
    pub fn conservative_potential(&self, spheres: &SphereStates, time: f64) -> f64 {
        self.conservative().map(|it| it.potential_energy(spheres, time)).sum()
    }

    /// The springs, in the order in which they entered the world.
    pub fn springs(&self) -> impl Iterator<Item = &'a Spring> + use<'a> {
        self.springs.iter().map(|(_, spring)| spring)
    }

    /// The springs with their ids, in the order in which they entered the world.
    pub fn numbered_springs(&self) -> impl Iterator<Item = (SpringId, &'a Spring)> + use<'a> {
        self.springs.iter().map(|(number, spring)| (SpringId(number), spring))
    }

    /// Whether there are only springs.
    pub fn are_springs(&self) -> bool {
        self.list().next().is_none()
    }

    /// Adds the forces \[N\] on all spheres without those of springs.
    pub fn add_forces_without_springs(
        &self,
        spheres: &SphereStates,
        time: f64,
        forces: &mut [DVec3],
    ) {
        self.list().for_each(|interaction| interaction.add_forces(spheres, time, forces));
    }

    /// Adds the forces \[N\] on all spheres: those among the forces in the order in which they entered the
    /// world, then springs in theirs.
    pub fn add_forces(&self, spheres: &SphereStates, time: f64, forces: &mut [DVec3]) {
        self.add_forces_without_springs(spheres, time, forces);
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

    /// An upper bound for the rate of the fastest motion on springs \[1/s\], of spheres with these ids and masses
    /// \[kg\]: by Gershgorin's circles no eigenvalue of the matrix of stiffness by mass is larger than
    /// `max Σ 2 k / m` over the springs at a sphere (`k / m` for one to a fixed point), and likewise that of
    /// damping by mass.
    pub fn fastest_spring_rate(&self, ids: &[SphereId], masses: &[f64]) -> f64 {
        let mut sums = vec![[0.0; 2]; ids.len()];
        for (_, spring) in self.springs.iter() {
            let ends = spring.spheres().count() as f64;
            for index in spring.spheres().flat_map(|id| ids.binary_search(&id)) {
                sums[index][0] += ends * spring.stiffness / masses[index];
                sums[index][1] += ends * spring.damping / masses[index];
            }
        }
        let largest = |which: usize| sums.iter().map(|sum| sum[which]).fold(0.0, f64::max);
        largest(0).sqrt() + largest(1)
    }

    /// Returns whether a force depends on velocities.
    pub fn depend_on_velocity(&self) -> bool {
        self.list().any(|interaction| interaction.depends_on_velocity())
            || self.springs.iter().any(|(_, spring)| spring.damping > 0.0)
    }
}
