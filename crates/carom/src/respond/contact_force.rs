//! Forces at contacts that last.

use glam::DVec3;

use super::complementarity::Outcome;
use super::group::{Group, speed_scale, tolerance};
use super::project::Projector;
use super::resolve::unit_of;
use super::touching::TouchingContact;
use crate::work::Work;

/// Forces at the contacts of a group.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ContactForces {
    /// One per contact \[N\], >= 0: along the normal on body 2, against it on body 1. Where
    /// contacts are redundant, as under a table with four legs, one of many distributions.
    pub forces: Vec<f64>,
    /// Normal acceleration \[m/s²\] below which a contact counts as neither closing nor opening:
    /// the rounding of the accelerations in the group.
    pub resolution: f64,
    /// Whether the conditions hold. If not, no forces can keep the bodies apart, as between
    /// surfaces that approach each other; the forces are then those without the bias.
    pub complete: bool,
}

/// Forces that keep touching bodies from accelerating into each other; gives the spheres the
/// accelerations with them.
///
/// With the normal acceleration `w = (a2 − a1)·n + bias` that results, `f >= 0, w >= 0, f w = 0`:
/// a contact either lasts or pushes nothing. The accelerations are those nearest to the free ones
/// in the norm of the masses (Gauss's principle of least constraint), and unique. Source:
/// Lötstedt, "Mechanical systems of rigid bodies subject to unilateral constraints", SIAM J.
/// Appl. Math. 42, 281 (1982); Baraff, "Fast contact force computation for nonpenetrating rigid
/// bodies", SIGGRAPH 1994.
///
/// - `contacts` whose bodies touch and neither close nor open; `surface_velocity` and
///   `restitution` are not read
/// - `masses` \[kg\], > 0; `accelerations` \[m/s²\] of the spheres: in, without contact forces;
///   out, with them. If any is not finite, all are left as they are
/// - `normal_acceleration_bias` \[m/s²\], one per contact: what the second derivative of the
///   distance has besides. `|v_t|²/R` where bodies slide on each other with speed v_t, R being
///   the distance of the centres, or zero on a flat surface; less the acceleration of a moving
///   surface along the normal
///
/// # Panics
/// If a contact names a sphere that has no mass or acceleration, or has no bias.
pub fn contact_forces(
    contacts: &[TouchingContact],
    masses: &[f64],
    accelerations: &mut [DVec3],
    normal_acceleration_bias: &[f64],
) -> ContactForces {
    let work = Work::unlimited();
    contact_forces_within(&work, contacts, masses, accelerations, normal_acceleration_bias)
}

/// [`contact_forces`] as part of the work of a step. If that has to end, the forces are any.
pub(crate) fn contact_forces_within(
    work: &Work,
    contacts: &[TouchingContact],
    masses: &[f64],
    accelerations: &mut [DVec3],
    normal_acceleration_bias: &[f64],
) -> ContactForces {
    let biases = normal_acceleration_bias.iter().map(|bias| DVec3::X * *bias);
    let Some(unit) = unit_of(accelerations.iter().copied().chain(biases)) else {
        let forces = vec![0.0; contacts.len()];
        return ContactForces { forces, resolution: 0.0, complete: true };
    };
    let group = Group::at_rest(contacts, masses, work);
    let free: Vec<DVec3> = accelerations.iter().map(|a| *a / unit).collect();
    let mut held = free.clone();
    let mut projector = Projector::default();
    let target = |contact: usize| -normal_acceleration_bias[contact] / unit;
    let outcome = projector.project(&group, |_| true, target, &mut held);
    if outcome == Outcome::Jammed {
        held.copy_from_slice(&free);
        projector.project(&group, |_| true, |_| 0.0, &mut held);
    }
    for (acceleration, held) in accelerations.iter_mut().zip(&held) {
        *acceleration = unit * *held;
    }
    let scale = speed_scale(held.iter().chain(&free).copied());
    ContactForces {
        forces: projector.impulses().iter().map(|force| unit * force).collect(),
        resolution: unit * tolerance(scale).coarse.max(projector.resolution()),
        complete: outcome == Outcome::Solved,
    }
}
