//! How long a sphere stays on the part of a surface that it is in contact with.

use glam::DVec3;

use super::accelerations::Accelerations;
use crate::detect::contact::Bodies;
use crate::rule::exact::contacts::{Group, Touch, beyond};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::flights::AxisMotion;
use crate::surface::{Form, Rectangle};

/// Time \[s\] until a sphere may slide off the part of a rectangle that it is in contact with.
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
        let Form::Rectangle(rectangle) = form else { continue };
        let member = &group.members[touch.second];
        let center = member.position + touch.shift;
        let velocity = member.velocity - touch.surface_velocity;
        let motion = |axis: DVec3| AxisMotion {
            velocity: velocity.dot(axis),
            acceleration: accelerations.each[touch.second].dot(axis),
            drag_rate: member.species.drag_rate,
        };
        time = time.min(time_on_face(&rectangle, center, motion));
    }
    time
}

/// Time \[s\] until a sphere about `center` \[m\] may slide off the part of a rectangle that it is in
/// contact with, by its motion along the axes of the rectangle.
pub(super) fn time_on_face(
    rectangle: &Rectangle,
    center: DVec3,
    motion: impl Fn(DVec3) -> AxisMotion,
) -> f64 {
    let mut time = f64::INFINITY;
    let distances = beyond(rectangle, center);
    for (axis, beyond) in [rectangle.axis_x, rectangle.axis_z].into_iter().zip(distances) {
        if beyond >= 0.0 {
            continue;
        }
        let place = (center - rectangle.center).dot(axis);
        let half_length = place.abs() - beyond;
        time = time.min(motion(axis).leaves(-half_length - place, half_length - place));
    }
    time
}
