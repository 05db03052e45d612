//! Impact law `reflection`: the generalized reflection of Smith et al.

use glam::DVec3;

use super::group::{Group, Motion};
use super::project::Projector;
use super::simultaneous;

/// Reflections before the answer is sought otherwise. A row of n equal spheres needs about n; a
/// light sphere between heavy ones about π/2 times the root of the ratio of masses.
const MAX_REFLECTIONS: usize = 1000;
const MAX_REFLECTIONS_PER_CONTACT: usize = 4;

/// Layers that restitution is divided into at most; each costs about one elastic answer.
const MAX_LAYERS: usize = 8;

/// A motion with each e, and the change of energy it asks for.
struct Layer {
    weight: f64,
    motion: Motion,
    energy: f64,
}

/// The answer, the change of energy it asks for, and whether it is what the law says.
///
/// Source: Smith, Kaufman, Vouga, Tamstorf, Grinspun, "Reflections on Simultaneous Impact", ACM
/// TOG 31(4), 2012. For one e in the group, as there: the elastic answer times e plus the plastic
/// one times 1 - e. For several, restitution is divided into layers between neighbouring values
/// of e: in each, a contact of larger e is elastic, one of smaller e plastic. The answer is the
/// mean of the layers' answers by thickness. All of them conserve momentum, gain no energy and
/// leave no contact closing, and so does their mean, since the motions without closing contacts
/// form a convex cone and the energy is convex.
pub(super) fn resolve(
    group: &Group,
    start: &[DVec3],
    projector: &mut Projector,
) -> (Motion, f64, bool) {
    let levels = levels(&group.restitutions);
    let mut layers = Vec::with_capacity(levels.len() + 1);
    let mut complete = true;
    let mut below = 0.0;
    for level in levels {
        let part_of = |e: &f64| ((e - below) / (level - below)).clamp(0.0, 1.0);
        let parts: Vec<f64> = group.restitutions.iter().map(part_of).collect();
        let (motion, energy, as_told) = reflect(group, &parts, start, projector);
        layers.push(Layer { weight: level - below, motion, energy });
        complete &= as_told;
        below = level;
    }
    if below < 1.0 {
        let motion = group.plastic(start, projector);
        let energy = group.work(&motion.impulses, start, &motion.velocities);
        layers.push(Layer { weight: 1.0 - below, motion, energy });
    }
    let (motion, energy) = mean(group, layers);
    (motion, energy, complete)
}

/// Values of e above zero, ascending, thinned out to the bound of layers; the largest is kept.
fn levels(restitutions: &[f64]) -> Vec<f64> {
    let mut levels: Vec<f64> = restitutions.iter().copied().filter(|e| *e > 0.0).collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    let stride = levels.len().div_ceil(MAX_LAYERS).max(1);
    let skipped = levels.len().saturating_sub(1) % stride;
    levels.into_iter().skip(skipped).step_by(stride).collect()
}

/// Mean of the layers; its energy is the mean of theirs less that of their spread.
fn mean(group: &Group, mut layers: Vec<Layer>) -> (Motion, f64) {
    let Some(Layer { mut motion, mut energy, .. }) = layers.pop() else {
        return (Motion::default(), 0.0);
    };
    // Weight by weight: of what has been gone through, the new layer's part.
    let mut weight = 1.0 - layers.iter().map(|layer| layer.weight).sum::<f64>();
    for layer in layers.into_iter().rev() {
        weight += layer.weight;
        let part = layer.weight / weight;
        let spread = group.energy_between(&motion.velocities, &layer.motion.velocities);
        energy += part * (layer.energy - energy) - part * (1.0 - part) * spread;
        motion = motion.towards(&layer.motion, part);
    }
    (motion, energy)
}

/// The answer in one layer, where each contact gives back this `part` of what its compression
/// took: 1 is elastic, 0 plastic.
///
/// Again and again, as long as a contact closes: compress, that is, project the motion to the
/// nearest one in which neither the closing contacts nor those that are not elastic close; give
/// back the parts of the impulses (Poisson's hypothesis); and let the contacts that are not
/// elastic keep what would press them from closing. If all are elastic that is the reflection
/// of Smith et al., with all closing contacts at once. No pass gains energy: the last projection
/// is no farther from rest than the way back of all compression.
///
/// If there is no end of it, `simultaneous` gives the answer.
fn reflect(
    group: &Group,
    parts: &[f64],
    start: &[DVec3],
    projector: &mut Projector,
) -> (Motion, f64, bool) {
    let all_elastic = parts.iter().all(|part| *part == 1.0);
    let mut motion = Motion::start(group, start);
    let mut closing = vec![false; parts.len()];
    let bound = MAX_REFLECTIONS + MAX_REFLECTIONS_PER_CONTACT * parts.len();
    for _ in 0..bound {
        for (contact, closing) in closing.iter_mut().enumerate() {
            *closing = group.is_closing(contact, &motion.velocities);
        }
        if !closing.contains(&true) {
            let energy = if all_elastic {
                0.0
            } else {
                group.work(&motion.impulses, start, &motion.velocities).min(0.0)
            };
            return (motion, energy, true);
        }
        if all_elastic {
            reflect_once(group, &closing, &mut motion, projector);
        } else {
            restitute_once(group, &closing, parts, &mut motion, projector);
        }
    }
    let (motion, _) = simultaneous::resolve(group, parts, start, projector);
    let energy = group.work(&motion.impulses, start, &motion.velocities).min(0.0);
    (motion, energy, false)
}

/// Reflection of the motion at the cone of motions in which the `closing` contacts do not close.
fn reflect_once(group: &Group, closing: &[bool], motion: &mut Motion, projector: &mut Projector) {
    let before = motion.velocities.clone();
    projector.project(group, |contact| closing[contact], |_| 0.0, &mut motion.velocities);
    for (velocity, before) in motion.velocities.iter_mut().zip(before) {
        *velocity += *velocity - before;
    }
    motion.add(projector.impulses(), 2.0);
}

/// The same where not all contacts are elastic.
fn restitute_once(
    group: &Group,
    closing: &[bool],
    parts: &[f64],
    motion: &mut Motion,
    projector: &mut Projector,
) {
    let active = |contact: usize| closing[contact] || parts[contact] < 1.0;
    projector.project(group, active, |_| 0.0, &mut motion.velocities);
    let compression = projector.impulses().to_vec();
    motion.add(&compression, 1.0);
    let given_back: Vec<f64> = compression.iter().zip(parts).map(|(p, part)| p * part).collect();
    group.push(&given_back, &mut motion.velocities);
    motion.add(&given_back, 1.0);
    projector.project(group, |contact| parts[contact] < 1.0, |_| 0.0, &mut motion.velocities);
    motion.add(projector.impulses(), 1.0);
}
