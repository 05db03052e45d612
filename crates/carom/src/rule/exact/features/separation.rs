//! The separation of a sphere and a surface, within rounding, and the part of a surface that has a sphere.

use glam::DVec3;

use crate::band::Band;
use crate::detect::{
    Separation, known_in_front, sphere_corner_point, sphere_edge_line, sphere_facet_plane,
    sphere_surface,
};
use crate::norm::Norm;
use crate::respond;
use crate::surface::{Form, Rectangle};

/// Bodies touch when the gap between them is below this many roundings of their coordinates: the uncertainty of the
/// time of an impact and of the path to it.
pub(in crate::rule::exact) const TOUCHING: f64 = 256.0 * f64::EPSILON;

/// The separation of a sphere and a surface. A predicted contact with a rectangle or a band is in front of it,
/// whatever rounding says. A feature of a mesh counts as the nearest one.
pub(crate) fn separation(
    form: &Form,
    center: DVec3,
    radius: f64,
    is_predicted: bool,
) -> Option<Separation> {
    match form {
        Form::Rectangle(_) | Form::Band(_) if is_predicted => known_in_front(form, center, radius),
        Form::Facet(facet) => Some(sphere_facet_plane(facet, center, radius)),
        Form::Edge(edge) => Some(sphere_edge_line(edge, center, radius)),
        Form::Corner(corner) => Some(sphere_corner_point(corner, center, radius)),
        form => sphere_surface(form, center, radius),
    }
}

/// How far a point is beyond the edges of a rectangle along its axes \[m\]; negative inside. A point on the edge
/// counts as beyond, so that a sliding sphere leaves the face.
pub(crate) fn beyond(rectangle: &Rectangle, point: DVec3) -> [f64; 2] {
    let offset = point - rectangle.center;
    let slack = slack_of(rectangle, offset);
    [(rectangle.axis_x, rectangle.half_x), (rectangle.axis_z, rectangle.half_z)]
        .map(|(axis, half)| offset.dot(axis).abs() - half + slack)
}

/// Whether a sphere with this centre \[m\] and velocity relative to a rectangle \[m/s\] is within its edges along
/// its axes. A sphere on the edge is inside if it moves inward, or if it moves along the edge and inward is a
/// positive direction of the world's axes. So one of two faces that share an edge has the sphere.
pub(crate) fn are_within(rectangle: &Rectangle, [center, velocity]: [DVec3; 2]) -> [bool; 2] {
    let offset = center - rectangle.center;
    let slack = slack_of(rectangle, offset);
    let [beyond_x, beyond_z] = beyond(rectangle, center);
    [(rectangle.axis_x, beyond_x), (rectangle.axis_z, beyond_z)].map(|(axis, beyond)| {
        let inward = if offset.dot(axis) > 0.0 { -axis } else { axis };
        let moves_in = || {
            let speed = velocity.dot(inward);
            let is_along = speed.abs() <= respond::rounding_of(velocity);
            let leads = || inward.to_array().into_iter().find(|&part| part != 0.0) > Some(0.0);
            if is_along { leads() } else { speed > 0.0 }
        };
        beyond < 0.0 || (beyond <= 2.0 * slack && moves_in())
    })
}

/// Whether a sphere with this centre \[m\] and velocity relative to a band \[m/s\] is over its face. A sphere on
/// the rim is, if it moves away from the rim.
pub(crate) fn is_over_face(band: &Band, [center, velocity]: [DVec3; 2]) -> bool {
    let slack = TOUCHING * band.coordinates();
    let view = band.face_seen_from(center);
    if view.room.abs() > slack {
        return view.room > 0.0;
    }
    let step = slack / velocity.norm().max(f64::MIN_POSITIVE);
    band.face_seen_from(center + step * velocity).room > view.room
}

/// Rounding of a place beside a rectangle, at an `offset` from its centre \[m\].
pub(crate) fn slack_of(rectangle: &Rectangle, offset: DVec3) -> f64 {
    TOUCHING * (offset.norm() + rectangle.half_x + rectangle.half_z)
}

/// Whether a sphere with this centre \[m\] and velocity relative to a surface \[m/s\] is in the region of this part
/// of a mesh; true for other surfaces. At a border between two parts, exactly one has the sphere.
pub(crate) fn has(form: &Form, state: [DVec3; 2]) -> bool {
    match form {
        Form::Facet(facet) => facet.holds(state),
        Form::Edge(edge) => edge.holds(state),
        Form::Corner(corner) => corner.holds(state),
        _ => true,
    }
}

/// Whether a surface is a part of a mesh.
pub(crate) fn is_part(form: &Form) -> bool {
    form.is_feature()
}

/// Whether the distance of a point from a surface is above `height` \[m\]; for a plane, behind it too.
pub(crate) fn is_above(form: &Form, point: DVec3, height: f64) -> bool {
    match form {
        Form::HalfSpace { point: origin, normal } => (point - *origin).dot(*normal) > height,
        Form::Rectangle(face) => (point - face.center).dot(face.normal).abs() > height,
        Form::Facet(facet) => facet.height_of(point).abs() > height,
        Form::Edge(edge) => edge.distance_of(point) > height,
        Form::Corner(corner) => (point - corner.point).norm() > height,
        _ => false,
    }
}
