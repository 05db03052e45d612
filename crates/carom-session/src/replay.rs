//! A run repeated, forwards only.

use std::sync::Arc;

use carom::{StopRequest, World};
use carom_scene::SceneError;
use carom_scene::scene::{Scene, Simulation};

use crate::change::{Change, PastChange};
use crate::error::SessionError;
use crate::link::Link;
use crate::looks::Looks;
use crate::setup::Setup;
use crate::subjects::Subjects;
use crate::timetable::Timetable;

/// A world that goes forwards, with the changes of a link made at their frames: what a
/// [`Session`](crate::Session) of the same link is at each frame, to the bit, without a past and
/// whatever else only an interface needs.
#[derive(Debug)]
pub struct Replay {
    scene: Scene,
    world: World,
    setup: Arc<Setup>,
    /// No colours: a replay is not drawn.
    looks: Looks,
    changes: Arc<Vec<PastChange>>,
    /// How many of them have been made.
    made: usize,
    /// Number of frames taken.
    frame: u64,
}

impl Replay {
    /// A scene without changes.
    ///
    /// # Errors
    /// [`SceneError`] if the scene makes no sense; only one put together in code can.
    pub fn new(scene: Scene) -> Result<Self, SceneError> {
        let world = scene.world()?;
        let setup = Arc::new(Setup::new(&scene, &world));
        let (looks, changes, made, frame) = (Looks::default(), Arc::default(), 0, 0);
        Ok(Self { scene, world, setup, looks, changes, made, frame })
    }

    /// A scene, the one of this link, at the beginning of its run.
    ///
    /// # Errors
    /// [`SessionError::Scene`] if the scene makes no sense, [`SessionError::Repeat`] for a change
    /// at the beginning that is refused.
    pub fn of(link: &Link, scene: Scene) -> Result<Self, SessionError> {
        let mut replay = Self { changes: link.changes().clone(), ..Self::new(scene)? };
        replay.make_changes()?;
        Ok(replay)
    }

    /// The frame nearest to a time \[s\], counted from the beginning of the run.
    ///
    /// # Errors
    /// As [`Session::frame_at`](crate::Session::frame_at).
    pub fn frame_at(&self, time: f64) -> Result<u64, SessionError> {
        let mut timetable = Timetable::new(self.scene.simulation.frame_time);
        timetable.extend(&self.changes);
        timetable.frame_at(time)
    }

    /// Takes one frame, and makes the changes that come then. The report of the frame is that of
    /// the world.
    ///
    /// # Errors
    /// [`SessionError::World`] if the physics cannot take it; nothing has moved then.
    /// [`SessionError::Repeat`] if the frame is taken, but a change there is refused.
    pub fn step(&mut self) -> Result<(), SessionError> {
        self.world.step(self.setup.simulation.frame_time)?;
        self.frame += 1;
        self.make_changes()
    }

    /// Has steps end early once a request is made; see [`World::set_stop_request`].
    pub fn set_stop_request(&mut self, request: Option<StopRequest>) {
        self.world.set_stop_request(request);
    }

    /// The world at present.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// The scene at the beginning.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// How it is stepped at present.
    pub fn simulation(&self) -> &Simulation {
        &self.setup.simulation
    }

    /// Number of edits made so far.
    pub fn edits(&self) -> usize {
        let made = &self.changes[..self.made];
        made.iter().filter(|it| matches!(it.change, Change::Edit(_))).count()
    }

    fn make_changes(&mut self) -> Result<(), SessionError> {
        let frame = self.frame;
        while let Some(past) = self.changes.get(self.made).filter(|it| it.frame == frame) {
            let Self { scene, world, setup, looks, .. } = self;
            Subjects { world, setup, looks }
                .change(&past.change, scene)
                .map_err(|error| SessionError::Repeat { frame, source: Box::new(error) })?;
            self.made += 1;
        }
        Ok(())
    }
}
