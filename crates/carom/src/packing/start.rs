//! Where a compression begins: small spheres far apart, with the velocities of a gas.

use glam::DVec3;

use crate::error::{Error, InvalidValue, Subject};
use crate::settings::{Boundary, Settings};
use crate::sphere::{Sphere, volume};
use crate::validate;
use crate::world::World;

/// The largest radius at the start, in parts of the distance of neighbours on the lattice.
const LARGEST: f64 = 0.4;
/// The packing fraction at the start is at most this. It is low enough that the lattice is forgotten.
const DILUTE: f64 = 0.05;

/// Spheres to be compressed.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Start {
    /// Radii that the spheres will have at `packing_fraction` \[m\], each > 0.
    pub radii: Vec<f64>,
    /// Decides places and velocities.
    pub seed: u64,
    /// Packing fraction at which radii are `radii`, in (0, 1): it decides the edges of the box.
    pub packing_fraction: f64,
    /// Mass of a sphere with a radius of 1 m \[kg\], > 0; others have it by their volume.
    pub mass_of_unit_radius: f64,
}

impl Start {
    /// Spheres that will have these radii \[m\] at a packing fraction of 0.64, with a density of 1 kg for a radius of
    /// 1 m.
    pub fn of(radii: Vec<f64>, seed: u64) -> Self {
        Self { radii, seed, packing_fraction: 0.64, mass_of_unit_radius: 1.0 }
    }

    /// The same with the box that makes this packing fraction of the radii.
    pub fn with_packing_fraction(self, packing_fraction: f64) -> Self {
        Self { packing_fraction, ..self }
    }

    fn validate(&self) -> Result<(), InvalidValue> {
        let is_some = !self.radii.is_empty();
        validate::require(is_some, "radii", "those of at least one sphere", "none")?;
        self.radii.iter().try_for_each(|&radius| validate::positive("radius", radius))?;
        validate::positive("mass_of_unit_radius", self.mass_of_unit_radius)?;
        let fraction = self.packing_fraction;
        let is_part = fraction > 0.0 && fraction < 1.0;
        validate::require(is_part, "packing_fraction", "between 0 and 1", fraction)
    }
}

/// A world with small spheres in a periodic cube about the origin, on the places of a simple cubic lattice, in random
/// order, with random velocities: `k T` is the mass of the mean radius times (1 m/s)², and the momentum is zero.
///
/// The radii are those asked for times one factor, which growth makes 1.
///
/// # Errors
/// [`Error::Invalid`] for numbers that make no sense, or if the largest sphere does not go into the cube: its edge must
/// be four times the radius.
pub fn start(start: &Start) -> Result<World, Error> {
    start.validate().map_err(|invalid| invalid.about(Subject::Settings))?;
    let Start { radii, seed, packing_fraction, mass_of_unit_radius } = start;
    let total: f64 = radii.iter().map(|&radius| volume(radius)).sum();
    let edge = libm::cbrt(total / packing_fraction);
    let size = DVec3::splat(edge);
    let mut world = World::new(Settings::default().with_boundary(Boundary::Periodic { size }))?;
    let largest = radii.iter().copied().fold(0.0, f64::max);
    let requirement = "at least four times the largest radius: more or smaller spheres are needed";
    validate::require(edge >= 4.0 * largest, "size", requirement, edge)
        .map_err(|invalid| invalid.about(Subject::Settings))?;
    let side = places_along_an_edge(radii.len());
    let spacing = edge / side as f64;
    let by_density = libm::cbrt(DILUTE / packing_fraction);
    let factor = (LARGEST * spacing / largest).min(by_density).min(1.0);
    let mut random = Random(*seed);
    let places = random.some_of(side * side * side, radii.len());
    let mean = radii.iter().sum::<f64>() / radii.len() as f64;
    let velocities = thermal_velocities(radii, mean, &mut random);
    for ((&radius, place), velocity) in radii.iter().zip(places).zip(velocities) {
        let along = |number: usize| (number as f64 + 0.5) * spacing - 0.5 * edge;
        let [x, y, z] = [place % side, place / side % side, place / (side * side)].map(along);
        let sphere = Sphere::new(DVec3::new(x, y, z), factor * radius)
            .with_velocity(velocity)
            .with_mass(mass_of_unit_radius * radius * radius * radius);
        world.add_sphere(sphere)?;
    }
    Ok(world)
}

/// The edge of the smallest cube of places that holds this many, in places.
fn places_along_an_edge(count: usize) -> usize {
    let mut side = 1;
    while side * side * side < count {
        side += 1;
    }
    side
}

/// Normally distributed velocities without a total momentum, with the variance that each mass has at one temperature.
fn thermal_velocities(radii: &[f64], mean_radius: f64, random: &mut Random) -> Vec<DVec3> {
    let mass = |radius: f64| {
        let part = radius / mean_radius;
        part * part * part
    };
    let mut velocities: Vec<DVec3> =
        radii.iter().map(|&radius| random.normal_vector() / mass(radius).sqrt()).collect();
    let total: f64 = radii.iter().map(|&radius| mass(radius)).sum();
    let momentum: DVec3 = radii.iter().zip(&velocities).map(|(&radius, &v)| mass(radius) * v).sum();
    velocities.iter_mut().for_each(|velocity| *velocity -= momentum / total);
    velocities
}

/// Random numbers, the same on every machine: SplitMix64 (Steele, Lea and Flood, OOPSLA 2014).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^ (bits >> 31)
    }

    /// In (0, 1].
    fn number(&mut self) -> f64 {
        ((self.bits() >> 11) + 1) as f64 / (1u64 << 53) as f64
    }

    /// One of the standard normal distribution (Box and Muller, Ann. Math. Stat. 29, 610 (1958)).
    fn normal(&mut self) -> f64 {
        let radius = (-2.0 * libm::log(self.number())).sqrt();
        radius * libm::cos(std::f64::consts::TAU * self.number())
    }

    fn normal_vector(&mut self) -> DVec3 {
        DVec3::new(self.normal(), self.normal(), self.normal())
    }

    /// Some of the numbers below `count`, each at most once, in random order (Fisher and Yates).
    fn some_of(&mut self, count: usize, some: usize) -> Vec<usize> {
        let mut numbers: Vec<usize> = (0..count).collect();
        for place in 0..some {
            let left = (count - place) as u64;
            numbers.swap(place, place + (self.bits() % left) as usize);
        }
        numbers.truncate(some);
        numbers
    }
}
