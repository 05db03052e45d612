//! Drift: the motion that spheres have in common. Balls that fall side by side stay neighbours, however
//! fast they are.

use glam::DVec3;

/// The common motion since the last search for neighbours, at the mean velocity of then.
#[derive(Debug, Clone, Copy, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Drift {
    /// \[m/s\]
    pub velocity: DVec3,
    /// Since the search \[m\].
    pub way: DVec3,
    /// How long the way may become until the next search \[m\]: surfaces are looked for so far.
    pub reach: f64,
}

impl Drift {
    /// From a search on that is to last so long \[s\].
    pub fn begin(velocity: DVec3, lasting: f64) -> Self {
        Self { velocity, way: DVec3::ZERO, reach: velocity.length() * lasting }
    }

    /// After a time of `h` \[s\] more.
    pub fn after(self, h: f64) -> Self {
        Self { way: self.way + h * self.velocity, ..self }
    }

    /// Whether the way is longer than surfaces were looked for.
    pub fn is_beyond(&self) -> bool {
        self.way.length_squared() > self.reach * self.reach
    }
}
