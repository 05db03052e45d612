//! The derivative of the impact of a group of touching bodies.

mod answer;
mod bearing;
mod friction;
mod loose;
mod model;
mod plan;
mod solve;

pub(super) use answer::{Answer, answer};
pub(super) use bearing::{layers_of, plastic_at};
pub(super) use loose::{First, LooseContact};
pub(super) use model::{Contact, Model};
pub(super) use plan::Plan;

use glam::DVec3;
use model::Change;

use super::state::{NUMBERS, SphereTangent};
use super::variation::{ColliderVariation, SphereVariation, Variation};
use crate::id::{ColliderId, SphereId};

/// Count of numbers of the change of a sphere, and of a collider.
const OF_SPHERE: usize = 13;
const OF_COLLIDER: usize = 8;
/// A change keeps bodies in touch if it changes gaps and speeds by at most this part of the change as a whole.
const KEEPS: f64 = 1e-9;
/// A coefficient below this is rounding of zero, in units of the group.
const ROUNDING: f64 = 1e-11;

/// Derivative of an impact of a group: a saltation matrix where active sets are fixed.
///
/// One contact of the group meets; the others have touched before. A change that opens or closes one of these, or makes
/// the impact law take other contacts, has no derivative: it is one of two.
#[derive(Debug, Clone)]
pub(super) struct GroupSaltation {
    /// Indices of the spheres in the arrays of the world, and their ids.
    pub places: Vec<usize>,
    ids: Vec<SphereId>,
    colliders: Vec<ColliderId>,
    /// One of the spheres that meet.
    pub second: SphereId,
    /// Rows of the motion of all spheres afterwards by all that is given.
    matrix: Vec<Vec<f64>>,
    /// Rows of changes that have to be zero, in units of the group.
    kinks: Vec<Vec<f64>>,
    /// Units of all that is given.
    units: Vec<f64>,
    /// Time since the start of the derivatives \[s\].
    pub time: f64,
    /// Ratio of the speed of approach to the relative speed.
    pub directness: f64,
    /// How near the impact law was to taking other contacts: 0 to 1.
    pub margin: f64,
    /// Whether bodies touched that nothing pressed together.
    pub has_loose_touches: bool,
}

impl GroupSaltation {
    /// Returns the derivative of an impact at a time since the start of the derivatives \[s\]; `None` if friction acts
    /// where impulses are not unique.
    pub fn of(model: &Model, time: f64) -> Option<Self> {
        let count = OF_SPHERE * model.members.len() + OF_COLLIDER * model.colliders.len();
        let units = units_of(model);
        let fastest = model.fastest();
        let smallest = model.members.iter().map(|it| it.radius).fold(f64::INFINITY, f64::min);
        let mut matrix = vec![vec![0.0; count]; NUMBERS * model.members.len()];
        let mut kinks: Vec<Vec<f64>> = Vec::new();
        let (mut margin, mut is_ambiguous) = (1.0, false);
        for column in 0..count {
            let mut given = vec![0.0; count];
            given[column] = 1.0;
            let change = change_of(model, &given);
            let answer = answer(model, &change);
            (margin, is_ambiguous) = (answer.margin, answer.is_ambiguous);
            for (place, after) in after(model, &answer).iter_mut().enumerate() {
                for number in 0..NUMBERS {
                    matrix[NUMBERS * place + number][column] = *after.number_mut(number);
                }
            }
            let [speeds, gaps] = &answer.kinks;
            let speeds = speeds.iter().map(|it| it / fastest);
            let all = speeds.chain(gaps.iter().map(|it| it / smallest));
            for (row, kink) in all.enumerate() {
                if kinks.len() == row {
                    kinks.push(vec![0.0; count]);
                }
                let kink = kink * units[column];
                kinks[row][column] = if kink.abs() > ROUNDING { kink } else { 0.0 };
            }
        }
        kinks.retain(|row| row.iter().any(|it| *it != 0.0));
        kinks.dedup();
        let meeting = &model.contacts[model.meeting];
        let relative = model.relative_velocity(meeting);
        let is_loose =
            |number: usize| number != model.meeting && !model.contacts[number].is_pressed;
        (!is_ambiguous).then(|| Self {
            places: model.members.iter().map(|it| it.place).collect(),
            ids: model.members.iter().map(|it| it.id).collect(),
            colliders: model.colliders.clone(),
            second: model.members[meeting.second].id,
            matrix,
            kinks,
            units,
            time,
            directness: -relative.dot(meeting.normal) / relative.length(),
            margin,
            has_loose_touches: (0..model.contacts.len()).any(is_loose),
        })
    }

    /// Returns the ids of the spheres.
    pub fn ids(&self) -> &[SphereId] {
        &self.ids
    }

    /// Returns whether a direction turns a collider of the group, of which derivatives are not known.
    pub fn turns(&self, direction: &Variation) -> bool {
        self.colliders.iter().any(|&id| direction.collider(id).rotation != DVec3::ZERO)
    }

    /// Applies the derivative to the derivatives of the spheres in one direction. Returns whether the direction keeps
    /// bodies in touch that touch.
    pub fn pass(&self, direction: &Variation, spheres: &mut [SphereTangent]) -> bool {
        let given = self.given(direction, spheres);
        let sizes = given.iter().zip(&self.units).map(|(it, unit)| it.abs() / unit);
        let largest = sizes.fold(0.0, f64::max);
        let keeps = self.kinks.iter().all(|row| {
            let numbers = row.iter().zip(&given).zip(&self.units);
            let kink: f64 = numbers.map(|((by, it), unit)| by * (it / unit)).sum();
            kink.abs() <= KEEPS * largest
        });
        for (number, row) in self.matrix.iter().enumerate() {
            let sphere = &mut spheres[self.places[number / NUMBERS]];
            let after = row.iter().zip(&given).map(|(by, it)| by * it).sum();
            *sphere.number_mut(number % NUMBERS) = after;
        }
        keeps
    }

    /// The transpose of [`Self::pass`]: the derivative in directions that keep bodies in touch.
    pub fn pass_back(&self, spheres: &mut [SphereTangent], gradient: &mut Variation) {
        let mut by = vec![0.0; self.units.len()];
        for (number, row) in self.matrix.iter().enumerate() {
            let after = *spheres[self.places[number / NUMBERS]].number_mut(number % NUMBERS);
            by.iter_mut().zip(row).for_each(|(by, it)| *by += it * after);
        }
        let (of_spheres, of_colliders) = by.split_at(OF_SPHERE * self.places.len());
        let members = self.places.iter().zip(&self.ids);
        for ((&place, &id), by) in members.zip(of_spheres.chunks(OF_SPHERE)) {
            for (number, &by) in by.iter().enumerate() {
                if number < NUMBERS {
                    *spheres[place].number_mut(number) = by;
                } else {
                    *sphere_number(gradient.sphere_mut(id), number) += by;
                }
            }
        }
        for (&id, by) in self.colliders.iter().zip(of_colliders.chunks(OF_COLLIDER)) {
            let collider = gradient.collider_mut(id);
            collider.rotation = DVec3::NAN;
            for (number, &by) in by.iter().enumerate() {
                *collider_number(collider, number) += by;
                if number < 3 {
                    // The place at the impact changes with the velocity.
                    *collider_number(collider, number + 3) += self.time * by;
                }
            }
        }
    }

    fn given(&self, direction: &Variation, spheres: &[SphereTangent]) -> Vec<f64> {
        let mut given = Vec::with_capacity(self.units.len());
        for (&place, &id) in self.places.iter().zip(&self.ids) {
            let mut sphere = direction.sphere(id);
            let SphereTangent { position, velocity, angular_velocity } = spheres[place];
            sphere.position = position;
            (sphere.velocity, sphere.angular_velocity) = (velocity, angular_velocity);
            given.extend((0..OF_SPHERE).map(|number| *sphere_number(&mut sphere, number)));
        }
        for &id in &self.colliders {
            let mut collider = direction.collider(id);
            collider.position += self.time * collider.velocity;
            given.extend((0..OF_COLLIDER).map(|number| *collider_number(&mut collider, number)));
        }
        given
    }
}

/// Returns a unit for each number that is given: sizes at which changes count alike.
fn units_of(model: &Model) -> Vec<f64> {
    let fastest = model.fastest();
    let length = model.members.iter().map(|it| it.radius).fold(f64::INFINITY, f64::min);
    let of_sphere = |mass: f64| {
        let axes = |it: f64| [it; 3];
        let motion = [axes(length), axes(fastest), axes(fastest / length)];
        motion.into_iter().flatten().chain([length, mass, 1.0, 1.0])
    };
    let of_collider = [length, length, length, fastest, fastest, fastest, 1.0, 1.0];
    let spheres = model.members.iter().flat_map(|it| of_sphere(it.mass));
    spheres.chain(model.colliders.iter().flat_map(|_| of_collider)).collect()
}

fn change_of(model: &Model, given: &[f64]) -> Change {
    let mut change = model.no_change();
    let (of_spheres, of_colliders) = given.split_at(OF_SPHERE * model.members.len());
    for (sphere, numbers) in change.spheres.iter_mut().zip(of_spheres.chunks(OF_SPHERE)) {
        for (number, &it) in numbers.iter().enumerate() {
            *sphere_number(sphere, number) = it;
        }
    }
    for (collider, numbers) in change.colliders.iter_mut().zip(of_colliders.chunks(OF_COLLIDER)) {
        for (number, &it) in numbers.iter().enumerate() {
            *collider_number(collider, number) = it;
        }
    }
    change
}

/// Returns the change of the motion of each sphere after the impact, at the undisturbed time.
fn after(model: &Model, answer: &Answer) -> Vec<SphereTangent> {
    let Answer { given, velocities, spins, .. } = answer;
    let later = given.later;
    let after = |(number, sphere): (usize, &super::saltation::Colliding)| {
        let velocity: DVec3 = velocities[number].value();
        SphereTangent {
            position: given.places[number].change() - later * velocity,
            velocity: velocities[number].change() - later * sphere.after.acceleration(velocity),
            angular_velocity: spins[number].change() - later * sphere.after.angular_acceleration,
        }
    };
    model.members.iter().enumerate().map(after).collect()
}

fn sphere_number(sphere: &mut SphereVariation, number: usize) -> &mut f64 {
    match number {
        0..3 => &mut sphere.position[number],
        3..6 => &mut sphere.velocity[number - 3],
        6..9 => &mut sphere.angular_velocity[number - 6],
        9 => &mut sphere.radius,
        10 => &mut sphere.mass,
        11 => &mut sphere.restitution,
        _ => &mut sphere.friction,
    }
}

fn collider_number(collider: &mut ColliderVariation, number: usize) -> &mut f64 {
    match number {
        0..3 => &mut collider.position[number],
        3..6 => &mut collider.velocity[number - 3],
        6 => &mut collider.restitution,
        _ => &mut collider.friction,
    }
}
