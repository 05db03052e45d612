//! What a run leaves: the states of all spheres, frame by frame.

use std::collections::BTreeMap;
use std::sync::Arc;

use carom::{SphereId, World};

use crate::arrays::{Column, Quantity};
use crate::tables::Table;

/// Rows of states, one for each recorded frame.
#[derive(Debug, Default)]
pub struct Recording {
    /// \[s\]
    pub times: Vec<f64>,
    /// What is recorded of each sphere of each row: centres and velocities, and how spheres are turned
    /// and turn where the first frame has spin.
    motion: Vec<Column>,
    /// The spheres of each row, ascending.
    members: Vec<Arc<[SphereId]>>,
    /// Radius \[m\] and mass \[kg\] of every sphere of any row, as it was last.
    known: BTreeMap<SphereId, [f64; 2]>,
    /// Every impact of every frame, recorded or not.
    pub impacts: Table,
}

/// The rows with a place in each for every sphere of any of them.
#[derive(Debug)]
pub struct States {
    /// Ascending.
    pub ids: Vec<SphereId>,
    /// \[m\]
    pub radii: Vec<f64>,
    /// \[kg\]
    pub masses: Vec<f64>,
    /// What changes from row to row; NaN where a sphere is not there.
    pub motion: Vec<Column>,
}

impl Recording {
    /// Appends the state of a world.
    pub fn push(&mut self, world: &World) {
        let spheres = world.spheres();
        if self.times.is_empty() {
            let recorded = if world.has_spin() { &Quantity::MOTION[..] } else { &WITHOUT_SPIN };
            self.motion = recorded.iter().map(|&quantity| (quantity, Vec::new())).collect();
        }
        self.times.push(world.time());
        for (quantity, values) in &mut self.motion {
            let row = values.len();
            values.resize(row + quantity.width() * spheres.len(), 0.0);
            quantity.write(spheres, &mut values[row..]);
        }
        let last = self.members.last().filter(|last| ***last == *spheres.ids());
        let members = last.map_or_else(|| spheres.ids().into(), Arc::clone);
        if !self.members.last().is_some_and(|last| Arc::ptr_eq(last, &members)) {
            let properties = spheres.radii().iter().zip(spheres.masses());
            let known = spheres.ids().iter().zip(properties);
            self.known.extend(known.map(|(id, (radius, mass))| (*id, [*radius, *mass])));
        }
        self.members.push(members);
    }

    /// The states, and the rest of the recording.
    pub fn finish(self) -> (Vec<f64>, States, Table) {
        let ids: Vec<SphereId> = self.known.keys().copied().collect();
        let is_whole = self.members.iter().all(|members| **members == *ids);
        let spread = |(quantity, values): Column| match is_whole {
            true => (quantity, values),
            false => (quantity, spread(&values, quantity.width(), &self.members, &ids)),
        };
        let states = States {
            radii: self.known.values().map(|[radius, _]| *radius).collect(),
            masses: self.known.values().map(|[_, mass]| *mass).collect(),
            motion: self.motion.into_iter().map(spread).collect(),
            ids,
        };
        (self.times, states, self.impacts)
    }
}

/// What is recorded where nothing turns.
const WITHOUT_SPIN: [Quantity; 2] = [Quantity::Positions, Quantity::Velocities];

/// Rows of `width` numbers for each of their members, as rows of all `ids`.
fn spread(values: &[f64], width: usize, members: &[Arc<[SphereId]>], ids: &[SphereId]) -> Vec<f64> {
    let mut all = vec![f64::NAN; width * ids.len() * members.len()];
    let mut values = values.chunks_exact(width);
    for (row, members) in members.iter().enumerate() {
        for (id, value) in members.iter().zip(&mut values) {
            // Every member is among the ids.
            let column = ids.partition_point(|other| other < id);
            let place = width * (row * ids.len() + column);
            all[place..place + width].copy_from_slice(value);
        }
    }
    all
}
