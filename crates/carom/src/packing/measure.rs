//! Measurements of a fluid of hard spheres: packing fraction, pressure and collision rate.

use super::dimensions::Dimensions;
use crate::error::{Error, Subject};
use crate::report::BodyPair;
use crate::settings::Boundary;
use crate::sum::Sum;
use crate::validate;
use crate::world::World;

/// Measured properties of a fluid or a packing.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[non_exhaustive]
pub struct Fluid {
    /// Volume of the spheres divided by the volume that contains them.
    pub packing_fraction: f64,
    /// Reduced pressure `P V / N k T` from the virial of collisions; 1 for an ideal gas.
    pub pressure: f64,
    /// Number of collisions of a sphere with others in the time in which the thermal speed `√(k T / m)` covers its
    /// mean diameter.
    pub collision_rate: f64,
}

/// Returns the volume of the spheres divided by the volume of the box, or in two dimensions their area divided by its
/// area.
///
/// # Errors
/// [`Error::Invalid`] for a world whose box is not periodic along all axes: there `volume` has to be given \[m³\].
pub fn packing_fraction(world: &World, volume: Option<f64>) -> Result<f64, Error> {
    Ok(volume_of_spheres(world) / volume_around(world, volume)?)
}

pub(super) fn volume_of_spheres(world: &World) -> f64 {
    let dimensions = Dimensions(world.settings().dimensions);
    let volumes = world.spheres().radii().iter().map(|&radius| dimensions.of_sphere(radius));
    volumes.collect::<Sum>().value()
}

/// Returns the volume that contains the spheres \[m³\], or the area \[m²\].
pub(super) fn volume_around(world: &World, given: Option<f64>) -> Result<f64, Error> {
    let of_box = match world.settings().boundary {
        Boundary::Periodic { size } => Dimensions(world.settings().dimensions).of_box(size),
        Boundary::Open => f64::INFINITY,
    };
    let volume = given.unwrap_or(of_box);
    let requirement =
        "positive and finite; outside of a periodic box that is closed it has to be given";
    validate::require(volume > 0.0 && volume.is_finite(), "volume", requirement, volume)
        .map_err(|invalid| invalid.about(Subject::Settings))?;
    Ok(volume)
}

/// Averages over the spheres that depend on their temperature.
#[derive(Debug, Clone, Copy)]
pub(super) struct Thermal {
    pub count: f64,
    pub dimensions: Dimensions,
    /// Two thirds of the kinetic energy of a sphere \[J\]; all of it in two dimensions.
    pub temperature: f64,
    /// Thermal speed \[m/s\].
    pub speed: f64,
    /// Mean radius \[m\].
    pub mean_radius: f64,
}

impl Thermal {
    pub fn of(world: &World) -> Self {
        let spheres = world.spheres();
        let count = spheres.len() as f64;
        let dimensions = Dimensions(world.settings().dimensions);
        let temperature = 2.0 / dimensions.number() * world.kinetic_energy() / count;
        let mean_mass = spheres.masses().iter().copied().collect::<Sum>().value() / count;
        let mean_radius = spheres.radii().iter().copied().collect::<Sum>().value() / count;
        let speed = (temperature / mean_mass).sqrt();
        Self { count, dimensions, temperature, speed, mean_radius }
    }

    /// Returns the number of collisions of a sphere in a second at a packing fraction p, for spheres of one size,
    /// by Enskog's theory with the contact value of Carnahan and Starling, of discs with that of Henderson:
    ///
    /// ```text
    /// rate = 24/√π p χ v/d        χ = (1 - p/2)/(1 - p)³
    /// rate = 8/√π p χ v/d         χ = (1 - 7p/16)/(1 - p)²
    /// ```
    pub fn enskog_rate(&self, packing_fraction: f64) -> f64 {
        let free = 1.0 - packing_fraction.min(0.9);
        let (neighbours, contact_value) = match self.dimensions.0 {
            2 => (8.0, (1.0 - 0.4375 * packing_fraction) / (free * free)),
            _ => (24.0, (1.0 - 0.5 * packing_fraction) / (free * free * free)),
        };
        let per_crossing =
            neighbours / std::f64::consts::PI.sqrt() * packing_fraction * contact_value;
        per_crossing * self.speed / (2.0 * self.mean_radius)
    }
}

/// Sums over the frames of a measurement.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Tally {
    /// Integral of Σ j R / (D N k T) over time \[s\], with D dimensions.
    virial: f64,
    /// Collisions of spheres with each other.
    pub collisions: u64,
    /// Integral of the collision rate over time: collisions of a sphere in the time in which it covers its diameter
    /// \[s\].
    rates: f64,
    /// Length of the measurement \[s\].
    time: f64,
}

impl Tally {
    /// Adds the impacts of the last frame, which has a length \[s\] and began with `before`.
    pub fn add_frame(&mut self, world: &World, before: Thermal, length: f64) {
        let (spheres, impacts) = (world.spheres(), &world.report().impacts);
        let radius_at = |id, time: f64| {
            let index = spheres.index_of(id).unwrap_or_default();
            let speed = spheres.growth_speeds().get(index).copied().unwrap_or(0.0);
            spheres.radii()[index] - speed * (length - time)
        };
        let (mut virial, mut count) = (Sum::default(), 0u64);
        for impact in impacts {
            if let BodyPair::Spheres(first, second) = impact.between {
                let distance = radius_at(first, impact.time) + radius_at(second, impact.time);
                let factor = world.distance_factor([first, second]);
                virial.add(impact.impulse * (factor * distance));
                count += 1;
            }
        }
        let after = Thermal::of(world);
        let temperature = 0.5 * (before.temperature + after.temperature);
        let crossing =
            (before.mean_radius + after.mean_radius) / (0.5 * (before.speed + after.speed));
        self.virial += virial.value() / (after.dimensions.number() * after.count * temperature);
        self.rates += 2.0 * count as f64 / after.count * crossing;
        self.collisions += count;
        self.time += length;
    }

    /// Returns the properties of the fluid over the measurement, at a packing fraction.
    pub fn fluid(&self, packing_fraction: f64) -> Fluid {
        let time = self.time.max(f64::MIN_POSITIVE);
        Fluid {
            packing_fraction,
            pressure: 1.0 + self.virial / time,
            collision_rate: self.rates / time,
        }
    }

    /// Returns the number of collisions of a sphere in a second.
    pub fn rate(&self, count: f64) -> f64 {
        2.0 * self.collisions as f64 / count / self.time.max(f64::MIN_POSITIVE)
    }
}
