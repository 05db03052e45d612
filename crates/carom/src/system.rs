//! What a step reads and never changes.

use std::sync::Arc;

use crate::bodies::Properties;
use crate::forces::Force;
use crate::settings::Settings;
use crate::state::Colliders;
use crate::surface::{Surface, SurfaceTree};

/// The world during one step, but for the motion of its spheres.
#[derive(Clone, Copy)]
pub(crate) struct System<'a> {
    pub settings: &'a Settings,
    pub forces: &'a [Arc<dyn Force>],
    pub surfaces: &'a [Surface],
    pub tree: &'a SurfaceTree,
    pub spheres: &'a Properties,
}

impl<'a> System<'a> {
    pub fn new(
        (settings, forces): (&'a Settings, &'a [Arc<dyn Force>]),
        colliders: &'a Colliders,
        spheres: &'a Properties,
    ) -> Self {
        let (surfaces, tree) = (colliders.surfaces(), colliders.tree());
        Self { settings, forces, surfaces, tree, spheres }
    }
}

/// A stretch of time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Interval {
    /// Its beginning, on the world's clock \[s\].
    pub time: f64,
    /// Its length \[s\].
    pub h: f64,
}

impl Interval {
    /// What is left after a part \[s\] of it.
    pub fn after(self, elapsed: f64) -> Self {
        Self { time: self.time + elapsed, h: self.h - elapsed }
    }
}
