//! What a sphere cannot come to within a short time, by bounds alone.

use glam::DVec3;

use crate::flight::Flight;
use crate::norm::Norm;
use crate::surface::{Form, Rectangle};

/// Distances are compared with this part of the coordinates to spare: far more than their rounding,
/// far less than what the comparison saves.
const MARGIN: f64 = 1e-9;

/// Whether a sphere in flight certainly meets no surface of this `form`, at rest, within `horizon`
/// \[s\].
///
/// `radius` of the sphere \[m\], > 0.
#[inline]
pub(crate) fn is_out_of_reach(flight: &Flight, radius: f64, form: &Form, horizon: f64) -> bool {
    match *form {
        Form::HalfSpace { point, normal } => {
            let offset = flight.position - point;
            let margin = MARGIN * (offset.abs().element_sum() + radius);
            offset.dot(normal) - approach(flight, normal, horizon) > radius + margin
        }
        Form::Sphere { center, radius: own } => {
            let offset = flight.position - center;
            let margin = MARGIN * (offset.abs().element_sum() + radius + own);
            let way =
                horizon * (flight.velocity.norm() + 0.5 * horizon * flight.acceleration.norm());
            offset.norm() > own + radius + way * (1.0 + MARGIN) + margin
        }
        Form::Rectangle(ref rectangle) => {
            is_rectangle_out_of_reach(flight, radius, rectangle, horizon)
        }
        Form::Box(_) => true,
    }
}

/// A rectangle meets only centres in front of its plane.
#[inline]
fn is_rectangle_out_of_reach(
    flight: &Flight,
    radius: f64,
    rectangle: &Rectangle,
    horizon: f64,
) -> bool {
    let Rectangle { center, axis_x, axis_z, normal, half_x, half_z } = *rectangle;
    let offset = flight.position - center;
    let margin = MARGIN * (offset.abs().element_sum() + half_x + half_z + radius);
    let height = offset.dot(normal);
    let stays_above = || height - approach(flight, normal, horizon) > radius + margin;
    let stays_behind = || height + approach(flight, -normal, horizon) < -margin;
    let stays_beside = |axis: DVec3, half: f64| {
        let place = offset.dot(axis);
        let outward = if place < 0.0 { -axis } else { axis };
        place.abs() - approach(flight, outward, horizon) > half + radius + margin
    };
    (if height < 0.0 { stays_behind() } else { stays_above() })
        || stays_beside(axis_x, half_x)
        || stays_beside(axis_z, half_z)
}

/// How far a sphere goes at most against a direction within `horizon` \[s\] \[m\]: each part of
/// `v t + a t²/2` that leads there, for all of that time. Drag makes both smaller.
#[inline]
fn approach(flight: &Flight, direction: DVec3, horizon: f64) -> f64 {
    let velocity = (-flight.velocity.dot(direction)).max(0.0);
    let acceleration = (-flight.acceleration.dot(direction)).max(0.0);
    horizon * (velocity + 0.5 * horizon * acceleration) * (1.0 + MARGIN)
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
                let is_out = is_out_of_reach(&flight, radius, &form, horizon);
                assert!(contact.is_none() || !is_out, "{flight:?} {form:?}");
                met += usize::from(contact.is_some());
                passed_over += usize::from(is_out);
            }
        }
        assert!(met > 10_000 && passed_over > 100_000, "{met} {passed_over}");
    }
}
