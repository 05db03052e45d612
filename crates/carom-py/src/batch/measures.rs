//! Numbers of each world of a batch, and observations for agents.

// Python shows these comments as docstrings, with units in plain brackets.
#![allow(rustdoc::broken_intra_doc_links)]

use carom::World;
use numpy::{Element, PyArray1};
use pyo3::prelude::*;

use super::BatchEngine;
use super::observed::{Columns, Out};

#[pymethods]
impl BatchEngine {
    /// Kinetic energy of each world [J], shape (n,). A copy.
    #[getter]
    fn kinetic_energies<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.number_of_each(py, World::kinetic_energy)
    }

    /// Potential energy of each world [J] in all forces and springs that have one, shape (n,). A copy.
    #[getter]
    fn potential_energies<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.number_of_each(py, World::potential_energy)
    }

    /// Kinetic and potential energy of each world [J], shape (n,). A copy.
    #[getter]
    fn total_energies<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.number_of_each(py, World::total_energy)
    }

    /// Number of persistent contacts of each world, shape (n,), int64. A copy.
    #[getter]
    fn contact_counts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<i64>>> {
        self.number_of_each(py, |world| world.contacts().len() as i64)
    }

    /// Number of impacts of each world in all frames of the last step, shape (n,), int64. A copy.
    #[getter]
    fn impact_counts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<i64>>> {
        let guard = self.lock(py)?;
        Ok(PyArray1::from_iter(py, guard.members.impact_counts()))
    }

    /// Returns the number of columns of an observation of these quantities.
    #[pyo3(name = "_observation_length")]
    fn observation_length(&self, py: Python<'_>, quantities: Vec<String>) -> PyResult<usize> {
        Ok(Columns::named(&quantities, self.lock(py)?.members.most_spheres())?.len())
    }

    /// Writes quantities of all spheres into `out`, float32 or float64 of shape (n, columns): a row for each world, in
    /// it the quantities one after the other.
    #[pyo3(name = "_observe")]
    fn observe(
        &self,
        py: Python<'_>,
        quantities: Vec<String>,
        out: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let members = &self.lock(py)?.members;
        let columns = Columns::named(&quantities, members.most_spheres())?;
        let mut out = Out::of(out, members.len(), &columns)?;
        let mut values = Vec::new();
        let rows = out.rows(members.len(), &columns);
        for (world, mut row) in members.worlds().zip(rows) {
            row.write(world, &columns, &mut values);
        }
        Ok(())
    }
}

impl BatchEngine {
    fn number_of_each<'py, T: Element>(
        &self,
        py: Python<'py>,
        number: impl Fn(&World) -> T,
    ) -> PyResult<Bound<'py, PyArray1<T>>> {
        let guard = self.lock(py)?;
        Ok(PyArray1::from_iter(py, guard.members.worlds().map(number)))
    }
}
