//! The part of a surface at rest that a sphere lies on, without its borders.

use glam::DVec3;

use super::curvature::NormalCurvature;
use super::separation::{are_within, is_over_face, separation};
use crate::band::{Band, View};
use crate::norm::Norm;
use crate::surface::Form;

/// A part of a surface of revolution.
#[derive(Debug, Clone, Copy)]
pub(crate) enum BandPart {
    Face,
    Rim,
}

/// A part of a surface at rest, as if it went on past its borders.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Feature {
    /// A plane with this normal.
    Plane(DVec3),
    /// A line through a point \[m\] along a unit vector.
    Line { point: DVec3, axis: DVec3 },
    /// A point, or a sphere about it \[m\].
    Point(DVec3),
    /// A part of a surface of revolution. In the section along a unit vector from the axis, if any, it is as if it went
    /// on past the axis.
    Part { band: Band, part: BandPart, section: Option<DVec3> },
    /// The side of a ring in a direction from the axis, a unit vector.
    Side { band: Band, side: DVec3 },
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
            Form::Band(band) if band.has_ring_about(center) => Self::Plane(separation.normal),
            Form::Band(band) => Self::of_band(band, [center, velocity]),
            Form::Box(_) | Form::Round(_) | Form::Closed(_) => return None,
        })
    }

    /// A side of a ring in a direction from the axis, a unit vector; `None` for other forms.
    pub fn side_of(form: &Form, side: DVec3) -> Option<Self> {
        match form {
            Form::Band(band) => Some(Self::Side { band: *band, side }),
            _ => None,
        }
    }

    /// The part of a surface of revolution that has a sphere with this centre \[m\] and velocity \[m/s\], which is on no
    /// ring of it.
    fn of_band(band: &Band, state: [DVec3; 2]) -> Self {
        let part = if is_over_face(band, state) { BandPart::Face } else { BandPart::Rim };
        Self::Part { band: *band, part, section: band.section_through_axis(state) }
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
            Self::Part { band, part, section } => {
                let section = section.filter(|&section| band.is_in_section(center, section));
                of_view(match (part, section) {
                    (BandPart::Face, None) => band.face_seen_from(center),
                    (BandPart::Rim, None) => band.rim_seen_from(center),
                    (BandPart::Face, Some(section)) => band.side_face_seen_from(center, section),
                    (BandPart::Rim, Some(section)) => band.side_rim_seen_from(center, section),
                })
            }
            Self::Side { band, side } => of_view(band.side_seen_from(center, side)),
        }
    }
}
