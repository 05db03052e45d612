//! Corrections of persistent contacts: removes the overlaps and normal velocities that rounding or a piece of path
//! left.

use glam::DVec3;

use super::accelerations::contacts_and_masses;
use crate::respond::{contact_forces_within, least_change};
use crate::rule::exact::contact_scale::TOUCHING;
use crate::rule::exact::contacts::{Group, Member, Touch};
use crate::rule::exact::context::StepContext;
use crate::work::Work;

/// Moves overlapping spheres in persistent contact apart, where normals turn, sets normal velocities to zero and
/// measures the contacts again. Returns whether anything moved.
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
    stop_along_normals(context.work, &mut group.members, touches);
    moves_apart
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

/// Brings the normal velocities of contacts to zero.
fn stop_along_normals(work: &Work, members: &mut [Member], touches: &[Touch]) {
    let speeds: Vec<f64> = touches.iter().map(|touch| touch.normal_velocity(members)).collect();
    let changes = corrections(work, members, touches, &speeds);
    for (member, by) in members.iter_mut().zip(changes) {
        member.velocity += by;
    }
}
