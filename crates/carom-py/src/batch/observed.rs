//! Observations: quantities of all spheres of a world in a row of numbers.

use carom::World;
use numpy::{Element, PyArrayDyn, PyArrayMethods, PyReadwriteArrayDyn, PyUntypedArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

use crate::failure::Failure;
use crate::quantity::Quantity;

/// The columns of an observation.
#[derive(Debug, Clone)]
pub struct Columns {
    quantities: Vec<Quantity>,
    /// Number of spheres for which there are places.
    most: usize,
}

impl Columns {
    /// Returns the columns of the quantities with these names, of worlds with at most this number of spheres.
    ///
    /// # Errors
    /// [`Failure`] for an unknown name.
    pub fn named(names: &[String], most: usize) -> Result<Self, Failure> {
        let known = |name: &String| {
            let quantity = Quantity::ALL.into_iter().find(|it| it.name() == name);
            let names = || Quantity::ALL.map(Quantity::name).join(", ");
            quantity.ok_or_else(|| {
                Failure::value("quantities", format_args!("must be of {}, not {name:?}", names()))
            })
        };
        let quantities = names.iter().map(known).collect::<Result<_, _>>()?;
        Ok(Self { quantities, most })
    }

    /// Returns the number of columns.
    pub fn len(&self) -> usize {
        self.quantities.iter().map(|it| it.width()).sum::<usize>() * self.most
    }

    /// Writes the quantities of a world, one after the other; NaN where it has no sphere.
    fn write(&self, world: &World, values: &mut [f64]) {
        let spheres = world.spheres();
        let mut rest = values;
        for quantity in &self.quantities {
            let (own, others) = rest.split_at_mut(quantity.width() * self.most);
            let (own, empty) = own.split_at_mut(quantity.width() * spheres.len().min(self.most));
            quantity.write(spheres, own);
            empty.fill(f64::NAN);
            rest = others;
        }
    }
}

/// The array for observations of all worlds.
#[derive(Debug)]
pub enum Out<'py> {
    Single(PyReadwriteArrayDyn<'py, f32>),
    Double(PyReadwriteArrayDyn<'py, f64>),
}

/// The place of an observation of one world.
#[derive(Debug)]
pub enum Row<'a> {
    Nowhere,
    Single(&'a mut [f32]),
    Double(&'a mut [f64]),
}

impl<'py> Out<'py> {
    /// Takes an array with rows for `count` worlds.
    ///
    /// # Errors
    /// `TypeError` for numbers of another kind, [`Failure`] for another shape, and an array that cannot be written.
    pub fn of(out: &Bound<'py, PyAny>, count: usize, columns: &Columns) -> PyResult<Self> {
        if let Ok(out) = out.cast::<PyArrayDyn<f32>>() {
            return Ok(Self::Single(checked(out, [count, columns.len()])?));
        }
        match out.cast::<PyArrayDyn<f64>>() {
            Ok(out) => Ok(Self::Double(checked(out, [count, columns.len()])?)),
            Err(_) => Err(PyTypeError::new_err("out: must be an array of float32 or float64")),
        }
    }

    /// Returns the rows of `count` worlds.
    pub fn rows(&mut self, count: usize, columns: &Columns) -> Vec<Row<'_>> {
        let length = columns.len();
        if length == 0 {
            return (0..count).map(|_| Row::Nowhere).collect();
        }
        // The array is contiguous.
        match self {
            Self::Single(out) => match out.as_slice_mut() {
                Ok(all) => all.chunks_exact_mut(length).map(Row::Single).collect(),
                Err(_) => Vec::new(),
            },
            Self::Double(out) => match out.as_slice_mut() {
                Ok(all) => all.chunks_exact_mut(length).map(Row::Double).collect(),
                Err(_) => Vec::new(),
            },
        }
    }
}

impl Row<'_> {
    /// Writes the observation of a world; `values` is working memory.
    pub fn write(&mut self, world: &World, columns: &Columns, values: &mut Vec<f64>) {
        match self {
            Self::Nowhere => {}
            Self::Double(row) => columns.write(world, row),
            Self::Single(row) => {
                values.resize(row.len(), 0.0);
                columns.write(world, values);
                row.iter_mut().zip(&*values).for_each(|(place, &value)| *place = value as f32);
            }
        }
    }
}

/// Borrows an array of this shape to write into it.
fn checked<'py, T: Element>(
    out: &Bound<'py, PyArrayDyn<T>>,
    [count, columns]: [usize; 2],
) -> PyResult<PyReadwriteArrayDyn<'py, T>> {
    if out.shape() != [count, columns] {
        let problem = format_args!("must be of shape ({count}, {columns}), not {:?}", out.shape());
        return Err(Failure::value("out", problem).into());
    }
    let refused = || Failure::value("out", "must be writable and contiguous, in the order of C");
    let mut array = out.try_readwrite().map_err(|_| refused())?;
    if array.as_slice_mut().is_err() {
        return Err(refused().into());
    }
    Ok(array)
}
