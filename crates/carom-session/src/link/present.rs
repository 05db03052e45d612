//! Links to the present of a session or view.

use std::sync::Arc;

use carom_scene::scene::Scene;

use super::run::{Beside, Link};
use super::time::readable;
use crate::change::PastChange;
use crate::session::Session;
use crate::view::View;

impl Link {
    /// Extends the link to the present frame of a view of the same scene, with its changes, and with
    /// the second of two runs side by side.
    pub fn at(&self, view: &View) -> Self {
        let link = self.come_to((view.frame, view.time), &view.scene, &view.changes);
        let beside = view.other.as_ref().map(|other| Beside {
            rule: other.scene.simulation.rule,
            changes: until(view.frame, &other.changes),
        });
        Self { beside, ..link }
    }

    /// Extends the link to a frame and its time \[s\], with the changes up to the frame.
    fn come_to(&self, now: (u64, f64), scene: &Scene, changes: &Arc<Vec<PastChange>>) -> Self {
        let (frame, time) = now;
        let changes = until(frame, changes);
        let time = Some(readable(time, shortest_frame(scene, &changes)));
        Self { changes, time, ..self.clone() }
    }
}

impl View {
    /// Link to the present of the view. If the scene was opened from a link, [`Link::at`] of that
    /// link is shorter.
    pub fn link(&self) -> Link {
        Link::to_scene(&self.scene).at(self)
    }
}

impl Session {
    /// Link to the present.
    pub fn link(&self) -> Link {
        let now = (self.frame(), self.time());
        Link::to_scene(self.scene()).come_to(now, self.scene(), self.changes())
    }
}

/// Returns the changes up to a frame.
fn until(frame: u64, changes: &Arc<Vec<PastChange>>) -> Arc<Vec<PastChange>> {
    let made = changes.partition_point(|it| it.frame <= frame);
    if made == changes.len() { changes.clone() } else { changes[..made].to_vec().into() }
}

/// Length of the shortest frame of a run \[s\].
fn shortest_frame(scene: &Scene, changes: &[PastChange]) -> f64 {
    let later = changes.iter().filter_map(|it| it.change.frame_time());
    later.fold(scene.simulation.frame_time, f64::min)
}
