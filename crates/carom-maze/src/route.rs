//! Ways over the free floor: costs from some cells to all others.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::floor::Floor;

/// A way that is this far from walls costs its length; nearer to them more \[m\].
const COMFORTABLE: f64 = 0.25;
/// How much more a way costs along a wall.
const ALONG_A_WALL: f64 = 4.0;

/// The eight neighbours of a cell: columns, rows, and distance in cells.
const NEIGHBOURS: [(isize, isize, f64); 8] = [
    (-1, 0, 1.0),
    (1, 0, 1.0),
    (0, -1, 1.0),
    (0, 1, 1.0),
    (-1, -1, std::f64::consts::SQRT_2),
    (1, -1, std::f64::consts::SQRT_2),
    (-1, 1, std::f64::consts::SQRT_2),
    (1, 1, std::f64::consts::SQRT_2),
];

/// Neighbours of a cell, with their distance \[cells\].
pub(crate) fn neighbours(floor: &Floor, index: usize) -> impl Iterator<Item = (usize, f64)> {
    let (columns, rows) = (floor.columns, floor.rows);
    let (column, row) = (index % columns, index / columns);
    NEIGHBOURS.into_iter().filter_map(move |(x, z, distance)| {
        let column = column.checked_add_signed(x).filter(|&it| it < columns)?;
        let row = row.checked_add_signed(z).filter(|&it| it < rows)?;
        Some((row * columns + column, distance))
    })
}

/// Cost of the way \[m\] from any of some cells to each free cell, and infinity where there is none
/// (Dijkstra). A way near walls costs more, and `extra` times as much in each cell as it says.
pub(crate) fn costs(floor: &Floor, from: &[usize], extra: impl Fn(usize) -> f64) -> Vec<f64> {
    let price = |index: usize| {
        let near = (1.0 - floor.clearance(index) / COMFORTABLE).max(0.0);
        floor.cell * (1.0 + ALONG_A_WALL * near) * extra(index)
    };
    let step = |index: usize, distance| floor.is_free(index).then(|| price(index) * distance);
    spread(floor, from, step)
}

/// Distance to the nearest cell that is not free, or to the edge \[cells\].
pub(crate) fn clearance(floor: &Floor) -> Vec<f64> {
    let blocked: Vec<usize> = (0..floor.len()).filter(|&index| !floor.is_free(index)).collect();
    spread(floor, &blocked, |_, distance| Some(distance))
}

/// Least cost from any of some cells to each, where `step` gives the cost of entering a cell from a
/// neighbour at a distance \[cells\], if it can be entered.
fn spread(floor: &Floor, from: &[usize], step: impl Fn(usize, f64) -> Option<f64>) -> Vec<f64> {
    let mut costs = vec![f64::INFINITY; floor.len()];
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
        for (next, distance) in neighbours(floor, index) {
            let Some(step) = step(next, distance) else { continue };
            if cost + step < costs[next] {
                costs[next] = cost + step;
                open.push(Reverse(((cost + step).to_bits(), next)));
            }
        }
    }
    costs
}
