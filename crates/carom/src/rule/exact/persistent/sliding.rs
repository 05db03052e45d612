//! How long a sphere stays on the part of a surface that it is in contact with.

use glam::DVec3;

use super::accelerations::Accelerations;
use crate::axis_motion::AxisMotion;
use crate::band::Band;
use crate::contact_time;
use crate::detect::contact::Bodies;
use crate::flight::Flight;
use crate::rule::exact::contact_scale::TOUCHING;
use crate::rule::exact::contacts::{Group, Touch, are_within, is_over_face, slack_of};
use crate::rule::exact::context::StepContext;
use crate::surface::{Form, Rectangle, SurfaceMotion};

/// Time \[s\] until a sphere may slide off the part of a surface that it is in contact with.
pub(super) fn sliding_time(
    context: &StepContext,
    group: &Group,
    touches: &[Touch],
    accelerations: &Accelerations,
) -> f64 {
    let mut time = f64::INFINITY;
    for touch in touches {
        let Bodies::Surface { surface, .. } = touch.bodies else { continue };
        let (form, _) = context.surface_at(surface, group.time);
        let member = &group.members[touch.second];
        let center = member.position + touch.shift;
        let velocity = member.velocity - touch.form_velocity();
        let (acceleration, drag_rate) =
            (accelerations.each[touch.second] - touch.drive, member.species.drag_rate);
        let motion = |axis: DVec3| AxisMotion {
            velocity: velocity.dot(axis),
            acceleration: acceleration.dot(axis),
            drag_rate,
        };
        if let Form::Band(band) = &form {
            let flight = Flight { position: center, velocity, acceleration, drag_rate };
            time = time.min(time_on_disc(band, &flight));
        }
        time = time.min(time_on(&form, [center, velocity], motion));
    }
    time
}

/// Time \[s\] until a sphere with this centre \[m\] and velocity relative to a surface \[m/s\] may slide off the part of
/// it that it is in contact with; infinite where the surface has no parts.
pub(super) fn time_on(
    form: &Form,
    [center, velocity]: [DVec3; 2],
    motion: impl Fn(DVec3) -> AxisMotion,
) -> f64 {
    match form {
        Form::Rectangle(rectangle) => time_on_face(rectangle, [center, velocity], motion),
        Form::Facet(facet) => facet.time_on(center, motion),
        Form::Edge(edge) => edge.time_on(center, motion),
        Form::Corner(corner) => corner.time_on(center, motion),
        Form::Band(band) => time_on_band(band, [center, velocity], motion),
        _ => f64::INFINITY,
    }
}

/// Time \[s\] until a sphere with this centre \[m\] and velocity relative to a band \[m/s\] may slide off its face, along
/// the profile.
fn time_on_band(band: &Band, state: [DVec3; 2], motion: impl Fn(DVec3) -> AxisMotion) -> f64 {
    if band.disc_radius().is_some() || !is_over_face(band, state) {
        return f64::INFINITY;
    }
    // Up to where the rim is certainly behind the sphere.
    let slack = TOUCHING * band.coordinates();
    let view = band.face_seen_from(state[0]);
    let [before, after] = band.rooms(state[0]);
    let along = motion(view.directions[0]).leaves(-before - slack, after + slack);
    // On the axis the sphere meets the other side of the ring in which it lies.
    match view.way_to_ring(band) {
        Some((inward, way)) => along.min(motion(inward).leaves(f64::NEG_INFINITY, way)),
        None => along,
    }
}

/// Time \[s\] until a sphere with this flight relative to a disc may slide off it; infinite for other bands.
pub(super) fn time_on_disc(disc: &Band, flight: &Flight) -> f64 {
    let slack = TOUCHING * disc.coordinates();
    let is_over = || is_over_face(disc, [flight.position, flight.velocity]);
    let wall = disc.beyond_disc(flight.position, slack).filter(|_| is_over());
    let (Some(wall), Some(radius)) = (wall, disc.disc_radius()) else { return f64::INFINITY };
    // The centre is over the rim where a sphere with the radius of the disc meets the wall: a centre that met one itself
    // could be behind it by rounding.
    let (form, rest, endless) = (Form::Band(wall), SurfaceMotion::REST, f64::INFINITY);
    let time = contact_time::sphere_surface(flight, radius, &form, &rest, endless);
    time.unwrap_or(f64::INFINITY)
}

/// Time \[s\] until a sphere with this centre \[m\] and velocity relative to a rectangle \[m/s\] may slide off
/// the part of it that it is in contact with, by its motion along the axes of the rectangle.
fn time_on_face(
    rectangle: &Rectangle,
    state: [DVec3; 2],
    motion: impl Fn(DVec3) -> AxisMotion,
) -> f64 {
    let mut time = f64::INFINITY;
    let offset = state[0] - rectangle.center;
    let sides = [(rectangle.axis_x, rectangle.half_x), (rectangle.axis_z, rectangle.half_z)];
    for ((axis, half), is_within) in sides.into_iter().zip(are_within(rectangle, state)) {
        if !is_within {
            continue;
        }
        let place = offset.dot(axis);
        // Up to where the edge is certainly behind the sphere: then the next face has it.
        let half = half + slack_of(rectangle, offset);
        time = time.min(motion(axis).leaves(-half - place, half - place));
    }
    time
}
