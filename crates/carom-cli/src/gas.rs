//! The gas of hard spheres in the literature: equal spheres of diameter 1 and mass 1, at
//! temperature kT = 1, in a periodic cube.

use std::f64::consts::PI;

use carom::{Boundary, DVec3, Error, Rule, Settings, Sphere, World};

use crate::numbers::Numbers;

/// Largest fraction of the volume that equal spheres can fill, `π / (3 √2)`.
const CLOSEST_PACKING: f64 = 0.740_480_489_693_061;

/// Collisions per sphere after which the gas no longer depends on its start: speeds need a few, the
/// lattice, below freezing, about ten.
pub const COLLISIONS_TO_EQUILIBRIUM: f64 = 20.0;

/// Number and density of the spheres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Filling {
    pub count: usize,
    /// Fraction of the volume that the spheres fill.
    pub packing_fraction: f64,
}

/// Distribution of the speeds at the start.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Speeds {
    /// Distributed as in equilibrium (Maxwell and Boltzmann).
    Equilibrium,
    /// Equal speeds in random directions.
    Equal,
}

impl Filling {
    /// Length of an edge of the cube.
    pub fn edge(&self) -> f64 {
        libm::cbrt(self.count as f64 * PI / 6.0 / self.packing_fraction)
    }

    /// Cells of the face-centred cubic lattice along an edge, with 4 sites each.
    fn cells(&self) -> usize {
        (1..).find(|n| 4 * n * n * n >= self.count).unwrap_or(1)
    }

    /// Largest packing fraction at which this number of spheres fits on the lattice.
    pub fn most(&self) -> f64 {
        let cells = self.cells();
        CLOSEST_PACKING * self.count as f64 / (4 * cells * cells * cells) as f64
    }

    /// Centres on a face-centred cubic lattice; empty sites are spread evenly.
    fn places(&self) -> impl Iterator<Item = DVec3> {
        let (cells, count) = (self.cells(), self.count);
        let sites = 4 * cells * cells * cells;
        let spacing = self.edge() / cells as f64;
        const BASIS: [DVec3; 4] = [
            DVec3::new(0.25, 0.25, 0.25),
            DVec3::new(0.75, 0.75, 0.25),
            DVec3::new(0.75, 0.25, 0.75),
            DVec3::new(0.25, 0.75, 0.75),
        ];
        let half = 0.5 * self.edge();
        (0..count).map(move |i| {
            let site = (i as u128 * sites as u128 / count as u128) as usize;
            let cell = site / 4;
            let cell = [cell % cells, cell / cells % cells, cell / (cells * cells)];
            let cell = DVec3::from_array(cell.map(|k| k as f64));
            (cell + BASIS[site % 4]) * spacing - half
        })
    }

    /// Collisions of one sphere per unit of time in equilibrium, by Enskog's theory with the
    /// contact value of Carnahan and Starling, `4 √π n (1 - p/2) / (1 - p)³`.
    pub fn collision_rate(&self) -> f64 {
        let p = self.packing_fraction;
        let contact_value = (1.0 - 0.5 * p) / ((1.0 - p) * (1.0 - p) * (1.0 - p));
        4.0 * PI.sqrt() * (6.0 * p / PI) * contact_value
    }

    /// Length of a frame with 0.2 collisions per sphere, which are 0.1 impacts per sphere: few
    /// enough for a short report, and enough that the cost of a frame is small.
    pub fn frame_time(&self) -> f64 {
        self.time_of(0.2)
    }

    /// Time in which a sphere has this number of collisions on average.
    pub fn time_of(&self, collisions: f64) -> f64 {
        collisions / self.collision_rate()
    }
}

/// Creates the gas on a lattice, with zero momentum and temperature 1.
pub fn gas(filling: Filling, speeds: Speeds, rule: Rule, seed: u64) -> Result<World, Error> {
    let boundary = Boundary::Periodic { size: DVec3::splat(filling.edge()) };
    let mut world = World::new(Settings::default().with_rule(rule).with_boundary(boundary))?;
    add_spheres(&mut world, filling, speeds, seed)?;
    Ok(world)
}

/// Fills a cube about the origin with the spheres of a gas.
pub fn add_spheres(
    world: &mut World,
    filling: Filling,
    speeds: Speeds,
    seed: u64,
) -> Result<(), Error> {
    let velocities = velocities(filling.count, speeds, seed);
    for (place, velocity) in filling.places().zip(velocities) {
        world.add_sphere(Sphere::new(place, 0.5).with_velocity(velocity))?;
    }
    Ok(())
}

/// Random velocities of mean 0. The mean square is 3, up to rounding and, for equal speeds, the
/// subtraction of the mean.
fn velocities(count: usize, speeds: Speeds, seed: u64) -> Vec<DVec3> {
    let mut numbers = Numbers::new(seed);
    let mut velocities: Vec<DVec3> = (0..count)
        .map(|_| match speeds {
            Speeds::Equilibrium => numbers.normal_vector(),
            Speeds::Equal => numbers.direction(),
        })
        .collect();
    let mean = velocities.iter().sum::<DVec3>() / count as f64;
    velocities.iter_mut().for_each(|velocity| *velocity -= mean);
    let square: f64 = velocities.iter().map(|velocity| velocity.length_squared()).sum();
    let factor = (3.0 * count as f64 / square).sqrt();
    velocities.iter_mut().for_each(|velocity| *velocity *= factor);
    velocities
}

/// Steps until each sphere has had at least this number of collisions on average (two for each
/// impact); returns their actual number.
pub fn run_collisions(world: &mut World, h: f64, collisions: f64) -> Result<f64, Error> {
    let wanted = 0.5 * collisions * world.spheres().len() as f64;
    let mut impacts = 0;
    while (impacts as f64) < wanted {
        impacts += world.step(h)?.impacts.len();
    }
    Ok(2.0 * impacts as f64 / world.spheres().len() as f64)
}
