//! How long a sphere stays on the part of a surface that it is in contact with.

use glam::DVec3;

use super::separation::{TOUCHING, are_within, is_over_face, slack_of};
use crate::axis_motion::AlongAxis;
use crate::axis_polynomial::AxisPolynomial;
use crate::band::Band;
use crate::integrate::crossing::bisected;
use crate::norm::Norm;
use crate::polynomial_flight::PolynomialFlight;
use crate::surface::{Form, Rectangle};

/// Least step towards the end of a face, as a part of the time of a flight: how briefly a sphere may be past it
/// unseen.
const LEAST_PART: f64 = 1e-3;

/// Time \[s\] until a sphere with this centre \[m\] and velocity relative to a surface \[m/s\] may slide off the part of
/// it that it is in contact with; infinite where the surface has no parts.
pub(crate) fn time_on<M: AlongAxis>(
    form: &Form,
    [center, velocity]: [DVec3; 2],
    motion: impl Fn(DVec3) -> M,
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
fn time_on_band<M: AlongAxis>(band: &Band, state: [DVec3; 2], motion: impl Fn(DVec3) -> M) -> f64 {
    if band.has_ring_about(state[0]) {
        return time_on_ring(band, state[0], motion);
    }
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

/// Time \[s\] until a sphere with this centre \[m\] leaves the axis of a band.
fn time_on_ring<M: AlongAxis>(band: &Band, center: DVec3, motion: impl Fn(DVec3) -> M) -> f64 {
    let reach = band.ring_reach();
    let radial = band.radial_at(center);
    let leaves = |axis: DVec3| motion(axis).leaves(-reach, reach);
    leaves(radial).min(leaves(band.axis.cross(radial)))
}

/// Time \[s\] until a sphere with this centre \[m\] and velocity relative to a rectangle \[m/s\] may slide off
/// the part of it that it is in contact with, by its motion along the axes of the rectangle.
fn time_on_face<M: AlongAxis>(
    rectangle: &Rectangle,
    state: [DVec3; 2],
    motion: impl Fn(DVec3) -> M,
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

/// Time \[s\] until a sphere with this flight, relative to a surface, may slide off the part of it that it is in
/// contact with, and may be on a ring; infinite if it does not in the time of the flight.
pub(crate) fn time_on_curve(form: &Form, flight: &PolynomialFlight, is_on_ring: bool) -> f64 {
    let state = [flight.position, flight.velocity];
    let motion = |axis: DVec3| AxisPolynomial::of(flight, axis);
    match form {
        Form::Band(band) if is_on_ring || band.has_ring_about(flight.position) => {
            time_on_ring(band, flight.position, motion)
        }
        Form::Band(band) => time_beside_rim(band, flight).min(time_to_ring(band, flight)),
        Form::Rectangle(rectangle) => {
            time_on_face(rectangle, state, motion).min(time_beside_face(rectangle, state, motion))
        }
        form => time_on(form, state, motion),
    }
}

/// Time \[s\] until a sphere beyond edges of a rectangle may come back within one of them, by its motion along the
/// axes of the rectangle.
fn time_beside_face<M: AlongAxis>(
    rectangle: &Rectangle,
    state: [DVec3; 2],
    motion: impl Fn(DVec3) -> M,
) -> f64 {
    let offset = state[0] - rectangle.center;
    let slack = slack_of(rectangle, offset);
    let sides = [(rectangle.axis_x, rectangle.half_x), (rectangle.axis_z, rectangle.half_z)];
    let beyond = sides.into_iter().zip(are_within(rectangle, state)).filter(|it| !it.1);
    let times = beyond.map(|((axis, half), _)| {
        let place = offset.dot(axis);
        let inward = if place > 0.0 { -axis } else { axis };
        motion(inward).leaves(f64::NEG_INFINITY, place.abs() - half + slack)
    });
    times.fold(f64::INFINITY, f64::min)
}

/// Time \[s\] until a sphere with this flight changes between the face of a band and a rim.
fn time_beside_rim(band: &Band, flight: &PolynomialFlight) -> f64 {
    // Up to where the other part certainly has the sphere.
    let slack = 2.0 * TOUCHING * band.coordinates();
    let side = if is_over_face(band, [flight.position, flight.velocity]) { 1.0 } else { -1.0 };
    time_to_zero(flight, |center| side * band.face_seen_from(center).room + slack)
}

/// Time \[s\] until a sphere with this flight meets the opposite side of a ring of a band, on the axis.
fn time_to_ring(band: &Band, flight: &PolynomialFlight) -> f64 {
    let radial = band.radial_at(flight.position);
    let time = time_to_zero(flight, |center| (center - band.center).dot(radial));
    let is_on_ring = time < f64::INFINITY && band.has_ring_about(flight.after(time).0);
    if is_on_ring { time } else { f64::INFINITY }
}

/// Time \[s\] until a distance of the centre of a sphere with this flight \[m\] is no longer positive.
fn time_to_zero(flight: &PolynomialFlight, distance: impl Fn(DVec3) -> f64) -> f64 {
    let room = |time: f64| distance(flight.after(time).0);
    let end = flight.acceleration.length;
    // The distance changes no faster than the sphere moves.
    let fastest = flight.fastest().norm();
    let (mut time, mut left) = (0.0, room(0.0));
    while time < end {
        let next = (time + (left / fastest).max(LEAST_PART * end)).min(end);
        left = room(next);
        if left <= 0.0 {
            return bisected(&|time| [-room(time), 0.0], [time, next]);
        }
        time = next;
    }
    f64::INFINITY
}
