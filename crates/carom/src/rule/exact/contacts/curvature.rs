//! The curvature of a contact's normal.

use glam::DVec3;

use super::separation::beyond;
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

/// How the normal turns where a sphere about `center` \[m\] touches a surface.
pub(super) fn curvature_of(form: &Form, center: DVec3, separation: &Separation) -> NormalCurvature {
    let distance = (center - separation.point).norm();
    match form {
        Form::Sphere { center: fixed, .. } => {
            NormalCurvature::RoundFeature((center - *fixed).norm())
        }
        Form::HalfSpace { .. } | Form::Box(_) => NormalCurvature::Flat,
        Form::Rectangle(rectangle) => {
            let [beyond_x, beyond_z] = beyond(rectangle, center);
            match (beyond_x >= 0.0, beyond_z >= 0.0) {
                (false, false) => NormalCurvature::Flat,
                (true, false) => NormalCurvature::Edge(rectangle.axis_z, distance),
                (false, true) => NormalCurvature::Edge(rectangle.axis_x, distance),
                (true, true) => NormalCurvature::RoundFeature(distance),
            }
        }
    }
}
