//! Finds which contacts bear an impact, from the undisturbed one.

use glam::DVec3;

use super::model::{Contact, Model};
use super::plan::Layer;
use crate::respond::{self, Projection, TouchingContact};

/// A contact bears an impact if its impulse is more than this part of the largest one.
const BEARS: f64 = 1e-9;

/// Returns the layers of the answer to a group; `None` if the law has none of its own.
pub(in crate::tangent) fn layers_of(model: &Model) -> Option<Vec<Layer>> {
    let velocities: Vec<DVec3> = model.members.iter().map(|it| it.velocity).collect();
    let contacts = touching(model, |contact| contact.restitution.combined.value);
    let projections = respond::projections(&contacts, &masses(model), &velocities)?;
    let restitutions: Vec<f64> = contacts.iter().map(|it| it.restitution).collect();
    let mut levels = respond::levels(&restitutions);
    let is_thinned = restitutions.iter().any(|it| *it > 0.0 && !levels.contains(it));
    if is_thinned {
        return None;
    }
    if levels.last().is_none_or(|&it| it < 1.0) {
        // What is left is plastic.
        levels.push(f64::INFINITY);
    }
    let layer = |(number, &level): (usize, &f64)| Layer {
        level,
        projections: projections.iter().filter(|it| it.layer == number).map(bearing).collect(),
    };
    Some(levels.iter().enumerate().map(layer).collect())
}

/// Returns the contacts that bear the plastic answer at some velocities \[m/s\]; `None` if none closes.
pub(in crate::tangent) fn plastic_at(model: &Model, velocities: &[DVec3]) -> Option<Vec<usize>> {
    let contacts = touching(model, |_| 0.0);
    respond::projections(&contacts, &masses(model), velocities)?.first().map(bearing)
}
fn touching(model: &Model, restitution: impl Fn(&Contact) -> f64) -> Vec<TouchingContact> {
    let contact = |it: &Contact| TouchingContact {
        first: it.first,
        second: it.second,
        normal: it.normal,
        surface_velocity: DVec3::ZERO,
        restitution: restitution(it),
    };
    model.contacts.iter().map(contact).collect()
}

fn masses(model: &Model) -> Vec<f64> {
    model.members.iter().map(|it| it.mass).collect()
}

fn bearing(projection: &Projection) -> Vec<usize> {
    let impulses = &projection.impulses;
    let largest = impulses.iter().copied().fold(0.0, f64::max);
    (0..impulses.len()).filter(|&it| impulses[it] > BEARS * largest).collect()
}
