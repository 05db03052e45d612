//! Positions and orientations one frame ago, for pictures between two frames.

use carom::{Boundary, DQuat, DVec3, SphereId, World};

use crate::periodic;

/// Positions and orientations one frame ago, one for each present sphere.
#[derive(Debug, Clone)]
pub(crate) struct Previous {
    ids: Vec<SphereId>,
    positions: Vec<DVec3>,
    /// Empty while no sphere has rotated.
    orientations: Vec<DQuat>,
}

impl Previous {
    /// Stores the present state.
    pub fn new(world: &World) -> Self {
        let spheres = world.spheres();
        Self {
            ids: spheres.ids().to_vec(),
            positions: spheres.positions().to_vec(),
            orientations: spheres.orientations().to_vec(),
        }
    }

    /// Stores the present state in the existing memory.
    pub fn remember(&mut self, world: &World) {
        self.ids.clear();
        self.ids.extend_from_slice(world.spheres().ids());
        self.positions.clear();
        self.positions.extend_from_slice(world.spheres().positions());
        self.orientations.clear();
        self.orientations.extend_from_slice(world.spheres().orientations());
    }

    /// Adapts the stored state to the spheres after a frame. A new sphere gets its present
    /// position; a sphere that crossed a periodic boundary gets its position beyond the boundary.
    pub fn align(&mut self, world: &World) {
        if !world.spheres().orientations().is_empty() {
            self.orientations.resize(self.ids.len(), DQuat::IDENTITY);
        }
        if self.ids != world.spheres().ids() {
            self.fit(world);
        }
        if let Boundary::Periodic { size } = world.settings().boundary {
            for (before, now) in self.positions.iter_mut().zip(world.spheres().positions()) {
                *before += periodic::whole_edges(*now - *before, size);
            }
        }
    }

    fn fit(&mut self, world: &World) {
        let spheres = world.spheres();
        let mut old = self.ids.iter().enumerate().peekable();
        let old_index_of = |id: &SphereId| {
            // Both lists are ascending.
            while old.next_if(|(_, old)| *old < id).is_some() {}
            old.next_if(|(_, old)| *old == id).map(|(index, _)| index)
        };
        let old: Vec<_> = spheres.ids().iter().map(old_index_of).collect();
        self.positions = fitted(&old, &self.positions, spheres.positions());
        self.orientations = fitted(&old, &self.orientations, spheres.orientations());
        self.ids.clear();
        self.ids.extend_from_slice(spheres.ids());
    }

    /// Positions \[m\].
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// Rotations from the coordinate system of each sphere to the world's; empty while no sphere
    /// has rotated.
    pub fn orientations(&self) -> &[DQuat] {
        &self.orientations
    }
}

/// Orders previous values as the present ones; a sphere without an old index gets its present
/// value.
fn fitted<T: Copy>(old: &[Option<usize>], before: &[T], now: &[T]) -> Vec<T> {
    old.iter().zip(now).map(|(old, now)| old.map_or(*now, |index| before[index])).collect()
}
