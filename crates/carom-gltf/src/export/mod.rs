//! Records runs as animations.

mod addition;
mod arrays;
mod bodies;
mod channels;
mod compose;
mod frames;
mod geometry;
mod look;
mod nodes;
mod tracks;

use std::io;
use std::path::Path;

use carom::World;
use carom_scene::recording::{Format, Recovered, RecoveryError, complete, recover_by};
use carom_scene::scene::Scene;
use carom_scene::unfinished::Unfinished;
use carom_scene::{Palette, SceneError};
use thiserror::Error;

use crate::glb;
use addition::Marks;
use arrays::Arrays;
use compose::compose;
use frames::Frame;
use nodes::{Nodes, coat_of};
use tracks::{Changes, Placement, Tracks};

/// Why a recording cannot be started.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The file cannot be written.
    #[error(transparent)]
    Unwritable(#[from] io::Error),
    /// The scene is invalid.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

/// Records a run as an animation in one binary glTF file (.glb).
///
/// Each ball is a node with a sphere of radius 1, scaled by its radius; each collider is a node
/// with its shape of size 1. Keys are the frames, with linear interpolation. A body has scale 0
/// before it appears and after it is removed. Nodes contain the state at the start in 64 bits; keys
/// have 32 bits.
///
/// The file gets its name once it is complete. Until then its frames are in `NAME.0.unfinished`
/// beside it (1, 2, ... if others exist): about 100 bytes per frame, and 28 bytes per frame for
/// each ball and collider. A frame that was written has been passed to the operating system, and
/// [`recover_animation`] creates the animation of a killed process. The recording takes about 3 kB
/// of memory per ball; completion takes 64 MiB and 60 bytes per frame in addition.
pub struct Animation {
    unfinished: Unfinished,
    palette: Palette,
    nodes: Nodes,
    arrays: Arrays,
    /// Lengths of the lists of nodes and arrays that the unfinished file contains.
    marks: Marks,
    balls: Tracks,
    colliders: Tracks,
    /// Time of the last frame \[s\].
    time: Option<f32>,
    /// Number of frames in the unfinished file.
    frames: u64,
    /// Largest size of the complete file \[byte\].
    most_bytes: u64,
    /// Whether spheres can rotate; decided at the start.
    has_spin: bool,
    /// Whether a frame was written only partly; then no frame may follow.
    broken: bool,
    /// Buffer that is reused.
    chunk: Vec<u8>,
}

impl std::fmt::Debug for Animation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Animation").field("time", &self.time).finish_non_exhaustive()
    }
}

impl Animation {
    /// Starts a recording with the present state of a world, which was created from this scene.
    ///
    /// # Errors
    /// [`ExportError`] if the file cannot be written, or the scene is invalid.
    pub fn create(path: &Path, scene: &Scene, world: &World) -> Result<Self, ExportError> {
        let palette = Palette::new(scene)?;
        let (unfinished, ()) = Unfinished::begin(path, frames::begin)?;
        let mut animation = Self {
            unfinished,
            palette,
            nodes: Nodes::new(scene, world),
            arrays: Arrays::default(),
            marks: Marks::default(),
            balls: Tracks::default(),
            colliders: Tracks::default(),
            time: None,
            frames: 0,
            most_bytes: u32::MAX.into(),
            has_spin: world.has_spin(),
            broken: false,
            chunk: Vec::new(),
        };
        match animation.push(world, Some(scene)) {
            Ok(()) => Ok(animation),
            Err(error) => {
                // Ignored, because an earlier error is being reported.
                animation.unfinished.remove().ok();
                Err(error.into())
            }
        }
    }

    /// Adds a frame; the first one with the scene of the world.
    fn push(&mut self, world: &World, scene: Option<&Scene>) -> io::Result<()> {
        let time = world.time() as f32;
        if self.time.is_some_and(|last| last >= time) {
            let text = "times of its keys have 32 bits, in which these frames fall together: write fewer (--every)";
            return Err(io::Error::new(io::ErrorKind::InvalidInput, text));
        }
        if self.broken {
            return Err(io::Error::other("the frame before was written in part"));
        }
        self.broken = true;
        self.palette.follow(world.time());
        let mut rows = Vec::new();
        let colliders = self.push_colliders(world, scene, &mut rows);
        let balls = self.push_balls(world, scene.is_some(), &mut rows);
        if self.bytes() > self.most_bytes {
            return Err(glb::too_large());
        }
        let (added, arrays) = self.marks.advance(&self.nodes, &self.arrays).unzip();
        let frame = Frame { time: world.time(), balls, colliders, added };
        let arrays = arrays.unwrap_or_default();
        frames::append(self.unfinished.file(), &mut self.chunk, &frame, &arrays, &rows)?;
        self.time = Some(time);
        self.frames += 1;
        self.broken = false;
        Ok(())
    }

    /// Upper bound of the size of the complete file, with the frame that is being added \[byte\].
    fn bytes(&self) -> u64 {
        // Generous size of a node in the JSON, with its channels.
        const NODE: u64 = 1500;
        const TIME: u64 = 4;
        let json = NODE * self.nodes.document.nodes.len() as u64;
        let keys = self.balls.bytes() + self.colliders.bytes() + TIME * (self.frames + 1);
        json + keys + self.arrays.bytes.len() as u64
    }

    /// Returns the unfinished file, which contains the whole run, and its number of frames.
    fn into_unfinished(self) -> (Unfinished, u64) {
        (self.unfinished, self.frames)
    }

    /// Adds the rows of colliders; at the start, `scene` describes their looks.
    fn push_colliders(
        &mut self,
        world: &World,
        scene: Option<&Scene>,
        rows: &mut Vec<u8>,
    ) -> Changes {
        let Self { nodes, arrays, palette, .. } = self;
        let there: Vec<_> = world.colliders().map(|(id, it)| (id.number(), it)).collect();
        let places = there.iter().map(|&(number, it)| (number, nodes.collider_place(it)));
        let places: Vec<_> = places.collect();
        let written = scene.map(Scene::all_colliders);
        let node = |number| {
            let place = there.partition_point(|it| it.0 < number);
            let (_, collider) = there[place];
            let Some(written) = &written else {
                let (name, coat) = (format!("collider {number}"), palette.collider(usize::MAX));
                return nodes.push_later_collider(&name, collider, coat, arrays);
            };
            let written = written.get(place);
            let coat = written.is_none_or(|it| it.visible).then(|| palette.collider(place));
            let name = written.map(|it| it.name.clone()).filter(|it| !it.is_empty());
            let name = name.unwrap_or_else(|| format!("collider {place}"));
            nodes.push_collider(&name, collider, coat, arrays)
        };
        self.colliders.push(places.into_iter(), node, rows)
    }

    /// Adds the rows of balls.
    fn push_balls(&mut self, world: &World, is_start: bool, rows: &mut Vec<u8>) -> Changes {
        let Self { nodes, arrays, palette, has_spin, .. } = self;
        let spheres = world.spheres();
        let places = spheres.ids().iter().enumerate().map(|(i, id)| {
            let sphere = spheres.get(i);
            let (position, rotation) = (sphere.position, sphere.orientation.normalize());
            (id.number(), Placement { position, rotation, scale: [sphere.radius; 3] })
        });
        let node = |number| {
            let sphere = spheres.get(spheres.ids().partition_point(|id| id.number() < number));
            let look = (coat_of(palette, number, &sphere), *has_spin);
            nodes.push_ball(number, &sphere, look, is_start, arrays)
        };
        self.balls.push(places, node, rows)
    }
}

impl Format for Animation {
    fn write(&mut self, world: &World) -> io::Result<()> {
        self.push(world, None)
    }

    fn finish(self: Box<Self>) -> io::Result<()> {
        let (unfinished, frames) = self.into_unfinished();
        complete(unfinished, frames, compose)
    }
}

/// Creates the animation `target` from the file `unfinished` of a killed run, and removes
/// `unfinished`.
///
/// # Errors
/// [`RecoveryError`]. Both files are then unchanged, except if only the removal of `unfinished`
/// failed.
pub fn recover_animation(unfinished: &Path, target: &Path) -> Result<Recovered, RecoveryError> {
    recover_by(unfinished, target, compose)
}

#[cfg(test)]
mod tests {
    use carom_scene::Library;

    use super::*;

    #[test]
    fn a_recording_ends_before_the_frame_for_which_the_file_has_no_room() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.glb");
        let (scene, _) = Library::new().find("simtest3", &[]).unwrap();
        let mut world = scene.world().unwrap();
        let mut animation = Animation::create(&path, &scene, &world).unwrap();
        animation.most_bytes = 40_000;
        let error = loop {
            world.step(scene.simulation.frame_time).unwrap();
            if let Err(error) = animation.write(&world) {
                break error;
            }
        };
        assert_eq!(error.kind(), io::ErrorKind::FileTooLarge);
        assert!(animation.write(&world).is_err(), "nothing comes after it");
        assert!(animation.frames > 10, "{}", animation.frames);
        Box::new(animation).finish().unwrap();
        let length = std::fs::metadata(&path).unwrap().len();
        assert!((10_000..40_000).contains(&length), "{length}");
    }
}
