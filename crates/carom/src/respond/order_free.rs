//! Sums that do not depend on the order of their terms.
//!
//! Mirrored or renumbered bodies present the same terms in another order. A floating-point sum
//! would round differently; a sum of integers does not. The idea of rounding all terms to one
//! grid first: Demmel and Nguyen, "Fast reproducible floating-point summation", ARITH 21 (2013).

use std::array;
use std::ops::{Add, Mul, Sub};

use glam::DVec3;

/// Bits of a double-precision number.
const DIGITS: i32 = f64::MANTISSA_DIGITS as i32;

/// Numbers beyond these powers of two are scaled for the sum, so that nothing overflows on the way and
/// little is lost.
const LARGEST_EXPONENT: i32 = 800;

/// Two grids whose multiples are added in double precision without any rounding, so in any order.
///
/// A term is split into a multiple of the coarse grid, a multiple of the fine one, and a rest that is
/// left out. The grids are so coarse that no sum of all terms rounds.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grid {
    /// A power of two, as a rule 1.
    scale: f64,
    /// Inverse of the scale.
    unscale: f64,
    /// Added and subtracted, they round to multiples of the grids.
    coarse: f64,
    fine: f64,
}

/// A term or a sum on a [`Grid`]: its multiples of the coarse and of the fine grid.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Steps<T> {
    coarse: T,
    fine: T,
}

impl Steps<DVec3> {
    pub fn add(&mut self, other: Self) {
        self.coarse += other.coarse;
        self.fine += other.fine;
    }

    pub fn subtract(&mut self, other: Self) {
        self.coarse -= other.coarse;
        self.fine -= other.fine;
    }
}

impl Grid {
    /// For sums of up to `terms` terms, none larger in magnitude than `largest`.
    ///
    /// What is left out of a term is below `terms² · largest / 2^100`: with a thousand terms, 10⁻²⁴ of
    /// the largest.
    pub fn new(largest: f64, terms: usize) -> Self {
        let growth = (usize::BITS - terms.leading_zeros()) as i32;
        let exponent = exponent_of(largest);
        let shift = exponent - exponent.clamp(-LARGEST_EXPONENT, LARGEST_EXPONENT);
        // Terms are below 2^top, sums below 2^(top + growth), which is 2^52 coarse steps.
        let top = exponent - shift + 1;
        let coarse = top + growth - (DIGITS - 1);
        let fine = coarse + growth - (DIGITS - 1);
        // One and a half times 2^52 steps: next to it, numbers are a step apart.
        let rounding_to = |step: i32| 1.5 * power_of_two(step + DIGITS - 1);
        Self {
            scale: power_of_two(-shift),
            unscale: power_of_two(shift),
            coarse: rounding_to(coarse),
            fine: rounding_to(fine),
        }
    }

    /// A term on the grid.
    #[inline(always)]
    pub fn split<T>(&self, term: T) -> Steps<T>
    where
        T: Copy
            + Mul<f64, Output = T>
            + Add<f64, Output = T>
            + Sub<f64, Output = T>
            + Sub<Output = T>,
    {
        let term = term * self.scale;
        let coarse = (term + self.coarse) - self.coarse;
        let fine = ((term - coarse) + self.fine) - self.fine;
        Steps { coarse, fine }
    }

    /// The value of a sum, rounded once.
    #[inline(always)]
    pub fn value<T>(&self, sum: Steps<T>) -> T
    where
        T: Add<Output = T> + Mul<f64, Output = T>,
    {
        (sum.coarse + sum.fine) * self.unscale
    }
}

/// Sums that are kept side by side, for the processor to add several terms at once.
const LANES: usize = 8;

/// Sum of the terms, as good as if it had been rounded once, whatever their order.
pub(super) fn total(terms: &[f64]) -> f64 {
    let (whole, rest) = terms.as_chunks::<LANES>();
    let mut last = [0.0; LANES];
    last[..rest.len()].copy_from_slice(rest);
    let mut largest = [0.0; LANES];
    for chunk in whole.iter().chain([&last]) {
        // Not a number counts as none.
        largest = array::from_fn(|lane| {
            let size = chunk[lane].abs();
            if size > largest[lane] { size } else { largest[lane] }
        });
    }
    let grid = Grid::new(largest.into_iter().fold(0.0, f64::max), terms.len());
    let (mut coarse, mut fine) = ([0.0; LANES], [0.0; LANES]);
    for chunk in whole.iter().chain([&last]) {
        let scaled: [f64; LANES] = array::from_fn(|lane| chunk[lane] * grid.scale);
        let steps: [f64; LANES] = array::from_fn(|lane| (scaled[lane] + grid.coarse) - grid.coarse);
        let rests: [f64; LANES] = array::from_fn(|lane| scaled[lane] - steps[lane]);
        coarse = array::from_fn(|lane| coarse[lane] + steps[lane]);
        fine = array::from_fn(|lane| fine[lane] + ((rests[lane] + grid.fine) - grid.fine));
    }
    grid.value(Steps { coarse: coarse.iter().sum(), fine: fine.iter().sum() })
}

/// [`total`] of terms that are put in working memory.
pub(super) fn sum_of(memory: &mut Vec<f64>, terms: impl Iterator<Item = f64>) -> f64 {
    memory.clear();
    memory.extend(terms);
    total(memory)
}

/// [`total`] of terms that are not in memory.
pub(super) fn sum(terms: impl Iterator<Item = f64>) -> f64 {
    total(&terms.collect::<Vec<f64>>())
}

/// The largest power of two not above x, as its exponent; for normal numbers.
pub(super) fn exponent_of(x: f64) -> i32 {
    ((x.to_bits() >> 52) & 0x7ff) as i32 - 1023
}

/// 2 to the `exponent`, for exponents of normal numbers.
pub(super) fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((exponent.clamp(-1022, 1023) + 1023) as u64) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_of_terms_changes_no_bit() {
        let terms = [1.0, 1e-16, 1e-16, -1.0 / 3.0, 3e-5, -7e-11, 1e-30];
        let forward = sum(terms.into_iter());
        let backward = sum(terms.into_iter().rev());
        assert_eq!(forward.to_bits(), backward.to_bits());
        assert_eq!(sum(terms.into_iter().map(|term| -term)), -forward);
    }

    #[test]
    fn opposite_terms_cancel_exactly() {
        assert_eq!(sum([0.1, 0.7, 1e-3, -0.7, -0.1].into_iter()), 1e-3);
        assert_eq!(sum([0.1, 0.7, -0.7, -0.1].into_iter()), 0.0);
    }

    #[test]
    fn sums_of_extreme_or_no_terms_are_harmless() {
        assert_eq!(sum([].into_iter()), 0.0);
        assert_eq!(sum([0.0, -0.0].into_iter()), 0.0);
        assert_eq!(sum([f64::MAX, -f64::MAX, 1.0].into_iter()), 0.0);
        // Not numbers: anything but a panic.
        sum([f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1.0].into_iter());
    }
}
