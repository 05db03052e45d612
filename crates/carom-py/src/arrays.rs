//! Arrays of spheres for NumPy.
//!
//! Python owns the memory: a script can read an array as long as it holds it, even without the
//! world. After a script has read an array, the world updates it after every frame, so reading is
//! free. The next call on the world applies values that a script wrote into an array. When spheres
//! are added or removed, the world drops its arrays and makes new ones at the next read; the old
//! ones keep their last values and become read-only.
//! last values of their spheres, and cannot be written to.

use carom::{SphereId, Spheres};
use numpy::{Element, PyArray, PyArray1, PyArrayDyn, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::IntoPyDict;

use crate::quantity::Quantity;
use crate::written::Written;

/// The arrays of a world that a script has read.
#[derive(Debug, Default)]
pub struct Arrays {
    /// Spheres of the rows.
    members: Vec<SphereId>,
    quantities: Quantities,
    ids: Option<Py<PyArray1<u64>>>,
}

/// Arrays of quantities that a script has read, indexed by [`Quantity`].
#[derive(Debug, Default)]
pub struct Quantities([Option<ArrayView>; Quantity::ALL.len()]);

impl Quantities {
    /// Returns the array of a quantity for Python. If it does not exist, it is made with this shape
    /// and filled by `fill`.
    pub fn get(
        &mut self,
        py: Python<'_>,
        quantity: Quantity,
        shape: Vec<usize>,
        fill: impl FnOnce(&mut [f64]),
    ) -> PyResult<Py<PyAny>> {
        let place = &mut self.0[quantity as usize];
        if let Some(shown) = place {
            return Ok(shown.view(py));
        }
        let mut values = vec![0.0; shape.iter().product()];
        fill(&mut values);
        Ok(place.insert(ArrayView::new(py, values, shape)?).view(py))
    }

    /// Calls `fill` for the existing arrays of these quantities.
    pub fn write(
        &mut self,
        py: Python<'_>,
        quantities: &[Quantity],
        fill: impl Fn(Quantity, &mut [f64]),
    ) {
        for &quantity in quantities {
            let place = &mut self.0[quantity as usize];
            let Some(shown) = place else { continue };
            if !shown.write(py, |values| fill(quantity, values)) {
                *place = None;
            }
        }
    }

    /// Returns the values that a script wrote: those that differ from what `fill` writes.
    pub fn written(&self, py: Python<'_>, fill: impl Fn(Quantity, &mut [f64])) -> Vec<Written> {
        let mut all = Vec::new();
        for (quantity, shown) in Quantity::ALL.into_iter().zip(&self.0) {
            let Some(shown) = shown else { continue };
            let Ok(array) = shown.own.bind(py).try_readonly() else { continue };
            let Ok(values) = array.as_slice() else { continue };
            let mut own = vec![0.0; values.len()];
            fill(quantity, &mut own);
            let differs = |(one, other): (&f64, &f64)| one.to_bits() != other.to_bits();
            if !values.iter().zip(&own).any(differs) {
                continue;
            }
            let width = quantity.width();
            let both = values.chunks_exact(width).zip(own.chunks_exact(width)).enumerate();
            let rows = both.filter(|(_, (values, own))| values.iter().zip(*own).any(differs));
            let rows = rows.map(|(row, _)| row).collect();
            all.push(Written { quantity, values: values.to_vec(), rows });
        }
        all
    }

    /// Makes all arrays read-only.
    pub fn freeze(&self, py: Python<'_>) -> PyResult<()> {
        self.0.iter().flatten().try_for_each(|shown| freeze(shown.view.bind(py)))
    }
}

/// An array, and the view of it that Python gets.
#[derive(Debug)]
struct ArrayView {
    own: Py<PyArrayDyn<f64>>,
    /// A view of the same memory. A script can make it read-only, and the world can still write.
    view: Py<PyAny>,
}

impl ArrayView {
    /// Makes an array of these values.
    fn new(py: Python<'_>, values: Vec<f64>, shape: Vec<usize>) -> PyResult<Self> {
        let own = PyArray1::from_vec(py, values).reshape(shape)?;
        let view = own.call_method0("view")?.unbind();
        Ok(Self { own: own.unbind(), view })
    }

    /// Returns the view.
    fn view(&self, py: Python<'_>) -> Py<PyAny> {
        self.view.clone_ref(py)
    }

    /// Writes into the array. Returns `false` without writing if other native code is reading it.
    fn write(&self, py: Python<'_>, write: impl FnOnce(&mut [f64])) -> bool {
        let array = self.own.bind(py);
        let mut borrowed = array.try_readwrite();
        match borrowed.as_mut().map(|array| array.as_slice_mut()) {
            Ok(Ok(slice)) => {
                write(slice);
                true
            }
            _ => false,
        }
    }
}

impl Arrays {
    /// Returns the array of a quantity with its present values.
    pub fn get(
        &mut self,
        py: Python<'_>,
        quantity: Quantity,
        spheres: &Spheres,
    ) -> PyResult<Py<PyAny>> {
        self.follow(py, spheres)?;
        let shape = quantity.shape(spheres.len());
        self.quantities.get(py, quantity, shape, |values| quantity.write(spheres, values))
    }

    /// Returns the ids, ascending.
    pub fn ids(&mut self, py: Python<'_>, spheres: &Spheres) -> PyResult<Py<PyArray1<u64>>> {
        self.follow(py, spheres)?;
        if let Some(ids) = &self.ids {
            return Ok(ids.clone_ref(py));
        }
        let ids = numbers(py, spheres.ids());
        freeze(&ids)?;
        let ids = ids.unbind();
        self.ids = Some(ids.clone_ref(py));
        Ok(ids)
    }

    /// Writes quantities that a frame changes into existing arrays.
    pub fn write_motion(&mut self, py: Python<'_>, spheres: &Spheres) {
        self.write(py, spheres, &Quantity::MOTION);
    }

    /// Writes all quantities into existing arrays.
    pub fn write_all(&mut self, py: Python<'_>, spheres: &Spheres) {
        self.write(py, spheres, &Quantity::ALL);
    }

    /// Returns the values that a script wrote.
    pub fn written(&self, py: Python<'_>, spheres: &Spheres) -> Vec<Written> {
        if self.members != spheres.ids() {
            return Vec::new();
        }
        self.quantities.written(py, |quantity, values| quantity.write(spheres, values))
    }

    fn write(&mut self, py: Python<'_>, spheres: &Spheres, quantities: &[Quantity]) {
        // An array that could not be made read-only is dropped as well.
        let _ = self.follow(py, spheres);
        self.quantities.write(py, quantities, |quantity, values| quantity.write(spheres, values));
    }

    /// Drops the arrays if the world has other spheres than their rows.
    fn follow(&mut self, py: Python<'_>, spheres: &Spheres) -> PyResult<()> {
        if self.members == spheres.ids() {
            return Ok(());
        }
        let members = spheres.ids().to_vec();
        let old = std::mem::replace(self, Self { members, ..Self::default() });
        old.quantities.freeze(py)
    }
}

/// Returns ids as a new array.
pub fn numbers<'py>(py: Python<'py>, ids: &[SphereId]) -> Bound<'py, PyArray1<u64>> {
    PyArray1::from_vec(py, ids.iter().map(|id| id.number()).collect())
}

/// Makes an array read-only.
fn freeze(array: &Bound<'_, PyAny>) -> PyResult<()> {
    let kwargs = [("write", false)].into_py_dict(array.py())?;
    array.call_method("setflags", (), Some(&kwargs)).map(drop)
}

/// Turns a list into an array of this shape without copying.
pub fn shaped<'py, T: Element>(
    py: Python<'py>,
    values: Vec<T>,
    shape: Vec<usize>,
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    PyArray::from_vec(py, values).reshape(shape)
}
