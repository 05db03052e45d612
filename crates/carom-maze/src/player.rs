//! A computer player: it plans over the free floor and steers by tilting.

use carom::DVec3;

use crate::error::{MazeError, PlanError};
use crate::floor::Floor;
use crate::game::Game;
use crate::maze::Maze;
use crate::tilt::{Steering, Tilt};

/// Largest distance along the way to the point that the ball aims at \[m\].
const LOOKAHEAD: f64 = 2.5;
/// Largest target speed \[m/s\].
const TOP_SPEED: f64 = 2.0;
/// Assumed deceleration before the target point \[m/s²\].
const BRAKING: f64 = 0.8;
/// Time in which a small error of velocity is corrected \[s\].
const RESPONSE: f64 = 0.35;
/// Steepest tilt \[rad\]: at more, the ball would become too fast to stop in time.
const STEEPEST: f64 = 10.0 / 180.0 * std::f64::consts::PI;
/// Factor of the cost of cells at an end wall before the player wants to win.
const DETOUR: f64 = 100.0;

/// The present destination of the player.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Goal {
    Collectible(usize),
    EndWall,
}

/// A computer player that knows the maze.
///
/// It goes to the nearest collectible until it has as many as it wants, then to an end wall. It
/// knows the cost of the way to its goal from everywhere, so it can continue from any position.
#[derive(Debug, Clone)]
pub struct Player {
    floor: Floor,
    wanted: usize,
    /// For each collectible, the cells from which the ball touches it; empty if it cannot be
    /// reached.
    collectibles: Vec<Vec<usize>>,
    end_walls: Vec<usize>,
    goal: Option<Goal>,
    /// Cost of the way from each cell to the goal.
    costs: Vec<f64>,
}

impl Player {
    /// Makes a player that takes this many collectibles before it wins.
    ///
    /// # Errors
    /// [`PlanError`] if the ball cannot reach this many, or no end wall.
    pub fn new(maze: &Maze, wanted: usize) -> Result<Self, PlanError> {
        let unusable = |error: MazeError| PlanError::Maze(error.to_string());
        let floor = Floor::new(maze).map_err(unusable)?;
        let start = floor.cell_near(maze.start()).ok_or(PlanError::NoWay)?;
        let costs = floor.costs_from(&[start]);
        let reached = |cells: Vec<usize>| -> Vec<usize> {
            cells.into_iter().filter(|&cell| costs[cell].is_finite()).collect()
        };
        let end_walls = reached(floor.cells_at_end_walls());
        if end_walls.is_empty() {
            return Err(PlanError::NoWay);
        }
        let touching = |(center, radius)| reached(floor.cells_touching(center, radius));
        let collectibles: Vec<_> = maze.collectible_spheres().map(touching).collect();
        let reachable = collectibles.iter().filter(|cells| !cells.is_empty()).count();
        if reachable < wanted {
            return Err(PlanError::TooFewCollectibles { wanted, reachable });
        }
        Ok(Self { floor, wanted, collectibles, end_walls, goal: None, costs: Vec::new() })
    }

    /// Returns the collectibles that the ball can reach, in ascending order.
    pub fn reachable(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.collectibles.len()).filter(|&index| !self.collectibles[index].is_empty())
    }

    /// Returns the steering for the next frame of a game in the player's maze.
    pub fn steer(&mut self, game: &Game) -> Steering {
        let (position, velocity) = game.ball_in_maze();
        let Some(cell) = self.floor.cell_near(position) else {
            return Steering::Towards(Tilt::LEVEL);
        };
        self.choose(game, cell);
        let target = self.target(position, cell);
        let error = wanted_velocity(target - position) - velocity;
        let options = game.options();
        let speed = options.tilt_speed_degrees_per_second.to_radians();
        let steepest = STEEPEST.min(options.max_tilt_degrees.to_radians());
        let slope = |error| slope(error, speed, game.maze().gravity()).clamp(-steepest, steepest);
        Steering::Towards(Tilt::down(slope(error.x), slope(error.z)))
    }

    /// Chooses the next goal if there is none or the last one is reached.
    fn choose(&mut self, game: &Game, cell: usize) {
        let remaining: Vec<usize> = game
            .remaining()
            .filter(|&index| self.collectibles.get(index).is_some_and(|cells| !cells.is_empty()))
            .collect();
        let wants_more = game.collected() < self.wanted && !remaining.is_empty();
        let stays = match self.goal {
            Some(Goal::Collectible(index)) => wants_more && remaining.contains(&index),
            Some(Goal::EndWall) => !wants_more,
            None => false,
        };
        if stays {
            return;
        }
        let goal = if wants_more {
            let costs = self.floor.costs(&[cell], self.detour());
            let cost = |index: usize| {
                self.collectibles[index].iter().map(|&it| costs[it]).fold(f64::INFINITY, f64::min)
            };
            let nearest = remaining.iter().copied().min_by(|&a, &b| cost(a).total_cmp(&cost(b)));
            nearest.map_or(Goal::EndWall, Goal::Collectible)
        } else {
            Goal::EndWall
        };
        self.costs = match goal {
            Goal::Collectible(index) => self.floor.costs(&self.collectibles[index], self.detour()),
            Goal::EndWall => self.floor.costs_from(&self.end_walls),
        };
        self.goal = Some(goal);
    }

    /// Returns the factor of the cost of a cell while the player avoids end walls.
    fn detour(&self) -> impl Fn(usize) -> f64 + use<'_> {
        |index| if self.floor.is_at_end_wall(index) { DETOUR } else { 1.0 }
    }

    /// Returns the point to aim at: the farthest point on the way that the ball can reach straight.
    fn target(&self, position: DVec3, cell: usize) -> DVec3 {
        let mut target = self.floor.point(cell);
        let (mut here, mut length) = (cell, 0.0);
        while length < LOOKAHEAD {
            let cost = |&(next, _): &(usize, f64)| self.costs[next];
            let best = self
                .floor
                .neighbours(here)
                .min_by(|a, b| cost(a).total_cmp(&cost(b)))
                .filter(|best| cost(best) < self.costs[here]);
            let Some((next, distance)) = best else {
                // The goal lies beyond the last cell.
                return target + (target - position).reject_from(DVec3::Y);
            };
            if !self.floor.sees(position, self.floor.point(next)) {
                break;
            }
            target = self.floor.point(next);
            length += distance * self.floor.cell();
            here = next;
        }
        target
    }
}

/// Returns a velocity \[m/s\] from which the ball can stop at the end of a way \[m\].
fn wanted_velocity(way: DVec3) -> DVec3 {
    let way = way.reject_from(DVec3::Y);
    let distance = way.length();
    let speed = (2.0 * BRAKING * distance).sqrt().min(TOP_SPEED);
    if distance > 0.0 { way * (speed / distance) } else { DVec3::ZERO }
}

/// Returns the slope \[rad\] that causes a change of velocity \[m/s\]. A slope θ that is levelled
/// at the rate ω \[rad/s\] still adds g θ²/(2 ω) of speed; levelling must begin when this much is
/// missing.
fn slope(change: f64, rate: f64, gravity: f64) -> f64 {
    let levelling = (2.0 * rate * change.abs() / gravity).sqrt();
    let gentle = change.abs() / (gravity * RESPONSE);
    levelling.min(gentle).copysign(change)
}
