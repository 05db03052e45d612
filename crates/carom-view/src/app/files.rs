//! Opens dropped files, and reloads files that change on the disk.

use std::path::Path;

use carom_maze::Maze;
use carom_scene::{Source, text_of};
use egui::{Align2, Color32, FontId, Id, LayerId, Order, Stroke, StrokeKind};

use super::{App, Screen};
use crate::host::ReadFile;
use crate::written_scene::WrittenScene;

/// Kinds of files that can be opened.
const OPENS: &str = "a scene (TOML) or a maze (text)";

impl App {
    /// Opens files that were dropped on the window: scenes, or mazes drawn with characters.
    pub(super) fn open_dropped(&mut self) {
        for file in self.context.input(|input| input.raw.dropped_files.clone()) {
            self.host.read(&file, &self.inbox);
        }
        for ReadFile { path, content } in self.inbox.take() {
            match content {
                Ok(content) => match text_of(content) {
                    Ok(text) => self.open_text(&text, &path),
                    Err(error) => self.complain_of(&path, &format_args!("{error}; open {OPENS}")),
                },
                Err(error) => self.complain_of(&path, &error),
            }
        }
    }

    fn complain_of(&mut self, path: &Path, error: &dyn std::fmt::Display) {
        self.notices.complain(format!("cannot read {}: {error}", path.display()));
    }

    /// Shows the drop area while a file is held over the window.
    pub(super) fn drop_target(&self) {
        if self.context.input(|input| input.raw.hovered_files.is_empty()) {
            return;
        }
        let place = self.context.content_rect().shrink(12.0);
        let layer = LayerId::new(Order::Foreground, Id::unique("drop target"));
        let painter = self.context.layer_painter(layer);
        let stroke = Stroke::new(3.0, self.context.global_style().visuals.selection.stroke.color);
        painter.rect(place, 8, Color32::from_black_alpha(150), stroke, StrokeKind::Inside);
        let font = FontId::proportional(26.0);
        let text = format!("Drop it here: {OPENS}");
        painter.text(place.center(), Align2::CENTER_CENTER, text, font, Color32::WHITE);
    }

    /// Opens the text of a file.
    fn open_text(&mut self, text: &str, path: &Path) {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.extension().is_some_and(|ending| ending == "txt") {
            let name = name.trim_end_matches(".txt");
            match Maze::from_text(text, name) {
                Ok(maze) => self.play(maze),
                Err(error) => self.notices.complain(format!("{}: {error}", path.display())),
            }
            return;
        }
        // A web page has the text alone; a file on the disk may include other files.
        let written = if path.is_file() {
            WrittenScene::from_file(path, Vec::new())
        } else {
            WrittenScene::new(&name, text, Vec::new())
        };
        match written {
            Ok(written) => {
                self.open(written.scene().clone(), Source::File(path.to_owned()));
                if let Screen::Watching(watching) = &mut self.screen {
                    watching.set_written(written);
                }
            }
            Err(error) => self.notices.complain(error),
        }
    }

    /// Reloads the open scene file after a change on the disk.
    pub(super) fn reload_changed(&mut self) {
        let now = self.context.input(|input| input.time);
        let Screen::Watching(watching) = &mut self.screen else { return };
        if let Some(seconds) = self.host.seconds_to_look() {
            self.context.request_repaint_after_secs(seconds as f32);
        }
        let Some(path) = self.host.changed_file(now) else { return };
        match watching.read_anew(&path) {
            Ok(()) => {
                self.notices.clear();
                self.notices.tell(format!("{} was changed, and read anew", path.display()));
            }
            Err(error) => self.notices.complain(error),
        }
    }
}
