//! A tree of all bodies of a world at one instant.

use glam::DVec3;

use crate::bounds::Bounds;
use crate::bounds_tree::{Bounded, BoundsTree};

/// A body by its place in the arrays of the world. Spheres sort before surfaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Item {
    Sphere(u32),
    Surface(u32),
}

/// A body in its bounds.
#[derive(Debug, Clone, Copy)]
pub(super) struct Leaf {
    pub bounds: Bounds,
    pub item: Item,
    /// Offset from the body in the world to its wrapped place \[m\].
    pub shift: DVec3,
    /// Whether a periodic box repeats it.
    pub has_images: bool,
}

impl Bounded for Leaf {
    type Order = Item;

    fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    fn order(&self) -> Item {
        self.item
    }
}

/// Bodies by their places.
pub(super) type BodyTree = BoundsTree<Leaf>;
