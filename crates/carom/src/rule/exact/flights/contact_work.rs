//! The work of persistent contacts: that of friction, and of colliders that move.

/// Kinds of work that the persistent contacts of a sphere do.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) enum ContactWork {
    /// No work: no friction, and no moving surface.
    #[default]
    None,
    /// Friction changes the sphere's motion, and its rotation with this moment of inertia \[kg m²\].
    Friction {
        /// \[kg m²\]
        moment: f64,
        /// Power of belts on the sphere \[W\].
        collider_power: f64,
    },
    /// Moving colliders push the sphere.
    Colliders,
}

/// Work of persistent contacts that is in no report yet.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct WorkDone {
    /// \[J\]
    pub friction: f64,
    /// \[J\]
    pub colliders: f64,
    /// Time until which the work along present flights is counted, on the world's clock \[s\].
    pub until: f64,
}

impl WorkDone {
    /// No work, for flights that begin from now on.
    pub const NONE: Self = Self { friction: 0.0, colliders: 0.0, until: f64::NEG_INFINITY };
}

impl Default for WorkDone {
    fn default() -> Self {
        Self::NONE
    }
}
