//! Impact law `sequential`: pair after pair.

use glam::DVec3;

use super::complementarity::Outcome;
use super::group::{Answer, Group};
use super::plastic;
use super::project::Projector;
use super::{line_of_centres, reflection};

/// Sweeps over all contacts before what is left is finished plastically. Elastic equal spheres
/// need about as many as there are spheres in a row; with e < 1, closing speeds fall
/// geometrically.
const MAX_SWEEPS: usize = 1000;

/// Answers contacts in their order, each by Newton's law if it closes when its turn comes; again
/// and again until none closes.
///
/// Source: Chatterjee and Ruina, "A new algebraic rigid-body collision law based on impulse space
/// considerations", J. Appl. Mech. 65, 939 (1998), discuss such sequences.
pub(super) fn resolve(group: &Group, start: &[DVec3], projector: &mut Projector) -> Answer {
    let mut answer = Answer::unchanged(group, start);
    for _ in 0..MAX_SWEEPS {
        if !group.work.spend(group.links.len() as u64) {
            break;
        }
        let mut calm = true;
        for contact in 0..group.links.len() {
            if group.is_closing(contact, &answer.motion.velocities) {
                answer_one(group, contact, &mut answer);
                calm = false;
            }
        }
        if calm {
            return answer;
        }
    }
    answer.complete = false;
    match plastic::finish(group, &mut answer, projector) {
        // Crushed between surfaces: the sweeps have been filling it with their energy.
        Outcome::Jammed => plastic::answer(group, start, projector),
        Outcome::Solved | Outcome::Unfinished => answer,
    }
}

/// Newton's law for one contact, and the energy it takes: `(1 − e) p u⁻/2`.
fn answer_one(group: &Group, contact: usize, answer: &mut Answer) {
    let (link, e) = (&group.links[contact], group.restitutions[contact]);
    let rate = group.rate(contact, &answer.motion.velocities);
    let (velocities, second) = (&mut answer.motion.velocities, link.second as usize);
    let impulse = if let Some(first) = link.first.map(|body| body as usize) {
        let masses = [group.masses[first], group.masses[second]];
        let before = [velocities[first], velocities[second]];
        line_of_centres(before, masses, link.normal, e).map(|(after, impulse)| {
            [velocities[first], velocities[second]] = after;
            impulse
        })
    } else {
        let relative = velocities[second] - link.surface_velocity;
        reflection(relative, link.normal, e).map(|change| {
            velocities[second] += change * link.normal;
            group.masses[second] * change
        })
    };
    let impulse = impulse.unwrap_or(0.0);
    answer.motion.impulses[contact] += impulse;
    answer.energy += 0.5 * (1.0 - e) * impulse * rate;
}
