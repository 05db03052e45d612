//! Bond orientational order.
//!
//! Sources: P. J. Steinhardt, D. R. Nelson and M. Ronchetti, Phys. Rev. B 28, 784 (1983); averages
//! over neighbours: W. Lechner and C. Dellago, J. Chem. Phys. 129, 114707 (2008).

use crate::neighbours::Neighbours;

/// Orders of one degree.
#[derive(Debug, Clone, PartialEq)]
pub struct BondOrder {
    /// q of each point; NaN where it has no neighbours.
    pub local: Vec<f64>,
    /// Q of all bonds together; NaN without bonds.
    pub total: f64,
}

/// Computes `q_l = sqrt(4π / (2l + 1) Σ_m |q_lm|²)` of each point, with `q_lm` the mean of the
/// spherical harmonic over its bonds. If `is_averaged`, `q_lm` is the mean of a point and its
/// neighbours.
pub fn bond_order(neighbours: &Neighbours, degree: usize, is_averaged: bool) -> BondOrder {
    let harmonics = Harmonics::new(degree);
    let width = 2 * degree + 1;
    let mut sums = vec![0.0; neighbours.len() * width];
    let (mut all, mut bonds) = (vec![0.0; width], 0);
    for (point, sum) in sums.chunks_exact_mut(width).enumerate() {
        for bond in neighbours.of(point) {
            harmonics.add(bond.vector, sum);
        }
        all.iter_mut().zip(&*sum).for_each(|(all, part)| *all += part);
        let count = neighbours.of(point).len();
        bonds += count;
        sum.iter_mut().for_each(|it| *it /= count as f64);
    }
    let of = |point: usize| &sums[point * width..(point + 1) * width];
    let local = (0..neighbours.len()).map(|point| {
        if !is_averaged {
            return length(of(point));
        }
        let mut mean = of(point).to_vec();
        // A neighbour has a bond, too, where bonds are mutual.
        let around = neighbours.of(point).iter().map(|bond| of(bond.to));
        around.for_each(|part| mean.iter_mut().zip(part).for_each(|(mean, it)| *mean += it));
        length(&mean) / (neighbours.of(point).len() + 1) as f64
    });
    BondOrder { local: local.collect(), total: length(&all) / bonds as f64 }
}

fn length(numbers: &[f64]) -> f64 {
    numbers.iter().map(|it| it * it).sum::<f64>().sqrt()
}

/// Real spherical harmonics of one degree, with the sum of squares 1 in every direction: those of
/// orthonormal ones times `sqrt(4π / (2l + 1))`.
struct Harmonics {
    degree: usize,
    /// `sqrt((2 - δ_m0) (l - m)! / (l + m)!)` of each order m.
    factors: Vec<f64>,
}

impl Harmonics {
    fn new(degree: usize) -> Self {
        let mut factors = vec![1.0];
        let mut ratio = 1.0;
        factors.extend((1..=degree).map(|order| {
            // (l - m)! / (l + m)! from that of the order before.
            ratio /= ((degree + order) * (degree - order + 1)) as f64;
            (2.0_f64 * ratio).sqrt()
        }));
        Self { degree, factors }
    }

    /// Adds those of a direction to sums of order 0, then of cosine and sine of each order.
    ///
    /// `P_l^m / sin^m θ` follows from recurrences, and `sin^m θ e^{imφ}` is `(x + iy)^m`.
    fn add(&self, vector: [f64; 3], sums: &mut [f64]) {
        let norm = length(&vector);
        let [x, y, z] = vector.map(|it| it / norm);
        let (mut power, mut diagonal) = ([1.0, 0.0], 1.0);
        for order in 0..=self.degree {
            let value = self.factors[order] * legendre(self.degree, order, z, diagonal);
            if order == 0 {
                sums[0] += value;
            } else {
                sums[2 * order - 1] += value * power[0];
                sums[2 * order] += value * power[1];
            }
            power = [power[0] * x - power[1] * y, power[0] * y + power[1] * x];
            diagonal *= (2 * order + 1) as f64;
        }
    }
}

/// `P_l^m(z) / (1 - z²)^{m/2}` without the sign of Condon and Shortley; `diagonal` is that of l = m,
/// `(2m - 1)!!`.
fn legendre(degree: usize, order: usize, z: f64, diagonal: f64) -> f64 {
    let (mut before, mut value) = (0.0, diagonal);
    for l in order + 1..=degree {
        let next =
            ((2 * l - 1) as f64 * z * value - (l + order - 1) as f64 * before) / (l - order) as f64;
        (before, value) = (value, next);
    }
    value
}
