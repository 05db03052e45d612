//! Impact law `simultaneous`: Newton's law of restitution at all contacts at once.

use glam::DVec3;

use super::complementarity::Outcome;
use super::group::{Group, Motion};
use super::project::Projector;

/// The motion in which no contact opens more slowly than Newton's law asks, and those that open
/// faster have no impulse; and whether it is that.
///
/// ```text
/// 0 <= p  ⟂  u⁺ − e max(−u⁻, 0) >= 0
/// ```
///
/// Source: Moreau, "Unilateral contact and dry friction in finite freedom dynamics" (1988);
/// Glocker and Pfeiffer, Nonlinear Dynamics 7, 471 (1995). A contact that was opening asks for
/// nothing but not to close.
///
/// With different e, or where opening contacts are pressed, that would gain energy (Kane 1984;
/// Glocker, Multibody Syst. Dyn. 29, 77 (2013)). The answer is then on the straight way from the
/// plastic answer to Newton's, as far as energy allows. Spheres that are wedged in, so that no
/// motion fulfils the conditions, are answered plastically.
pub(super) fn resolve(
    group: &Group,
    restitutions: &[f64],
    start: &[DVec3],
    projector: &mut Projector,
) -> (Motion, bool) {
    let mut newton = Motion::start(group, start);
    let rebound = |contact| restitutions[contact] * (-group.rate(contact, start)).max(0.0);
    let outcome = projector.project(group, |_| true, rebound, &mut newton.velocities);
    newton.add(projector.impulses(), 1.0);
    if outcome == Outcome::Jammed {
        return (group.plastic(start, projector), false);
    }
    let demanded =
        newton.impulses.iter().enumerate().map(|(contact, impulse)| {
            0.5 * impulse * (group.rate(contact, start) + rebound(contact))
        });
    if super::order_free::sum(demanded) <= 0.0 {
        return (newton, outcome == Outcome::Solved);
    }
    let plastic = group.plastic(start, projector);
    let part = part_without_gain(group, start, &plastic, &newton);
    (plastic.towards(&newton, part), outcome == Outcome::Solved)
}

/// How far one can go from the plastic answer to Newton's before energy is gained.
///
/// On the way s, the change of energy is `W_P + B s + D s²`: W_P < 0 is what the plastic answer
/// takes, B >= 0 the work of Newton's impulses at the plastic rates, D the energy of the
/// difference.
fn part_without_gain(group: &Group, start: &[DVec3], plastic: &Motion, newton: &Motion) -> f64 {
    let taken = group.work(&plastic.impulses, start, &plastic.velocities);
    let rate = |contact| group.rate(contact, &plastic.velocities).max(0.0);
    let work = super::order_free::sum(
        newton.impulses.iter().enumerate().map(|(contact, impulse)| impulse * rate(contact)),
    );
    let difference = group.energy_between(&newton.velocities, &plastic.velocities);
    // The positive root, in the form without cancellation.
    let root = (work * work - 4.0 * difference * taken).max(0.0).sqrt();
    let part = -2.0 * taken / (work + root);
    if part.is_finite() { part.clamp(0.0, 1.0) } else { 0.0 }
}
