//! Costs of the ways to collectibles and end walls.

use carom::DVec3;

use crate::floor::Floor;
use crate::maze::Maze;

/// Costs of ways over the floor to each collectible and to the end walls.
#[derive(Debug, Clone)]
pub(crate) struct Ways {
    floor: Floor,
    /// The nearest free cell of each cell; `None` if none is near.
    nearest: Vec<Option<u32>>,
    /// For each collectible, the cost from each cell \[m\]; infinite if there is no way.
    to_collectibles: Vec<Vec<f32>>,
    to_end_walls: Vec<f32>,
}

impl Ways {
    pub fn new(maze: &Maze, floor: Floor) -> Self {
        let costs = |cells: Vec<usize>| -> Vec<f32> {
            floor.costs_from(&cells).into_iter().map(|cost| cost as f32).collect()
        };
        let touching = |(center, radius)| costs(floor.cells_touching(center, radius));
        let to_collectibles = maze.collectible_spheres().map(touching).collect();
        let to_end_walls = costs(floor.cells_at_end_walls());
        let near = |index| floor.cell_near(floor.point(index)).map(|cell| cell as u32);
        let nearest = (0..floor.len()).map(near).collect();
        Self { floor, nearest, to_collectibles, to_end_walls }
    }

    /// Returns the cost of the way \[m\] from a position to the nearest remaining collectible, or
    /// to an end wall if none can be reached; `None` off the floor and where there is no way.
    pub fn to_goal(&self, place: DVec3, taken: u64) -> Option<f64> {
        let cell = self.nearest[self.floor.cell_at(place)?]? as usize;
        let left = self.to_collectibles.iter().enumerate();
        let left = left.filter(|(index, _)| taken >> index & 1 == 0);
        let nearest = left.map(|(_, costs)| costs[cell]).fold(f32::INFINITY, f32::min);
        let cost = if nearest.is_finite() { nearest } else { self.to_end_walls[cell] };
        cost.is_finite().then_some(cost.into())
    }
}
