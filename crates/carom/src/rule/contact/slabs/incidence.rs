//! The contacts of each sphere.

use educe::Educe;

use crate::rule::contact::contacts::batch::{Impulses, set};
use crate::rule::contact::slabs::{Slab, Slabs};

/// The place of a contact in memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Origin {
    /// A pair in a lane of a batch of a slab.
    Pair { slab: u32, batch: u32, lane: u32 },
    /// Among the surface contacts of a slab.
    Surface { slab: u32, contact: u32 },
}

impl Origin {
    /// The slab of a number, the far one last.
    pub fn slab(slabs: &Slabs, number: u32) -> &Slab {
        slabs.list.get(number as usize).unwrap_or(&slabs.far)
    }

    /// The slab of a number, the far one last.
    pub fn slab_mut(slabs: &mut Slabs, number: u32) -> &mut Slab {
        slabs.list.get_mut(number as usize).unwrap_or(&mut slabs.far)
    }

    /// Makes the contact a plain one with these impulses and minus the least normal velocity that it allows
    /// \[m/s\].
    pub fn set(self, slabs: &mut Slabs, kept: Impulses, bias: f64) {
        match self {
            Self::Surface { slab, contact } => {
                let contact = &mut Self::slab_mut(slabs, slab).surfaces[contact as usize];
                (contact.impulses, contact.bias, contact.approach) = (kept, bias, 0.0);
            }
            Self::Pair { slab, batch, lane } => {
                let batches = &mut Self::slab_mut(slabs, slab).batches;
                let (batch, lane) = (batch as usize, lane as usize);
                batches.pairs[batch].impulse[lane] = kept.normal;
                batches.pairs[batch].bias[lane] = bias;
                batches.approaches[batch].previous[lane] = kept.previous;
                if let Some(friction) = batches.frictions.get_mut(batch) {
                    set(&mut friction.tangential, lane, kept.tangential);
                }
                if let Some(rolling) = batches.rollings.get_mut(batch) {
                    set(&mut rolling.angular, lane, kept.angular);
                }
            }
        }
    }
}

/// The contacts of each sphere, by slot, as the last search for neighbours left them.
#[derive(Debug, Educe, Default)]
#[educe(Clone)]
pub struct Incidence {
    /// Start of each slot's contacts in `origins`; empty until they are needed.
    starts: Vec<u32>,
    origins: Vec<Origin>,
}

impl Incidence {
    /// Clears the lists, since contacts are made again.
    pub fn clear(&mut self) {
        self.starts.clear();
    }

    /// Finds the contacts of all spheres, unless they are known.
    pub fn renew(&mut self, slabs: &Slabs, spheres: usize) {
        if !self.starts.is_empty() {
            return;
        }
        self.starts.resize(spheres + 2, 0);
        each(slabs, |slot, _| self.starts[slot + 2] += 1);
        for slot in 2..self.starts.len() {
            self.starts[slot] += self.starts[slot - 1];
        }
        let count = self.starts.last().map_or(0, |&count| count as usize);
        self.origins.clear();
        self.origins.resize(count, Origin::Surface { slab: 0, contact: 0 });
        each(slabs, |slot, origin| {
            let place = &mut self.starts[slot + 1];
            self.origins[*place as usize] = origin;
            *place += 1;
        });
    }

    /// The contacts of the sphere in a slot.
    pub fn of(&self, slot: usize) -> &[Origin] {
        &self.origins[self.starts[slot] as usize..self.starts[slot + 1] as usize]
    }
}

/// Visits the contacts of all spheres.
fn each(slabs: &Slabs, mut visit: impl FnMut(usize, Origin)) {
    for (number, slab) in (0u32..).zip(slabs.iter()) {
        for (batch, lane, slots) in slab.batches.contacts() {
            let origin = Origin::Pair { slab: number, batch: batch as u32, lane: lane as u32 };
            slots.iter().for_each(|&slot| visit(slab.start + slot as usize, origin));
        }
        for (contact, it) in (0u32..).zip(&slab.surfaces).filter(|it| !it.1.passes) {
            let origin = Origin::Surface { slab: number, contact };
            visit(slab.start + it.slot as usize, origin);
        }
    }
}
