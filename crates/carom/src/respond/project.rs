//! Projection of a motion to one in which contacts do not close.

use glam::DVec3;

use super::complementarity::{Outcome, Solver};
use super::group::{Group, speed_scale, tolerance};
use super::problem::Problem;

/// Marks a body that is in no component.
const NONE: u32 = u32::MAX;

/// Largest ratio of masses in the computation; beyond it a sphere counts as heavier than it
/// is. Far beyond what speeds in double precision can tell, and its square does not overflow.
const MASS_RATIO: f64 = 1e150;

/// Projects motions, component by component: contacts that share no sphere, directly or through
/// others, do not feel each other. Working memory, kept to spare its allocation.
#[derive(Debug, Clone, Default)]
pub(super) struct Projector {
    /// Per body: another one of its component, or itself.
    parents: Vec<u32>,
    /// Representative body and contact, sorted: the contacts of a component are neighbours.
    members: Vec<(u32, u32)>,
    /// Per body: its index in the problem.
    local: Vec<u32>,
    /// Per body of the problem: its index in the group.
    bodies: Vec<u32>,
    problem: Problem,
    solver: Solver,
    velocities: Vec<DVec3>,
    component_impulses: Vec<f64>,
    impulses: Vec<f64>,
    /// The coarsest tolerance of rates that was used.
    resolution: f64,
    /// The projections so far, where they are recorded.
    record: Option<Record>,
}

/// Projections in the order in which they were made.
#[derive(Debug, Clone, Default)]
struct Record {
    layers: usize,
    projections: Vec<Projection>,
}

/// A projection of the motion of a group.
#[derive(Debug, Clone)]
pub(crate) struct Projection {
    /// Number of the layer of restitution, from 0.
    pub layer: usize,
    /// One per contact \[N s\], up to a common factor.
    pub impulses: Vec<f64>,
}

impl Projector {
    /// Impulses of the last projection, one per contact of the group.
    pub fn impulses(&self) -> &[f64] {
        &self.impulses
    }

    /// Returns a projector that records what it does.
    pub fn recording() -> Self {
        Self { record: Some(Record::default()), ..Self::default() }
    }

    /// Begins the next layer of restitution in the record.
    pub fn begin_layer(&mut self) {
        if let Some(record) = &mut self.record {
            record.layers += 1;
        }
    }

    /// Returns the projections that were recorded.
    pub fn into_projections(self) -> Vec<Projection> {
        self.record.map_or(Vec::new(), |record| record.projections)
    }

    /// The coarsest tolerance of rates that any projection used.
    pub fn resolution(&self) -> f64 {
        self.resolution
    }

    /// Moves the velocities, by impulses at `active` contacts, to the nearest ones (in kinetic
    /// energy) whose rates of opening are at least the targets.
    ///
    /// Projects each component on its own; returns the worst outcome of one.
    pub fn project(
        &mut self,
        group: &Group,
        active: impl Fn(usize) -> bool,
        target: impl Fn(usize) -> f64,
        velocities: &mut [DVec3],
    ) -> Outcome {
        self.impulses.clear();
        self.impulses.resize(group.links.len(), 0.0);
        self.find_components(group, active);
        let members = std::mem::take(&mut self.members);
        let mut worst = Outcome::Solved;
        for component in members.chunk_by(|a, b| a.0 == b.0) {
            let falls_short = |&(_, contact): &(u32, u32)| {
                group.rate(contact as usize, velocities) < target(contact as usize)
            };
            if component.iter().any(falls_short) {
                let outcome = self.project_component(group, component, &target, velocities);
                if worst == Outcome::Solved || outcome == Outcome::Jammed {
                    worst = outcome;
                }
            }
        }
        self.members = members;
        if let Some(record) = &mut self.record {
            let (layer, impulses) = (record.layers.saturating_sub(1), self.impulses.clone());
            record.projections.push(Projection { layer, impulses });
        }
        worst
    }

    fn find_components(&mut self, group: &Group, active: impl Fn(usize) -> bool) {
        self.parents.clear();
        self.parents.extend(0..group.masses.len() as u32);
        self.local.resize(group.masses.len(), NONE);
        self.members.clear();
        for (contact, link) in group.links.iter().enumerate().filter(|(i, _)| active(*i)) {
            if let Some(first) = link.first {
                let (a, b) = (self.representative(first), self.representative(link.second));
                self.parents[a as usize] = b;
            }
            self.members.push((link.second, contact as u32));
        }
        for i in 0..self.members.len() {
            self.members[i].0 = self.representative(self.members[i].0);
        }
        self.members.sort_unstable();
    }

    fn representative(&mut self, mut body: u32) -> u32 {
        while self.parents[body as usize] != body {
            let parent = self.parents[body as usize];
            self.parents[body as usize] = self.parents[parent as usize];
            body = parent;
        }
        body
    }

    fn project_component(
        &mut self,
        group: &Group,
        component: &[(u32, u32)],
        target: impl Fn(usize) -> f64,
        velocities: &mut [DVec3],
    ) -> Outcome {
        self.gather(group, component, target, velocities);
        // Relative to the largest mass, equal masses are exactly 1.
        let masses = self.bodies.iter().map(|body| group.masses[*body as usize]);
        let largest_mass = masses.clone().fold(0.0, f64::max);
        self.problem.inverse_masses.clear();
        self.problem
            .inverse_masses
            .extend(masses.map(|mass| (largest_mass / mass).min(MASS_RATIO)));

        self.problem.tolerance = tolerance(speed_scale(self.velocities.iter().copied()));
        let impulses = &mut self.component_impulses;
        let outcome = self.solver.solve(&self.problem, group.work, &mut self.velocities, impulses);
        let missed = if outcome == Outcome::Solved { self.solver.missed() } else { 0.0 };
        self.resolution = self.resolution.max(self.problem.tolerance.coarse).max(missed);
        for (local, &body) in self.bodies.iter().enumerate() {
            self.local[body as usize] = NONE;
            velocities[body as usize] = self.velocities[local];
        }
        for (&(_, contact), impulse) in component.iter().zip(&self.component_impulses) {
            self.impulses[contact as usize] = largest_mass * impulse;
        }
        outcome
    }

    /// Contacts and bodies of a component, as a problem of their own.
    fn gather(
        &mut self,
        group: &Group,
        component: &[(u32, u32)],
        target: impl Fn(usize) -> f64,
        velocities: &[DVec3],
    ) {
        self.bodies.clear();
        self.velocities.clear();
        self.problem.links.clear();
        for &(_, contact) in component {
            let mut link = group.links[contact as usize];
            link.second = self.local_index(link.second, velocities);
            link.first = link.first.map(|body| self.local_index(body, velocities));
            link.target = target(contact as usize);
            self.problem.links.push(link);
        }
    }

    fn local_index(&mut self, body: u32, velocities: &[DVec3]) -> u32 {
        let local = &mut self.local[body as usize];
        if *local == NONE {
            *local = self.bodies.len() as u32;
            self.bodies.push(body);
            self.velocities.push(velocities[body as usize]);
        }
        *local
    }
}
