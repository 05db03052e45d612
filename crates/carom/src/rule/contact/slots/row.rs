//! Four numbers that are read together, and four of these side by side.

use fearless_simd::{Simd, mask64x4};
use glam::DVec3;

use crate::lanes::{LANES, Lanes};
use crate::real::Vector;

/// A vector and a fourth number, in one piece of memory that fits a vector of the processor.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(align(32))]
pub(crate) struct Row(pub [f64; 4]);

/// The value of lanes beyond the last row: at rest, with a mass.
const BEYOND: Row = Row([0.0, 0.0, 0.0, 1.0]);

/// The value of lanes beyond the last reference place: any distance is within reach.
pub(crate) const BOUNDLESS: Row = Row([0.0, 0.0, 0.0, f64::INFINITY]);

impl Row {
    #[inline(always)]
    pub fn new(vector: DVec3, number: f64) -> Self {
        Self([vector.x, vector.y, vector.z, number])
    }

    #[inline(always)]
    pub fn vector(self) -> DVec3 {
        let [x, y, z, _] = self.0;
        DVec3::new(x, y, z)
    }

    /// The number beside the vector.
    #[inline(always)]
    pub fn number(self) -> f64 {
        self.0[3]
    }

    /// The same number beside another vector.
    #[inline(always)]
    pub fn with_vector(self, vector: DVec3) -> Self {
        Self::new(vector, self.0[3])
    }
}

/// The vectors and the numbers of the rows from one on, side by side.
#[inline(always)]
pub(crate) fn columns<S: Simd>(
    simd: S,
    rows: &[Row],
    first: usize,
) -> (Vector<Lanes<S>>, Lanes<S>) {
    columns_or(simd, rows, first, BEYOND)
}

/// [`columns`], with this row in lanes beyond the last one.
#[inline(always)]
pub(crate) fn columns_or<S: Simd>(
    simd: S,
    rows: &[Row],
    first: usize,
    beyond: Row,
) -> (Vector<Lanes<S>>, Lanes<S>) {
    let [a, b, c, d] = four(rows, first, beyond);
    let [x, y, z, number] = Lanes::transposed([
        Lanes::each(simd, a.0),
        Lanes::each(simd, b.0),
        Lanes::each(simd, c.0),
        Lanes::each(simd, d.0),
    ]);
    (Vector { x, y, z }, number)
}

/// Stores vectors and numbers of lanes into the rows from one on.
#[inline(always)]
pub(crate) fn store<S: Simd>(
    rows: &mut [Row],
    first: usize,
    (Vector { x, y, z }, number): (Vector<Lanes<S>>, Lanes<S>),
) {
    let [a, b, c, d] = Lanes::transposed([x, y, z, number]);
    let columns = [a.to_array(), b.to_array(), c.to_array(), d.to_array()];
    for (row, column) in rows[first..].iter_mut().zip(columns) {
        row.0 = column;
    }
}

/// Mask of the lanes whose item satisfies the predicate, of the items from `first` on.
#[inline(always)]
pub(crate) fn flags<S: Simd, T: Copy + Default>(
    simd: S,
    items: &[T],
    first: usize,
    predicate: impl Fn(T) -> bool,
) -> mask64x4<S> {
    let [a, b, c, d] = four(items, first, T::default());
    let number = |item: T| if predicate(item) { 1.0 } else { 0.0 };
    let numbers = Lanes::each(simd, [number(a), number(b), number(c), number(d)]);
    Lanes::all(simd, 0.0).is_less(numbers)
}

/// The items from one on; `beyond` after the last.
#[inline(always)]
fn four<T: Copy>(items: &[T], first: usize, beyond: T) -> [T; LANES] {
    let rest = items.get(first..).unwrap_or_default();
    if let Some(four) = rest.first_chunk() {
        return *four;
    }
    let mut four = [beyond; LANES];
    four[..rest.len()].copy_from_slice(rest);
    four
}
