//! Dense fluids, by growth.

use carom::packing::{self, Compressed, Compression, Enclosure, Start, Until};
use carom::{Boundary, DVec3, World};

use super::numbers::{Numbers, check_plane, in_space, radii};
use crate::bodies::sphere;
use crate::error::Problem;
use crate::requirement::{check, check_non_negative, check_vector};
use crate::scene::values::vector;
use crate::scene::{DenseFluid, Sphere};

/// Speed at which diameters grow, in parts of the thermal speed: up to packing fractions of about 0.62.
const GROWTH: f64 = 0.1;
/// Collisions of each sphere after its growth, which bring the fluid to equilibrium.
const COLLISIONS: f64 = 20.0;
/// Relative excess of the radii after the growth. The scene gets the requested radii, so that rounding makes no
/// spheres overlap.
const SPARE: f64 = 1e-9;
/// Reduced pressure at which spheres count as jammed.
const JAMMED: f64 = 1e5;

/// Box that a fluid fills.
struct Place {
    enclosure: Enclosure,
    /// Edges \[m\]; that along z does not count in two dimensions.
    size: DVec3,
    /// Centre of the box \[m\].
    middle: DVec3,
    /// Number of dimensions, 2 or 3.
    dimensions: u32,
}

impl Place {
    /// Volume \[m³\], or area \[m²\].
    fn volume(&self) -> f64 {
        match self.dimensions {
            2 => self.size.x * self.size.y,
            _ => self.size.element_product(),
        }
    }

    /// Part of the box that spheres with these radii \[m\] fill.
    fn filled(&self, radii: &[f64]) -> f64 {
        let volumes = radii.iter().map(|&radius| match self.dimensions {
            2 => std::f64::consts::PI * radius * radius,
            _ => carom::volume(radius),
        });
        volumes.sum::<f64>() / self.volume()
    }
}

/// Returns the spheres of a fluid that stands at `path`. The box of `world` is what it fills by default.
pub(super) fn spheres(
    fluid: &DenseFluid,
    world: &World,
    path: &str,
) -> Result<Vec<Sphere>, Problem> {
    check_non_negative(fluid.temperature, &format!("{path}.temperature"))?;
    check_vector(fluid.sphere.position, &format!("{path}.sphere.position"))?;
    let place = place(fluid, world, path)?;
    let radii = all_radii(fluid, &place, path)?;
    let spheres = templates(fluid, &radii, path)?;
    let masses = spheres.iter().map(carom::Sphere::kilograms).collect();
    let moved = grown(fluid, &place, radii, masses, path)?;
    let temperature =
        2.0 / f64::from(place.dimensions) * moved.kinetic_energy() / f64::from(fluid.count);
    let factor = if temperature > 0.0 { (fluid.temperature / temperature).sqrt() } else { 0.0 };
    let (positions, velocities) = (moved.spheres().positions(), moved.spheres().velocities());
    let offset = place.middle + vector(fluid.sphere.position);
    let own = vector(fluid.sphere.velocity);
    let made = spheres.iter().zip(positions.iter().zip(velocities));
    let made = made.map(|(sphere, (&position, &velocity))| Sphere {
        position: (offset + position).to_array(),
        velocity: (own + factor * velocity).to_array(),
        radius: Some(sphere.radius),
        diameter: None,
        ..fluid.sphere.clone()
    });
    Ok(made.collect())
}

fn place(fluid: &DenseFluid, world: &World, path: &str) -> Result<Place, Problem> {
    let settings = world.settings();
    let dimensions = settings.dimensions;
    let Some(min) = fluid.min.or(fluid.max) else {
        let Boundary::Periodic { size } = settings.boundary else {
            let text = "needs `min` and `max` where the simulation has no periodic box";
            return Err(Problem::new(path, text));
        };
        check(in_space(size, dimensions).is_finite(), "simulation.boundary.periodic.size", || {
            "must be finite along every axis, or x and y in two dimensions, for a `dense-fluid` without `min` and `max`".into()
        })?;
        let enclosure = Enclosure::Periodic { size };
        return Ok(Place { enclosure, size, middle: DVec3::ZERO, dimensions });
    };
    let (Some(_), Some(max)) = (fluid.min, fluid.max) else {
        return Err(Problem::new(path, "needs both `min` and `max`, or neither"));
    };
    check_vector(min, &format!("{path}.min"))?;
    check_vector(max, &format!("{path}.max"))?;
    let (low, high) = (vector(min), vector(max));
    check_plane([low, high], dimensions, &format!("{path}.max"))?;
    let size = high - low;
    let has_edges = size.to_array()[..dimensions as usize].iter().all(|&edge| edge > 0.0);
    check(has_edges && size.is_finite(), &format!("{path}.max"), || {
        format!("must be above `min` along every axis, not {max:?}")
    })?;
    let middle = in_space(0.5 * low + 0.5 * high, dimensions);
    Ok(Place { enclosure: Enclosure::Walls { size }, size, middle, dimensions })
}

/// Radii of all spheres \[m\] in a box.
fn all_radii(fluid: &DenseFluid, place: &Place, path: &str) -> Result<Vec<f64>, Problem> {
    let count = fluid.count as usize;
    let Some(fraction) = fluid.packing_fraction else {
        let [smallest, largest] = radii(&fluid.sphere, fluid.radius_range, path)?;
        let mut numbers = Numbers::new(fluid.seed.into());
        return Ok((0..count).map(|_| smallest + (largest - smallest) * numbers.unit()).collect());
    };
    let path = format!("{path}.packing_fraction");
    check(fraction > 0.0 && fraction < 1.0, &path, || {
        format!("must be between 0 and 1, not {fraction}")
    })?;
    let sizes = (fluid.sphere.radius, fluid.sphere.diameter, fluid.radius_range);
    check(sizes == (None, None, None), &path, || {
        "must not be given beside a radius, which determines it".into()
    })?;
    let (volume, number) = (place.volume(), count as f64);
    let radius = match place.dimensions {
        2 => (fraction * volume / (number * std::f64::consts::PI)).sqrt(),
        _ => libm::cbrt(fraction * volume / (number * carom::volume(1.0))),
    };
    Ok(vec![radius; count])
}

/// Spheres with the properties that the scene gives them and these radii \[m\].
fn templates(fluid: &DenseFluid, radii: &[f64], path: &str) -> Result<Vec<carom::Sphere>, Problem> {
    let path = format!("{path}.sphere");
    let with = |&radius: &f64| {
        let written = Sphere { radius: Some(radius), diameter: None, ..fluid.sphere.clone() };
        let made = sphere(&written, &path)?;
        let mass = made.kilograms();
        check(mass > 0.0 && mass.is_finite(), &format!("{path}.mass"), || {
            format!("must be positive and finite, not {mass}")
        })?;
        Ok(made)
    };
    radii.iter().map(with).collect()
}

/// Returns a world whose spheres have grown to these radii \[m\], and have forgotten it.
fn grown(
    fluid: &DenseFluid,
    place: &Place,
    radii: Vec<f64>,
    masses: Vec<f64>,
    path: &str,
) -> Result<World, Problem> {
    let room = place.volume();
    let fraction = place.filled(&radii);
    let name = if fluid.packing_fraction.is_some() { "packing_fraction" } else { "count" };
    let path = format!("{path}.{name}");
    let refused = |error: carom::Error| Problem::new(path.clone(), error.to_string());
    check(fraction < 1.0, &path, || {
        format!("must leave room: the spheres would fill {fraction:.4} of the box")
    })?;
    let start = Start::of(radii, fluid.seed.into())
        .with_masses(masses)
        .within(place.enclosure)
        .with_dimensions(place.dimensions);
    let mut world = packing::start(&start).map_err(refused)?;
    if fluid.count == 1 {
        // It has nothing to collide with, and no momentum.
        return Ok(world);
    }
    let compression = Compression::until(Until::PackingFraction(fraction * (1.0 + SPARE)))
        .with_growth(GROWTH)
        .with_most_pressure(JAMMED)
        .with_volume(room);
    let Compressed { is_reached, packing_fraction, .. } =
        packing::compress(&mut world, &compression).map_err(refused)?;
    check(is_reached, &path, || {
        format!(
            "asks for {fraction:.4} of the box, but the spheres jam at {packing_fraction:.4}; \
             `carom pack` grows them more slowly"
        )
    })?;
    packing::equilibrate(&mut world, COLLISIONS, Some(room)).map_err(refused)?;
    Ok(world)
}
