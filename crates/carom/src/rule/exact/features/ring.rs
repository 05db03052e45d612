//! Rings of contact: a sphere on the axis of a surface of revolution touches it along a circle. What holds the sphere
//! there is the side that it moves to, and the one opposite.

use glam::DVec3;

use super::curvature::NormalCurvature;
use crate::band::View;
use crate::detect::{Separation, sphere_side_of_band};
use crate::norm::Norm;
use crate::surface::Form;

/// A vector is along the axis if its part across the axis is a smaller part of it: rounding.
const ASIDE: f64 = 1e-12;

/// Unit vector from the axis to the side of a ring that a sphere with this centre \[m\] comes to in a direction; `None`
/// if the sphere is on no ring, or the direction is along the axis.
pub(crate) fn side_of_ring(form: &Form, [center, direction]: [DVec3; 2]) -> Option<DVec3> {
    let Form::Band(band) = form else { return None };
    let across = direction - direction.dot(band.axis) * band.axis;
    let is_aside = across.norm() > ASIDE * direction.norm();
    (is_aside && band.has_ring_about(center)).then(|| across / across.norm())
}

/// The separation of a sphere from one side of a ring, and how the normal turns there; `None` for other forms.
pub(crate) fn separation_from_side(
    form: &Form,
    center: DVec3,
    radius: f64,
    side: DVec3,
) -> Option<(Separation, NormalCurvature)> {
    let Form::Band(band) = form else { return None };
    let View { directions, curvatures, .. } = band.side_seen_from(center, side);
    let curvature = NormalCurvature::Principal { directions, curvatures };
    Some((sphere_side_of_band(band, center, radius, side), curvature))
}
