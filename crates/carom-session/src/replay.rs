//! Repeats a run forwards only.

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

/// A world that goes forwards and makes the changes of a link at their frames. At each frame it
/// equals, bit for bit, a [`Session`](crate::Session) of the same link, but it stores no past and
/// nothing that only an interface needs.
#[derive(Debug)]
pub struct Replay {
    scene: Scene,
    world: World,
    setup: Arc<Setup>,
    /// Left without colours, because a replay is not drawn.
    looks: Looks,
    changes: Arc<Vec<PastChange>>,
    /// Number of changes made so far.
    made: usize,
    /// Number of frames taken.
    frame: u64,
}

impl Replay {
    /// Opens a scene without changes.
    ///
    /// # Errors
    /// [`SceneError`] if the scene is invalid, which is only possible for one built in code.
    pub fn new(scene: Scene) -> Result<Self, SceneError> {
        let world = scene.world()?;
        let setup = Arc::new(Setup::new(&scene, &world));
        let (looks, changes, made, frame) = (Looks::default(), Arc::default(), 0, 0);
        Ok(Self { scene, world, setup, looks, changes, made, frame })
    }

    /// Opens the scene of a link at the beginning of its run.
    ///
    /// # Errors
    /// [`SessionError::Scene`] if the scene is invalid, [`SessionError::Repeat`] if a change at the
    /// beginning is refused.
    pub fn of(link: &Link, scene: Scene) -> Result<Self, SessionError> {
        let mut replay = Self { changes: link.changes().clone(), ..Self::new(scene)? };
        replay.make_changes()?;
        Ok(replay)
    }

    /// Frame nearest to a time \[s\], counted from the beginning of the run.
    ///
    /// # Errors
    /// The same as those of [`Session::frame_at`](crate::Session::frame_at).
    pub fn frame_at(&self, time: f64) -> Result<u64, SessionError> {
        let mut timetable = Timetable::new(self.scene.simulation.frame_time);
        timetable.extend(&self.changes);
        timetable.frame_at(time)
    }

    /// Takes one frame and makes the changes at its end. The world contains the report of the
    /// frame.
    ///
    /// # Errors
    /// [`SessionError::World`] if the physics refuses the step; then nothing has moved.
    /// [`SessionError::Repeat`] if the frame was taken but a change there was refused.
    pub fn step(&mut self) -> Result<(), SessionError> {
        self.step_by(|world, dt| Ok(world.step(dt).map(|_| ())?))
    }

    /// Takes one frame by a function that advances the world by a time \[s\], and makes the changes at its end.
    ///
    /// # Errors
    /// Those of the function; then nothing else is done. [`SessionError::Repeat`] if a change was refused.
    pub fn step_by<E: From<SessionError>>(
        &mut self,
        step: impl FnOnce(&mut World, f64) -> Result<(), E>,
    ) -> Result<(), E> {
        step(&mut self.world, self.setup.simulation.frame_time)?;
        self.frame += 1;
        Ok(self.make_changes()?)
    }

    /// Sets a request that ends steps early; see [`World::set_stop_request`].
    pub fn set_stop_request(&mut self, request: Option<StopRequest>) {
        self.world.set_stop_request(request);
    }

    /// Present state of the world.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// Scene at the beginning.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Present settings of the simulation.
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
