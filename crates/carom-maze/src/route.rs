//! Ways over the free floor: costs from some cells to all others.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::grid::Grid;

/// A way that is this far from walls costs its length; nearer to them more \[m\].
const COMFORTABLE: f64 = 0.25;
/// How much more a way costs along a wall.
const ALONG_A_WALL: f64 = 4.0;

/// Cost of the way \[m\] from any of some cells to each free cell, and infinity where there is none
/// (Dijkstra). A way near walls costs more, and `extra` times as much in each cell as it says.
pub(crate) fn costs(grid: &Grid, from: &[usize], extra: impl Fn(usize) -> f64) -> Vec<f64> {
    let price = |index: usize| {
        let near = (1.0 - grid.clearance(index) / COMFORTABLE).max(0.0);
        grid.cell * (1.0 + ALONG_A_WALL * near) * extra(index)
    };
    let step = |index: usize, distance| grid.free[index].then(|| price(index) * distance);
    spread(grid, from, step)
}

/// Distance to the nearest cell that is not free, or to the edge \[cells\].
pub(crate) fn clearance(grid: &Grid) -> Vec<f64> {
    let blocked: Vec<usize> = (0..grid.len()).filter(|&index| !grid.free[index]).collect();
    spread(grid, &blocked, |_, distance| Some(distance))
}

/// Least cost from any of some cells to each, where `step` gives the cost of entering a cell from a
/// neighbour at a distance \[cells\], if it can be entered.
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
