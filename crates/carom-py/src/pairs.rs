//! Pairs of nearby points, for `carom.analysis`.

// Python shows these comments as docstrings, with units in plain brackets.
#![allow(rustdoc::broken_intra_doc_links)]

use numpy::{IntoPyArray, PyArray1, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::failure::Failure;

/// Both points of each pair, and the squared distances \[m²\].
type Pairs<'py> = (Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<f64>>);

/// Counts the pairs of points in each of `bins` equal intervals of distance up to `r_max` [m].
#[pyfunction]
pub fn pair_histogram<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    sides: [f64; 3],
    r_max: f64,
    bins: usize,
) -> PyResult<Bound<'py, PyArray1<u64>>> {
    let points = rows(&points)?;
    let counts = py.detach(|| carom_analysis::pair_histogram(&points, sides, r_max, bins));
    Ok(counts.into_pyarray(py))
}

/// Returns every pair of points nearer than a distance [m], once.
#[pyfunction]
pub fn pairs_within<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    sides: [f64; 3],
    distance: f64,
) -> PyResult<Pairs<'py>> {
    let points = rows(&points)?;
    let pairs = py.detach(|| carom_analysis::pairs_within(&points, sides, distance));
    let place = |which: usize| pairs.iter().map(move |pair| pair.points[which] as i64);
    let [first, second] = [0, 1].map(|which| PyArray1::from_iter(py, place(which)));
    let squares = PyArray1::from_iter(py, pairs.iter().map(|pair| pair.squared_distance));
    Ok((first, second, squares))
}

/// Returns the rows of an array of shape (n, 3).
pub fn rows(points: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<[f64; 3]>> {
    let wrong = || Failure::value("points", "must have the shape (n, 3)");
    let numbers = points.to_vec().map_err(|_| wrong())?;
    let (rows, rest) = numbers.as_chunks::<3>();
    if points.shape()[1] != 3 || !rest.is_empty() {
        return Err(wrong().into());
    }
    Ok(rows.to_vec())
}
