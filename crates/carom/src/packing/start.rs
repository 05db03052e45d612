//! Initial state of a compression: small spheres far apart, with the velocities of a gas.

use glam::DVec3;

use super::dimensions::Dimensions;
use crate::collider::{Collider, Shape, Sides};
use crate::error::{Error, InvalidValue, Subject};
use crate::pose::Pose;
use crate::random::Random;
use crate::settings::{Boundary, Settings};
use crate::sphere::Sphere;
use crate::validate;
use crate::world::World;

/// Largest initial radius, divided by the distance of neighbours on the lattice.
const LARGEST: f64 = 0.4;
/// Largest packing fraction of the initial state, low enough for the order of the lattice to vanish.
const DILUTE: f64 = 0.05;

/// Box about the origin that contains the spheres.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub enum Enclosure {
    /// A periodic cube, in two dimensions a square, whose edge follows from the radii and the packing fraction.
    #[default]
    Cube,
    /// A periodic box.
    Periodic {
        /// Edges \[m\], each > 0; that along z does not count in two dimensions.
        size: DVec3,
    },
    /// A box with smooth, elastic walls.
    Walls {
        /// Edges \[m\], each > 0; that along z does not count in two dimensions.
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
    /// Number of dimensions, 2 or 3. In two dimensions volumes are areas.
    pub dimensions: u32,
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
            dimensions: 3,
            masses: None,
            enclosure,
        }
    }

    /// Sets the packing fraction at which the radii are reached.
    pub fn with_packing_fraction(self, packing_fraction: f64) -> Self {
        Self { packing_fraction, ..self }
    }

    /// Sets the number of dimensions, 2 or 3.
    pub fn with_dimensions(self, dimensions: u32) -> Self {
        Self { dimensions, ..self }
    }

    /// Replaces the masses \[kg\], one for each radius.
    pub fn with_masses(self, masses: Vec<f64>) -> Self {
        Self { masses: Some(masses), ..self }
    }

    /// Replaces the box. Its volume, if given, determines the packing fraction with the radii.
    pub fn within(self, enclosure: Enclosure) -> Self {
        Self { enclosure, ..self }
    }

    /// Returns the edges of the box \[m\]; that along z is infinite in two dimensions.
    fn size(&self) -> DVec3 {
        let dimensions = Dimensions(self.dimensions);
        let size = match self.enclosure {
            Enclosure::Cube => DVec3::splat(dimensions.edge(self.volume() / self.packing_fraction)),
            Enclosure::Periodic { size } | Enclosure::Walls { size } => size,
        };
        if self.dimensions == 2 { size.with_z(f64::INFINITY) } else { size }
    }

    /// Returns the volume of all spheres \[m³\], or their area \[m²\].
    fn volume(&self) -> f64 {
        let dimensions = Dimensions(self.dimensions);
        self.radii.iter().map(|&radius| dimensions.of_sphere(radius)).sum()
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
        let is_known = matches!(self.dimensions, 2 | 3);
        validate::require(is_known, "dimensions", "2 or 3", self.dimensions)?;
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
        let content = Dimensions(self.dimensions).of_box(size);
        let is_closed = size.cmpgt(DVec3::ZERO).all() && content.is_finite();
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

/// Returns a world with small spheres in a box about the origin, at random places of a simple cubic lattice (in two
/// dimensions a square one), with random velocities and zero momentum. `k T` is the mass of the mean radius (with
/// [`Start::masses`], the mean mass) times (1 m/s)².
///
/// The radii are the requested ones times a common factor, which growth brings to 1.
///
/// # Errors
/// [`Error::Invalid`] for invalid numbers, or if the largest sphere does not go into the box: the edges of a
/// periodic one must be four times its radius, those of walls twice.
pub fn start(start: &Start) -> Result<World, Error> {
    start.validate().map_err(|invalid| invalid.about(Subject::Settings))?;
    let Start { radii, seed, packing_fraction, enclosure, .. } = start;
    let size = start.size();
    let dimensions = Dimensions(start.dimensions);
    let mut world = empty(*enclosure, dimensions, size)?;
    let sides = places_along_edges(size, dimensions, radii.len(), *enclosure);
    let spacing = DVec3::from_array([0, 1, 2].map(|axis| size[axis] / sides[axis] as f64));
    let largest = radii.iter().copied().fold(0.0, f64::max);
    let final_fraction = match enclosure {
        Enclosure::Cube => *packing_fraction,
        _ => start.volume() / dimensions.of_box(size),
    };
    let by_density = dimensions.edge(DILUTE / final_fraction);
    let factor = (LARGEST * spacing.min_element() / largest).min(by_density).min(1.0);
    let mut random = Random::new(*seed);
    let places = random.some_of(sides.iter().product(), radii.len());
    let velocities = thermal_velocities(&start.relative_masses(), dimensions, &mut random);
    let spheres = radii.iter().zip(start.all_masses()).zip(places.into_iter().zip(velocities));
    for ((&radius, mass), (place, velocity)) in spheres {
        let number = [place % sides[0], place / sides[0] % sides[1], place / (sides[0] * sides[1])];
        let along = |axis: usize| (number[axis] as f64 + 0.5) * spacing[axis] - 0.5 * size[axis];
        let position = dimensions.project(DVec3::from_array([0, 1, 2].map(along)));
        let sphere = Sphere::new(position, factor * radius).with_velocity(velocity).with_mass(mass);
        world.add_sphere(sphere)?;
    }
    Ok(world)
}

/// Returns an empty world with a box of these edges \[m\].
fn empty(enclosure: Enclosure, dimensions: Dimensions, size: DVec3) -> Result<World, Error> {
    let settings = Settings::default().with_dimensions(dimensions.0);
    if !matches!(enclosure, Enclosure::Walls { .. }) {
        return World::new(settings.with_boundary(Boundary::Periodic { size }));
    }
    let mut world = World::new(settings)?;
    let walls = if dimensions.0 == 2 {
        let size = size.with_z(size.x.max(size.y));
        Shape::Container { size, open: Sides { back: true, front: true, ..Sides::NONE } }
    } else {
        Shape::Container { size, open: Sides::NONE }
    };
    world.add_collider(Collider::new(walls, Pose::at(DVec3::ZERO)))?;
    Ok(world)
}

/// Returns the numbers of lattice places along the edges of a box of a size \[m\], with at least `count` places in
/// all.
fn places_along_edges(
    size: DVec3,
    dimensions: Dimensions,
    count: usize,
    enclosure: Enclosure,
) -> [usize; 3] {
    if enclosure == Enclosure::Cube {
        let side = places_along_an_edge(count, dimensions);
        return [side, side, if dimensions.0 == 2 { 1 } else { side }];
    }
    let mut is_long = [true, true, dimensions.0 == 3];
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

/// Returns the number of places along an edge of the smallest cubic or square lattice with this many places.
fn places_along_an_edge(count: usize, dimensions: Dimensions) -> usize {
    let mut side: usize = 1;
    while side.pow(dimensions.0) < count {
        side += 1;
    }
    side
}

/// Returns normally distributed velocities \[m/s\] with zero total momentum, whose variance for each mass belongs
/// to one temperature. `masses` are relative to the mass whose variance is 1.
fn thermal_velocities(masses: &[f64], dimensions: Dimensions, random: &mut Random) -> Vec<DVec3> {
    let mut velocity = |&mass: &f64| dimensions.project(random.normal_vector() / mass.sqrt());
    let mut velocities: Vec<DVec3> = masses.iter().map(&mut velocity).collect();
    let total: f64 = masses.iter().sum();
    let momentum: DVec3 = masses.iter().zip(&velocities).map(|(&mass, &v)| mass * v).sum();
    velocities.iter_mut().for_each(|velocity| *velocity -= momentum / total);
    velocities
}
