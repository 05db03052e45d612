//! What all episodes in a maze share: the world to roll in, and what is known of it.

use carom::{ColliderId, DVec3, Rule, World, Zones};
use carom_scene::scene::Force;

use super::ground::Ground;
use super::observation;
use super::options::EpisodeOptions;
use super::ways::Ways;
use crate::error::{EpisodeError, MazeError};
use crate::floor::Floor;
use crate::maze::{Maze, Role};

/// As many bits as there are for what a ball has taken.
const MOST_COLLECTIBLES: usize = u64::BITS as usize;
/// Impacts of a ball in a frame under the rule `exact`. A rolling ball needs some ten; one that
/// needs more than this takes the frame by the rule `discrete`.
const MOST_IMPACTS: u32 = 2_000;
/// What a place to start from leaves to walls, beyond the ball \[cells of the floor\]: the middle of
/// a cell is known to be free but for a hundredth of a radius.
const FREE_CELLS: f64 = 2.0;

/// A maze, made ready for episodes. It can be shared by many [`Episodes`](super::Episodes).
#[derive(Debug, Clone)]
pub struct Arena {
    maze: Maze,
    options: EpisodeOptions,
    /// One ball without weight, the rule that of the options.
    world: World,
    /// By number of collider.
    roles: Vec<Role>,
    ground: Ground,
    collectibles: usize,
    /// Where balls may start: the maze's own start, and others.
    starts: Vec<DVec3>,
    observation_bounds: [Vec<f32>; 2],
    /// Only for shaping.
    ways: Option<Ways>,
}

impl Arena {
    /// Prepares a maze. Of the scene's forces only drag is kept; weight is what
    /// [`Maze::gravity`] says.
    ///
    /// # Errors
    /// [`EpisodeError`] for an option that makes no sense, and for a maze with more than 64
    /// collectibles.
    pub fn new(maze: Maze, options: EpisodeOptions) -> Result<Self, EpisodeError> {
        options.validate(maze.start().y)?;
        let collectibles = maze.collectibles().count();
        if collectibles > MOST_COLLECTIBLES {
            let (count, most) = (collectibles, MOST_COLLECTIBLES);
            return Err(EpisodeError::Collectibles { count, most });
        }
        let mut scene = maze.scene().clone();
        scene.forces.retain(is_drag);
        let mut world = scene.world().map_err(MazeError::from)?;
        let settings = world.settings().with_rule(limited(options.rule));
        world.set_settings(settings.with_spheres_collide(false))?;
        if options.friction > 0.0 {
            let (id, ball) = (world.spheres().ids()[0], world.spheres().get(0));
            world.set_sphere(id, ball.with_friction(options.friction))?;
        }
        let floor = Floor::new(&maze)?;
        let starts = starts(&maze, &floor);
        let ways = (options.rewards.shaping > 0.0).then(|| Ways::new(&maze, floor));
        Ok(Self {
            roles: maze.roles().to_vec(),
            ground: Ground::new(&maze),
            observation_bounds: observation::bounds(&maze, &options),
            maze,
            options,
            world,
            collectibles,
            starts,
            ways,
        })
    }

    /// The maze.
    pub fn maze(&self) -> &Maze {
        &self.maze
    }

    /// How episodes are played in it.
    pub fn options(&self) -> &EpisodeOptions {
        &self.options
    }

    /// How many collectibles there are.
    pub fn collectibles(&self) -> usize {
        self.collectibles
    }

    /// Where balls may start \[m\]: first the maze's own start, then all middles of cells of the floor
    /// that can be reached from it, free on all sides, not at an end wall and not at a collectible.
    pub fn starts(&self) -> &[DVec3] {
        &self.starts
    }

    /// How many numbers an observation has.
    pub fn observation_length(&self) -> usize {
        self.observation_bounds[0].len()
    }

    /// The least and the most that each number of an observation can be: places are within a box
    /// about the maze, speeds at most what a ball gains from rest that rolls along the diagonal of
    /// that box at the steepest.
    pub fn observation_bounds(&self) -> [&[f32]; 2] {
        let [low, high] = &self.observation_bounds;
        [low, high]
    }

    /// Whether a ball at a place \[m\] has ground under it, and does not fall.
    pub(super) fn has_ground_at(&self, place: DVec3) -> bool {
        self.ground.reaches(place)
    }

    /// Weight of a ball \[N\].
    pub(super) fn weight(&self) -> f64 {
        self.maze.gravity() * self.world.spheres().masses()[0]
    }

    /// Potential of a ball at a place \[m\] that has taken some collectibles, as shaping needs it;
    /// `None` without shaping, and where nothing is known.
    pub(super) fn potential(&self, place: DVec3, taken: u64) -> Option<f64> {
        let cost = self.ways.as_ref()?.to_goal(place, taken)?;
        Some(-self.options.rewards.shaping * cost)
    }

    /// A world of one ball, which has no weight.
    pub(super) fn world(&self) -> &World {
        &self.world
    }

    /// What a collider is in the game.
    pub(super) fn role(&self, id: ColliderId) -> Role {
        // In a world made of a scene, colliders are numbered as in the scene.
        self.roles.get(id.number() as usize).copied().unwrap_or(Role::Wall)
    }
}

/// Whether a force slows balls down.
fn is_drag(force: &Force) -> bool {
    matches!(force, Force::ViscousDrag { coefficient } if *coefficient > 0.0)
}

/// The rule, with a bound that keeps frames short.
fn limited(rule: Rule) -> Rule {
    match rule {
        Rule::Exact(exact) => {
            let limited = exact.with_max_impacts(exact.max_impacts.min(MOST_IMPACTS));
            Rule::Exact(limited.with_zones(Zones::Never))
        }
        other => other,
    }
}

fn starts(maze: &Maze, floor: &Floor) -> Vec<DVec3> {
    let mut starts = vec![maze.start()];
    let Some(cell) = floor.cell_near(maze.start()) else { return starts };
    let costs = floor.costs_from(&[cell]);
    let touched = |point: DVec3| {
        let radius = maze.ball_radius();
        let near = |(center, reach): (DVec3, f64)| point.distance(center) <= reach + radius;
        maze.collectible_reaches().any(near)
    };
    let is_good = |&index: &usize| {
        costs[index].is_finite()
            && !floor.is_at_end_wall(index)
            && floor.clearance(index) >= FREE_CELLS * floor.cell()
            && !touched(floor.point(index))
    };
    starts.extend((0..floor.len()).filter(is_good).map(|index| floor.point(index)));
    starts
}
