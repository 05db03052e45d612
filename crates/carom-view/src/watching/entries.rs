//! Entries of the menus about a watched scene.

use super::Watching;
use crate::action::Action;
use crate::look::Marks;
use crate::menu::Entry;
use crate::saved::Panels;

/// The cameras of every screen.
pub const PRESETS: [Entry; 3] = [
    Entry::once("Scene's camera", Action::SceneCamera),
    Entry::once("Front", Action::FrontCamera),
    Entry::once("Top", Action::TopCamera),
];

impl Watching {
    /// Returns whether the inspector is open.
    pub fn shows_inspector(&self) -> bool {
        self.open_panels().inspector
    }

    pub(super) fn open_panels(&self) -> Panels {
        if self.has_sheets { self.sheet } else { self.layout.panels }
    }

    /// Returns the entries for the camera.
    pub fn cameras(&self) -> Vec<Entry> {
        let mut entries = PRESETS.to_vec();
        entries.extend([
            Entry::switch("Fit all", Action::Fit, self.viewpoint.fits()),
            Entry::switch("Follow the picked ball", Action::Follow, self.viewpoint.follows()),
            Entry::switch("Settings", Action::Inspector, self.shows_inspector()),
        ]);
        entries
    }

    /// Returns the entries for panels with measurements, marks and comparisons.
    pub fn measures(&self) -> Vec<Entry> {
        let Panels { plots, impacts, .. } = self.open_panels();
        let Marks { velocities, contacts, forces, .. } = self.layout.marks;
        vec![
            Entry::switch("Plots", Action::Plots, plots),
            Entry::switch("Impacts", Action::Impacts, impacts),
            Entry::switch("Velocities", Action::Velocities, velocities),
            Entry::switch("Contacts", Action::Contacts, contacts),
            Entry::switch("Contact forces", Action::Forces, forces),
            Entry::switch("Two rules", Action::Compare, self.view().other.is_some()),
            Entry::once("Nudge a ball", Action::Nudge),
        ]
    }
}
