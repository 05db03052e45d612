//! Drift: the common motion of all spheres. Balls that fall side by side stay neighbours, however fast they are.

use glam::DVec3;

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
}

impl Drift {
    /// The drift after a search that is to last this long \[s\].
    pub fn begin(velocity: DVec3, lasting: f64) -> Self {
        Self { velocity, way: DVec3::ZERO, reach: velocity.length() * lasting }
    }

    /// After a time of `h` \[s\] more.
    pub fn after(self, h: f64) -> Self {
        Self { way: self.way + h * self.velocity, ..self }
    }

    /// Whether the common path exceeds the reach of the search.
    pub fn is_beyond(&self) -> bool {
        self.way.length_squared() > self.reach * self.reach
    }
}
