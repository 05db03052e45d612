//! Random fillings.

use std::collections::{BTreeMap, HashMap};

use carom::{DVec3, World};

use super::count::check_count;
use super::numbers::{Numbers, check_plane, in_space, radii};
use crate::error::Problem;
use crate::requirement::{check, check_non_negative, check_vector};
use crate::scene::values::vector;
use crate::scene::{Generator, Sphere};

/// Places tried for each sphere of a random filling. Random places fill a box to a volume
/// fraction of 0.38 at most (random sequential addition), and slow down long before.
const TRIES_PER_SPHERE: u32 = 10_000;

impl Generator {
    /// Creates the spheres of a random filling; returns none for another generator.
    pub(super) fn scatter(
        &self,
        world: &World,
        material: u8,
        path: &str,
    ) -> Result<Vec<Sphere>, Problem> {
        let Self::Random { count, min, max, seed, speed, radius_range, sphere } = self else {
            return Ok(Vec::new());
        };
        check_count(self, path)?;
        check_non_negative(*speed, &format!("{path}.speed"))?;
        check_vector(sphere.position, &format!("{path}.sphere.position"))?;
        let [smallest, largest] = radii(sphere, *radius_range, path)?;
        check_vector(*min, &format!("{path}.min"))?;
        check_vector(*max, &format!("{path}.max"))?;
        let dimensions = world.settings().dimensions;
        check_plane([*min, *max].map(vector), dimensions, &format!("{path}.max"))?;
        let corners = [*min, *max].map(|corner| in_space(vector(corner), dimensions));
        let (min, room) = (corners[0], corners[1] - corners[0]);
        let along = &room.to_array()[..dimensions as usize];
        let has_room = along.iter().all(|&it| it >= 2.0 * largest) && room.is_finite();
        check(has_room, &format!("{path}.max"), || {
            format!("must be above `min` by a diameter at least, not {max:?}")
        })?;
        let mut numbers = Numbers::new((*seed).into());
        let corner = min + vector(sphere.position);
        let mut placed = Placed::new(world, material);
        let mut spheres = Vec::new();
        for _ in 0..*count {
            let radius = smallest + (largest - smallest) * numbers.unit();
            let free = (0..TRIES_PER_SPHERE)
                .map(|_| {
                    let place = numbers.vector(dimensions) * (room - 2.0 * radius);
                    let center = corner + radius + place;
                    if dimensions == 2 { center.with_z(corner.z) } else { center }
                })
                .find(|&center| placed.is_free(center, radius));
            let Some(center) = free else {
                let text = format!(
                    "only {} of {count} spheres find a place at random; ask for fewer, or use a \
                     lattice",
                    spheres.len()
                );
                return Err(Problem::new(format!("{path}.count"), text));
            };
            placed.add(center, radius, material);
            let velocity = vector(sphere.velocity) + *speed * numbers.direction(dimensions);
            spheres.push(Sphere {
                position: center.to_array(),
                velocity: velocity.to_array(),
                radius: Some(radius),
                diameter: None,
                ..sphere.clone()
            });
        }
        Ok(spheres)
    }
}

/// Spheres that are placed already.
struct Placed<'a> {
    world: &'a World,
    /// Factor of the contact distance with spheres of each material, and the largest one.
    factors: Vec<f64>,
    largest_factor: f64,
    /// Cells by size class: those of class k are 2^k m wide and hold spheres of at most that
    /// diameter.
    classes: BTreeMap<i32, Cells>,
}

#[derive(Clone, Copy)]
struct PlacedSphere {
    center: DVec3,
    radius: f64,
    material: u8,
}

/// Spheres of one size class by the cell of their centre.
#[derive(Default)]
struct Cells {
    spheres: Vec<PlacedSphere>,
    by_cell: HashMap<[i64; 3], Vec<usize>>,
}

impl<'a> Placed<'a> {
    /// Spheres of a world, beside which others of a material are placed.
    fn new(world: &'a World, material: u8) -> Self {
        let mut factors = vec![1.0; usize::from(u8::MAX) + 1];
        for pair in world.material_pairs() {
            let [first, second] = pair.materials;
            for [one, other] in [[first, second], [second, first]] {
                if one == material {
                    factors[usize::from(other)] = 1.0 + pair.non_additivity;
                }
            }
        }
        let largest_factor = factors.iter().copied().fold(1.0, f64::max);
        let mut placed = Self { world, factors, largest_factor, classes: BTreeMap::new() };
        let spheres = world.spheres();
        let bodies = spheres.positions().iter().zip(spheres.radii()).enumerate();
        for (index, (&center, &radius)) in bodies {
            placed.add(center, radius, spheres.materials().get(index).copied().unwrap_or(0));
        }
        placed
    }

    fn add(&mut self, center: DVec3, radius: f64, material: u8) {
        let class = (2.0 * radius).log2().ceil() as i32;
        let Cells { spheres, by_cell } = self.classes.entry(class).or_default();
        by_cell.entry(cell(center, class)).or_default().push(spheres.len());
        spheres.push(PlacedSphere { center, radius, material });
    }

    fn is_free(&self, center: DVec3, radius: f64) -> bool {
        let is_apart = |other: &PlacedSphere| {
            let factor = self.factors[usize::from(other.material)];
            center.distance(other.center) > factor * (radius + other.radius)
        };
        !self.world.meets_collider(center, radius)
            && self.classes.iter().all(|(&class, cells)| {
                let reach = self.largest_factor * (radius + 0.5 * 2f64.powi(class));
                let reach = DVec3::splat(reach);
                let (low, high) = (cell(center - reach, class), cell(center + reach, class));
                let count = (0..3).map(|axis| high[axis].saturating_sub(low[axis]) as f64 + 1.0);
                // A sphere far larger than the cells overlaps more cells than there are spheres:
                // search the spheres.
                if count.product::<f64>() > cells.spheres.len() as f64 {
                    return cells.spheres.iter().all(is_apart);
                }
                cells.between(low, high).all(is_apart)
            })
    }
}

impl Cells {
    /// Iterates over the spheres in a block of cells.
    fn between(&self, low: [i64; 3], high: [i64; 3]) -> impl Iterator<Item = &PlacedSphere> {
        (low[0]..=high[0])
            .flat_map(move |x| (low[1]..=high[1]).map(move |y| (x, y)))
            .flat_map(move |(x, y)| (low[2]..=high[2]).map(move |z| [x, y, z]))
            .filter_map(|cell| self.by_cell.get(&cell))
            .flatten()
            .map(|&index| &self.spheres[index])
    }
}

/// Cell of a place in the grid of a size class.
fn cell(place: DVec3, class: i32) -> [i64; 3] {
    (place / 2f64.powi(class)).floor().to_array().map(|part| part as i64)
}
