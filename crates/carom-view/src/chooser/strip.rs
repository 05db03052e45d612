//! The scenes as a strip below the first picture, and the line over it.

use egui::{
    Area, Color32, Frame, Id, Label, Margin, Rect, Response, RichText, Role, ScrollArea, Sense, Ui,
    Vec2, WidgetInfo,
};

use super::{Chooser, Chosen, title_of};
use crate::layout::{is_low, is_narrow, is_touched};
use crate::studio::Studio;

/// Size of a picture in the strip, in points; in a low window the second.
const PICTURE: Vec2 = Vec2::new(144.0, 81.0);
const LOW_PICTURE: Vec2 = Vec2::new(96.0, 54.0);

/// Height of the title below a picture, in points.
const TITLE: f32 = 18.0;

/// What the user wants of the strip.
pub enum Asked {
    /// A scene of the strip.
    Chosen(Chosen),
    /// The dialog with all scenes.
    All,
}

impl Chooser {
    /// Shows the strip at the lower edge, if it is open. Returns what the user wants.
    pub fn show_strip(&mut self, ui: &mut Ui, studio: &mut Studio) -> Option<Asked> {
        if !self.is_strip {
            return None;
        }
        let size = if is_low(ui) { LOW_PICTURE } else { PICTURE };
        let (mut chosen, mut asked, mut pointed) = (None, None, None);
        let mut seen = Vec::new();
        self.has_focus = false;
        let margin = Margin::symmetric(8, 6);
        let frame = Frame::side_top_panel(ui.style()).inner_margin(margin);
        egui::Panel::bottom("strip").resizable(false).frame(frame).show(ui, |ui| {
            ui.horizontal(|ui| {
                let buttons = buttons_width(ui);
                let width = ui.available_width() - buttons;
                ui.style_mut().always_scroll_the_only_direction = true;
                let list = ScrollArea::horizontal().max_width(width).auto_shrink(false);
                let height = size.y + TITLE + 14.0;
                list.id_salt("strip").min_scrolled_height(height).max_height(height).show(
                    ui,
                    |ui| {
                        ui.horizontal(|ui| {
                            for index in 0..self.cards.len() {
                                let Some(response) = self.in_strip(ui, index, size) else {
                                    continue;
                                };
                                if ui.is_rect_visible(response.rect) {
                                    seen.push(index);
                                }
                                self.has_focus |= response.has_focus();
                                if response.hovered() || response.has_focus() {
                                    pointed = Some(index);
                                }
                                if response.clicked() {
                                    chosen = Some(index);
                                }
                            }
                        });
                    },
                );
                ui.vertical(|ui| {
                    let all = ui.button("All scenes").on_hover_text("With a search, and files");
                    if all.clicked() {
                        asked = Some(Asked::All);
                    }
                    let close = ui.button("✖  Close").on_hover_text("Close the list (Esc)");
                    close.widget_info(|| {
                        WidgetInfo::labeled(Role::Button, true, "Close the list of scenes")
                    });
                    if close.clicked() {
                        self.is_strip = false;
                    }
                });
            });
        });
        if !self.open {
            self.draw_missing(ui.ctx(), studio, &seen);
            self.run_pointed(ui.ctx(), studio, pointed);
        }
        asked.or_else(|| self.choose(chosen?).map(Asked::Chosen))
    }

    /// Shows a scene of the strip; `None` if it cannot be read.
    fn in_strip(&self, ui: &mut Ui, index: usize, size: Vec2) -> Option<Response> {
        let card = &self.cards[index];
        let title = title_of(card.entry.scene.as_ref().ok()?);
        let column = ui.vertical(|ui| {
            ui.set_width(size.x);
            ui.spacing_mut().item_spacing.y = 2.0;
            let response = card.thumbnail.show(ui, size, Sense::click());
            let text = Label::new(RichText::new(title).small()).truncate().selectable(false);
            ui.add_sized([size.x, TITLE], text);
            response
        });
        let response = column.inner;
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, title));
        if response.gained_focus() {
            response.scroll_to_me(None);
        }
        if response.hovered() || response.has_focus() {
            let stroke = ui.visuals().selection.stroke;
            let stroke = egui::Stroke::new(2.0, stroke.color);
            ui.painter().rect_stroke(response.rect, 4, stroke, egui::StrokeKind::Outside);
        }
        Some(response)
    }
}

/// Returns the width of the widest button at the end of the strip, in points.
fn buttons_width(ui: &Ui) -> f32 {
    let padding = 2.0 * ui.spacing().button_padding.x;
    if is_narrow(ui) { 66.0 + padding } else { 78.0 + padding }
}

/// Shows over a picture what can be done with it.
pub fn invite(ui: &Ui, picture: Rect) {
    let text = if is_touched(ui) {
        "Drag to look. Tap a ball."
    } else {
        "Drag to look. Click a ball. Ctrl-click throws one."
    };
    let place = picture.center_top() + Vec2::new(0.0, 14.0);
    // The pointer reaches the picture through it.
    let area = Area::new(Id::unique("invitation")).pivot(egui::Align2::CENTER_TOP);
    area.fixed_pos(place).interactable(false).show(ui.ctx(), |ui| {
        let fill = Color32::from_rgba_unmultiplied(20, 24, 32, 215);
        let frame = Frame::NONE.fill(fill).corner_radius(16).inner_margin(Margin::symmetric(16, 7));
        frame.show(ui, |ui| {
            let text = RichText::new(text).size(15.0).color(Color32::WHITE);
            ui.add(Label::new(text).extend().selectable(false));
        });
    });
}
