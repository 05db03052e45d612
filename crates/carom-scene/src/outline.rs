//! Outlines of shapes of revolution, for pictures and meshes.

use std::f64::consts::{FRAC_PI_2, PI};

use carom::{DVec3, Ends, Shape};

/// How many pieces half a circle has.
const ALONG: usize = 32;

/// A point of an outline: distance from the axis and height along it \[m\].
pub type Point = [f64; 2];

/// Returns whether a shape is one of revolution, other than a sphere.
pub fn is_round(shape: &Shape) -> bool {
    half_lengths(shape).is_some()
}

/// Returns half the lengths of the box around a shape of revolution \[m\]; `None` for other shapes.
pub fn half_lengths(shape: &Shape) -> Option<DVec3> {
    let (radius, height) = match *shape {
        Shape::Cylinder { radius, height: length } | Shape::Pipe { radius, length, .. } => {
            (radius, 0.5 * length)
        }
        Shape::Cone { bottom_radius, top_radius, height }
        | Shape::Funnel { bottom_radius, top_radius, height } => {
            (bottom_radius.max(top_radius), 0.5 * height)
        }
        Shape::Capsule { radius, length } => (radius, radius + 0.5 * length),
        Shape::Disc { radius } => (radius, 0.0),
        Shape::Torus { ring_radius, tube_radius } => (ring_radius + tube_radius, tube_radius),
        Shape::Bowl { radius, .. } => (radius, radius),
        _ => return None,
    };
    Some(DVec3::new(radius, height, radius))
}

/// Returns whether a shape is a wall without thickness.
pub fn is_hollow(shape: &Shape) -> bool {
    matches!(shape, Shape::Pipe { .. } | Shape::Bowl { .. } | Shape::Funnel { .. })
}

/// Returns the outlines of a shape of revolution, as lists of points; each turns its left side outward.
pub fn outlines(shape: &Shape) -> Vec<Vec<Point>> {
    match *shape {
        Shape::Cylinder { radius, height } => {
            vec![side(radius, radius, height), top(radius, height), bottom(radius, height)]
        }
        Shape::Cone { bottom_radius, top_radius, height } => vec![
            side(bottom_radius, top_radius, height),
            top(top_radius, height),
            bottom(bottom_radius, height),
        ],
        Shape::Funnel { bottom_radius, top_radius, height } => {
            vec![side(bottom_radius, top_radius, height)]
        }
        Shape::Pipe { radius, length, closed: Ends { bottom: at_bottom, top: at_top } } => {
            let mut outlines = vec![side(radius, radius, length)];
            outlines.extend(at_top.then(|| top(radius, length)));
            outlines.extend(at_bottom.then(|| bottom(radius, length)));
            outlines
        }
        Shape::Capsule { radius, length } => {
            let half = 0.5 * length;
            let mut outline = arc([0.0, half], radius, [FRAC_PI_2, 0.0]);
            outline.extend(arc([0.0, -half], radius, [0.0, -FRAC_PI_2]));
            vec![outline]
        }
        Shape::Disc { radius } => vec![top(radius, 0.0)],
        Shape::Torus { ring_radius, tube_radius } => {
            vec![arc([ring_radius, 0.0], tube_radius, [PI, -PI])]
        }
        Shape::Bowl { radius, opening } => {
            vec![arc([0.0, 0.0], radius, [FRAC_PI_2 - opening, -FRAC_PI_2])]
        }
        _ => Vec::new(),
    }
}

/// Returns the side from top to bottom, in pieces: on a cone they differ in width.
fn side(bottom_radius: f64, top_radius: f64, height: f64) -> Vec<Point> {
    let pieces = if bottom_radius == top_radius { 1 } else { ALONG };
    let point = |number: usize| {
        let part = number as f64 / pieces as f64;
        [top_radius + part * (bottom_radius - top_radius), height * (0.5 - part)]
    };
    (0..=pieces).map(point).collect()
}

/// Returns the disc at the upper end, from the axis outward.
fn top(radius: f64, height: f64) -> Vec<Point> {
    let rings = ALONG / 4;
    let point = |number: usize| [radius * number as f64 / rings as f64, 0.5 * height];
    if radius > 0.0 { (0..=rings).map(point).collect() } else { Vec::new() }
}

/// Returns the disc at the lower end, inward to the axis.
fn bottom(radius: f64, height: f64) -> Vec<Point> {
    top(radius, -height).into_iter().rev().collect()
}

/// Returns an arc about a centre, between two angles from the way outward \[rad\].
fn arc([x, y]: Point, radius: f64, [from, to]: [f64; 2]) -> Vec<Point> {
    let pieces = ((to - from).abs() / PI * ALONG as f64).ceil().max(1.0) as usize;
    let point = |number: usize| {
        let angle = from + (to - from) * number as f64 / pieces as f64;
        [(x + radius * libm::cos(angle)).max(0.0), y + radius * libm::sin(angle)]
    };
    (0..=pieces).map(point).collect()
}
