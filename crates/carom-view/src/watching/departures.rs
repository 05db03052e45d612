//! Since when balls have left the scene.

use std::sync::Arc;

use carom_render::{Bounds, Framing};
use carom_scene::Scene;
use carom_session::View;

/// How far outside what a camera is fitted to a ball has left, in radii of that.
const FAR: f64 = 3.0;

/// Since when balls have left a scene.
#[derive(Debug, Default)]
pub(super) struct Departures {
    scene: Option<Arc<Scene>>,
    since: Option<f64>,
}

impl Departures {
    /// The earliest time at which a ball was seen to have left \[s\]; `None` while none has.
    pub fn since(&self) -> Option<f64> {
        self.since
    }

    /// Looks at the balls of a view of a scene that is framed so.
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
