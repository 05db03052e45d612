//! Persistent contacts of a sphere in a corner: which ones stay, with which forces, and for how long.

use glam::DVec3;

use super::accelerations::{IDLE, free_acceleration};
use super::sliding::time_on_face;
use super::solve::is_back_within;
use crate::flight::Flight;
use crate::norm::Norm;
use crate::rule::exact::contacts::{Corner, MOST_PLANES, Member, beyond};
use crate::rule::exact::flights::AxisMotion;
use crate::surface::Form;

/// How a sphere goes on in its persistent contacts.
pub(crate) struct PlanarSupport {
    /// \[m/s\]
    pub velocity: DVec3,
    /// Of everything but drag \[m/s²\].
    pub acceleration: DVec3,
    /// How long that holds \[s\]; infinite if longer than the given duration.
    pub valid_for: f64,
    /// Which contacts persist, in the order of the planes; the others part.
    pub persists: [bool; MOST_PLANES],
}

/// How a sphere that touches the planes of a corner goes on: where it is pressed on one, without the
/// part along the normal; elsewhere the contact parts. `None` where no contact is left.
///
/// All of that holds for a `duration` \[s\]. Contacts that part for less than a contact's duration
/// \[s\] persist, and what holds for less is in doubt only by rounding.
///
/// Forces at right angles do not depend on each other, so each follows from its own plane, as it
/// would from [`contact_forces`](crate::respond::contact_forces).
pub(crate) fn support(
    member: &Member,
    corner: &Corner,
    contact_duration: f64,
    duration: f64,
) -> Option<PlanarSupport> {
    let Member { position, mut velocity, species, .. } = *member;
    let (mut acceleration, mut largest) = (species.acceleration, 0.0f64);
    let mut persists = [false; MOST_PLANES];
    let pull = free_acceleration(member).norm();
    for (plane, persists) in corner.planes().zip(&mut persists) {
        // Along the plane, drag has no part in what presses on it.
        let pressing = -species.acceleration.dot(plane.normal);
        let parting = velocity.dot(plane.normal);
        let is_back = is_back_within(contact_duration, parting, pull);
        *persists = is_back && pressing >= -IDLE * pull;
        if *persists {
            let pressing = pressing.max(0.0);
            acceleration += pressing * plane.normal;
            velocity -= parting * plane.normal;
            largest = largest.max(pressing);
        }
    }
    if largest == 0.0 {
        return None;
    }
    if acceleration.norm() <= IDLE * (species.acceleration.norm() + largest) {
        acceleration = DVec3::ZERO;
    }
    let motion = |axis: DVec3| AxisMotion {
        velocity: velocity.dot(axis),
        acceleration: acceleration.dot(axis),
        drag_rate: species.drag_rate,
    };
    let flight = Flight { position, velocity, acceleration, drag_rate: species.drag_rate };
    let way = flight.farthest(duration).element_sum();
    let mut valid_for = f64::INFINITY;
    for (plane, persists) in corner.planes().zip(persists) {
        // Nothing may be known of how far that is in endless time.
        let is_within = |beyond: f64| beyond + way < 0.0;
        if let Form::Rectangle(face) = plane.form
            && persists
            && !beyond(face, position).into_iter().all(is_within)
        {
            valid_for = valid_for.min(time_on_face(face, position, motion));
        }
    }
    let valid_for = valid_for.max(contact_duration);
    Some(PlanarSupport { velocity, acceleration, valid_for, persists })
}
