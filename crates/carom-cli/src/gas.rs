//! The gas of hard spheres that figures of the literature are about: equal spheres of diameter 1
//! and mass 1, at temperature kT = 1, in a periodic cube.

use std::f64::consts::PI;

use carom::{Boundary, DVec3, Error, Rule, Settings, Sphere, World};

use crate::numbers::Numbers;

/// Part of the volume above which equal spheres have no room on any lattice, `π / (3 √2)`.
const CLOSEST_PACKING: f64 = 0.740_480_489_693_061;

/// Collisions that a sphere has seen when the gas has forgotten its start: speeds take a few, the
/// lattice, below freezing, about ten.
pub const COLLISIONS_TO_EQUILIBRIUM: f64 = 20.0;

/// How many spheres there are in how much space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Filling {
    pub count: usize,
    /// Part of the volume that the spheres fill.
    pub packing_fraction: f64,
}

/// How fast the spheres are at the start.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Speeds {
    /// Distributed as in equilibrium (Maxwell and Boltzmann).
    Equilibrium,
    /// All alike, in random directions.
    Equal,
}

impl Filling {
    /// Edge of the cube.
    pub fn edge(&self) -> f64 {
        libm::cbrt(self.count as f64 * PI / 6.0 / self.packing_fraction)
    }

    /// Cells of the face-centred cubic lattice along an edge, with 4 sites each.
    fn cells(&self) -> usize {
        (1..).find(|n| 4 * n * n * n >= self.count).unwrap_or(1)
    }

    /// Largest packing fraction at which this many spheres have place on the lattice.
    pub fn most(&self) -> f64 {
        let cells = self.cells();
        CLOSEST_PACKING * self.count as f64 / (4 * cells * cells * cells) as f64
    }

    /// Centres on a face-centred cubic lattice; sites that stay empty are spread over all of it.
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

    /// A frame in which a sphere takes part in 0.2 impacts on average, so that there are 0.1 per
    /// sphere: few enough for a short report, enough that frames cost little.
    pub fn frame_time(&self) -> f64 {
        self.time_of(0.2)
    }

    /// A time in which a sphere takes part in so many impacts on average.
    pub fn time_of(&self, collisions: f64) -> f64 {
        collisions / self.collision_rate()
    }
}

/// The gas at its start: no momentum, temperature 1, on a lattice.
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

/// Velocities of mean 0, and of mean square 3 but for what rounding and, for equal speeds, taking
/// out the mean does.
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

/// Steps until there were at least this many collisions per sphere, two for each impact; gives how
/// many there were.
pub fn run_collisions(world: &mut World, h: f64, collisions: f64) -> Result<f64, Error> {
    let wanted = 0.5 * collisions * world.spheres().len() as f64;
    let mut impacts = 0;
    while (impacts as f64) < wanted {
        impacts += world.step(h)?.impacts.len();
    }
    Ok(2.0 * impacts as f64 / world.spheres().len() as f64)
}
