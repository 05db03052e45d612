//! Applies values that scripts wrote into arrays of spheres to worlds.

use carom::{Error, Sphere, SphereMotion, World};

use crate::failure::Failure;
use crate::quantity::Quantity;
use crate::setting::{changed, set_all};

/// Values that a script wrote into an array.
#[derive(Debug)]
pub struct Written {
    pub quantity: Quantity,
    /// The whole array.
    pub values: Vec<f64>,
    /// Rows that differ from the world, ascending.
    pub rows: Vec<usize>,
}

impl Written {
    /// Returns the values for one world, which has `count` rows from `first` on; `None` if none
    /// were written.
    pub fn of_world(&self, first: usize, count: usize) -> Option<Self> {
        // Rows ascend.
        let place = |row: usize| self.rows.partition_point(|&other| other < row);
        let rows = &self.rows[place(first)..place(first + count)];
        let rows: Vec<usize> = rows.iter().map(|row| row - first).collect();
        let width = self.quantity.width();
        let values = || self.values[first * width..(first + count) * width].to_vec();
        (!rows.is_empty()).then(|| Self { quantity: self.quantity, values: values(), rows })
    }

    /// Refuses values that are invalid for any world, apart from bounds. `place_of` formats a row.
    ///
    /// # Errors
    /// [`Failure`] with the array and the row.
    pub fn check(&self, place_of: impl Fn(usize) -> String) -> Result<(), Failure> {
        let can_be = |row: usize| self.of(row).iter().all(|&value| self.quantity.may_be(value));
        let Some(&row) = self.rows.iter().find(|&&row| !can_be(row)) else { return Ok(()) };
        let problem = format_args!("must be finite, not {:?}", self.of(row));
        Err(Failure::value(&self.place(&place_of(row)), problem))
    }

    fn of(&self, row: usize) -> &[f64] {
        self.quantity.row(&self.values, row)
    }

    /// Returns a row of the array in Python's notation.
    pub fn place(&self, row: &str) -> String {
        format!("{}[{row}]", self.quantity.name())
    }
}

/// Applies the written values to a world; if it refuses one, the world stays unchanged. `place_of`
/// formats a row.
///
/// # Errors
/// [`Failure`] with the array and the row.
pub fn take_over(
    world: &mut World,
    written: &[Written],
    place_of: impl Fn(usize) -> String,
) -> Result<(), Failure> {
    written.iter().try_for_each(|written| written.check(&place_of))?;
    // Finite values are refused only if the quantity has bounds.
    let is_safe = !written.iter().any(|written| written.quantity.is_bounded());
    let before = (!is_safe).then(|| world.snapshot());
    let taken = set_checked(world, written, place_of);
    if taken.is_err() {
        before.iter().for_each(|before| world.restore(before));
    }
    taken
}

/// Applies checked values to a world until it refuses one. `place_of` formats a row.
///
/// # Errors
/// [`Failure`] with the array and the row; the values before it are applied.
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
