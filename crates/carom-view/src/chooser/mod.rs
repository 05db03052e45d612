//! The choice of a scene: a strip of pictures at the first visit, and a dialog.

mod strip;
mod thumbnail;

use std::path::{Path, PathBuf};

use carom_scene::scene::Scene;
use carom_scene::{Entry, Library, Source};
use egui::{
    Align, Align2, Context, Id, Key, Label, Layout, Modal, Modifiers, Response, RichText, Sense,
    TextEdit, Ui,
};

use crate::layout::{is_for_fingers, is_touched, scrolled_within};
use crate::studio::{Canvas, Studio};
pub use strip::{Asked, invite};
use thumbnail::{Running, THUMBNAIL, Thumbnail, is_dark};

/// The strip and the dialog; they read all scenes whenever one of them opens.
#[derive(Default)]
pub struct Chooser {
    open: bool,
    is_strip: bool,
    /// Whether a scene of the strip has the keyboard.
    has_focus: bool,
    /// The scene that runs in the card with this index, under the pointer.
    running: Option<(usize, Box<Running>)>,
    /// The scene that goes to the time of its thumbnail.
    prepared: Option<(usize, Box<Running>)>,
    just_opened: bool,
    /// Whether an arrow key was pressed in this frame.
    moved: bool,
    filter: String,
    selected: usize,
    /// An error from before the dialog opened.
    trouble: Option<String>,
    cards: Vec<Card>,
}

/// The choice of the user.
pub enum Chosen {
    /// A scene of the list.
    Scene(Box<Scene>, Source),
    /// A file whose path was typed.
    File(PathBuf),
    /// A file to be chosen in a file dialog.
    AnyFile,
}

/// A scene in the list.
struct Card {
    entry: Entry,
    /// Whether the card is among the recently opened files.
    is_recent: bool,
    thumbnail: Thumbnail,
}

impl Card {
    /// Returns whether this card has a thumbnail of the same scene as `other`.
    fn shows_same(&self, other: &Self) -> bool {
        let [own, others] = [self, other].map(|card| card.entry.scene.as_ref().ok());
        matches!(self.thumbnail, Thumbnail::Drawn { .. }) && own.is_some() && own == others
    }
}

impl Chooser {
    /// Opens the dialog with all present scenes, recent files first. Thumbnails of unchanged scenes
    /// are kept.
    ///
    /// # Errors
    /// If a folder of scenes can no longer be read; the list is then unchanged.
    pub fn open(
        &mut self,
        library: &Library,
        recent: &[PathBuf],
    ) -> Result<(), carom_scene::SceneError> {
        self.read(library, recent)?;
        self.open = true;
        self.just_opened = true;
        self.filter.clear();
        self.selected = 0;
        self.trouble = None;
        Ok(())
    }

    /// Opens the strip with all present scenes.
    ///
    /// # Errors
    /// If a folder of scenes can no longer be read; the strip then stays closed.
    pub fn open_strip(
        &mut self,
        library: &Library,
        recent: &[PathBuf],
    ) -> Result<(), carom_scene::SceneError> {
        self.read(library, recent)?;
        self.is_strip = true;
        Ok(())
    }

    /// Returns whether the strip is open.
    pub fn is_strip(&self) -> bool {
        self.is_strip
    }

    /// Returns whether a scene of the strip has the keyboard.
    pub fn has_focus(&self) -> bool {
        self.is_strip && self.has_focus
    }

    /// Reads all scenes; keeps the thumbnails of unchanged ones.
    fn read(
        &mut self,
        library: &Library,
        recent: &[PathBuf],
    ) -> Result<(), carom_scene::SceneError> {
        let card = |entry: Entry, is_recent| {
            let thumbnail =
                if entry.scene.is_ok() { Thumbnail::Missing } else { Thumbnail::Impossible };
            Card { entry, is_recent, thumbnail }
        };
        let of_file = |path: &PathBuf| {
            let scene = Scene::from_file(path, &[]);
            let name = scene.as_ref().map(|it| it.name.clone());
            let name = name.unwrap_or_else(|_| path.display().to_string());
            card(Entry { name, scene, source: Source::File(path.clone()) }, true)
        };
        let files = recent.iter().filter(|path| path.is_file()).map(of_file);
        let is_recent = |entry: &Entry| match &entry.source {
            Source::File(path) => {
                let path = std::path::absolute(path).unwrap_or_else(|_| path.clone());
                recent.contains(&path)
            }
            _ => false,
        };
        let all = library.entries()?.into_iter().filter(|entry| !is_recent(entry));
        let all = all.map(|entry| card(entry, false));
        let mut before = std::mem::take(&mut self.cards);
        let with_thumbnail = |mut card: Card| {
            if let Some(old) = before.iter_mut().find(|old| old.shows_same(&card)) {
                card.thumbnail = std::mem::replace(&mut old.thumbnail, Thumbnail::Missing);
            }
            card
        };
        self.cards = files.chain(all).map(with_thumbnail).collect();
        (self.running, self.prepared) = (None, None);
        Ok(())
    }

    /// Shows an error from before the dialog opened.
    pub fn complain(&mut self, why: &str) {
        self.trouble = Some(why.to_owned());
    }

    /// Returns whether the dialog is open.
    pub fn is_open(&self) -> bool {
        self.open
    }

    /// Closes the dialog without a choice; without a dialog, the strip.
    pub fn close(&mut self) {
        self.is_strip &= self.open;
        self.open = false;
        (self.running, self.prepared) = (None, None);
    }

    /// Closes dialog and strip.
    pub fn close_all(&mut self) {
        (self.open, self.is_strip) = (false, false);
        (self.running, self.prepared) = (None, None);
    }

    /// Shows the open dialog. Returns the choice, which closes the dialog.
    pub fn show(&mut self, context: &Context, studio: &mut Studio) -> Option<Chosen> {
        if !self.open {
            return None;
        }
        let found = self.found();
        let entered = self.keys(context, &found);
        let (mut chosen, mut file) = (entered.flatten(), None);
        let (mut pointed, mut seen) = (None, Vec::new());
        let modal = Modal::new(Id::unique("scenes")).show(context, |ui| {
            let size = ui.ctx().content_rect().size();
            ui.set_width((size.x - 40.0).clamp(240.0, 880.0));
            file = self.head(ui);
            if let Some(why) = &self.trouble {
                ui.colored_label(ui.visuals().error_fg_color, why);
            }
            ui.separator();
            let height = (size.y - 160.0).clamp(120.0, 620.0);
            // The list has its full height whatever the filter leaves, so that nothing moves under
            // the pointer.
            scrolled_within(height).auto_shrink(false).show(ui, |ui| {
                let typed = Path::new(self.filter.trim());
                if found.is_empty() && typed.is_file() {
                    let button = ui.button(format!("Open {}", typed.display()));
                    if button.clicked() || entered.is_some() {
                        file = Some(Chosen::File(typed.to_owned()));
                    }
                } else if found.is_empty() {
                    ui.weak("No scene has this in its name or description.");
                }
                let mut group = String::new();
                for (place, &index) in found.iter().enumerate() {
                    let next = group_of(&self.cards[index]);
                    if next != group {
                        ui.add_space(6.0);
                        ui.strong(&next);
                        group = next;
                    }
                    let response = self.card(ui, index, place == self.selected);
                    if ui.is_rect_visible(response.rect) {
                        seen.push(index);
                    }
                    if response.contains_pointer() {
                        pointed = Some(index);
                    }
                    if response.clicked() {
                        chosen = Some(index);
                    }
                }
            });
            ui.separator();
            ui.weak(if is_for_fingers(ui.ctx()) {
                "Tap the one to watch."
            } else {
                "Arrow keys and Enter, or a click. Or drop a scene file on the window."
            });
        });
        self.just_opened = false;
        self.draw_missing(context, studio, &seen);
        self.run_pointed(context, studio, pointed);
        if modal.should_close() {
            self.open = false;
        }
        if file.is_some() {
            self.open = false;
        }
        file.or_else(|| self.choose(chosen?))
    }

    /// Shows the heading with the filter and a button for other files. Returns [`Chosen::AnyFile`]
    /// if that button was pressed.
    fn head(&mut self, ui: &mut Ui) -> Option<Chosen> {
        let mut file = None;
        ui.horizontal(|ui| {
            ui.heading("Choose a scene");
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let open = ui.button("Open a file...");
                if open.on_hover_text("A scene (TOML) or a maze (text)").clicked() {
                    file = Some(Chosen::AnyFile);
                }
                let edit = TextEdit::singleline(&mut self.filter)
                    .hint_text("type to filter")
                    .align(Align2::LEFT_CENTER);
                let width = ui.available_width().min(220.0);
                let response = ui.add(edit.desired_width(width));
                // On a touch screen a keyboard would cover the list.
                if self.just_opened && !is_touched(ui) {
                    response.request_focus();
                }
                if response.changed() {
                    self.selected = 0;
                }
            });
        });
        file
    }

    /// Returns the indices of the cards that match the filter.
    fn found(&self) -> Vec<usize> {
        let wanted = self.filter.to_lowercase();
        let words: Vec<&str> = wanted.split_whitespace().collect();
        let is_found = |card: &Card| {
            let text = match &card.entry.scene {
                Ok(scene) => format!("{} {} {}", scene.name, scene.title, scene.description),
                Err(error) => format!("{} {error}", card.entry.name),
            };
            let text = text.to_lowercase();
            words.iter().all(|word| text.contains(word))
        };
        (0..self.cards.len()).filter(|&index| is_found(&self.cards[index])).collect()
    }

    /// Handles the arrow keys and Enter, also while a text is typed. If Enter was pressed, returns
    /// the selected card.
    fn keys(&mut self, context: &Context, found: &[usize]) -> Option<Option<usize>> {
        let mut entered = None;
        context.input_mut(|input| {
            let down = input.consume_key(Modifiers::NONE, Key::ArrowDown);
            let up = input.consume_key(Modifiers::NONE, Key::ArrowUp);
            self.moved = down || up;
            if down {
                self.selected += 1;
            }
            if up {
                self.selected = self.selected.saturating_sub(1);
            }
            self.selected = self.selected.min(found.len().saturating_sub(1));
            if !self.just_opened && input.consume_key(Modifiers::NONE, Key::Enter) {
                entered = Some(found.get(self.selected).copied());
            }
        });
        entered
    }

    /// Shows a scene in the dialog.
    fn card(&self, ui: &mut Ui, index: usize, is_selected: bool) -> Response {
        let card = &self.cards[index];
        let fill = if is_selected {
            ui.visuals().selection.bg_fill.gamma_multiply(0.45)
        } else {
            ui.visuals().faint_bg_color
        };
        let frame = egui::Frame::group(ui.style()).fill(fill);
        let shown = frame.show(ui, |ui| {
            ui.horizontal(|ui| {
                card.thumbnail.show(ui, THUMBNAIL, Sense::hover());
                ui.vertical(|ui| {
                    ui.set_width(ui.available_width());
                    ui.add_space(4.0);
                    match &card.entry.scene {
                        Ok(scene) => about(ui, scene, &card.entry.source),
                        Err(error) => {
                            ui.strong(&card.entry.name);
                            ui.colored_label(ui.visuals().error_fg_color, error.to_string());
                        }
                    }
                });
            });
        });
        let response = shown.response.interact(Sense::click());
        let name = &card.entry.name;
        response.widget_info(|| {
            egui::WidgetInfo::selected(egui::Role::Button, true, is_selected, name)
        });
        if is_selected && (self.just_opened || self.moved) {
            response.scroll_to_me(None);
        }
        response
    }

    /// Closes the dialog with the choice of this scene. A scene that cannot be read cannot be
    /// chosen.
    fn choose(&mut self, index: usize) -> Option<Chosen> {
        let entry = &self.cards.get(index)?.entry;
        let scene = entry.scene.as_ref().ok()?.clone();
        self.open = false;
        Some(Chosen::Scene(Box::new(scene), entry.source.clone()))
    }

    /// Works on the first thumbnail of the cards that are `seen` that is missing in the present theme,
    /// a little in each frame, so that the interface goes on.
    fn draw_missing(&mut self, context: &Context, studio: &mut Studio, seen: &[usize]) {
        let dark = is_dark(context);
        let is_missing = |it: &usize| self.cards[*it].thumbnail.is_wanted(dark);
        let Some(index) = seen.iter().copied().find(is_missing) else { return };
        context.request_repaint();
        let before = self.prepared.take().filter(|it| it.0 == index);
        let Card { entry, thumbnail, .. } = &mut self.cards[index];
        let running = match before {
            Some((_, running)) => Some(running),
            None => entry.scene.as_ref().ok().and_then(Running::new).map(Box::new),
        };
        let Some(mut running) = running else {
            *thumbnail = Thumbnail::Impossible;
            return;
        };
        if !running.prepare() {
            self.prepared = Some((index, running));
            return;
        }
        let mut canvas = Canvas::default();
        running.draw(studio, &mut canvas, context);
        *thumbnail = Thumbnail::Drawn { canvas: Box::new(canvas), dark };
    }

    /// Runs the scene of the card under the pointer in its thumbnail, and no other.
    fn run_pointed(&mut self, context: &Context, studio: &mut Studio, pointed: Option<usize>) {
        if self.running.as_ref().map(|it| it.0) != pointed {
            let scene = pointed.and_then(|index| self.cards[index].entry.scene.as_ref().ok());
            let running = scene.and_then(Running::new).map(Box::new);
            self.running = pointed.zip(running);
        }
        let Some((index, running)) = &mut self.running else { return };
        let Thumbnail::Drawn { canvas, .. } = &mut self.cards[*index].thumbnail else { return };
        running.advance(context.input(|input| f64::from(input.stable_dt)));
        running.draw(studio, canvas, context);
        context.request_repaint();
    }
}

/// Returns the heading under which a scene is listed: its origin if it is built in.
fn group_of(card: &Card) -> String {
    if card.is_recent {
        return "Recent".to_owned();
    }
    let entry = &card.entry;
    let origin = entry.scene.as_ref().map_or("", |scene| &scene.origin);
    match (&entry.source, origin.split(',').next()) {
        (Source::BuiltIn, Some(origin)) if !origin.is_empty() => origin.to_owned(),
        _ => "Your scenes".to_owned(),
    }
}

/// Returns the title of a scene, or its name if it has none.
fn title_of(scene: &Scene) -> &str {
    if scene.title.is_empty() { &scene.name } else { &scene.title }
}

fn about(ui: &mut Ui, scene: &Scene, source: &Source) {
    let title = title_of(scene);
    // Lines of text need no space for fingers.
    ui.spacing_mut().interact_size.y = 0.0;
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(title).strong().size(15.0));
        if title != scene.name {
            ui.weak(&scene.name);
        }
        let rule = RichText::new(format!(" {} ", scene.simulation.rule));
        let background = ui.visuals().widgets.inactive.bg_fill;
        let rule = Label::new(rule.monospace().size(11.0).background_color(background));
        ui.add(rule.extend()).on_hover_text("the rule by which it is stepped");
    });
    ui.label(&scene.description);
    if let Source::File(path) = source {
        ui.weak(path.display().to_string());
    }
}
