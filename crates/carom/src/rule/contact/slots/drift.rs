//! Drift: the common motion of all spheres. Balls that fall side by side stay neighbours, however fast they are.

use fearless_simd::Simd;
use glam::DVec3;

use crate::lanes::Lanes;

/// The common motion since the last search for neighbours, with the mean velocity at that time.
#[derive(Debug, Clone, Copy, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Drift {
    /// Velocity \[m/s\].
    pub velocity: DVec3,
    /// Since the search \[m\].
    pub way: DVec3,
    /// Longest common path until the next search \[m\]; surfaces were searched up to it.
    pub reach: f64,
    /// Shear rate of the common motion \[1/s\].
    pub rate: f64,
    /// Shear since the search.
    pub strain: f64,
    /// Largest factor of the contact distances of spheres.
    pub factor: f64,
}

impl Drift {
    /// The drift after a search that is to last this long \[s\].
    pub fn begin(velocity: DVec3, lasting: f64) -> Self {
        Self { velocity, reach: velocity.length() * lasting, ..Self::default() }
    }

    /// The same drift beside a shear flow with this rate \[1/s\], of spheres whose contact distances have this largest
    /// factor.
    pub fn with_shear(self, rate: f64, factor: f64) -> Self {
        Self { rate, factor, ..self }
    }

    /// After a time of `h` \[s\] more.
    pub fn after(self, h: f64) -> Self {
        let (way, strain) = (self.way + h * self.velocity, self.strain + h * self.rate);
        Self { way, strain, ..self }
    }

    /// How far the common motion has taken a sphere from its reference \[m\].
    pub fn way_from(&self, reference: DVec3) -> DVec3 {
        self.way + DVec3::new(self.strain * reference.y, 0.0, 0.0)
    }

    /// How far a sphere of this radius \[m\] may be from where the common motion has taken it, if it was searched with
    /// this margin \[m\]; negative where shear has used the margin up.
    ///
    /// Spheres that touch have references as far apart as their radii and ways beside the flow, times 1 + strain at
    /// most.
    pub fn margin_after(&self, radius: f64, margin: f64) -> f64 {
        if self.strain == 0.0 {
            return margin;
        }
        let radius = self.factor * radius;
        (radius + margin) / (1.0 + self.strain.abs()) - radius
    }

    /// The squares of [`Self::margin_after`] \[m²\]; negative where that is negative.
    #[inline(always)]
    pub fn reach_after<S: Simd>(&self, simd: S, radius: Lanes<S>, margin: Lanes<S>) -> Lanes<S> {
        let whole = Lanes::all(simd, 1.0 + self.strain.abs());
        let radius = radius * Lanes::all(simd, self.factor);
        let left = (radius + margin) / whole - radius;
        left * left.abs()
    }

    /// Whether the common path exceeds the reach of the search.
    pub fn is_beyond(&self) -> bool {
        self.way.length_squared() > self.reach * self.reach
    }
}
