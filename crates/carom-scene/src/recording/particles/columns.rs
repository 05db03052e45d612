//! Columns of particle files, and what they hold.

use super::error::{Problem, shown};

/// Quantities of a particle, one component each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Quantity {
    Position,
    Velocity,
    /// A quaternion x, y, z, w.
    Orientation,
    AngularVelocity,
    Radius,
    Diameter,
    Mass,
    Id,
}

/// In the order of `Quantity`.
const WIDTHS: [usize; 8] = [3, 3, 4, 3, 1, 1, 1, 1];

impl Quantity {
    /// Number of its components.
    pub fn width(self) -> usize {
        WIDTHS[self as usize]
    }
}

/// Where the components of each quantity stand in a row.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Columns {
    places: [[Option<usize>; 4]; WIDTHS.len()],
    /// Number of columns of a row, at least.
    pub width: usize,
    /// Whether positions are parts of the edges of the box.
    pub is_scaled: bool,
}

impl Columns {
    /// Notes that a component of a quantity stands in a column.
    pub fn put(&mut self, quantity: Quantity, component: usize, column: usize) {
        self.places[quantity as usize][component] = Some(column);
    }

    /// Returns whether all components of a quantity have columns.
    pub fn has(&self, quantity: Quantity) -> bool {
        self.places[quantity as usize][..quantity.width()].iter().all(Option::is_some)
    }

    /// Reads the components of a quantity; `None` if the row does not have all of them.
    ///
    /// # Errors
    /// What is wrong with a number.
    pub fn read<const N: usize>(
        &self,
        quantity: Quantity,
        row: &[&str],
    ) -> Result<Option<[f64; N]>, Problem> {
        if !self.has(quantity) {
            return Ok(None);
        }
        let mut numbers = [0.0; N];
        let places = self.places[quantity as usize].iter().flatten();
        for (number, &column) in numbers.iter_mut().zip(places) {
            let text = row.get(column).copied().unwrap_or_default();
            let value: Option<f64> = text.parse().ok().filter(|it: &f64| it.is_finite());
            *number = value.ok_or_else(|| {
                Problem::from(format!("column {} is no finite number: {}", column + 1, shown(text)))
            })?;
        }
        Ok(Some(numbers))
    }
}
