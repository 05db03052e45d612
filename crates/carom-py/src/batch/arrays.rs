//! Arrays of all worlds of a batch for NumPy.

use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;

use super::members::Members;
use crate::arrays::Quantities;
use crate::quantity::Quantity;
use crate::written::Written;

/// The arrays that a script has read, with a row for each world. A row has space for the largest
/// number of spheres in any world; if that number changes, new arrays are made at the next read.
#[derive(Debug, Default)]
pub struct BatchArrays {
    /// Number of spheres per row.
    most: usize,
    quantities: Quantities,
}

impl BatchArrays {
    /// Returns the array of a quantity with its present values.
    pub fn get(
        &mut self,
        py: Python<'_>,
        quantity: Quantity,
        members: &Members,
    ) -> PyResult<Py<PyAny>> {
        self.follow(py, members)?;
        let shape = members.shape_of(quantity);
        self.quantities.get(py, quantity, shape, |values| write(quantity, members, values))
    }

    /// Writes quantities that a frame changes into existing arrays.
    pub fn write_motion(&mut self, py: Python<'_>, members: &Members) {
        // If emitters add or remove spheres, all quantities change.
        let is_same = members.worlds().all(|world| world.emitters().len() == 0);
        let changed: &[Quantity] = if is_same { &Quantity::MOTION } else { &Quantity::ALL };
        self.write(py, members, changed);
    }

    /// Writes all quantities into existing arrays.
    pub fn write_all(&mut self, py: Python<'_>, members: &Members) {
        self.write(py, members, &Quantity::ALL);
    }

    /// Returns the values that a script wrote; rows run through all places of one world after
    /// another.
    pub fn written(&self, py: Python<'_>, members: &Members) -> Vec<Written> {
        self.quantities.written(py, |quantity, values| write(quantity, members, values))
    }

    fn write(&mut self, py: Python<'_>, members: &Members, quantities: &[Quantity]) {
        // An array that could not be made read-only is dropped as well.
        let _ = self.follow(py, members);
        let write = |quantity, values: &mut [f64]| write(quantity, members, values);
        self.quantities.write(py, quantities, write);
    }

    /// Drops the arrays if the number of spheres per row changed.
    fn follow(&mut self, py: Python<'_>, members: &Members) -> PyResult<()> {
        let most = members.most_spheres();
        if self.most == most {
            return Ok(());
        }
        let old = std::mem::replace(self, Self { most, ..Self::default() });
        old.quantities.freeze(py)
    }
}

/// Returns the ids of all worlds, one world after another; -1 for an empty place.
pub fn ids<'py>(py: Python<'py>, members: &Members) -> PyResult<Bound<'py, PyAny>> {
    let most = members.most_spheres();
    let mut all = vec![-1_i64; members.len() * most];
    for (world, own) in members.worlds().zip(all.chunks_exact_mut(most.max(1))) {
        let ids = world.spheres().ids();
        own.iter_mut().zip(ids).for_each(|(place, id)| *place = id.number() as i64);
    }
    Ok(PyArray1::from_vec(py, all).reshape([members.len(), most])?.into_any())
}

/// Writes a quantity of all worlds, one world after another; NaN for an empty place.
fn write(quantity: Quantity, members: &Members, values: &mut [f64]) {
    let width = quantity.width();
    let places = (width * members.most_spheres()).max(1);
    for (world, own) in members.worlds().zip(values.chunks_exact_mut(places)) {
        let spheres = world.spheres();
        let (own, rest) = own.split_at_mut(width * spheres.len());
        quantity.write(spheres, own);
        rest.fill(f64::NAN);
    }
}
