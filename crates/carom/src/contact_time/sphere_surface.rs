//! Contact of a sphere and a surface, at rest or moving.

use glam::DVec3;

use super::feature::{sphere_feature, sphere_turning_feature};
use super::half_space::sphere_half_space;
use super::obstacle::Obstacle;
use super::reach::Reach;
use super::roundoff::Magnitudes;
use super::search;
use super::sphere_sphere::sphere_point;
use super::turning::{Orbit, Turning, Turns};
use crate::band::Band;
use crate::flight::Flight;
use crate::moving_bounds::MovingBounds;
use crate::norm::Norm;
use crate::surface::{Form, Rectangle, SurfaceMotion};

/// Time \[s\] at which a sphere in flight comes into contact with a surface.
///
/// `form` is the place of the surface at time 0. Drag is that of air at rest, whatever the
/// surface does. A rectangle is met from its front only, edges and corners included. A box is
/// not met: its faces deflect. A face, an edge or a corner of a mesh is met where it is nearest.
///
/// - `radius` of the sphere \[m\], > 0
/// - `horizon` \[s\], >= 0; finite if the surface turns
/// - returns \[s\] in `[0, horizon]`; `None` if there is no contact
pub(crate) fn sphere_surface(
    flight: &Flight,
    radius: f64,
    form: &Form,
    motion: &SurfaceMotion,
    horizon: f64,
) -> Option<f64> {
    if motion.turns_form(form) {
        debug_assert!(horizon.is_finite(), "a turning surface needs a finite horizon");
        return sphere_turning_surface(flight, radius, form, motion, horizon);
    }
    let drift = Magnitudes { speed: motion.velocity.norm(), ..size_of(form, radius) };
    let size = Magnitudes::of(flight) + drift;
    match *form {
        Form::Sphere { center, radius: own } => {
            let relative = flight.seen_from(center, motion.velocity);
            sphere_point(&relative, own + radius, size, horizon)
        }
        Form::HalfSpace { point, normal } => {
            let relative = flight.seen_from(DVec3::ZERO, motion.velocity);
            sphere_half_space(&relative, radius, (point, normal), &size, horizon)
        }
        Form::Rectangle(rectangle) => {
            let relative = flight.seen_from(DVec3::ZERO, motion.velocity);
            let obstacle = Obstacle::Rectangle { rectangle, radius };
            search::first_contact(&relative, &obstacle, size, horizon)
        }
        Form::Band(band) => {
            let relative = flight.seen_from(DVec3::ZERO, motion.velocity);
            let obstacle = Obstacle::Band { band, radius };
            search::first_contact(&relative, &obstacle, size, horizon)
        }
        Form::Box(_) | Form::Round(_) | Form::Closed(_) => None,
        Form::Facet(_) | Form::Edge(_) | Form::Corner(_) => {
            sphere_feature(flight, radius, (form, motion), size, horizon)
        }
    }
}

/// [`sphere_surface`] where most surfaces are out of reach within the horizon, which bounds show at less cost.
pub(crate) fn sphere_surface_in_reach(
    flight: &Flight,
    radius: f64,
    form: &Form,
    motion: &SurfaceMotion,
    horizon: f64,
) -> Option<f64> {
    let mut reach = Reach::of(*flight, radius, horizon);
    if !motion.is_at_rest() {
        let moving = MovingBounds::steady(motion, horizon);
        reach = reach.seen_from_moving(0.0, motion.origin, &moving);
    }
    match reach.misses(form, DVec3::ZERO) {
        true => None,
        false => sphere_surface(flight, radius, form, motion, horizon),
    }
}

fn sphere_turning_surface(
    flight: &Flight,
    radius: f64,
    form: &Form,
    motion: &SurfaceMotion,
    horizon: f64,
) -> Option<f64> {
    let SurfaceMotion { origin, velocity, angular_velocity, .. } = *motion;
    let from_origin = flight.seen_from(origin, velocity);
    let turns = Turns::new(angular_velocity);
    let drift = Magnitudes { speed: velocity.norm(), ..size_of(form, radius) };
    let size = Magnitudes::of(flight) + drift + Magnitudes::of_length(origin.norm());
    let path = Turning { flight: from_origin, turns };
    match *form {
        Form::Sphere { center, radius: own } => {
            let path = Orbit { flight: from_origin, turns, arm: center - origin };
            let obstacle = Obstacle::Point { radius: own + radius };
            search::first_contact(&path, &obstacle, size, horizon)
        }
        Form::HalfSpace { point, normal } => {
            let obstacle = Obstacle::HalfSpace { point: point - origin, normal, radius };
            search::first_contact(&path, &obstacle, size, horizon)
        }
        Form::Rectangle(rectangle) => {
            let center = rectangle.center - origin;
            let rectangle = Rectangle { center, ..rectangle };
            let obstacle = Obstacle::Rectangle { rectangle, radius };
            search::first_contact(&path, &obstacle, size, horizon)
        }
        Form::Band(band) => {
            let band = Band { center: band.center - origin, ..band };
            let obstacle = Obstacle::Band { band, radius };
            search::first_contact(&path, &obstacle, size, horizon)
        }
        Form::Box(_) | Form::Round(_) | Form::Closed(_) => None,
        Form::Facet(_) | Form::Edge(_) | Form::Corner(_) => {
            sphere_turning_feature(&path, radius, (form, motion), size, horizon)
        }
    }
}

/// Size of the coordinates of a surface and of the radii.
pub(super) fn size_of(form: &Form, radius: f64) -> Magnitudes {
    Magnitudes::of_length(form.coordinates() + radius)
}
