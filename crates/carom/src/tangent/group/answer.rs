//! The impact law `Reflection` and friction in a group, in dual numbers with fixed active sets.

use glam::DVec3;

use super::friction;
use super::model::{Change, Given, Model};
use super::plan::Layer;
use super::solve::{Solution, solve};
use crate::real::Vector;
use crate::tangent::dual::{Dual, vector};

/// A rate of opening below this part of the fastest speed is zero but for rounding.
const NOTHING: f64 = 1e-9;

/// The motion of a group after an impact.
pub(in crate::tangent) struct Answer {
    pub given: Given,
    pub velocities: Vec<Vector<Dual>>,
    pub spins: Vec<Vector<Dual>>,
    /// Changes that have to be zero for the answer to be differentiable: of speeds \[m/s\], then of gaps \[m\].
    pub kinks: [Vec<f64>; 2],
    /// How near a contact is to bearing, or not bearing, the impact: 0 to 1.
    pub margin: f64,
    /// Whether friction acts where impulses are not unique.
    pub is_ambiguous: bool,
}

/// The answer in the making.
struct Making<'a> {
    model: &'a Model,
    given: &'a Given,
    /// Speeds below this are zero \[m/s\].
    nothing: f64,
    kinks: Vec<f64>,
    margin: f64,
    is_redundant: bool,
}

/// Velocities, and the impulses that led to them.
#[derive(Clone)]
struct Motion {
    velocities: Vec<Vector<Dual>>,
    impulses: Vec<Dual>,
}

/// Returns the answer to a changed impact.
pub(in crate::tangent) fn answer(model: &Model, change: &Change) -> Answer {
    let given = model.given(change);
    let nothing = NOTHING * model.fastest();
    let (kinks, margin) = (Vec::new(), 1.0);
    let mut making = Making { model, given: &given, nothing, kinks, margin, is_redundant: false };
    let mut motion = making.reflect_in_layers();
    let acts = |number: usize| {
        model.contacts[number].sliding.value > 0.0 && motion.impulses[number].value > 0.0
    };
    let is_rough = (0..model.contacts.len()).any(acts);
    let mut spins = given.spins.clone();
    if is_rough {
        let impulses = &motion.impulses;
        let kinks = friction::apply(model, &given, impulses, (&mut motion.velocities, &mut spins));
        making.kinks.extend(kinks);
    }
    let is_ambiguous = is_rough && making.is_redundant;
    if let Some(bearing) = &model.plan.plastic {
        let all: Vec<usize> = (0..model.contacts.len()).collect();
        making.project(&all, bearing, &mut motion.velocities);
    }
    making.note_still(&motion.velocities);
    let Making { kinks, margin, .. } = making;
    let kinks = [kinks, given.gaps.clone()];
    Answer { velocities: motion.velocities, given, spins, kinks, margin, is_ambiguous }
}

impl Making<'_> {
    /// Returns the mean of the answers of all layers of restitution.
    fn reflect_in_layers(&mut self) -> Motion {
        let layers = &self.model.plan.layers;
        let answers: Vec<Motion> = layers.iter().map(|layer| self.reflect(layer)).collect();
        let zero = vector(DVec3::ZERO, DVec3::ZERO);
        let mut mean = Motion {
            velocities: vec![zero; self.model.members.len()],
            impulses: vec![Dual::constant(0.0); self.model.contacts.len()],
        };
        let mut below = Dual::constant(0.0);
        for (layer, answer) in layers.iter().zip(&answers) {
            let level = self.level(layer, &answers);
            let weight = level - below;
            for (mean, it) in mean.velocities.iter_mut().zip(&answer.velocities) {
                *mean = *mean + *it * weight;
            }
            for (mean, it) in mean.impulses.iter_mut().zip(&answer.impulses) {
                *mean = *mean + *it * weight;
            }
            below = level;
        }
        let restitutions = self.given.restitutions.iter().zip(&mean.impulses);
        let plastic = restitutions.filter(|(it, impulse)| it.value == 0.0 && impulse.value > 0.0);
        let speed = self.nothing / NOTHING;
        self.kinks.extend(plastic.map(|(it, _)| speed * it.change));
        mean
    }

    /// Returns the restitution at the end of a layer: all contacts of that restitution have to change alike.
    fn level(&mut self, layer: &Layer, answers: &[Motion]) -> Dual {
        if layer.level > 1.0 {
            return Dual::constant(1.0);
        }
        let bears = |number: usize| answers.iter().any(|it| it.impulses[number].value > 0.0);
        let restitutions = &self.given.restitutions;
        let mut of_level = (0..restitutions.len())
            .filter(|&number| restitutions[number].value == layer.level && bears(number))
            .map(|number| restitutions[number]);
        let Some(level) = of_level.next() else { return Dual::constant(layer.level) };
        let speed = self.nothing / NOTHING;
        self.kinks.extend(of_level.map(|it| speed * (it.change - level.change)));
        level
    }

    fn reflect(&mut self, layer: &Layer) -> Motion {
        let contacts = self.model.contacts.len();
        let mut motion = Motion {
            velocities: self.given.velocities.clone(),
            impulses: vec![Dual::constant(0.0); contacts],
        };
        let gives_back: Vec<bool> =
            self.given.restitutions.iter().map(|it| it.value >= layer.level).collect();
        let all_elastic = !gives_back.contains(&false);
        for (number, bearing) in layer.projections.iter().enumerate() {
            let is_compression = all_elastic || number % 2 == 0;
            if is_compression && layer.level <= 1.0 {
                self.note_still(&motion.velocities);
            }
            let closes = |it: &usize| self.rate(*it, &motion.velocities).value < -self.nothing;
            let takes_part = |it: &usize| {
                !gives_back[*it] || is_compression && (closes(it) || bearing.contains(it))
            };
            let candidates: Vec<usize> = (0..contacts).filter(takes_part).collect();
            let before = motion.velocities.clone();
            let impulses = self.project(&candidates, bearing, &mut motion.velocities);
            for (place, impulse) in impulses.into_iter().enumerate() {
                let twice = is_compression && gives_back[place];
                let factor = Dual::constant(if twice { 2.0 } else { 1.0 });
                motion.impulses[place] = motion.impulses[place] + impulse * factor;
                if twice && !all_elastic {
                    self.push(place, impulse, &mut motion.velocities);
                }
            }
            if all_elastic {
                for (velocity, before) in motion.velocities.iter_mut().zip(before) {
                    *velocity = *velocity + *velocity - before;
                }
            }
        }
        motion
    }

    /// Moves velocities, by impulses at the contacts that bear them, to those at which these do not close. Returns the
    /// impulses. `candidates` are all contacts that may not close.
    fn project(
        &mut self,
        candidates: &[usize],
        bearing: &[usize],
        velocities: &mut [Vector<Dual>],
    ) -> Vec<Dual> {
        let rates = bearing.iter().map(|&it| self.rate(it, velocities) * -1.0).collect();
        let matrix = bearing.iter().map(|&row| {
            let row = bearing.iter().map(|&column| self.coupling(row, column));
            row.collect()
        });
        let Solution { unknowns, left } = solve(matrix.collect(), rates);
        self.is_redundant |= !left.is_empty();
        self.kinks.extend(left);
        let largest = unknowns.iter().map(|it| it.value).fold(0.0, f64::max);
        let mut impulses = vec![Dual::constant(0.0); self.model.contacts.len()];
        for (&place, impulse) in bearing.iter().zip(unknowns) {
            if impulse.value > 0.0 {
                self.margin = self.margin.min(impulse.value / largest);
            }
            impulses[place] = impulse;
            self.push(place, impulse, velocities);
        }
        for &place in candidates.iter().filter(|it| !bearing.contains(it)) {
            self.note(place, velocities);
        }
        impulses
    }

    /// Notes contacts that neither open nor close: a small change may make them do either.
    fn note_still(&mut self, velocities: &[Vector<Dual>]) {
        for place in 0..self.model.contacts.len() {
            self.note(place, velocities);
        }
    }

    fn note(&mut self, place: usize, velocities: &[Vector<Dual>]) {
        let rate = self.rate(place, velocities);
        if self.model.contacts[place].is_held {
            return;
        }
        if rate.value.abs() <= self.nothing {
            self.kinks.push(rate.change);
        } else {
            self.margin = self.margin.min(rate.value.abs() * NOTHING / self.nothing);
        }
    }

    fn rate(&self, place: usize, velocities: &[Vector<Dual>]) -> Dual {
        self.given.rate_at(&self.model.contacts[place], place, velocities)
    }

    /// Returns the rate of opening of one contact by a unit of impulse at another one \[1/kg\].
    fn coupling(&self, one: usize, other: usize) -> Dual {
        let sides = |number: usize| {
            let contact = &self.model.contacts[number];
            [contact.first.map(|it| (it, -1.0)), Some((contact.second, 1.0))].into_iter().flatten()
        };
        let product = self.given.normals[one].dot(self.given.normals[other]);
        let mut sum = Dual::constant(0.0);
        for (body, side) in sides(one) {
            for (_, other_side) in sides(other).filter(|it| it.0 == body) {
                sum = sum + product / self.given.masses[body] * (side * other_side);
            }
        }
        sum
    }

    fn push(&self, place: usize, impulse: Dual, velocities: &mut [Vector<Dual>]) {
        let contact = &self.model.contacts[place];
        let along = self.given.normals[place] * impulse;
        let change = |body: usize| along * (Dual::constant(1.0) / self.given.masses[body]);
        velocities[contact.second] = velocities[contact.second] + change(contact.second);
        if let Some(first) = contact.first {
            velocities[first] = velocities[first] - change(first);
        }
    }
}
