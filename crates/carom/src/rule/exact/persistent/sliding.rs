//! How long a sphere stays on the part of a surface that it is in contact with.

use glam::DVec3;

use super::accelerations::Accelerations;
use crate::axis_motion::AxisMotion;
use crate::detect::contact::Bodies;
use crate::rule::exact::contacts::{Group, Touch, are_within, slack_of};
use crate::rule::exact::context::StepContext;
use crate::surface::{Form, Rectangle};

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
        let velocity = member.velocity - touch.surface_velocity;
        let motion = |axis: DVec3| AxisMotion {
            velocity: velocity.dot(axis),
            acceleration: accelerations.each[touch.second].dot(axis),
            drag_rate: member.species.drag_rate,
        };
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
        Form::Sphere { .. } | Form::HalfSpace { .. } | Form::Box(_) => f64::INFINITY,
    }
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
        // As far as the edge is certain to be behind it: then the next face has it.
        let half = half + slack_of(rectangle, offset);
        time = time.min(motion(axis).leaves(-half - place, half - place));
    }
    time
}
