//! Links to what is shown, for the host.

use std::sync::Arc;

use carom_scene::scene::Scene;
use carom_session::{Link, LinkCamera, LinkSource, PastChange, View};
use egui::Context;

use crate::host::Host;

/// Least time between two links that the host gets \[s\].
const INTERVAL: f64 = 1.0;

/// The host gets no link to a scene file of more bytes as it goes on: no address bar takes it.
const LARGEST_FILE: usize = 100_000;

/// Which link is shown.
#[derive(Default)]
pub struct Address {
    told: Option<Moment>,
    /// When the host got it, by the clock of the interface \[s\].
    told_at: f64,
}

/// All that a link depends on.
#[derive(Debug, Clone)]
pub struct Moment {
    scene: Arc<Scene>,
    frame: u64,
    changes: Arc<Vec<PastChange>>,
    camera: Option<LinkCamera>,
}

impl Moment {
    /// The moment that a view shows, seen from where a link to its scene says.
    pub fn of(view: &View, base: &Link) -> Self {
        let (scene, changes) = (view.scene.clone(), view.changes.clone());
        Self { scene, frame: view.frame, changes, camera: base.camera() }
    }

    /// Whether a link to this is a link to the other, too.
    pub fn is_same(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.scene, &other.scene)
            && self.frame == other.frame
            && self.camera == other.camera
            && Arc::ptr_eq(&self.changes, &other.changes)
    }
}

impl Address {
    /// Gives the host a link to what is shown, if it has changed and the last is not of just now.
    pub fn tell(&mut self, view: &View, base: &Link, host: &mut dyn Host, context: &Context) {
        let is_large =
            matches!(base.source(), LinkSource::File { text, .. } if text.len() > LARGEST_FILE);
        if !host.shows_links() || is_large || view.seeking.is_some() {
            return;
        }
        let moment = Moment::of(view, base);
        if self.told.as_ref().is_some_and(|told| told.is_same(&moment)) {
            return;
        }
        let now = context.input(|input| input.time);
        let is_another_scene =
            self.told.as_ref().is_none_or(|told| !Arc::ptr_eq(&told.scene, &moment.scene));
        if !is_another_scene && now - self.told_at < INTERVAL {
            context.request_repaint_after_secs(INTERVAL as f32);
            return;
        }
        host.show_link(&base.at(view));
        self.told = Some(moment);
        self.told_at = now;
    }
}
