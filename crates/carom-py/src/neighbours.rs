//! Neighbours of points and what follows from them, for `carom.analysis`.

// Python shows these comments as docstrings, with units in plain brackets.
#![allow(rustdoc::broken_intra_doc_links)]

use carom_analysis::{
    Neighbours, Structure, adaptive_structures, bond_order, cluster_labels, structures_within,
};
use numpy::{PyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::failure::Failure;
use crate::pairs::rows;

/// Neighbours of points: behind `carom.analysis.bond_order` and `carom.analysis.crystal_structure`.
#[pyclass(frozen, module = "carom._carom")]
#[derive(Debug)]
pub struct NeighbourLists(Neighbours);

#[pymethods]
impl NeighbourLists {
    /// Finds those within a distance [m], or the nearest ones.
    #[new]
    fn new(
        py: Python<'_>,
        points: PyReadonlyArray2<'_, f64>,
        sides: [f64; 3],
        distance: Option<f64>,
        nearest: usize,
    ) -> PyResult<Self> {
        let points = rows(&points)?;
        let found = py.detach(|| match distance {
            Some(distance) => Some(Neighbours::within(&points, sides, distance)),
            None => Neighbours::nearest(&points, sides, nearest),
        });
        let few = || {
            let within = "within half the smallest side of the box";
            Failure::value("nearest", format_args!("a sphere has fewer than {nearest} {within}"))
        };
        Ok(Self(found.ok_or_else(few)?))
    }

    /// Returns the bond order of each point, and that of all bonds.
    fn bond_order<'py>(
        &self,
        py: Python<'py>,
        degree: usize,
        is_averaged: bool,
    ) -> (Bound<'py, PyArray1<f64>>, f64) {
        let found = py.detach(|| bond_order(&self.0, degree, is_averaged));
        (PyArray1::from_vec(py, found.local), found.total)
    }

    /// Returns the number of the structure around each point, by bonds up to a distance [m] or by
    /// distances that adapt to each point.
    fn structures<'py>(&self, py: Python<'py>, distance: Option<f64>) -> Bound<'py, PyArray1<i64>> {
        let found = py.detach(|| match distance {
            Some(distance) => structures_within(&self.0, distance),
            None => adaptive_structures(&self.0),
        });
        PyArray1::from_iter(py, found.into_iter().map(number))
    }
}

/// Number of a structure in Python.
fn number(structure: Structure) -> i64 {
    match structure {
        Structure::Other => 0,
        Structure::FaceCentered => 1,
        Structure::HexagonalClosePacked => 2,
        Structure::BodyCentered => 3,
        Structure::Icosahedral => 4,
    }
}

/// Returns the cluster of each of `count` points that pairs of indices connect.
#[pyfunction]
pub fn label_clusters<'py>(
    py: Python<'py>,
    count: usize,
    pairs: Vec<[usize; 2]>,
) -> PyResult<Bound<'py, PyArray1<i64>>> {
    if pairs.as_flattened().iter().any(|&index| index >= count) {
        return Err(Failure::value("pairs", "must be indices of spheres").into());
    }
    let labels = py.detach(|| cluster_labels(count, &pairs));
    Ok(PyArray1::from_iter(py, labels.into_iter().map(|label| label as i64)))
}
