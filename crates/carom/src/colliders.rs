//! All colliders of a world, with the surfaces and trees made of them.

use std::collections::BTreeSet;
use std::mem::{self, Discriminant};
use std::sync::{Arc, OnceLock};

use crate::collider::{Collider, Shape};
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
    /// Seams before the last changes from outside, and the numbers of the colliders that these changed.
    earlier: Option<(Arc<Seams>, BTreeSet<u64>)>,
    /// Surfaces that move and deflect, and those that move and report; found when first read after a change from
    /// outside, as seams.
    moving: OnceLock<Arc<MovingSurfaces>>,
    moving_triggers: OnceLock<Arc<MovingSurfaces>>,
    /// Made when first read after a change, as the trees.
    surfaces: OnceLock<Arc<Vec<Surface>>>,
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
        self.shared_surfaces()
    }

    /// [`Self::surfaces`], which others may keep.
    pub fn shared_surfaces(&self) -> &Arc<Vec<Surface>> {
        self.surfaces.get_or_init(|| {
            // Growing by doubling would copy those of large meshes twice.
            let counts = self.list.iter().map(|(_, it)| match &it.shape {
                Shape::Mesh(mesh) => mesh.features().count() + 1,
                _ => 1,
            });
            let mut plain = Vec::with_capacity(counts.sum());
            for (number, collider) in self.list.iter() {
                surface::place(ColliderId(number), collider, self.time, &mut plain);
            }
            let seams = self.seams.get_or_init(|| match &self.earlier {
                Some((seams, changed)) if seams.remain(&self.list, &plain, changed) => {
                    Arc::clone(seams)
                }
                _ => Arc::new(Seams::of(&self.list, &plain)),
            });
            Arc::new(seams.applied(&self.list, plain))
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

    /// The surfaces that move and deflect, by their index in [`Self::surfaces`].
    pub fn moving(&self) -> &MovingSurfaces {
        self.moving.get_or_init(|| self.moving_of(Role::Deflects))
    }

    /// The surfaces that move and report, by their index in [`Self::surfaces`].
    pub fn moving_triggers(&self) -> &MovingSurfaces {
        self.moving_triggers.get_or_init(|| self.moving_of(Role::Reports))
    }

    fn moving_of(&self, role: Role) -> Arc<MovingSurfaces> {
        Arc::new(MovingSurfaces::of(&self.list, self.surfaces(), role))
    }

    /// Has each surface that moves count as near every place, until colliders change from outside.
    #[cfg(test)]
    pub fn find_moving_everywhere(&mut self) {
        self.moving = Arc::new(self.moving().everywhere()).into();
    }

    pub fn push(&mut self, mut collider: Collider) {
        collider.follow_motion(self.time);
        let number = self.list.next_number();
        self.list.push(collider);
        self.check_seams([number]);
    }

    /// Replaces some of the colliders.
    pub fn set(&mut self, changes: &[(ColliderId, Collider)]) {
        for (id, collider) in changes {
            if let Some(place) = self.list.get_mut(id.0) {
                place.clone_from(collider);
                place.follow_motion(self.time);
            }
        }
        self.check_seams(changes.iter().map(|(id, _)| id.0));
    }

    pub fn remove(&mut self, id: ColliderId) -> Option<Collider> {
        let removed = self.list.remove(id.0);
        self.check_seams([id.0]);
        removed
    }

    /// Returns whether any collider moves.
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

    /// Marks the seams for a check at their next read, after changes of the colliders with these numbers.
    fn check_seams(&mut self, changed: impl IntoIterator<Item = u64>) {
        if let Some(seams) = self.seams.take() {
            self.earlier = Some((seams, BTreeSet::new()));
        }
        if let Some((_, numbers)) = &mut self.earlier {
            numbers.extend(changed);
        }
        self.moving.take();
        self.moving_triggers.take();
        self.forget_surfaces();
    }

    fn forget_seams(&mut self) {
        self.seams.take();
        self.earlier = None;
        self.moving.take();
        self.moving_triggers.take();
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

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::collider_motion::{Motion, MotionPart};
    use crate::pose::Pose;

    /// Whole numbers of a linear congruential generator (Knuth, MMIX).
    fn below(state: &mut u64, count: u64) -> u64 {
        *state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*state >> 33) % count
    }

    /// A tile, a ball or a half-space in one of nine places; some of them move.
    fn random_collider(state: &mut u64) -> Collider {
        let place = [0, 1].map(|_| below(state, 3) as f64);
        let pose = Pose::at(DVec3::new(place[0], -0.5, place[1]));
        let unit = DVec3::ONE;
        let collider = match below(state, 8) {
            0 => Collider::new(Shape::Sphere { radius: 0.5 }, pose),
            1 => Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)),
            2 => Collider::new(Shape::Rectangle { size_x: 1.0, size_z: 1.0 }, pose),
            _ => Collider::new(Shape::Box { size: unit }, pose),
        };
        match below(state, 6) {
            0 => collider.moving(0.25 * unit, DVec3::ZERO),
            1 => {
                let velocity = 0.5 * unit;
                collider.with_motion(Motion::new([MotionPart::Steady { velocity }]))
            }
            _ => collider,
        }
    }

    #[test]
    fn changed_colliders_have_the_surfaces_of_new_ones() {
        let mut state = 1;
        let mut colliders = Colliders::default();
        for step in 0..400_u32 {
            let numbers: Vec<u64> = colliders.list().iter().map(|(number, _)| number).collect();
            let chosen = ColliderId(below(&mut state, numbers.len().max(1) as u64));
            let chosen = numbers.get(chosen.0 as usize).map(|&it| ColliderId(it));
            match (below(&mut state, 4), chosen) {
                (0, Some(id)) if numbers.len() > 6 => drop(colliders.remove(id)),
                (1 | 2, Some(id)) => colliders.set(&[(id, random_collider(&mut state))]),
                _ => colliders.push(random_collider(&mut state)),
            }
            let Colliders { list, time, .. } = colliders.clone();
            let made = Colliders { list, time, ..Colliders::default() };
            assert_eq!(colliders.surfaces(), made.surfaces(), "step {step}");
            colliders.advance(0.5, 0.5 * f64::from(step + 1));
        }
    }
}
