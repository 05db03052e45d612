//! Shortest ways over the free floor.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::grid::Grid;

/// Distance from walls above which a way costs its length \[m\]; nearer to walls it costs more.
const COMFORTABLE: f64 = 0.25;
/// Additional cost of a way along a wall, in lengths of the way.
const ALONG_A_WALL: f64 = 4.0;

/// Returns the cost of the way \[m\] from the nearest of the cells `from` to each free cell,
/// infinite if there is none (Dijkstra). A way near walls costs more; `extra` is a factor for each
/// cell.
pub(crate) fn costs(grid: &Grid, from: &[usize], extra: impl Fn(usize) -> f64) -> Vec<f64> {
    let price = |index: usize| {
        let near = (1.0 - grid.clearance(index) / COMFORTABLE).max(0.0);
        grid.cell * (1.0 + ALONG_A_WALL * near) * extra(index)
    };
    let step = |index: usize, distance| grid.free[index].then(|| price(index) * distance);
    spread(grid, from, step)
}

/// Returns the distance of each cell from the nearest blocked cell \[cells\].
pub(crate) fn clearance(grid: &Grid) -> Vec<f64> {
    let blocked: Vec<usize> = (0..grid.len()).filter(|&index| !grid.free[index]).collect();
    spread(grid, &blocked, |_, distance| Some(distance))
}

/// Returns the least cost from any of the cells `from` to each cell. `step` returns the cost of
/// entering a cell from a neighbour at a distance \[cells\], or `None` if it cannot be entered.
fn spread(grid: &Grid, from: &[usize], step: impl Fn(usize, f64) -> Option<f64>) -> Vec<f64> {
    let mut costs = vec![f64::INFINITY; grid.len()];
    let mut open = BinaryHeap::new();
    for &index in from {
        costs[index] = 0.0;
        open.push(Reverse((0_u64, index)));
    }
    while let Some(Reverse((bits, index))) = open.pop() {
        // The bits of numbers >= 0 are in the order of the numbers.
        let cost = f64::from_bits(bits);
        if cost > costs[index] {
            continue;
        }
        for (next, distance) in grid.neighbours(index) {
            let Some(step) = step(next, distance) else { continue };
            if cost + step < costs[next] {
                costs[next] = cost + step;
                open.push(Reverse(((cost + step).to_bits(), next)));
            }
        }
    }
    costs
}
