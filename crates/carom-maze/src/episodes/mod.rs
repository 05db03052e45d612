//! Episodes for learning agents: many independent balls in one maze.

mod alone;
mod arena;
mod ball;
mod ground;
mod observation;
mod options;
mod rescue;
mod ways;

use std::sync::Arc;

use carom::{Contact, DQuat, DVec3, Error, SphereId, SphereMotion, World};
use carom_scene::scene::Scene;

use crate::error::EpisodeError;
use crate::maze::Role;
use crate::tilt::Tilt;
use alone::Alone;
use ball::{Ball, Steering};
use rescue::Rescue;

pub use arena::Arena;
pub use ball::Outcome;
pub use options::{EpisodeOptions, Rewards};

/// Where an episode starts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Start {
    /// The maze's start.
    #[default]
    Maze,
    /// One of [`Arena::starts`], all equally likely, chosen by the ball's own random numbers.
    Random,
}

/// Episodes of many balls in one maze, which do not affect each other.
///
/// The maze is at rest. The weight of each ball is turned by its own tilt, so the motion of a
/// turning maze exerts no force. An action is the wanted tilt as a part of the steepest; the tilt
/// follows at [`EpisodeOptions::tilt_speed_degrees_per_second`]. A ball takes a collectible by
/// touching it. An episode is won when the ball touches an end wall. It also ends when the ball
/// falls: when its centre passes the edge of the ground. After that the ball moves on without
/// rewards until it is [reset](Self::reset).
///
/// The bits of an episode depend only on its start and its actions, not on the other balls.
///
/// ```
/// use std::sync::Arc;
/// use carom_maze::{Arena, EpisodeOptions, Episodes, Maze};
///
/// let arena = Arc::new(Arena::new(Maze::course()?, EpisodeOptions::default())?);
/// let mut episodes = Episodes::new(arena, 2)?;
/// for _ in 0..50 {
///     episodes.step(&[[1.0, 0.0], [0.0, -0.5]])?;
/// }
/// let mut seen = vec![0.0; episodes.arena().observation_length()];
/// episodes.observe(0, &mut seen);
/// assert!(seen[0] > 2.23, "rolled to +x");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Episodes {
    arena: Arc<Arena>,
    /// All balls; the number of each sphere is its index in `balls`.
    world: World,
    balls: Vec<Ball>,
    /// Weight of each ball along the axes of the maze \[N\].
    weights: Vec<DVec3>,
    rescue: Rescue,
    /// Takes the frames of balls with friction.
    rolling: Option<Alone>,
    /// Working memory of resets.
    moved: Vec<SphereMotion>,
}

impl Episodes {
    /// Starts `count` episodes at the maze's start with a level maze. The balls' random numbers
    /// have the seeds 0, 1, 2, ...
    ///
    /// # Errors
    /// [`EpisodeError::Count`] if `count` is 0.
    pub fn new(arena: Arc<Arena>, count: usize) -> Result<Self, EpisodeError> {
        if count == 0 {
            let what = "the number of balls";
            return Err(EpisodeError::Count { what, balls: 1, count });
        }
        let mut world = arena.world().clone();
        let ball = world.spheres().get(0);
        for _ in 1..count {
            world.add_sphere(ball)?;
        }
        let balls = (0..count as u64).map(Ball::new).collect();
        let rescue = Rescue::new(&arena)?;
        let weights = vec![DVec3::ZERO; count];
        let rolls = arena.options().friction > 0.0;
        let rolling = rolls.then(|| Alone::new(&arena, Contact::default())).transpose()?;
        let moved = Vec::new();
        let mut episodes = Self { arena, world, balls, weights, rescue, rolling, moved };
        let all: Vec<usize> = (0..count).collect();
        episodes.reset(&all, Start::Maze)?;
        Ok(episodes)
    }

    /// Takes a step with an action for each ball: the wanted tilt towards +x and +z, as parts of
    /// the steepest in \[-1, 1\]. Values outside are clamped. A positive part lowers the maze at
    /// that side.
    ///
    /// # Errors
    /// [`EpisodeError::Count`] if the number of actions differs from that of balls,
    /// [`EpisodeError::Action`] for an action that is not finite; nothing happens then.
    /// [`EpisodeError::Physics`] if a number would overflow; that frame is not taken.
    pub fn step(&mut self, actions: &[[f64; 2]]) -> Result<(), EpisodeError> {
        let (balls, count) = (self.balls.len(), actions.len());
        if balls != count {
            return Err(EpisodeError::Count { what: "the number of actions", balls, count });
        }
        if let Some(ball) = actions.iter().position(|[x, z]| !(x.is_finite() && z.is_finite())) {
            let [x, z] = actions[ball];
            return Err(EpisodeError::Action { ball, value: if x.is_finite() { z } else { x } });
        }
        self.balls.iter_mut().for_each(|ball| ball.begin_step(&self.arena));
        for _ in 0..self.arena.options().frames_per_step {
            self.take_frame(actions)?;
        }
        let places = self.world.spheres().positions();
        for (ball, &place) in self.balls.iter_mut().zip(places) {
            ball.end_step(place, &self.arena);
        }
        Ok(())
    }

    fn take_frame(&mut self, actions: &[[f64; 2]]) -> Result<(), EpisodeError> {
        let steering = Steering::new(self.arena.options());
        let weight = self.arena.weight();
        for ((ball, weight_of_ball), &action) in
            self.balls.iter_mut().zip(&mut self.weights).zip(actions)
        {
            ball.tilt = steering.steered(ball.tilt, action);
            *weight_of_ball = weight * ball.tilt.down_in_maze();
        }
        self.step_world()?;
        let lowest = self.arena.options().reset_height;
        for (ball, place) in self.balls.iter_mut().zip(self.world.spheres().positions()) {
            if place.y < lowest || !self.arena.has_ground_at(*place) {
                ball.fall(&self.arena);
            }
        }
        Ok(())
    }

    /// Moves all balls by a frame and records what they touch.
    fn step_world(&mut self) -> Result<(), EpisodeError> {
        let Self { arena, world, balls, weights, .. } = self;
        if let Some(rolling) = &mut self.rolling {
            for (index, &weight) in weights.iter().enumerate() {
                let id = world.spheres().ids()[index];
                let ball = world.spheres().get(index);
                let after = rolling.take_frame(id, ball, weight, balls, arena)?;
                world.set_sphere(id, after)?;
            }
            return Ok(());
        }
        self.rescue.clear();
        loop {
            self.world.set_applied_forces(&self.weights)?;
            // Times differ in rounding: with the same time, the same frame has the same bits.
            self.world.set_time(0.0)?;
            match self.world.step(self.arena.options().frame_time).map(drop) {
                Ok(()) => break,
                Err(Error::TooManyImpacts { sphere, .. }) if !self.rescue.has(sphere) => {
                    let weight = &mut self.weights[ball::index_of(sphere)];
                    self.rescue.park(sphere, weight, &mut self.world, &self.arena)?;
                }
                Err(error) => return Err(error.into()),
            }
        }
        let rescue = &self.rescue;
        ball::note(&self.world, &mut self.balls, &self.arena, |id| {
            (!rescue.has(id)).then_some(ball::index_of(id))
        });
        self.rescue.release(&mut self.world, &mut self.balls, &self.arena)
    }

    /// Starts new episodes of some balls, with a level maze.
    ///
    /// # Errors
    /// [`EpisodeError::NoBall`] for an index without a ball; then none is reset.
    pub fn reset(&mut self, balls: &[usize], start: Start) -> Result<(), EpisodeError> {
        balls.iter().try_for_each(|&ball| self.check(ball))?;
        self.moved.clear();
        for &index in balls {
            let ball = &mut self.balls[index];
            let position = match start {
                Start::Maze => self.arena.maze().start(),
                Start::Random => ball.choose(self.arena.starts()),
            };
            ball.begin(position, &self.arena);
            let id = self.world.spheres().ids()[index];
            self.moved.push(SphereMotion { id, position, velocity: DVec3::ZERO });
        }
        self.world.set_motions(&self.moved)?;
        if self.rolling.is_some() {
            for &index in balls {
                let (id, ball) =
                    (self.world.spheres().ids()[index], self.world.spheres().get(index));
                self.world.set_sphere(id, ball.with_angular_velocity(DVec3::ZERO))?;
            }
        }
        Ok(())
    }

    /// Sets the seed of the random numbers with which a ball chooses its starts.
    ///
    /// # Errors
    /// [`EpisodeError::NoBall`] for an index without a ball.
    pub fn seed(&mut self, ball: usize, seed: u64) -> Result<(), EpisodeError> {
        self.check(ball)?;
        self.balls[ball].seed(seed);
        Ok(())
    }

    fn check(&self, ball: usize) -> Result<(), EpisodeError> {
        let balls = self.balls.len();
        if ball < balls { Ok(()) } else { Err(EpisodeError::NoBall { ball, balls }) }
    }

    /// Returns the arena.
    pub fn arena(&self) -> &Arena {
        &self.arena
    }

    /// Returns the number of balls.
    pub fn len(&self) -> usize {
        self.balls.len()
    }

    /// Returns `false`: there is at least one ball.
    pub fn is_empty(&self) -> bool {
        self.balls.is_empty()
    }

    /// Returns centre \[m\] and velocity \[m/s\] of a ball along the axes of the maze.
    ///
    /// # Panics
    /// For an index without a ball, as the methods below.
    pub fn motion(&self, ball: usize) -> (DVec3, DVec3) {
        let spheres = self.world.spheres();
        (spheres.positions()[ball], spheres.velocities()[ball])
    }

    /// Returns the tilt of the maze for a ball.
    pub fn tilt(&self, ball: usize) -> Tilt {
        self.balls[ball].tilt
    }

    /// Returns the collectibles that a ball has taken in this episode; bit i is the i-th.
    pub fn taken(&self, ball: usize) -> u64 {
        self.balls[ball].taken
    }

    /// Returns whether an episode continues, or how it ended.
    pub fn outcome(&self, ball: usize) -> Outcome {
        self.balls[ball].outcome
    }

    /// Returns the reward of the last step.
    pub fn reward(&self, ball: usize) -> f64 {
        self.balls[ball].reward
    }

    /// Returns the number of steps since the episode began.
    pub fn steps(&self, ball: usize) -> u32 {
        self.balls[ball].steps
    }

    /// Writes the observation of an agent; a shorter slice gets its first numbers:
    ///
    /// - the centre of the ball along x and z \[m\], in the maze's own frame;
    /// - its velocity along x and z \[m/s\];
    /// - the slope of the maze down towards +x and +z \[rad\];
    /// - for each collectible, 1 if it is not taken yet, else 0.
    ///
    /// Every number is clamped to [`Arena::observation_bounds`].
    pub fn observe(&self, ball: usize, out: &mut [f32]) {
        let (place, velocity) = self.motion(ball);
        let Ball { tilt, taken, .. } = self.balls[ball];
        observation::write((place, velocity), tilt, taken, self.arena.observation_bounds(), out);
    }

    /// Returns the scene as a ball sees it, along the axes of the world: the maze tilted, without
    /// the collectibles taken.
    pub fn scene(&self, ball: usize) -> Scene {
        let (rotation, (place, velocity)) = (self.tilt(ball).rotation(), self.motion(ball));
        let mut scene = self.arena.maze().scene().clone();
        scene.simulation.allow_overlap = true;
        let turned = |vector: DVec3| (rotation * vector).to_array();
        (scene.spheres[0].position, scene.spheres[0].velocity) = (turned(place), turned(velocity));
        if self.rolling.is_some() {
            let orientation = self.world.spheres().get(ball).orientation;
            scene.spheres[0].orientation = (rotation * orientation).to_array();
        }
        let is_taken = |role: &Role| match role {
            Role::Collectible(index) => self.taken(ball) >> index & 1 == 1,
            _ => false,
        };
        let mut roles = self.arena.maze().roles().iter();
        scene.colliders.retain(|_| !roles.next().is_some_and(is_taken));
        for collider in &mut scene.colliders {
            collider.position = turned(DVec3::from_array(collider.position));
            let level = DQuat::from_array(collider.rotation).normalize();
            collider.rotation = (rotation * level).to_array();
        }
        scene
    }

    /// Returns the number of frames of single balls that were taken by the rule `discrete`, because
    /// the ball hit walls more often than the rule `exact` may follow.
    pub fn rough_frames(&self) -> u64 {
        self.rescue.frames()
    }
}
