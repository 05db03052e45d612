//! Impact law `simultaneous`: Newton's law of restitution at all contacts at once.

use glam::DVec3;

use super::complementarity::Outcome;
use super::group::{Answer, Group, Motion};
use super::order_free;
use super::plastic;
use super::project::Projector;

/// The motion in which no contact opens more slowly than Newton's law demands, and those that open
/// faster have no impulse:
///
/// ```text
/// 0 <= p  ⟂  u⁺ − e max(−u⁻, 0) >= 0
/// ```
///
/// Source: Moreau, "Unilateral contact and dry friction in finite freedom dynamics" (1988);
/// Glocker and Pfeiffer, Nonlinear Dynamics 7, 471 (1995). A contact that was opening demands
/// nothing but not to close.
///
/// With different e, or where opening contacts are pressed, that would gain energy (Kane, "A
/// dynamics puzzle", 1984; Glocker, Multibody Syst. Dyn. 29, 77 (2013)). The answer is then on
/// the straight way from the plastic answer to Newton's, as far as energy allows. Where spheres
/// are wedged in, so that no motion fulfils the conditions, it is the plastic one.
///
/// - `restitutions`: one per contact, to be used instead of the group's own
pub(super) fn resolve(
    group: &Group,
    restitutions: &[f64],
    start: &[DVec3],
    projector: &mut Projector,
) -> Answer {
    let mut newton = Answer::unchanged(group, start);
    let rebound = |contact| restitutions[contact] * (-group.rate(contact, start)).max(0.0);
    let outcome = projector.project(group, |_| true, rebound, &mut newton.motion.velocities);
    newton.motion.add(projector.impulses(), 1.0);
    if outcome != Outcome::Solved {
        return Answer { complete: false, ..plastic::answer(group, start, projector) };
    }
    // The work of the impulses, with the rates after them as the law wants them.
    let work = |(contact, impulse): (usize, &f64)| {
        0.5 * impulse * (group.rate(contact, start) + rebound(contact))
    };
    newton.energy = order_free::sum(newton.motion.impulses.iter().enumerate().map(work));
    if newton.energy > 0.0 {
        let plastic = plastic::answer(group, start, projector);
        let part = part_without_gain(group, &plastic, &newton.motion);
        newton.motion = plastic.motion.towards(&newton.motion, part);
        newton.energy = 0.0;
    }
    newton
}

/// How far one can go from the plastic answer to Newton's before energy is gained.
///
/// On the way s, the change of energy is `W_P + B s + D s²`: W_P <= 0 is what the plastic answer
/// takes, B >= 0 the work of Newton's impulses at the plastic rates, D the energy of the
/// difference.
fn part_without_gain(group: &Group, plastic: &Answer, newton: &Motion) -> f64 {
    let taken = plastic.energy;
    let rate = |contact| group.rate(contact, &plastic.motion.velocities).max(0.0);
    let work = order_free::sum(newton.impulses.iter().enumerate().map(|(i, p)| p * rate(i)));
    let difference = group.energy_between(&newton.velocities, &plastic.motion.velocities);
    // The positive root, in the form without cancellation.
    let root = (work * work - 4.0 * difference * taken).max(0.0).sqrt();
    let part = -2.0 * taken / (work + root);
    if part.is_finite() { part.clamp(0.0, 1.0) } else { 0.0 }
}
