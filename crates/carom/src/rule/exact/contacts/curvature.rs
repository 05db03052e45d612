//! The curvature of a contact's normal.

use glam::DVec3;

use super::separation::are_within;
use crate::detect::Separation;
use crate::norm::Norm;
use crate::surface::Form;

/// How the normal of a contact turns when the bodies slide along each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum NormalCurvature {
    /// Not at all: a plane.
    Flat,
    /// About a point, this far from the centre of body 2 \[m\].
    RoundFeature(f64),
    /// About an edge in this direction, this far from the centre of body 2 \[m\].
    Edge(DVec3, f64),
}

impl NormalCurvature {
    /// Velocity along which the normal turns, and the distance about which it does.
    pub fn turning(&self, tangential: DVec3) -> Option<(DVec3, f64)> {
        match *self {
            Self::Flat => None,
            Self::RoundFeature(distance) => Some((tangential, distance)),
            Self::Edge(direction, distance) => {
                Some((tangential - tangential.dot(direction) * direction, distance))
            }
        }
    }
}

/// How the normal turns where a sphere about `center` \[m\] touches a surface, with a velocity relative to
/// it \[m/s\].
pub(super) fn curvature_of(
    form: &Form,
    [center, velocity]: [DVec3; 2],
    separation: &Separation,
) -> NormalCurvature {
    let distance = (center - separation.point).norm();
    match form {
        Form::Sphere { center: fixed, .. } => {
            NormalCurvature::RoundFeature((center - *fixed).norm())
        }
        Form::HalfSpace { .. } | Form::Box(_) | Form::Facet(_) => NormalCurvature::Flat,
        Form::Edge(edge) => NormalCurvature::Edge(edge.axis, distance),
        Form::Corner(_) => NormalCurvature::RoundFeature(distance),
        Form::Rectangle(rectangle) => match are_within(rectangle, [center, velocity]) {
            [true, true] => NormalCurvature::Flat,
            [false, true] => NormalCurvature::Edge(rectangle.axis_z, distance),
            [true, false] => NormalCurvature::Edge(rectangle.axis_x, distance),
            [false, false] => NormalCurvature::RoundFeature(distance),
        },
    }
}
