//! Contact of a sphere and a face, an edge or a corner of a mesh.
//!
//! The sphere meets the whole plane, line or point first somewhere. If the feature is not what of the mesh is nearest
//! there, the search goes on ([`super::nearest`]).

use super::half_space::sphere_half_space;
use super::nearest::{Feature, segment};
use super::obstacle::Obstacle;
use super::path::Path;
use super::roundoff::Magnitudes;
use super::search;
use super::sphere_sphere::sphere_point;
use crate::flight::Flight;
use crate::mesh::Facet;
use crate::surface::{Form, SurfaceMotion};
use glam::DVec3;

/// Time \[s\] at which a sphere in flight comes into contact with a feature that does not turn.
pub(super) fn sphere_feature(
    flight: &Flight,
    radius: f64,
    (form, motion): (&Form, &SurfaceMotion),
    size: Magnitudes,
    horizon: f64,
) -> Option<f64> {
    let seen_from = |place: DVec3| flight.seen_from(place, motion.velocity);
    let time = match form {
        Form::Facet(facet) if facet.height_of(flight.position) >= 0.0 => {
            let plane = (facet.frame.center, facet.frame.normal);
            sphere_half_space(&seen_from(DVec3::ZERO), radius, plane, &size, horizon)
        }
        Form::Facet(facet) => {
            let (point, normal) = (facet.frame.center, facet.frame.normal);
            let obstacle = Obstacle::Plane { point, normal, radius };
            search::first_contact(&seen_from(DVec3::ZERO), &obstacle, size, horizon)
        }
        Form::Edge(edge) => {
            let obstacle = segment(edge, DVec3::ZERO, radius);
            search::first_contact(&seen_from(DVec3::ZERO), &obstacle, size, horizon)
        }
        Form::Corner(corner) => sphere_point(&seen_from(corner.point), radius, size, horizon),
        _ => None,
    };
    let feature = Feature { form, origin: DVec3::ZERO, radius, size };
    feature.first_nearest(&seen_from(DVec3::ZERO), time?, horizon)
}

/// Time \[s\] at which a sphere comes into contact with a feature that turns: its `path` is seen from that.
pub(super) fn sphere_turning_feature(
    path: &impl Path,
    radius: f64,
    (form, motion): (&Form, &SurfaceMotion),
    size: Magnitudes,
    horizon: f64,
) -> Option<f64> {
    let origin = motion.origin;
    let meet = |obstacle: &Obstacle| search::first_contact(path, obstacle, size, horizon);
    let time = match form {
        Form::Facet(facet) => meet_triangles(facet, origin, radius, meet),
        Form::Edge(edge) => meet(&segment(edge, origin, radius)),
        Form::Corner(corner) => {
            let ends = [corner.point - origin; 2];
            meet(&Obstacle::Segment { ends, radius })
        }
        _ => None,
    };
    Feature { form, origin, radius, size }.first_nearest(path, time?, horizon)
}

/// The first contact with one of the triangles of a face, whose places count from an origin \[m\].
fn meet_triangles(
    facet: &Facet,
    origin: DVec3,
    radius: f64,
    meet: impl Fn(&Obstacle) -> Option<f64>,
) -> Option<f64> {
    let normal = facet.frame.normal;
    let met = facet.triangles().filter_map(|[a, b, c]| {
        // Of a face that is met from behind, they go round the other way.
        let is_forward = (b - a).cross(c - a).dot(normal) > 0.0;
        let corners = if is_forward { [a, b, c] } else { [a, c, b] };
        let corners = corners.map(|corner| corner - origin);
        meet(&Obstacle::Triangle { corners, normal, radius })
    });
    met.min_by(f64::total_cmp)
}
