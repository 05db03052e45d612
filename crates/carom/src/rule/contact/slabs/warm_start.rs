//! Impulses from which contacts start after a search for neighbours.

use educe::Educe;

use super::{Slab, Slabs};
use crate::rule::contact::contacts::batch::Impulses;
use crate::rule::contact::contacts::dormant::{Dormant, Partner};
use crate::rule::contact::slots::GONE;

/// Marks the number of a surface as the partner of a sphere.
const SURFACE: u32 = 1 << 31;

/// Impulses of contacts, by the slots that their spheres had before the search.
#[derive(Debug, Educe, Default)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct WarmStart {
    /// Sphere and partner of each contact, in no order.
    bodies: Vec<[u32; 2]>,
    /// Impulses on the partner, or of a surface on the sphere.
    impulses: Vec<Impulses>,
    /// Where the contacts of each sphere begin in `sorted`, by the smaller slot of a pair.
    starts: Vec<u32>,
    /// Partners and numbers of contacts.
    sorted: Vec<[u32; 2]>,
    /// Spheres on their way through surfaces that are open from behind, and these surfaces, ascending.
    passages: Vec<[u32; 2]>,
}

impl WarmStart {
    /// Collects the impulses of contacts that press, and the passages. `now` maps the slot of a sphere when the slabs
    /// were made to its present slot, [`GONE`] if the sphere left the world: its contacts are lost.
    pub fn collect(&mut self, slabs: &Slabs, spheres: usize, now: impl Fn(usize) -> u32) {
        self.bodies.clear();
        self.impulses.clear();
        self.passages.clear();
        for slab in slabs.iter() {
            self.add_slab(slab, &now);
        }
        self.sort(spheres);
    }

    /// Adds the impulses of the contacts of sleeping spheres; `now` maps the slot of a sphere when it fell
    /// asleep to its present slot.
    pub fn collect_dormant<'a>(
        &mut self,
        dormant: impl Iterator<Item = &'a Dormant>,
        spheres: usize,
        now: impl Fn(usize) -> u32,
    ) {
        for &Dormant { sphere, partner, impulses, .. } in dormant {
            let slot = now(sphere as usize);
            match partner {
                Partner::Sphere(other) => self.add_pair([now(other as usize), slot], impulses),
                Partner::Surface(surface) if slot != GONE => {
                    self.add(slot, surface | SURFACE, impulses);
                }
                // The slabs have the contact of an awake sphere.
                Partner::Awake(_) | Partner::Surface(_) => {}
            }
        }
        self.sort(spheres);
    }

    /// Sorts contacts by sphere.
    fn sort(&mut self, spheres: usize) {
        let Self { bodies, starts, sorted, passages, .. } = self;
        passages.sort_unstable();
        starts.clear();
        starts.resize(spheres + 2, 0);
        for &[sphere, _] in &*bodies {
            starts[sphere as usize + 2] += 1;
        }
        for sphere in 2..starts.len() {
            starts[sphere] += starts[sphere - 1];
        }
        sorted.clear();
        sorted.resize(bodies.len(), [0; 2]);
        for (number, &[sphere, partner]) in bodies.iter().enumerate() {
            let place = &mut starts[sphere as usize + 1];
            sorted[*place as usize] = [partner, number as u32];
            *place += 1;
        }
    }

    /// The impulses between the spheres that were in two slots, on the second.
    pub fn of_pair(&self, [first, second]: [u32; 2]) -> Impulses {
        let impulses = self.find(first.min(second), first.max(second));
        if first < second { impulses } else { impulses.reversed() }
    }

    /// The impulses of a surface on the sphere that was in a slot.
    pub fn of_surface(&self, sphere: u32, surface: u32) -> Impulses {
        self.find(sphere, surface | SURFACE)
    }

    /// Whether the sphere that was in a slot passes a surface from behind.
    pub fn passes(&self, sphere: u32, surface: u32) -> bool {
        self.passages.binary_search(&[sphere, surface]).is_ok()
    }

    fn find(&self, sphere: u32, partner: u32) -> Impulses {
        let place = |sphere: usize| self.starts.get(sphere).copied().unwrap_or(0) as usize;
        let contacts = &self.sorted[place(sphere as usize)..place(sphere as usize + 1)];
        let found = contacts.iter().find(|contact| contact[0] == partner);
        found.map_or(Impulses::default(), |contact| self.impulses[contact[1] as usize])
    }

    fn add(&mut self, sphere: u32, partner: u32, impulses: Impulses) {
        self.bodies.push([sphere, partner]);
        self.impulses.push(impulses);
    }

    fn add_slab(&mut self, slab: &Slab, now: &impl Fn(usize) -> u32) {
        for (number, lane, [first, second]) in slab.batches.contacts() {
            if slab.batches.pairs[number].impulse[lane] > 0.0 {
                let impulses = slab.batches.impulses(number, lane);
                let slots = [first, second].map(|slot| now(slab.start + slot as usize));
                self.add_pair(slots, impulses);
            }
        }
        for contact in &slab.surfaces {
            let slot = now(slab.start + contact.slot as usize);
            let impulses = contact.kept();
            if contact.passes && slot != GONE {
                self.passages.push([slot, contact.surface]);
            }
            if impulses.is_some() && slot != GONE {
                self.add(slot, contact.surface | SURFACE, impulses);
            }
        }
    }

    /// Adds the contact of the spheres in two slots, with the impulses on the second.
    fn add_pair(&mut self, [first, second]: [u32; 2], impulses: Impulses) {
        if impulses.is_some() && first != GONE && second != GONE {
            let ordered = if first < second { impulses } else { impulses.reversed() };
            self.add(first.min(second), first.max(second), ordered);
        }
    }
}
