//! Advice after a run: another rule or other settings that would suit the scene better.

use carom::World;
use carom_scene::scene::{Bisect, Contact, Discrete, Exact, Rule, Simulation};

use crate::written::written;

/// Largest overlap, as a fraction of the radius, that is not yet visible. Rules that only compare
/// the ends of frames may cause overlaps.
const OVERLAP: f64 = 0.5;
/// Impacts of a ball per second \[1/s\] above which, under forces, balls probably lie on each
/// other.
const IMPACT_RATE: f64 = 300.0;

/// Properties of a run on which advice depends.
#[derive(Debug, Clone, Copy)]
pub struct Conduct {
    pub rule: Rule,
    /// Whether there are spheres, or emitters that can create some.
    pub has_spheres: bool,
    /// Whether there are forces.
    pub has_forces: bool,
    /// Largest overlap at the end of a frame, as a fraction of the mean radius.
    pub overlap: f64,
    /// Impacts per sphere and second \[1/s\].
    pub impact_rate: f64,
    /// Whether an emitter put a ball into another one.
    pub emitted_into_another: bool,
}

/// Advice for a run, in a sentence; `None` if there is none.
pub fn advice(conduct: Conduct) -> Option<String> {
    let Conduct { rule, has_spheres, has_forces, overlap, impact_rate, .. } = conduct;
    if !has_spheres {
        let text = "nothing can move: there are no balls, and no emitters that give some; `carom new NAME` writes \
                    a scene to start from";
        return Some(text.to_owned());
    }
    match rule {
        Rule::Exact if conduct.emitted_into_another => Some(
            "an emitter puts balls into others: a longer `period` leaves them room, and with `needs_room = true` \
             those are left out that have none"
                .to_owned(),
        ),
        Rule::Discrete | Rule::Bisect if overlap > OVERLAP => Some(format!(
            "balls overlap by {overlap:.1} of a radius: `--rule contact` keeps them apart in heaps, \
             `--rule exact` in bounces"
        )),
        Rule::Exact if has_forces && impact_rate > IMPACT_RATE => Some(format!(
            "each ball has {impact_rate:.0} impacts in a second, as in a heap: `--rule contact` is made \
             for those"
        )),
        _ => None,
    }
}

/// Parts of a scene that its rule ignores, in a sentence; `None` if there are none.
pub fn unread(simulation: &Simulation, world: &World) -> Option<String> {
    let Simulation { rule, exact, contact, discrete, bisect, .. } = simulation;
    let has_friction = world.settings().rule.has_friction();
    let friction = (world.is_rough() && !has_friction).then(|| "friction".to_owned());
    let tables = [
        (Rule::Exact, *exact != Exact::default()),
        (Rule::Contact, *contact != Contact::default()),
        (Rule::Discrete, *discrete != Discrete::default()),
        (Rule::Bisect, *bisect != Bisect::default()),
    ];
    let of_others = tables.into_iter().filter(|(other, is_set)| other != rule && *is_set);
    let tables = of_others.map(|(other, _)| format!("`simulation.{}`", written(other)));
    let all: Vec<String> = friction.into_iter().chain(tables).collect();
    (!all.is_empty())
        .then(|| format!("the rule {} does not read {}", written(rule), all.join(", ")))
}
