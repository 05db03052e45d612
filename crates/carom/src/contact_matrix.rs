//! Linear equations for the forces or impulses of contacts.

/// Forces depend on each other where what one adds to the others is below this part of it.
const DEPENDENT: f64 = 1e-8;

/// What a unit of each force adds to the accelerations along the directions of the contacts (of each impulse to the
/// velocities) \[1/kg\], as the product of a lower and an upper triangle (Gauss, without pivoting: the largest terms are
/// on the diagonal).
#[derive(Default)]
pub(crate) struct ContactMatrix {
    count: usize,
    /// Elements, row by row.
    values: Vec<f64>,
    /// First column of each row with a value, and the column after the last one.
    ranges: Vec<[usize; 2]>,
    is_definite: bool,
}

impl ContactMatrix {
    /// Begins with this number of forces, and no values.
    pub fn begin(&mut self, count: usize) {
        self.count = count;
        self.values.clear();
        self.values.resize(count * count, 0.0);
        self.ranges.clear();
        self.ranges.extend((0..count).map(|row| [row, row + 1]));
    }

    /// Sets a value.
    pub fn set(&mut self, row: usize, column: usize, value: f64) {
        if value != 0.0 {
            self.values[row * self.count + column] = value;
            let [first, end] = self.ranges[row];
            self.ranges[row] = [first.min(column), end.max(column + 1)];
        }
    }

    /// Factorizes. Returns whether all forces are independent; one that is not will be zero.
    pub fn factorize(&mut self) -> bool {
        let count = self.count;
        let mut are_independent = true;
        self.is_definite = true;
        for row in 0..count {
            let diagonal = self.values[row * count + row];
            for known in self.ranges[row][0]..row {
                let pivot = self.values[known * count + known];
                let (above, below) = self.values.split_at_mut(row * count);
                let factor = if pivot == 0.0 { 0.0 } else { below[known] / pivot };
                below[known] = factor;
                if factor == 0.0 {
                    continue;
                }
                let end = self.ranges[known][1];
                let rest = known + 1..end;
                let of_known = &above[known * count..][rest.clone()];
                for (value, &other) in below[rest].iter_mut().zip(of_known) {
                    *value -= factor * other;
                }
                self.ranges[row][1] = self.ranges[row][1].max(end);
            }
            let pivot = &mut self.values[row * count + row];
            if *pivot <= DEPENDENT * diagonal {
                self.is_definite &= *pivot >= -DEPENDENT * diagonal;
                *pivot = 0.0;
                are_independent = false;
            }
        }
        are_independent
    }

    /// Whether every force, with those before it as they follow, moves its bodies along itself and not against it. Without
    /// friction all do.
    pub fn is_definite(&self) -> bool {
        self.is_definite
    }

    /// Solves for the forces in place.
    pub fn solve(&self, forces: &mut [f64]) {
        let count = self.count;
        for row in 0..count {
            let factors = &self.values[row * count..];
            let known: f64 = (self.ranges[row][0]..row).map(|k| factors[k] * forces[k]).sum();
            forces[row] -= known;
        }
        for row in (0..count).rev() {
            let values = &self.values[row * count..];
            let known: f64 = (row + 1..self.ranges[row][1]).map(|k| values[k] * forces[k]).sum();
            let pivot = values[row];
            forces[row] = if pivot == 0.0 { 0.0 } else { (forces[row] - known) / pivot };
        }
    }
}
