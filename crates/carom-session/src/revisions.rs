//! Undo and redo of manual edits.

use std::sync::Arc;

use crate::change::PastChange;

/// Most manual edits that can be undone: more than a user remembers.
const MOST: usize = 100;

/// All changes at one time.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Revision {
    /// Present frame at that time.
    pub frame: u64,
    /// Changes, ascending by frame.
    pub changes: Arc<Vec<PastChange>>,
}

/// Changes before each manual edit, and after each edit that was undone.
#[derive(Debug, Clone, Default)]
pub(crate) struct Revisions {
    /// States before edits; the most recent one is the last.
    before: Vec<Revision>,
    /// States after undone edits; the next one to redo is the last.
    after: Vec<Revision>,
}

impl Revisions {
    /// Stores the changes before a manual edit. Undone edits can no longer be repeated.
    pub fn open(&mut self, before: Revision) {
        self.after.clear();
        self.before.push(before);
        if self.before.len() > MOST {
            self.before.remove(0);
        }
    }

    /// Records that the last manual edit was continued. Undone edits can no longer be repeated.
    pub fn go_on(&mut self) {
        self.after.clear();
    }

    /// Returns the changes before the last manual edit; stores the present ones for [`Self::redo`].
    pub fn undo(&mut self, present: &Arc<Vec<PastChange>>) -> Option<Revision> {
        let found = self.before.pop()?;
        self.after.push(Revision { frame: found.frame, changes: present.clone() });
        Some(found)
    }

    /// Returns the changes after the edit that was undone last; stores the present ones for
    /// [`Self::undo`].
    pub fn redo(&mut self, present: &Arc<Vec<PastChange>>) -> Option<Revision> {
        let found = self.after.pop()?;
        self.before.push(Revision { frame: found.frame, changes: present.clone() });
        Some(found)
    }

    /// Number of manual edits that can be undone.
    pub fn undoable(&self) -> usize {
        self.before.len()
    }

    /// Number of edits that can be repeated.
    pub fn redoable(&self) -> usize {
        self.after.len()
    }
}
