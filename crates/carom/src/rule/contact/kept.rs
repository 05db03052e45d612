//! The impulses of contacts, kept over a search for neighbours.

use super::batch::Impulses;
use super::slab::Slabs;
use super::slots::{GONE, Slots};

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
    /// Keeps what the contacts that bear something have; that of bodies that are gone is lost.
    pub fn collect(&mut self, slots: &Slots, slabs: &Slabs, spheres: usize) {
        let mut found: Vec<(u32, u32, Impulses)> = Vec::new();
        for slab in slabs.iter() {
            for (number, lane, [first, second]) in slab.batches.contacts() {
                let impulses = slab.batches.impulses(number, lane);
                let indices = [first, second].map(|slot| slots.index[slab.start + slot as usize]);
                if impulses.is_some() && !indices.contains(&GONE) {
                    let [first, second] = indices;
                    let ordered = if first < second { impulses } else { impulses.reversed() };
                    found.push((first.min(second), first.max(second), ordered));
                }
            }
            for contact in &slab.surfaces {
                let index = slots.index[slab.start + contact.slot as usize];
                let impulses = contact.kept();
                if impulses.is_some() && index != GONE {
                    found.push((index, contact.surface | SURFACE, impulses));
                }
            }
        }
        self.starts.clear();
        self.starts.resize(spheres + 2, 0);
        for &(sphere, ..) in &found {
            self.starts[sphere as usize + 2] += 1;
        }
        for sphere in 2..self.starts.len() {
            self.starts[sphere] += self.starts[sphere - 1];
        }
        self.contacts.clear();
        self.contacts.resize(found.len(), (0, Impulses::default()));
        for (sphere, partner, impulses) in found {
            let place = &mut self.starts[sphere as usize + 1];
            self.contacts[*place as usize] = (partner, impulses);
            *place += 1;
        }
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
