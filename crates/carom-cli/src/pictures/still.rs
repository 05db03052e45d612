//! The present state of a world as footage.

use carom::World;
use carom_render::{Drawing, draw_world};
use carom_scene::{Palette, Scene};

use super::error::ShootError;
use super::footage::{Footage, Words, title};

/// A world that does not move while it is drawn.
pub struct Still<'a> {
    /// Everything except spheres; its colliders are those of the world, in the same order.
    pub scene: &'a Scene,
    /// World that is drawn.
    pub world: &'a World,
    /// Colours, followed to the time of the world.
    pub palette: &'a Palette,
}

impl Footage for Still<'_> {
    fn title(&self) -> &str {
        title(self.scene)
    }

    fn scene(&self) -> &Scene {
        self.scene
    }

    fn draw(&mut self, _: f64, drawing: &mut Drawing) -> Result<Words, ShootError> {
        draw_world(self.scene, self.world, self.palette, |_| None, drawing);
        Ok(Words::at(self.world.time()))
    }
}
