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
    pub(super) fn scatter(&self, world: &World, path: &str) -> Result<Vec<Sphere>, Problem> {
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
        let mut placed = Placed::new(world);
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
            placed.add(center, radius);
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
    /// Cells by size class: those of class k are 2^k m wide and hold spheres of at most that
    /// diameter.
    classes: BTreeMap<i32, Cells>,
}

/// Spheres of one size class by the cell of their centre.
#[derive(Default)]
struct Cells {
    spheres: Vec<(DVec3, f64)>,
    by_cell: HashMap<[i64; 3], Vec<usize>>,
}

impl<'a> Placed<'a> {
    fn new(world: &'a World) -> Self {
        let mut placed = Self { world, classes: BTreeMap::new() };
        let spheres = world.spheres();
        for (&center, &radius) in spheres.positions().iter().zip(spheres.radii()) {
            placed.add(center, radius);
        }
        placed
    }

    fn add(&mut self, center: DVec3, radius: f64) {
        let class = (2.0 * radius).log2().ceil() as i32;
        let Cells { spheres, by_cell } = self.classes.entry(class).or_default();
        by_cell.entry(cell(center, class)).or_default().push(spheres.len());
        spheres.push((center, radius));
    }

    fn is_free(&self, center: DVec3, radius: f64) -> bool {
        let is_apart = |&(other, r): &(DVec3, f64)| center.distance(other) > radius + r;
        !self.world.meets_collider(center, radius)
            && self.classes.iter().all(|(&class, cells)| {
                let reach = DVec3::splat(radius + 0.5 * 2f64.powi(class));
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
    fn between(&self, low: [i64; 3], high: [i64; 3]) -> impl Iterator<Item = &(DVec3, f64)> {
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
