//! The part of a surface at rest that a sphere lies on, without its borders.

use glam::DVec3;

use super::curvature::NormalCurvature;
use super::separation::{are_within, is_over_face, separation};
use crate::band::{Band, View};
use crate::norm::Norm;
use crate::surface::Form;

/// A part of a surface at rest, as if it went on past its borders.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Feature {
    /// A plane with this normal.
    Plane(DVec3),
    /// A line through a point \[m\] along a unit vector.
    Line { point: DVec3, axis: DVec3 },
    /// A point, or a sphere about it \[m\].
    Point(DVec3),
    /// The face of a surface of revolution.
    Face(Band),
    /// The rim of a surface of revolution.
    Rim(Band),
}

impl Feature {
    /// The part of a surface that has a sphere of this radius \[m\] with this centre \[m\] and velocity \[m/s\], which
    /// touches the surface; `None` for forms without parts.
    pub fn under(form: &Form, [center, velocity]: [DVec3; 2], radius: f64) -> Option<Self> {
        let separation = separation(form, center, radius, true)?;
        let point = separation.point;
        Some(match form {
            Form::HalfSpace { normal, .. } => Self::Plane(*normal),
            Form::Facet(_) => Self::Plane(separation.normal),
            Form::Rectangle(rectangle) => match are_within(rectangle, [center, velocity]) {
                [true, true] => Self::Plane(rectangle.normal),
                [false, true] => Self::Line { point, axis: rectangle.axis_z },
                [true, false] => Self::Line { point, axis: rectangle.axis_x },
                [false, false] => Self::Point(point),
            },
            Form::Edge(edge) => Self::Line { point, axis: edge.axis },
            Form::Corner(_) => Self::Point(point),
            Form::Sphere { center, .. } => Self::Point(*center),
            Form::Band(band) if is_over_face(band, [center, velocity]) => Self::Face(*band),
            Form::Band(band) => Self::Rim(*band),
            Form::Box(_) | Form::Round(_) | Form::Closed(_) => return None,
        })
    }

    /// Unit normal at a sphere's centre \[m\], and how it turns.
    pub fn normal_at(&self, center: DVec3) -> (DVec3, NormalCurvature) {
        let of_view = |View { normal, directions, curvatures, .. }: View| {
            (normal, NormalCurvature::Principal { directions, curvatures })
        };
        match *self {
            Self::Plane(normal) => (normal, NormalCurvature::Flat),
            Self::Line { point, axis } => {
                let offset = center - point;
                let across = offset - offset.dot(axis) * axis;
                (across / across.norm(), NormalCurvature::Edge(axis, across.norm()))
            }
            Self::Point(point) => {
                let offset = center - point;
                (offset / offset.norm(), NormalCurvature::RoundFeature(offset.norm()))
            }
            Self::Face(band) => of_view(band.face_seen_from(center)),
            Self::Rim(band) => of_view(band.rim_seen_from(center)),
        }
    }
}
