//! Data that all episodes in a maze share: the world, and what is computed from the maze once.

use carom::{ColliderId, DVec3, Rule, World, Zones};
use carom_scene::scene::Force;

use super::ground::Ground;
use super::observation;
use super::options::EpisodeOptions;
use super::ways::Ways;
use crate::error::{EpisodeError, MazeError};
use crate::floor::Floor;
use crate::maze::{Maze, Role};

/// A ball has one bit for each collectible.
const MOST_COLLECTIBLES: usize = u64::BITS as usize;
/// Largest number of impacts of a ball in a frame under the rule `exact`. A rolling ball needs about
/// ten. A ball that needs more takes the frame by the rule `discrete`.
const MOST_IMPACTS: u32 = 2_000;
/// Least distance between walls and a ball at a start, beyond its radius \[cells of the floor\].
/// The middle of a cell is known to be free only up to a hundredth of a radius.
const FREE_CELLS: f64 = 2.0;

/// A maze prepared for episodes. Many [`Episodes`](super::Episodes) can share it.
#[derive(Debug, Clone)]
pub struct Arena {
    maze: Maze,
    options: EpisodeOptions,
    /// The world with one ball without weight, under the rule of the options.
    world: World,
    /// Role of each collider, by its number.
    roles: Vec<Role>,
    ground: Ground,
    collectibles: usize,
    /// Possible starts: the maze's own start, then others.
    starts: Vec<DVec3>,
    observation_bounds: [Vec<f32>; 2],
    /// Costs of ways; only for shaping.
    ways: Option<Ways>,
}

impl Arena {
    /// Prepares a maze. Of the scene's forces only drag is kept; the weight comes from
    /// [`Maze::gravity`].
    ///
    /// # Errors
    /// [`EpisodeError`] for an invalid option, and for a maze with more than 64 collectibles.
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

    /// Returns the maze.
    pub fn maze(&self) -> &Maze {
        &self.maze
    }

    /// Returns the options of the episodes.
    pub fn options(&self) -> &EpisodeOptions {
        &self.options
    }

    /// Returns the number of collectibles.
    pub fn collectibles(&self) -> usize {
        self.collectibles
    }

    /// Returns the possible starts \[m\]: the maze's own start, then the middles of all cells of
    /// the floor that can be reached from it, are free on all sides, and touch neither an end wall
    /// nor a collectible.
    pub fn starts(&self) -> &[DVec3] {
        &self.starts
    }

    /// Returns the length of an observation.
    pub fn observation_length(&self) -> usize {
        self.observation_bounds[0].len()
    }

    /// Returns the smallest and the largest value of each number of an observation. Positions are
    /// within a box around the maze. The largest speed is that of a ball that starts at rest and
    /// rolls along the diagonal of that box at the steepest tilt.
    pub fn observation_bounds(&self) -> [&[f32]; 2] {
        let [low, high] = &self.observation_bounds;
        [low, high]
    }

    /// Returns whether there is ground under a ball at a position \[m\].
    pub(super) fn has_ground_at(&self, place: DVec3) -> bool {
        self.ground.reaches(place)
    }

    /// Returns the weight of a ball \[N\].
    pub(super) fn weight(&self) -> f64 {
        self.maze.gravity() * self.world.spheres().masses()[0]
    }

    /// Returns the potential for shaping of a ball at a position \[m\] with these collectibles
    /// taken; `None` without shaping and where the cost is unknown.
    pub(super) fn potential(&self, place: DVec3, taken: u64) -> Option<f64> {
        let cost = self.ways.as_ref()?.to_goal(place, taken)?;
        Some(-self.options.rewards.shaping * cost)
    }

    /// Returns the world with one ball, which has no weight.
    pub(super) fn world(&self) -> &World {
        &self.world
    }

    /// Returns the role of a collider.
    pub(super) fn role(&self, id: ColliderId) -> Role {
        // The world was made from the scene, so it numbers colliders as the scene does.
        self.roles.get(id.number() as usize).copied().unwrap_or(Role::Wall)
    }
}

/// Returns whether a force slows balls down.
fn is_drag(force: &Force) -> bool {
    matches!(force, Force::ViscousDrag { coefficient } if *coefficient > 0.0)
}

/// Returns the rule with a limit on impacts, which keeps frames short.
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
