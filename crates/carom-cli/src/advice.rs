//! What would have made a run better: another rule, or something that moves.

use carom::World;
use carom_scene::scene::{Bisect, Contact, Discrete, Exact, Rule, Simulation};

use crate::written::written;

/// Under the rules that know nothing but frames, balls may overlap by this part of their radius before it
/// shows.
const OVERLAP: f64 = 0.5;
/// More impacts than this of a ball in a second \[1/s\], under forces, are those of balls that lie on each
/// other.
const IMPACT_RATE: f64 = 300.0;

/// What a run was like.
#[derive(Debug, Clone, Copy)]
pub struct Conduct {
    pub rule: Rule,
    /// Whether there are spheres, or emitters that may give some.
    pub has_spheres: bool,
    /// Whether the world is a periodic box, which no rule but `exact` knows.
    pub is_periodic: bool,
    /// Whether there are forces.
    pub has_forces: bool,
    /// Largest overlap at the end of a frame, as a part of the mean radius.
    pub overlap: f64,
    /// Impacts of a sphere in a second \[1/s\].
    pub impact_rate: f64,
    /// Whether an emitter put a ball into another one.
    pub emitted_into_another: bool,
    /// The length of frames, and the longest in which motion on springs is stable \[s\].
    pub frames: [f64; 2],
}

/// What would have been better, in a sentence; `None` where all is well.
pub fn advice(conduct: Conduct) -> Option<String> {
    let Conduct { rule, has_spheres, has_forces, overlap, impact_rate, .. } = conduct;
    if !has_spheres {
        let text = "nothing can move: there are no balls, and no emitters that give some; `carom new NAME` writes \
                    a scene to start from";
        return Some(text.to_owned());
    }
    if let Some(text) = advice_for_springs(conduct.frames) {
        return Some(text);
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
        Rule::Exact if has_forces && impact_rate > IMPACT_RATE && !conduct.is_periodic => Some(format!(
            "each ball has {impact_rate:.0} impacts in a second, as in a heap: `--rule contact` is made \
             for those"
        )),
        _ => None,
    }
}

/// What a scene says that its rule does not read; `None` where that is nothing.
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

/// What would keep motion on springs from growing without bound, in frames that long and of the longest
/// length in which it is stable \[s\].
pub fn advice_for_springs([frame, stable]: [f64; 2]) -> Option<String> {
    let text = || {
        format!(
            "frames of {frame:.3e} s are too long for the springs, whose motion may grow without bound: \
             `frame_time` has to be below {stable:.4e} s; the rule `exact` takes any"
        )
    };
    (frame >= stable).then(text)
}
