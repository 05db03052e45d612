//! How much room there is.

use egui::Ui;

/// Windows less wide than this are those of telephones, in points.
const NARROW: f32 = 640.0;

/// Whether the window has little room beside the picture: bars take two lines then, and what is
/// seldom used waits in menus.
pub fn is_narrow(ui: &Ui) -> bool {
    ui.ctx().content_rect().width() < NARROW
}
