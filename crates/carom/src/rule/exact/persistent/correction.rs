//! Corrections of persistent contacts: removes the overlaps and normal velocities that rounding or a piece of path
//! left.

use glam::DVec3;

use super::accelerations::contacts_and_masses;
use crate::norm::Norm;
use crate::respond::{contact_forces_within, least_change};
use crate::rule::exact::contacts::contact_scale::TOUCHING;
use crate::rule::exact::contacts::{Group, Member, Touch};
use crate::rule::exact::context::StepContext;
use crate::work::Work;

/// A correction of velocities by more than this many times the normal velocities that it removes, and by more than
/// [`MOST_CHANGED`] of the speed, would stop a sphere that crosses between contacts whose normals hardly differ.
const MOST_AMPLIFIED: f64 = 1e3;
/// A part of a speed that is far above what rounding or a piece of path leaves.
const MOST_CHANGED: f64 = 1e-6;

/// Moves overlapping spheres in persistent contact apart, where normals turn, sets normal velocities to zero and
/// measures the contacts again. A contact that opens ends where that would take a sphere's speed along another one.
/// Returns whether spheres moved or contacts ended.
pub(super) fn correct(context: &StepContext, group: &mut Group, touches: &mut Vec<Touch>) -> bool {
    let overlaps = |touch: &Touch| touch.gap < -TOUCHING * group.scale(touch).length;
    let moves_apart = touches.iter().any(Touch::is_curved) && touches.iter().any(overlaps);
    if moves_apart {
        let moves = separations(context.work, &group.members, touches);
        for (member, by) in group.members.iter_mut().zip(moves) {
            member.position += by;
        }
        let (members, time) = (&group.members, group.time);
        *touches = touches.iter().filter_map(|it| it.measured_at(context, members, time)).collect();
    }
    let count = touches.len();
    stop_along_normals(context.work, &mut group.members, touches);
    moves_apart || touches.len() < count
}

/// The least change of the members, weighted by mass, that removes `excess` along the normals.
pub(super) fn corrections(
    work: &Work,
    members: &[Member],
    touches: &[Touch],
    excess: &[f64],
) -> Vec<DVec3> {
    let (contacts, masses) = contacts_and_masses(members, touches);
    least_change(work, &contacts, &masses, excess)
}
/// The least moves of the members, weighted by mass, after which none of the contacts overlaps: the
/// problem of contact forces, with moves for accelerations.
fn separations(work: &Work, members: &[Member], touches: &[Touch]) -> Vec<DVec3> {
    let (contacts, masses) = contacts_and_masses(members, touches);
    let gaps: Vec<f64> = touches.iter().map(|touch| touch.gap).collect();
    let mut moves = vec![DVec3::ZERO; members.len()];
    if contact_forces_within(work, &contacts, &masses, &mut moves, &gaps).complete {
        moves
    } else {
        vec![DVec3::ZERO; members.len()]
    }
}

/// Brings the normal velocities of contacts to zero. Where that would take more than the contacts have, as between two
/// facets of a mesh in almost one plane, the contact that opens most is left out.
fn stop_along_normals(work: &Work, members: &mut [Member], touches: &mut Vec<Touch>) {
    let largest = |vectors: &[DVec3]| vectors.iter().map(|it| it.norm()).fold(0.0, f64::max);
    let velocities: Vec<DVec3> = members.iter().map(|member| member.velocity).collect();
    let most_changed = MOST_CHANGED * largest(&velocities);
    loop {
        let speeds: Vec<f64> = touches.iter().map(|touch| touch.normal_velocity(members)).collect();
        let changes = corrections(work, members, touches, &speeds);
        let removed = speeds.iter().copied().map(f64::abs).fold(0.0, f64::max);
        if largest(&changes) > most_changed.max(MOST_AMPLIFIED * removed) {
            let opening = (0..speeds.len()).max_by(|&a, &b| speeds[a].total_cmp(&speeds[b]));
            opening.map(|place| touches.remove(place));
            continue;
        }
        for (member, by) in members.iter_mut().zip(changes) {
            member.velocity += by;
        }
        return;
    }
}
