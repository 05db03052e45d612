//! Compression by growth, and equilibration.

use super::dimensions::Dimensions;
use super::measure::{Fluid, Tally, Thermal, volume_around, volume_of_spheres};
use crate::error::{Error, InvalidValue, Subject};
use crate::sphere::SphereMotion;
use crate::validate;
use crate::world::World;

/// Mean number of collisions of a sphere in a frame: enough to measure a pressure to some per cent, and few enough
/// for velocities to change little.
const COLLISIONS_PER_FRAME: f64 = 8.0;
/// Largest relative growth of radii in a frame.
const GROWTH_PER_FRAME: f64 = 1.0 / 32.0;
/// Kinetic energy at which velocities are scaled back, as a multiple of the initial one.
const MOST_HEATED: f64 = 2.0;

/// When a compression ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Until {
    /// Stops at this packing fraction, in (0, 1), to rounding.
    PackingFraction(f64),
    /// Stops at this reduced pressure, > 1, as measured over a frame.
    Pressure(f64),
    /// Stops at this number of collisions of a sphere in the time in which the thermal speed covers
    /// its mean diameter, as measured over a frame; > 0.
    CollisionRate(f64),
}

/// Parameters of a compression.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Compression {
    /// Condition at which it ends.
    pub until: Until,
    /// Growth rate of the mean diameter, as a fraction of the initial thermal speed `√(k T / m)`; > 0. Slower
    /// compressions give denser packings, and very slow ones crystals.
    pub growth: f64,
    /// Reduced pressure, > 1, at which the spheres count as jammed and the compression ends before its condition.
    pub most_pressure: f64,
    /// Volume that contains the spheres \[m³\], in two dimensions the area \[m²\]; by default that of the periodic box.
    pub volume: Option<f64>,
}

impl Compression {
    /// Returns a compression with the default parameters: the diameter grows at a hundredth of the thermal speed,
    /// and spheres count as jammed at a reduced pressure of 10⁸.
    pub fn until(until: Until) -> Self {
        Self { until, growth: 0.01, most_pressure: 1e8, volume: None }
    }

    /// Sets the growth rate, as a fraction of the thermal speed.
    pub fn with_growth(self, growth: f64) -> Self {
        Self { growth, ..self }
    }

    /// Sets the reduced pressure at which spheres count as jammed.
    pub fn with_most_pressure(self, most_pressure: f64) -> Self {
        Self { most_pressure, ..self }
    }

    /// Sets the volume \[m³\].
    pub fn with_volume(self, volume: f64) -> Self {
        Self { volume: Some(volume), ..self }
    }

    fn validate(&self) -> Result<(), InvalidValue> {
        validate::positive("growth", self.growth)?;
        let above_one = |field, value: f64| {
            validate::require(value > 1.0, field, "greater than 1, that of an ideal gas", value)
        };
        above_one("most_pressure", self.most_pressure)?;
        match self.until {
            Until::PackingFraction(fraction) => {
                let is_part = fraction > 0.0 && fraction < 1.0;
                validate::require(is_part, "packing_fraction", "between 0 and 1", fraction)
            }
            Until::Pressure(pressure) => above_one("pressure", pressure),
            Until::CollisionRate(rate) => validate::positive("collision_rate", rate),
        }
    }
}

/// Result of a compression.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Compressed {
    /// Packing fraction at the end.
    pub packing_fraction: f64,
    /// Properties of the fluid, measured in the last frame in which spheres grew.
    pub fluid: Fluid,
    /// Whether the condition was reached; otherwise the spheres jammed first.
    pub is_reached: bool,
    /// Collisions of spheres with each other.
    pub collisions: u64,
    /// Total kinetic energy that growth added \[J\]; the thermostat removed most of it.
    pub energy_gained: f64,
}

/// Grows elastic spheres, all at one relative rate, to a packing fraction, a pressure or a collision rate.
/// Velocities are scaled back to the initial kinetic energy whenever it has doubled. Growth is zero at the end.
///
/// # Errors
/// Those of [`World::step`]; [`Error::Invalid`] for invalid numbers, for spheres that are at rest or denser
/// than they are to become, or where the volume is not known.
pub fn compress(world: &mut World, compression: &Compression) -> Result<Compressed, Error> {
    let about_settings = |invalid: InvalidValue| invalid.about(Subject::Settings);
    compression.validate().map_err(about_settings)?;
    let volume = volume_around(world, compression.volume)?;
    let (energy, thermal) = (world.kinetic_energy(), Thermal::of(world));
    let requirement = "above zero: spheres at rest have no thermal speed";
    validate::require(energy > 0.0, "kinetic energy", requirement, energy)
        .map_err(about_settings)?;
    let mut course = Course {
        compression: *compression,
        dimensions: thermal.dimensions,
        volume,
        energy,
        growth_speed: 0.5 * compression.growth * thermal.speed,
        compressed: Compressed {
            packing_fraction: volume_of_spheres(world) / volume,
            fluid: Fluid::default(),
            is_reached: false,
            collisions: 0,
            energy_gained: 0.0,
        },
    };
    if let Until::PackingFraction(fraction) = compression.until {
        let now = course.compressed.packing_fraction;
        let requirement = "at least that at the start";
        validate::require(fraction >= now, "packing_fraction", requirement, fraction)
            .map_err(about_settings)?;
    }
    world.set_growth_rate(course.growth_speed / thermal.mean_radius)?;
    let outcome = course.run(world);
    world.set_growth_rate(0.0)?;
    outcome.map(|()| course.compressed)
}

/// State of a compression.
struct Course {
    compression: Compression,
    dimensions: Dimensions,
    /// Volume that contains the spheres \[m³\].
    volume: f64,
    /// Kinetic energy to which velocities are scaled back \[J\].
    energy: f64,
    /// Speed at which the mean radius grows \[m/s\].
    growth_speed: f64,
    compressed: Compressed,
}

impl Course {
    fn run(&mut self, world: &mut World) -> Result<(), Error> {
        let mut rate = 0.0;
        loop {
            let thermal = Thermal::of(world);
            let most = GROWTH_PER_FRAME * thermal.mean_radius / self.growth_speed;
            let expected = thermal.enskog_rate(self.compressed.packing_fraction).max(rate);
            let usual = most.min(COLLISIONS_PER_FRAME / expected);
            let left = self.time_left(thermal.mean_radius);
            let is_last = left <= usual;
            let wanted = if is_last { left } else { usual };
            if wanted > 0.0 {
                let (tally, length) = self.frame(world, thermal, wanted)?;
                rate = tally.rate(thermal.count);
                self.compressed.fluid = tally.fluid(self.compressed.packing_fraction);
                if is_last && length < wanted {
                    continue;
                }
            }
            let Fluid { pressure, collision_rate, .. } = self.compressed.fluid;
            self.compressed.is_reached = match self.compression.until {
                Until::PackingFraction(_) => is_last,
                Until::Pressure(limit) => pressure >= limit,
                Until::CollisionRate(limit) => collision_rate >= limit,
            };
            self.scale_back(world)?;
            if self.compressed.is_reached || pressure >= self.compression.most_pressure {
                return Ok(());
            }
        }
    }

    /// Returns the time until spheres with this mean radius \[m\] reach their final radius \[s\]; infinite if that
    /// radius is not known.
    fn time_left(&self, mean_radius: f64) -> f64 {
        match self.compression.until {
            Until::PackingFraction(fraction) => {
                let ratio = fraction / self.compressed.packing_fraction;
                let larger = self.dimensions.edge(ratio) - 1.0;
                larger.max(0.0) * mean_radius / self.growth_speed
            }
            Until::Pressure(_) | Until::CollisionRate(_) => f64::INFINITY,
        }
    }

    /// Takes a frame of a length \[s\], or a shorter one if spheres have too little room for it.
    fn frame(
        &mut self,
        world: &mut World,
        thermal: Thermal,
        length: f64,
    ) -> Result<(Tally, f64), Error> {
        let mut length = length;
        let mut tries = 0;
        while let Err(error) = world.step(length).map(drop) {
            if !matches!(error, Error::NoRoomToGrow { .. }) || tries == MOST_HALVINGS {
                return Err(error);
            }
            (length, tries) = (0.5 * length, tries + 1);
        }
        let mut tally = Tally::default();
        tally.add_frame(world, thermal, length);
        self.compressed.packing_fraction = volume_of_spheres(world) / self.volume;
        self.compressed.collisions += tally.collisions;
        self.compressed.energy_gained += world.report().energy_account.growth;
        Ok((tally, length))
    }

    /// Scales velocities back to the initial kinetic energy, if it has doubled.
    fn scale_back(&self, world: &mut World) -> Result<(), Error> {
        let energy = world.kinetic_energy();
        if energy < MOST_HEATED * self.energy {
            return Ok(());
        }
        let factor = (self.energy / energy).sqrt();
        let spheres = world.spheres();
        let scaled = |index: usize| SphereMotion {
            id: spheres.ids()[index],
            position: spheres.positions()[index],
            velocity: factor * spheres.velocities()[index],
        };
        let motions: Vec<SphereMotion> = (0..spheres.len()).map(scaled).collect();
        world.set_motions(&motions)
    }
}

/// Largest number of halvings of a frame in which spheres have too little room.
const MOST_HALVINGS: u32 = 60;

/// Runs until each sphere has had this mean number of collisions, and measures the fluid over the second half of that
/// time.
///
/// # Errors
/// Those of [`World::step`]; [`Error::Invalid`] where the volume is not known, for spheres at rest, or for a number of
/// collisions that is not positive.
pub fn equilibrate(
    world: &mut World,
    collisions_per_sphere: f64,
    volume: Option<f64>,
) -> Result<Fluid, Error> {
    let about_settings = |invalid: InvalidValue| invalid.about(Subject::Settings);
    validate::positive("collisions", collisions_per_sphere).map_err(about_settings)?;
    let packing_fraction = volume_of_spheres(world) / volume_around(world, volume)?;
    let thermal = Thermal::of(world);
    let requirement = "above zero: spheres at rest do not collide";
    validate::require(thermal.speed > 0.0, "kinetic energy", requirement, thermal.speed)
        .map_err(about_settings)?;
    let wanted = 0.25 * collisions_per_sphere * thermal.count;
    let mut length = COLLISIONS_PER_FRAME / thermal.enskog_rate(packing_fraction);
    let mut tally = Tally::default();
    for _ in 0..2 {
        tally = Tally::default();
        let mut idle_frames = 0;
        while (tally.collisions as f64) < wanted && idle_frames < MOST_IDLE_FRAMES {
            let before = Thermal::of(world);
            world.step(length)?;
            tally.add_frame(world, before, length);
            if tally.collisions == 0 {
                (length, idle_frames) = (2.0 * length, idle_frames + 1);
            } else {
                length = COLLISIONS_PER_FRAME / tally.rate(before.count);
            }
        }
    }
    Ok(tally.fluid(packing_fraction))
}

/// Number of frames without a collision after which a measurement ends. Each is twice as long as the one before, so
/// the spheres never meet.
const MOST_IDLE_FRAMES: u32 = 12;
