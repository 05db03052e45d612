//! The impulses of contacts, kept over a search for neighbours.

use super::batch::Impulses;
use super::dormant::{Dormant, Partner};
use super::slab::{Slab, Slabs};
use super::slots::{GONE, Slots};
use crate::id::SphereId;

/// Marks the number of a surface as the partner of a sphere.
const SURFACE: u32 = 1 << 31;

/// Impulses by the indices of their bodies.
#[derive(Debug, Clone, Default)]
pub(super) struct Kept {
    /// Where the contacts of each sphere begin, by the smaller index of a pair.
    starts: Vec<u32>,
    /// Partner and impulses on it.
    contacts: Vec<(u32, Impulses)>,
}

impl Kept {
    /// Keeps what the contacts that bear something have, of spheres in slots whose indices follow these ids.
    /// That of bodies that are gone is lost.
    pub fn of(slots: &Slots, slabs: &Slabs, dormant: &[Dormant], ids: &[SphereId]) -> Self {
        let mut found = Found::default();
        for slab in slabs.iter() {
            found.add_slab(slab, slots);
        }
        found.add_dormant(dormant, ids);
        Self::sorted(found.0, ids.len())
    }

    /// Sorts contacts by sphere.
    fn sorted(found: Vec<(u32, u32, Impulses)>, spheres: usize) -> Self {
        let mut kept = Self::default();
        kept.starts.resize(spheres + 2, 0);
        for &(sphere, ..) in &found {
            kept.starts[sphere as usize + 2] += 1;
        }
        for sphere in 2..kept.starts.len() {
            kept.starts[sphere] += kept.starts[sphere - 1];
        }
        kept.contacts.resize(found.len(), (0, Impulses::default()));
        for (sphere, partner, impulses) in found {
            let place = &mut kept.starts[sphere as usize + 1];
            kept.contacts[*place as usize] = (partner, impulses);
            *place += 1;
        }
        kept
    }

    /// The impulses between two spheres, given by index, on the second.
    pub fn of_pair(&self, [first, second]: [u32; 2]) -> Impulses {
        let impulses = self.find(first.min(second), first.max(second));
        if first < second { impulses } else { impulses.reversed() }
    }

    /// The impulses of a surface on a sphere, given by index.
    pub fn of_surface(&self, sphere: u32, surface: u32) -> Impulses {
        self.find(sphere, surface | SURFACE)
    }

    fn find(&self, sphere: u32, partner: u32) -> Impulses {
        let place = |sphere: usize| self.starts.get(sphere).copied().unwrap_or(0) as usize;
        let contacts = &self.contacts[place(sphere as usize)..place(sphere as usize + 1)];
        let found = contacts.iter().find(|contact| contact.0 == partner);
        found.map_or(Impulses::default(), |contact| contact.1)
    }
}

/// Contacts in no order: sphere, partner, impulses.
#[derive(Default)]
struct Found(Vec<(u32, u32, Impulses)>);

impl Found {
    fn add_slab(&mut self, slab: &Slab, slots: &Slots) {
        for (number, lane, [first, second]) in slab.batches.contacts() {
            let impulses = slab.batches.impulses(number, lane);
            if impulses.is_some() {
                let indices = [first, second].map(|slot| slots.index[slab.start + slot as usize]);
                self.add_pair(indices, impulses);
            }
        }
        for contact in &slab.surfaces {
            let index = slots.index[slab.start + contact.slot as usize];
            let impulses = contact.kept();
            if impulses.is_some() && index != GONE {
                self.0.push((index, contact.surface | SURFACE, impulses));
            }
        }
    }

    /// Adds the contacts of islands that sleep.
    fn add_dormant(&mut self, dormant: &[Dormant], ids: &[SphereId]) {
        let index_of = |id: SphereId| ids.binary_search(&id).map_or(GONE, |found| found as u32);
        for &Dormant { sphere, partner, impulses, .. } in dormant {
            let index = index_of(sphere);
            match partner {
                Partner::Sphere(other) => self.add_pair([index_of(other), index], impulses),
                Partner::Surface(surface) if index != GONE => {
                    self.0.push((index, surface | SURFACE, impulses));
                }
                Partner::Surface(_) => {}
            }
        }
    }

    /// Adds the contact of two spheres, given by index, with the impulses on the second.
    fn add_pair(&mut self, [first, second]: [u32; 2], impulses: Impulses) {
        if first != GONE && second != GONE {
            let ordered = if first < second { impulses } else { impulses.reversed() };
            self.0.push((first.min(second), first.max(second), ordered));
        }
    }
}
