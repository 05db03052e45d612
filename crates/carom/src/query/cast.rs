//! The first contact of a sphere on a straight path.

use glam::DVec3;

use crate::bounds::Bounds;
use crate::contact_time;
use crate::detect::{Separation, known_in_front, sphere_surface};
use crate::flight::Flight;
use crate::norm::Norm;
use crate::surface::{Form, SurfaceMotion};

/// Distances below this part of the coordinates are rounding, as in the search for contact times.
const ROUNDING: f64 = 32.0 * f64::EPSILON;
/// Bounds are widened by this part of the coordinates: more than rounding.
const SLACK: f64 = 1e-9;
/// A ray is first treated as a sphere with this part of the coordinates as its radius. Rectangles have a front
/// only, and rounding might put a point on one behind it.
const THIN: f64 = 1e-9;
/// Newton's method on a convex function doubles its digits, from [`THIN`] to all of them in one or two steps; on a
/// path past an edge it may take as many as there are bits.
const MOST_STEPS: u32 = 64;

/// A sphere on a straight path; a ray has the radius 0.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sweep {
    /// \[m\]
    start: DVec3,
    /// Radius \[m\].
    radius: f64,
    /// Displacement \[m\].
    way: DVec3,
    /// One over the way along each axis \[1/m\].
    inverse: DVec3,
    /// Distance by which bounds are widened \[m\].
    margin: f64,
}

impl Sweep {
    pub fn new(start: DVec3, radius: f64, way: DVec3) -> Self {
        let size = start.abs().max_element() + radius + way.abs().max_element();
        Self { start, radius, way, inverse: way.recip(), margin: radius + SLACK * size }
    }

    /// Returns the sweep relative to a place \[m\].
    pub fn seen_from(self, place: DVec3) -> Self {
        Self { start: self.start - place, ..self }
    }

    /// Bounds of the whole way.
    pub fn bounds(&self) -> Bounds {
        let end = self.start + self.way;
        Bounds { min: self.start.min(end), max: self.start.max(end) }.widened(self.margin)
    }

    /// A lower bound of the part of the path before these bounds; infinite if it never reaches them.
    #[inline]
    pub fn reaches(&self, bounds: &Bounds) -> f64 {
        let one = (bounds.min - self.margin - self.start) * self.inverse;
        let other = (bounds.max + self.margin - self.start) * self.inverse;
        let (mut enter, mut leave) = (0.0f64, 1.0f64);
        for axis in 0..3 {
            if self.way[axis] == 0.0 {
                let is_beside = self.start[axis] < bounds.min[axis] - self.margin
                    || self.start[axis] > bounds.max[axis] + self.margin;
                leave = if is_beside { -1.0 } else { leave };
            } else {
                enter = enter.max(one[axis].min(other[axis]));
                leave = leave.min(one[axis].max(other[axis]));
            }
        }
        // The widening is more than the rounding of both.
        if enter <= leave { enter } else { f64::INFINITY }
    }

    /// Part of the path before the sphere touches a form, and their separation there. For a volume that only
    /// `encloses`, a sphere outside meets the faces, which are forms of their own.
    pub fn meet(&self, form: &Form, encloses: bool) -> Option<(f64, Separation)> {
        let rounding = ROUNDING * (form.coordinates() + self.start.norm() + self.radius);
        let start = sphere_surface(form, self.start, self.radius);
        if let Some(start) = start.filter(|start| start.distance < -rounding) {
            return Some((0.0, start));
        }
        if encloses || self.way == DVec3::ZERO {
            return None;
        }
        match form {
            Form::Box(solid) => {
                let faces = solid.faces().into_iter().map(Form::Rectangle);
                let meetings = faces.filter_map(|face| self.come_to(&face));
                meetings.min_by(|one, other| one.0.total_cmp(&other.0))
            }
            Form::Round(solid) => {
                let meetings = solid.bands().filter_map(|band| self.come_to(&Form::Band(band)));
                meetings.min_by(|one, other| one.0.total_cmp(&other.0))
            }
            _ => self.come_to(form),
        }
    }

    /// Contact with a form that the sphere does not overlap at the start.
    fn come_to(&self, form: &Form) -> Option<(f64, Separation)> {
        // These have an inside, where rounding may put a point.
        let is_solid = matches!(form, Form::Sphere { .. } | Form::HalfSpace { .. });
        if self.radius > 0.0 || is_solid {
            let fraction = self.contact_at(form, self.radius)?;
            return Some((fraction, self.separation_at(form, fraction)?));
        }
        let size = form.coordinates() + self.start.norm() + self.way.norm();
        let (thin, rounding) = (THIN * size, ROUNDING * size);
        let mut fraction = self.contact_at(form, thin)?;
        for _ in 0..MOST_STEPS {
            let separation = self.separation_at(form, fraction)?;
            if separation.distance <= rounding {
                return Some((fraction, separation));
            }
            let closing = -self.way.dot(separation.normal);
            fraction += separation.distance / closing;
            if closing <= 0.0 || fraction > 1.0 {
                return None;
            }
        }
        None
    }

    /// Part of the path before a sphere with this radius \[m\] touches a form.
    fn contact_at(&self, form: &Form, radius: f64) -> Option<f64> {
        let flight = Flight {
            position: self.start,
            velocity: self.way,
            acceleration: DVec3::ZERO,
            drag_rate: 0.0,
        };
        contact_time::sphere_surface(&flight, radius, form, &SurfaceMotion::REST, 1.0)
    }

    fn separation_at(&self, form: &Form, fraction: f64) -> Option<Separation> {
        known_in_front(form, self.start + fraction * self.way, self.radius)
    }
}
