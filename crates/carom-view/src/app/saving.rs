//! Saves pictures, films and scenes.

use super::{App, Screen};
use crate::exports::Outlet;
use crate::naming::stamp_text;
use crate::plots::{self, Wanted};
use crate::snapshot::Snapshot;

/// Smallest size of a saved picture \[pixels\].
const SMALLEST_PICTURE: [u32; 2] = [1280, 720];

impl App {
    fn snapshot(&mut self, size: [u32; 2]) -> Option<Snapshot> {
        let manner = self.manner();
        let drawn = match &mut self.screen {
            Screen::Watching(watching) => watching.snapshot(&mut self.studio, manner, size),
            screen => screen.game_mut()?.snapshot(&mut self.studio, size),
        };
        drawn.map_err(|error| self.notices.complain(error)).ok()
    }

    /// Saves a picture with the simulation time written on it, at least as large as the window.
    pub(super) fn screenshot(&mut self) {
        let Some((name, time)) = self.shown() else { return };
        let window = self.context.content_rect().size() * self.context.pixels_per_point();
        let [width, height] = SMALLEST_PICTURE;
        let size = [width.max(window.x as u32), height.max(window.y as u32)];
        if let Some(snapshot) = self.snapshot(size) {
            self.exports.save_picture(snapshot, &name, time);
        }
    }

    /// Saves the present state as a scene file.
    pub(super) fn save(&mut self) {
        let Screen::Watching(watching) = &self.screen else {
            self.notices.complain("a game cannot be saved as a scene");
            return;
        };
        let view = watching.view();
        let mut outlet = Outlet { host: &mut *self.host, notices: &mut self.notices };
        outlet.save_scene(&view.scene_now(), view.time);
    }

    /// Saves the numbers of a plot, or a picture of the plots.
    pub(super) fn save_plots(&mut self, wanted: Wanted) {
        let Some((scene, time)) = self.shown() else { return };
        match wanted {
            Wanted::Table { name, csv } => {
                let mut outlet = Outlet { host: &mut *self.host, notices: &mut self.notices };
                outlet.save_table(&scene, time, &name, &csv);
            }
            Wanted::Picture(figures) => {
                let heading = stamp_text(&scene, time);
                let page = plots::print(&figures, &heading, &self.context, &self.studio);
                self.exports.save_plots(Snapshot { parts: vec![page] }, &scene, time);
            }
        }
    }

    /// Starts a film, or ends the present one.
    pub(super) fn record(&mut self) {
        if self.exports.is_recording() {
            self.exports.end_film();
            return;
        }
        let Some((name, _)) = self.shown() else { return };
        let time = self.film_clock();
        let mut outlet = Outlet { host: &mut *self.host, notices: &mut self.notices };
        self.exports.begin_film(&name, time, &mut outlet);
    }

    /// Returns the time that films follow \[s\].
    fn film_clock(&self) -> f64 {
        match &self.screen {
            Screen::Watching(watching) => watching.view().time,
            screen => screen.game().map_or(0.0, |game| game.view().clock),
        }
    }

    /// Adds the due frames to the film, and saves pictures that are complete.
    pub(super) fn export(&mut self) {
        if let Some((size, frames)) = self.exports.film_due(self.film_clock())
            && let Some(snapshot) = self.snapshot(size)
        {
            self.exports.add_to_film(snapshot, frames);
        }
        let mut outlet = Outlet { host: &mut *self.host, notices: &mut self.notices };
        if self.exports.collect(&self.studio, &mut outlet) {
            self.context.request_repaint();
        }
    }
}
