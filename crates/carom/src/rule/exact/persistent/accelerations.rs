//! Accelerations of spheres under contact forces.

use glam::DVec3;

use crate::norm::Norm;
use crate::respond::{TouchingContact, contact_forces_within};
use crate::rule::exact::contacts::{Member, Touch};
use crate::work::Work;

/// A contact whose normal acceleration is below this part of the free accelerations neither presses nor opens, up
/// to rounding.
pub(super) const IDLE: f64 = 1e-12;

/// Accelerations of the members of a group.
pub(super) struct Accelerations {
    /// Acceleration of each sphere by everything but drag \[m/s²\].
    pub each: Vec<DVec3>,
    /// The largest contribution of a contact force to one of them \[m/s²\].
    pub largest: f64,
}

impl Accelerations {
    /// Accelerations at work at a contact \[m/s²\].
    pub fn scale_at(&self, touch: &Touch, members: &[Member]) -> f64 {
        free_acceleration(&members[touch.second]).norm() + self.largest
    }

    /// Acceleration of a gap \[m/s²\].
    pub fn along(&self, touch: &Touch, members: &[Member]) -> f64 {
        let total = |place: usize| {
            self.each[place] - members[place].species.drag_rate * members[place].velocity
        };
        let first = touch.first.map_or(DVec3::ZERO, total);
        (total(touch.second) - first).dot(touch.normal) + bias(touch, members)
    }
}

/// Acceleration of a sphere without contact forces \[m/s²\].
pub(crate) fn free_acceleration(member: &Member) -> DVec3 {
    member.species.acceleration - member.species.drag_rate * member.velocity
}

/// Acceleration of the gap \[m/s²\] that comes from the turning of the normal: `v²/R` where the
/// bodies slide along a curve, and the swing of a surface that turns; and from the acceleration of a surface.
pub(super) fn bias(touch: &Touch, members: &[Member]) -> f64 {
    let tangential = touch.across(touch.relative_velocity(members));
    let mut curve = touch.curvature.acceleration(tangential);
    if touch.drive_rate > 0.0 {
        curve -= touch.drive.dot(touch.normal);
    }
    let spin = touch.form_spin();
    if spin == DVec3::ZERO {
        return curve;
    }
    // Of the gap n·(x - p), with n' = w × n.
    curve + 2.0 * spin.cross(touch.normal).dot(tangential) + touch.surface_pull.dot(touch.normal)
}

/// Contacts and masses of the members \[kg\] in the form of the solvers.
pub(super) fn contacts_and_masses(
    members: &[Member],
    touches: &[Touch],
) -> (Vec<TouchingContact>, Vec<f64>) {
    let contacts = touches.iter().map(Touch::contact).collect();
    (contacts, members.iter().map(|member| member.species.mass).collect())
}

/// Forces \[N\] of contacts, each >= 0.
pub(super) fn forces(work: &Work, members: &[Member], touches: &[Touch]) -> Vec<f64> {
    let (contacts, masses) = contacts_and_masses(members, touches);
    let mut accelerations: Vec<DVec3> = members.iter().map(free_acceleration).collect();
    let bias: Vec<f64> = touches.iter().map(|touch| bias(touch, members)).collect();
    contact_forces_within(work, &contacts, &masses, &mut accelerations, &bias).forces
}

/// Accelerations under contact forces \[N\].
pub(super) fn accelerations_under(
    members: &[Member],
    touches: &[Touch],
    forces: &[f64],
) -> Accelerations {
    let mut each: Vec<DVec3> = members.iter().map(|member| member.species.acceleration).collect();
    let mut largest = 0.0f64;
    for (touch, &force) in touches.iter().zip(forces) {
        let part = force / members[touch.second].species.mass;
        each[touch.second] += part * touch.normal;
        largest = largest.max(part);
        if let Some(first) = touch.first {
            let part = force / members[first].species.mass;
            each[first] -= part * touch.normal;
            largest = largest.max(part);
        }
    }
    Accelerations { each, largest }
}

/// Whether a contact does not open, up to rounding.
pub(super) fn is_idle(accelerations: &Accelerations, touch: &Touch, members: &[Member]) -> bool {
    accelerations.along(touch, members) <= IDLE * accelerations.scale_at(touch, members)
}

/// Whether bodies that part with a speed \[m/s\] against an acceleration \[m/s²\] meet again within a `duration`
/// \[s\]: after 2 u / a for the speed u and the acceleration a.
pub(crate) fn is_back_within(duration: f64, speed: f64, acceleration: f64) -> bool {
    acceleration > 0.0 && speed <= 0.5 * acceleration * duration
}
