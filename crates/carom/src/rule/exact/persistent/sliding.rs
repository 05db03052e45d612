//! How long the spheres of a group stay on the parts of surfaces that they are in contact with.

use glam::DVec3;

use super::accelerations::Accelerations;
use crate::axis_motion::AxisMotion;
use crate::band::Band;
use crate::contact_time;
use crate::detect::contact::Bodies;
use crate::flight::Flight;
use crate::rule::exact::contacts::contact_scale::TOUCHING;
use crate::rule::exact::contacts::{Group, Touch};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::features::{is_over_face, time_on};
use crate::surface::{Form, SurfaceMotion};

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
