//! Symmetric linear equations in dual numbers.

use crate::tangent::dual::Dual;

/// A pivot below this part of the first one is rounding: its equation follows from the others.
const REDUNDANT: f64 = 1e-10;

/// Solution of equations.
pub(super) struct Solution {
    /// Zero where an equation follows from the others.
    pub unknowns: Vec<Dual>,
    /// Changes of what is left of equations that follow from the others: zero if they still do.
    pub left: Vec<f64>,
}

/// Solves `A x = b` with a positive semidefinite matrix by elimination with diagonal pivots.
pub(super) fn solve(mut matrix: Vec<Vec<Dual>>, mut given: Vec<Dual>) -> Solution {
    let count = given.len();
    let mut remaining: Vec<usize> = (0..count).collect();
    let mut order = Vec::with_capacity(count);
    let mut largest = 0.0;
    while let Some(at) = largest_pivot(&matrix, &remaining) {
        let pivot = remaining[at];
        let size = matrix[pivot][pivot].value;
        if order.is_empty() {
            largest = size;
        }
        if size <= REDUNDANT * largest {
            break;
        }
        remaining.swap_remove(at);
        for &row in &remaining {
            let factor = matrix[row][pivot] / matrix[pivot][pivot];
            for &column in &remaining {
                let part = factor * matrix[pivot][column];
                matrix[row][column] = matrix[row][column] - part;
            }
            given[row] = given[row] - factor * given[pivot];
        }
        order.push((pivot, remaining.clone()));
    }
    let mut unknowns = vec![Dual::constant(0.0); count];
    for (pivot, later) in order.iter().rev() {
        let known = later.iter().map(|&column| matrix[*pivot][column] * unknowns[column]);
        let known = known.fold(Dual::constant(0.0), |sum, it| sum + it);
        unknowns[*pivot] = (given[*pivot] - known) / matrix[*pivot][*pivot];
    }
    let left = remaining.iter().map(|&row| given[row].change).collect();
    Solution { unknowns, left }
}

fn largest_pivot(matrix: &[Vec<Dual>], remaining: &[usize]) -> Option<usize> {
    let size = |at: &usize| matrix[remaining[*at]][remaining[*at]].value;
    (0..remaining.len()).max_by(|a, b| size(a).total_cmp(&size(b)))
}
