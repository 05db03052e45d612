//! Distances at which spheres of named materials touch, where these are not the sums of their radii.

use educe::Educe;

/// Factors `1 + Δ` of the contact distances `(1 + Δ) (r1 + r2)` of spheres, by their materials; empty where all spheres
/// are additive.
#[derive(Debug, Educe, Default, PartialEq)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct NonAdditivity {
    /// One for each pair: the numbers of the second material within those of the first.
    factors: Vec<f64>,
    /// Largest factor of each material with any other, at least 1.
    reaches: Vec<f64>,
}

impl NonAdditivity {
    /// The factors of pairs of materials, given with their parameters Δ, whose numbers are less than `side`.
    pub fn of(pairs: impl Iterator<Item = ([u8; 2], f64)>, side: usize) -> Self {
        let (mut factors, mut reaches) = (vec![1.0; side * side], vec![1.0_f64; side]);
        let mut is_additive = true;
        for (materials, non_additivity) in pairs {
            is_additive &= non_additivity == 0.0;
            let [first, second] = materials.map(usize::from);
            let factor = 1.0 + non_additivity;
            for [one, other] in [[first, second], [second, first]] {
                factors[one * side + other] = factor;
                reaches[one] = reaches[one].max(factor);
            }
        }
        if is_additive { Self::default() } else { Self { factors, reaches } }
    }

    /// Whether all spheres touch at the sums of their radii.
    #[inline(always)]
    pub fn is_none(&self) -> bool {
        self.reaches.is_empty()
    }

    /// The factor of the contact distance of two materials; 1 for pairs that are not given.
    #[inline]
    pub fn factor(&self, materials: [u8; 2]) -> f64 {
        let [first, second] = materials.map(usize::from);
        let side = self.reaches.len();
        if first >= side || second >= side {
            return 1.0;
        }
        self.factors[first * side + second]
    }

    /// The largest factor of the contact distances of a material.
    #[inline]
    pub fn reach(&self, material: u8) -> f64 {
        self.reaches.get(usize::from(material)).copied().unwrap_or(1.0)
    }

    /// The largest factor of all.
    pub fn largest(&self) -> f64 {
        self.reaches.iter().copied().fold(1.0, f64::max)
    }
}
