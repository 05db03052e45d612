//! The dialog that chooses a scene.

use std::path::{Path, PathBuf};

use carom_render::{Camera, Drawing, Framing};
use carom_scene::scene::Scene;
use carom_scene::{Entry, Library, Source};
use carom_session::{Session, View};
use egui::{
    Align, Align2, Context, Id, Image, Key, Label, Layout, Modal, Modifiers, RichText, Sense,
    TextEdit, Ui, Vec2,
};

use crate::layout::{is_for_fingers, is_touched, scrolled_within};
use crate::look::{self, DrawOptions, Marks};
use crate::orbit::{Orbit, Preset};
use crate::studio::{Canvas, Studio};

/// The dialog; it reads all scenes whenever it opens.
#[derive(Default)]
pub struct Chooser {
    open: bool,
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
        matches!(self.thumbnail, Thumbnail::Drawn(_)) && own.is_some() && own == others
    }
}

enum Thumbnail {
    Missing,
    Drawn(Box<Canvas>),
    /// The scene cannot be read.
    Impossible,
}

/// Size of a thumbnail in points.
const THUMBNAIL: Vec2 = Vec2::new(176.0, 99.0);

/// A thumbnail shows the scene at this part of its duration, but at most `LATEST` \[s\] after the
/// start, ...
const THUMBNAIL_PART: f64 = 0.25;
const LATEST: f64 = 3.0;
/// ... and at the start if more than this many frames times spheres would be needed.
const MOST_WORK: f64 = 40_000.0;

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
        self.open = true;
        self.just_opened = true;
        self.filter.clear();
        self.selected = 0;
        self.trouble = None;
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

    /// Closes the dialog without a choice.
    pub fn close(&mut self) {
        self.open = false;
    }

    /// Shows the open dialog. Returns the choice, which closes the dialog.
    pub fn show(&mut self, context: &Context, studio: &mut Studio) -> Option<Chosen> {
        if !self.open {
            return None;
        }
        self.draw_a_thumbnail(context, studio);
        let found = self.found();
        let entered = self.keys(context, &found);
        let (mut chosen, mut file) = (entered.flatten(), None);
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
                    if self.card(ui, index, place == self.selected) {
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

    /// Shows a scene; returns whether it was clicked.
    fn card(&mut self, ui: &mut Ui, index: usize, is_selected: bool) -> bool {
        let card = &self.cards[index];
        let fill = if is_selected {
            ui.visuals().selection.bg_fill.gamma_multiply(0.45)
        } else {
            ui.visuals().faint_bg_color
        };
        let frame = egui::Frame::group(ui.style()).fill(fill);
        let shown = frame.show(ui, |ui| {
            ui.horizontal(|ui| {
                picture(ui, &card.thumbnail);
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
        response.clicked()
    }

    /// Closes the dialog with the choice of this scene. A scene that cannot be read cannot be
    /// chosen.
    fn choose(&mut self, index: usize) -> Option<Chosen> {
        let entry = &self.cards.get(index)?.entry;
        let scene = entry.scene.as_ref().ok()?.clone();
        self.open = false;
        Some(Chosen::Scene(Box::new(scene), entry.source.clone()))
    }

    /// Draws one of the missing thumbnails: one per frame, so that the dialog opens at once.
    fn draw_a_thumbnail(&mut self, context: &Context, studio: &mut Studio) {
        let missing =
            self.cards.iter_mut().find(|card| matches!(card.thumbnail, Thumbnail::Missing));
        let Some(card) = missing else { return };
        let scene = card.entry.scene.as_ref().ok();
        let drawn = scene.and_then(drawing_of);
        card.thumbnail = match drawn {
            Some((drawing, camera)) => {
                let mut canvas = Canvas::default();
                let size = THUMBNAIL * context.pixels_per_point();
                studio.draw(&mut canvas, size, &drawing, &camera);
                Thumbnail::Drawn(Box::new(canvas))
            }
            None => Thumbnail::Impossible,
        };
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

fn picture(ui: &mut Ui, thumbnail: &Thumbnail) {
    match thumbnail {
        Thumbnail::Drawn(canvas) if canvas.texture().is_some() => {
            if let Some(texture) = canvas.texture() {
                ui.add(Image::new((texture, THUMBNAIL)).corner_radius(4));
            }
        }
        _ => {
            ui.allocate_space(THUMBNAIL);
        }
    }
}

fn about(ui: &mut Ui, scene: &Scene, source: &Source) {
    let title = if scene.title.is_empty() { &scene.name } else { &scene.title };
    // Lines of text need no space for fingers.
    ui.spacing_mut().interact_size.y = 0.0;
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(title).strong().size(15.0));
        if *title != scene.name {
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

/// Draws a scene a little after its start, with its own camera.
fn drawing_of(scene: &Scene) -> Option<(Drawing, Camera)> {
    let mut session = Session::new(scene.clone()).ok()?;
    let time = (THUMBNAIL_PART * scene.simulation.duration).min(LATEST);
    let frames = (time / scene.simulation.frame_time).floor();
    if frames * session.world().spheres().len().max(1) as f64 <= MOST_WORK {
        // If a step fails, the state before it is drawn.
        (0..frames as u64).try_for_each(|_| session.step()).ok();
    }
    let mut view = View::default();
    session.fill(&mut view);
    let mut drawing = Drawing::default();
    let look = DrawOptions { marks: Marks::default(), dark: false, blend: 1.0 };
    look::draw(&view, &look, &mut drawing);
    let framing = Framing::of_run(Framing::of_scene(scene), &drawing);
    drawing.framing = Some(framing);
    let aspect = f64::from(THUMBNAIL.x / THUMBNAIL.y);
    let orbit = Orbit::preset(Preset::Scene, Camera::of_scene(scene), &framing.whole, aspect);
    Some((drawing, orbit.camera))
}
