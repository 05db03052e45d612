//! Creates the complete file of an animation from its frames.

use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read, Write};

use carom_scene::recording::Recovered;

use super::addition;
use super::arrays::Arrays;
use super::channels;
use super::frames::{self, Frame, Place};
use super::tracks::{Track, Tracks};
use crate::document::{Asset, Buffer, Document};
use crate::extensions::{BODIES, LIGHTS, SHAPES, TRANSMISSION};
use crate::glb;

/// Writes the animation of the complete frames of an unfinished file; `None` if the file is of
/// another kind.
pub(super) fn compose(source: &mut File, target: File) -> io::Result<Option<Recovered>> {
    let Some((places, extent)) = frames::scan(source)? else { return Ok(None) };
    if places.is_empty() {
        return Err(io::Error::new(io::ErrorKind::InvalidData, "it has no whole frame"));
    }
    let mut run = Run::default();
    places.iter().try_for_each(|place| run.read(source, place))?;
    let recovered = Recovered {
        frames: extent.records,
        last: run.last,
        left_out: extent.rest,
        is_damaged: extent.is_damaged,
    };
    run.write(source, target)?;
    Ok(Some(recovered))
}

/// Everything of a run except its rows.
#[derive(Debug, Default)]
struct Run {
    document: Document,
    /// Bytes of the arrays.
    bytes: Vec<u8>,
    balls: Tracks,
    colliders: Tracks,
    /// Time of each frame \[s\].
    times: Vec<f32>,
    /// Time of the last frame \[s\].
    last: Option<f64>,
}

impl Run {
    /// Adds a frame.
    fn read(&mut self, source: &mut File, place: &Place) -> io::Result<()> {
        let Frame { time, balls, colliders, added } = place.read(source, &mut self.bytes)?;
        added.into_iter().for_each(|added| addition::extend(&mut self.document, added));
        let (start, length) = place.rows();
        let mut rows = BufReader::new(source.take(length));
        let of_colliders = self.colliders.repeat(&colliders, start, &mut rows);
        let later = start + self.colliders.rows_length();
        let are_whole = of_colliders && self.balls.repeat(&balls, later, &mut rows);
        if !are_whole || rows.bytes().next().is_some() {
            let text = "a frame has other bodies than rows";
            return Err(io::Error::new(io::ErrorKind::InvalidData, text));
        }
        self.times.push(time as f32);
        self.last = Some(time);
        Ok(())
    }

    fn write(self, source: &mut File, target: File) -> io::Result<()> {
        let Self { mut document, bytes, balls, colliders, times, .. } = self;
        let (accessors, views) = (&mut document.accessors, &mut document.buffer_views);
        let (accessors, views) = (std::mem::take(accessors), std::mem::take(views));
        let mut arrays = Arrays { bytes, views, accessors };
        let tracks: Vec<&Track> = balls.tracks().iter().chain(colliders.tracks()).collect();
        document.animations.extend(channels::of_tracks(&tracks, &times, &mut arrays));
        document.accessors = arrays.accessors;
        document.buffer_views = arrays.views;
        complete(&mut document);
        let byte_length = arrays.bytes.len() as u64 + balls.bytes() + colliders.bytes();
        if byte_length > 0 {
            document.buffers.push(Buffer { byte_length, uri: None });
        }
        let json = serde_json::to_vec(&document)?;
        drop(document);
        let mut out = BufWriter::new(target);
        glb::write_head(&mut out, &json, byte_length)?;
        out.write_all(&arrays.bytes)?;
        balls.write_keys(source, &mut out)?;
        colliders.write_keys(source, &mut out)?;
        out.flush()
    }
}

/// Sets the version of the file and the extensions that it uses.
fn complete(document: &mut Document) {
    let generator = format!("Carom {}", env!("CARGO_PKG_VERSION"));
    document.asset = Some(Asset { version: "2.0".to_owned(), generator });
    document.extensions_used = vec![LIGHTS.to_owned()];
    if document.materials.iter().any(|it| it.extensions.transmission.is_some()) {
        document.extensions_used.push(TRANSMISSION.to_owned());
    }
    if document.extensions.shapes.is_some() {
        document.extensions_used.extend([SHAPES, BODIES].map(ToOwned::to_owned));
    }
}
