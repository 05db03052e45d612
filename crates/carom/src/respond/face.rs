//! The minimum among a few contacts, directly.

use glam::DVec3;

use super::problem::Problem;

/// A column whose part independent of the columns before it is smaller than this, of its own
/// length, is that of a redundant contact: what is left are a few roundings per column.
const DEPENDENT: f64 = 1e-13;

/// Triangular factor R of `B = M^-1/2 N`, for the contacts of a face: `A = Bᵀ B = Rᵀ R`.
///
/// Made from B, whose condition is the square root of that of A: masses may differ by as much as
/// double precision holds. Modified Gram-Schmidt (Björck, "Numerical Methods for Least Squares
/// Problems", 1996, section 2.4). The rounding of the result depends on the order of contacts.
#[derive(Debug, Clone, Default)]
pub(super) struct Face {
    /// Contacts of the face.
    contacts: Vec<usize>,
    /// Rows of R, full length each; a row of a redundant contact is zero.
    rows: Vec<Vec<f64>>,
    columns: Vec<Vec<f64>>,
}

impl Face {
    /// Makes the face of these contacts the current one, unless it is already.
    pub fn set(&mut self, problem: &Problem, scales: &[f64], is_free: impl Fn(usize) -> bool) {
        let contacts = (0..problem.links.len()).filter(|contact| is_free(*contact));
        if !contacts.clone().eq(self.contacts.iter().copied()) {
            self.contacts = contacts.collect();
            self.factor(problem, scales);
        }
    }

    /// Forgets the problem.
    pub fn clear(&mut self) {
        self.contacts.clear();
        self.rows.clear();
    }

    /// Solution of `A direction = gradient` on the face, zero elsewhere; redundant contacts take
    /// no part.
    pub fn solve(&self, gradient: &[f64], direction: &mut [f64]) {
        direction.fill(0.0);
        // Rᵀ z = gradient, then R d = z.
        let count = self.contacts.len();
        let mut z = vec![0.0; count];
        for i in 0..count {
            let known: f64 = (0..i).map(|k| self.rows[k][i] * z[k]).sum();
            z[i] = self.over_pivot(i, gradient[self.contacts[i]] - known);
        }
        for i in (0..count).rev() {
            let known: f64 = (i + 1..count).map(|k| self.rows[i][k] * z[k]).sum();
            z[i] = self.over_pivot(i, z[i] - known);
        }
        for (contact, z) in self.contacts.iter().zip(z) {
            direction[*contact] = z;
        }
    }

    fn over_pivot(&self, i: usize, value: f64) -> f64 {
        let pivot = self.rows[i][i];
        if pivot > 0.0 { value / pivot } else { 0.0 }
    }

    fn factor(&mut self, problem: &Problem, scales: &[f64]) {
        let count = self.contacts.len();
        self.columns.clear();
        self.columns.extend(self.contacts.iter().map(|c| column(problem, scales, *c)));
        self.rows.clear();
        self.rows.resize(count, vec![0.0; count]);
        let lengths: Vec<f64> = self.columns.iter().map(|c| dot(c, c).sqrt()).collect();
        for i in 0..count {
            let (done, rest) = self.columns.split_at_mut(i + 1);
            let unit = &mut done[i];
            let length = dot(unit, unit).sqrt();
            if length <= DEPENDENT * lengths[i] {
                continue;
            }
            self.rows[i][i] = length;
            unit.iter_mut().for_each(|part| *part /= length);
            for (k, other) in rest.iter_mut().enumerate() {
                let along = dot(unit, other);
                self.rows[i][i + 1 + k] = along;
                other.iter_mut().zip(unit.iter()).for_each(|(o, u)| *o -= along * u);
            }
        }
    }
}

/// Column of B: what the scaled contact does to each body, by the roots of the masses.
fn column(problem: &Problem, scales: &[f64], contact: usize) -> Vec<f64> {
    let link = &problem.links[contact];
    let mut column = vec![0.0; 3 * problem.inverse_masses.len()];
    let mut put = |body: u32, push: DVec3| {
        let root = problem.inverse_masses[body as usize].sqrt();
        for (part, push) in column[3 * body as usize..].iter_mut().zip((root * push).to_array()) {
            *part += push;
        }
    };
    put(link.second, scales[contact] * link.normal);
    if let Some(first) = link.first {
        put(first, -scales[contact] * link.normal);
    }
    column
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
