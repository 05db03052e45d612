//! A world in which one ball after the other takes a frame, alone.

use carom::{DVec3, Rule, Snapshot, Sphere, SphereId, World};

use super::Arena;
use super::ball::{self, Ball};
use crate::error::EpisodeError;

/// A maze with one ball. What becomes of a ball in a frame depends on nothing but how it comes to that.
#[derive(Debug, Clone)]
pub(super) struct Alone {
    world: World,
    /// Without what a rule keeps of the frames of other balls.
    unplayed: Snapshot,
}

impl Alone {
    pub fn new(arena: &Arena, rule: impl Into<Rule>) -> Result<Self, EpisodeError> {
        let mut world = arena.world().clone();
        world.set_settings(world.settings().with_rule(rule))?;
        Ok(Self { unplayed: world.snapshot(), world })
    }

    /// Moves the ball of this id, as it is, by a frame under a weight \[N\]; notes what it touches. Gives
    /// how it moves then.
    pub fn take_frame(
        &mut self,
        id: SphereId,
        before: Sphere,
        weight: DVec3,
        balls: &mut [Ball],
        arena: &Arena,
    ) -> Result<Sphere, EpisodeError> {
        self.world.restore(&self.unplayed);
        let alone = self.world.spheres().ids()[0];
        let ball = self.world.sphere(alone)?;
        let moved = ball.with_position(before.position).with_velocity(before.velocity);
        let spin = before.angular_velocity;
        self.world.set_sphere(
            alone,
            moved.with_orientation(before.orientation).with_angular_velocity(spin),
        )?;
        self.world.set_applied_forces(&[weight])?;
        self.world.step(arena.options().frame_time)?;
        ball::note(&self.world, balls, arena, |_| Some(ball::index_of(id)));
        Ok(self.world.sphere(alone)?)
    }
}
