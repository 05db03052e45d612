//! Things that can be filmed.

use carom::StopRequest;
use carom_render::Drawing;
use carom_scene::Scene;

use super::error::ShootError;

/// A source of pictures at any time.
pub trait Footage: Send {
    /// Title for people.
    fn title(&self) -> &str;

    /// Scene that determines camera and light.
    fn scene(&self) -> &Scene;

    /// Sets a request that ends a frame of the physics early; does nothing if the footage has no
    /// physics.
    fn set_stop_request(&mut self, _request: StopRequest) {}

    /// Draws the picture at `time` \[s\], which must not be before the last one.
    ///
    /// # Errors
    /// [`ShootError`] if that time cannot be reached.
    fn draw(&mut self, time: f64, drawing: &mut Drawing) -> Result<Words, ShootError>;
}

/// Text on a picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Words {
    /// Time and status, shown after the title in the corner.
    pub stamp: String,
    /// Large text in the middle.
    pub caption: Option<&'static str>,
}

impl Words {
    /// Text with the time \[s\] only.
    pub fn at(time: f64) -> Self {
        Self { stamp: format!("t = {time:.3} s"), caption: None }
    }
}

/// Title of a scene for people.
pub fn title(scene: &Scene) -> &str {
    if scene.title.is_empty() { &scene.name } else { &scene.title }
}
