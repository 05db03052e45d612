//! Pairs of spheres inside the potential of each other.

use super::contact::{Bodies, Contact};
use super::contacts::{self, Search};
use super::image_overlaps;
use super::instant::Instant;
use crate::settings::PairPotential;
use crate::system::System;

/// Pairs of spheres, by index, whose centres are nearer than the range of a potential, each once in order.
pub(crate) fn bound_pairs(now: &Instant, potential: PairPotential) -> Vec<[u32; 2]> {
    // They overlap once each radius is multiplied by the ratio of the range.
    let mut spheres = now.system.spheres.clone();
    spheres.radius.iter_mut().for_each(|radius| *radius *= potential.range_ratio());
    let now = Instant { system: System { spheres: &spheres, ..now.system }, ..*now };
    let mut pairs = Vec::new();
    let mut keep = |bodies: Bodies| {
        if let Bodies::Pair(first, second) = bodies {
            pairs.push([first.min(second), first.max(second)]);
        }
    };
    if now.system.settings.boundary.is_periodic() {
        image_overlaps::visit(&now, 0.0, |_, _| false, |bodies, _| keep(bodies));
    } else {
        let mut found: Vec<Contact> = Vec::new();
        contacts::find_overlapping_pairs(&now, 0.0, &mut Search::default(), &mut found);
        found.iter().for_each(|contact| keep(contact.bodies));
    }
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}
