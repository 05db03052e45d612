//! What a run leaves: the states of all spheres, frame by frame.

use std::collections::BTreeMap;
use std::sync::Arc;

use carom::{SphereId, World};

use crate::arrays::flat;
use crate::tables::Table;

/// Rows of states, one for each recorded frame.
#[derive(Debug, Default)]
pub struct Recording {
    /// \[s\]
    pub times: Vec<f64>,
    /// Centres \[m\], three numbers for each sphere of each row.
    positions: Vec<f64>,
    /// Velocities \[m/s\], in the order of the positions.
    velocities: Vec<f64>,
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
    /// Centres \[m\]; NaN where a sphere is not there.
    pub positions: Vec<f64>,
    /// Velocities \[m/s\]; NaN where a sphere is not there.
    pub velocities: Vec<f64>,
}

impl Recording {
    /// Appends the state of a world.
    pub fn push(&mut self, world: &World) {
        let spheres = world.spheres();
        self.times.push(world.time());
        self.positions.extend(flat(spheres.positions()));
        self.velocities.extend(flat(spheres.velocities()));
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
        let spread = |values: Vec<f64>| match is_whole {
            true => values,
            false => spread(&values, &self.members, &ids),
        };
        let states = States {
            radii: self.known.values().map(|[radius, _]| *radius).collect(),
            masses: self.known.values().map(|[_, mass]| *mass).collect(),
            positions: spread(self.positions),
            velocities: spread(self.velocities),
            ids,
        };
        (self.times, states, self.impacts)
    }
}

/// Rows of vectors of their members, as rows of all `ids`.
fn spread(values: &[f64], members: &[Arc<[SphereId]>], ids: &[SphereId]) -> Vec<f64> {
    let mut all = vec![f64::NAN; 3 * ids.len() * members.len()];
    let mut values = values.chunks_exact(3);
    for (row, members) in members.iter().enumerate() {
        for (id, value) in members.iter().zip(&mut values) {
            // Every member is among the ids.
            let column = ids.partition_point(|other| other < id);
            let place = 3 * (row * ids.len() + column);
            all[place..place + 3].copy_from_slice(value);
        }
    }
    all
}
