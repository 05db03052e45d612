//! Gather and scatter for contacts of pairs: reads the data of their spheres, one pair per lane of the processor's
//! vectors, and writes results back.
//!
//! Every operation is the one that a single contact needs, so no bit depends on the vectors.

use fearless_simd::{Simd, SimdMask};

use super::batch::{PairBatch, Quad, RollingBatch};
use crate::lanes::{LANES, Lanes};
use crate::real::{Real, Vector};
use crate::rule::contact::slots::row::Row;

/// Smaller than any number it is compared with, except zero.
pub(crate) const TINY: f64 = f64::MIN_POSITIVE;

/// Slip of the surfaces at the contact: the tangential part of the velocity, with spin.
#[inline(always)]
pub(crate) fn slip<S: Simd>(
    velocity: Vector<Lanes<S>>,
    normal: Vector<Lanes<S>>,
    spin: Vector<Lanes<S>>,
) -> Vector<Lanes<S>> {
    velocity - normal * velocity.dot(normal) - spin.cross(normal)
}

/// Vectors, shortened to a length where they are longer.
#[inline(always)]
pub(crate) fn limited<S: Simd>(
    simd: S,
    vector: Vector<Lanes<S>>,
    most: Lanes<S>,
) -> Vector<Lanes<S>> {
    let length = vector.length_squared().sqrt().max(Lanes::all(simd, TINY));
    vector * (most / length).min(1.0)
}

/// Second minus first of each pair.
#[inline(always)]
pub(crate) fn difference<S: Simd>(simd: S, all: &[Row], batch: &PairBatch) -> [Lanes<S>; LANES] {
    let [first, second] = [gathered(simd, all, &batch.first), gathered(simd, all, &batch.second)];
    let ([a, b, c, d], [e, f, g, h]) = (first, second);
    Lanes::transposed([e - a, f - b, g - c, h - d])
}

/// Velocities of spheres 2, or of their images that slide along x \[m/s\], relative to spheres 1.
#[inline(always)]
pub(crate) fn relative_velocity<S: Simd>(
    simd: S,
    velocities: &[Row],
    batch: &PairBatch,
    slide: Option<&Quad>,
) -> [Lanes<S>; LANES] {
    let [x, y, z, number] = difference(simd, velocities, batch);
    match slide {
        Some(slide) => [x + Lanes::each(simd, *slide), y, z, number],
        None => [x, y, z, number],
    }
}

/// Offsets from spheres 1 to spheres 2, or to their images at these shifts \[m\].
#[inline(always)]
pub(crate) fn offset<S: Simd>(
    simd: S,
    positions: &[Row],
    batch: &PairBatch,
    shift: Option<&[Quad; 3]>,
) -> Vector<Lanes<S>> {
    let offset = xyz(difference(simd, positions, batch));
    match shift {
        Some(shift) => offset + vector(simd, shift),
        None => offset,
    }
}

/// First plus second of each pair.
#[inline(always)]
pub(crate) fn sum<S: Simd>(simd: S, all: &[Row], batch: &PairBatch) -> [Lanes<S>; LANES] {
    let [first, second] = [gathered(simd, all, &batch.first), gathered(simd, all, &batch.second)];
    let ([a, b, c, d], [e, f, g, h]) = (first, second);
    Lanes::transposed([e + a, f + b, g + c, h + d])
}

/// The rows of these slots. Written out, for closures are not compiled for the processor's vectors.
#[inline(always)]
pub(crate) fn gathered<S: Simd>(simd: S, all: &[Row], slots: &[u32; LANES]) -> [Lanes<S>; LANES] {
    let [a, b, c, d] = *slots;
    [
        Lanes::each(simd, all[a as usize].0),
        Lanes::each(simd, all[b as usize].0),
        Lanes::each(simd, all[c as usize].0),
        Lanes::each(simd, all[d as usize].0),
    ]
}

/// Applies impulses to spheres 2, and the opposite ones to spheres 1.
#[inline(always)]
pub(crate) fn apply<S: Simd>(
    simd: S,
    velocities: &mut [Row],
    batch: &PairBatch,
    impulse: Vector<Lanes<S>>,
) {
    let rows = rows_of(simd, impulse);
    for (lane, row) in rows.into_iter().enumerate() {
        let first = &mut velocities[batch.first[lane] as usize];
        shift(simd, first, row * -first.number());
        let second = &mut velocities[batch.second[lane] as usize];
        shift(simd, second, row * second.number());
    }
}

/// Turns both spheres of each pair by tangential impulses, given by their cross product with the normal.
#[inline(always)]
pub(crate) fn apply_spin<S: Simd>(
    simd: S,
    spins: &mut [Row],
    batch: &PairBatch,
    turn: Vector<Lanes<S>>,
) {
    let rows = rows_of(simd, turn);
    for (lane, row) in rows.into_iter().enumerate() {
        for slot in [batch.first[lane], batch.second[lane]] {
            let spin = &mut spins[slot as usize];
            shift(simd, spin, row * -spin.number());
        }
    }
}

/// Applies angular impulses to spheres 2, and the opposite ones to spheres 1.
#[inline(always)]
pub(crate) fn turn<S: Simd>(
    simd: S,
    spins: &mut [Row],
    batch: &PairBatch,
    rolling: &RollingBatch,
    angular: Vector<Lanes<S>>,
) {
    let rows = rows_of(simd, angular);
    for (lane, row) in rows.into_iter().enumerate() {
        let first = &mut spins[batch.first[lane] as usize];
        shift(simd, first, row * -(first.number() * rolling.curvature[0][lane]));
        let second = &mut spins[batch.second[lane] as usize];
        shift(simd, second, row * (second.number() * rolling.curvature[1][lane]));
    }
}

#[inline(always)]
pub(crate) fn shift<S: Simd>(simd: S, row: &mut Row, by: Lanes<S>) {
    row.0 = (Lanes::each(simd, row.0) + by).to_array();
}

#[inline(always)]
pub(crate) fn rows_of<S: Simd>(simd: S, Vector { x, y, z }: Vector<Lanes<S>>) -> [Lanes<S>; LANES] {
    Lanes::transposed([x, y, z, Lanes::all(simd, 0.0)])
}

#[inline(always)]
pub(crate) fn xyz<S: Simd>([x, y, z, _]: [Lanes<S>; LANES]) -> Vector<Lanes<S>> {
    Vector { x, y, z }
}

#[inline(always)]
pub(crate) fn vector<S: Simd>(simd: S, quads: &[Quad; 3]) -> Vector<Lanes<S>> {
    let [x, y, z] = *quads;
    Vector { x: Lanes::each(simd, x), y: Lanes::each(simd, y), z: Lanes::each(simd, z) }
}

#[inline(always)]
pub(crate) fn arrays<S: Simd>(Vector { x, y, z }: Vector<Lanes<S>>) -> [Quad; 3] {
    [x.to_array(), y.to_array(), z.to_array()]
}

#[inline(always)]
pub(crate) fn smaller<S: Simd>(first: Lanes<S>, second: Lanes<S>) -> Lanes<S> {
    first.select(first.is_less(second), second)
}

/// Returns whether any lane is not zero.
#[inline(always)]
pub(crate) fn is_any<S: Simd>(simd: S, numbers: Lanes<S>) -> bool {
    !numbers.is_equal(Lanes::all(simd, 0.0)).all_true()
}
