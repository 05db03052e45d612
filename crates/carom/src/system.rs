//! What a step reads and never changes.

use std::sync::Arc;

use crate::bodies::Properties;
use crate::colliders::Colliders;
use crate::detect::surface_tree::SurfaceTree;
use crate::forces::Force;
use crate::friction::Friction;
use crate::numbered::Numbered;
use crate::settings::Settings;
use crate::surface::Surface;

/// The world during one step, but for the motion of its spheres.
#[derive(Clone, Copy)]
pub(crate) struct System<'a> {
    pub settings: &'a Settings,
    pub forces: &'a Numbered<Arc<dyn Force>>,
    pub surfaces: &'a [Surface],
    pub tree: &'a SurfaceTree,
    /// Of the surfaces that report contact and deflect nothing.
    pub trigger_tree: &'a SurfaceTree,
    pub spheres: &'a Properties,
}

impl<'a> System<'a> {
    pub fn new(
        settings: &'a Settings,
        forces: &'a Numbered<Arc<dyn Force>>,
        colliders: &'a Colliders,
        spheres: &'a Properties,
    ) -> Self {
        let (surfaces, tree) = (colliders.surfaces(), colliders.tree());
        let trigger_tree = colliders.trigger_tree();
        Self { settings, forces, surfaces, tree, trigger_tree, spheres }
    }

    /// What all bodies say of friction, as far as they say something.
    pub fn frictions(&self) -> impl Iterator<Item = Friction> {
        let of_surfaces = self.surfaces.iter().map(|surface| surface.friction);
        self.spheres.friction.iter().copied().chain(of_surfaces)
    }
}
