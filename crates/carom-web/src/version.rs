//! Which scene is watched, and what was changed in it: a number that tells one from the next.

use std::cell::{Cell, RefCell};
use std::sync::Arc;

use carom_scene::scene::Scene;
use carom_session::PastChange;
use carom_view::App;

/// A scene, and what was changed in it.
type Edited = (Arc<Scene>, Arc<Vec<PastChange>>);

/// Counts scenes and changes as they are looked at.
#[derive(Default)]
pub struct Version {
    number: Cell<u32>,
    /// What was there at the last look. Held, so that no other takes its place in memory.
    seen: RefCell<Option<Edited>>,
}

impl Version {
    /// Another number than at the last look if another scene is watched, or something was changed
    /// in it by hand; the same without one.
    pub fn of(&self, app: &App) -> u32 {
        let Some(view) = app.watching().map(|watching| watching.view()) else {
            return self.number.get();
        };
        let mut seen = self.seen.borrow_mut();
        let is_same = seen.as_ref().is_some_and(|(scene, changes)| {
            Arc::ptr_eq(scene, &view.scene) && Arc::ptr_eq(changes, &view.changes)
        });
        if !is_same {
            *seen = Some((view.scene.clone(), view.changes.clone()));
            self.number.set(self.number.get().wrapping_add(1));
        }
        self.number.get()
    }
}
