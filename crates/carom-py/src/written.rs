//! What scripts write into arrays of spheres, as worlds take it over.

use carom::{Error, Sphere, SphereMotion, World};

use crate::failure::Failure;
use crate::quantity::Quantity;
use crate::setting::{changed, set_all};

/// What a script has written into an array.
#[derive(Debug)]
pub struct Written {
    pub quantity: Quantity,
    /// The whole array.
    pub values: Vec<f64>,
    /// The spheres of which it is not what the world has, ascending.
    pub rows: Vec<usize>,
}

impl Written {
    /// What was written of the spheres from this row on: so many are in one world.
    pub fn of_world(&self, first: usize, count: usize) -> Option<Self> {
        // Rows ascend.
        let place = |row: usize| self.rows.partition_point(|&other| other < row);
        let rows = &self.rows[place(first)..place(first + count)];
        let rows: Vec<usize> = rows.iter().map(|row| row - first).collect();
        let width = self.quantity.width();
        let values = || self.values[first * width..(first + count) * width].to_vec();
        (!rows.is_empty()).then(|| Self { quantity: self.quantity, values: values(), rows })
    }

    /// Refuses what no world takes, whatever the quantity's bounds. `place_of` writes a row.
    ///
    /// # Errors
    /// [`Failure`] that names the array and the row.
    pub fn check(&self, place_of: impl Fn(usize) -> String) -> Result<(), Failure> {
        let can_be = |row: usize| self.of(row).iter().all(|&value| self.quantity.may_be(value));
        let Some(&row) = self.rows.iter().find(|&&row| !can_be(row)) else { return Ok(()) };
        let problem = format_args!("must be finite, not {:?}", self.of(row));
        Err(Failure::value(&self.place(&place_of(row)), problem))
    }

    fn of(&self, row: usize) -> &[f64] {
        self.quantity.row(&self.values, row)
    }

    /// The array, and a row of it, as Python writes them.
    pub fn place(&self, row: &str) -> String {
        format!("{}[{row}]", self.quantity.name())
    }
}

/// Has a world take over what was written of its spheres; if it refuses a value, it is as it was. `place_of`
/// writes a row.
///
/// # Errors
/// [`Failure`] that names the array and the row.
pub fn take_over(
    world: &mut World,
    written: &[Written],
    place_of: impl Fn(usize) -> String,
) -> Result<(), Failure> {
    written.iter().try_for_each(|written| written.check(&place_of))?;
    // What is finite is refused only where there are bounds.
    let is_safe = !written.iter().any(|written| written.quantity.is_bounded());
    let before = (!is_safe).then(|| world.snapshot());
    let taken = set_checked(world, written, place_of);
    if taken.is_err() {
        before.iter().for_each(|before| world.restore(before));
    }
    taken
}

/// Has a world take over what was written and checked, until it refuses a value. `place_of` writes a row.
///
/// # Errors
/// [`Failure`] that names the array and the row; the values before it are taken over.
pub fn set_checked(
    world: &mut World,
    written: &[Written],
    place_of: impl Fn(usize) -> String,
) -> Result<(), Failure> {
    written.iter().try_for_each(|written| set(world, written, &place_of))
}

fn set(
    world: &mut World,
    written: &Written,
    place_of: impl Fn(usize) -> String,
) -> Result<(), Failure> {
    let Written { quantity, values, rows } = written;
    let sphere = |world: &World, row: usize| {
        (world.spheres().ids()[row], changed(world.spheres().get(row), *quantity, written.of(row)))
    };
    match quantity {
        Quantity::AppliedForces => set_all(world, *quantity, values),
        Quantity::Positions | Quantity::Velocities => {
            let spheres = rows.iter().map(|&row| sphere(world, row));
            let motion =
                |(id, Sphere { position, velocity, .. })| SphereMotion { id, position, velocity };
            let motions: Vec<_> = spheres.map(motion).collect();
            world.set_motions(&motions).map_err(|error| Failure::from(error).about(quantity.name()))
        }
        _ => rows.iter().try_for_each(|&row| {
            let (id, sphere) = sphere(world, row);
            let about = |error: Error| Failure::from(error).about(&written.place(&place_of(row)));
            world.set_sphere(id, sphere).map_err(about)
        }),
    }
}
