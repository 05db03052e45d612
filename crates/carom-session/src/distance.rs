//! How far apart two worlds are.

use carom::{Boundary, DVec3, SphereId, World};

use crate::periodic;

/// How far apart the spheres are that both worlds have.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Distance {
    /// \[s\]
    pub time: f64,
    /// Largest distance of a sphere from itself in the other world \[m\].
    pub largest: f64,
    /// Root of the mean of the squares of these distances \[m\].
    pub root_mean_square: f64,
}

impl Distance {
    /// Between two worlds, of the spheres with the same ids; 0 without any.
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

/// Positions of the spheres that both worlds have, by the order of ids.
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
