//! Balls that hit walls too often in a frame, and take it by another rule.

use carom::{DVec3, Discrete, Sphere, SphereId, SphereMotion, World};

use super::Arena;
use super::alone::Alone;
use super::ball::Ball;
use crate::error::EpisodeError;

/// Handles balls whose frame the rule `exact` refuses. They are parked at the start of the maze
/// while the others take the frame. Then each takes it by the rule `discrete`, which always ends.
#[derive(Debug, Clone)]
pub(super) struct Rescue {
    /// World under the rule `discrete`.
    alone: Alone,
    parked: Vec<Parked>,
    frames: u64,
}

#[derive(Debug, Clone, Copy)]
struct Parked {
    id: SphereId,
    ball: Sphere,
    weight: DVec3,
}

impl Rescue {
    pub fn new(arena: &Arena) -> Result<Self, EpisodeError> {
        let alone = Alone::new(arena, Discrete::default())?;
        Ok(Self { alone, parked: Vec::new(), frames: 0 })
    }

    pub fn clear(&mut self) {
        self.parked.clear();
    }

    pub fn has(&self, id: SphereId) -> bool {
        self.parked.iter().any(|parked| parked.id == id)
    }

    pub fn frames(&self) -> u64 {
        self.frames
    }

    /// Parks a ball at the start of the maze for a frame.
    pub fn park(
        &mut self,
        id: SphereId,
        weight: &mut DVec3,
        world: &mut World,
        arena: &Arena,
    ) -> Result<(), EpisodeError> {
        let ball = world.sphere(id)?;
        self.parked.push(Parked { id, ball, weight: *weight });
        *weight = arena.weight() * DVec3::NEG_Y;
        Ok(world.set_motions(&[SphereMotion {
            id,
            position: arena.maze().start(),
            velocity: DVec3::ZERO,
        }])?)
    }

    /// Steps each parked ball by its frame and puts it back.
    pub fn release(
        &mut self,
        world: &mut World,
        balls: &mut [Ball],
        arena: &Arena,
    ) -> Result<(), EpisodeError> {
        for &Parked { id, ball, weight } in &self.parked {
            self.frames += 1;
            let after = self.alone.take_frame(id, ball, weight, balls, arena)?;
            let Sphere { position, velocity, .. } = after;
            world.set_motions(&[SphereMotion { id, position, velocity }])?;
        }
        Ok(())
    }
}
