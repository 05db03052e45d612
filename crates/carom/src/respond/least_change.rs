//! The least change of bodies that makes up for what contacts have too much.

use glam::DVec3;

use super::group::Group;
use super::order_free::{Steps, sum_of};
use super::problem::push;
use super::touching::TouchingContact;
use crate::work::Work;

/// Where contacts differ by less than that in their normals \[rad\], as the faces of a box do in their
/// common edge, what distinguishes them is rounding: a gap of 1e-16 m would be closed by a way as long
/// as it divided by that.
const SAME_NORMAL: f64 = 1e-8;

/// Iterations for each contact: conjugate gradients on exact numbers need one.
const ITERATIONS: usize = 2;

/// The least change of the bodies, weighted by mass, that takes away `excess` along the normals of
/// contacts: `M⁻¹ N λ` with `Nᵀ M⁻¹ N λ = -excess`, by conjugate gradients.
///
/// - `contacts`: of bodies numbered from 0; `surface_velocity` and `restitution` are not read
/// - `masses` \[kg\], > 0, one per body
/// - `excess`: one per contact, of velocities \[m/s\] or gaps \[m\]
pub(crate) fn least_change(
    work: &Work,
    contacts: &[TouchingContact],
    masses: &[f64],
    excess: &[f64],
) -> Vec<DVec3> {
    let group = Group::at_rest(contacts, masses, work);
    let mut steps = vec![Steps::default(); masses.len()];
    let mut spread = |weights: &[f64], changes: &mut [DVec3]| {
        push(&group.links, |body| 1.0 / masses[body], |i| weights[i], &mut steps, changes);
    };
    let mut terms = Vec::with_capacity(excess.len());
    let mut dot = |a: &[f64], b: &[f64]| sum_of(&mut terms, a.iter().zip(b).map(|(a, b)| a * b));
    // What the curvature would be if no contact shared a body with another.
    let each_alone = |weights: &[f64]| -> f64 {
        let inverse_mass = |body: u32| 1.0 / masses[body as usize];
        let links = group.links.iter().zip(weights);
        let of = links.map(|(link, weight)| {
            let both = inverse_mass(link.second) + link.first.map_or(0.0, inverse_mass);
            weight * weight * both
        });
        of.sum()
    };
    let mut changes = vec![DVec3::ZERO; masses.len()];
    let mut weights = vec![0.0; excess.len()];
    let mut residual: Vec<f64> = excess.iter().map(|excess| -excess).collect();
    let (mut direction, mut image) = (residual.clone(), residual.clone());
    let mut square = dot(&residual, &residual);
    // Of the squares: what is left is below the rounding of what was there.
    let enough = square * (f64::EPSILON * f64::EPSILON);
    for _ in 0..ITERATIONS * contacts.len() {
        if square <= enough || !work.spend(contacts.len() as u64) {
            break;
        }
        spread(&direction, &mut changes);
        for (image, link) in image.iter_mut().zip(&group.links) {
            *image = link.rate(&changes);
        }
        let curvature = dot(&direction, &image);
        if curvature <= SAME_NORMAL * SAME_NORMAL * each_alone(&direction) {
            break;
        }
        let step = square / curvature;
        for (weight, part) in weights.iter_mut().zip(&direction) {
            *weight += step * part;
        }
        for (residual, part) in residual.iter_mut().zip(&image) {
            *residual -= step * part;
        }
        let next = dot(&residual, &residual);
        for (part, residual) in direction.iter_mut().zip(&residual) {
            *part = residual + next / square * *part;
        }
        square = next;
    }
    spread(&weights, &mut changes);
    changes
}
