//! The game: keys move the levers, the ball rolls, and what it hits counts.

use carom::{BodyPair, ColliderId, Snapshot, Sphere, SphereId, World};
use carom_scene::scene::{Color, Scene};

use crate::error::GameError;
use crate::keys::Keys;
use crate::lever::Lever;
use crate::role::Role;
use crate::table::Table;

/// Points for a kick of a bumper.
const BUMPER: u64 = 100;
/// Points for a kick of a slingshot.
const SLINGSHOT: u64 = 10;
/// Points for a target that lights up.
const TARGET: u64 = 500;
/// Points for the last of all targets, which then go out.
const ALL_TARGETS: u64 = 5_000;
/// Colour of a target that is lit.
const LIT: Color = [1.0, 0.78, 0.16];

/// State of a game.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GameState {
    /// A ball is in play.
    Playing,
    /// The last ball is lost; the game stops until it is played again.
    Over,
}

/// An event in a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GameEvent {
    /// A bumper or a slingshot kicked the ball.
    Kicked {
        /// Index of its collider in the scene.
        collider: usize,
        /// Points for it.
        points: u64,
    },
    /// The ball lit a target.
    Lit {
        /// Index of the target.
        target: usize,
        /// Points for it.
        points: u64,
    },
    /// All targets were lit; they go out.
    AllLit {
        /// Points for it.
        points: u64,
    },
    /// The ball went down the drain.
    Lost {
        /// Number of balls left, with the one that comes next.
        left: usize,
    },
    /// The last ball went down the drain.
    Over {
        /// Points of the game.
        score: u64,
        /// Whether they are more than ever before.
        is_best: bool,
    },
}

/// A game on a table.
///
/// Each ball begins at rest at its place on the plunger. When the drain takes it, the next one follows, until none is
/// left. Kicks of bumpers and slingshots and targets that light up give points.
///
/// The rule and the frame time are those of the scene.
#[derive(Debug, Clone)]
pub struct Game {
    table: Table,
    world: World,
    /// The world at the start of a game.
    start: Snapshot,
    /// The ball at its start.
    ball: Sphere,
    levers: Vec<Lever>,
    /// The scene of the table, with the colours of targets that are lit.
    scene: Scene,
    /// Whether each target is lit.
    lit: Vec<bool>,
    state: GameState,
    /// Balls left, with the one in play.
    balls: usize,
    score: u64,
    best: Option<u64>,
    frames: u64,
    events: Vec<GameEvent>,
}

impl Game {
    /// Makes a game that has not begun.
    ///
    /// # Errors
    /// Only errors that [`Table::from_scene`] has found already.
    pub fn new(table: Table) -> Result<Self, GameError> {
        let world = table.at_start().world()?;
        Ok(Self {
            start: world.snapshot(),
            ball: world.spheres().get(0),
            levers: table.levers(&world),
            world,
            scene: table.scene().clone(),
            lit: vec![false; table.targets()],
            state: GameState::Playing,
            balls: table.balls(),
            score: 0,
            best: None,
            frames: 0,
            events: Vec::new(),
            table,
        })
    }

    /// Plays one frame. A game that is over does not change.
    ///
    /// # Errors
    /// [`GameError::Physics`] if the rule refuses the frame. The game is then unchanged.
    pub fn step(&mut self, keys: Keys) -> Result<&[GameEvent], GameError> {
        self.events.clear();
        if self.state == GameState::Over {
            return Ok(&[]);
        }
        let before = (self.world.snapshot(), self.levers.clone());
        if let Err(error) = self.step_world(keys) {
            self.world.restore(&before.0);
            self.levers = before.1;
            return Err(error);
        }
        self.frames += 1;
        self.count_kicks();
        self.light_targets();
        self.replace_ball()?;
        Ok(&self.events)
    }

    /// Moves the levers by a frame, and all else with them.
    fn step_world(&mut self, keys: Keys) -> Result<(), GameError> {
        let (frame_time, time) = (self.frame_time(), self.world.time());
        let press = |lever: &mut Lever| lever.press(keys.press(lever.role), frame_time, time);
        let changes: Vec<_> = self.levers.iter_mut().filter_map(press).collect();
        self.world.set_colliders(&changes)?;
        self.world.step(frame_time)?;
        Ok(())
    }

    /// Counts the kicks of the last frame.
    fn count_kicks(&mut self) {
        for impact in &self.world.report().impacts {
            let BodyPair::Collider { collider, .. } = impact.between else { continue };
            let Some(collider) = self.index_of(collider) else { continue };
            let points = match self.table.roles()[collider] {
                Role::Bumper => BUMPER,
                Role::Slingshot => SLINGSHOT,
                _ => continue,
            };
            if impact.kick > 0.0 {
                self.score += points;
                self.events.push(GameEvent::Kicked { collider, points });
            }
        }
    }

    /// Lights the targets that the ball entered in the last frame; once all are lit, they go out.
    fn light_targets(&mut self) {
        let entered = self.world.report().sensor_events.iter().filter(|event| event.enters);
        let entered: Vec<_> = entered.filter_map(|event| self.index_of(event.collider)).collect();
        for collider in entered {
            let Role::Target(target) = self.table.roles()[collider] else { continue };
            if std::mem::replace(&mut self.lit[target], true) {
                continue;
            }
            self.score += TARGET;
            self.scene.colliders[collider].color = Some(LIT);
            self.events.push(GameEvent::Lit { target, points: TARGET });
            if self.lit.iter().all(|it| *it) {
                self.score += ALL_TARGETS;
                self.extinguish();
                self.events.push(GameEvent::AllLit { points: ALL_TARGETS });
            }
        }
    }

    fn extinguish(&mut self) {
        self.lit.fill(false);
        self.scene.clone_from(self.table.scene());
    }

    /// Puts the next ball to the start if the drain took one.
    fn replace_ball(&mut self) -> Result<(), GameError> {
        if !self.world.spheres().is_empty() {
            return Ok(());
        }
        self.balls -= 1;
        if self.balls > 0 {
            self.world.add_sphere(self.ball)?;
            self.events.push(GameEvent::Lost { left: self.balls });
            return Ok(());
        }
        let is_best = self.best.is_none_or(|best| self.score > best);
        self.best = self.best.max(Some(self.score));
        self.state = GameState::Over;
        self.events.push(GameEvent::Over { score: self.score, is_best });
        Ok(())
    }

    /// Returns the index of a collider in the scene.
    fn index_of(&self, id: ColliderId) -> Option<usize> {
        self.world.colliders().position(|(it, _)| it == id)
    }

    /// Starts again: everything is at its start, with all balls and no points. The best score stays.
    pub fn play_again(&mut self) {
        self.world.restore(&self.start);
        self.levers.iter_mut().for_each(Lever::release);
        self.extinguish();
        self.state = GameState::Playing;
        self.balls = self.table.balls();
        (self.score, self.frames) = (0, 0);
        self.events.clear();
    }

    /// Returns the table.
    pub fn table(&self) -> &Table {
        &self.table
    }

    /// Returns the world, whose only sphere is the ball in play.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// Returns the scene of the table with the targets as they are lit. Its colliders are in the order of those of
    /// [`Self::world`], which has their present poses.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Returns the duration of a frame \[s\].
    pub fn frame_time(&self) -> f64 {
        self.table.scene().simulation.frame_time
    }

    /// Returns whether the game goes on.
    pub fn state(&self) -> GameState {
        self.state
    }

    /// Returns the number of balls left, with the one in play.
    pub fn balls(&self) -> usize {
        self.balls
    }

    /// Returns the id of the ball in play; `None` once the game is over.
    pub fn ball(&self) -> Option<SphereId> {
        self.world.spheres().ids().first().copied()
    }

    /// Returns whether the ball in play is still where it began, so that the plunger can shoot it.
    pub fn waits(&self) -> bool {
        // A ball on the plunger follows it by a stroke at most, along the lane.
        self.world.spheres().positions().first().is_some_and(|place| {
            place.x == self.ball.position.x && place.z >= self.ball.position.z - self.ball.radius
        })
    }

    /// Returns the points of this game.
    pub fn score(&self) -> u64 {
        self.score
    }

    /// Sets the most points of a game that is over, to continue from an earlier session.
    pub fn set_best(&mut self, best: Option<u64>) {
        self.best = best;
    }

    /// Returns the most points of a game that is over.
    pub fn best(&self) -> Option<u64> {
        self.best
    }

    /// Returns whether each target is lit.
    pub fn lit(&self) -> &[bool] {
        &self.lit
    }

    /// Returns the time played \[s\].
    pub fn elapsed(&self) -> f64 {
        self.frames as f64 * self.frame_time()
    }

    /// Returns the events of the last frame.
    pub fn events(&self) -> &[GameEvent] {
        &self.events
    }
}
