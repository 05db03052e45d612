//! The free floor: where the centre of the ball can be, as a grid of cells.

use carom::{DVec3, World};

use crate::error::MazeError;
use crate::grid::Grid;
use crate::maze::{Maze, Role, ground_height};
use crate::route;

/// Cells in a radius of the ball: fine enough for a way that leaves a third of a radius to spare.
const CELLS_PER_RADIUS: f64 = 6.0;
/// Cells along a side, at most; a larger ground gets coarser cells.
const MOST_CELLS: f64 = 1000.0;
/// How far above its place on the ground, and how much smaller, the ball is in a search for what
/// it meets: more than rounding, less than the room under a ceiling \[radii\].
const LIFT: f64 = 0.01;
const SMALLER: f64 = 0.008;
/// The ball touches an end wall from this far beyond its radius \[cells\].
const NEAR_END_WALL: f64 = 1.5;

/// Free and blocked cells in the plane of the floor, in the maze's own frame.
#[derive(Debug, Clone)]
pub(crate) struct Floor {
    /// Middle of the first cell, at the height of the ball's centre \[m\].
    origin: DVec3,
    grid: Grid,
    /// Whether the ball touches an end wall there, or nearly.
    at_end_wall: Vec<bool>,
    /// Radius of the ball \[m\].
    radius: f64,
}

impl Floor {
    pub fn new(maze: &Maze) -> Result<Self, MazeError> {
        let world = maze.scene().world()?;
        let radius = maze.ball_radius();
        let [low, high] = bounds(maze);
        let size = high - low;
        let cell = (radius / CELLS_PER_RADIUS).max(size.max_element() / MOST_CELLS);
        let count = |length: f64| (length / cell).ceil() as usize + 1;
        let (columns, rows) = (count(size.x), count(size.z));
        let origin = DVec3::new(low.x, maze.start().y, low.z);
        let grid = Grid { cell, columns, rows, free: Vec::new(), clearance: Vec::new() };
        let mut floor = Self { origin, grid, at_end_wall: Vec::new(), radius };
        let points: Vec<DVec3> = (0..floor.len()).map(|index| floor.point(index)).collect();
        floor.grid.free = points.iter().map(|&point| is_free(maze, &world, point)).collect();
        floor.grid.clearance = route::clearance(&floor.grid);
        floor.at_end_wall = floor.touching_end_walls(maze, &points)?;
        Ok(floor)
    }

    /// Which cells are free and touch an end wall.
    fn touching_end_walls(&self, maze: &Maze, points: &[DVec3]) -> Result<Vec<bool>, MazeError> {
        let mut ends = maze.scene().clone();
        ends.colliders = maze.with_role(|role| role == Role::EndWall).cloned().collect();
        let ends = ends.world()?;
        let reach = self.radius + NEAR_END_WALL * self.grid.cell;
        let touches = |(index, &point)| self.grid.free[index] && ends.meets_collider(point, reach);
        Ok(points.iter().enumerate().map(touches).collect())
    }

    /// Centre of the ball in the middle of a cell \[m\].
    pub fn point(&self, index: usize) -> DVec3 {
        let (column, row) = (index % self.grid.columns, index / self.grid.columns);
        self.origin + self.grid.cell * DVec3::new(column as f64, 0.0, row as f64)
    }

    /// Edge of a cell \[m\].
    pub fn cell(&self) -> f64 {
        self.grid.cell
    }

    /// Distance of a cell to what blocks the ball \[m\].
    pub fn clearance(&self, index: usize) -> f64 {
        self.grid.clearance(index)
    }

    pub fn is_at_end_wall(&self, index: usize) -> bool {
        self.at_end_wall[index]
    }

    pub fn len(&self) -> usize {
        self.grid.len()
    }

    /// The cell that a point is in.
    pub fn cell_at(&self, point: DVec3) -> Option<usize> {
        let place = (point - self.origin) / self.grid.cell;
        let (column, row) = ((place.x + 0.5).floor(), (place.z + 0.5).floor());
        let is_inside = (0.0..self.grid.columns as f64).contains(&column)
            && (0.0..self.grid.rows as f64).contains(&row);
        is_inside.then(|| row as usize * self.grid.columns + column as usize)
    }

    /// The free cell that is nearest to a point, at most half a radius away.
    pub fn cell_near(&self, point: DVec3) -> Option<usize> {
        let reach = (0.5 * CELLS_PER_RADIUS) as isize;
        let steps = |x: isize, z: isize| self.grid.cell * DVec3::new(x as f64, 0.0, z as f64);
        let mut nearest = (f64::INFINITY, None);
        for z in -reach..=reach {
            for x in -reach..=reach {
                let Some(index) = self.cell_at(point + steps(x, z)) else { continue };
                let distance = (self.point(index) - point).reject_from(DVec3::Y).length();
                if self.grid.free[index] && distance < nearest.0 {
                    nearest = (distance, Some(index));
                }
            }
        }
        nearest.1
    }

    /// Free cells from which the ball touches a sphere-like thing, with something to spare.
    pub fn cells_touching(&self, center: DVec3, radius: f64) -> Vec<usize> {
        // Well inside: the ball shall not have to aim.
        const DEPTH: f64 = 0.85;
        let reach = DEPTH * (radius + self.radius);
        let near = |&index: &usize| {
            self.grid.free[index] && self.point(index).distance_squared(center) <= reach * reach
        };
        (0..self.len()).filter(near).collect()
    }

    /// Free cells from which the ball touches an end wall.
    pub fn cells_at_end_walls(&self) -> Vec<usize> {
        (0..self.len()).filter(|&index| self.at_end_wall[index]).collect()
    }

    /// Cost of the way from any of some cells to each; infinite where there is none.
    pub fn costs_from(&self, cells: &[usize]) -> Vec<f64> {
        self.costs(cells, |_| 1.0)
    }

    /// Cost of the way from any of some cells to each, `extra` times as much in each cell as it says;
    /// infinite where there is none.
    pub fn costs(&self, cells: &[usize], extra: impl Fn(usize) -> f64) -> Vec<f64> {
        route::costs(&self.grid, cells, extra)
    }

    /// Neighbours of a cell, with their distance \[cells\].
    pub fn neighbours(&self, index: usize) -> impl Iterator<Item = (usize, f64)> {
        self.grid.neighbours(index)
    }

    /// Whether the ball can go from one point to another on a straight line.
    pub fn sees(&self, from: DVec3, to: DVec3) -> bool {
        // Where the ball is, it is: against a wall, the middle of its cell may be blocked.
        const AROUND_THE_BALL: f64 = 1.5;
        let way = (to - from).reject_from(DVec3::Y);
        let length = way.length();
        let steps = (2.0 * length / self.grid.cell).ceil();
        (1..=steps as usize).all(|step| {
            let part = step as f64 / steps;
            let is_free = |point| self.cell_at(point).is_some_and(|index| self.grid.free[index]);
            part * length < AROUND_THE_BALL * self.grid.cell || is_free(from + part * way)
        })
    }
}

/// Corners of a box about all that the ball can roll between \[m\].
pub(crate) fn bounds(maze: &Maze) -> [DVec3; 2] {
    let mut bounds = [maze.start(); 2];
    for collider in maze.with_role(|role| role != Role::Ceiling) {
        use carom_scene::scene::Shape;
        // Half-spaces have no end; what else there is, and the start, bounds the way.
        let half = match collider.shape {
            Shape::Sphere { radius } => radius,
            Shape::Rectangle { size_x, size_z } => 0.5 * size_x.max(size_z),
            Shape::Box { size } | Shape::Container { size, .. } => {
                0.5 * DVec3::from_array(size).length()
            }
            Shape::HalfSpace => 0.0,
        };
        let center = DVec3::from_array(collider.position);
        bounds[0] = bounds[0].min(center - half);
        bounds[1] = bounds[1].max(center + half);
    }
    bounds
}

/// Whether the ball can be at a place: on some ground, and in no wall.
fn is_free(maze: &Maze, world: &World, point: DVec3) -> bool {
    let radius = maze.ball_radius();
    let bottom = point.y - radius;
    let mut grounds = maze.with_role(|role| role == Role::Ground);
    let is_ground = |height: f64| (height - bottom).abs() <= LIFT * radius;
    let is_borne = grounds.any(|it| ground_height(it, point).is_some_and(is_ground));
    let lifted = point + LIFT * radius * DVec3::Y;
    is_borne && !world.meets_collider(lifted, (1.0 - SMALLER) * radius)
}
