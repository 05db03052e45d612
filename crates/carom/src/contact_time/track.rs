//! Contact of spheres whose motion is known in closed form, or as a polynomial for some time.

use glam::DVec3;

use super::driven::Driven;
use super::feature::sphere_turning_feature;
use super::nearest::{Feature, segment};
use super::obstacle::Obstacle;
use super::path::{Path, State};
use super::roundoff::Magnitudes;
use super::search;
use super::sphere_surface::{size_of, sphere_surface};
use super::turning::{Orbit, Turning, Turns};
use crate::band::Band;
use crate::collider_motion::Course;
use crate::flight::Flight;
use crate::norm::Norm;
use crate::polynomial_flight::{ORDERS, PolynomialFlight, TERMS, upper_bound};
use crate::surface::{Form, Rectangle, SurfaceMotion};

/// The path of a sphere from some time on.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Track {
    /// A flight in closed form, without end.
    Flight(Flight),
    /// A polynomial, up to its end.
    Polynomial(Box<PolynomialTrack>),
}

/// A polynomial flight, some time after its beginning.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PolynomialTrack {
    flight: PolynomialFlight,
    /// Time since the flight began \[s\], where the time of the track is 0.
    age: f64,
    /// Sizes of the coefficients of the acceleration \[m/s²\].
    norms: [f64; TERMS],
}

impl PolynomialTrack {
    /// The rest of a flight that began `age` \[s\] ago.
    pub fn new(flight: PolynomialFlight, age: f64) -> Self {
        let norms = flight.acceleration.coefficients.map(Norm::norm);
        Self { flight, age, norms }
    }

    /// A time of the track \[s\] as a part of the flight's length.
    fn part(&self, t: f64) -> f64 {
        ((self.age + t) / self.flight.acceleration.length).clamp(0.0, 1.0)
    }

    /// `Σ |c_k| s^k w_k` with weights of the orders.
    fn sum(&self, s: f64, weight: impl Fn(f64) -> f64) -> f64 {
        self.norms.iter().zip(ORDERS).rev().fold(0.0, |sum, (&c, k)| sum * s + c * weight(k))
    }
}

impl Track {
    /// Returns the track in a coordinate system whose origin starts at `origin` \[m\] and moves
    /// with a constant velocity \[m/s\].
    fn seen_from(&self, origin: DVec3, velocity: DVec3) -> Self {
        match self {
            Self::Flight(flight) => Self::Flight(flight.seen_from(origin, velocity)),
            Self::Polynomial(track) => {
                let mut track = track.clone();
                track.flight.position -= origin - track.age * velocity;
                track.flight.velocity -= velocity;
                Self::Polynomial(track)
            }
        }
    }

    /// Returns where the flight began \[m\], and the track moved to the origin.
    fn at_origin(&self) -> (DVec3, Self) {
        let mut track = self.clone();
        let position = match &mut track {
            Self::Flight(flight) => &mut flight.position,
            Self::Polynomial(track) => &mut track.flight.position,
        };
        let start = std::mem::replace(position, DVec3::ZERO);
        (start, track)
    }

    /// Returns the track moved by a way \[m\].
    pub fn shifted(mut self, by: DVec3) -> Self {
        match &mut self {
            Self::Flight(flight) => flight.position += by,
            Self::Polynomial(track) => track.flight.position += by,
        }
        self
    }

    /// Sizes of the numbers that it is given by.
    fn size(&self) -> Magnitudes {
        match self {
            Self::Flight(flight) => Magnitudes::of(flight),
            Self::Polynomial(track) => Magnitudes {
                length: track.flight.position.norm(),
                speed: track.flight.velocity.norm(),
                acceleration: track.norms[0],
            },
        }
    }
}

impl Path for PolynomialTrack {
    fn state_at(&self, t: f64) -> State {
        let time = self.age + t;
        let (position, velocity) = self.flight.after(time);
        let s = self.part(t);
        let speed = self.flight.velocity.norm();
        State {
            position,
            velocity,
            acceleration: self.flight.acceleration.at(time),
            size: Magnitudes {
                length: time * (speed + time * self.sum(s, |k| 1.0 / ((k + 1.0) * (k + 2.0)))),
                speed: speed + time * self.sum(s, |k| 1.0 / (k + 1.0)),
                acceleration: self.sum(s, |_| 1.0),
            },
        }
    }

    fn max_acceleration(&self, direction: DVec3, from: f64, to: f64) -> f64 {
        let along = self.flight.acceleration.coefficients.map(|c| direction.dot(c));
        upper_bound(along, self.part(from), self.part(to))
    }

    fn max_acceleration_anywhere(&self, _from: f64, to: f64) -> f64 {
        self.sum(self.part(to), |_| 1.0)
    }

    fn growth(&self, to: f64) -> f64 {
        let Self { norms: [_, rest @ ..], .. } = self;
        let terms = rest.iter().zip(&ORDERS[1..]).rev();
        let s = self.part(to);
        terms.fold(0.0, |sum, (c, k)| sum * s + k * c) / self.flight.acceleration.length
    }
}

impl Path for Track {
    fn state_at(&self, t: f64) -> State {
        match self {
            Self::Flight(flight) => flight.state_at(t),
            Self::Polynomial(track) => track.state_at(t),
        }
    }

    fn max_acceleration(&self, direction: DVec3, from: f64, to: f64) -> f64 {
        match self {
            Self::Flight(flight) => flight.max_acceleration(direction, from, to),
            Self::Polynomial(track) => track.max_acceleration(direction, from, to),
        }
    }

    fn max_acceleration_anywhere(&self, from: f64, to: f64) -> f64 {
        match self {
            Self::Flight(flight) => flight.max_acceleration_anywhere(from, to),
            Self::Polynomial(track) => track.max_acceleration_anywhere(from, to),
        }
    }

    fn growth(&self, to: f64) -> f64 {
        match self {
            Self::Flight(flight) => flight.growth(to),
            Self::Polynomial(track) => track.growth(to),
        }
    }

    fn decay_rate(&self) -> f64 {
        match self {
            Self::Flight(flight) => flight.decay_rate(),
            Self::Polynomial(track) => track.decay_rate(),
        }
    }
}

/// The second of two tracks relative to the first.
struct TrackPair {
    /// Offset from the start of the first to that of the second \[m\].
    offset: DVec3,
    /// Track of the first body, from the origin.
    first: Track,
    second: Track,
}

impl Path for TrackPair {
    fn state_at(&self, t: f64) -> State {
        // Ways before places: the difference of the starting points is rounded once.
        let (first, second) = (self.first.state_at(t), self.second.state_at(t));
        State {
            position: self.offset + (second.position - first.position),
            velocity: second.velocity - first.velocity,
            acceleration: second.acceleration - first.acceleration,
            size: first.size + second.size,
        }
    }

    fn max_acceleration(&self, direction: DVec3, from: f64, to: f64) -> f64 {
        self.second.max_acceleration(direction, from, to)
            + self.first.max_acceleration(-direction, from, to)
    }

    fn max_acceleration_anywhere(&self, from: f64, to: f64) -> f64 {
        self.second.max_acceleration_anywhere(from, to)
            + self.first.max_acceleration_anywhere(from, to)
    }
}

/// Time \[s\] at which two spheres come into contact.
///
/// - `radius_sum` \[m\], > 0; `horizon` \[s\], not after the end of either track
/// - returns \[s\] in `[0, horizon]`; `None` if there is no contact
pub(crate) fn tracks(first: &Track, second: &Track, radius_sum: f64, horizon: f64) -> Option<f64> {
    let size = first.size() + second.size() + Magnitudes::of_length(radius_sum);
    let ((start, first), (other_start, second)) = (first.at_origin(), second.at_origin());
    let path = TrackPair { offset: other_start - start, first, second };
    search::first_contact(&path, &Obstacle::Point { radius: radius_sum }, size, horizon)
}

/// Time \[s\] at which a sphere comes into contact with a surface: [`sphere_surface`] for any track, and for any
/// `course` of a surface that does not move steadily, which needs a finite horizon.
///
/// - `radius` of the sphere \[m\], > 0; `horizon` \[s\], not after the end of the track
/// - returns \[s\] in `[0, horizon]`; `None` if there is no contact
pub(crate) fn track_surface(
    track: &Track,
    radius: f64,
    form: &Form,
    motion: &SurfaceMotion,
    course: Option<&Course>,
    horizon: f64,
) -> Option<f64> {
    if let Some(course) = course {
        return track_driven_surface(track, radius, (form, motion), course, horizon);
    }
    if let Track::Flight(flight) = track {
        return sphere_surface(flight, radius, form, motion, horizon);
    }
    let SurfaceMotion { origin, velocity, angular_velocity, .. } = *motion;
    let drift = Magnitudes { speed: velocity.norm(), ..size_of(form, radius) };
    let size = track.size() + drift;
    let seen_from = |origin| track.seen_from(origin, velocity);
    if !motion.turns_form(form) {
        let (origin, obstacle) = obstacle(form, radius, DVec3::ZERO)?;
        let path = seen_from(origin);
        let time = search::first_contact(&path, &obstacle, size, horizon)?;
        return Feature { form, origin, radius, size }.first_nearest(&path, time, horizon);
    }
    let size = size + Magnitudes::of_length(origin.norm());
    let (flight, turns) = (seen_from(origin), Turns::new(angular_velocity));
    match form {
        Form::Sphere { center, radius: own } => {
            let path = Orbit { flight, turns, arm: *center - origin };
            let obstacle = Obstacle::Point { radius: own + radius };
            search::first_contact(&path, &obstacle, size, horizon)
        }
        Form::Facet(_) | Form::Edge(_) | Form::Corner(_) => {
            let path = Turning { flight, turns };
            sphere_turning_feature(&path, radius, (form, motion), size, horizon)
        }
        Form::HalfSpace { .. }
        | Form::Rectangle(_)
        | Form::Box(_)
        | Form::Band(_)
        | Form::Round(_)
        | Form::Closed(_) => {
            let (_, obstacle) = obstacle(form, radius, origin)?;
            search::first_contact(&Turning { flight, turns }, &obstacle, size, horizon)
        }
    }
}

/// Time \[s\] at which a sphere comes into contact with a surface that moves by this course.
fn track_driven_surface(
    track: &Track,
    radius: f64,
    (form, motion): (&Form, &SurfaceMotion),
    course: &Course,
    horizon: f64,
) -> Option<f64> {
    debug_assert!(horizon.is_finite(), "a surface that moves unsteadily needs a finite horizon");
    let origin = motion.origin;
    let drift = Magnitudes { speed: motion.velocity.norm(), ..size_of(form, radius) };
    let size = track.size() + drift + Magnitudes::of_length(origin.norm());
    let seen_from = |about: DVec3| Driven::new(track.seen_from(origin, DVec3::ZERO), course, about);
    match form {
        Form::Sphere { center, radius: own } => {
            let obstacle = Obstacle::Point { radius: own + radius };
            search::first_contact(&seen_from(*center - origin), &obstacle, size, horizon)
        }
        Form::Facet(_) | Form::Edge(_) | Form::Corner(_) => {
            let path = seen_from(DVec3::ZERO);
            sphere_turning_feature(&path, radius, (form, motion), size, horizon)
        }
        _ => {
            let (_, obstacle) = obstacle(form, radius, origin)?;
            search::first_contact(&seen_from(DVec3::ZERO), &obstacle, size, horizon)
        }
    }
}

/// A surface as an obstacle in a coordinate system about an `origin` \[m\], for a sphere of this radius \[m\];
/// a sphere or a corner is one about its own centre, which is given \[m\].
fn obstacle(form: &Form, radius: f64, origin: DVec3) -> Option<(DVec3, Obstacle)> {
    match *form {
        Form::Sphere { center, radius: own } => {
            Some((center, Obstacle::Point { radius: own + radius }))
        }
        Form::HalfSpace { point, normal } => {
            Some((DVec3::ZERO, Obstacle::HalfSpace { point: point - origin, normal, radius }))
        }
        Form::Rectangle(rectangle) => {
            let center = rectangle.center - origin;
            let rectangle = Rectangle { center, ..rectangle };
            Some((DVec3::ZERO, Obstacle::Rectangle { rectangle, radius }))
        }
        Form::Facet(ref facet) => {
            let (point, normal) = (facet.frame.center - origin, facet.frame.normal);
            Some((DVec3::ZERO, Obstacle::Plane { point, normal, radius }))
        }
        Form::Edge(ref edge) => Some((DVec3::ZERO, segment(edge, origin, radius))),
        Form::Corner(ref corner) => Some((corner.point, Obstacle::Point { radius })),
        Form::Band(band) => {
            let band = Band { center: band.center - origin, ..band };
            Some((DVec3::ZERO, Obstacle::Band { band, radius }))
        }
        Form::Box(_) | Form::Round(_) | Form::Closed(_) => None,
    }
}
