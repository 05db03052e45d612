//! Shapes of revolution, as narrow rectangles that lie on them and are shaded as if they were curved.

use std::f64::consts::{PI, TAU};

use carom::{DQuat, DVec3, Pose};
use carom_scene::outline::{Point, half_lengths, outlines};
use glam::DMat3;

use crate::drawing::Panel;

/// Number of rectangles around the axis.
const AROUND: usize = 96;

/// A narrow rectangle that lies on a surface of revolution: local x is along the outline, y the normal, z around.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Facet {
    pub pose: Pose,
    /// Half the lengths along local x and z \[m\].
    pub half: [f64; 2],
    /// Curvatures of the surface along local x and z \[1/m\]: positive where it bulges.
    pub curvatures: [f64; 2],
}

impl Facet {
    /// Returns whether a point is in front of the surface.
    pub fn faces(&self, point: DVec3) -> bool {
        (self.pose.rotation * DVec3::Y).dot(point - self.pose.position) > 0.0
    }

    /// Returns the other side.
    pub fn turned(self) -> Self {
        let rotation = self.pose.rotation * DQuat::from_rotation_x(PI);
        Self {
            pose: self.pose.rotated(rotation),
            curvatures: self.curvatures.map(|curvature| -curvature),
            ..self
        }
    }
}

/// Returns the facets of a panel of revolution, facing outward.
pub(crate) fn facets(panel: &Panel) -> impl Iterator<Item = Facet> {
    let pose = panel.pose;
    outlines(&panel.shape).into_iter().flat_map(move |outline| {
        let pieces: Vec<[Point; 2]> = outline.windows(2).map(|it| [it[0], it[1]]).collect();
        let bend = bend_of(&pieces);
        pieces
            .into_iter()
            .flat_map(move |piece| (0..AROUND).map(move |number| facet(pose, piece, bend, number)))
    })
}

/// Returns narrow strips along the open ends of a hollow shape.
pub(crate) fn rims(panel: &Panel) -> impl Iterator<Item = Facet> {
    /// Part of the size of the shape.
    const WIDTH: f64 = 0.015;
    let pose = panel.pose;
    let width = half_lengths(&panel.shape).map_or(0.0, |it| WIDTH * it.max_element());
    let ends = outlines(&panel.shape).into_iter().take(1).flat_map(move |outline| {
        let strip = |[from, to]: [Point; 2]| {
            let length = (to[0] - from[0]).hypot(to[1] - from[1]);
            let at = |axis: usize| from[axis] + (to[axis] - from[axis]) * (width / length).min(1.0);
            [from, [at(0), at(1)]]
        };
        let last = outline.len() - 1;
        // On the outside it faces the other way.
        [strip([outline[0], outline[1]]), strip([outline[last], outline[last - 1]])]
    });
    let is_open = |piece: &[Point; 2]| piece[0][0] > 0.0;
    ends.filter(is_open)
        .flat_map(move |piece| (0..AROUND).map(move |number| facet(pose, piece, 0.0, number)))
}

/// Returns the curvature of an outline in equal pieces \[1/m\].
fn bend_of(pieces: &[[Point; 2]]) -> f64 {
    let [Some([a, b]), Some([_, c])] = [pieces.first(), pieces.get(1)] else { return 0.0 };
    let (first, second) = ([b[0] - a[0], b[1] - a[1]], [c[0] - b[0], c[1] - b[1]]);
    let lengths = first[0].hypot(first[1]) * second[0].hypot(second[1]);
    (second[0] * first[1] - second[1] * first[0]) / (lengths * lengths.sqrt())
}

/// Returns the facet over a piece of the outline, one of those around; it faces the left of the piece.
fn facet(place: Pose, [from, to]: [Point; 2], bend: f64, number: usize) -> Facet {
    let step = TAU / AROUND as f64;
    let (sin, cos) = ((number as f64 + 0.5) * step).sin_cos();
    let radial = DVec3::new(cos, 0.0, sin);
    let way = [to[0] - from[0], to[1] - from[1]];
    let length = way[0].hypot(way[1]);
    let along = (way[0] * radial + way[1] * DVec3::Y) / length;
    let normal = (-way[1] * radial + way[0] * DVec3::Y) / length;
    let local = DQuat::from_mat3(&DMat3::from_cols(along, normal, along.cross(normal)));
    let rotation = place.rotation.normalize();
    let [x, y] = [0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])];
    let position = place.position + rotation * (x * radial + y * DVec3::Y);
    // As wide as at the wider end: neighbours overlap, and leave no gap.
    let half_width = from[0].max(to[0]) * (0.5 * step).tan();
    Facet {
        pose: Pose { position, rotation: rotation * local },
        half: [0.5 * length, half_width],
        curvatures: [bend, -way[1] / length / x.max(1e-9 * length)],
    }
}
