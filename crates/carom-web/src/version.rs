//! A number that changes with the watched scene and with every change in it.

use std::cell::{Cell, RefCell};
use std::sync::Arc;

use carom_scene::scene::Scene;
use carom_session::PastChange;
use carom_view::App;

/// A scene and its changes.
type Edited = (Arc<Scene>, Arc<Vec<PastChange>>);

/// Counts changes between calls of [`Self::of`].
#[derive(Default)]
pub struct Version {
    number: Cell<u32>,
    /// Scene and changes at the last call. Kept alive, so that nothing else gets their address.
    seen: RefCell<Option<Edited>>,
}

impl Version {
    /// Returns another number than before if another scene is watched or the user changed something
    /// in it; the same number if no scene is watched.
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
