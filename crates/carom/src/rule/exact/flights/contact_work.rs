//! The work of persistent contacts: that of friction, and of colliders that move.

/// Which work the persistent contacts of a sphere do.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) enum ContactWork {
    /// None: nothing rubs, and no surface moves.
    #[default]
    None,
    /// Friction changes how the sphere moves, and turns about its moment of inertia \[kg m²\].
    Friction {
        /// \[kg m²\]
        moment: f64,
    },
    /// Colliders that move push it.
    Colliders,
}

/// Work that persistent contacts have done and that is in no report yet.
#[derive(Debug, Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct WorkDone {
    /// \[J\]
    pub friction: f64,
    /// \[J\]
    pub colliders: f64,
    /// Until when that of flights that go on is counted, on the world's clock \[s\].
    pub until: f64,
}

impl WorkDone {
    /// None, of flights that begin from now on.
    pub const NONE: Self = Self { friction: 0.0, colliders: 0.0, until: f64::NEG_INFINITY };
}

impl Default for WorkDone {
    fn default() -> Self {
        Self::NONE
    }
}
