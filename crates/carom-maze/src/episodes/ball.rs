//! The episode of one ball.

use carom::{BodyPair, DVec3, SphereId, World};

use super::Arena;
use super::options::EpisodeOptions;
use crate::maze::Role;
use crate::random::Numbers;
use crate::tilt::Tilt;

/// State or result of an episode.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// The episode continues.
    Rolling,
    /// The ball touched an end wall.
    Won,
    /// The ball fell out of the maze.
    Fell,
    /// The episode reached its largest number of steps.
    TimeUp,
}

/// The episode of a ball, except for its motion.
#[derive(Debug, Clone)]
pub(super) struct Ball {
    pub tilt: Tilt,
    /// The taken collectibles, one bit each.
    pub taken: u64,
    pub outcome: Outcome,
    pub steps: u32,
    pub reward: f64,
    /// Potential for shaping at the last step; 0 without shaping.
    potential: f64,
    numbers: Numbers,
}

/// How fast and how far a tilt follows actions in one frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct Steering {
    /// \[rad\]
    steepest: f64,
    /// Largest turn about each axis in a frame \[rad\].
    most: f64,
}

impl Steering {
    pub fn new(options: &EpisodeOptions) -> Self {
        let speed = options.tilt_speed_degrees_per_second.to_radians();
        let steepest = options.max_tilt_degrees.to_radians();
        Self { steepest, most: speed * options.frame_time }
    }

    pub fn steered(self, tilt: Tilt, action: [f64; 2]) -> Tilt {
        let [to_x, to_z] = action.map(|part| self.steepest * part.clamp(-1.0, 1.0));
        tilt.towards(Tilt::down(to_x, to_z), self.most, self.steepest)
    }
}

impl Ball {
    pub fn new(seed: u64) -> Self {
        Self {
            tilt: Tilt::LEVEL,
            taken: 0,
            outcome: Outcome::Rolling,
            steps: 0,
            reward: 0.0,
            potential: 0.0,
            numbers: Numbers::new(seed),
        }
    }

    pub fn seed(&mut self, seed: u64) {
        self.numbers = Numbers::new(seed);
    }

    pub fn choose(&mut self, places: &[DVec3]) -> DVec3 {
        places[self.numbers.below(places.len())]
    }

    /// Starts an episode at a position.
    pub fn begin(&mut self, place: DVec3, arena: &Arena) {
        (self.tilt, self.taken) = (Tilt::LEVEL, 0);
        (self.outcome, self.steps, self.reward) = (Outcome::Rolling, 0, 0.0);
        self.potential = arena.potential(place, 0).unwrap_or(0.0);
    }

    pub fn begin_step(&mut self, arena: &Arena) {
        let is_rolling = self.outcome == Outcome::Rolling;
        self.reward = if is_rolling { arena.options().rewards.step } else { 0.0 };
    }

    /// Ends a step at a position: adds the shaping reward and checks the limit of steps.
    pub fn end_step(&mut self, place: DVec3, arena: &Arena) {
        let EpisodeOptions { max_steps, rewards, .. } = arena.options();
        self.steps = self.steps.saturating_add(1);
        if rewards.shaping > 0.0 {
            let after = match self.outcome {
                Outcome::Won | Outcome::Fell => 0.0,
                // Where the potential is unknown, it stays unchanged.
                _ => arena.potential(place, self.taken).unwrap_or(self.potential),
            };
            if self.outcome != Outcome::TimeUp {
                self.reward += rewards.discount * after - self.potential;
            }
            self.potential = after;
        }
        if self.outcome == Outcome::Rolling && max_steps.is_some_and(|most| self.steps >= most) {
            self.outcome = Outcome::TimeUp;
        }
    }

    fn is_rolling(&self) -> bool {
        self.outcome == Outcome::Rolling
    }

    fn take(&mut self, index: usize, arena: &Arena) {
        let bit = 1 << index;
        if self.is_rolling() && self.taken & bit == 0 {
            self.taken |= bit;
            self.reward += arena.options().rewards.collectible;
        }
    }

    fn win(&mut self, arena: &Arena) {
        if self.is_rolling() {
            self.outcome = Outcome::Won;
            self.reward += arena.options().rewards.end_wall;
        }
    }

    pub fn fall(&mut self, arena: &Arena) {
        if self.is_rolling() {
            self.outcome = Outcome::Fell;
            self.reward += arena.options().rewards.fall;
        }
    }
}

/// Returns the index of the ball of a sphere. Spheres are never removed, so their numbers are the
/// indices.
pub(super) fn index_of(id: SphereId) -> usize {
    id.number() as usize
}

/// Records what balls touched in a frame. Collectibles come first, so that they count in a frame
/// that wins. `index_of` returns the index of a sphere's ball, or `None` for a sphere that does not
/// count.
pub(super) fn note(
    world: &World,
    balls: &mut [Ball],
    arena: &Arena,
    index_of: impl Fn(SphereId) -> Option<usize>,
) {
    let report = world.report();
    for contact in &report.triggers {
        let Role::Collectible(collectible) = arena.role(contact.collider) else { continue };
        if let Some(index) = index_of(contact.sphere) {
            balls[index].take(collectible, arena);
        }
    }
    // A ball that rolls up to a wall slowly is in contact without an impact.
    let contacts = if arena.options().friction > 0.0 { world.contacts() } else { Vec::new() };
    let in_contact = contacts.iter().map(|contact| contact.between);
    for between in report.impacts.iter().map(|impact| impact.between).chain(in_contact) {
        let BodyPair::Collider { collider, sphere } = between else { continue };
        if arena.role(collider) != Role::EndWall {
            continue;
        }
        if let Some(index) = index_of(sphere) {
            balls[index].win(arena);
        }
    }
}
