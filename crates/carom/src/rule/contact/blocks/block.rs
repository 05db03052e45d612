//! A block: the contacts of a heavy sphere and of the lighter ones about it.

use glam::DVec3;

use super::equations::{self, BlockContact, BlockSphere};
use crate::rule::contact::contacts::batch::{get, set};
use crate::rule::contact::slabs::incidence::Origin;
use crate::rule::contact::solver::Solver;

/// Contacts of spheres whose masses differ by this factor are solved in blocks. For spheres of one density that is a
/// ratio of 2.5 of their sizes; at 3, codes that integrate stiff contacts begin to fail (Vyas, Ottino, Lueptow and
/// Umbanhowar, Comput. Phys. Commun. 310, 109524 (2025)).
const UNEVEN: f64 = 16.0;
/// Largest number of contacts of a block; larger ones are left to the sweeps.
const MOST_CONTACTS: usize = 32;

/// The spheres and contacts of a block.
#[derive(Debug, Default)]
pub struct Block {
    spheres: Vec<BlockSphere>,
    /// The slot of each sphere.
    slots: Vec<usize>,
    contacts: Vec<BlockContact>,
    /// The place of each contact in the solver.
    origins: Vec<Origin>,
}

/// Whether the masses of two awake spheres differ by the factor [`UNEVEN`].
pub fn has_uneven_masses(solver: &Solver) -> bool {
    let awake = solver.slots.velocity.iter().map(|row| row.number()).filter(|&it| it > 0.0);
    let (least, most) = awake.fold((f64::INFINITY, 0.0_f64), |(least, most), inverse_mass| {
        (least.min(inverse_mass), most.max(inverse_mass))
    });
    most >= UNEVEN * least
}

/// The slots of spheres that press on a much lighter one, in order.
pub fn heavy_spheres(solver: &Solver) -> Vec<usize> {
    let mut found = Vec::new();
    for slab in solver.slabs.iter() {
        for (batch, lane, _) in slab.batches.contacts() {
            if slab.batches.pairs[batch].impulse[lane] <= 0.0 {
                continue;
            }
            let [first, second] = slab.slots_of(batch, lane);
            let [of_first, of_second] =
                [first, second].map(|slot| solver.slots.velocity[slot].number());
            if of_first > 0.0 && of_second >= UNEVEN * of_first {
                found.push(first);
            } else if of_second > 0.0 && of_first >= UNEVEN * of_second {
                found.push(second);
            }
        }
    }
    found.sort_unstable();
    found.dedup();
    found
}

impl Block {
    /// Gathers the block about a heavy sphere; `None` if it has too many contacts, or one of them bounces. Restitution at
    /// several contacts with friction may add energy (Kane 1984), and sweeps answer it one contact after the other.
    pub fn about(solver: &Solver, heavy: usize) -> Option<Self> {
        let mut block = Self::default();
        block.add_sphere(solver, heavy);
        let light = UNEVEN * solver.slots.velocity[heavy].number();
        let mut next = 0;
        while next < block.slots.len() {
            let slot = block.slots[next];
            // Contacts of the others are not in the block, but for those with its light spheres.
            if next == 0 || solver.slots.velocity[slot].number() >= light {
                for &origin in solver.incidence.of(slot) {
                    block.add_contact(solver, origin);
                }
            }
            if block.contacts.len() > MOST_CONTACTS {
                return None;
            }
            next += 1;
        }
        let bounces = block.contacts.iter().any(BlockContact::bounces);
        (!bounces).then_some(block)
    }

    /// Solves for the impulses of all contacts, with errors of velocities below a tolerance \[m/s\]. Returns whether
    /// they changed.
    pub fn solve(&mut self, tolerance: f64) -> bool {
        equations::solve(&mut self.contacts, &mut self.spheres, tolerance)
    }

    /// Writes impulses and velocities to the solver.
    pub fn write(&self, solver: &mut Solver) {
        for (sphere, &slot) in self.spheres.iter().zip(&self.slots) {
            let row = &mut solver.slots.velocity[slot];
            *row = row.with_vector(sphere.velocity);
            if let Some(spin) = solver.slots.spin.get_mut(slot) {
                *spin = spin.with_vector(sphere.spin);
            }
        }
        for (contact, &origin) in self.contacts.iter().zip(&self.origins) {
            let tangential = contact.tangential().to_array();
            match origin {
                Origin::Surface { slab, contact: number } => {
                    let slab = Origin::slab_mut(&mut solver.slabs, slab);
                    let impulses = &mut slab.surfaces[number as usize].impulses;
                    (impulses.normal, impulses.tangential) = (contact.normal_impulse(), tangential);
                }
                Origin::Pair { slab, batch, lane } => {
                    let batches = &mut Origin::slab_mut(&mut solver.slabs, slab).batches;
                    let (batch, lane) = (batch as usize, lane as usize);
                    batches.pairs[batch].impulse[lane] = contact.normal_impulse();
                    if let Some(friction) = batches.frictions.get_mut(batch) {
                        set(&mut friction.tangential, lane, tangential);
                    }
                }
            }
        }
    }

    /// The place of the sphere in a slot.
    fn add_sphere(&mut self, solver: &Solver, slot: usize) -> usize {
        self.slots.iter().position(|&it| it == slot).unwrap_or_else(|| {
            let (velocity, spin) = (solver.slots.velocity[slot], solver.slots.spin.get(slot));
            self.slots.push(slot);
            self.spheres.push(BlockSphere {
                inverse_mass: velocity.number(),
                inverse_inertia: spin.map_or(0.0, |spin| spin.number()),
                velocity: velocity.vector(),
                spin: spin.map_or(DVec3::ZERO, |spin| spin.vector()),
            });
            self.slots.len() - 1
        })
    }

    /// Adds a contact and its spheres, unless it is there.
    fn add_contact(&mut self, solver: &Solver, origin: Origin) {
        if self.origins.contains(&origin) {
            return;
        }
        let contact = match origin {
            Origin::Surface { slab, contact } => {
                let slab = Origin::slab(&solver.slabs, slab);
                let contact = &slab.surfaces[contact as usize];
                let second = self.add_sphere(solver, slab.start + contact.slot as usize);
                BlockContact::new([None, Some(second)], contact.normal)
                    .with_bound(contact.bias, contact.velocity, contact.slip())
                    .with_friction(contact.friction.sliding)
                    .with_impulses(contact.impulses.normal, contact.impulses.tangential)
            }
            Origin::Pair { slab, batch, lane } => {
                let slab = Origin::slab(&solver.slabs, slab);
                let (number, lane) = (batch as usize, lane as usize);
                let places =
                    slab.slots_of(number, lane).map(|slot| Some(self.add_sphere(solver, slot)));
                let pairs = &slab.batches.pairs[number];
                let friction = slab.batches.frictions.get(number);
                let of = |vectors: &[_; 3]| get(vectors, lane);
                let slip = friction.map_or(DVec3::ZERO, |it| of(&it.slip).into());
                // As though sphere 1 were as much slower as the image of sphere 2 is faster.
                let slide = DVec3::new(-slab.batches.slide(number, lane), 0.0, 0.0);
                BlockContact::new(places, of(&pairs.normal).into())
                    .with_bound(pairs.bias[lane], slide, slip)
                    .with_friction(friction.map_or(0.0, |it| it.sliding[lane]))
                    .with_impulses(
                        pairs.impulse[lane],
                        friction.map_or([0.0; 3], |it| of(&it.tangential)),
                    )
            }
        };
        self.contacts.push(contact);
        self.origins.push(origin);
    }
}
