//! The interface in a desktop window.

use eframe::{NativeOptions, Renderer};
use egui::ViewportBuilder;
use thiserror::Error;

use crate::app::{App, Setup};

/// The reason why no window could be opened.
#[derive(Debug, Error)]
#[error(
    "cannot open a window: {0}\n\
     A window needs a display (X11 or Wayland) and a graphics driver; one in software is enough \
     (Debian, Ubuntu: apt-get install mesa-vulkan-drivers libxkbcommon-x11-0). Pictures and films \
     need no display: carom picture, carom record."
)]
pub struct WindowError(String);

/// Opens the window and returns when it is closed.
///
/// # Errors
/// [`WindowError`] without a display or graphics driver.
pub fn open(setup: Setup) -> Result<(), WindowError> {
    let viewport = ViewportBuilder::default()
        .with_title("Carom")
        .with_app_id("carom")
        .with_inner_size([1360.0, 800.0])
        .with_min_inner_size([640.0, 420.0])
        .with_drag_and_drop(true);
    let options = NativeOptions { viewport, renderer: Renderer::Wgpu, ..Default::default() };
    let create: eframe::AppCreator =
        Box::new(|host| Ok(Box::new(App::new(host, setup)?) as Box<dyn eframe::App>));
    eframe::run_native("carom", options, create)
        .map_err(|error| WindowError(without_place(&error.to_string())))
}

/// Removes the source position that a library puts into its error.
fn without_place(error: &str) -> String {
    let parts = error.split_once(" at ").and_then(|(what, rest)| {
        let (place, why) = rest.split_once(": ")?;
        place.contains(".rs:").then(|| format!("{what}: {why}"))
    });
    parts.unwrap_or_else(|| error.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_names_no_line_of_a_library() {
        let told = "os error at /root/.cargo/registry/src/x/winit-0.30/src/mod.rs:779: no DISPLAY";
        assert_eq!(without_place(told), "os error: no DISPLAY");
        for plain in ["no driver", "looked at it: nothing", "at: once"] {
            assert_eq!(without_place(plain), plain);
        }
    }
}
