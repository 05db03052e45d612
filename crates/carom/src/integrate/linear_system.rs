//! Systems of linear equations of moderate size, solved by elimination with row exchanges.

/// A square matrix as the product of a lower and an upper triangle (Gauss; the largest number of a column comes first).
pub(super) struct Factorized {
    count: usize,
    /// Both triangles, by rows.
    values: Vec<f64>,
    /// The row that each row was exchanged with.
    exchanged: Vec<usize>,
}

impl Factorized {
    /// Factorizes the matrix of `count` rows with these values, by rows; `None` if it is singular.
    pub fn of(count: usize, mut values: Vec<f64>) -> Option<Self> {
        let mut exchanged = Vec::with_capacity(count);
        for known in 0..count {
            let size = |row: &usize| values[row * count + known].abs();
            let largest = (known..count).reduce(|a, b| if size(&b) > size(&a) { b } else { a })?;
            let is_regular = size(&largest) > 0.0 && size(&largest).is_finite();
            if !is_regular {
                return None;
            }
            exchanged.push(largest);
            for column in 0..count {
                values.swap(known * count + column, largest * count + column);
            }
            let (above, below) = values.split_at_mut((known + 1) * count);
            let pivot_row = &above[known * count..];
            for row in below.chunks_exact_mut(count) {
                let factor = row[known] / pivot_row[known];
                row[known] = factor;
                let terms = row.iter_mut().zip(pivot_row).skip(known + 1);
                terms.for_each(|(value, of_pivot)| *value -= factor * *of_pivot);
            }
        }
        Some(Self { count, values, exchanged })
    }

    /// Replaces a right side by the solution.
    pub fn solve(&self, side: &mut [f64]) {
        for (row, &other) in self.exchanged.iter().enumerate() {
            side.swap(row, other);
        }
        let rows = || self.values.chunks_exact(self.count).enumerate();
        for (row, factors) in rows() {
            let known: f64 = factors[..row].iter().zip(&side[..row]).map(|(a, b)| a * b).sum();
            side[row] -= known;
        }
        for (row, factors) in rows().rev() {
            let known = factors.iter().zip(side.iter()).skip(row + 1).map(|(a, b)| a * b);
            side[row] = (side[row] - known.sum::<f64>()) / factors[row];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Factorized;

    #[test]
    fn solution_fulfils_its_equations_where_rows_must_be_exchanged() {
        let matrix = [0.0, 2.0, 1.0, 1.0, -1.0, 3.0, 4.0, 0.5, 0.0];
        let mut side = [1.0, 2.0, 3.0];
        Factorized::of(3, matrix.to_vec()).unwrap().solve(&mut side);
        for (row, wanted) in matrix.chunks(3).zip([1.0, 2.0, 3.0]) {
            let sum: f64 = row.iter().zip(side).map(|(a, b)| a * b).sum();
            // Rounding of three terms of size 4.
            assert!((sum - wanted).abs() < 1e-15 * 16.0, "{sum}");
        }
    }

    #[test]
    fn singular_matrix_has_no_factors() {
        assert!(Factorized::of(2, vec![1.0, 2.0, 2.0, 4.0]).is_none());
    }
}
