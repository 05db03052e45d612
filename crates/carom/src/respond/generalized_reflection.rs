//! Impact law `reflection`: the generalized reflection of Smith et al.

use glam::DVec3;

use super::complementarity::Outcome;
use super::group::{Answer, Group};
use super::plastic;
use super::project::Projector;
use super::simultaneous;

/// Reflections before the answer is sought otherwise. A row of n equal spheres needs about n; a
/// light sphere between heavy ones about π/2 times the root of the ratio of masses.
const MAX_REFLECTIONS: usize = 1000;
const MAX_REFLECTIONS_PER_CONTACT: usize = 4;

/// Units of work that reflections may take, besides and per pair of contacts: a row of n spheres needs
/// about n² of them. In a lattice that is locked from all sides they have no end.
const REFLECTION_WORK: u64 = 30_000;
const REFLECTION_WORK_PER_PAIR: u64 = 4;

/// Layers that restitution is divided into at most; each costs about one elastic answer.
const MAX_LAYERS: usize = 8;

/// The answer to one layer of restitution.
struct Layer {
    /// Thickness of the layer. Those of all layers add up to 1.
    weight: f64,
    answer: Answer,
}

/// For one e in the group: the elastic answer times e plus the plastic one times 1 − e.
///
/// Source: Smith, Kaufman, Vouga, Tamstorf, Grinspun, "Reflections on Simultaneous Impact", ACM
/// TOG 31(4), 2012.
///
/// For several e, restitution is divided into layers between neighbouring values: in each, a
/// contact of larger e is elastic, one of smaller e plastic. The answer is the mean of the
/// layers' answers by thickness. All of them conserve momentum, gain no energy and leave no
/// contact closing, and so does their mean, since the motions without closing contacts form a
/// convex cone and the energy is convex. A contact that feels no other gets Newton's law with
/// its own e: the layers below e are elastic for it.
pub(super) fn resolve(group: &Group, start: &[DVec3], projector: &mut Projector) -> Answer {
    let mut layers = Vec::with_capacity(MAX_LAYERS + 1);
    let mut below = 0.0;
    for level in levels(&group.restitutions) {
        let part_of = |e: &f64| ((e - below) / (level - below)).clamp(0.0, 1.0);
        let parts: Vec<f64> = group.restitutions.iter().map(part_of).collect();
        projector.begin_layer();
        let answer = reflect(group, &parts, start, projector);
        layers.push(Layer { weight: level - below, answer });
        below = level;
    }
    if below < 1.0 {
        projector.begin_layer();
        let answer = plastic::answer(group, start, projector);
        layers.push(Layer { weight: 1.0 - below, answer });
    }
    mean(group, layers)
}

/// Values of e above zero, ascending, thinned out to the bound of layers; the largest is kept.
///
/// Where values are left out, contacts between two levels give back a part in that layer.
pub(crate) fn levels(restitutions: &[f64]) -> Vec<f64> {
    let mut levels: Vec<f64> = restitutions.iter().copied().filter(|e| *e > 0.0).collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    let stride = levels.len().div_ceil(MAX_LAYERS).max(1);
    let skipped = levels.len().saturating_sub(1) % stride;
    levels.into_iter().skip(skipped).step_by(stride).collect()
}

/// Mean of the layers, from the last to the first; its energy is the mean of theirs, less that
/// of their spread.
fn mean(group: &Group, mut layers: Vec<Layer>) -> Answer {
    let Some(Layer { mut weight, answer: mut mean }) = layers.pop() else {
        return Answer::default();
    };
    for Layer { weight: added, answer } in layers.into_iter().rev() {
        weight += added;
        let part = added / weight;
        let spread = group.energy_between(&mean.motion.velocities, &answer.motion.velocities);
        mean.energy += part * (answer.energy - mean.energy) - part * (1.0 - part) * spread;
        mean.motion = mean.motion.towards(&answer.motion, part);
        mean.complete &= answer.complete;
    }
    mean
}

/// The answer in one layer, where each contact gives back this `part` of what its compression
/// took: 1 is elastic, 0 plastic.
///
/// Again and again, as long as a contact closes: compress, that is, project the motion to the
/// nearest one in which neither the closing contacts nor those that are not elastic close; give
/// back the parts of the impulses (Poisson's hypothesis); and let the contacts that are not
/// elastic take what would make them close. If all are elastic, that is the reflection of Smith
/// et al., at all closing contacts at once.
///
/// No pass gains energy. With w the compressed motion, λ its impulses and E the parts, the pass
/// ends at the projection of `w + M⁻¹N E λ` to the cone of contacts with E < 1; its norm is the
/// least of `|w + M⁻¹N (E λ + μ)|` over the impulses μ >= 0 of those contacts, and with
/// `μ = (1 − E) λ` that is the norm before, since `λ·u(w) = 0`.
///
/// If there is no end of it, `simultaneous` gives the answer; if a projection cannot be found, the
/// answer is plastic, as far as that can be.
fn reflect(group: &Group, parts: &[f64], start: &[DVec3], projector: &mut Projector) -> Answer {
    let all_elastic = parts.iter().all(|part| *part == 1.0);
    let mut answer = Answer::unchanged(group, start);
    let mut closing = vec![false; parts.len()];
    let contacts = parts.len() as u64;
    let most_work =
        group.work.done() + REFLECTION_WORK + REFLECTION_WORK_PER_PAIR * contacts * contacts;
    for _ in 0..MAX_REFLECTIONS + MAX_REFLECTIONS_PER_CONTACT * parts.len() {
        for (contact, closing) in closing.iter_mut().enumerate() {
            *closing = group.is_closing(contact, &answer.motion.velocities);
        }
        if !closing.contains(&true) || !group.work.spend(contacts) {
            if !all_elastic {
                let impulses = &answer.motion.impulses;
                let work = group.work(impulses, start, &answer.motion.velocities);
                answer.energy = work.min(0.0);
            }
            return answer;
        }
        let outcome = if all_elastic {
            reflect_once(group, &closing, &mut answer, projector)
        } else {
            restitute_once(group, &closing, parts, &mut answer, projector)
        };
        if outcome != Outcome::Solved {
            return Answer { complete: false, ..plastic::answer(group, start, projector) };
        }
        if group.work.done() > most_work {
            break;
        }
    }
    Answer { complete: false, ..simultaneous::resolve(group, parts, start, projector) }
}

/// Reflection of the motion at the cone of motions in which the `closing` contacts do not close.
fn reflect_once(
    group: &Group,
    closing: &[bool],
    answer: &mut Answer,
    projector: &mut Projector,
) -> Outcome {
    let velocities = &mut answer.motion.velocities;
    let before = velocities.clone();
    let outcome = projector.project(group, |contact| closing[contact], |_| 0.0, velocities);
    for (velocity, before) in velocities.iter_mut().zip(before) {
        *velocity += *velocity - before;
    }
    answer.motion.add(projector.impulses(), 2.0);
    outcome
}

/// Reflects a group once in which not all contacts are elastic.
fn restitute_once(
    group: &Group,
    closing: &[bool],
    parts: &[f64],
    answer: &mut Answer,
    projector: &mut Projector,
) -> Outcome {
    let motion = &mut answer.motion;
    let active = |contact: usize| closing[contact] || parts[contact] < 1.0;
    let compressed = projector.project(group, active, |_| 0.0, &mut motion.velocities);
    motion.add(projector.impulses(), 1.0);
    if compressed != Outcome::Solved {
        return compressed;
    }
    let given_back: Vec<f64> =
        projector.impulses().iter().zip(parts).map(|(impulse, part)| impulse * part).collect();
    group.push(&given_back, &mut motion.velocities);
    motion.add(&given_back, 1.0);
    let plastic = |contact: usize| parts[contact] < 1.0;
    let outcome = projector.project(group, plastic, |_| 0.0, &mut motion.velocities);
    motion.add(projector.impulses(), 1.0);
    outcome
}
