//! Forces at contacts that last.

use glam::DVec3;

use super::group::{Group, Motion};
use super::project::Projector;
use super::resolve::unit_of;
use super::touching::TouchingContact;

/// Forces \[N\] that keep touching bodies from accelerating into each other, one per contact,
/// >= 0: along the normal on body 2, against it on body 1.
///
/// With the normal acceleration `w = (a2 - a1)·n + bias` that results, `f >= 0, w >= 0, f w = 0`:
/// a contact either holds or pushes nothing (Signorini's condition on accelerations: Lötstedt,
/// SIAM J. Appl. Math. 42, 281 (1982); Baraff, SIGGRAPH 1989). Where contacts are redundant, one
/// of many distributions; the accelerations are unique.
///
/// - `contacts` whose bodies touch and neither close nor open; `surface_velocity` and
///   `restitution` are not read
/// - `masses` \[kg\], `accelerations` \[m/s²\] of the spheres without contact forces, replaced by
///   those with them
/// - `normal_acceleration_bias` \[m/s²\], one per contact: what the second derivative of the
///   distance has besides, `|v_t|²/R` for sliding speed v_t and distance R of centres (radius of
///   the sphere's path), less the acceleration of a moving surface along the normal
///
/// # Panics
/// If a contact names a body that has no mass or acceleration, or has no bias.
pub fn contact_forces(
    contacts: &[TouchingContact],
    masses: &[f64],
    accelerations: &mut [DVec3],
    normal_acceleration_bias: &[f64],
) -> Vec<f64> {
    let biases = normal_acceleration_bias.iter().map(|bias| DVec3::X * *bias);
    let Some(unit) = unit_of(accelerations.iter().copied().chain(biases)) else {
        return vec![0.0; contacts.len()];
    };
    let mut group = Group::new(contacts, masses, 1.0);
    for link in &mut group.links {
        link.surface_velocity = DVec3::ZERO;
    }
    let mut motion = Motion::default();
    motion.velocities.extend(accelerations.iter().map(|a| *a / unit));
    let mut projector = Projector::default();
    let target = |contact: usize| -normal_acceleration_bias[contact] / unit;
    projector.project(&group, |_| true, target, &mut motion.velocities);
    for (acceleration, scaled) in accelerations.iter_mut().zip(motion.velocities) {
        *acceleration = unit * scaled;
    }
    projector.impulses().iter().map(|force| unit * force).collect()
}
