//! Impact law `sequential`: pair after pair.

use super::group::{Group, Motion};
use super::project::Projector;
use super::{line_of_centres, reflection};

/// Sweeps over all contacts before what is left is finished plastically. Elastic equal spheres
/// need about as many as there are spheres in a row; with e < 1, closing speeds fall
/// geometrically.
const MAX_SWEEPS: usize = 1000;

/// Answers contacts in their order, each by Newton's law if it closes when its turn comes; again
/// and again until none closes. Tells whether that came to an end.
///
/// Source: Brach, "Mechanical Impact Dynamics" (1991), chapter 6; Chatterjee and Ruina, J. Appl.
/// Mech. 65, 939 (1998), on sequences of impacts and their limits.
pub(super) fn resolve(group: &Group, motion: &mut Motion, projector: &mut Projector) -> bool {
    for _ in 0..MAX_SWEEPS {
        let mut answered = false;
        for contact in 0..group.links.len() {
            if group.is_closing(contact, &motion.velocities) {
                answer(group, contact, motion);
                answered = true;
            }
        }
        if !answered {
            return true;
        }
    }
    group.finish(motion, projector);
    false
}

/// Newton's law for one contact.
fn answer(group: &Group, contact: usize, motion: &mut Motion) {
    let (link, e) = (&group.links[contact], group.restitutions[contact]);
    let (velocities, second) = (&mut motion.velocities, link.second as usize);
    if let Some(first) = link.first.map(|body| body as usize) {
        let masses = [group.masses[first], group.masses[second]];
        let before = [velocities[first], velocities[second]];
        if let Some((after, impulse)) = line_of_centres(before, masses, link.normal, e) {
            [velocities[first], velocities[second]] = after;
            motion.impulses[contact] += impulse;
        }
    } else if let Some(change) =
        reflection(velocities[second] - link.surface_velocity, link.normal, e)
    {
        velocities[second] += change * link.normal;
        motion.impulses[contact] += group.masses[second] * change;
    }
}
