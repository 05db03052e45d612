//! Lasting contacts that go on while the forces change: those of a sphere with planes at rest.

use glam::DVec3;

use super::axis_motion::AxisMotion;
use super::group::Member;
use super::support::{self, IDLE};
use super::touch::beyond;
use crate::flight::Flight;
use crate::norm::Norm;
use crate::surface::{Form, Surface};

/// Planes at right angles to each other, at most.
const MOST_PLANES: usize = 3;

/// How a sphere goes on in its lasting contacts.
pub(super) struct Carried {
    /// \[m/s\]
    pub velocity: DVec3,
    /// Of everything but drag \[m/s²\].
    pub acceleration: DVec3,
    /// How long that holds \[s\]; infinite if it is for longer than was asked.
    pub hold: f64,
    /// Which contacts go on; the others part.
    pub lasts: [bool; MOST_PLANES],
}

/// How a sphere in lasting contact with surfaces goes on under another acceleration, that of
/// `member`: where it is pressed on a plane, without the part along the normal; elsewhere the contact
/// parts. `None` where no contact is left, or where they are not with planes at rest that stand at
/// right angles: then lasting contacts have to be found anew.
///
/// All of that is asked for a `duration` \[s\].
///
/// Forces at right angles do not depend on each other, so each follows from its own plane, as it
/// would from [`contact_forces`](crate::respond::contact_forces).
pub(super) fn carry<'a>(
    member: &Member,
    surfaces: impl Iterator<Item = &'a Surface>,
    duration: f64,
) -> Option<Carried> {
    let free = support::free_acceleration(member);
    let Member { position, mut velocity, kind, .. } = *member;
    let (mut acceleration, mut largest) = (kind.acceleration, 0.0f64);
    let (mut planes, mut lasts) = ([None; MOST_PLANES], [false; MOST_PLANES]);
    for (place, surface) in surfaces.enumerate() {
        let normal = plane_under(surface, position)?;
        if place == MOST_PLANES
            || planes.iter().flatten().any(|&(known, _)| normal.dot(known) != 0.0)
        {
            return None;
        }
        planes[place] = Some((normal, &surface.form));
        let pressing = -free.dot(normal);
        lasts[place] = pressing >= -IDLE * free.norm();
        if lasts[place] {
            let pressing = pressing.max(0.0);
            acceleration += pressing * normal;
            velocity -= velocity.dot(normal) * normal;
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
    for (plane, lasts) in planes.iter().zip(lasts) {
        if let Some((_, Form::Rectangle(face))) = plane
            && lasts
            && beyond(face, position).into_iter().any(|beyond| beyond + way >= 0.0)
        {
            hold = hold.min(support::time_on_face(face, position, motion));
        }
    }
    Some(Carried { velocity, acceleration, hold, lasts })
}

/// The normal of a plane at rest on which a sphere about `center` \[m\] lies; not over an edge.
fn plane_under(surface: &Surface, center: DVec3) -> Option<DVec3> {
    match &surface.form {
        _ if !surface.motion.is_at_rest() => None,
        Form::HalfSpace { normal, .. } => Some(*normal),
        Form::Rectangle(rectangle) => {
            let is_over = beyond(rectangle, center).into_iter().all(|beyond| beyond < 0.0);
            is_over.then_some(rectangle.normal)
        }
        Form::Sphere { .. } | Form::Box(_) => None,
    }
}
