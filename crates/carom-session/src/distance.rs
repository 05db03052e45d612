//! Distance between two worlds.

use carom::{Boundary, DVec3, SphereId, World};

use crate::periodic;

/// Distance between two worlds, over the spheres that both have.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Distance {
    /// Time \[s\].
    pub time: f64,
    /// Largest distance of a sphere from the same sphere in the other world \[m\].
    pub largest: f64,
    /// Root mean square of these distances \[m\].
    pub root_mean_square: f64,
}

impl Distance {
    /// Measures the distance between spheres with the same ids; 0 if there are none.
    pub fn between(first: &World, second: &World) -> Self {
        let size = match first.settings().boundary {
            Boundary::Open => DVec3::INFINITY,
            Boundary::Periodic { size } => size,
        };
        let (mut count, mut sum, mut largest) = (0_usize, 0.0_f64, 0.0_f64);
        for (one, other) in common(first, second) {
            let way = one - other;
            let squared = (way - periodic::whole_edges(way, size)).length_squared();
            count += 1;
            sum += squared;
            largest = largest.max(squared);
        }
        let mean = if count > 0 { sum / count as f64 } else { 0.0 };
        Self { time: first.time(), largest: largest.sqrt(), root_mean_square: mean.sqrt() }
    }
}

/// Positions of the spheres that both worlds have, in the order of ids.
fn common<'a>(
    first: &'a World,
    second: &'a World,
) -> impl Iterator<Item = (DVec3, DVec3)> + use<'a> {
    let all = |world: &'a World| {
        world.spheres().ids().iter().copied().zip(world.spheres().positions().iter().copied())
    };
    let mut others = all(second).peekable();
    all(first).filter_map(move |(id, position): (SphereId, DVec3)| {
        while others.next_if(|(other, _)| *other < id).is_some() {}
        others.next_if(|(other, _)| *other == id).map(|(_, other)| (position, other))
    })
}
