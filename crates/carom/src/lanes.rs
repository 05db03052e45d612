//! Lanes: several numbers in a vector of the processor.
//!
//! Which vectors it has is found out when the program runs. Each lane is rounded as a number alone, so
//! no bit depends on it.

use std::ops::{Add, Div, Mul, Sub};

use fearless_simd::{
    Select, Simd, SimdBase, SimdCombine, SimdFloat, SimdMask, f64x2, f64x4, mask64x4,
};
use glam::DVec3;

use crate::real::{Real, Vector};

/// How many numbers stand side by side.
pub(crate) const LANES: usize = 4;

/// Numbers side by side, one in each lane of a vector of the processor, or of two.
#[derive(Clone, Copy)]
pub(crate) struct Lanes<S: Simd>(f64x4<S>);

impl<S: Simd> Lanes<S> {
    #[inline(always)]
    pub fn all(simd: S, number: f64) -> Self {
        Self(f64x4::splat(simd, number))
    }

    #[inline(always)]
    pub fn each(simd: S, numbers: [f64; LANES]) -> Self {
        Self(f64x4::load_array(simd, numbers))
    }

    /// The first numbers of pairs, and the second ones.
    #[inline(always)]
    pub fn pairs(simd: S, pairs: [[f64; 2]; LANES]) -> [Self; 2] {
        let [a, b, c, d] = pairs.map(|pair| f64x2::load_array(simd, pair));
        let (first, second) = a.combine(b).deinterleave(c.combine(d));
        [Self(first), Self(second)]
    }

    /// The columns of a square, of its rows.
    #[inline(always)]
    pub fn transposed(rows: [Self; LANES]) -> [Self; LANES] {
        let [Self(a), Self(b), Self(c), Self(d)] = rows;
        let ((ac_low, ac_high), (bd_low, bd_high)) = (a.interleave(c), b.interleave(d));
        let ((first, second), (third, fourth)) =
            (ac_low.interleave(bd_low), ac_high.interleave(bd_high));
        [Self(first), Self(second), Self(third), Self(fourth)]
    }

    #[inline(always)]
    pub fn abs(self) -> Self {
        Self(self.0.abs())
    }

    /// Returns by how much the size of each lane exceeds a bound; none is NaN.
    #[inline(always)]
    pub fn beyond(self, bound: Self) -> Self {
        Self((self.0.abs() - bound.0).max(0.0))
    }

    /// The one in lane 0.
    #[inline(always)]
    pub fn first(self) -> f64 {
        self.0[0]
    }

    /// Rotates the lanes to the front by a number of places; the foremost come behind.
    #[inline(always)]
    pub fn rotated<const BY: usize>(self) -> Self {
        Self(self.0.rotate_elements_left::<BY>())
    }

    /// Returns the largest lane, at least 0; no lane is NaN.
    #[inline(always)]
    pub fn largest(self) -> f64 {
        self.to_array().into_iter().fold(0.0, Real::max)
    }

    /// Returns the sum of the lanes.
    #[inline(always)]
    pub fn sum(self) -> f64 {
        let [a, b, c, d] = self.to_array();
        (a + b) + (c + d)
    }

    /// Returns the lanes as an array, lane 0 first.
    #[inline(always)]
    pub fn to_array(self) -> [f64; LANES] {
        self.0.to_array()
    }

    #[inline(always)]
    pub fn is_less(self, other: Self) -> mask64x4<S> {
        self.0.simd_lt(other.0)
    }

    #[inline(always)]
    pub fn is_equal(self, other: Self) -> mask64x4<S> {
        self.0.simd_eq(other.0)
    }

    #[inline(always)]
    pub fn is_at_most(self, other: Self) -> mask64x4<S> {
        self.0.simd_le(other.0)
    }

    /// Returns these lanes where they are chosen, and others elsewhere.
    #[inline(always)]
    pub fn select(self, chosen: mask64x4<S>, others: Self) -> Self {
        Self(chosen.select(self.0, others.0))
    }
}

impl<S: Simd> Real for Lanes<S> {
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        other.select(self.is_less(other), self)
    }

    #[inline(always)]
    fn min(self, bound: f64) -> Self {
        Self(self.0.min(bound))
    }
}

impl<S: Simd> Add for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl<S: Simd> Sub for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl<S: Simd> Mul for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
}

impl<S: Simd> Mul<f64> for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        Self(self.0 * factor)
    }
}

impl<S: Simd> Div for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self(self.0 / other.0)
    }
}

impl<S: Simd> Vector<Lanes<S>> {
    /// The same one in all lanes.
    #[inline(always)]
    pub fn all(simd: S, DVec3 { x, y, z }: DVec3) -> Self {
        Self { x: Lanes::all(simd, x), y: Lanes::all(simd, y), z: Lanes::all(simd, z) }
    }

    #[inline(always)]
    pub fn each(simd: S, vectors: [DVec3; LANES]) -> Self {
        Self {
            x: Lanes::each(simd, vectors.map(|vector| vector.x)),
            y: Lanes::each(simd, vectors.map(|vector| vector.y)),
            z: Lanes::each(simd, vectors.map(|vector| vector.z)),
        }
    }

    /// Returns these vectors where they are chosen, and others elsewhere.
    #[inline(always)]
    pub fn select(self, chosen: mask64x4<S>, others: Self) -> Self {
        Self {
            x: self.x.select(chosen, others.x),
            y: self.y.select(chosen, others.y),
            z: self.z.select(chosen, others.z),
        }
    }

    /// The nearest whole numbers; the numbers must be less than 2^51.
    #[inline(always)]
    pub fn rounded(self, simd: S) -> Self {
        // From here on there are no fractions.
        let whole = Lanes::all(simd, 1.5 / f64::EPSILON);
        let rounded = |number: Lanes<S>| (number + whole) - whole;
        Self { x: rounded(self.x), y: rounded(self.y), z: rounded(self.z) }
    }

    /// Returns the vectors as an array, lane 0 first.
    #[inline(always)]
    pub fn to_array(self) -> [DVec3; LANES] {
        let [x, y, z] = [self.x, self.y, self.z].map(Lanes::to_array);
        std::array::from_fn(|lane| DVec3::new(x[lane], y[lane], z[lane]))
    }

    /// Sum of the sizes of the components.
    #[inline(always)]
    pub fn l1_norm(self) -> Lanes<S> {
        self.x.abs() + self.y.abs() + self.z.abs()
    }

    /// Whether a component of any goes beyond a bound, either way.
    #[inline(always)]
    pub fn is_beyond(self, bound: Self) -> bool {
        let is_beyond = |number: Lanes<S>, bound: Lanes<S>| bound.is_less(number.abs());
        (is_beyond(self.x, bound.x) | is_beyond(self.y, bound.y) | is_beyond(self.z, bound.z))
            .any_true()
    }

    /// Returns by how much each component goes beyond a bound, either way.
    #[inline(always)]
    pub fn beyond(self, bound: Self) -> Self {
        Self { x: self.x.beyond(bound.x), y: self.y.beyond(bound.y), z: self.z.beyond(bound.z) }
    }
}

#[cfg(test)]
mod tests {
    //! The time of a contact, which needs every operation but the choice of lanes, for several pairs
    //! side by side and for each alone, in all vectors that this processor has.

    use fearless_simd::{Level, dispatch};

    use super::*;
    use crate::contact_time::Approach;

    fn levels() -> Vec<Level> {
        let mut levels = vec![Level::baseline(), Level::new()];
        #[cfg(target_arch = "x86_64")]
        {
            levels.extend(Level::new().as_sse4_2().map(Level::Sse4_2));
            levels.extend(Level::new().as_avx2().map(Level::Avx2));
        }
        levels
    }

    /// What an approach gives: closing, discriminant and time.
    #[inline(always)]
    fn approach<N: Real>(offset: Vector<N>, velocity: Vector<N>, radius_sum: N) -> [N; 3] {
        let approach = Approach::of(offset, velocity, radius_sum);
        let distance = offset.length_squared().sqrt();
        let time = approach.time(distance - radius_sum, distance + radius_sum);
        [approach.closing, approach.discriminant, time]
    }

    #[inline(always)]
    fn side_by_side<S: Simd>(simd: S, pairs: &[(DVec3, DVec3, f64); LANES]) -> [[f64; LANES]; 3] {
        let offset = Vector::each(simd, pairs.map(|pair| pair.0));
        let velocity = Vector::each(simd, pairs.map(|pair| pair.1));
        let radius_sum = Lanes::each(simd, pairs.map(|pair| pair.2));
        approach(offset, velocity, radius_sum).map(Lanes::to_array)
    }

    #[test]
    fn several_approaches_side_by_side_have_the_bits_of_each_alone() {
        let mut seed = 3u64;
        let mut random = || {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        let mut vector = |size: f64| size * DVec3::new(random(), random(), random());
        for round in 0..1000 {
            let scale = f64::from(1 << (round % 20));
            let pairs: [_; LANES] =
                std::array::from_fn(|_| (vector(3.0), vector(scale), vector(1.0).length_squared()));
            let alone = pairs.map(|(r, v, sum)| approach(r.into(), v.into(), sum));
            for level in levels() {
                let found = dispatch!(level, simd => side_by_side(simd, &pairs));
                for (lane, alone) in alone.iter().enumerate() {
                    // Where they miss each other the time is no number, in any vector.
                    let found = found.map(|values| values[lane]);
                    let are_same = |(a, b): (f64, f64)| {
                        a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
                    };
                    assert!(found.into_iter().zip(*alone).all(are_same), "{level:?} {found:?}");
                }
            }
        }
    }

    #[test]
    fn a_square_is_transposed() {
        #[inline(always)]
        fn transposed<S: Simd>(simd: S) -> [[f64; LANES]; LANES] {
            let row = |row: u8| Lanes::each(simd, [0, 1, 2, 3].map(|it| f64::from(10 * row + it)));
            Lanes::transposed([0, 1, 2, 3].map(row)).map(Lanes::to_array)
        }
        for level in levels() {
            let columns = dispatch!(level, simd => transposed(simd));
            let expected =
                [0, 1, 2, 3].map(|it: u8| [0, 10, 20, 30].map(|row| f64::from(row + it)));
            assert_eq!(columns, expected, "{level:?}");
        }
    }

    #[test]
    fn pairs_come_apart_in_order() {
        let pairs = [[0.0, 1.0], [2.0, 3.0], [4.0, 5.0], [6.0, 7.0]];
        for level in levels() {
            let apart = dispatch!(level, simd => Lanes::pairs(simd, pairs).map(Lanes::to_array));
            assert_eq!(apart, [[0.0, 2.0, 4.0, 6.0], [1.0, 3.0, 5.0, 7.0]], "{level:?}");
        }
    }
}
