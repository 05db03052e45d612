//! Totals of the events of square wells.

use carom::{WellEvent, WellEventKind};
use serde::Serialize;

/// Numbers of events at the edges of square wells.
#[derive(Debug, Clone, Copy, Default, Serialize)]
pub struct WellTotals {
    captures: u64,
    dissociations: u64,
    bounces: u64,
}

impl WellTotals {
    /// Adds the events of a frame.
    pub fn add(&mut self, events: &[WellEvent]) {
        for event in events {
            match event.kind {
                WellEventKind::Capture => self.captures += 1,
                WellEventKind::Dissociation => self.dissociations += 1,
                _ => self.bounces += 1,
            }
        }
    }

    /// Returns the totals as text.
    pub fn row(&self) -> String {
        let Self { captures, dissociations, bounces } = self;
        format!("{captures} captures, {dissociations} dissociations, {bounces} bounces")
    }
}
