//! Initial state of a compression: small spheres far apart, with the velocities of a gas.

use glam::DVec3;

use crate::collider::{Collider, Shape, Sides};
use crate::error::{Error, InvalidValue, Subject};
use crate::pose::Pose;
use crate::random::Random;
use crate::settings::{Boundary, Settings};
use crate::sphere::{Sphere, volume};
use crate::validate;
use crate::world::World;

/// Largest initial radius, divided by the distance of neighbours on the lattice.
const LARGEST: f64 = 0.4;
/// Largest packing fraction of the initial state, low enough for the order of the lattice to vanish.
const DILUTE: f64 = 0.05;

/// Box about the origin that contains the spheres.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub enum Enclosure {
    /// A periodic cube whose edge follows from the radii and the packing fraction.
    #[default]
    Cube,
    /// A periodic box.
    Periodic {
        /// Edges \[m\], each > 0.
        size: DVec3,
    },
    /// A box with smooth, elastic walls.
    Walls {
        /// Edges \[m\], each > 0.
        size: DVec3,
    },
}

/// Parameters of the initial state of a compression.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Start {
    /// Radii of the spheres at `packing_fraction` \[m\], each > 0.
    pub radii: Vec<f64>,
    /// Seed of random positions and velocities.
    pub seed: u64,
    /// Packing fraction at which the radii are `radii`, in (0, 1). It determines the edges of [`Enclosure::Cube`].
    pub packing_fraction: f64,
    /// Mass of a sphere with a radius of 1 m \[kg\], > 0; masses of others are proportional to their volumes.
    pub mass_of_unit_radius: f64,
    /// Masses of the spheres \[kg\], each > 0, instead of those proportional to volumes.
    pub masses: Option<Vec<f64>>,
    /// Box that contains the spheres.
    pub enclosure: Enclosure,
}

impl Start {
    /// Returns parameters for spheres with these radii \[m\] at a packing fraction of 0.64, where a radius of 1 m
    /// has a mass of 1 kg.
    pub fn of(radii: Vec<f64>, seed: u64) -> Self {
        let enclosure = Enclosure::default();
        Self {
            radii,
            seed,
            packing_fraction: 0.64,
            mass_of_unit_radius: 1.0,
            masses: None,
            enclosure,
        }
    }

    /// Sets the packing fraction at which the radii are reached.
    pub fn with_packing_fraction(self, packing_fraction: f64) -> Self {
        Self { packing_fraction, ..self }
    }

    /// Replaces the masses \[kg\], one for each radius.
    pub fn with_masses(self, masses: Vec<f64>) -> Self {
        Self { masses: Some(masses), ..self }
    }

    /// Replaces the box. Its volume, if given, determines the packing fraction with the radii.
    pub fn within(self, enclosure: Enclosure) -> Self {
        Self { enclosure, ..self }
    }

    /// Returns the edges of the box \[m\].
    fn size(&self) -> DVec3 {
        match self.enclosure {
            Enclosure::Cube => {
                let total: f64 = self.radii.iter().map(|&radius| volume(radius)).sum();
                DVec3::splat(libm::cbrt(total / self.packing_fraction))
            }
            Enclosure::Periodic { size } | Enclosure::Walls { size } => size,
        }
    }

    /// Returns the masses of the spheres \[kg\].
    fn all_masses(&self) -> Vec<f64> {
        let by_volume = |&radius: &f64| self.mass_of_unit_radius * radius * radius * radius;
        self.masses.clone().unwrap_or_else(|| self.radii.iter().map(by_volume).collect())
    }

    /// Returns the masses divided by the mass of the mean radius, or by their mean if they are given.
    fn relative_masses(&self) -> Vec<f64> {
        let count = self.radii.len() as f64;
        if let Some(masses) = &self.masses {
            let mean = masses.iter().sum::<f64>() / count;
            return masses.iter().map(|mass| mass / mean).collect();
        }
        let mean = self.radii.iter().sum::<f64>() / count;
        let cube = |part: f64| part * part * part;
        self.radii.iter().map(|radius| cube(radius / mean)).collect()
    }

    fn validate(&self) -> Result<(), InvalidValue> {
        let is_some = !self.radii.is_empty();
        validate::require(is_some, "radii", "those of at least one sphere", "none")?;
        self.radii.iter().try_for_each(|&radius| validate::positive("radius", radius))?;
        validate::positive("mass_of_unit_radius", self.mass_of_unit_radius)?;
        if let Some(masses) = &self.masses {
            let count = self.radii.len();
            validate::require(
                masses.len() == count,
                "masses",
                "one for each radius",
                masses.len(),
            )?;
            masses.iter().try_for_each(|&mass| validate::positive("mass", mass))?;
        }
        let fraction = self.packing_fraction;
        let is_part = fraction > 0.0 && fraction < 1.0;
        validate::require(is_part, "packing_fraction", "between 0 and 1", fraction)?;
        let size = self.size();
        let is_closed = size.cmpgt(DVec3::ZERO).all() && size.is_finite();
        validate::require(is_closed, "size", "positive and finite along every axis", size)?;
        let largest = self.radii.iter().copied().fold(0.0, f64::max);
        let (least, requirement) = match self.enclosure {
            Enclosure::Walls { .. } => (2.0, "at least twice the largest radius"),
            Enclosure::Cube | Enclosure::Periodic { .. } => {
                (4.0, "at least four times the largest radius: more or smaller spheres are needed")
            }
        };
        let edge = size.min_element();
        validate::require(edge >= least * largest, "size", requirement, edge)
    }
}

/// Returns a world with small spheres in a box about the origin, at random places of a simple cubic lattice, with
/// random velocities and zero momentum. `k T` is the mass of the mean radius (with [`Start::masses`], the mean
/// mass) times (1 m/s)².
///
/// The radii are the requested ones times a common factor, which growth brings to 1.
///
/// # Errors
/// [`Error::Invalid`] for numbers that make no sense, or if the largest sphere does not go into the box: the edges of a
/// periodic one must be four times its radius, those of walls twice.
pub fn start(start: &Start) -> Result<World, Error> {
    start.validate().map_err(|invalid| invalid.about(Subject::Settings))?;
    let Start { radii, seed, packing_fraction, enclosure, .. } = start;
    let size = start.size();
    let mut world = empty(*enclosure, size)?;
    let sides = places_along_edges(size, radii.len(), *enclosure);
    let spacing = DVec3::from_array([0, 1, 2].map(|axis| size[axis] / sides[axis] as f64));
    let largest = radii.iter().copied().fold(0.0, f64::max);
    let total: f64 = radii.iter().map(|&radius| volume(radius)).sum();
    let final_fraction = match enclosure {
        Enclosure::Cube => *packing_fraction,
        _ => total / size.element_product(),
    };
    let by_density = libm::cbrt(DILUTE / final_fraction);
    let factor = (LARGEST * spacing.min_element() / largest).min(by_density).min(1.0);
    let mut random = Random::new(*seed);
    let places = random.some_of(sides.iter().product(), radii.len());
    let velocities = thermal_velocities(&start.relative_masses(), &mut random);
    let spheres = radii.iter().zip(start.all_masses()).zip(places.into_iter().zip(velocities));
    for ((&radius, mass), (place, velocity)) in spheres {
        let number = [place % sides[0], place / sides[0] % sides[1], place / (sides[0] * sides[1])];
        let along = |axis: usize| (number[axis] as f64 + 0.5) * spacing[axis] - 0.5 * size[axis];
        let sphere = Sphere::new(DVec3::from_array([0, 1, 2].map(along)), factor * radius)
            .with_velocity(velocity)
            .with_mass(mass);
        world.add_sphere(sphere)?;
    }
    Ok(world)
}

/// Returns an empty world with a box of these edges \[m\].
fn empty(enclosure: Enclosure, size: DVec3) -> Result<World, Error> {
    if !matches!(enclosure, Enclosure::Walls { .. }) {
        return World::new(Settings::default().with_boundary(Boundary::Periodic { size }));
    }
    let mut world = World::new(Settings::default())?;
    let walls = Shape::Container { size, open: Sides::NONE };
    world.add_collider(Collider::new(walls, Pose::at(DVec3::ZERO)))?;
    Ok(world)
}

/// Returns the numbers of lattice places along the edges of a box of a size \[m\], with at least `count` places in
/// all.
fn places_along_edges(size: DVec3, count: usize, enclosure: Enclosure) -> [usize; 3] {
    if enclosure == Enclosure::Cube {
        return [places_along_an_edge(count); 3];
    }
    let mut is_long = [true; 3];
    loop {
        let long = || (0..3).filter(|&axis| is_long[axis]);
        let share = long().map(|axis| size[axis]).product::<f64>() / count as f64;
        let spacing = match long().count() {
            3 => libm::cbrt(share),
            2 => share.sqrt(),
            _ => share,
        };
        // An edge shorter than the spacing has one place; the other edges have all.
        let Some(short) = long().find(|&axis| size[axis] < spacing) else {
            // Each number is rounded up, so their product is at least `count`.
            let places = |axis: usize| (size[axis] / spacing).ceil().max(1.0) as usize;
            return [0, 1, 2].map(|axis| if is_long[axis] { places(axis) } else { 1 });
        };
        is_long[short] = false;
    }
}

/// Returns the number of places along an edge of the smallest cubic lattice with this many places.
fn places_along_an_edge(count: usize) -> usize {
    let mut side = 1;
    while side * side * side < count {
        side += 1;
    }
    side
}

/// Returns normally distributed velocities \[m/s\] with zero total momentum, whose variance for each mass belongs
/// to one temperature. `masses` are relative to the mass whose variance is 1.
fn thermal_velocities(masses: &[f64], random: &mut Random) -> Vec<DVec3> {
    let mut velocities: Vec<DVec3> =
        masses.iter().map(|&mass| random.normal_vector() / mass.sqrt()).collect();
    let total: f64 = masses.iter().sum();
    let momentum: DVec3 = masses.iter().zip(&velocities).map(|(&mass, &v)| mass * v).sum();
    velocities.iter_mut().for_each(|velocity| *velocity -= momentum / total);
    velocities
}
