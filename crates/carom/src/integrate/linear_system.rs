//! Systems of linear equations of moderate size, solved by elimination with row exchanges.

/// A square matrix with numbers near its diagonal only, as the product of a lower and an upper triangle (Gauss; the largest
/// number of a column comes first).
///
/// Source: Golub and Van Loan, *Matrix Computations* (2013), section 4.3.
pub(super) struct Factorized {
    count: usize,
    /// How far from the diagonal numbers are.
    reach: usize,
    /// Both triangles, by rows: each from `reach` columns before the diagonal to twice as far behind it.
    values: Vec<f64>,
    /// The row that each row was exchanged with.
    exchanged: Vec<usize>,
}

impl Factorized {
    /// Factorizes a matrix of `count` rows, whose numbers are at most `reach` places from the diagonal; `None` if it is
    /// singular.
    pub fn of(count: usize, reach: usize, number: impl Fn(usize, usize) -> f64) -> Option<Self> {
        let reach = reach.min(count.saturating_sub(1));
        let width = 3 * reach + 1;
        let mut values = vec![0.0; count * width];
        for (row, values) in values.chunks_exact_mut(width).enumerate() {
            for column in row.saturating_sub(reach)..count.min(row + reach + 1) {
                values[column + reach - row] = number(row, column);
            }
        }
        let mut matrix = Self { count, reach, values, exchanged: Vec::with_capacity(count) };
        (0..count).all(|known| matrix.eliminate(known)).then_some(matrix)
    }

    /// Place of a number among the values.
    fn place(&self, row: usize, column: usize) -> usize {
        row * (3 * self.reach + 1) + column + self.reach - row
    }

    /// The rows below one with numbers in its column.
    fn below(&self, known: usize) -> std::ops::Range<usize> {
        known + 1..self.count.min(known + self.reach + 1)
    }

    /// The columns behind one with numbers in its row, also after exchanges.
    fn behind(&self, known: usize) -> std::ops::Range<usize> {
        known + 1..self.count.min(known + 2 * self.reach + 1)
    }

    /// Takes an unknown out of all further rows. Returns whether they give it a value.
    fn eliminate(&mut self, known: usize) -> bool {
        let size = |row: &usize| self.values[self.place(*row, known)].abs();
        let rows = std::iter::once(known).chain(self.below(known));
        let Some(largest) = rows.reduce(|a, b| if size(&b) > size(&a) { b } else { a }) else {
            return false;
        };
        if !(size(&largest) > 0.0 && size(&largest).is_finite()) {
            return false;
        }
        self.exchanged.push(largest);
        for column in std::iter::once(known).chain(self.behind(known)) {
            let places = [known, largest].map(|row| self.place(row, column));
            self.values.swap(places[0], places[1]);
        }
        let pivot = self.place(known, known);
        let length = self.behind(known).len();
        for row in self.below(known) {
            let first = self.place(row, known);
            let (above, below) = self.values.split_at_mut(first);
            let factor = below[0] / above[pivot];
            below[0] = factor;
            let terms = below[1..=length].iter_mut().zip(&above[pivot + 1..=pivot + length]);
            terms.for_each(|(value, of_pivot)| *value -= factor * *of_pivot);
        }
        true
    }

    /// Replaces a right side by the solution.
    pub fn solve(&self, side: &mut [f64]) {
        for (known, &other) in self.exchanged.iter().enumerate() {
            side.swap(known, other);
            let value = side[known];
            for row in self.below(known) {
                side[row] -= self.values[self.place(row, known)] * value;
            }
        }
        for row in (0..self.count).rev() {
            let behind = self.behind(row);
            let known = behind.map(|column| self.values[self.place(row, column)] * side[column]);
            side[row] = (side[row] - known.sum::<f64>()) / self.values[self.place(row, row)];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Factorized;

    fn assert_solved(count: usize, reach: usize, number: impl Fn(usize, usize) -> f64) {
        let wanted: Vec<f64> = (1..=count).map(|it| it as f64).collect();
        let mut side = wanted.clone();
        Factorized::of(count, reach, &number).unwrap().solve(&mut side);
        for (row, wanted) in wanted.into_iter().enumerate() {
            let near = row.saturating_sub(reach)..count.min(row + reach + 1);
            let sum: f64 = near.map(|column| number(row, column) * side[column]).sum();
            // Rounding of some terms of size 4.
            assert!((sum - wanted).abs() < 1e-13, "{row}: {sum}");
        }
    }

    #[test]
    fn solution_fulfils_its_equations_where_rows_must_be_exchanged() {
        let matrix = [0.0, 2.0, 1.0, 1.0, -1.0, 3.0, 4.0, 0.5, 0.0];
        assert_solved(3, 2, |row, column| matrix[3 * row + column]);
    }

    #[test]
    fn solution_of_a_band_fulfils_its_equations_where_rows_must_be_exchanged() {
        assert_solved(12, 2, |row, column| match column + 2 - row {
            2 => 0.1 * row as f64,
            3 => 2.0,
            1 => -1.0,
            4 => 0.5,
            _ => 3.0,
        });
    }

    #[test]
    fn singular_matrix_has_no_factors() {
        assert!(
            Factorized::of(2, 1, |row, column| [1.0, 2.0, 2.0, 4.0][2 * row + column]).is_none()
        );
    }
}
