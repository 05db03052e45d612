//! The ground that balls roll on, with its edges.

use carom::{DQuat, DVec3};
use carom_scene::scene::{Collider, Shape};

use crate::maze::{Maze, Role};

/// The ground of a maze.
#[derive(Debug, Clone)]
pub(super) struct Ground(Vec<Patch>);

/// A rectangle of ground, or a plane without end.
#[derive(Debug, Clone, Copy)]
struct Patch {
    center: DVec3,
    axis_x: DVec3,
    axis_z: DVec3,
    /// Half the lengths along the axes \[m\].
    half_x: f64,
    half_z: f64,
}

impl Ground {
    pub fn new(maze: &Maze) -> Self {
        Self(maze.with_role(|role| role == Role::Ground).filter_map(Patch::of).collect())
    }

    /// Returns whether there is ground straight below or above a position. A ball whose centre has
    /// passed the edge falls under any action.
    pub fn reaches(&self, place: DVec3) -> bool {
        self.0.iter().any(|patch| patch.reaches(place))
    }
}

impl Patch {
    fn of(collider: &Collider) -> Option<Self> {
        let (half_x, half_z) = match collider.shape {
            Shape::Rectangle { size_x, size_z } => (0.5 * size_x, 0.5 * size_z),
            Shape::HalfSpace => (f64::INFINITY, f64::INFINITY),
            _ => return None,
        };
        let rotation = DQuat::from_array(collider.rotation).normalize();
        let (axis_x, axis_z) = (rotation * DVec3::X, rotation * DVec3::Z);
        let center = DVec3::from_array(collider.position);
        Some(Self { center, axis_x, axis_z, half_x, half_z })
    }

    fn reaches(&self, place: DVec3) -> bool {
        let offset = place - self.center;
        offset.dot(self.axis_x).abs() <= self.half_x && offset.dot(self.axis_z).abs() <= self.half_z
    }
}
