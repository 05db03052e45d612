//! A world in which single balls take their frames one after the other.

use carom::{DVec3, Rule, Snapshot, Sphere, SphereId, World};

use super::Arena;
use super::ball::{self, Ball};
use crate::error::EpisodeError;

/// A maze with one ball. The result of a frame depends only on the state of its ball.
#[derive(Debug, Clone)]
pub(super) struct Alone {
    world: World,
    /// State before the first frame, without data that a rule keeps from frames of other balls.
    unplayed: Snapshot,
}

impl Alone {
    pub fn new(arena: &Arena, rule: impl Into<Rule>) -> Result<Self, EpisodeError> {
        let mut world = arena.world().clone();
        world.set_settings(world.settings().with_rule(rule))?;
        Ok(Self { unplayed: world.snapshot(), world })
    }

    /// Moves the ball with this id by a frame under a weight \[N\] and notes what it touches.
    /// Returns the ball after the frame.
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
