//! Materials: spheres with equal restitution and friction, of one material by name. The coefficients of each pair of materials are combined
//! once and looked up at each search.

use std::collections::BTreeMap;

use educe::Educe;

use crate::bodies::Properties;
use crate::detect::contact::Bodies;
use crate::friction::{ContactFriction, Friction};
use crate::respond::{friction_of, restitution_of};
use crate::restitution::{BodyRestitution, ContactRestitution, RestitutionLaw};
use crate::system::System;

/// With more materials than this, pairs are combined one by one.
const MOST: usize = 64;

/// The coefficients of two bodies in contact.
#[derive(Debug, Clone, Copy, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct ContactMaterial {
    pub restitution: ContactRestitution,
    pub friction: ContactFriction,
}

impl ContactMaterial {
    /// Returns the coefficients of a contact of two bodies.
    pub fn of(bodies: Bodies, system: &System) -> Self {
        Self { restitution: restitution_of(bodies, system), friction: friction_of(bodies, system) }
    }
}

/// The material of each sphere, and the coefficients of each pair of materials.
#[derive(Debug, Educe, Default)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Materials {
    /// Material of each sphere, by index; empty where there are too many.
    material_of: Vec<u8>,
    /// Coefficients of pairs, by the material of the first, then of the second.
    table: Vec<ContactMaterial>,
    count: usize,
}

impl Materials {
    /// The materials of the present spheres.
    pub fn of(system: &System) -> Self {
        let spheres = system.spheres;
        let mut known: BTreeMap<[u64; 9], u8> = BTreeMap::new();
        // A sphere of each material.
        let mut examples = Vec::new();
        let mut material_of = Vec::with_capacity(spheres.id.len());
        for sphere in 0..spheres.id.len() {
            let key = key(spheres, sphere);
            let material = *known.entry(key).or_insert_with(|| {
                examples.push(sphere as u32);
                (examples.len() - 1) as u8
            });
            if examples.len() > MOST {
                return Self::default();
            }
            material_of.push(material);
        }
        let pairs =
            examples.iter().flat_map(|&i| examples.iter().map(move |&j| Bodies::Pair(i, j)));
        let table = pairs.map(|pair| ContactMaterial::of(pair, system)).collect();
        Self { material_of, table, count: examples.len() }
    }

    /// The coefficients of two spheres, given by index.
    pub fn of_pair(&self, [first, second]: [u32; 2], system: &System) -> ContactMaterial {
        if self.material_of.is_empty() {
            return ContactMaterial::of(Bodies::Pair(first, second), system);
        }
        if self.count == 1 {
            return self.table[0];
        }
        let material = |sphere: u32| usize::from(self.material_of[sphere as usize]);
        self.table[material(first) * self.count + material(second)]
    }
}

/// The bits of a sphere's coefficients, equal for spheres of one material.
fn key(spheres: &Properties, sphere: usize) -> [u64; 9] {
    let bits = |said: Option<f64>| said.map_or(u64::MAX, f64::to_bits);
    let Friction { sliding, rolling, spinning, tangential_restitution } = spheres.friction(sphere);
    let [law, first, second, third] = match spheres.restitution(sphere) {
        BodyRestitution::Constant(coefficient) => [0, coefficient.to_bits(), 0, 0],
        BodyRestitution::BySpeed(law) => law_key(law),
    };
    let material = u64::from(spheres.material(sphere));
    let [sliding, rolling] = [sliding, rolling].map(bits);
    let [spinning, tangential] = [spinning, tangential_restitution].map(bits);
    [law, first, second, third, sliding, rolling, spinning, tangential, material]
}

/// The bits of a law: its number, from 1 on, and its constants.
fn law_key(law: RestitutionLaw) -> [u64; 4] {
    let (number, constants) = match law {
        RestitutionLaw::PowerLaw { restitution, speed, exponent } => {
            (1, [restitution, speed, exponent])
        }
        RestitutionLaw::Viscoelastic { speed } => (2, [speed, 0.0, 0.0]),
        RestitutionLaw::Cutoff { restitution, speed } => (3, [restitution, speed, 0.0]),
    };
    let [first, second, third] = constants.map(f64::to_bits);
    [number, first, second, third]
}
