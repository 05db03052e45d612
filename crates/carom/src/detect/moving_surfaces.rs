//! Surfaces of colliders that move, found by place at any time.

use std::collections::BTreeMap;

use glam::{DQuat, DVec3};

use super::surface_tree::SurfaceTree;
use super::swept_region::{SweptPlane, SweptRegion};
use crate::bounds::Bounds;
use crate::collider::Collider;
use crate::collider_motion::MotionBounds;
use crate::id::ColliderId;
use crate::moving_bounds::MovingBounds;
use crate::norm::Norm;
use crate::numbered::Numbered;
use crate::pose::Pose;
use crate::rotation;
use crate::surface::{Form, LastCarriage, Role, Surface, SurfaceMotion};

/// Distances are compared with this part of the coordinates to spare: far more than their rounding.
const SLACK: f64 = 1e-9;

/// Trees over the surfaces of one role of colliders that move. A tree stays valid while its collider moves,
/// since its surfaces move as one: a place is looked up in the coordinates of the collider when the tree was made.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct MovingSurfaces {
    /// Trees of the surfaces, in the order of the colliders.
    trees: Vec<MovingTree>,
}

/// The surfaces of one collider that moves.
#[derive(Debug, Clone, PartialEq)]
struct MovingTree {
    collider: ColliderId,
    /// Number of one of its surfaces.
    surface: u32,
    /// Pose of the collider when the tree was made.
    pose: Pose,
    tree: SurfaceTree,
}

/// The surfaces of a collider that moves, at some time.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlacedTree<'a> {
    tree: &'a SurfaceTree,
    /// One of the surfaces, as it is when the step begins; all of them move like it.
    surface: &'a Surface,
    /// Rotation from the present directions to those of the tree.
    back: DQuat,
    /// Origin of the collider now \[m\].
    pub origin: DVec3,
    /// Origin of the collider when the tree was made \[m\].
    start: DVec3,
}

impl MovingSurfaces {
    /// Makes a tree for each collider that moves, over its surfaces of a role.
    pub fn of(colliders: &Numbered<Collider>, surfaces: &[Surface], role: Role) -> Self {
        let moves = |it: &Surface| it.role == role && !it.motion.is_at_rest();
        let mut numbers: BTreeMap<ColliderId, Vec<u32>> = BTreeMap::new();
        for (number, surface) in (0..).zip(surfaces).filter(|(_, it)| moves(it)) {
            numbers.entry(surface.collider).or_default().push(number);
        }
        let tree = |(collider, numbers): (ColliderId, Vec<u32>)| {
            Some(MovingTree {
                collider,
                surface: *numbers.first()?,
                pose: colliders.get(collider.0)?.pose,
                tree: SurfaceTree::of(surfaces, numbers),
            })
        };
        Self { trees: numbers.into_iter().filter_map(tree).collect() }
    }

    /// The same surfaces, each of which counts as near every place.
    #[cfg(test)]
    pub fn everywhere(&self) -> Self {
        let all = |it: &MovingTree| {
            let mut numbers = Vec::new();
            it.tree.add_near(&Bounds::around(DVec3::ZERO, DVec3::INFINITY), &mut numbers);
            MovingTree { tree: SurfaceTree::everywhere(numbers), ..it.clone() }
        };
        Self { trees: self.trees.iter().map(all).collect() }
    }

    /// The trees where they are `h` \[s\] after the present poses of the colliders and places of the surfaces.
    pub fn placed<'a>(
        &'a self,
        (colliders, surfaces): (&Numbered<Collider>, &'a [Surface]),
        h: f64,
        last: &LastCarriage,
    ) -> impl Iterator<Item = PlacedTree<'a>> {
        self.trees.iter().filter_map(move |it| {
            let now = colliders.get(it.collider.0)?.pose.rotation.normalize();
            let surface = &surfaces[it.surface as usize];
            let (origin, turn) = last.turn_after(surface, h);
            let rotation = turn * now * it.pose.rotation.normalize().conjugate();
            let (tree, back, start) = (&it.tree, rotation.conjugate(), it.pose.position);
            Some(PlacedTree { tree, surface, back, origin, start })
        })
    }
}

impl PlacedTree<'_> {
    /// Appends the numbers of the surfaces that may have a point within a distance `reach` \[m\] of a place \[m\].
    pub fn add_near(&self, place: DVec3, reach: f64, near: &mut Vec<u32>) {
        let offset = place - self.origin;
        let coordinates = [place, self.origin, self.start, offset].map(|it| it.abs().element_sum());
        let slack = SLACK * (coordinates.iter().sum::<f64>() + reach);
        let there = self.start + self.back * offset;
        self.tree.add_near(&Bounds::around(there, DVec3::splat(reach + slack)), near);
    }

    /// Bounds of the speed of the origin \[m/s\] and of the angular velocity \[rad/s\], from a time after the places of
    /// the surfaces on, for a length of time \[s\].
    pub fn fastest(&self, times: [f64; 2]) -> [f64; 2] {
        let MotionBounds { speed, spin, .. } = self.bounds(times);
        [speed, spin]
    }

    /// Bounds of the way of the origin \[m\] and of the angular velocity \[rad/s\], for times as in [`Self::fastest`].
    pub fn farthest(&self, times: [f64; 2]) -> [f64; 2] {
        let MotionBounds { way, spin, .. } = self.bounds(times);
        [way, spin]
    }

    /// Bound of the way \[m\] of the surfaces within `reach` \[m\] of a place \[m\], for times as in [`Self::fastest`].
    pub fn way_beside(&self, place: DVec3, reach: f64, times: [f64; 2]) -> f64 {
        let [way, spin] = self.farthest(times);
        way + spin * times[1] * ((place - self.origin).norm() + reach + way)
    }

    /// How the collider moves from now on for a `length` of time \[s\].
    pub fn moving(&self, length: f64) -> MovingBounds {
        let velocity = self.surface.motion.velocity;
        MovingBounds::within(length, velocity, &self.bounds([0.0, length]))
    }

    /// Where the surfaces may be from now on for a `length` of time \[s\].
    pub fn swept(&self, length: f64) -> SweptRegion {
        let MotionBounds { way, spin, .. } = self.bounds([0.0, length]);
        let angle = spin * length;
        if self.tree.has_unbounded() {
            return self.swept_by_plane(way, angle);
        }
        let Some(bounds) = self.tree.bounds() else { return SweptRegion::Everywhere };
        let turn = self.back.conjugate();
        let center = self.origin + turn * (bounds.center() - self.start);
        let [x, y, z] = rotation::axes(turn).map(DVec3::abs);
        let half = bounds.half();
        let half = half.x * x + half.y * y + half.z * z;
        let arm = (center - self.origin).norm() + half.norm();
        let coordinates = [center, self.origin, self.start, half].map(|it| it.abs().element_sum());
        // A chord is no longer than its arc, nor than the diameter.
        let way = way + angle.min(2.0) * arm;
        let slack = SLACK * (coordinates.iter().sum::<f64>() + way);
        SweptRegion::Within(Bounds::around(center, half + (way + slack)))
    }

    /// Where the only surface may be if it is a half-space, whose origin moves by at most `way` \[m\] and which turns by
    /// at most an angle \[rad\].
    fn swept_by_plane(&self, way: f64, angle: f64) -> SweptRegion {
        match self.surface.form {
            Form::HalfSpace { point, normal } => {
                let way = way + SLACK * (point.abs().element_sum() + way);
                SweptRegion::Behind(SweptPlane { point, normal, way, angle })
            }
            _ => SweptRegion::Everywhere,
        }
    }

    fn bounds(&self, [from, length]: [f64; 2]) -> MotionBounds {
        let SurfaceMotion { velocity, angular_velocity, .. } = self.surface.motion;
        match &self.surface.course {
            Some(course) => course.bounds(from, length),
            None => {
                let (speed, spin) = (velocity.norm(), angular_velocity.norm());
                MotionBounds { way: speed * length, speed, spin, ..MotionBounds::default() }
            }
        }
    }
}
