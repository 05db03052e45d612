//! Sums that do not depend on the order of their terms.
//!
//! Mirrored or renumbered bodies present the same terms in another order. A floating-point sum
//! would round differently; a sum of integers does not. The idea of rounding all terms to one
//! grid first: Demmel and Nguyen, "Fast reproducible floating-point summation", ARITH 21 (2013).

/// Bits of a magnitude that a sum may use: those of an `i128`, less the sign and one to spare for
/// a term that rounding carries past `largest`.
const BITS: i32 = 126;

/// A grid of numbers whose multiples are added as integers, exactly and in any order.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grid {
    step: f64,
    steps_per_unit: f64,
}

impl Grid {
    /// For sums of up to `terms` terms, none larger in magnitude than `largest`.
    ///
    /// A term is cut off at `terms · largest / 2^126`: with a thousand terms, at 10⁻³⁵ of the
    /// largest.
    pub fn new(largest: f64, terms: usize) -> Self {
        let growth = (usize::BITS - terms.leading_zeros()) as i32;
        // Within what a power of two can be; terms below 2^-1000 are lost, which is far below
        // what a sum of speeds or impulses can tell.
        let exponent = (exponent_of(largest) + 1 + growth - BITS).clamp(-1000, 1000);
        Self { step: power_of_two(exponent), steps_per_unit: power_of_two(-exponent) }
    }

    /// A term, in steps of the grid; cut off towards zero, so `-term` gives minus the same.
    pub fn steps(&self, term: f64) -> i128 {
        (term * self.steps_per_unit) as i128
    }

    /// The number that lies so many steps from zero, rounded once.
    pub fn value(&self, steps: i128) -> f64 {
        steps as f64 * self.step
    }
}

/// Sum of the terms, as good as if it had been rounded once, whatever their order.
pub(super) fn sum(terms: impl Iterator<Item = f64> + Clone) -> f64 {
    let (largest, count) = terms
        .clone()
        .fold((0.0_f64, 0), |(largest, count), term| (largest.max(term.abs()), count + 1));
    let grid = Grid::new(largest, count);
    grid.value(terms.fold(0, |total: i128, term| total.wrapping_add(grid.steps(term))))
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
