//! How long a sphere stays on the part of a surface that it is in contact with.

use glam::DVec3;

use super::accelerations::Accelerations;
use crate::band::Band;
use crate::contact_time;
use crate::detect::contact::Bodies;
use crate::flight::Flight;
use crate::rule::exact::contact_scale::TOUCHING;
use crate::rule::exact::contacts::{Group, Touch, are_within, is_over_face, slack_of};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::flights::AxisMotion;
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
        let acceleration = accelerations.each[touch.second];
        let flight = Flight {
            position: center,
            velocity,
            acceleration,
            drag_rate: member.species.drag_rate,
        };
        time = time.min(time_on(&form, &flight));
    }
    time
}

/// Time \[s\] until a sphere with this flight relative to a surface may slide off the part of it that it is in
/// contact with.
pub(super) fn time_on(form: &Form, flight: &Flight) -> f64 {
    let Flight { position, velocity, acceleration, drag_rate } = *flight;
    let motion = |axis: DVec3| AxisMotion {
        velocity: velocity.dot(axis),
        acceleration: acceleration.dot(axis),
        drag_rate,
    };
    match form {
        Form::Rectangle(face) => time_on_face(face, [position, velocity], motion),
        Form::Band(band) => time_on_band(band, flight, motion),
        _ => f64::INFINITY,
    }
}

/// Time \[s\] until a sphere with this flight relative to a band may slide off its face.
fn time_on_band(band: &Band, flight: &Flight, motion: impl Fn(DVec3) -> AxisMotion) -> f64 {
    let Flight { position, velocity, .. } = *flight;
    if !is_over_face(band, [position, velocity]) {
        return f64::INFINITY;
    }
    // As far as the rim is certain to be behind it.
    let slack = TOUCHING * band.coordinates();
    if let Some(wall) = band.beyond_disc(slack) {
        let form = Form::Band(wall);
        let time = contact_time::sphere_surface(flight, 0.0, &form, &SurfaceMotion::REST, FOREVER);
        return time.unwrap_or(f64::INFINITY);
    }
    let view = band.face_seen_from(position);
    let [before, after] = band.rooms(position);
    motion(view.directions[0]).leaves(-before - slack, after + slack)
}

const FOREVER: f64 = f64::INFINITY;

/// Time \[s\] until a sphere with this centre \[m\] and velocity relative to a rectangle \[m/s\] may slide off
/// the part of it that it is in contact with, by its motion along the axes of the rectangle.
pub(super) fn time_on_face(
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
        // As far as the edge is certain to be behind it: then the next face has it.
        let half = half + slack_of(rectangle, offset);
        time = time.min(motion(axis).leaves(-half - place, half - place));
    }
    time
}
