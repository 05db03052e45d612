//! Output of the interface: pictures, films and scene files.

use std::ops::Range;

use carom_render::{Picture, missing_characters, stamp};
use carom_scene::scene::Scene;

use crate::host::Host;
use crate::naming::{file_name, stamp_text};
use crate::notices::Notices;
use crate::recorder::{FRAMES_PER_SECOND, Recorder, SIZE};
use crate::snapshot::Snapshot;
use crate::studio::Studio;

/// Pictures and films that are not complete yet.
#[derive(Default)]
pub struct Exports {
    pictures: Vec<Pending>,
    recorder: Option<Recorder>,
}

/// A picture that is being drawn.
struct Pending {
    snapshot: Snapshot,
    /// File name without an ending.
    name: String,
    /// Text written on the picture.
    stamp: Option<String>,
}

impl Exports {
    /// Saves plots of a scene at a time \[s\] as soon as they are drawn.
    pub fn save_plots(&mut self, plots: Snapshot, scene: &str, time: f64) {
        let name = format!("{}-plots", file_name(scene, time));
        self.pictures.push(Pending { snapshot: plots, name, stamp: None });
    }

    /// Saves a picture of a scene as soon as it is drawn, with the time written on it \[s\].
    pub fn save_picture(&mut self, snapshot: Snapshot, scene: &str, time: f64) {
        let (name, stamp) = (file_name(scene, time), Some(stamp_text(scene, time)));
        self.pictures.push(Pending { snapshot, name, stamp });
    }

    /// Returns whether a film is being recorded.
    pub fn is_recording(&self) -> bool {
        self.recorder.as_ref().is_some_and(|recorder| !recorder.is_ending())
    }

    /// Starts a film of a scene at this time \[s\].
    pub fn begin_film(&mut self, scene: &str, time: f64, to: &mut Outlet) {
        if self.recorder.is_some() {
            to.notices.complain("the last film is being completed: try again in a moment");
            return;
        }
        match to.host.begin_film(&file_name(scene, time), SIZE, FRAMES_PER_SECOND) {
            Ok(film) => self.recorder = Some(Recorder::new(film, time)),
            Err(error) => to.notices.complain(error),
        }
    }

    /// Ends the film, if one is being recorded.
    pub fn end_film(&mut self) {
        if let Some(recorder) = &mut self.recorder {
            recorder.end();
        }
    }

    /// Returns the film frames that are due at a time \[s\], and the size in pixels of the one
    /// picture to draw for them.
    pub fn film_due(&mut self, time: f64) -> Option<([u32; 2], Range<u32>)> {
        let frames = self.recorder.as_mut()?.due(time)?;
        Some((SIZE, frames))
    }

    /// Adds a picture that is still being drawn for these frames.
    pub fn add_to_film(&mut self, snapshot: Snapshot, frames: Range<u32>) {
        if let Some(recorder) = &mut self.recorder {
            recorder.add(snapshot, frames);
        }
    }

    /// Saves the pictures that are complete. Returns whether any are left.
    pub fn collect(&mut self, studio: &Studio, to: &mut Outlet) -> bool {
        let device = studio.device();
        let is_ready = |pending: &mut Pending| pending.snapshot.is_ready(device);
        for Pending { snapshot, name, stamp } in self.pictures.extract_if(.., is_ready) {
            match snapshot.picture() {
                Ok(picture) => to.save_picture(picture, &name, stamp.as_deref()),
                Err(error) => to.notices.complain(error),
            }
        }
        if let Some(recorder) = &mut self.recorder
            && let Err(error) = recorder.collect(device)
        {
            to.notices.complain(error);
        }
        if let Some(recorder) = self.recorder.take_if(|it| it.is_complete()) {
            match recorder.finish() {
                Ok(text) => to.notices.tell(text),
                Err(error) => to.notices.complain(error),
            }
        }
        if let Some(trouble) = to.host.trouble() {
            to.notices.complain(trouble);
        }
        !self.pictures.is_empty() || self.recorder.is_some()
    }
}

/// The destination of exports: files go to the host, messages to the notices.
pub struct Outlet<'a> {
    pub host: &'a mut dyn Host,
    pub notices: &'a mut Notices,
}

impl Outlet<'_> {
    /// Saves the scene with its state at a time \[s\].
    pub fn save_scene(&mut self, scene: &Scene, time: f64) {
        self.save(&file_name(&scene.name, time), "toml", scene.to_toml().as_bytes());
    }

    /// Saves a table about a scene at a time \[s\].
    pub fn save_table(&mut self, scene: &str, time: f64, name: &str, csv: &str) {
        self.save(&format!("{}-{name}", file_name(scene, time)), "csv", csv.as_bytes());
    }

    fn save_picture(&mut self, mut picture: Picture, name: &str, text: Option<&str>) {
        if let Some(text) = text {
            stamp(&mut picture, text);
            let missing = missing_characters(text);
            if !missing.is_empty() {
                self.notices.tell(format!("the picture lacks {missing}: no font draws that"));
            }
        }
        match picture.to_png() {
            Ok(content) => self.save(name, "png", &content),
            Err(error) => self.notices.complain(error),
        }
    }

    fn save(&mut self, name: &str, ending: &str, content: &[u8]) {
        match self.host.save(name, ending, content) {
            Ok(saved) => self.notices.tell(format!("saved {saved}")),
            Err(error) => self.notices.complain(error),
        }
    }
}
