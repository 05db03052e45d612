//! What the lock of an engine guards.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use carom::World;
use carom_scene::{Palette, Scene};
use pyo3::prelude::*;

use crate::arrays::Arrays;
use crate::failure::Failure;
use crate::snapshot::State;
use crate::stop::Watch;
use crate::threads;
use crate::written;

/// A world and what belongs to it, guarded by the lock of an engine.
#[derive(Debug)]
pub struct Inner {
    pub world: World,
    /// The scene without spheres. Its forces, colliders and emitters have the order of the world;
    /// colliders have the poses of their descriptions.
    pub described: Arc<Scene>,
    /// Colours; updated to the present time only by [`Self::follow_colors`].
    pub palette: Arc<Palette>,
    pub arrays: Arrays,
    /// Start time of the last frame \[s\].
    pub frame_start: f64,
    /// Start time of the frame that is being taken.
    pub clock: Arc<Clock>,
}

impl Inner {
    /// Makes the data of a world before its first frame.
    pub fn new(world: World, described: Arc<Scene>, palette: Arc<Palette>) -> Self {
        let (arrays, clock) = (Arrays::default(), Arc::default());
        Self { world, described, palette, arrays, frame_start: 0.0, clock }
    }

    /// Returns the description for changes, which must match those of the world.
    pub fn described_mut(&mut self) -> &mut Scene {
        Arc::make_mut(&mut self.described)
    }

    /// Returns the colours for changes, which must match those of the world.
    pub fn palette_mut(&mut self) -> &mut Palette {
        Arc::make_mut(&mut self.palette)
    }

    /// Updates the colours for all present spheres.
    pub fn follow_colors(&mut self) {
        let time = self.world.time();
        self.palette_mut().follow(time);
    }

    /// Returns the state.
    pub fn snapshot(&self) -> State {
        let (described, palette) = (Arc::clone(&self.described), Arc::clone(&self.palette));
        State { world: self.world.snapshot(), described, palette, time: self.world.time() }
    }

    /// Writes the state into the memory of an earlier one.
    pub fn snapshot_into(&self, state: &mut State) {
        self.world.snapshot_into(&mut state.world);
        state.described = Arc::clone(&self.described);
        state.palette = Arc::clone(&self.palette);
        state.time = self.world.time();
    }

    /// Restores a state. The report of the last frame is removed.
    pub fn restore(&mut self, snapshot: &State) {
        self.world.restore(&snapshot.world);
        self.described = Arc::clone(&snapshot.described);
        self.palette = Arc::clone(&snapshot.palette);
        self.frame_start = snapshot.time;
    }

    /// Makes Python's signals stop the next frames of this thread.
    pub fn heed_signals(&mut self) -> Watch {
        let watch = Watch::begin();
        self.world.set_stop_request(Some(watch.request()));
        watch
    }

    /// Takes one frame.
    pub fn take_frame(&mut self, dt: f64, watch: &Watch) -> Result<(), carom::Error> {
        let start = self.world.time();
        self.clock.set(start);
        let world = &mut self.world;
        threads::among_all(world.spheres().len(), watch, || world.step(dt).map(|_| ()))?;
        self.frame_start = start;
        Ok(())
    }

    /// Applies values that a script wrote into arrays; if the world refuses them, the arrays get
    /// the world's values again.
    pub fn take_written(&mut self, py: Python<'_>) -> Result<(), Failure> {
        let written = self.arrays.written(py, self.world.spheres());
        if written.is_empty() {
            return Ok(());
        }
        let taken = written::take_over(&mut self.world, &written, |row| row.to_string());
        self.arrays.write_all(py, self.world.spheres());
        taken
    }

    /// Returns the frame time \[s\]: `dt`, or the scene's own.
    pub fn frame_time(&self, dt: Option<f64>) -> f64 {
        dt.unwrap_or(self.described.simulation.frame_time)
    }
}

/// A time \[s\] that can be read while the world is locked, as `f64::to_bits`.
#[derive(Debug, Default)]
pub struct Clock(AtomicU64);

impl Clock {
    fn set(&self, time: f64) {
        self.0.store(time.to_bits(), Ordering::Relaxed);
    }

    /// Returns the time \[s\].
    pub fn read(&self) -> f64 {
        f64::from_bits(self.0.load(Ordering::Relaxed))
    }
}
