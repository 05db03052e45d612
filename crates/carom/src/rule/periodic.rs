//! Positions in a periodic box.
//!
//! An image offset counts boxes along each axis; the shift is that way in metres.

use glam::DVec3;

/// The image of a position in the box about the origin \[m\]. `period` has the edges of the box,
/// infinite along an open axis.
pub(crate) fn wrapped(position: DVec3, period: DVec3) -> DVec3 {
    if is_in_box(position, period) {
        return position;
    }
    // Boxes may be more than an image offset counts. Along an open axis this is the floor of a half.
    let boxes = (position / period + 0.5).floor();
    let way = DVec3::select(period.is_finite_mask(), boxes * period, DVec3::ZERO);
    // From very far away, rounding leaves no place within the box.
    (position - way).clamp(-0.5 * period, 0.5 * period)
}

/// The image of a position that is nearest to a place \[m\]. `period` has the edges of the box, infinite along
/// an open axis.
pub(super) fn image_near(position: DVec3, place: DVec3, period: DVec3) -> DVec3 {
    if period == DVec3::INFINITY {
        return position;
    }
    let boxes = ((place - position) / period).round();
    position + DVec3::select(period.is_finite_mask(), boxes * period, DVec3::ZERO)
}

/// Whether a position is in the box about the origin.
#[inline(always)]
pub(super) fn is_in_box(position: DVec3, period: DVec3) -> bool {
    // One comparison for all axes, not three branches that the processor cannot predict.
    position.abs().cmple(0.5 * period).all()
}

/// How many boxes a position is away from the box about the origin, along each periodic axis.
#[inline]
pub(super) fn image_offset_of(position: DVec3, period: DVec3) -> [i32; 3] {
    if is_in_box(position, period) {
        return [0; 3];
    }
    [0, 1, 2].map(|axis| {
        // Along an open axis this is a half, so 0.
        let boxes = position[axis] / period[axis] + 0.5;
        boxes.floor() as i32
    })
}

/// The way across numbers of boxes along the periodic axes \[m\]; zero along open ones.
#[inline]
pub(super) fn image_shift(offset: [i32; 3], period: DVec3) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|axis| match offset[axis] {
        0 => 0.0,
        boxes => f64::from(boxes) * period[axis],
    }))
}
