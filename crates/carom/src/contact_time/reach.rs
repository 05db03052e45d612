//! Reach: what a sphere cannot meet within a short time, by bounds alone.

use glam::DVec3;

use crate::flight::Flight;
use crate::moving_bounds::MovingBounds;
use crate::norm::Norm;
use crate::polynomial_flight::PolynomialAcceleration;
use crate::surface::{Form, Rectangle};

/// Distances are compared with this part of the coordinates to spare: far more than their rounding,
/// far less than what the comparison saves.
const MARGIN: f64 = 1e-9;

/// Bounds of the path of a sphere within some time.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reach {
    flight: Flight,
    /// Radius of the sphere \[m\].
    radius: f64,
    /// \[s\]
    horizon: f64,
    /// Longest path in any direction \[m\].
    way: f64,
    /// Largest deviation of the path from the flight \[m\].
    beside: f64,
}

impl Reach {
    /// The reach of a sphere of this `radius` \[m\], > 0, within `horizon` \[s\].
    #[inline]
    pub fn of(flight: Flight, radius: f64, horizon: f64) -> Self {
        let way = flight.farthest(horizon).norm() * (1.0 + MARGIN);
        Self { flight, radius, horizon, way, beside: 0.0 }
    }

    /// The reach of a sphere of this `radius` \[m\], > 0, over a whole polynomial flight from a place \[m\] with a
    /// velocity \[m/s\].
    pub fn of_polynomial(
        [position, velocity]: [DVec3; 2],
        acceleration: &PolynomialAcceleration,
        radius: f64,
    ) -> Self {
        let [first, ..] = acceleration.coefficients;
        let parabola = Flight { position, velocity, acceleration: first, drag_rate: 0.0 };
        let beside = acceleration.beyond_parabola() * (1.0 + MARGIN);
        let reach = Self::of(parabola, radius, acceleration.length);
        Self { way: reach.way + beside, beside, ..reach }
    }

    /// Reach relative to a surface that was in its place some time before the flight \[s\] and has moved in these bounds
    /// since. `origin` is that of its collider \[m\].
    pub fn seen_from_moving(self, since: f64, origin: DVec3, moving: &MovingBounds) -> Self {
        // Air does not move along.
        let goes_along = moving.beside < moving.way && self.flight.drag_rate == 0.0;
        let (reach, way) = match goes_along {
            true => (self.seen_along(moving.velocity, since), moving.beside),
            false => (self, moving.way),
        };
        let arm = (reach.flight.position - origin).norm();
        let beside = (way + moving.angle * (arm + reach.way + way)) * (1.0 + MARGIN);
        Self { way: reach.way + beside, beside: reach.beside + beside, ..reach }
    }

    /// Reach in a coordinate system that moves with a velocity \[m/s\], and that was in its place some time before the
    /// flight \[s\].
    fn seen_along(self, velocity: DVec3, since: f64) -> Self {
        let Flight { position, velocity: own, .. } = self.flight;
        let (position, velocity) = (position - since * velocity, own - velocity);
        let flight = Flight { position, velocity, ..self.flight };
        let way = flight.farthest(self.horizon).norm() * (1.0 + MARGIN) + self.beside;
        Self { flight, way, ..self }
    }

    /// Centre of the sphere at the start \[m\].
    pub fn center(&self) -> DVec3 {
        self.flight.position
    }

    /// The same reach, shifted by a distance \[m\].
    pub fn shifted(self, way: DVec3) -> Self {
        let flight = Flight { position: self.flight.position + way, ..self.flight };
        Self { flight, ..self }
    }

    /// Distance from its start that no point of the sphere exceeds \[m\].
    pub fn farthest(&self) -> f64 {
        self.radius + self.way
    }

    /// Whether the sphere cannot meet a surface of this `form` at rest, at the offset `shift` \[m\].
    #[inline]
    pub fn misses(&self, form: &Form, shift: DVec3) -> bool {
        let position = self.flight.position - shift;
        match *form {
            Form::HalfSpace { point, normal } => {
                let offset = position - point;
                let margin = MARGIN * (offset.abs().element_sum() + self.radius);
                offset.dot(normal) - self.approach(normal) > self.radius + margin
            }
            Form::Sphere { center, radius } => {
                let offset = position - center;
                let size = radius + self.radius;
                let margin = MARGIN * (offset.abs().element_sum() + size);
                offset.norm() > size + self.way + margin
            }
            Form::Rectangle(ref rectangle) => self.misses_rectangle(position, rectangle),
            Form::Band(ref band) => {
                let view = band.seen_from(position);
                let margin = MARGIN * (position.abs().element_sum() + band.coordinates());
                let near = if view.front < 0.0 { -view.front } else { view.distance - self.radius };
                near > self.way + margin
            }
            Form::Box(_) | Form::Round(_) | Form::Closed(_) => true,
            Form::Facet(ref facet) => self.misses_rectangle(position, &facet.frame),
            Form::Edge(ref edge) => {
                let size = edge.center.abs().element_sum() + edge.half + self.radius;
                let margin = MARGIN * (position.abs().element_sum() + size);
                edge.distance_of(position) > self.radius + self.way + margin
            }
            Form::Corner(ref corner) => {
                let offset = position - corner.point;
                let margin = MARGIN * (offset.abs().element_sum() + self.radius);
                offset.norm() > self.radius + self.way + margin
            }
        }
    }

    /// Whether the sphere cannot meet another one at the offset `shift` \[m\] within their horizons, where they touch at
    /// the sum of their radii and a part of it `beyond`.
    #[inline]
    pub fn misses_sphere(&self, other: &Self, beyond: f64, shift: DVec3) -> bool {
        let offset = other.flight.position + shift - self.flight.position;
        let sum = self.radius + other.radius;
        let size = sum + beyond * sum;
        let margin = MARGIN * (offset.abs().element_sum() + size);
        offset.norm() > size + self.way + other.way + margin
    }

    /// A rectangle meets only centres in front of its plane.
    #[inline]
    fn misses_rectangle(&self, position: DVec3, rectangle: &Rectangle) -> bool {
        let Rectangle { center, axis_x, axis_z, normal, half_x, half_z, .. } = *rectangle;
        let offset = position - center;
        let margin = MARGIN * (offset.abs().element_sum() + half_x + half_z + self.radius);
        let height = offset.dot(normal);
        if height.abs() > self.radius + self.way + margin {
            return true;
        }
        let stays_above = || height - self.approach(normal) > self.radius + margin;
        let stays_behind = || height + self.approach(-normal) < -margin;
        let stays_beside = |axis: DVec3, half: f64| {
            let place = offset.dot(axis);
            let outward = if place < 0.0 { -axis } else { axis };
            place.abs() - self.approach(outward) > half + self.radius + margin
        };
        (if height < 0.0 { stays_behind() } else { stays_above() })
            || stays_beside(axis_x, half_x)
            || stays_beside(axis_z, half_z)
    }

    /// Largest displacement of the sphere against a direction \[m\]: each part of `v t + a t²/2` in that direction,
    /// for the whole time. Drag makes both smaller.
    #[inline]
    fn approach(&self, direction: DVec3) -> f64 {
        let velocity = (-self.flight.velocity.dot(direction)).max(0.0);
        let acceleration = (-self.flight.acceleration.dot(direction)).max(0.0);
        self.horizon * (velocity + 0.5 * self.horizon * acceleration) * (1.0 + MARGIN) + self.beside
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact_time::sphere_surface;
    use crate::surface::SurfaceMotion;

    /// Numbers in [-1, 1) that look random, the same in every run (Knuth's MMIX generator).
    fn numbers(mut state: u64) -> impl FnMut() -> f64 {
        move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        }
    }

    #[test]
    fn what_is_met_within_the_time_is_never_out_of_reach() {
        let mut next = numbers(1);
        let mut vector = |scale: f64| scale * DVec3::new(next(), next(), next());
        let (mut met, mut passed_over) = (0, 0);
        for _ in 0..100_000 {
            let flight = Flight {
                position: vector(3.0),
                velocity: vector(20.0),
                acceleration: vector(100.0),
                drag_rate: vector(1.0).x.abs() * 5.0,
            };
            let numbers = vector(1.0);
            let (x, y) = (vector(1.0).normalize(), vector(1.0));
            let z = x.cross(y).normalize();
            let rectangle = Rectangle {
                center: vector(1.0),
                axis_x: x,
                axis_z: z,
                normal: z.cross(x),
                half_x: numbers.x.abs(),
                half_z: numbers.y.abs(),
                is_open: true,
            };
            let (center, normal) = (vector(1.0), rectangle.normal);
            let forms = [
                Form::Rectangle(rectangle),
                Form::Sphere { center, radius: numbers.z.abs() },
                Form::HalfSpace { point: center, normal },
            ];
            let (radius, horizon) = (0.3, 0.05);
            for form in forms {
                let contact = sphere_surface(&flight, radius, &form, &SurfaceMotion::REST, horizon);
                let is_out = Reach::of(flight, radius, horizon).misses(&form, DVec3::ZERO);
                assert!(contact.is_none() || !is_out, "{flight:?} {form:?}");
                met += usize::from(contact.is_some());
                passed_over += usize::from(is_out);
            }
        }
        assert!(met > 10_000 && passed_over > 100_000, "{met} {passed_over}");
    }

    #[test]
    fn what_a_moving_surface_meets_within_the_time_is_never_out_of_reach() {
        let mut next = numbers(2);
        let mut vector = |scale: f64| scale * DVec3::new(next(), next(), next());
        let (mut met, mut passed_over) = (0, 0);
        for case in 0..100_000 {
            let drag_rate = if case % 2 == 0 { 0.0 } else { 5.0 };
            let (position, acceleration) = (vector(3.0), vector(100.0));
            let (velocity, along) = (vector(20.0), vector(20.0));
            let flight = Flight { position, velocity: velocity + along, acceleration, drag_rate };
            let form = Form::Sphere { center: vector(1.0), radius: 0.4 };
            let angular_velocity = if case % 3 == 0 { vector(8.0) } else { DVec3::ZERO };
            let motion = SurfaceMotion {
                origin: vector(1.0),
                velocity: along,
                angular_velocity,
                belt: DVec3::ZERO,
                drive: None,
            };
            let (radius, horizon) = (0.3, 0.05);
            let contact = sphere_surface(&flight, radius, &form, &motion, horizon);
            let moving = MovingBounds::steady(&motion, horizon);
            let reach = Reach::of(flight, radius, horizon);
            let reach = reach.seen_from_moving(0.0, motion.origin, &moving);
            let is_out = reach.misses(&form, DVec3::ZERO);
            assert!(contact.is_none() || !is_out, "{flight:?} {form:?} {motion:?}");
            met += usize::from(contact.is_some());
            passed_over += usize::from(is_out);
        }
        assert!(met > 500 && passed_over > 10_000, "{met} {passed_over}");
    }
}
