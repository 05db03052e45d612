//! The game: the maze tilts, the ball rolls, and the ball's contacts count.

use carom::{
    BodyPair, ColliderId, Contact, DQuat, DVec3, Discrete, Error, Exact, Friction, Rule, Settings,
    Snapshot, SphereId, World, Zones, rotation_vector,
};
use carom_scene::scene::Scene;

use crate::error::GameError;
use crate::maze::{Maze, Role};
use crate::options::Options;
use crate::part::Part;
use crate::progress::Progress;
use crate::tilt::{Steering, Tilt};

/// Largest number of impacts of the ball in a frame. A rolling ball needs about ten. A frame that
/// needs more is taken by the rule `discrete`, after some milliseconds.
const MOST_IMPACTS: u32 = 2_000;
/// Depth of overlap with the maze beyond which a ball is moved out \[m\]. Far more than the error
/// of the rule `exact` at turning surfaces, far less than is visible.
const SUNK: f64 = 1e-6;
/// [`SUNK`] for a ball with friction, as a part of its radius: sub-steps have a larger error.
const STEPPED_SUNK: f64 = 0.02;

/// State of a game.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum GameState {
    /// The ball rolls.
    Rolling,
    /// The ball touched an end wall; the game stops until it is played again.
    Won {
        /// Duration of the game \[s\].
        time: f64,
    },
}

/// An event in a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum GameEvent {
    /// The ball touched a collectible, which disappeared.
    Collected {
        /// Index of the collectible in [`Maze::collectibles`].
        index: usize,
        /// Number of collectibles taken so far.
        count: usize,
    },
    /// The ball fell out of the maze and was put back to the start.
    Fell,
    /// The ball touched an end wall.
    Won {
        /// Duration of the game \[s\].
        time: f64,
        /// Number of collectibles taken.
        collected: usize,
        /// Whether all were taken, in less time than ever before.
        is_best: bool,
    },
}

/// A game in a maze.
///
/// Time starts with the first frame in which the player steers. The ball starts at rest on the
/// ground in a level maze. A collectible that the ball touches disappears and counts. A ball below
/// [`Options::reset_height`] returns to the start with a level maze; its collectibles stay taken,
/// and time continues. Touching an end wall wins.
#[derive(Debug, Clone)]
pub struct Game {
    maze: Maze,
    options: Options,
    world: World,
    /// The world at the start of a game.
    start: Snapshot,
    ball: SphereId,
    /// Remaining colliders, in the order of the world's colliders.
    parts: Vec<Part>,
    /// The maze's scene without the collectibles taken.
    scene: Scene,
    tilt: Tilt,
    state: GameState,
    collected: usize,
    /// Frames since the player first steered.
    frames: u64,
    best: Option<f64>,
    rough_frames: u64,
    events: Vec<GameEvent>,
}

impl Game {
    /// Makes a game that has not begun.
    ///
    /// # Errors
    /// [`GameError::Option`] for an invalid option, also for a reset height that is not below the
    /// start.
    pub fn new(maze: Maze, options: Options) -> Result<Self, GameError> {
        options.validate()?;
        if options.reset_height >= maze.start().y {
            let (field, value) = ("reset_height", options.reset_height);
            return Err(GameError::Option { field, requirement: "below the ball's start", value });
        }
        let mut world = maze.scene().world()?;
        play_with(&mut world, &options)?;
        let parts = Part::all(&world, &maze);
        Ok(Self {
            start: world.snapshot(),
            ball: world.spheres().ids()[0],
            world,
            parts,
            scene: maze.scene().clone(),
            maze,
            options,
            tilt: Tilt::LEVEL,
            state: GameState::Rolling,
            collected: 0,
            frames: 0,
            best: None,
            rough_frames: 0,
            events: Vec::new(),
        })
    }

    /// Plays one frame. A won game does not change.
    ///
    /// # Errors
    /// [`GameError::Steering`] for steering that is not finite, [`GameError::Physics`] if a number
    /// would overflow. The game is then unchanged.
    pub fn step(&mut self, steering: Steering) -> Result<&[GameEvent], GameError> {
        self.events.clear();
        steering.validate()?;
        if self.state != GameState::Rolling {
            return Ok(&[]);
        }
        let tilt = self.tilt.steered(steering, &self.options);
        self.step_world(tilt)?;
        self.tilt = tilt;
        if self.frames > 0 || steering.is_active() {
            self.frames += 1;
        }
        self.collect()?;
        self.win();
        self.catch()?;
        Ok(&self.events)
    }

    /// Steps the world by a frame in which the maze turns to `tilt`: by the rule `exact`, or, if
    /// that fails, by the rule `discrete`, so that the ball never leaves the maze.
    fn step_world(&mut self, tilt: Tilt) -> Result<(), GameError> {
        let before = self.world.snapshot();
        if self.world.overlaps(self.sunk()).is_empty() {
            let reach = self.reach(tilt);
            let place = self.world.spheres().positions()[0];
            self.move_maze(self.tilt, tilt)?;
            match self.world.step(self.options.frame_time).map(drop) {
                Ok(()) if self.is_lawful(place, reach) => return Ok(()),
                Ok(()) | Err(Error::TooManyImpacts { .. }) => self.world.restore(&before),
                Err(error) => return Err(error.into()),
            }
        }
        let stepped = self.step_roughly(tilt);
        if stepped.is_err() {
            self.world.restore(&before);
        }
        stepped
    }

    /// Returns how far the ball can move \[m\] while the maze turns to `tilt`: its own speed, plus
    /// the gain from gravity, plus twice the speed of the walls, which an elastic wall transfers.
    fn reach(&self, tilt: Tilt) -> f64 {
        let h = self.options.frame_time;
        let turn = rotation_vector(tilt.rotation() * self.tilt().inverse()).length();
        let spheres = self.world.spheres();
        let (arm, speed) = (spheres.positions()[0].length(), spheres.velocities()[0].length());
        let arm = arm + 2.0 * self.maze.ball_radius();
        h * speed + h * h * self.maze.gravity() + 2.0 * turn * arm
    }

    /// Returns whether the ball is within `reach` of its earlier position `place`, and in no wall.
    fn is_lawful(&self, place: DVec3, reach: f64) -> bool {
        let way = self.world.spheres().positions()[0].distance(place);
        way <= reach + self.sunk() && self.world.overlaps(self.sunk()).is_empty()
    }

    /// Returns the depth of overlap with the maze beyond which a ball is moved out \[m\].
    fn sunk(&self) -> f64 {
        if self.options.friction > 0.0 { STEPPED_SUNK * self.maze.ball_radius() } else { SUNK }
    }

    /// Takes a frame by the rule `discrete`, which always ends: the ball moves and is then moved
    /// out of the maze at its final tilt.
    fn step_roughly(&mut self, tilt: Tilt) -> Result<(), GameError> {
        self.rough_frames += 1;
        self.move_maze(self.tilt, tilt)?;
        let turned: Vec<_> = self
            .parts
            .iter()
            .map(|part| {
                let moving = self.world.collider(part.id);
                moving.map(|it| (part.id, it.with_pose(part.posed(tilt.rotation()))))
            })
            .collect::<Result<_, Error>>()?;
        self.world.set_colliders(&turned)?;
        self.world.set_settings(settings(Rule::Discrete(Discrete::default()), &self.world))?;
        let stepped = self.world.step(self.options.frame_time).map(drop);
        play_with(&mut self.world, &self.options)?;
        Ok(stepped?)
    }

    /// Sets every collider to its pose at the tilt `from`, with the steady motion that takes it to
    /// the pose at `to` in a frame. Poses are computed from the tilt, so they never drift.
    fn move_maze(&mut self, from: Tilt, to: Tilt) -> Result<(), GameError> {
        let (before, after) = (from.rotation(), to.rotation());
        let turn = rotation_vector(after * before.inverse()) / self.options.frame_time;
        if turn == DVec3::ZERO && self.is_posed(before) {
            return Ok(());
        }
        let moved = |part: &Part| {
            let pose = part.posed(before);
            let way = part.posed(after).position - pose.position;
            let velocity = way / self.options.frame_time;
            (part.id, part.level.clone().moving(velocity, turn).with_pose(pose))
        };
        let changes: Vec<_> = self.parts.iter().map(moved).collect();
        Ok(self.world.set_colliders(&changes)?)
    }

    /// Returns whether the colliders are at rest in the poses of a rotation of the maze.
    fn is_posed(&self, rotation: DQuat) -> bool {
        let mut both = self.world.colliders().zip(&self.parts);
        both.all(|((_, now), part)| *now == part.level.clone().with_pose(part.posed(rotation)))
    }

    /// Takes the collectibles that the ball touches.
    fn collect(&mut self) -> Result<(), GameError> {
        let touched: Vec<ColliderId> =
            self.world.report().triggers.iter().map(|contact| contact.collider).collect();
        for id in touched {
            let Some(place) = self.parts.iter().position(|part| part.id == id) else { continue };
            let Role::Collectible(index) = self.parts[place].role else { continue };
            self.take(place)?;
            self.events.push(GameEvent::Collected { index, count: self.collected });
        }
        Ok(())
    }

    /// Removes a remaining collider that is a collectible, and counts it.
    fn take(&mut self, place: usize) -> Result<(), GameError> {
        self.world.remove_collider(self.parts[place].id)?;
        self.parts.remove(place);
        self.scene.colliders.remove(place);
        self.collected += 1;
        Ok(())
    }

    /// Wins if the ball touched an end wall.
    fn win(&mut self) {
        let is_end_wall = |id: ColliderId| {
            self.parts.iter().any(|part| part.id == id && part.role == Role::EndWall)
        };
        let touches = |between| match between {
            BodyPair::Collider { collider, .. } => is_end_wall(collider),
            BodyPair::Spheres(..) => false,
        };
        // A ball that rolls up to a wall slowly is in contact without an impact.
        let rolls = self.options.friction > 0.0;
        let contacts = if rolls { self.world.contacts() } else { Vec::new() };
        let in_contact = contacts.iter().map(|contact| contact.between);
        let impacts = self.world.report().impacts.iter().map(|impact| impact.between);
        if impacts.chain(in_contact).any(touches) {
            let (time, collected) = (self.elapsed(), self.collected);
            let has_all = self.remaining().next().is_none();
            let is_best = has_all && self.best.is_none_or(|best| time < best);
            self.best = is_best.then_some(time).or(self.best);
            self.state = GameState::Won { time };
            self.events.push(GameEvent::Won { time, collected, is_best });
        }
    }

    /// Puts a fallen ball back to the start.
    fn catch(&mut self) -> Result<(), GameError> {
        let is_low = self.ball_in_maze().0.y < self.options.reset_height;
        if self.state != GameState::Rolling || !is_low {
            return Ok(());
        }
        let ball = self.world.sphere(self.ball)?;
        let ball = ball
            .with_position(self.maze.start())
            .with_velocity(DVec3::ZERO)
            .with_angular_velocity(DVec3::ZERO);
        self.world.set_sphere(self.ball, ball)?;
        self.tilt = Tilt::LEVEL;
        self.move_maze(Tilt::LEVEL, Tilt::LEVEL)?;
        self.events.push(GameEvent::Fell);
        Ok(())
    }

    /// Starts again: everything is at its start, the time is 0, and the best time stays.
    pub fn play_again(&mut self) {
        self.world.restore(&self.start);
        self.parts = Part::all(&self.world, &self.maze);
        self.scene.clone_from(self.maze.scene());
        self.tilt = Tilt::LEVEL;
        self.state = GameState::Rolling;
        (self.collected, self.frames) = (0, 0);
        self.events.clear();
    }

    /// Sets the least time in which this maze was won \[s\].
    pub fn set_best(&mut self, best: Option<f64>) {
        self.best = best;
    }

    /// Returns the progress of the game; of a won game, only the best time.
    pub fn progress(&self) -> Progress {
        if self.state != GameState::Rolling {
            let mut again = self.clone();
            again.play_again();
            return again.progress();
        }
        let ball = self.world.spheres().get(0);
        Progress {
            position: ball.position.to_array(),
            velocity: ball.velocity.to_array(),
            orientation: ball.orientation.to_array(),
            angular_velocity: ball.angular_velocity.to_array(),
            tilt: [self.tilt.about_x, self.tilt.about_z],
            remaining: self.remaining().collect(),
            frames: self.frames,
            best: self.best,
        }
    }

    /// Continues from the progress of a game in this maze.
    ///
    /// # Errors
    /// [`GameError`] if no game in this maze can have this progress; the game is then unchanged.
    pub fn resume(&mut self, progress: &Progress) -> Result<(), GameError> {
        let mut game = self.clone();
        game.play_again();
        game.put(progress)?;
        *self = game;
        Ok(())
    }

    /// Applies a progress to a game at its start.
    fn put(&mut self, progress: &Progress) -> Result<(), GameError> {
        // A tilt at the limit may exceed it by rounding.
        const SLACK: f64 = 1e-9;
        let is_taken = |part: &Part| match part.role {
            Role::Collectible(index) => !progress.remaining.contains(&index),
            _ => false,
        };
        while let Some(place) = self.parts.iter().position(is_taken) {
            self.take(place)?;
        }
        let tilt = progress.tilt();
        Steering::Towards(tilt).validate()?;
        if tilt.angle() > self.options.max_tilt_degrees.to_radians() + SLACK {
            return Err(GameError::Progress { problem: "the maze is tilted too far" });
        }
        self.tilt = tilt;
        self.move_maze(tilt, tilt)?;
        let ball = progress.ball(self.world.sphere(self.ball)?);
        self.world.set_sphere(self.ball, ball)?;
        if !self.world.overlaps(self.sunk()).is_empty() {
            return Err(GameError::Progress { problem: "the ball is in a wall" });
        }
        self.frames = progress.frames;
        self.best = progress.best.filter(|best| best.is_finite());
        Ok(())
    }

    /// Returns the maze.
    pub fn maze(&self) -> &Maze {
        &self.maze
    }

    /// Returns the options.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// Sets the options from the next frame on.
    ///
    /// # Errors
    /// [`GameError::Option`] for an invalid value; the options are then unchanged.
    pub fn set_options(&mut self, options: Options) -> Result<(), GameError> {
        options.validate()?;
        if options.friction != self.options.friction {
            let now = self.world.snapshot();
            self.world.restore(&self.start);
            play_with(&mut self.world, &options)?;
            self.start = self.world.snapshot();
            self.world.restore(&now);
            play_with(&mut self.world, &options)?;
        }
        self.options = options;
        Ok(())
    }

    /// Returns the duration of a frame \[s\].
    pub fn frame_time(&self) -> f64 {
        self.options.frame_time
    }

    /// Returns the tilted world, whose only sphere is the ball.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// Returns the scene of the maze without the collectibles taken. Its colliders are in the order
    /// of those of [`Self::world`], which has their present poses.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Returns the rotation from the maze to the world.
    pub fn tilt(&self) -> DQuat {
        self.tilt.rotation()
    }

    /// Returns the tilt as angles.
    pub fn tilt_angles(&self) -> Tilt {
        self.tilt
    }

    /// Returns position \[m\] and velocity \[m/s\] of the ball's centre along the axes of the maze.
    /// The velocity is that relative to the world, without the motion of the maze.
    pub fn ball_in_maze(&self) -> (DVec3, DVec3) {
        let spheres = self.world.spheres();
        let into_maze = self.tilt().inverse();
        (into_maze * spheres.positions()[0], into_maze * spheres.velocities()[0])
    }

    /// Returns whether the game is running or won.
    pub fn state(&self) -> GameState {
        self.state
    }

    /// Returns the number of collectibles taken.
    pub fn collected(&self) -> usize {
        self.collected
    }

    /// Returns the remaining collectibles in ascending order, as indices into
    /// [`Maze::collectibles`].
    pub fn remaining(&self) -> impl Iterator<Item = usize> + '_ {
        self.parts.iter().filter_map(|part| match part.role {
            Role::Collectible(index) => Some(index),
            _ => None,
        })
    }

    /// Returns the time since the player first steered \[s\].
    pub fn elapsed(&self) -> f64 {
        self.frames as f64 * self.options.frame_time
    }

    /// Returns the least time of a win with all collectibles \[s\].
    pub fn best(&self) -> Option<f64> {
        self.best
    }

    /// Returns the events of the last frame.
    pub fn events(&self) -> &[GameEvent] {
        &self.events
    }

    /// Returns the number of frames taken by the rule `discrete`, because the ball hit walls more
    /// often than the rule `exact` may follow, or overlapped a wall.
    pub fn rough_frames(&self) -> u64 {
        self.rough_frames
    }
}

/// Sets the rule of the game in the world, and the friction of the ball.
fn play_with(world: &mut World, options: &Options) -> Result<(), Error> {
    let rolls = options.friction > 0.0;
    let exact = Exact::default().with_max_impacts(MOST_IMPACTS).with_zones(Zones::Never);
    let rule = if rolls { Rule::Contact(Contact::default()) } else { Rule::Exact(exact) };
    world.set_settings(settings(rule, world))?;
    let said = if rolls { Friction::sliding(options.friction) } else { Friction::default() };
    let (id, ball) = (world.spheres().ids()[0], world.spheres().get(0));
    // Setting a sphere ends its flight and contacts.
    if ball.friction == said { Ok(()) } else { world.set_sphere(id, ball.with_friction(said)) }
}

fn settings(rule: Rule, world: &World) -> Settings {
    world.settings().with_rule(rule)
}
