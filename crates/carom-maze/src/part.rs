//! Colliders of a maze that is being played.

use carom::{Collider, ColliderId, DQuat, Pose, World};

use crate::maze::{Maze, Role};

/// A collider of the world, with its pose in the level maze.
#[derive(Debug, Clone)]
pub(crate) struct Part {
    pub id: ColliderId,
    pub role: Role,
    pub level: Collider,
}

impl Part {
    /// Returns the colliders of a maze at its start.
    pub fn all(world: &World, maze: &Maze) -> Vec<Self> {
        let both = world.colliders().zip(maze.roles());
        both.map(|((id, level), &role)| Self { id, role, level: level.clone() }).collect()
    }

    /// Returns the pose of the collider when the maze is turned about the origin.
    pub fn posed(&self, rotation: DQuat) -> Pose {
        Pose {
            position: rotation * self.level.pose.position,
            rotation: rotation * self.level.pose.rotation.normalize(),
        }
    }
}
