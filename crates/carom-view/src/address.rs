//! Reports links to the present view to the host.

use std::sync::Arc;

use carom_scene::scene::Scene;
use carom_session::{Link, LinkCamera, LinkSource, PastChange, View};
use egui::Context;

use crate::host::Host;

/// Shortest time between two links for the host \[s\].
const INTERVAL: f64 = 1.0;

/// A link to a running scene file longer than this is not reported \[byte\]: no address bar takes
/// it.
const LARGEST_FILE: usize = 100_000;

/// The link that the host has.
#[derive(Default)]
pub struct Address {
    told: Option<Moment>,
    /// When the host got it, by the clock of the interface \[s\].
    told_at: f64,
}

/// Everything that a link depends on.
#[derive(Debug, Clone)]
pub struct Moment {
    scene: Arc<Scene>,
    frame: u64,
    changes: Arc<Vec<PastChange>>,
    /// Scene and changes of the second of two runs.
    beside: Option<(Arc<Scene>, Arc<Vec<PastChange>>)>,
    camera: Option<LinkCamera>,
}

impl Moment {
    /// Returns the moment that a view shows, with the camera of the link `base`.
    pub fn of(view: &View, base: &Link) -> Self {
        let (scene, changes) = (view.scene.clone(), view.changes.clone());
        let beside = view.other.as_ref().map(|it| (it.scene.clone(), it.changes.clone()));
        Self { scene, frame: view.frame, changes, beside, camera: base.camera() }
    }

    /// Returns whether both moments have the same link.
    pub fn is_same(&self, other: &Self) -> bool {
        let is_same_beside = match (&self.beside, &other.beside) {
            (Some(one), Some(two)) => Arc::ptr_eq(&one.0, &two.0) && Arc::ptr_eq(&one.1, &two.1),
            (one, two) => one.is_none() && two.is_none(),
        };
        Arc::ptr_eq(&self.scene, &other.scene)
            && self.frame == other.frame
            && self.camera == other.camera
            && Arc::ptr_eq(&self.changes, &other.changes)
            && is_same_beside
    }
}

impl Address {
    /// Reports a link to the present view to the host, if the view has changed and the last report
    /// is not too recent.
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
