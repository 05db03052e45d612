//! Flat faces that may be flush with others.

use std::sync::Arc;

use glam::DVec3;

use crate::bounds::Bounds;
use crate::detect::surface_tree;
use crate::mesh::Facet;
use crate::norm::Norm;
use crate::rectangle::Rectangle;
use crate::surface::Form;

/// Angle \[rad\] between the normals of two faces in one plane, at most.
pub(super) const FLAT: f64 = 1e-9;
/// Height of a step that counts as none, at most, as a part of the size of the smaller face.
const STEP: f64 = 1e-9;
/// Width of a gap that counts as none, at most, as a part of the coordinates: their rounding, and less than the
/// distance at which a point counts for both sides of a border (`mesh/facet.rs`).
const GAP: f64 = 64.0 * f64::EPSILON;
/// Distance from its bounds up to which a face may cover anything, as a part of its size and as a multiple of its gap:
/// far more than the height of a step and the width of a gap.
const REACH: [f64; 2] = [1e-6, 1e3];

/// A flat face.
#[derive(Debug, Clone)]
pub(super) struct FlushFace {
    /// A point of its plane \[m\].
    pub point: DVec3,
    pub normal: DVec3,
    /// The face with its outline; `None` for a half-space, which covers all of its plane.
    pub facet: Option<Arc<Facet>>,
    /// Half of its size \[m\].
    size: f64,
    /// Size of its coordinates \[m\].
    coordinates: f64,
    /// `None` for a half-space.
    bounds: Option<Bounds>,
    /// Rounding of places beside it \[m\].
    pub gap: f64,
}

/// Outlines of rectangles; equal rectangles in a row share theirs.
#[derive(Default)]
pub(super) struct Outlines {
    /// Half sides \[m\] of the last rectangles along the three axes of a box, with their faces.
    last: [Option<Facet>; 3],
}

impl Outlines {
    /// The face that fills a rectangle.
    fn fill(&mut self, frame: Rectangle) -> Facet {
        let is_equal =
            |it: &&Facet| (it.frame.half_x, it.frame.half_z) == (frame.half_x, frame.half_z);
        if let Some(known) = self.last.iter().flatten().find(is_equal) {
            return Facet { frame, outline: known.outline.clone() };
        }
        let made = Facet::of_rectangle(frame);
        self.last.rotate_right(1);
        self.last[0] = Some(made.clone());
        made
    }
}

impl FlushFace {
    /// A flat surface; `None` if it is not flat.
    pub fn of(form: &Form, outlines: &mut Outlines) -> Option<Self> {
        let (coordinates, bounds) = (form.coordinates(), surface_tree::bounds(form));
        let gap = GAP * coordinates;
        let facet = match form {
            &Form::HalfSpace { point, normal } => {
                let (facet, size) = (None, f64::INFINITY);
                return Some(Self { point, normal, facet, size, coordinates, bounds, gap });
            }
            Form::Rectangle(rectangle) => outlines.fill(*rectangle),
            Form::Facet(facet) => facet.clone(),
            _ => return None,
        };
        let (point, normal) = (facet.frame.center, facet.frame.normal);
        let size = facet.frame.half_x + facet.frame.half_z;
        let facet = Some(Arc::new(facet));
        Some(Self { point, normal, facet, size, coordinates, bounds, gap })
    }

    /// Returns the face with the rounding of places that are computed from one \[m\].
    pub fn beside(&self, place: DVec3) -> Self {
        Self { gap: GAP * (self.coordinates + place.norm()), ..self.clone() }
    }

    /// Returns whether it may cover something within bounds.
    pub fn may_cover(&self, bounds: &Bounds) -> bool {
        let reach = REACH[0] * self.size + REACH[1] * self.gap;
        self.bounds.is_none_or(|it| it.widened(reach).overlap(bounds))
    }

    /// Returns whether two faces lie in one plane and touch there.
    pub fn is_flush_with(&self, other: &Self) -> bool {
        let step = STEP * self.size.min(other.size) + self.gap + other.gap;
        let is_near =
            |face: &Self, point: DVec3| ((point - face.point).dot(face.normal)).abs() <= step;
        let is_level = match (&self.facet, &other.facet) {
            (None, _) => is_near(self, other.point),
            (_, None) => is_near(other, self.point),
            _ => is_near(self, other.point) && is_near(other, self.point),
        };
        is_level && (self.normal - other.normal).norm() <= FLAT && self.touches(other)
    }

    /// Returns whether the outlines of two faces in one plane touch.
    fn touches(&self, other: &Self) -> bool {
        let (Some(one), Some(two)) = (&self.facet, &other.facet) else { return true };
        let gap = self.gap + other.gap;
        let reaches = |from: &Facet, to: &Facet| from.vertices().any(|it| to.is_beside(it, gap));
        reaches(one, two) || reaches(two, one) || one.crosses(two)
    }

    /// Height \[m\] up to which a place on a body of this size \[m\] counts as in its plane.
    pub fn step(&self, size: f64) -> f64 {
        STEP * self.size.min(size) + 2.0 * self.gap
    }
}
