//! What can be filmed.

use carom::StopRequest;
use carom_render::Drawing;
use carom_scene::Scene;

use super::error::ShootError;

/// Something to see at any time.
pub trait Footage: Send {
    /// What it is called for people.
    fn title(&self) -> &str;

    /// The scene that says where from and in which light it is seen.
    fn scene(&self) -> &Scene;

    /// Has frames of the physics end early once a request is made; footage without any has nothing to
    /// stop.
    fn set_stop_request(&mut self, _request: StopRequest) {}

    /// Draws what is to be seen at a time \[s\] that is not before the last one.
    ///
    /// # Errors
    /// [`ShootError`] if it cannot go on to that time.
    fn draw(&mut self, time: f64, drawing: &mut Drawing) -> Result<Words, ShootError>;
}

/// What is written on a picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Words {
    /// When this is, and how things stand: after the title, in the corner.
    pub stamp: String,
    /// Large, in the middle.
    pub caption: Option<&'static str>,
}

impl Words {
    /// The time \[s\] alone.
    pub fn at(time: f64) -> Self {
        Self { stamp: format!("t = {time:.3} s"), caption: None }
    }
}

/// What a scene is called for people.
pub fn title(scene: &Scene) -> &str {
    if scene.title.is_empty() { &scene.name } else { &scene.title }
}
