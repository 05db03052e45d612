//! Random surfaces of triangles: closed ones, open ones with holes, several sheets at one edge, and triangles that cross
//! each other.

use proptest::collection::vec;
use proptest::prelude::*;

use super::vector::{Vector, scaled};

/// Vertices \[m\], and triangles of three of them each.
type Triangles = (Vec<Vector>, Vec<[usize; 3]>);

/// Draws the shape of a collider, as written in scene files.
pub fn mesh() -> impl Strategy<Value = String> {
    let numbers = vec([-1.0..1.0, -1.0..1.0, -1.0..1.0f64], 36);
    (0..4, numbers, 2..5usize, any::<bool>()).prop_map(|(kind, numbers, size, is_one_sided)| {
        let (vertices, triangles) = match kind {
            0 => ball(&numbers, size > 2),
            1 => sheet(&numbers, size),
            2 => fan(&numbers, size + 1),
            _ => crossing(&numbers, size),
        };
        let side = if is_one_sided { ", one_sided = true" } else { "" };
        format!("{{ mesh = {{ vertices = {vertices:?}, triangles = {triangles:?}{side} }} }}")
    })
}

/// A closed surface around the origin, of 8 or 32 triangles.
fn ball(numbers: &[Vector], is_fine: bool) -> Triangles {
    let mut vertices: Vec<Vector> = (0..6)
        .map(|it| {
            let mut direction = [0.0; 3];
            direction[it / 2] = if it % 2 == 0 { 1.0 } else { -1.0 };
            direction
        })
        .collect();
    let mut triangles = Vec::new();
    for signs in 0..8_usize {
        let [x, y, z] = [0, 1, 2].map(|axis| 2 * axis + (signs >> axis & 1));
        let is_even = signs.count_ones() % 2 == 0;
        triangles.push(if is_even { [x, y, z] } else { [x, z, y] });
    }
    if is_fine {
        triangles = triangles.iter().flat_map(|it| divided(*it, &mut vertices)).collect();
    }
    for (vertex, [number, ..]) in vertices.iter_mut().zip(numbers) {
        *vertex = scaled(*vertex, 0.45 + 0.25 * number);
    }
    (vertices, triangles)
}

/// A triangle on the unit sphere as four.
fn divided([a, b, c]: [usize; 3], vertices: &mut Vec<Vector>) -> [[usize; 3]; 4] {
    let [d, e, f] = [[a, b], [b, c], [c, a]].map(|ends| {
        let [one, other] = ends.map(|it| vertices[it]);
        // Ends are a quarter of a circle apart.
        let middle = [0, 1, 2].map(|axis| (one[axis] + other[axis]) * 0.5_f64.sqrt());
        vertices.iter().position(|it| *it == middle).unwrap_or_else(|| {
            vertices.push(middle);
            vertices.len() - 1
        })
    });
    [[a, d, f], [d, b, e], [f, e, c], [d, e, f]]
}

/// A rough sheet with `size` cells along each side; some of its triangles are missing.
fn sheet(numbers: &[Vector], size: usize) -> Triangles {
    let width = size + 1;
    let place = |it: usize| {
        let [x, y, z] = numbers[it];
        let along =
            |number: usize, beside: f64| 1.4 * ((number as f64 + 0.3 * beside) / size as f64 - 0.5);
        [along(it % width, x), 0.25 * y, along(it / width, z)]
    };
    let mut triangles = Vec::new();
    for (cell, number) in numbers.iter().enumerate().take(size * size) {
        let first = cell / size * width + cell % size;
        let corners = [first, first + 1, first + width, first + width + 1];
        let [a, b, c, d] = corners;
        let halves = if number[2] > 0.0 { [[a, c, b], [b, c, d]] } else { [[a, c, d], [a, d, b]] };
        let kept = halves.into_iter().enumerate().filter(|(half, _)| number[*half] > -0.6);
        triangles.extend(kept.map(|(_, triangle)| triangle));
    }
    if triangles.is_empty() {
        triangles.push([0, width, 1]);
    }
    ((0..width * width).map(place).collect(), triangles)
}

/// Rectangles with one common edge.
fn fan(numbers: &[Vector], count: usize) -> Triangles {
    let mut vertices = vec![[0.0, 0.0, -0.5], [0.0, 0.0, 0.5]];
    let mut triangles = Vec::new();
    for [x, y, length] in numbers.iter().take(count) {
        let factor = (0.5 + 0.2 * length) / (x * x + y * y).sqrt().max(0.1);
        let first = vertices.len();
        vertices.extend([-0.5, 0.5].map(|z| [factor * x, factor * y, z]));
        triangles.extend([[0, 1, first], [first, 1, first + 1]]);
    }
    (vertices, triangles)
}

/// Triangles that share no vertices and may cross each other.
fn crossing(numbers: &[Vector], count: usize) -> Triangles {
    let vertices = numbers.iter().take(3 * count).map(|it| scaled(*it, 0.6)).collect();
    (vertices, (0..count).map(|it| [3 * it, 3 * it + 1, 3 * it + 2]).collect())
}
