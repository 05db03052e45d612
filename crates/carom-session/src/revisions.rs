//! Changes by hand that can be taken back, and made again.

use std::sync::Arc;

use crate::change::PastChange;

/// Most changes by hand that can be taken back: more than anybody remembers.
const MOST: usize = 100;

/// All changes as they were at one time.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Revision {
    /// The frame that was the present then.
    pub frame: u64,
    /// Ascending by frame.
    pub changes: Arc<Vec<PastChange>>,
}

/// What there was before each change by hand, and what there was after those that were taken back.
#[derive(Debug, Default)]
pub(crate) struct Revisions {
    /// The last one last.
    before: Vec<Revision>,
    /// The next one last.
    after: Vec<Revision>,
}

impl Revisions {
    /// Notes what there is before a change by hand. What was taken back is lost.
    pub fn open(&mut self, before: Revision) {
        self.after.clear();
        self.before.push(before);
        if self.before.len() > MOST {
            self.before.remove(0);
        }
    }

    /// Notes that a change by hand went on. What was taken back is lost.
    pub fn go_on(&mut self) {
        self.after.clear();
    }

    /// What there was before the last change by hand, in the place of what there is.
    pub fn undo(&mut self, present: &Arc<Vec<PastChange>>) -> Option<Revision> {
        let found = self.before.pop()?;
        self.after.push(Revision { frame: found.frame, changes: present.clone() });
        Some(found)
    }

    /// What there was after the change by hand that was taken back last, in the place of what there
    /// is.
    pub fn redo(&mut self, present: &Arc<Vec<PastChange>>) -> Option<Revision> {
        let found = self.after.pop()?;
        self.before.push(Revision { frame: found.frame, changes: present.clone() });
        Some(found)
    }

    /// How many changes by hand can be taken back.
    pub fn undoable(&self) -> usize {
        self.before.len()
    }

    /// How many can be made again.
    pub fn redoable(&self) -> usize {
        self.after.len()
    }
}
