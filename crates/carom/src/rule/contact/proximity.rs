//! What zones of the rule `exact` read of a sub-step: proximities, since zones release spheres that are near no other
//! one, and forces.

use glam::DVec3;

use super::contacts::dormant::Partner;
use super::slots::Slots;
use super::solver::Solver;
use super::sub_step::SLOP;
use crate::id::SphereId;

/// A sphere is near another one whose gap is below this part of the sum of radii.
const NEAR: f64 = 0.05;
/// A sphere is also near another one that it meets within this number of sub-steps.
const SUB_STEPS: f64 = 16.0;

/// Returns the index of each sphere, and whether something other than forces and single bounces
/// changed its velocity in the last sub-step.
pub(crate) fn bearing(solver: &Solver) -> impl Iterator<Item = (u32, bool)> {
    solver.slots.index.iter().copied().zip(solver.slots.bears.iter().copied())
}

/// The forces with a potential, held ones included, that acted on each sphere in the last sub-step \[N\], by index.
pub(crate) fn conservative_forces(solver: &Solver) -> Vec<DVec3> {
    let Slots { index, velocity, acceleration, working, .. } = &solver.slots;
    let mut forces = vec![DVec3::ZERO; index.len()];
    for (slot, &index) in index.iter().enumerate() {
        let nonconservative = working.get(slot).map_or(DVec3::ZERO, |row| row.vector());
        let inverse_mass = velocity[slot].number();
        if inverse_mass > 0.0 {
            forces[index as usize] = (acceleration[slot].vector() - nonconservative) / inverse_mass;
        }
    }
    forces
}

/// Proximity of a sphere to the nearest other one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Proximity {
    /// The sphere meets no other one soon.
    Apart,
    /// The sphere touches another one, or may soon.
    Near,
    /// The sphere overlaps another one by more than the slop.
    Overlaps,
}

/// Returns the proximity of each sphere to others, in order of ids.
pub(crate) fn proximity(solver: &Solver) -> Vec<(SphereId, Proximity)> {
    let Solver { slots, slabs, dormant, h, .. } = solver;
    let mut proximity = vec![Proximity::Apart; slots.len()];
    let mut note = |slot: usize, found: Proximity| {
        if let Some(known) = proximity.get_mut(slot) {
            *known = found.max(*known);
        }
    };
    for slab in slabs.iter() {
        for (number, lane, _) in slab.batches.contacts() {
            let both = slab.slots_of(number, lane);
            let offset = slots.offset(both);
            let [before, after] = both.map(|slot| slots.velocity[slot].vector());
            let radius_sum = slab.batches.approaches[number].radius_sum[lane];
            let (distance, velocity) = (offset.length(), after - before);
            let closing = -velocity.dot(offset) / distance;
            let gap = distance - radius_sum;
            if gap < -2.0 * SLOP * radius_sum {
                both.into_iter().for_each(|slot| note(slot, Proximity::Overlaps));
            } else if gap < NEAR * radius_sum || gap < SUB_STEPS * h * closing {
                both.into_iter().for_each(|slot| note(slot, Proximity::Near));
            }
        }
    }
    for contact in dormant {
        match contact.partner {
            Partner::Sphere(other) | Partner::Awake(other) => {
                for slot in [contact.sphere, other] {
                    note(slot as usize, Proximity::Near);
                }
            }
            Partner::Surface(_) => {}
        }
    }
    let mut all: Vec<_> = slots.id.iter().copied().zip(proximity).collect();
    all.sort_unstable_by_key(|sphere| sphere.0);
    all
}
