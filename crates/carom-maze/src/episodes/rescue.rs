//! Balls that meet walls too often in a frame, and take it by another rule.

use carom::{DVec3, Discrete, SphereId, World};

use super::Arena;
use super::ball::{self, Ball};
use crate::error::EpisodeError;

/// What becomes of balls whose frame the rule `exact` refuses: while the others take it they are
/// parked at the start of the maze, and then each takes it by the rule `discrete`, which always ends.
#[derive(Debug, Clone)]
pub(super) struct Rescue {
    /// One ball, the rule `discrete`.
    world: World,
    parked: Vec<Parked>,
    frames: u64,
}

#[derive(Debug, Clone, Copy)]
struct Parked {
    id: SphereId,
    place: DVec3,
    velocity: DVec3,
    weight: DVec3,
}

impl Rescue {
    pub fn new(arena: &Arena) -> Result<Self, EpisodeError> {
        let mut world = arena.world().clone();
        world.set_settings(world.settings().with_rule(Discrete::default()))?;
        Ok(Self { world, parked: Vec::new(), frames: 0 })
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

    /// Takes a ball out of the way of a frame: it lies at the start of the maze.
    pub fn park(
        &mut self,
        id: SphereId,
        weight: &mut DVec3,
        world: &mut World,
        arena: &Arena,
    ) -> Result<(), EpisodeError> {
        let ball = world.sphere(id)?;
        let (place, velocity) = (ball.position, ball.velocity);
        self.parked.push(Parked { id, place, velocity, weight: *weight });
        *weight = arena.weight() * DVec3::NEG_Y;
        Ok(world.set_motions(&[(id, arena.maze().start(), DVec3::ZERO)])?)
    }

    /// Lets the parked balls take their frame, and puts them back.
    pub fn release(
        &mut self,
        world: &mut World,
        balls: &mut [Ball],
        arena: &Arena,
    ) -> Result<(), EpisodeError> {
        let alone = self.world.spheres().ids()[0];
        for parked in &self.parked {
            self.frames += 1;
            self.world.set_motions(&[(alone, parked.place, parked.velocity)])?;
            self.world.set_applied_forces(&[parked.weight])?;
            self.world.set_time(0.0)?;
            let report = self.world.step(arena.options().frame_time)?;
            ball::note(report, balls, arena, |_| Some(ball::index_of(parked.id)));
            let ball = self.world.sphere(alone)?;
            world.set_motions(&[(parked.id, ball.position, ball.velocity)])?;
        }
        Ok(())
    }
}
