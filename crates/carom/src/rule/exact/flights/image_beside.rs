//! Images of spheres beside what they touch in a periodic box.

use glam::DVec3;

use crate::detect::sphere_surface;
use crate::rule::periodic::image_shift;
use crate::settings::nearest_image;
use crate::surface::Form;

/// Shift \[m\] of a sphere to its image nearest to another one, by the offset \[m\] from that one. `period` has the edges
/// of the box \[m\], infinite along an open axis.
pub(super) fn shift_beside_sphere(offset: DVec3, period: DVec3) -> DVec3 {
    if period == DVec3::INFINITY {
        return DVec3::ZERO;
    }
    nearest_image(offset, period) - offset
}

/// Shift \[m\] of a sphere with this centre \[m\] to its image nearest to a surface. `period` has the edges of the box
/// \[m\], infinite along an open axis.
pub(super) fn shift_beside_surface(form: &Form, center: DVec3, period: DVec3) -> DVec3 {
    if period == DVec3::INFINITY || matches!(form, Form::HalfSpace { .. }) {
        return DVec3::ZERO;
    }
    // Of equally near images that without a shift.
    let boxes = |axis: usize| if period[axis].is_finite() { &[0, -1, 1][..] } else { &[0] };
    let along_z = |x: i32, y: i32| boxes(2).iter().map(move |&z| image_shift([x, y, z], period));
    let shifts = boxes(0).iter().flat_map(|&x| boxes(1).iter().flat_map(move |&y| along_z(x, y)));
    let distance = |shift: DVec3| {
        let separation = sphere_surface(form, center + shift, 0.0);
        separation.map_or(f64::INFINITY, |separation| separation.distance)
    };
    shifts.min_by(|&a, &b| distance(a).total_cmp(&distance(b))).unwrap_or(DVec3::ZERO)
}
