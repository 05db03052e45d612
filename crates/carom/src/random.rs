//! Random numbers that follow from a seed.

use glam::DVec3;

/// Random numbers, the same on every machine: SplitMix64 (Steele, Lea and Flood, OOPSLA 2014).
pub(crate) struct Random(u64);

impl Random {
    /// Begins the numbers of a seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Begins the numbers that belong to a seed and some keys, in this order.
    pub fn keyed<const N: usize>(seed: u64, keys: [u64; N]) -> Self {
        let random = Self::new(seed);
        keys.into_iter().fold(random, |mut random, key| Self(random.bits() ^ key))
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^ (bits >> 31)
    }

    /// Returns a uniform random number in (0, 1].
    fn number(&mut self) -> f64 {
        ((self.bits() >> 11) + 1) as f64 / (1u64 << 53) as f64
    }

    /// Returns a random number of the exponential distribution with mean 1.
    pub fn exponential(&mut self) -> f64 {
        -libm::log(self.number())
    }

    /// Returns a random number of the standard normal distribution (Box and Muller, Ann. Math. Stat. 29, 610
    /// (1958)).
    fn normal(&mut self) -> f64 {
        let radius = (-2.0 * libm::log(self.number())).sqrt();
        radius * libm::cos(std::f64::consts::TAU * self.number())
    }

    /// Returns three random numbers of the standard normal distribution.
    pub fn normal_vector(&mut self) -> DVec3 {
        DVec3::new(self.normal(), self.normal(), self.normal())
    }

    /// Returns `some` different numbers below `count` in random order (Fisher and Yates).
    pub fn some_of(&mut self, count: usize, some: usize) -> Vec<usize> {
        let mut numbers: Vec<usize> = (0..count).collect();
        for place in 0..some {
            let left = (count - place) as u64;
            numbers.swap(place, place + (self.bits() % left) as usize);
        }
        numbers.truncate(some);
        numbers
    }
}
