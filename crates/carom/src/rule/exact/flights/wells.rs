//! Wells of the potential between spheres: which pairs are inside.

use educe::Educe;

use crate::detect::bound_pairs;
use crate::detect::instant::Instant;
use crate::settings::PairPotential;

/// The wells around all spheres, and the pairs that are bound: inside the well of each other. That belongs to the pair
/// and changes in events alone, so that rounding of a distance at the edge never changes an energy.
#[derive(Debug, Educe, PartialEq)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Wells {
    /// Depth \[J\].
    pub depth: f64,
    /// Range as a multiple of the sum of radii.
    pub range_ratio: f64,
    /// Partners of each sphere by index, ascending.
    partners: Vec<Vec<u32>>,
}

impl Wells {
    /// The wells of a world, and the pairs whose distances are inside; `None` without such a potential.
    pub fn of(now: &Instant) -> Option<Self> {
        let potential = now.system.settings.pair_potential?;
        let PairPotential::SquareWell { depth, range_ratio } = potential;
        let partners = vec![Vec::new(); now.motion.position.len()];
        let mut wells = Self { depth, range_ratio, partners };
        for pair in bound_pairs(now, potential) {
            wells.set_bound(pair, true);
        }
        Some(wells)
    }

    /// Whether two spheres, by index, are bound.
    #[inline]
    pub fn is_bound(&self, [one, other]: [u32; 2]) -> bool {
        self.partners[one as usize].contains(&other)
    }

    /// Notes that two spheres, by index, entered the well of each other, or left it.
    pub fn set_bound(&mut self, [one, other]: [u32; 2], is_bound: bool) {
        for [sphere, partner] in [[one, other], [other, one]] {
            let partners = &mut self.partners[sphere as usize];
            match (partners.binary_search(&partner), is_bound) {
                (Err(place), true) => partners.insert(place, partner),
                (Ok(place), false) => drop(partners.remove(place)),
                _ => {}
            }
        }
    }

    /// Potential energy of all bound pairs \[J\].
    pub fn energy(&self) -> f64 {
        let partners: usize = self.partners.iter().map(Vec::len).sum();
        -self.depth * (partners / 2) as f64
    }
}
