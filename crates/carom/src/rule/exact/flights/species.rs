//! Species: the constants that equal spheres share, stored once.

use std::collections::BTreeMap;

use glam::DVec3;

use super::contact_work::ContactWork;
use crate::forces::{self, Spring};
use crate::system::System;

/// Radii within this factor are one size class; a level holds one class or two.
const CLASS_RATIO: f64 = 2.0;
/// Smaller spheres than `CLASS_RATIO` to the minus this share the last class.
const MAX_CLASSES: usize = 48;
/// A class has its own level if the next smaller class has more than this many times as many spheres. In cells as wide
/// as the larger spheres, each smaller sphere would have too many neighbours.
const MANY_SMALLER: usize = 20;

/// Constants of the flight and of the impacts of equal spheres.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Species {
    /// \[m\]; of growing spheres, when [`Growth`](super::Growth) began.
    pub radius: f64,
    /// Speed at which the radius grows \[m/s\].
    pub growth_speed: f64,
    /// Mass \[kg\].
    pub mass: f64,
    pub restitution: f64,
    /// Number of the material where spheres are non-additive; 0 elsewhere.
    pub material: u8,
    /// Acceleration by everything but drag \[m/s²\], with the forces of persistent contacts.
    pub acceleration: DVec3,
    /// Drag coefficient divided by mass \[1/s\].
    pub drag_rate: f64,
    /// Size class: the level of the cell lists that holds these spheres.
    pub level: u32,
    /// The cluster whose persistent contacts act on the sphere. Such a sphere has a species of its own.
    pub cluster: Option<u32>,
    /// The work of these contacts.
    pub contact_work: ContactWork,
    /// The number of the species of the sphere without contact forces and outside a zone: of this one, or another.
    pub free: u32,
    /// Whether these spheres are in a stepped zone.
    pub is_stepped: bool,
    /// Whether the flight of the sphere is a `Curve`: forces without a closed form act on it, or persistent contacts
    /// that turn, and no contacts whose forces are held. Such a sphere has a species of its own.
    pub is_curved: bool,
}

impl Species {
    /// Whether nothing bends or slows the flight.
    #[inline(always)]
    pub fn flies_straight(&self) -> bool {
        self.acceleration == DVec3::ZERO && self.drag_rate == 0.0
    }

    /// Whether the relative motion of two spheres is straight and uniform for as long as they fly, and no
    /// persistent contact holds both of them.
    #[inline(always)]
    pub fn flies_like(&self, other: &Self) -> bool {
        self.acceleration == other.acceleration
            && self.drag_rate == 0.0
            && other.drag_rate == 0.0
            && (self.cluster.is_none() || other.cluster.is_none())
            && !(self.is_stepped | other.is_stepped | self.is_curved | other.is_curved)
    }
}

/// The species of all spheres of a world.
pub(super) struct SpeciesOfSpheres {
    pub species: Vec<Species>,
    /// Number of the species of each sphere, by index.
    pub number_of: Vec<u32>,
    /// Whether some forces are held constant for a time. Then each sphere has a species of its own.
    pub hold_forces: bool,
    /// Whether some forces have no closed form, so that they change with the state.
    pub forces_vary: bool,
}

impl SpeciesOfSpheres {
    /// Gathers equal spheres.
    pub fn of(system: &System) -> Self {
        let spheres = system.spheres;
        let levels = levels_of(&spheres.radius);
        let mut forces_vary = system.has_interactions();
        let has_own_forces = !spheres.applied_force.is_empty() || forces_vary;
        let is_held = system.holds_forces_of_all();
        let is_coupled = coupled(system);
        let is_additive = system.material_pairs.non_additivity.is_none();
        let mut species: Vec<Species> = Vec::new();
        let mut known = BTreeMap::new();
        let mut number_of = Vec::with_capacity(levels.len());
        for (index, &level) in levels.iter().enumerate() {
            let (radius, mass) = (spheres.radius[index], spheres.mass[index]);
            let restitution = spheres.restitution[index];
            let (force, is_all) = forces::total_linear(system.forces, radius, mass);
            forces_vary |= !is_all;
            let own = if is_all && !has_own_forces { 0 } else { index + 1 };
            let growth_speed = spheres.growth_speed(index);
            let material = if is_additive { 0 } else { spheres.material(index) };
            let key = ([radius, growth_speed, mass, restitution].map(f64::to_bits), material, own);
            let next = species.len() as u32;
            let number = *known.entry(key).or_insert(next);
            if number == next {
                let (acceleration, drag_rate) = (force.acceleration, force.drag_rate);
                species.push(Species {
                    radius,
                    growth_speed,
                    mass,
                    restitution,
                    material,
                    acceleration,
                    drag_rate,
                    level,
                    cluster: None,
                    contact_work: ContactWork::None,
                    free: number,
                    is_stepped: false,
                    is_curved: !is_held && (!is_all || is_coupled[index]),
                });
            }
            number_of.push(number);
        }
        let hold_forces = has_own_forces || forces_vary;
        Self { species, number_of, hold_forces, forces_vary }
    }
}

/// Whether a force between spheres or a spring acts on each sphere, by index.
fn coupled(system: &System) -> Vec<bool> {
    let ids = &system.spheres.id;
    let mut is_coupled = vec![system.couples_all(); ids.len()];
    for id in system.springs().flat_map(Spring::spheres) {
        if let Ok(index) = ids.binary_search(&id) {
            is_coupled[index] = true;
        }
    }
    is_coupled
}

/// Level of each radius, from 0 for the largest, with no empty level between.
fn levels_of(radii: &[f64]) -> Vec<u32> {
    let largest = radii.iter().copied().fold(0.0, f64::max);
    let class_of = |radius: f64| {
        let mut class = 0;
        let mut bound = largest / CLASS_RATIO;
        while radius <= bound && class + 1 < MAX_CLASSES {
            (class, bound) = (class + 1, bound / CLASS_RATIO);
        }
        class
    };
    let mut counts = [0; MAX_CLASSES];
    radii.iter().for_each(|&radius| counts[class_of(radius)] += 1);
    let levels = levels_of_classes(&counts);
    radii.iter().map(|&radius| levels[class_of(radius)]).collect()
}

/// Level of each size class, from the numbers of spheres in them.
fn levels_of_classes(counts: &[usize; MAX_CLASSES]) -> [u32; MAX_CLASSES] {
    let mut levels = [0; MAX_CLASSES];
    let (mut class, mut level) = (0, 0);
    while class < MAX_CLASSES {
        let smaller = counts.get(class + 1).copied().unwrap_or_default();
        let is_shared = smaller <= MANY_SMALLER * counts[class];
        let end = (class + if is_shared { 2 } else { 1 }).min(MAX_CLASSES);
        if counts[class] > 0 {
            levels[class..end].fill(level);
            (class, level) = (end, level + 1);
        } else {
            class += 1;
        }
    }
    levels
}
