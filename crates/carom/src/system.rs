//! The input of a step, which it never changes.

use std::sync::Arc;

use glam::DVec3;

use crate::bodies::{Motion, Properties};
use crate::colliders::Colliders;
use crate::detect::contact::Bodies;
use crate::detect::moving_surfaces::{MovingSurfaces, PlacedTree};
use crate::detect::passage::FrameStart;
use crate::detect::surface_tree::SurfaceTree;
use crate::forces::{self, Force, Interactions, SphereState, SphereStates, Spring};
use crate::friction::Friction;
use crate::id::SpringId;
use crate::material_pair::{MaterialPair, MaterialPairs};
use crate::numbered::Numbered;
use crate::settings::Settings;
use crate::sum::Sum;
use crate::surface::{LastCarriage, Surface};

/// Largest number of spheres with forces between them all that take steps of high order together under the rule
/// `exact`. Each impact restarts all of them, and each step evaluates all forces some tens of times, so that the cost of
/// a cloud that collides grows with the cube of its number.
const MOST_TOGETHER: usize = 32;

/// The world during one step, without the motion of its spheres.
#[derive(Clone, Copy)]
pub(crate) struct System<'a> {
    pub settings: &'a Settings,
    /// Pairs of materials with coefficients of their own.
    pub material_pairs: &'a MaterialPairs,
    pub forces: &'a Numbered<Arc<dyn Force>>,
    /// Forces between spheres; `None` where there are none.
    pub interactions: Option<Interactions<'a>>,
    pub colliders: &'a Colliders,
    pub surfaces: &'a [Surface],
    pub tree: &'a SurfaceTree,
    /// The surfaces that move and deflect.
    pub moving: &'a MovingSurfaces,
    /// The surfaces that move and report.
    pub moving_triggers: &'a MovingSurfaces,
    /// Time \[s\] for which the surfaces have moved on since the step began; `None` at its start.
    pub moved_for: Option<f64>,
    /// Tree of the surfaces that report contact and deflect nothing.
    pub trigger_tree: &'a SurfaceTree,
    pub spheres: &'a Properties,
    /// Under rules that find at the end of a frame what spheres meet.
    pub frame_start: Option<FrameStart<'a>>,
}

impl<'a> System<'a> {
    pub fn new(
        (settings, material_pairs): (&'a Settings, &'a MaterialPairs),
        forces: &'a Numbered<Arc<dyn Force>>,
        springs: &'a Numbered<Spring>,
        colliders: &'a Colliders,
        spheres: &'a Properties,
    ) -> Self {
        let (surfaces, tree) = (colliders.surfaces(), colliders.tree());
        let trigger_tree = colliders.trigger_tree();
        let interactions = Interactions::of(forces, springs);
        Self {
            settings,
            material_pairs,
            forces,
            interactions,
            colliders,
            surfaces,
            tree,
            moving: colliders.moving(),
            moving_triggers: colliders.moving_triggers(),
            moved_for: None,
            trigger_tree,
            spheres,
            frame_start: None,
        }
    }

    /// Whether any collider moves.
    pub fn has_moving_surfaces(&self) -> bool {
        self.colliders.any_moving()
    }

    /// Whether the material of any surface moves along it.
    pub fn has_belts(&self) -> bool {
        self.colliders.list().iter().any(|(_, it)| it.surface_velocity != DVec3::ZERO)
    }

    /// The surfaces that move and deflect, where they are `h` \[s\] after the step began.
    pub fn moving_after(
        &self,
        h: f64,
        last: &LastCarriage,
    ) -> impl Iterator<Item = PlacedTree<'a>> {
        self.moving.placed((self.colliders.list(), self.surfaces), h, last)
    }

    /// The surfaces that move and report, where they are `h` \[s\] after the step began.
    pub fn moving_triggers_after(
        &self,
        h: f64,
        last: &LastCarriage,
    ) -> impl Iterator<Item = PlacedTree<'a>> {
        self.moving_triggers.placed((self.colliders.list(), self.surfaces), h, last)
    }

    /// Whether two spheres collide, by their groups.
    #[inline]
    pub fn spheres_meet(&self, first: u32, second: u32) -> bool {
        let Properties { groups, .. } = self.spheres;
        groups.is_empty() || groups[first as usize].collides(groups[second as usize])
    }

    /// Whether a sphere and a surface collide, by their groups, and the sphere does not pass it from behind in the
    /// frame.
    #[inline]
    pub fn meets_surface(&self, sphere: u32, surface: u32) -> bool {
        let (surface, index) = (&self.surfaces[surface as usize], sphere as usize);
        let radius = self.spheres.radius[index];
        let all = (self.surfaces, self.tree);
        let passes = |start: FrameStart| start.passes(index, radius, surface, all);
        self.spheres.groups(index).collides(surface.groups) && !self.frame_start.is_some_and(passes)
    }

    /// The pair of materials that two bodies are of, if it has coefficients of its own.
    #[inline]
    pub fn material_pair(&self, bodies: Bodies) -> Option<&'a MaterialPair> {
        if self.material_pairs.is_empty() {
            return None;
        }
        let of_sphere = |sphere: u32| self.spheres.material(sphere as usize);
        self.material_pairs.of(match bodies {
            Bodies::Pair(first, second) => [first, second].map(of_sphere),
            Bodies::Surface { sphere, surface } => {
                [self.surfaces[surface as usize].material, of_sphere(sphere)]
            }
        })
    }

    /// Radii of two spheres \[m\], by index, multiplied by the factor of their contact distance: they touch where their
    /// centres are as far apart as the sum.
    #[inline]
    pub fn contact_radii(&self, spheres: [u32; 2]) -> [f64; 2] {
        let radii = spheres.map(|sphere| self.spheres.radius[sphere as usize]);
        let non_additivity = &self.material_pairs.non_additivity;
        if non_additivity.is_none() {
            return radii;
        }
        let materials = spheres.map(|sphere| self.spheres.material(sphere as usize));
        let factor = non_additivity.factor(materials);
        radii.map(|radius| factor * radius)
    }

    /// Radius of a sphere, by index, multiplied by the largest factor of its contact distances \[m\].
    #[inline]
    pub fn reach_of(&self, sphere: u32) -> f64 {
        let radius = self.spheres.radius[sphere as usize];
        let non_additivity = &self.material_pairs.non_additivity;
        if non_additivity.is_none() {
            return radius;
        }
        non_additivity.reach(self.spheres.material(sphere as usize)) * radius
    }

    /// Whether the restitution of two spheres may differ from that which the combine rule gives for their two
    /// coefficients.
    #[inline]
    pub fn has_other_restitutions(&self) -> bool {
        !(self.spheres.restitution_law.is_empty() && self.material_pairs.is_empty())
    }

    /// Whether forces act between spheres.
    #[inline]
    pub fn has_interactions(&self) -> bool {
        self.interactions.is_some()
    }

    /// The springs, in the order in which they entered the world.
    pub fn springs(&self) -> impl Iterator<Item = &'a Spring> {
        self.interactions.into_iter().flat_map(|interactions| interactions.springs())
    }

    /// The springs with their ids, in the order in which they entered the world.
    pub fn numbered_springs(&self) -> impl Iterator<Item = (SpringId, &'a Spring)> {
        self.interactions.into_iter().flat_map(|interactions| interactions.numbered_springs())
    }

    /// Whether forces act between all spheres, not on springs only.
    pub fn couples_all(&self) -> bool {
        self.interactions.is_some_and(|interactions| !interactions.are_springs())
    }

    /// Whether forces act between all spheres, and they are few enough to take their steps together.
    pub fn moves_all_together(&self) -> bool {
        self.couples_all() && self.spheres.id.len() <= MOST_TOGETHER
    }

    /// Whether forces act between all spheres, and they are too many to take their steps together.
    pub fn holds_forces_of_all(&self) -> bool {
        self.couples_all() && !self.moves_all_together()
    }

    /// Whether a force between spheres depends on how they move.
    pub fn has_damped_interactions(&self) -> bool {
        self.interactions.is_some_and(|it| it.depend_on_velocity())
    }

    /// Whether nonconservative forces act.
    pub fn has_nonconservative_forces(&self) -> bool {
        !self.spheres.applied_force.is_empty()
            || !forces::are_conservative(self.forces)
            || self.interactions.is_some_and(|it| !it.are_conservative())
    }

    /// The nonconservative forces between spheres \[N\] on each of them, dampers included, where they are at
    /// `positions` \[m\] and move with `velocities` \[m/s\] at a time on the world's clock \[s\].
    pub fn nonconservative_forces_between(
        &self,
        states: [&[DVec3]; 2],
        time: f64,
        forces: &mut Vec<DVec3>,
    ) {
        self.nonconservative_interactions(states, time, forces);
        if let Some(interactions) = self.interactions {
            interactions.add_damping(&self.states(states), forces);
        }
    }

    /// Whether forces between spheres other than dampers are nonconservative.
    pub fn has_nonconservative_interactions(&self) -> bool {
        self.interactions.is_some_and(|it| !it.are_conservative_but_for_dampers())
    }

    /// The nonconservative forces between spheres \[N\] without dampers, as in
    /// [`Self::nonconservative_forces_between`].
    pub fn nonconservative_interactions(
        &self,
        states: [&[DVec3]; 2],
        time: f64,
        forces: &mut Vec<DVec3>,
    ) {
        self.sum_interactions(states, forces, |interactions, spheres, forces| {
            interactions.add_nonconservative(spheres, time, forces);
        });
    }

    /// The conservative forces between spheres \[N\] without springs, as in
    /// [`Self::nonconservative_forces_between`].
    pub fn conservative_interactions(
        &self,
        states: [&[DVec3]; 2],
        time: f64,
        forces: &mut Vec<DVec3>,
    ) {
        self.sum_interactions(states, forces, |interactions, spheres, forces| {
            interactions.add_conservative(spheres, time, forces);
        });
    }

    /// Writes the forces \[N\] that `add` adds to those of no interaction.
    fn sum_interactions(
        &self,
        states: [&[DVec3]; 2],
        forces: &mut Vec<DVec3>,
        add: impl FnOnce(Interactions, &SphereStates, &mut [DVec3]),
    ) {
        forces.clear();
        forces.resize(states[0].len(), DVec3::ZERO);
        if let Some(interactions) = self.interactions {
            add(interactions, &self.states(states), forces);
        }
    }

    /// Potential energy \[J\] of the conservative forces between spheres, without springs.
    pub fn conservative_interaction_potential(&self, states: [&[DVec3]; 2], time: f64) -> f64 {
        let spheres = self.states(states);
        self.interactions.map_or(0.0, |it| it.conservative_potential(&spheres, time))
    }

    /// Potential energy \[J\] of the conservative forces between spheres, springs included.
    pub fn conservative_potential_between(&self, states: [&[DVec3]; 2], time: f64) -> f64 {
        let spheres = self.states(states);
        let of_springs = self.springs().map(|spring| spring.potential_energy(&spheres));
        of_springs.sum::<f64>() + self.conservative_interaction_potential(states, time)
    }

    /// Potential energy \[J\] in nonconservative forces of spheres at `positions` \[m\] with `velocities` \[m/s\], at a
    /// time on the world's clock \[s\].
    pub fn nonconservative_potential(&self, states: [&[DVec3]; 2], time: f64) -> f64 {
        let spheres = self.states(states);
        let of_each = (0..spheres.len()).map(|index| {
            let state = SphereState {
                position: spheres.positions[index],
                velocity: spheres.velocities[index],
                radius: spheres.radii[index],
                mass: spheres.masses[index],
            };
            forces::nonconservative_potential(self.forces, &state, time)
        });
        let between = |it: Interactions| it.nonconservative_potential(&spheres, time);
        of_each.collect::<Sum>().value() + self.interactions.map_or(0.0, between)
    }

    /// All spheres at `positions` \[m\] with `velocities` \[m/s\].
    pub fn states<'b>(&'b self, [positions, velocities]: [&'b [DVec3]; 2]) -> SphereStates<'b> {
        let Properties { id, radius, mass, .. } = self.spheres;
        let period = self.settings.boundary.period();
        SphereStates { ids: id, positions, velocities, radii: radius, masses: mass, period }
    }

    /// The forces between spheres \[N\] on each of them, where they are at `positions` \[m\] and move with
    /// `velocities` \[m/s\] at a time on the world's clock \[s\].
    pub fn forces_between(&self, states: [&[DVec3]; 2], time: f64, forces: &mut Vec<DVec3>) {
        forces.clear();
        forces.resize(states[0].len(), DVec3::ZERO);
        if let Some(interactions) = self.interactions {
            interactions.add_forces(&self.states(states), time, forces);
        }
    }

    /// Potential energy of a sphere \[J\] at a time on the world's clock \[s\], without forces between spheres.
    pub fn potential_energy_alone(&self, motion: &Motion, index: usize, time: f64) -> f64 {
        let state = SphereState {
            position: motion.position[index],
            velocity: motion.velocity[index],
            radius: self.spheres.radius[index],
            mass: self.spheres.mass[index],
        };
        self.forces.iter().map(|(_, force)| force.potential_energy(&state, time)).sum()
    }

    /// An upper bound for the rate of the fastest motion on springs \[1/s\], damped or not; 0 without springs.
    pub fn fastest_spring_rate(&self) -> f64 {
        let Properties { id, mass, .. } = self.spheres;
        self.interactions.map_or(0.0, |interactions| interactions.fastest_spring_rate(id, mass))
    }

    /// The friction of all bodies that have some.
    pub fn frictions(&self) -> impl Iterator<Item = Friction> {
        let of_colliders = self.colliders.list().iter().map(|(_, collider)| collider.friction);
        let of_pairs = self.material_pairs.list().iter().map(|pair| pair.friction);
        self.spheres.friction.iter().copied().chain(of_colliders).chain(of_pairs)
    }

    /// Whether friction acts on some body.
    pub fn has_friction(&self) -> bool {
        self.frictions().any(|friction| friction.acts())
    }
}
