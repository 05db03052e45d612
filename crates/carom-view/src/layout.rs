//! Layout for large and small windows.

use egui::{Align, Button, Context, Layout, Panel, Rect, ScrollArea, Ui, Vec2, Window};

/// Width below which a window counts as that of a telephone, in points.
const NARROW: f32 = 640.0;

/// Width below which panels are sheets over the picture, in points.
const SHEETS: f32 = 900.0;

/// Largest part of the picture that a sheet covers.
const SHEET: f32 = 0.4;

/// Returns whether the window is narrow. Then the transport takes three lines, and all menus of the
/// top bar are in one.
pub fn is_narrow(ui: &Ui) -> bool {
    ui.ctx().content_rect().width() < NARROW
}

/// Returns whether panels are sheets over the picture, one at a time.
pub fn has_sheets(ui: &Ui) -> bool {
    ui.ctx().content_rect().width() < SHEETS
}

/// Returns whether the window is both narrow and low, as where a page embeds it.
pub fn is_compact(ui: &Ui) -> bool {
    is_narrow(ui) && is_low(ui)
}

/// Returns whether the window is as low as that of a telephone held sideways.
pub fn is_low(ui: &Ui) -> bool {
    ui.ctx().content_rect().height() < LOW
}

/// Height below which a window counts as that of a telephone held sideways, in points.
const LOW: f32 = 480.0;

/// Returns whether all menus of the top bar are in one.
pub fn has_one_menu(ui: &Ui) -> bool {
    is_narrow(ui)
}

/// Makes a scrolling list that has this height in points at once; otherwise it would grow from
/// frame to frame in a window of its own.
pub fn scrolled_within(height: f32) -> ScrollArea {
    ScrollArea::vertical().max_height(height).min_scrolled_height(height)
}

/// Smallest edge of a target for fingers, in points (Web Content Accessibility Guidelines 2.2,
/// 2.5.5).
const FINGER: f32 = 44.0;

/// Makes all controls large enough for fingers.
pub fn suit_fingers(context: &Context) {
    context.all_styles_mut(|style| {
        let spacing = &mut style.spacing;
        spacing.interact_size = Vec2::splat(FINGER);
        // Space around a symbol of fifteen points.
        spacing.button_padding.x = 15.0;
        spacing.icon_width = 24.0;
        spacing.icon_width_inner = 14.0;
    });
}

/// Takes every press as a click that does not move, however long it lasts: a machine that draws
/// slowly sees the end of a short one late. No control has a menu that a long press opens.
pub fn accept_slow_clicks(context: &Context) {
    context.options_mut(|options| options.input_options.max_click_duration = f64::INFINITY);
}

/// Returns whether controls are sized for fingers; then there is no keyboard.
pub fn is_for_fingers(context: &Context) -> bool {
    context.global_style().spacing.interact_size.y >= FINGER
}

/// Returns whether the user may touch the screen, where a virtual keyboard would cover controls.
pub fn is_touched(ui: &Ui) -> bool {
    is_for_fingers(ui.ctx()) || ui.input(|input| input.has_touch_screen())
}

/// Returns the word for pressing a control.
pub fn press_word(ui: &Ui) -> &'static str {
    if is_touched(ui) { "Tap" } else { "Click" }
}

/// Shows a window with a close button, which is large enough for fingers where needed.
pub fn show_closable<'open>(
    title: &str,
    window: Window<'open>,
    context: &Context,
    open: &'open mut bool,
    contents: impl FnOnce(&mut Ui),
) {
    let plain = window.collapsible(false);
    if !is_for_fingers(context) {
        plain.open(open).show(context, contents);
        return;
    }
    if !*open {
        return;
    }
    plain.title_bar(false).show(context, |ui| {
        ui.horizontal(|ui| {
            ui.heading(title);
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let close = ui.add(Button::new("✖").min_size(Vec2::splat(FINGER)));
                close.widget_info(|| {
                    egui::WidgetInfo::labeled(egui::Role::Button, true, "Close window")
                });
                *open &= !close.clicked();
            });
        });
        ui.separator();
        contents(ui);
    });
}

/// A panel at a side of the picture.
#[derive(Debug, Clone, Copy)]
pub struct Beside {
    pub title: &'static str,
    /// Whether it is at the right, else at the left.
    pub is_right: bool,
    /// Smallest, default and largest width, in points.
    pub widths: [f32; 3],
}

impl Beside {
    /// Shows the panel if it is `open`: beside the picture in a wide window if the picture keeps
    /// half of it, else over the picture. `room` is the width left for panels, in points. A panel
    /// with a single width is not resizable.
    pub fn show(
        self,
        ui: &mut Ui,
        room: &mut f32,
        open: &mut bool,
        contents: impl FnOnce(&mut Ui),
    ) {
        if !*open {
            return;
        }
        let [least, usual, largest] = self.widths;
        if has_sheets(ui) || *room < least {
            return self.over(ui, open, contents);
        }
        let largest = largest.min(*room);
        let id = self.title.to_lowercase();
        let panel = if self.is_right { Panel::right(id) } else { Panel::left(id) };
        let panel = if least == largest {
            panel.resizable(false).exact_size(least)
        } else {
            panel.default_size(usual.min(largest)).size_range(least..=largest)
        };
        let shown = panel.show(ui, contents);
        *room -= shown.response.rect.width();
    }

    /// Shows the panel over the picture: at its lower edge, in a low window at its side.
    fn over(self, ui: &Ui, open: &mut bool, contents: impl FnOnce(&mut Ui)) {
        let picture = ui.available_rect_before_wrap();
        let mut place = picture.shrink(4.0);
        if has_sheets(ui) && !is_low(ui) {
            place.min.y = picture.bottom() - SHEET * picture.height();
        } else {
            let most = if is_low(ui) { SHEET * picture.width() } else { place.width() };
            let width = self.widths[1].min(most);
            let left = if self.is_right { place.right() - width } else { place.left() };
            place = Rect::from_min_size(
                egui::pos2(left, place.top()),
                Vec2::new(width, place.height()),
            );
        }
        let frame = egui::Frame::window(ui.style());
        let outer = frame.total_margin().sum();
        let window = Window::new(self.title)
            .id(egui::Id::unique(("over the picture", self.title)))
            .frame(frame)
            .fixed_pos(place.min)
            .fixed_size((place.size() - outer).max(Vec2::splat(60.0)));
        show_closable(self.title, window, ui.ctx(), open, contents);
    }
}
