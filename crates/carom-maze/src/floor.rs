//! The free floor: a grid of the positions that the ball's centre can have.

use carom::{DVec3, World};

use crate::error::MazeError;
use crate::grid::Grid;
use crate::maze::{Maze, Role, ground_height, round_reach};
use crate::route;

/// Cells per radius of the ball: fine enough for ways that are a third of a radius wider than the
/// ball.
const CELLS_PER_RADIUS: f64 = 6.0;
/// Largest number of cells along a side; a larger ground gets coarser cells.
const MOST_CELLS: f64 = 1000.0;
/// Height by which the ball is lifted, and part by which it is shrunk, in a test for overlap
/// \[radii\]: more than rounding, less than the space under a ceiling.
const LIFT: f64 = 0.01;
const SMALLER: f64 = 0.008;
/// Distance beyond its radius at which the ball counts as touching an end wall \[cells\].
const NEAR_END_WALL: f64 = 1.5;

/// Free and blocked cells in the plane of the floor, in the maze's own frame.
#[derive(Debug, Clone)]
pub(crate) struct Floor {
    /// Middle of the first cell, at the height of the ball's centre \[m\].
    origin: DVec3,
    grid: Grid,
    /// Whether the ball in a cell touches an end wall, or nearly does.
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

    /// Returns which cells are free and touch an end wall.
    fn touching_end_walls(&self, maze: &Maze, points: &[DVec3]) -> Result<Vec<bool>, MazeError> {
        let mut ends = maze.scene().clone();
        ends.colliders = maze.with_role(|role| role == Role::EndWall).cloned().collect();
        let ends = ends.world()?;
        let reach = self.radius + NEAR_END_WALL * self.grid.cell;
        let touches = |(index, &point)| self.grid.free[index] && ends.meets_collider(point, reach);
        Ok(points.iter().enumerate().map(touches).collect())
    }

    /// Returns the centre of the ball in the middle of a cell \[m\].
    pub fn point(&self, index: usize) -> DVec3 {
        let (column, row) = (index % self.grid.columns, index / self.grid.columns);
        self.origin + self.grid.cell * DVec3::new(column as f64, 0.0, row as f64)
    }

    /// Returns the edge of a cell \[m\].
    pub fn cell(&self) -> f64 {
        self.grid.cell
    }

    /// Returns the distance of a cell from the nearest blocked cell \[m\].
    pub fn clearance(&self, index: usize) -> f64 {
        self.grid.clearance(index)
    }

    pub fn is_at_end_wall(&self, index: usize) -> bool {
        self.at_end_wall[index]
    }

    pub fn len(&self) -> usize {
        self.grid.len()
    }

    /// Returns the cell that contains a point.
    pub fn cell_at(&self, point: DVec3) -> Option<usize> {
        let place = (point - self.origin) / self.grid.cell;
        let (column, row) = ((place.x + 0.5).floor(), (place.z + 0.5).floor());
        let is_inside = (0.0..self.grid.columns as f64).contains(&column)
            && (0.0..self.grid.rows as f64).contains(&row);
        is_inside.then(|| row as usize * self.grid.columns + column as usize)
    }

    /// Returns the free cell nearest to a point, at most half a radius away.
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

    /// Returns the free cells from which the ball touches a sphere, with a margin.
    pub fn cells_touching(&self, center: DVec3, radius: f64) -> Vec<usize> {
        // Well inside, so that the ball need not aim.
        const DEPTH: f64 = 0.85;
        let reach = DEPTH * (radius + self.radius);
        let near = |&index: &usize| {
            self.grid.free[index] && self.point(index).distance_squared(center) <= reach * reach
        };
        (0..self.len()).filter(near).collect()
    }

    /// Returns the free cells from which the ball touches an end wall.
    pub fn cells_at_end_walls(&self) -> Vec<usize> {
        (0..self.len()).filter(|&index| self.at_end_wall[index]).collect()
    }

    /// Returns the cost of the way from the nearest of `cells` to each cell; infinite if there is
    /// none.
    pub fn costs_from(&self, cells: &[usize]) -> Vec<f64> {
        self.costs(cells, |_| 1.0)
    }

    /// Returns the cost of the way from the nearest of `cells` to each cell, multiplied in each
    /// cell by `extra`; infinite if there is none.
    pub fn costs(&self, cells: &[usize], extra: impl Fn(usize) -> f64) -> Vec<f64> {
        route::costs(&self.grid, cells, extra)
    }

    /// Returns the neighbours of a cell with their distance \[cells\].
    pub fn neighbours(&self, index: usize) -> impl Iterator<Item = (usize, f64)> {
        self.grid.neighbours(index)
    }

    /// Returns whether the ball can go straight from one point to another.
    pub fn sees(&self, from: DVec3, to: DVec3) -> bool {
        // The ball's own position is free, even if the middle of its cell near a wall is blocked.
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

/// Returns two corners of a box around everything that the ball can roll between \[m\].
pub(crate) fn bounds(maze: &Maze) -> [DVec3; 2] {
    let mut bounds = [maze.start(); 2];
    for collider in maze.with_role(|role| role != Role::Ceiling) {
        use carom_scene::scene::Shape;
        // Half-spaces have no end; other colliders and the start bound the way.
        let half = match collider.shape {
            Shape::Sphere { radius } => radius,
            Shape::Rectangle { size_x, size_z } => 0.5 * size_x.max(size_z),
            Shape::Box { size } | Shape::Container { size, .. } => {
                0.5 * DVec3::from_array(size).length()
            }
            Shape::HalfSpace => 0.0,
            ref round => round_reach(round),
        };
        let center = DVec3::from_array(collider.position);
        bounds[0] = bounds[0].min(center - half);
        bounds[1] = bounds[1].max(center + half);
    }
    bounds
}

/// Returns whether the ball can be at a position: on ground and in no wall.
fn is_free(maze: &Maze, world: &World, point: DVec3) -> bool {
    let radius = maze.ball_radius();
    let bottom = point.y - radius;
    let mut grounds = maze.with_role(|role| role == Role::Ground);
    let is_ground = |height: f64| (height - bottom).abs() <= LIFT * radius;
    let is_borne = grounds.any(|it| ground_height(it, point).is_some_and(is_ground));
    let lifted = point + LIFT * radius * DVec3::Y;
    is_borne && !world.meets_collider(lifted, (1.0 - SMALLER) * radius)
}
