//! Arrays of all worlds of a batch, as NumPy sees them.

use pyo3::prelude::*;

use super::members::Members;
use crate::arrays::{Quantity, Shown};

/// The arrays that were asked for. Worlds of a batch keep their spheres, so each stays the same.
#[derive(Debug, Default)]
pub struct BatchArrays {
    /// By [`Quantity`].
    shown: [Option<Shown>; Quantity::ALL.len()],
}

impl BatchArrays {
    /// The array of a quantity, with the values of now.
    pub fn get(
        &mut self,
        py: Python<'_>,
        quantity: Quantity,
        members: &Members,
    ) -> PyResult<Py<PyAny>> {
        if let Some(shown) = &self.shown[quantity as usize] {
            return Ok(shown.view(py));
        }
        let shape = members.shape_of(quantity);
        let mut values = vec![0.0; shape.iter().product()];
        write(quantity, members, &mut values);
        let shown = Shown::new(py, values, shape)?;
        let view = shown.view(py);
        self.shown[quantity as usize] = Some(shown);
        Ok(view)
    }

    /// Writes what a frame changes into the arrays that are there.
    pub fn write_motion(&mut self, py: Python<'_>, members: &Members) {
        self.write(py, members, &[Quantity::Positions, Quantity::Velocities]);
    }

    /// Writes everything into the arrays that are there.
    pub fn write_all(&mut self, py: Python<'_>, members: &Members) {
        self.write(py, members, &Quantity::ALL);
    }

    fn write(&mut self, py: Python<'_>, members: &Members, quantities: &[Quantity]) {
        for &quantity in quantities {
            let place = &mut self.shown[quantity as usize];
            let Some(shown) = place else { continue };
            if !shown.write(py, |values| write(quantity, members, values)) {
                *place = None;
            }
        }
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
