//! All colliders of a world, with the surfaces and trees made of them.

use std::mem::{self, Discriminant};
use std::sync::{Arc, OnceLock};

use crate::collider::Collider;
use crate::detect::moving_surfaces::MovingSurfaces;
use crate::detect::surface_tree::SurfaceTree;
use crate::id::ColliderId;
use crate::numbered::Numbered;
use crate::seams::Seams;
use crate::surface::{self, Form, Role, Surface};

/// Colliders in their order, and the surfaces made of them.
#[derive(Debug, Clone, Default)]
pub(crate) struct Colliders {
    list: Numbered<Collider>,
    /// Time of their present places, on the world's clock \[s\].
    time: f64,
    /// Seams, found when first read after a change from outside.
    seams: OnceLock<Arc<Seams>>,
    /// Those that move; found when first read after a change from outside, as seams.
    moving: OnceLock<Arc<MovingSurfaces>>,
    /// Made when first read after a change, as the trees.
    surfaces: OnceLock<Vec<Surface>>,
    tree: OnceLock<SurfaceTree>,
    /// Tree of the surfaces of triggers.
    trigger_tree: OnceLock<SurfaceTree>,
}

impl Colliders {
    pub fn list(&self) -> &Numbered<Collider> {
        &self.list
    }

    /// The surfaces of all colliders, in their order.
    pub fn surfaces(&self) -> &[Surface] {
        self.surfaces.get_or_init(|| {
            let mut plain = Vec::new();
            for (number, collider) in self.list.iter() {
                surface::place(ColliderId(number), collider, self.time, &mut plain);
            }
            let seams = self.seams.get_or_init(|| Arc::new(Seams::of(&self.list, &plain)));
            seams.applied(&self.list, plain)
        })
    }

    /// Finds surfaces, by their index in [`Self::surfaces`].
    pub fn tree(&self) -> &SurfaceTree {
        let surfaces = self.surfaces();
        self.tree.get_or_init(|| SurfaceTree::of(surfaces, 0..surfaces.len() as u32))
    }

    /// Tree of the surfaces that report and deflect nothing.
    pub fn trigger_tree(&self) -> &SurfaceTree {
        let is_trigger = |it: &(u32, &Surface)| it.1.role == Role::Reports;
        self.trigger_tree.get_or_init(|| {
            let triggers = (0..).zip(self.surfaces()).filter(is_trigger);
            SurfaceTree::of(self.surfaces(), triggers.map(|(number, _)| number))
        })
    }

    /// The surfaces that move, by their index in [`Self::surfaces`].
    pub fn moving(&self) -> &MovingSurfaces {
        self.moving.get_or_init(|| Arc::new(MovingSurfaces::of(&self.list, self.surfaces())))
    }

    /// Has each surface that moves count as near every place, until colliders change from outside.
    #[cfg(test)]
    pub fn find_moving_everywhere(&mut self) {
        self.moving = Arc::new(self.moving().everywhere()).into();
    }

    pub fn push(&mut self, mut collider: Collider) {
        collider.follow_motion(self.time);
        self.list.push(collider);
        self.forget_seams();
    }

    /// Replaces some of the colliders.
    pub fn set(&mut self, changes: &[(ColliderId, Collider)]) {
        for (id, collider) in changes {
            if let Some(place) = self.list.get_mut(id.0) {
                place.clone_from(collider);
                place.follow_motion(self.time);
            }
        }
        self.forget_seams();
    }

    pub fn remove(&mut self, id: ColliderId) -> Option<Collider> {
        let removed = self.list.remove(id.0);
        self.forget_seams();
        removed
    }

    /// Whether any of them moves.
    pub fn any_moving(&self) -> bool {
        self.list.iter().any(|(_, collider)| collider.moves())
    }

    /// Advances moving colliders by `h` \[s\], to `time` \[s\]. Returns whether surfaces have other numbers then, as
    /// seams may depend on the rounding of poses.
    pub fn advance(&mut self, h: f64, time: f64) -> bool {
        let are_seams_of_now = self.seams.get().is_some_and(|it| it.are_of_now);
        let before = are_seams_of_now.then(|| kinds(self.surfaces()));
        for collider in self.list.values_mut() {
            if collider.motion.is_empty() {
                let Collider { velocity, angular_velocity, .. } = *collider;
                collider.pose = collider.pose.moved(velocity, angular_velocity, h);
            }
        }
        self.set_time(time);
        if are_seams_of_now {
            self.forget_seams();
        }
        self.forget_surfaces();
        before.is_some_and(|before| before != kinds(self.surfaces()))
    }

    /// Moves colliders with a motion, and their surfaces, to their places at `time` \[s\].
    pub fn move_to(&mut self, time: f64) {
        if self.time != time && self.list.iter().any(|(_, it)| !it.motion.is_empty()) {
            self.set_time(time);
            self.forget_surfaces();
        }
        self.time = time;
    }

    fn set_time(&mut self, time: f64) {
        self.time = time;
        self.list.values_mut().for_each(|collider| collider.follow_motion(time));
    }

    fn forget_seams(&mut self) {
        self.seams.take();
        self.moving.take();
        self.forget_surfaces();
    }

    fn forget_surfaces(&mut self) {
        self.surfaces.take();
        self.tree.take();
        self.trigger_tree.take();
    }
}

/// Collider and kind of form of each surface.
fn kinds(surfaces: &[Surface]) -> Vec<(ColliderId, Discriminant<Form>)> {
    surfaces.iter().map(|it| (it.collider, mem::discriminant(&it.form))).collect()
}

/// Serialized colliders: surfaces and trees follow from them.
#[cfg(feature = "serde")]
mod written {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    use super::{Colliders, Numbered};

    impl Serialize for Colliders {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            (self.time, &self.list).serialize(serializer)
        }
    }

    impl<'de> Deserialize<'de> for Colliders {
        fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            let (time, list) = <(f64, Numbered<_>)>::deserialize(deserializer)?;
            Ok(Self { time, list, ..Self::default() })
        }
    }
}
