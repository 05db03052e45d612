//! Two bodies in contact.

use super::{ContactState, Separation};

/// Two bodies, by index. Pairs of spheres sort before spheres at surfaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) enum Bodies {
    /// Spheres 1 and 2, the smaller index first.
    Pair(u32, u32),
    /// A surface, which is body 1, and a sphere, which is body 2.
    Surface { sphere: u32, surface: u32 },
}

impl Bodies {
    /// Two spheres, in whatever order.
    pub fn pair([i, j]: [u32; 2]) -> Self {
        Self::Pair(i.min(j), i.max(j))
    }

    /// The one or two spheres among them.
    pub fn spheres(self) -> impl Iterator<Item = u32> {
        let (first, second) = match self {
            Self::Pair(i, j) => (i, Some(j)),
            Self::Surface { sphere, .. } => (sphere, None),
        };
        std::iter::once(first).chain(second)
    }
}

/// Two bodies and their contact state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Contact {
    pub bodies: Bodies,
    pub separation: Separation,
    pub state: ContactState,
}

impl Contact {
    /// The one or two spheres of the contact.
    pub fn spheres(&self) -> impl Iterator<Item = u32> + use<> {
        self.bodies.spheres()
    }
}
