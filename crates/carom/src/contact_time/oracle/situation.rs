//! Two bodies on their way, and how far apart they are in any precision.

use glam::{DVec2, DVec3};

use super::number::{Big, Number, Vector};
use crate::band::{Band, Profile};
use crate::contact_time::{sphere_sphere, sphere_surface};
use crate::flight::{Flight, Propagator};
use crate::surface::SurfaceMotion;
use crate::surface::{Form, Rectangle};

#[derive(Debug, Clone)]
#[allow(clippy::large_enum_variant, reason = "a trial has one at a time")]
pub enum Bodies {
    /// Two spheres, with the sum of their radii.
    Spheres {
        first: Flight,
        second: Flight,
        radius_sum: f64,
    },
    Surface {
        flight: Flight,
        radius: f64,
        form: Form,
        motion: SurfaceMotion,
    },
}

#[derive(Debug, Clone)]
pub struct Situation {
    pub bodies: Bodies,
    pub horizon: f64,
}

/// Distance of two bodies; behind a rectangle it is not one of contact.
pub struct Distance<N> {
    pub value: N,
    pub is_behind: bool,
}

impl Situation {
    /// The answer on trial.
    pub fn contact_time(&self) -> Option<f64> {
        match &self.bodies {
            Bodies::Spheres { first, second, radius_sum } => {
                sphere_sphere(first, second, *radius_sum, self.horizon)
            }
            Bodies::Surface { flight, radius, form, motion } => {
                sphere_surface(flight, *radius, form, motion, self.horizon)
            }
        }
    }

    pub fn distance<N: Number>(&self, t: &N) -> Distance<N> {
        let apart = |value| Distance { value, is_behind: false };
        match &self.bodies {
            Bodies::Spheres { first, second, radius_sum } => {
                let offset = position(second, t).minus(&position(first, t));
                apart(offset.length() - N::of(*radius_sum))
            }
            Bodies::Surface { flight, radius, form, motion } => {
                let place = in_body_frame(&position(flight, t), motion, t);
                let from_origin =
                    |point: &DVec3| Vector::<N>::of(*point).minus(&Vector::of(motion.origin));
                match form {
                    Form::Sphere { center, radius: own } => {
                        let offset = place.minus(&from_origin(center));
                        apart(offset.length() - N::of(*own) - N::of(*radius))
                    }
                    Form::HalfSpace { point, normal } => {
                        let offset = place.minus(&from_origin(point));
                        apart(offset.dot(&Vector::of(*normal)) - N::of(*radius))
                    }
                    Form::Rectangle(rectangle) => {
                        let offset = place.minus(&from_origin(&rectangle.center));
                        from_rectangle(rectangle, &offset, *radius)
                    }
                    Form::Band(band) => from_band(band, &place, motion.origin, *radius),
                    _ => unreachable!("not generated"),
                }
            }
        }
    }

    /// Distance and its derivative at a time, to many digits; and whether it is behind.
    pub fn judge(&self, t: f64, span: f64) -> (f64, f64, bool) {
        let (t, h) = (Big::of(t), Big::of(1e-30 * span));
        let now = self.distance(&t);
        let ahead = self.distance(&(t.clone() + h.clone())).value;
        let behind = self.distance(&(t - h.clone())).value;
        let speed = (ahead - behind) / (h * Big::of(2.0));
        (now.value.to_f64().value(), speed.to_f64().value(), now.is_behind)
    }

    /// Sizes \[m\] and \[m/s\] of what distance and closing speed at a time are made of.
    pub fn sizes(&self, t: f64) -> (f64, f64) {
        let of = |flight: &Flight| {
            let Propagator { decay, drift, fall } = Propagator::over(t, flight.drag_rate);
            let (v, a) = (flight.velocity.length(), flight.acceleration.length());
            (flight.position.length() + drift * v + fall * a, decay * v + drift * a)
        };
        match &self.bodies {
            Bodies::Spheres { first, second, radius_sum } => {
                let ((l1, v1), (l2, v2)) = (of(first), of(second));
                let length = l1 + l2 + radius_sum;
                let v = first.velocity.length() + second.velocity.length() + v1 + v2;
                (length, v * (1.0 + length / radius_sum))
            }
            Bodies::Surface { flight, radius, form, motion } => {
                let (l, v) = of(flight);
                let (core, own) = match form {
                    Form::Sphere { center, radius } => (center.length(), *radius),
                    Form::HalfSpace { point, .. } => (point.length(), 0.0),
                    Form::Rectangle(r) => (r.center.length() + r.half_x + r.half_z, 0.0),
                    Form::Band(band) => (band.coordinates(), 0.0),
                    _ => unreachable!("not generated"),
                };
                let omega = motion.angular_velocity.length();
                let drift = motion.velocity.length();
                let plain = l + core + own + radius + motion.origin.length() + drift * t;
                let length = plain * (1.0 + omega * t);
                let speed = flight.velocity.length() + v + drift + omega * length;
                (length, speed * (1.0 + length / (radius + own)))
            }
        }
    }
}

fn position<N: Number>(flight: &Flight, t: &N) -> Vector<N> {
    let (drift, fall) = N::drift_and_fall(t, flight.drag_rate);
    let way = Vector::of(flight.velocity).times(&drift);
    let fall = Vector::of(flight.acceleration).times(&fall);
    Vector::of(flight.position).plus(&way.plus(&fall))
}

/// Relative to the origin of the motion, turned back.
fn in_body_frame<N: Number>(place: &Vector<N>, motion: &SurfaceMotion, t: &N) -> Vector<N> {
    let origin = Vector::of(motion.origin).plus(&Vector::of(motion.velocity).times(t));
    let arm = place.minus(&origin);
    if motion.angular_velocity == DVec3::ZERO {
        return arm;
    }
    let omega = Vector::<N>::of(motion.angular_velocity);
    let rate = omega.length();
    let axis = omega.times(&(N::of(1.0) / rate.clone()));
    let (sin, cos) = (rate * -t.clone()).turn();
    // Rodrigues' formula as it is in books: v cos + k×v sin + k (k·v)(1 - cos).
    let along = axis.dot(&arm) * (N::of(1.0) - cos.clone());
    arm.times(&cos).plus(&axis.cross(&arm).times(&sin)).plus(&axis.times(&along))
}

fn from_rectangle<N: Number>(
    rectangle: &Rectangle,
    offset: &Vector<N>,
    radius: f64,
) -> Distance<N> {
    let outside = |axis: DVec3, half: f64| {
        let along = offset.dot(&Vector::of(axis));
        let half = N::of(half);
        if along > half {
            along - half
        } else if along < -half.clone() {
            along + half
        } else {
            N::of(0.0)
        }
    };
    let height = offset.dot(&Vector::of(rectangle.normal));
    let is_behind = height < N::of(0.0);
    let x = outside(rectangle.axis_x, rectangle.half_x);
    let z = outside(rectangle.axis_z, rectangle.half_z);
    let value = Vector([x, height, z]).length() - N::of(radius);
    Distance { value, is_behind }
}

/// Measures the distance from the nearest of the points of a profile that may be nearest: of the
/// face and of both ends.
fn from_band<N: Number>(band: &Band, place: &Vector<N>, origin: DVec3, radius: f64) -> Distance<N> {
    let offset = place.minus(&Vector::of(band.center).minus(&Vector::of(origin)));
    let axis = Vector::of(band.axis);
    // The axis has a length of one but for rounding.
    let scale = N::of(1.0) / axis.length();
    let axis = axis.times(&scale);
    let y = offset.dot(&axis);
    let x = offset.minus(&axis.times(&y)).length();
    let of = |value: f64| N::of(value);
    let between = |a: [N; 2], b: [N; 2]| {
        let [p, q] = [a[0].clone() - b[0].clone(), a[1].clone() - b[1].clone()];
        (p.clone() * p + q.clone() * q).root()
    };
    let point = || [x.clone(), y.clone()];
    let to_ends = || {
        let [first, second] =
            band.profile.ends().map(|end| between(point(), [of(end.x), of(end.y)]));
        if first < second { first } else { second }
    };
    let (front, distance, thickness) = match band.profile {
        Profile::Line { from, direction, length, thickness } => {
            let [p, q] = [x.clone() - of(from.x), y.clone() - of(from.y)];
            let along = p.clone() * of(direction.x) + q.clone() * of(direction.y);
            let front = q * of(direction.x) - p * of(direction.y);
            let is_disc = direction.y == 0.0;
            let is_over = (along >= of(0.0) || (is_disc && direction.x > 0.0))
                && (along <= of(length) || (is_disc && direction.x < 0.0));
            let distance = if is_over { front.clone() } else { to_ends() };
            (front, distance, thickness)
        }
        Profile::Arc { center, radius, ends, is_hollow } => {
            let from_center = between(point(), [of(center.x), of(center.y)]);
            let out = from_center - of(radius);
            let front = if is_hollow { -out } else { out };
            let [p, q] = [x.clone() - of(center.x), y.clone() - of(center.y)];
            let side = |end: DVec2| of(end.x) * q.clone() - of(end.y) * p.clone();
            let is_over = ends[0] == ends[1] || (ends[1].x == 0.0) || side(ends[1]) <= of(0.0);
            let distance = if is_over { front.clone() } else { to_ends() };
            (front, distance, 0.0)
        }
    };
    let is_behind = front < of(0.0);
    Distance { value: distance - of(thickness) - of(radius), is_behind }
}

impl Situation {
    /// Size of the relative acceleration \[m/s²\] at a time.
    pub fn pull(&self, t: f64) -> f64 {
        let of = |flight: &Flight| {
            flight.acceleration.length() + flight.drag_rate * flight.velocity.length()
        };
        let (length, speed) = self.sizes(t);
        match &self.bodies {
            Bodies::Spheres { first, second, .. } => of(first) + of(second),
            Bodies::Surface { flight, motion, .. } => {
                let omega = motion.angular_velocity.length();
                of(flight) + omega * (2.0 * speed + omega * length)
            }
        }
    }

    /// Long enough for most things to have happened, where there is no horizon.
    pub fn end_of_interest(&self) -> f64 {
        let (flights, length) = match &self.bodies {
            Bodies::Spheres { first, second, radius_sum } => (vec![first, second], *radius_sum),
            Bodies::Surface { flight, radius, .. } => (vec![flight], *radius),
        };
        let crossing = |flight: &&Flight| {
            let way = flight.position.length() + length;
            let speed = flight.velocity.length();
            let pull = flight.acceleration.length();
            let by_speed = if speed > 0.0 { way / speed } else { 0.0 };
            let by_pull = if pull > 0.0 { speed / pull + (way / pull).sqrt() } else { 0.0 };
            by_speed + by_pull
        };
        4.0 * flights.iter().map(crossing).fold(0.0, f64::max)
    }
}
