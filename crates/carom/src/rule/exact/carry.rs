//! Lasting contacts of a sphere in a corner: which ones stay, with which forces, and for how long.

use glam::DVec3;

use super::axis_motion::AxisMotion;
use super::corner::{Corner, MOST_PLANES};
use super::group::Member;
use super::support::{self, IDLE};
use super::touch::beyond;
use crate::flight::Flight;
use crate::norm::Norm;
use crate::surface::Form;

/// How a sphere goes on in its lasting contacts.
pub(super) struct Carried {
    /// \[m/s\]
    pub velocity: DVec3,
    /// Of everything but drag \[m/s²\].
    pub acceleration: DVec3,
    /// How long that holds \[s\]; infinite if it is for longer than was asked.
    pub hold: f64,
    /// Which contacts last, in the order of the planes; the others part.
    pub lasts: [bool; MOST_PLANES],
}

/// How a sphere that touches the planes of a corner goes on: where it is pressed on one, without the
/// part along the normal; elsewhere the contact parts. `None` where no contact is left.
///
/// All of that is asked for a `duration` \[s\]. Contacts that part for less than a contact's duration
/// \[s\] last, and what holds for less is in doubt only by rounding.
///
/// Forces at right angles do not depend on each other, so each follows from its own plane, as it
/// would from [`contact_forces`](crate::respond::contact_forces).
pub(super) fn carry(
    member: &Member,
    corner: &Corner,
    contact_duration: f64,
    duration: f64,
) -> Option<Carried> {
    let Member { position, mut velocity, kind, .. } = *member;
    let (mut acceleration, mut largest) = (kind.acceleration, 0.0f64);
    let mut lasts = [false; MOST_PLANES];
    let pull = support::free_acceleration(member).norm();
    for (plane, lasts) in corner.planes().zip(&mut lasts) {
        // Along the plane, drag has no part in what presses on it.
        let pressing = -kind.acceleration.dot(plane.normal);
        let parting = velocity.dot(plane.normal);
        let is_slow = support::is_back_within(contact_duration, parting, pull);
        *lasts = is_slow && pressing >= -IDLE * pull;
        if *lasts {
            let pressing = pressing.max(0.0);
            acceleration += pressing * plane.normal;
            velocity -= parting * plane.normal;
            largest = largest.max(pressing);
        }
    }
    if largest == 0.0 {
        return None;
    }
    if acceleration.norm() <= IDLE * (kind.acceleration.norm() + largest) {
        acceleration = DVec3::ZERO;
    }
    let motion = |axis: DVec3| AxisMotion {
        velocity: velocity.dot(axis),
        acceleration: acceleration.dot(axis),
        drag_rate: kind.drag_rate,
    };
    let flight = Flight { position, velocity, acceleration, drag_rate: kind.drag_rate };
    let way = flight.farthest(duration).element_sum();
    let mut hold = f64::INFINITY;
    for (plane, lasts) in corner.planes().zip(lasts) {
        // Nothing may be known of how far that is in endless time.
        let is_within = |beyond: f64| beyond + way < 0.0;
        if let Form::Rectangle(face) = plane.form
            && lasts
            && !beyond(face, position).into_iter().all(is_within)
        {
            hold = hold.min(support::time_on_face(face, position, motion));
        }
    }
    let hold = hold.max(contact_duration);
    Some(Carried { velocity, acceleration, hold, lasts })
}
