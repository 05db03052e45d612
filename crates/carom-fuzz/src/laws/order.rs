//! The same spheres and colliders in another order: what comes first in a scene does not come first in the world.

use carom_scene::Scene;
use carom_scene::scene::{ImpactLaw, Rule};

use super::pair::{Agreement, Law, Pair};
use super::trace::Trace;

pub const LAW: Law = Law { name: "in another order", pair };

fn pair(scene: &Scene, _: &Trace) -> Option<Pair> {
    // Other rules, and this impact law, answer the contacts of a sphere one after the other; so do all laws where
    // spheres grow or the box is sheared.
    let is_exact = scene.simulation.rule == Rule::Exact;
    let in_turn = scene.simulation.exact.impact_law == ImpactLaw::Sequential
        || scene.settings().shear_rate != 0.0
        || scene.spheres.iter().any(|it| it.growth_speed != 0.0);
    // Random numbers belong to ids.
    let is_random = scene.simulation.thermostat.is_some();
    if !is_exact || in_turn || is_random || !scene.generators.is_empty() {
        return None;
    }
    let count = scene.spheres.len() as u64;
    let pair = Pair::new(reversed(scene), Agreement::Rounding, move |frame| {
        for body in frame.bodies.iter_mut().filter(|body| body.id < count) {
            body.id = count - 1 - body.id;
        }
    });
    Some(Pair { ends: |frame| frame.in_zone, ..pair })
}

fn reversed(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    let count = scene.spheres.len() as u32;
    scene.spheres.reverse();
    scene.colliders.reverse();
    for spring in &mut scene.springs {
        let ends = spring.spheres.iter_mut().flatten().chain(&mut spring.sphere);
        ends.for_each(|it| *it = count - 1 - *it);
        spring.chain = spring.chain.map(|[first, last]| [count - 1 - last, count - 1 - first]);
    }
    scene
}
