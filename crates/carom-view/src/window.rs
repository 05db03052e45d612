//! The interface in a window of the desktop.

use eframe::{NativeOptions, Renderer};
use egui::ViewportBuilder;
use thiserror::Error;

use crate::app::{App, Setup};

/// Why there is no window.
#[derive(Debug, Error)]
#[error(
    "cannot open a window: {0}\n\
     A window needs a display (X11 or Wayland) and a graphics driver; one in software is enough \
     (Debian, Ubuntu: apt-get install mesa-vulkan-drivers libxkbcommon-x11-0). Pictures and films \
     need no display: carom picture, carom record."
)]
pub struct WindowError(String);

/// Opens the window and comes back when it is closed.
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
    eframe::run_native("carom", options, create).map_err(|error| WindowError(error.to_string()))
}
