//! Places in a periodic box.

use glam::DVec3;

/// The image of a place in the box about the origin \[m\]. `period` has the edges of the box,
/// infinite along an open axis.
pub(super) fn folded(place: DVec3, period: DVec3) -> DVec3 {
    match turns_of(place, period) {
        [0, 0, 0] => place,
        turns => place - way_round(turns, period),
    }
}

/// Whether a place is in the box about the origin.
#[inline(always)]
pub(super) fn is_in_box(place: DVec3, period: DVec3) -> bool {
    // One question for all axes, not three that no processor can foresee.
    place.abs().cmple(0.5 * period).all()
}

/// How often a place went round each periodic axis: 0 in the box about the origin.
#[inline]
pub(super) fn turns_of(place: DVec3, period: DVec3) -> [i32; 3] {
    if is_in_box(place, period) {
        return [0; 3];
    }
    [0, 1, 2].map(|axis| {
        // An axis that is open has no turns.
        let turns = place[axis] / period[axis] + 0.5;
        turns.floor() as i32
    })
}

/// The way round each periodic axis this often \[m\]; nothing along open ones.
#[inline]
pub(super) fn way_round(turns: [i32; 3], period: DVec3) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|axis| match turns[axis] {
        0 => 0.0,
        turns => f64::from(turns) * period[axis],
    }))
}
