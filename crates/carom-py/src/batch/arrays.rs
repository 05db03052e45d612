//! Arrays of all worlds of a batch, as NumPy sees them.

use pyo3::prelude::*;

use super::members::Members;
use crate::arrays::Quantities;
use crate::quantity::Quantity;
use crate::written::Written;

/// The arrays that a script has read. Worlds of a batch keep their spheres, so each stays the same.
#[derive(Debug, Default)]
pub struct BatchArrays(Quantities);

impl BatchArrays {
    /// The array of a quantity, with the values of now.
    pub fn get(
        &mut self,
        py: Python<'_>,
        quantity: Quantity,
        members: &Members,
    ) -> PyResult<Py<PyAny>> {
        let shape = members.shape_of(quantity);
        self.0.get(py, quantity, shape, |values| write(quantity, members, values))
    }

    /// Writes what a frame changes into the arrays that are there.
    pub fn write_motion(&mut self, py: Python<'_>, members: &Members) {
        self.write(py, members, &Quantity::MOTION);
    }

    /// Writes everything into the arrays that are there.
    pub fn write_all(&mut self, py: Python<'_>, members: &Members) {
        self.write(py, members, &Quantity::ALL);
    }

    /// What a script has written into them; rows are those of all worlds, one world after another.
    pub fn written(&self, py: Python<'_>, members: &Members) -> Vec<Written> {
        self.0.written(py, |quantity, values| write(quantity, members, values))
    }

    fn write(&mut self, py: Python<'_>, members: &Members, quantities: &[Quantity]) {
        self.0.write(py, quantities, |quantity, values| write(quantity, members, values));
    }
}

/// Writes a quantity of all worlds, one after another.
fn write(quantity: Quantity, members: &Members, mut values: &mut [f64]) {
    for world in members.worlds() {
        let length = quantity.shape(world.spheres().len()).iter().product();
        let Some((own, rest)) = values.split_at_mut_checked(length) else { return };
        quantity.write(world.spheres(), own);
        values = rest;
    }
}
