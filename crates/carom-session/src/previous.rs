//! Where spheres were a frame ago, for pictures between two frames.

use carom::{Boundary, DVec3, SphereId, World};

use crate::periodic;

/// Positions a frame ago, one for each sphere there is now.
#[derive(Debug, Clone)]
pub(crate) struct Previous {
    ids: Vec<SphereId>,
    positions: Vec<DVec3>,
}

impl Previous {
    /// The present.
    pub fn new(world: &World) -> Self {
        let spheres = world.spheres();
        Self { ids: spheres.ids().to_vec(), positions: spheres.positions().to_vec() }
    }

    /// Takes over the present, without allocating where there is place.
    pub fn remember(&mut self, world: &World) {
        self.ids.clear();
        self.ids.extend_from_slice(world.spheres().ids());
        self.positions.clear();
        self.positions.extend_from_slice(world.spheres().positions());
    }

    /// Fits what was remembered to the spheres after a frame: a new one was where it is now, and
    /// one that crossed a periodic boundary was beyond it.
    pub fn align(&mut self, world: &World) {
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
        let (ids, now) = (world.spheres().ids(), world.spheres().positions());
        let mut old = self.ids.iter().zip(&self.positions).peekable();
        let mut positions = Vec::with_capacity(ids.len());
        for (id, now) in ids.iter().zip(now) {
            // Both lists are ascending.
            while old.next_if(|(old, _)| *old < id).is_some() {}
            let before = old.next_if(|(old, _)| *old == id).map(|(_, before)| *before);
            positions.push(before.unwrap_or(*now));
        }
        self.positions = positions;
        self.ids.clear();
        self.ids.extend_from_slice(ids);
    }

    /// \[m\]
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }
}
