//! Readable colours of the interface.

use egui::{Color32, Context, Stroke, Theme, Visuals};

/// Sets a contrast of at least 4.5 between texts and their background in both themes (Web Content
/// Accessibility Guidelines 2.2, 1.4.3).
pub fn make_readable(context: &Context) {
    for theme in [Theme::Light, Theme::Dark] {
        context.style_mut_of(theme, |style| color(&mut style.visuals, theme));
    }
}

fn color(visuals: &mut Visuals, theme: Theme) {
    let rgb = Color32::from_rgb;
    let (text, weak, link, warning, error) = match theme {
        Theme::Light => (50, 92, rgb(0, 95, 180), rgb(158, 74, 0), rgb(184, 20, 20)),
        Theme::Dark => (200, 158, rgb(100, 175, 255), rgb(255, 160, 40), rgb(255, 110, 110)),
    };
    let gray = Color32::from_gray;
    visuals.widgets.noninteractive.fg_stroke = Stroke::new(1.0, gray(text));
    visuals.widgets.inactive.fg_stroke = Stroke::new(1.0, gray(text));
    visuals.weak_text_color = Some(gray(weak));
    visuals.hyperlink_color = link;
    visuals.warn_fg_color = warning;
    visuals.error_fg_color = error;
}
