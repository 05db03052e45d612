//! Edits of a session: making, undoing and repeating them.

use std::sync::Arc;

use carom_scene::scene::{Scene, Simulation};

use super::Session;
use crate::change::{Change, PastChange};
use crate::edit::Edit;
use crate::error::SessionError;
use crate::revisions::Revision;
use crate::subjects::Subjects;

impl Session {
    /// Makes an edit at the present frame, and cuts off the frames after it. [`Self::undo`] takes
    /// it back.
    ///
    /// # Errors
    /// [`SessionError`] if the edit is invalid; then nothing changes.
    pub fn edit(&mut self, edit: Edit) -> Result<(), SessionError> {
        let before = self.revision();
        self.make(edit)?;
        self.revisions.open(before);
        Ok(())
    }

    /// Makes an edit that continues the last one, as dragging a slider does. Both are undone
    /// together.
    ///
    /// # Errors
    /// [`SessionError`] if the edit is invalid; then nothing changes.
    pub fn edit_further(&mut self, edit: Edit) -> Result<(), SessionError> {
        if self.revisions.undoable() == 0 {
            return self.edit(edit);
        }
        self.make(edit)?;
        self.revisions.go_on();
        Ok(())
    }

    /// Undoes the last manual edit and starts to go to its frame, whose state is that before the
    /// edit; [`Self::advance_seek`] goes there. Returns whether there was one. Changes of a link
    /// are no manual edits.
    pub fn undo(&mut self) -> bool {
        let found = self.revisions.undo(self.history.changes());
        found.map(|revision| self.rewrite(revision)).is_some()
    }

    /// Repeats the edit that was undone last and starts to go to its frame; [`Self::advance_seek`]
    /// goes there. Returns whether there was one.
    pub fn redo(&mut self) -> bool {
        let found = self.revisions.redo(self.history.changes());
        found.map(|revision| self.rewrite(revision)).is_some()
    }

    /// Goes back to the beginning with the values that were edited during the whole run: forces,
    /// rule, materials, and properties of balls. Balls that were moved, thrown or removed during
    /// the run are as before; edits at the beginning itself remain. [`Self::undo`] takes it back.
    pub fn restart_with_values(&mut self) {
        let before = self.revision();
        let values = values_of(&before.changes);
        self.rewrite(Revision { frame: 0, changes: Arc::default() });
        for edit in values {
            // An edit of a ball that does not exist at the beginning is dropped.
            let _ = self.make(edit);
        }
        self.revisions.open(before);
    }

    /// Opens the scene under another simulation, at the beginning. All changes are repeated at
    /// their times, except those of the simulation.
    ///
    /// # Errors
    /// [`SessionError::Scene`] if the scene is invalid under it, [`SessionError::Repeat`] if a
    /// change at the beginning is refused.
    pub(crate) fn under(&self, simulation: &Simulation) -> Result<Self, SessionError> {
        let is_of_simulation = |change: &Change| match change {
            Change::Edit(edit) => matches!(edit, Edit::Simulation(_) | Edit::FrameTime(_)),
            Change::FailedStep => true,
        };
        let edits = self.history.changes().iter().filter(|it| !is_of_simulation(&it.change));
        let frame_at = |frame| (self.history.time_of(frame) / simulation.frame_time).round() as u64;
        let changes =
            edits.map(|it| PastChange { frame: frame_at(it.frame), change: it.change.clone() });
        let scene = Scene { simulation: simulation.clone(), ..(*self.scene).clone() };
        let mut session = Self::with_changes(scene, Arc::new(changes.collect()))?;
        session.repeat_changes()?;
        session.pick(self.readings.picked());
        Ok(session)
    }

    /// Checks whether an edit would be accepted.
    ///
    /// # Errors
    /// [`SessionError`] that the edit would return.
    pub fn check(&self, edit: &Edit) -> Result<(), SessionError> {
        let (mut world, mut setup) = (self.world.clone(), self.setup.clone());
        let mut looks = self.looks.clone();
        let subjects = Subjects { world: &mut world, setup: &mut setup, looks: &mut looks };
        subjects.edit(edit, &self.scene)
    }

    fn revision(&self) -> Revision {
        Revision { frame: self.frame, changes: self.history.changes().clone() }
    }

    fn make(&mut self, edit: Edit) -> Result<(), SessionError> {
        let change = Change::Edit(edit);
        self.apply(&change)?;
        self.target = None;
        self.history.cut(self.frame, self.world.time());
        self.changes = self.history.note(change, self.frame_time());
        self.readings.cut(self.frame, &self.world);
        Ok(())
    }

    /// Replaces all changes and starts to go to a frame.
    fn rewrite(&mut self, revision: Revision) {
        self.history.rewrite(revision.changes);
        self.return_before(revision.frame);
        self.history.end(self.frame, self.world.time(), self.frame_time());
        self.readings.cut(self.frame, &self.world);
        // These changes were accepted when they were made.
        let _ = self.repeat_changes();
        self.target = Some(revision.frame).filter(|frame| *frame != self.frame);
    }

    /// Makes the changes of the present frame. If one is refused, it is dropped with all later
    /// ones; changes made in this session are never refused.
    pub(super) fn repeat_changes(&mut self) -> Result<(), SessionError> {
        let (frame, first) = (self.frame, self.changes);
        let mut refused = None;
        while let Some(change) = self.history.change_at(frame, self.changes) {
            let change = change.clone();
            if let Err(error) = self.apply(&change) {
                self.history.forget_changes_after(self.changes);
                refused = Some(SessionError::Repeat { frame, source: Box::new(error) });
                break;
            }
            self.changes += 1;
        }
        if self.changes > first && frame == self.furthest_frame() {
            self.history.note_frame_time(self.frame_time());
            self.readings.cut(frame, &self.world);
        }
        refused.map_or(Ok(()), Err)
    }

    fn apply(&mut self, change: &Change) -> Result<(), SessionError> {
        let Self { scene, setup, world, looks, .. } = self;
        Subjects { world, setup, looks }.change(change, scene)?;
        self.previous.remember(&self.world);
        self.stamp += 1;
        Ok(())
    }
}

/// Edits that give a run from its start the values of these changes.
fn values_of(all: &[PastChange]) -> Vec<Edit> {
    let mut values: Vec<Edit> = Vec::new();
    for PastChange { frame, change } in all {
        let Change::Edit(edit) = change else { continue };
        let Some(value) = (if *frame == 0 { Some(edit.clone()) } else { edit.value() }) else {
            continue;
        };
        match values.last_mut().and_then(|last| Some((last.merged(&value)?, last))) {
            Some((merged, last)) => *last = merged,
            None => values.push(value),
        }
    }
    values
}
