//! Polynomials through values at the nodes of a step.

use std::ops::{Add, Div, Mul, Sub};

use crate::polynomial_flight::TERMS;

/// What a polynomial may have as values.
pub(crate) trait Value:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self> + Div<f64, Output = Self>
{
}

impl<T> Value for T where
    T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T> + Div<f64, Output = T>
{
}

/// The polynomial with these values at nodes, as a sum of powers: divided differences, which are the factors of the
/// products `basis` of nodes.
pub(super) fn through<T: Value>(
    nodes: &[f64; TERMS],
    basis: &[[f64; TERMS]; TERMS],
    values: [T; TERMS],
) -> [T; TERMS] {
    let mut newton = values;
    for node in 1..TERMS {
        for before in 0..node {
            newton[node] = (newton[node] - newton[before]) / (nodes[node] - nodes[before]);
        }
    }
    std::array::from_fn(|power| {
        let terms = (power + 1..TERMS).map(|n| newton[n] * basis[n][power]);
        terms.fold(newton[power] * basis[power][power], |sum, term| sum + term)
    })
}
