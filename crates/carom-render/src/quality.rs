//! How much work is spent on a picture.

/// How much work is spent on a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Quality {
    /// Samples per pixel: 1 or 4.
    pub samples: u32,
    /// Edge of the shadow maps in texels.
    pub shadow_texels: u32,
    /// Whether shadows have soft edges, made from nine samples instead of one.
    pub soft_shadows: bool,
}

impl Quality {
    /// Smooth edges, soft shadows: for pictures and films.
    pub const FINE: Self = Self { samples: 4, shadow_texels: 2048, soft_shadows: true };
    /// Smooth edges, coarser shadows: for watching.
    pub const GOOD: Self = Self { samples: 4, shadow_texels: 1024, soft_shadows: true };
    /// The cheapest, for slow machines and software drivers.
    pub const DRAFT: Self = Self { samples: 1, shadow_texels: 1024, soft_shadows: false };
}

impl Default for Quality {
    fn default() -> Self {
        Self::GOOD
    }
}
