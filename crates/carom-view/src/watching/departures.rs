//! Detects when balls leave the scene.

use std::sync::Arc;

use carom_render::{Bounds, Framing};
use carom_scene::Scene;
use carom_session::View;

/// Distance from the framing of a scene beyond which a ball has left, in radii of that framing.
const FAR: f64 = 3.0;

/// The time at which balls first left a scene.
#[derive(Debug, Default)]
pub(super) struct Departures {
    scene: Option<Arc<Scene>>,
    since: Option<f64>,
}

impl Departures {
    /// Returns the earliest time at which a ball was seen outside \[s\]; `None` if none was.
    pub fn since(&self) -> Option<f64> {
        self.since
    }

    /// Checks the balls of a view against the framing of its scene.
    pub fn note(&mut self, view: &View, framing: Option<Framing>) {
        let is_same = self.scene.as_ref().is_some_and(|scene| Arc::ptr_eq(scene, &view.scene));
        if !is_same || self.since.is_some_and(|since| view.furthest < since) {
            *self = Self { scene: Some(view.scene.clone()), since: None };
        }
        let is_known = self.since.is_some_and(|since| since <= view.time);
        let Some(framing) = framing.filter(|_| !is_known) else { return };
        let whole = framing.whole.grown(FAR * framing.whole.radius());
        if view.spheres.positions.iter().any(|center| !whole.holds(&Bounds::at(*center))) {
            self.since = Some(view.time);
        }
    }
}
