//! A recorded run as footage.

use std::path::Path;

use carom::Spring;
use carom_render::Drawing;
use carom_scene::recording::{Playback, Replay, ReplayBall};
use carom_scene::{Palette, Scene};

use super::drawn;
use super::error::ShootError;
use super::footage::{Footage, Words, title};
use super::running::{Running, Seen};

/// A recording that is played while it is filmed.
pub struct Replayed {
    scene: Scene,
    /// World with the colliders only: recordings do not contain them, because they move by
    /// themselves.
    surfaces: Running,
    playback: Playback,
    palette: Palette,
    duration: f64,
    /// Spheres of the last picture, shown after the end of the recording.
    spheres: Vec<Seen>,
    /// Springs at the start of the scene; a spring disappears with its spheres.
    springs: Vec<Spring>,
}

impl Replayed {
    /// Opens a recording of this scene.
    pub fn open(path: &Path, scene: Scene) -> Result<Self, ShootError> {
        let mut duration = 0.0;
        let mut replay = Replay::open(path, &scene)?;
        while let Some(frame) = replay.next_frame()? {
            duration = frame.time;
        }
        let mut empty = scene.clone();
        empty.spheres.clear();
        empty.generators.retain(|generator| generator.collider().is_some());
        empty.emitters.clear();
        empty.springs.clear();
        let world = scene.world()?;
        let springs = world.springs().map(|(_, spring)| *spring).collect();
        Ok(Self {
            surfaces: Running::new(&empty)?,
            playback: Playback::new(Replay::open(path, &scene)?)?,
            palette: Palette::new(&scene)?,
            scene,
            duration,
            spheres: Vec::new(),
            springs,
        })
    }

    /// Time of the last frame \[s\].
    pub fn duration(&self) -> f64 {
        self.duration
    }
}

impl Footage for Replayed {
    fn title(&self) -> &str {
        title(&self.scene)
    }

    fn scene(&self) -> &Scene {
        &self.scene
    }

    fn draw(&mut self, time: f64, drawing: &mut Drawing) -> Result<Words, ShootError> {
        let Self { scene, surfaces, playback, palette, spheres, springs, .. } = self;
        surfaces.go_to(time)?;
        if let Some(frame) = playback.at(time)? {
            palette.follow(frame.time);
            spheres.clear();
            spheres.extend(frame.balls.iter().map(seen));
        }
        drawn::draw(scene, surfaces, time, (spheres, springs), palette, drawing);
        Ok(Words::at(time))
    }
}

fn seen(ball: &ReplayBall) -> Seen {
    let ReplayBall { number, position, radius, mass, orientation, .. } = *ball;
    Seen { number, position, radius, mass, orientation }
}
