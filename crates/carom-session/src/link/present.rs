//! Links to what a session or an interface shows.

use std::sync::Arc;

use carom_scene::scene::Scene;

use super::run::Link;
use super::time::readable;
use crate::change::PastChange;
use crate::session::Session;
use crate::view::View;

impl Link {
    /// The same scene, come to where this view of it is, by the same changes.
    pub fn at(&self, view: &View) -> Self {
        self.come_to((view.frame, view.time), &view.scene, &view.changes)
    }

    /// The same `scene`, come to a frame at a time \[s\], by those of these changes that came before.
    fn come_to(&self, now: (u64, f64), scene: &Scene, changes: &Arc<Vec<PastChange>>) -> Self {
        let (frame, time) = now;
        let made = changes.partition_point(|it| it.frame <= frame);
        let changes =
            if made == changes.len() { changes.clone() } else { changes[..made].to_vec().into() };
        let time = Some(readable(time, shortest_frame(scene, &changes)));
        Self { changes, time, ..self.clone() }
    }
}

impl View {
    /// A link to what it shows. Where the scene was opened from a link, [`Link::at`] of that link
    /// is shorter.
    pub fn link(&self) -> Link {
        Link::to_scene(&self.scene).at(self)
    }
}

impl Session {
    /// A link to the present.
    pub fn link(&self) -> Link {
        let now = (self.frame(), self.time());
        Link::to_scene(self.scene()).come_to(now, self.scene(), self.changes())
    }
}

/// The shortest frame \[s\] of a run.
fn shortest_frame(scene: &Scene, changes: &[PastChange]) -> f64 {
    let later = changes.iter().filter_map(|it| it.change.frame_time());
    later.fold(scene.simulation.frame_time, f64::min)
}
