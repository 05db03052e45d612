//! A scene that is stepped as footage.

use carom::{Spring, StopRequest};
use carom_render::Drawing;
use carom_scene::{Palette, Scene, SceneError};

use super::drawn;
use super::error::ShootError;
use super::footage::{Footage, Words, title};
use super::running::Running;

/// A scene that is stepped while it is recorded.
pub struct Stepped {
    scene: Scene,
    running: Running,
    palette: Palette,
}

impl Stepped {
    /// Creates a scene at its start.
    ///
    /// # Errors
    /// [`SceneError`] if it is invalid.
    pub fn new(scene: Scene) -> Result<Self, SceneError> {
        let running = Running::new(&scene)?;
        let palette = Palette::new(&scene)?;
        Ok(Self { scene, running, palette })
    }

    /// Steps one frame; returns the time \[s\] at its end.
    ///
    /// # Errors
    /// The same as those of [`carom::World::step`].
    pub fn step(&mut self) -> Result<f64, carom::Error> {
        self.running.step()?;
        Ok(self.running.world().time())
    }
}

impl Footage for Stepped {
    fn set_stop_request(&mut self, request: StopRequest) {
        self.running.set_stop_request(request);
    }

    fn title(&self) -> &str {
        title(&self.scene)
    }

    fn scene(&self) -> &Scene {
        &self.scene
    }

    fn draw(&mut self, time: f64, drawing: &mut Drawing) -> Result<Words, ShootError> {
        let Self { scene, running, palette } = self;
        running.go_to(time)?;
        // The time of the film may be a rounding error before the frame of an emission.
        palette.follow(running.world().time());
        let springs: Vec<Spring> = running.world().springs().map(|(_, spring)| *spring).collect();
        let seen = (&running.spheres(time)[..], &springs[..]);
        drawn::draw(scene, running, time, seen, palette, drawing);
        Ok(Words::at(time))
    }
}
