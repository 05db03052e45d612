//! The separation of a sphere and a surface, within rounding.

use glam::DVec3;

use super::member::Member;
use crate::band::Band;
use crate::detect::{
    Separation, known_in_front, sphere_corner_point, sphere_edge_line, sphere_facet_plane,
    sphere_surface,
};
use crate::id::ColliderId;
use crate::norm::Norm;
use crate::respond;
use crate::rule::exact::contact_scale::{CLOCK_ROUNDING, TOUCHING};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::timeline::Timeline;
use crate::surface::{Form, Rectangle, Surface};

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

/// Gap \[m\] below which two bodies touch: the rounding of their coordinates \[m\], and how far they move at a
/// relative `speed` \[m/s\] within the rounding of the clock.
pub(super) fn touching_gap(coordinates: f64, speed: f64, time: f64) -> f64 {
    TOUCHING * coordinates + CLOCK_ROUNDING * time.abs() * speed
}

/// Whether a sphere with this centre \[m\] and velocity relative to a surface \[m/s\] is in the region of this part
/// of a mesh; true for other surfaces. At a border between two parts, exactly one has the sphere.
pub(super) fn has(form: &Form, state: [DVec3; 2]) -> bool {
    match form {
        Form::Facet(facet) => facet.holds(state),
        Form::Edge(edge) => edge.holds(state),
        Form::Corner(corner) => corner.holds(state),
        _ => true,
    }
}

/// The mesh with which a sphere is in persistent contact, and the colliders with faces flush with it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct HoldingMesh {
    /// `Surface::whole` of its surfaces.
    pub whole: ColliderId,
    /// Whether another part of the surface is now nearer to the sphere than the part that held it.
    pub is_left: bool,
}

/// The mesh with a part of which the sphere at `slot` is in persistent contact, at `time` \[s\].
pub(crate) fn holding_mesh(
    timeline: &Timeline,
    context: &StepContext,
    slot: u32,
    time: f64,
) -> Option<HoldingMesh> {
    let flights = &timeline.flights;
    let cluster = flights.clusters.get(flights.species_of(slot).cluster?);
    let surfaces = &context.system.surfaces;
    let mut parts = cluster
        .surfaces_of(flights.index_of[slot as usize])
        .filter(|&surface| is_part(&surfaces[surface as usize].form))
        .peekable();
    let first = *parts.peek()?;
    let left = parts.find(|&surface| !has_at(timeline, context, slot, surface, time));
    let whole = surfaces[left.unwrap_or(first) as usize].whole;
    Some(HoldingMesh { whole, is_left: left.is_some() })
}

/// Whether the sphere at `slot` is, at `time` \[s\], in the region of this part of a mesh; true for other surfaces.
pub(crate) fn has_at(
    timeline: &Timeline,
    context: &StepContext,
    slot: u32,
    surface: u32,
    time: f64,
) -> bool {
    if !is_part(&context.system.surfaces[surface as usize].form) {
        return true;
    }
    let (form, motion) = context.surface_at(surface, time);
    let (place, velocity) = timeline.flights.state_of(slot, time);
    has(&form, [place, velocity - motion.velocity_at(place)])
}

/// Whether a surface is a part of a mesh.
fn is_part(form: &Form) -> bool {
    matches!(form, Form::Facet(_) | Form::Edge(_) | Form::Corner(_))
}

/// Whether a sphere touches a surface, or its image at the offset `shift` \[m\], at `time` \[s\], however deep it
/// overlaps.
pub(crate) fn touches_surface(
    context: &StepContext,
    member: &Member,
    near: (u32, DVec3),
    time: f64,
) -> bool {
    touching_distance(context, member, near, 0.0, time).is_some()
}

/// The distance of a sphere from a surface, or from its image at the offset `shift` \[m\], that it touches at `time`
/// \[s\]: negative where they overlap. A gap of `missed` \[m\], the error of a path along a curve, counts as a touch.
pub(super) fn touching_distance(
    context: &StepContext,
    member: &Member,
    (surface, shift): (u32, DVec3),
    missed: f64,
    time: f64,
) -> Option<f64> {
    let Member { position: center, velocity, species, .. } = *member;
    let radius = species.radius;
    let Surface { form, motion, .. } = &context.system.surfaces[surface as usize];
    if motion.is_at_rest() {
        // The point of the surface is no farther from the origin than this if they touch.
        let coordinates = 2.0 * (center.norm() + shift.norm() + radius);
        let gap = 2.0 * touching_gap(coordinates, velocity.norm(), time) + missed;
        if is_above(form, center - shift, radius + gap) {
            return None;
        }
    }
    let (form, motion) = context.surface_at(surface, time);
    let state = [center - shift, velocity - motion.velocity_at(center - shift)];
    if !has(&form, state) {
        return None;
    }
    let separation = sphere_surface(&form, center - shift, radius)?;
    let speed = (velocity - motion.velocity_at(separation.point)).norm();
    let coordinates = center.norm() + separation.point.norm() + radius;
    let is_near = separation.distance <= touching_gap(coordinates, speed, time) + missed;
    is_near.then_some(separation.distance)
}

/// Whether the distance of a point from a surface is above `height` \[m\]; for a plane, behind it too.
fn is_above(form: &Form, point: DVec3, height: f64) -> bool {
    match form {
        Form::HalfSpace { point: origin, normal } => (point - *origin).dot(*normal) > height,
        Form::Rectangle(face) => (point - face.center).dot(face.normal).abs() > height,
        Form::Facet(facet) => facet.height_of(point).abs() > height,
        Form::Edge(edge) => edge.distance_of(point) > height,
        Form::Corner(corner) => (point - corner.point).norm() > height,
        _ => false,
    }
}
