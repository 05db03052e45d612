//! Changes from outside: made, taken back, and made again.

use std::sync::Arc;

use carom_scene::scene::{Scene, Simulation};

use super::Session;
use crate::change::{Change, PastChange};
use crate::edit::Edit;
use crate::error::SessionError;
use crate::revisions::Revision;
use crate::subjects::Subjects;

impl Session {
    /// Makes a change, now; what came after the present is cut off. [`Self::undo`] takes it back.
    ///
    /// # Errors
    /// What is wrong with it; nothing changes then.
    pub fn edit(&mut self, edit: Edit) -> Result<(), SessionError> {
        let before = self.revision();
        self.make(edit)?;
        self.revisions.open(before);
        Ok(())
    }

    /// Makes a change as [`Self::edit`] does, one that goes on with the last: as a slider does that is
    /// dragged. Both are taken back together.
    ///
    /// # Errors
    /// What is wrong with it; nothing changes then.
    pub fn edit_further(&mut self, edit: Edit) -> Result<(), SessionError> {
        if self.revisions.undoable() == 0 {
            return self.edit(edit);
        }
        self.make(edit)?;
        self.revisions.go_on();
        Ok(())
    }

    /// Takes back the last change by hand, and sets out for the frame at which it was made, where all
    /// is as it was before; [`Self::advance_seek`] goes there. Returns whether there was one. Changes
    /// of a link were not made by hand.
    pub fn undo(&mut self) -> bool {
        let found = self.revisions.undo(self.history.changes());
        found.map(|revision| self.rewrite(revision)).is_some()
    }

    /// Makes the change by hand again that was taken back last, and sets out for its frame;
    /// [`Self::advance_seek`] goes there. Returns whether there was one.
    pub fn redo(&mut self) -> bool {
        let found = self.revisions.redo(self.history.changes());
        found.map(|revision| self.rewrite(revision)).is_some()
    }

    /// Goes back to the beginning with the values that were changed in the whole run: forces, rule,
    /// materials, and what balls are like. Where balls were put, thrown or taken away on the way is
    /// forgotten, but not what was changed at the beginning itself. [`Self::undo`] takes it back.
    pub fn restart_with_values(&mut self) {
        let before = self.revision();
        let values = values_of(&before.changes);
        self.rewrite(Revision { frame: 0, changes: Arc::default() });
        for edit in values {
            // A ball that is not there at the beginning has nothing to be changed.
            let _ = self.make(edit);
        }
        self.revisions.open(before);
    }

    /// The scene under another simulation, at the beginning. Everything that was changed comes again
    /// at its time, but for changes of the simulation.
    ///
    /// # Errors
    /// [`SessionError::Scene`] if the scene makes no sense under it, [`SessionError::Repeat`] for a
    /// change at the beginning that is refused.
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

    /// Whether a change would be refused.
    ///
    /// # Errors
    /// What is wrong with it.
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

    /// Puts other changes in the place of all that there are, and sets out for a frame.
    fn rewrite(&mut self, revision: Revision) {
        self.history.rewrite(revision.changes);
        self.return_before(revision.frame);
        self.history.end(self.frame, self.world.time(), self.frame_time());
        self.readings.cut(self.frame, &self.world);
        // None was refused when it was made.
        let _ = self.repeat_changes();
        self.target = Some(revision.frame).filter(|frame| *frame != self.frame);
    }

    /// Makes the changes that come at this frame. One that is refused, which none is that was made
    /// in this session before, is dropped with all that follow.
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

/// The changes with which a run begins that is to have the values of these from the start.
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
