//! Runs as animations.

mod arrays;
mod bodies;
mod channels;
mod geometry;
mod look;
mod nodes;
mod tracks;

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use carom::World;
use carom_scene::recording::Format;
use carom_scene::scene::Scene;
use carom_scene::{Palette, SceneError};
use thiserror::Error;

use crate::document::{Asset, Buffer, Document};
use crate::extensions::{BODIES, LIGHTS, SHAPES, TRANSMISSION};
use crate::glb;
use arrays::Arrays;
use nodes::{Nodes, coat_of};
use tracks::{Placement, Track, Tracks};

/// Why a recording cannot begin.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The file cannot be written.
    #[error(transparent)]
    Unwritable(#[from] io::Error),
    /// The scene makes no sense.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

/// A run, recorded as an animation in one binary glTF file (.glb).
///
/// Each ball is a node with a sphere of radius 1, scaled by its radius; each collider a node with its shape of
/// size 1. Keys are the frames, with straight ways between them. What appears later has no size before, and
/// none after it is gone. Nodes begin as the world does, in 64 bits; keys have 32 bits.
///
/// The file is complete at the end only. Until then, rows wait in a temporary file beside it, 28 bytes for each
/// ball, collider and frame; in memory are 64 MiB of them at a time, some 3 kB for each ball, and 20 bytes for each
/// frame.
pub struct Animation {
    file: File,
    palette: Palette,
    nodes: Nodes,
    arrays: Arrays,
    /// Balls, with the nodes of those that were there, in the order of the tracks.
    balls: Tracks,
    ball_nodes: Vec<usize>,
    colliders: Tracks,
    collider_nodes: Vec<usize>,
    /// \[s\], one for each frame.
    times: Vec<f32>,
    /// Whether spheres turn; known from the start on.
    has_spin: bool,
    /// Whether a frame was written in part: then rows and tracks do not belong together.
    broken: bool,
}

impl std::fmt::Debug for Animation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Animation").field("frames", &self.times.len()).finish_non_exhaustive()
    }
}

impl Animation {
    /// Begins a recording with the world as it is, which was made of this scene.
    ///
    /// # Errors
    /// For a place that cannot be written to, and a scene that makes no sense.
    pub fn create(path: &Path, scene: &Scene, world: &World) -> Result<Self, ExportError> {
        let palette = Palette::new(scene)?;
        let file = File::create(path)?;
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new("."));
        let mut animation = Self {
            file,
            palette,
            nodes: Nodes::new(scene, world),
            arrays: Arrays::default(),
            balls: Tracks::create(folder)?,
            ball_nodes: Vec::new(),
            colliders: Tracks::create(folder)?,
            collider_nodes: Vec::new(),
            times: Vec::new(),
            has_spin: world.has_spin(),
            broken: false,
        };
        animation.add_colliders(scene, world);
        animation.push(world)?;
        Ok(animation)
    }

    /// Adds the colliders that are there at the start, in the looks of the scene.
    fn add_colliders(&mut self, scene: &Scene, world: &World) {
        let written = scene.all_colliders();
        for (i, (_, collider)) in world.colliders().enumerate() {
            let written = written.get(i);
            let coat = written.is_none_or(|it| it.visible).then(|| self.palette.collider(i));
            let name = written.map(|it| it.name.clone()).filter(|it| !it.is_empty());
            let name = name.unwrap_or_else(|| format!("collider {i}"));
            let node = self.nodes.push_collider(&name, collider, coat, &mut self.arrays);
            self.collider_nodes.push(node);
        }
    }

    /// Adds a frame.
    fn push(&mut self, world: &World) -> io::Result<()> {
        let time = world.time() as f32;
        if self.times.last().is_some_and(|last| *last >= time) {
            let text = "times of its keys have 32 bits, in which these frames fall together: write fewer (--every)";
            return Err(io::Error::new(io::ErrorKind::InvalidInput, text));
        }
        // What a ball takes in the JSON, generously.
        const NODE: u64 = 1500;
        let json = NODE * (self.ball_nodes.len() + world.spheres().len()) as u64;
        let keys = self.balls.bytes() + self.colliders.bytes();
        let frame = 28 * world.spheres().len() as u64;
        if json + keys + frame + self.arrays.bytes.len() as u64 > u64::from(u32::MAX) {
            return Err(glb::too_large());
        }
        self.broken = true;
        let is_start = self.times.is_empty();
        self.palette.follow(world.time());
        let spheres = world.spheres();
        self.balls.push(spheres.ids().iter().enumerate().map(|(i, id)| {
            let sphere = spheres.get(i);
            let (position, rotation) = (sphere.position, sphere.orientation.normalize());
            (id.number(), Placement { position, rotation, scale: [sphere.radius; 3] })
        }))?;
        for track in &self.balls.tracks()[self.ball_nodes.len()..] {
            let place = spheres.ids().partition_point(|id| id.number() < track.number);
            let sphere = spheres.get(place);
            let coat = coat_of(&self.palette, track.number, &sphere);
            let look = (coat, self.has_spin);
            let node =
                self.nodes.push_ball(track.number, &sphere, look, is_start, &mut self.arrays);
            self.ball_nodes.push(node);
        }
        let nodes = &self.nodes;
        let places = world.colliders().map(|(id, it)| (id.number(), nodes.collider_place(it)));
        self.colliders.push(places)?;
        let later = &self.colliders.tracks()[self.collider_nodes.len()..];
        for number in later.iter().map(|track| track.number) {
            let of_number = world.colliders().find(|(id, _)| id.number() == number);
            let Some((_, collider)) = of_number else { continue };
            let coat = Some(self.palette.collider(usize::MAX));
            let name = format!("collider {number}");
            let node = self.nodes.push_collider(&name, collider, coat, &mut self.arrays);
            self.nodes.document.nodes[node].scale = Some([0.0; 3]);
            self.collider_nodes.push(node);
        }
        self.times.push(time);
        self.broken = false;
        Ok(())
    }

    /// Everything but the binary part.
    fn document(&mut self) -> Document {
        let pairs = [(&self.balls, &self.ball_nodes), (&self.colliders, &self.collider_nodes)];
        let tracks: Vec<(&Track, usize)> = pairs
            .into_iter()
            .flat_map(|(tracks, nodes)| tracks.tracks().iter().zip(nodes.iter().copied()))
            .collect();
        let animation = channels::of_tracks(&tracks, &self.times, &mut self.arrays);
        let Nodes { document, bodies, .. } = &mut self.nodes;
        let mut document = std::mem::take(document);
        document.asset = Some(Asset {
            version: "2.0".to_owned(),
            generator: format!("Carom {}", env!("CARGO_PKG_VERSION")),
        });
        document.animations.extend(animation);
        document.accessors = std::mem::take(&mut self.arrays.accessors);
        document.buffer_views = std::mem::take(&mut self.arrays.views);
        document.extensions_used = vec![LIGHTS.to_owned()];
        if document.materials.iter().any(|it| it.extensions.transmission.is_some()) {
            document.extensions_used.push(TRANSMISSION.to_owned());
        }
        if !bodies.shapes.shapes.is_empty() {
            document.extensions_used.extend([SHAPES, BODIES].map(ToOwned::to_owned));
            document.extensions.shapes = Some(std::mem::take(&mut bodies.shapes));
            document.extensions.bodies = Some(std::mem::take(&mut bodies.materials));
        }
        document
    }
}

impl Format for Animation {
    fn write(&mut self, world: &World) -> io::Result<()> {
        self.push(world)
    }

    fn finish(mut self: Box<Self>) -> io::Result<()> {
        if self.broken {
            return Err(io::Error::other("a frame was written in part; there is no animation"));
        }
        let mut document = self.document();
        let Self { file, arrays, balls, colliders, .. } = *self;
        let byte_length = arrays.bytes.len() as u64 + balls.bytes() + colliders.bytes();
        if byte_length > 0 {
            document.buffers.push(Buffer { byte_length, uri: None });
        }
        let json = serde_json::to_vec(&document)?;
        drop(document);
        let mut out = BufWriter::new(file);
        glb::write_head(&mut out, &json, byte_length)?;
        out.write_all(&arrays.bytes)?;
        balls.write_keys(&mut out)?;
        colliders.write_keys(&mut out)?;
        out.flush()
    }
}
