//! A session: a scene with its past and its edits.

mod editing;

use std::iter;
use std::sync::Arc;

use carom::{DQuat, DVec3, SphereId, StateHash, StopRequest, World};
use carom_scene::SceneError;
use carom_scene::scene::Scene;

use crate::change::{Change, PastChange};
use crate::error::SessionError;
use crate::history::{History, Moment};
use crate::link::Link;
use crate::looks::Looks;
use crate::previous::Previous;
use crate::readings::{Readings, Tally};
use crate::revisions::Revisions;
use crate::setup::Setup;
use crate::subjects;
use crate::view::{SphereArrays, View, replace};

/// An interactive simulation of a scene.
///
/// Time passes in frames. Every frame reached so far can be restored bit for bit, because all
/// changes are repeated at their frames. A new edit cuts off the frames after it.
#[derive(Debug, Clone)]
pub struct Session {
    /// The scene as opened.
    scene: Arc<Scene>,
    setup: Arc<Setup>,
    world: World,
    looks: Looks,
    /// Number of frames taken.
    frame: u64,
    /// Number of changes made so far.
    changes: usize,
    history: History,
    revisions: Revisions,
    readings: Readings,
    previous: Previous,
    /// Frame to go to.
    target: Option<u64>,
    /// Increases whenever properties of spheres other than their motion may have changed.
    stamp: u64,
}

impl Session {
    /// Opens a scene.
    ///
    /// # Errors
    /// [`SceneError`] if the scene is invalid, which is only possible for one built in code.
    pub fn new(scene: Scene) -> Result<Self, SceneError> {
        Self::with_changes(scene, Arc::default())
    }

    /// Opens a scene with `changes`, ascending by frame, that are still to be made.
    fn with_changes(scene: Scene, changes: Arc<Vec<PastChange>>) -> Result<Self, SceneError> {
        let world = scene.world()?;
        let setup = Arc::new(Setup::new(&scene, &world));
        let looks = Looks::new(&scene, &world);
        let start = Moment::new(0, 0, Tally::default(), &world, (&setup, &looks));
        let history = History::new(start, setup.simulation.frame_time, changes);
        let mut readings = Readings::default();
        readings.measure(0, &world);
        let previous = Previous::new(&world);
        let scene = Arc::new(scene);
        let (frame, changes, target, stamp) = (0, 0, None, 0);
        Ok(Self {
            scene,
            setup,
            world,
            looks,
            frame,
            changes,
            history,
            revisions: Revisions::default(),
            readings,
            previous,
            target,
            stamp,
        })
    }

    /// Opens the scene of a link and starts to go to the time of the link. [`Self::advance_seek`]
    /// goes there and makes every change of the link at its frame. At that time, the session equals
    /// the one from which the link was created, bit for bit. Changes after that time are made when
    /// their frames are reached.
    ///
    /// # Errors
    /// [`SessionError::Scene`] if the scene is invalid, [`SessionError::Repeat`] if a change at the
    /// beginning is refused, and those of [`Self::frame_at`].
    pub fn replay(scene: Scene, link: &Link) -> Result<Self, SessionError> {
        let mut session = Self::with_changes(scene, link.changes().clone())?;
        session.repeat_changes()?;
        if let Some(time) = link.time() {
            session.seek(session.frame_at(time)?);
        }
        Ok(session)
    }

    /// Takes one frame and stops any seek.
    ///
    /// # Errors
    /// [`SessionError::World`] if the physics refuses the step; then nothing changes.
    /// [`SessionError::Repeat`] if the frame was taken, but a change of a link there was refused.
    pub fn step(&mut self) -> Result<(), SessionError> {
        self.target = None;
        self.take_frame()
    }

    /// Goes back by one frame, if there is one.
    ///
    /// # Errors
    /// Only those that these frames had when they were first taken.
    pub fn step_back(&mut self) -> Result<(), SessionError> {
        self.seek(self.frame.saturating_sub(1));
        self.advance_seek(u64::MAX).map(drop)
    }

    /// Goes back to the beginning; the frames after it are kept.
    ///
    /// # Errors
    /// Only those that opening the session had.
    pub fn restart(&mut self) -> Result<(), SessionError> {
        self.seek(0);
        self.advance_seek(u64::MAX).map(drop)
    }

    /// Goes to the frame nearest to a time \[s\] in one call; the frame may be new.
    ///
    /// # Errors
    /// [`SessionError::Time`] if the time is invalid; those of [`Self::step`] for new frames.
    pub fn jump(&mut self, time: f64) -> Result<(), SessionError> {
        self.seek(self.frame_at(time)?);
        self.advance_seek(u64::MAX).map(drop)
    }

    /// Frame nearest to a time \[s\].
    ///
    /// # Errors
    /// [`SessionError::Time`] if the time is negative or not finite, [`SessionError::TooFar`] if it
    /// is more than 100,000,000 frames after the start.
    pub fn frame_at(&self, time: f64) -> Result<u64, SessionError> {
        self.history.frame_at(time)
    }

    /// Starts to go to a frame; [`Self::advance_seek`] goes there.
    pub fn seek(&mut self, frame: u64) {
        let is_ahead = self.frame <= frame;
        if !(is_ahead && self.history.before(frame).frame <= self.frame) {
            self.return_before(frame);
            // Changes at a frame reached before were accepted.
            let _ = self.repeat_changes();
        }
        self.target = Some(frame).filter(|frame| *frame != self.frame);
    }

    /// Frame to which the session is going.
    pub fn seeking(&self) -> Option<u64> {
        self.target
    }

    /// Stops going to a frame; stays at the present one.
    pub fn stop_seeking(&mut self) {
        self.target = None;
    }

    /// Takes up to `budget` frames towards the frame of [`Self::seek`]. Returns whether the session
    /// has arrived.
    ///
    /// # Errors
    /// The same as those of [`Self::step`]; then the seek ends.
    pub fn advance_seek(&mut self, budget: u64) -> Result<bool, SessionError> {
        for _ in 0..budget {
            let Some(target) = self.target else { break };
            if let Err(error) = self.take_frame() {
                self.target = None;
                return Err(error);
            }
            self.target = Some(target).filter(|target| *target != self.frame);
        }
        Ok(self.target.is_none())
    }

    /// Picks a sphere to follow, or none; its past is read as far as it is stored.
    pub fn pick(&mut self, sphere: Option<SphereId>) {
        let past = self.history.until(self.frame).map(|moment| (moment.frame, moment.state()));
        self.readings.pick(sphere, past);
        self.readings.measure(self.frame, &self.world);
    }

    /// Sets a limit on the memory for the past \[bytes\]. Frames that are not stored are computed
    /// again when the session goes back; the beginning is always stored.
    pub fn set_memory(&mut self, bytes: usize) {
        self.history.set_memory(bytes, self.frame);
    }

    /// Estimated memory of the past \[bytes\].
    pub fn memory(&self) -> usize {
        self.history.bytes()
    }

    /// The scene as opened.
    pub fn scene(&self) -> &Arc<Scene> {
        &self.scene
    }

    /// Writes the present as a scene, with all edits, and with every sphere as a single one. When
    /// it is opened, its world is the same bit for bit, except that its clock starts at 0, its
    /// emitters emit at once, and all flights are computed again, as after an edit.
    pub fn scene_now(&self) -> Scene {
        let mut view = View::default();
        self.fill(&mut view);
        view.scene_now()
    }

    /// Copies everything that an interface shows, in the existing memory of the view. The state of
    /// playback is not changed.
    pub fn fill(&self, view: &mut View) {
        let is_same = Arc::ptr_eq(&view.scene, &self.scene);
        if !(is_same && view.spheres.stamp == self.stamp) {
            self.fill_properties(&mut view.spheres);
            replace(&mut view.springs, self.world.springs().map(|(id, spring)| (id, *spring)));
            view.scene = self.scene.clone();
        }
        self.fill_motion(&mut view.spheres);
        (view.setup, view.changes) = (self.setup.clone(), self.history.changes().clone());
        (view.frame, view.time) = (self.frame, self.time());
        (view.furthest_frame, view.furthest) = self.history.furthest();
        view.edits = self.history.edit_times();
        (view.undoable, view.redoable) = (self.revisions.undoable(), self.revisions.redoable());
        view.seeking = self.target;
        replace(&mut view.poses, self.world.colliders().map(|(_, collider)| collider.pose));
        self.fill_readings(view);
    }

    /// Returns everything but the spheres, as edited.
    pub fn setup(&self) -> &Arc<Setup> {
        &self.setup
    }

    /// All changes, ascending by frame, including those in the future.
    pub fn changes(&self) -> &Arc<Vec<PastChange>> {
        self.history.changes()
    }

    /// Sets a request that ends steps early; see [`World::set_stop_request`].
    pub fn set_stop_request(&mut self, request: Option<StopRequest>) {
        self.world.set_stop_request(request);
    }

    /// Present state of the world.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// The state of the world as one number.
    pub fn state_hash(&self) -> StateHash {
        self.world.state_hash()
    }

    /// Number of frames taken.
    pub fn frame(&self) -> u64 {
        self.frame
    }

    /// Present time \[s\].
    pub fn time(&self) -> f64 {
        self.world.time()
    }

    /// Length of the next frame \[s\].
    pub fn frame_time(&self) -> f64 {
        self.setup.simulation.frame_time
    }

    /// Time of the furthest frame \[s\].
    pub fn furthest(&self) -> f64 {
        self.history.furthest().1
    }

    /// Furthest frame reached that was not cut off.
    pub fn furthest_frame(&self) -> u64 {
        self.history.furthest().0
    }

    /// Positions of the spheres one frame ago \[m\], in the order of the world; present positions
    /// for new spheres.
    pub fn previous_positions(&self) -> &[DVec3] {
        self.previous.positions()
    }

    /// Goes back to the last stored moment that is not after this frame.
    fn return_before(&mut self, frame: u64) {
        let moment = self.history.before(frame);
        moment.restore(&mut self.world);
        (self.frame, self.changes) = (moment.frame, moment.changes);
        (self.setup, self.looks) = (moment.setup.clone(), moment.looks.clone());
        self.readings.go_to(moment.frame, moment.tally);
        self.previous.remember(&self.world);
        self.stamp += 1;
    }

    fn take_frame(&mut self) -> Result<(), SessionError> {
        let start = self.world.time();
        self.previous.remember(&self.world);
        if let Err(error) = self.world.step(self.setup.simulation.frame_time) {
            self.note_failed_step();
            return Err(error.into());
        }
        self.frame += 1;
        let report = self.world.report();
        self.looks.note(report, start, &self.scene, (&self.world, &self.setup));
        if !(report.emitted.is_empty() && report.retired.is_empty()) {
            self.stamp += 1;
        }
        self.previous.align(&self.world);
        self.readings.note(self.frame, start, &self.world);
        self.history.reach(self.frame, self.world.time());
        self.repeat_changes()?;
        if self.history.wants(self.frame, &self.world) {
            let more = (&self.setup, &self.looks);
            let tally = self.readings.tally;
            let moment = Moment::new(self.frame, self.changes, tally, &self.world, more);
            self.history.keep(moment);
        }
        Ok(())
    }

    /// Records a failed step, after which all flights are computed again, as a change. The
    /// following frames can then be restored bit for bit.
    fn note_failed_step(&mut self) {
        subjects::begin_flights_anew(&mut self.world);
        if self.frame == self.furthest_frame() && !self.history.ends_with_failed_step() {
            self.changes = self.history.note(Change::FailedStep, self.frame_time());
        }
    }

    fn fill_properties(&self, arrays: &mut SphereArrays) {
        let spheres = self.world.spheres();
        replace(&mut arrays.ids, spheres.ids().iter().copied());
        replace(&mut arrays.radii, spheres.radii().iter().copied());
        replace(&mut arrays.masses, spheres.masses().iter().copied());
        replace(&mut arrays.restitutions, spheres.restitutions().iter().copied());
        replace(&mut arrays.restitution_laws, spheres.restitution_laws().iter().copied());
        replace(&mut arrays.materials, spheres.materials().iter().copied());
        replace(&mut arrays.frictions, spheres.frictions().iter().copied());
        replace(&mut arrays.inertia_factors, spheres.inertia_factors().iter().copied());
        let mut paints = self.looks.paints().iter().peekable();
        // Both lists are ascending.
        let paint_of = |id: &SphereId| {
            while paints.next_if(|(of, _)| of < id).is_some() {}
            paints.next_if(|(of, _)| of == id).map(|(_, paint)| *paint).unwrap_or_default()
        };
        replace(&mut arrays.paints, spheres.ids().iter().map(paint_of));
        arrays.stamp = self.stamp;
    }

    fn fill_motion(&self, arrays: &mut SphereArrays) {
        let spheres = self.world.spheres();
        replace(&mut arrays.positions, spheres.positions().iter().copied());
        replace(&mut arrays.velocities, spheres.velocities().iter().copied());
        replace(&mut arrays.orientations, spheres.orientations().iter().copied());
        replace(&mut arrays.angular_velocities, spheres.angular_velocities().iter().copied());
        replace(&mut arrays.previous_positions, self.previous_positions().iter().copied());
        // At the start there may be no orientations yet, even if the first frame rotates spheres.
        let before =
            self.previous.orientations().iter().copied().chain(iter::repeat(DQuat::IDENTITY));
        let count = if self.world.has_spin() { spheres.len() } else { 0 };
        replace(&mut arrays.previous_orientations, before.take(count));
    }

    fn fill_readings(&self, view: &mut View) {
        let Self { readings, frame, world, .. } = self;
        view.now = readings.present(*frame, world);
        replace(&mut view.readings, readings.until(*frame).copied());
        view.readings.pop_if(|last| last.time >= view.now.time);
        view.readings.push(view.now);
        view.picked = readings.picked();
        replace(&mut view.picked_readings, readings.of_picked_until(*frame).copied());
        if let Some(now) = readings.present_of_picked(world) {
            view.picked_readings.pop_if(|last| last.time >= now.time);
            view.picked_readings.push(now);
        }
        replace(&mut view.impacts, readings.last_impacts().copied());
    }
}
