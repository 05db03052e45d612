//! Flat faces that may be flush with others.

use glam::DVec3;

use crate::mesh::Facet;
use crate::norm::Norm;
use crate::surface::Form;

/// Angle \[rad\] between the normals of two faces in one plane, at most.
pub(super) const FLAT: f64 = 1e-9;
/// Height of a step that counts as none, at most, as a part of the size of the smaller face.
const STEP: f64 = 1e-9;
/// Width of a gap that counts as none, at most, as a part of the coordinates: their rounding, and less than the
/// distance at which a point counts for both sides of a border (`mesh/facet.rs`).
const GAP: f64 = 64.0 * f64::EPSILON;

/// A flat face.
#[derive(Debug, Clone)]
pub(super) struct FlushFace {
    /// A point of its plane \[m\].
    pub point: DVec3,
    pub normal: DVec3,
    /// The face with its outline; `None` for a half-space, which covers all of its plane.
    pub facet: Option<Facet>,
    /// Half of its size \[m\].
    size: f64,
    /// Rounding of places beside it \[m\].
    pub gap: f64,
}

impl FlushFace {
    /// A flat surface beside a place \[m\]; `None` if it is not flat.
    pub fn of(form: &Form, beside: DVec3) -> Option<Self> {
        let facet = match form {
            &Form::HalfSpace { point, normal } => {
                let gap = GAP * (point.norm() + beside.norm());
                return Some(Self { point, normal, facet: None, size: f64::INFINITY, gap });
            }
            Form::Rectangle(rectangle) => Facet::of_rectangle(*rectangle),
            Form::Facet(facet) => facet.clone(),
            _ => return None,
        };
        let (point, normal) = (facet.frame.center, facet.frame.normal);
        let size = facet.frame.half_x + facet.frame.half_z;
        let gap = GAP * (form.coordinates() + beside.norm());
        Some(Self { point, normal, facet: Some(facet), size, gap })
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
