//! Contacts as a problem: bodies, what impulses at contacts do to them, and the rates that are wanted.

use glam::DVec3;

use super::order_free::{Grid, Steps};

/// One contact of a problem: what its impulse moves, and the rate that is wanted of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Link {
    /// Body 1, pushed against the normal; none for a surface.
    pub first: Option<u32>,
    /// Body 2, pushed along the normal.
    pub second: u32,
    /// Unit vector from 1 to 2.
    pub normal: DVec3,
    /// Velocity of the surface, where there is no body 1.
    pub surface_velocity: DVec3,
    /// The rate of opening that counts as zero.
    pub target: f64,
}

impl Link {
    /// Rate of opening above the target.
    pub fn rate(&self, velocities: &[DVec3]) -> f64 {
        let first = self.first.map_or(self.surface_velocity, |body| velocities[body as usize]);
        (velocities[self.second as usize] - first).dot(self.normal) - self.target
    }
}

/// Contacts and the bodies they move.
#[derive(Debug, Clone, Default)]
pub(super) struct Problem {
    pub links: Vec<Link>,
    /// One per body, relative to some common mass.
    pub inverse_masses: Vec<f64>,
    pub tolerance: Tolerance,
}

/// Rates of opening that are distinguished from zero.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Tolerance {
    /// The largest speed of the problem.
    pub scale: f64,
    /// Below this nothing is gained by going on.
    pub fine: f64,
    /// Below this it may be rounding, and is left where going on gains nothing.
    pub coarse: f64,
}

/// Velocities `M⁻¹ N x` that impulses give to bodies at rest.
///
/// The impulses are added on a grid: to no order, and as much to one body as from the other.
pub(super) fn push(
    links: &[Link],
    inverse_mass: impl Fn(usize) -> f64,
    impulse: impl Fn(usize) -> f64,
    steps: &mut [Steps<DVec3>],
    moved: &mut [DVec3],
) {
    let count = links.len();
    let largest = (0..count).map(|i| impulse(i).abs()).fold(0.0, f64::max);
    let grid = Grid::new(largest, count);
    steps.fill(Default::default());
    for (i, link) in links.iter().enumerate() {
        let given = grid.split(impulse(i) * link.normal);
        steps[link.second as usize].add(given);
        if let Some(first) = link.first {
            steps[first as usize].subtract(given);
        }
    }
    for (body, (moved, steps)) in moved.iter_mut().zip(steps).enumerate() {
        *moved = inverse_mass(body) * grid.value(*steps);
    }
}
