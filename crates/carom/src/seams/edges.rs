//! Edges without the parts that flush faces cover.

use glam::DVec3;

use super::face::{FLAT, FlushFace};
use crate::mesh::{Edge, Facet};
use crate::norm::Norm;

/// Parts of an edge that no face covers. Those no longer than `least` \[m\] count as covered.
pub(super) fn uncovered(edge: &Edge, faces: &[&FlushFace], least: f64) -> Vec<Edge> {
    let [first, second] = edge.outward;
    if first != second {
        return parts(edge, faces, least);
    }
    // It is met from both sides of its face: each may be covered by another face.
    let normal = edge.axis.cross(first);
    let halves = [normal, -normal].map(|it| Edge { outward: [first, it], ..*edge });
    let left: Vec<Edge> = halves.iter().flat_map(|half| parts(half, faces, least)).collect();
    if left == halves { vec![*edge] } else { left }
}

/// Parts of a one-sided edge that no face covers.
fn parts(edge: &Edge, faces: &[&FlushFace], least: f64) -> Vec<Edge> {
    let mut covered: Vec<[f64; 2]> = faces.iter().flat_map(|face| intervals(edge, face)).collect();
    if covered.is_empty() {
        return vec![*edge];
    }
    covered.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let (mut left, mut from) = (Vec::new(), -edge.half);
    for [start, end] in covered.into_iter().chain([[edge.half; 2]]) {
        if start - from > least {
            let center = edge.center + 0.5 * (from + start) * edge.axis;
            left.push(Edge { center, half: 0.5 * (start - from), ..*edge });
        }
        from = from.max(end);
    }
    left
}

/// Intervals of an edge in which a face continues one of the faces that end there, from the middle of the edge \[m\].
fn intervals(edge: &Edge, face: &FlushFace) -> Vec<[f64; 2]> {
    let [one, other] = edge.outward;
    let continues = |[outward, other]: [DVec3; 2]| {
        let across = edge.axis.cross(outward);
        let normal = if across.dot(other) < 0.0 { -across } else { across };
        let height = (edge.center - face.point).dot(face.normal);
        (normal - face.normal).norm() <= 2.0 * FLAT && height.abs() <= face.step(edge.half)
    };
    let sides = [[one, other], [other, one]].into_iter().filter(|it| continues(*it));
    sides
        .flat_map(|[outward, _]| match &face.facet {
            None => vec![[-edge.half, edge.half]],
            Some(facet) => under(facet, edge, edge.center + 2.0 * face.gap * outward, face.gap),
        })
        .collect()
}

/// Intervals in which a line through a place \[m\] along an edge is inside a facet, or beside it by a gap \[m\] at
/// most.
fn under(facet: &Facet, edge: &Edge, through: DVec3, gap: f64) -> Vec<[f64; 2]> {
    let start = facet.local(through);
    let along = facet.local_direction(edge.axis);
    let mut breaks = vec![-edge.half, edge.half];
    for side in facet.outline.sides() {
        let [first, second] = side.ends.map(|end| (end - start).perp_dot(along));
        let [from, to] = side.ends.map(|end| (end - start).dot(along));
        // Beside the line by no more than the gap at one end, or on both sides of it.
        for (beside, place) in [(first, from), (second, to)] {
            if beside.abs() <= gap {
                breaks.push(place);
            }
        }
        if (first > 0.0) != (second > 0.0) {
            breaks.push(from + (to - from) * (first / (first - second)));
        }
    }
    breaks.retain(|it| it.abs() <= edge.half);
    breaks.sort_by(f64::total_cmp);
    let is_under = |pair: &&[f64]| {
        let middle = start + 0.5 * (pair[0] + pair[1]) * along;
        facet.outline.is_within(middle, gap)
    };
    let inside = breaks.windows(2).filter(is_under);
    inside.map(|pair| [pair[0] - 2.0 * gap, pair[1] + 2.0 * gap]).collect()
}
