//! What leaves the interface: pictures, films and scene files.

use std::ops::Range;
use std::sync::{Arc, Mutex};

use carom_render::{Picture, stamp};
use carom_scene::scene::Scene;
use egui::{ColorImage, Context, Pos2, Rect, ScreenshotCallback, Vec2, ViewportCommand};

use crate::host::Host;
use crate::naming::{file_name, stamp_text};
use crate::notices::Notices;
use crate::recorder::{FRAMES_PER_SECOND, Recorder, SIZE};
use crate::snapshot::Snapshot;
use crate::studio::Studio;

/// Pictures and films on their way out.
#[derive(Default)]
pub struct Exports {
    pictures: Vec<Pending>,
    screens: Vec<PendingScreen>,
    recorder: Option<Recorder>,
}

/// A picture that is being drawn.
struct Pending {
    snapshot: Snapshot,
    scene: String,
    /// \[s\]
    time: f64,
}

/// A picture of a part of the window that is awaited, and what it is called.
struct PendingScreen {
    name: String,
    image: Arc<Mutex<Option<ColorImage>>>,
}

impl Exports {
    /// Saves a part of the window, in points, as it is in the next picture, with plots of a scene at a
    /// time \[s\].
    pub fn save_screen(&mut self, context: &Context, part: Rect, scene: String, time: f64) {
        let pixels_per_point = context.pixels_per_point();
        let part = part.intersect(context.content_rect());
        let image = Arc::new(Mutex::new(None));
        let (inbox, waiting) = (image.clone(), context.clone());
        let callback = ScreenshotCallback::new(move |screen| {
            // The window may have become smaller meanwhile.
            let [width, height] = screen.size.map(|it| it as f32 / pixels_per_point);
            let whole = Rect::from_min_size(Pos2::ZERO, Vec2::new(width, height));
            let part = part.intersect(whole);
            if let Ok(mut inbox) = inbox.lock()
                && part.is_positive()
            {
                *inbox = Some(screen.region(&part, Some(pixels_per_point)));
            }
            waiting.request_repaint();
        });
        context.send_viewport_cmd(ViewportCommand::Screenshot(callback));
        let name = format!("{}-plots", file_name(&scene, time));
        self.screens.push(PendingScreen { name, image });
    }

    /// Saves a picture of a scene at a time \[s\], which is written on it, when it has been drawn.
    pub fn save_picture(&mut self, snapshot: Snapshot, scene: String, time: f64) {
        self.pictures.push(Pending { snapshot, scene, time });
    }

    /// Whether a film is being recorded.
    pub fn is_recording(&self) -> bool {
        self.recorder.as_ref().is_some_and(|recorder| !recorder.is_ending())
    }

    /// Begins a film of a scene from a time on \[s\].
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

    /// Ends the film that is being recorded, if one is.
    pub fn end_film(&mut self) {
        if let Some(recorder) = &mut self.recorder {
            recorder.end();
        }
    }

    /// Frames of the film that a picture of this size in pixels is to be drawn for, at a time \[s\].
    pub fn film_due(&mut self, time: f64) -> Option<([u32; 2], Range<u32>)> {
        let frames = self.recorder.as_mut()?.due(time)?;
        Some((SIZE, frames))
    }

    /// Adds a picture that is being drawn for these frames.
    pub fn add_to_film(&mut self, snapshot: Snapshot, frames: Range<u32>) {
        if let Some(recorder) = &mut self.recorder {
            recorder.add(snapshot, frames);
        }
    }

    /// Saves what has been drawn since this was called last. Returns whether anything is still to
    /// come.
    pub fn collect(&mut self, studio: &Studio, to: &mut Outlet) -> bool {
        let device = studio.device();
        let is_ready = |pending: &mut Pending| pending.snapshot.is_ready(device);
        for Pending { snapshot, scene, time } in self.pictures.extract_if(.., is_ready) {
            match snapshot.picture() {
                Ok(picture) => to.save_picture(picture, &scene, time),
                Err(error) => to.notices.complain(error),
            }
        }
        self.screens.retain(|screen| {
            let taken = screen.image.lock().ok().and_then(|mut image| image.take());
            taken.is_none_or(|image| {
                to.save_screen(&screen.name, &image);
                false
            })
        });
        if let Some(recorder) = &mut self.recorder
            && let Err(error) = recorder.collect(device)
        {
            // What was recorded until then is kept.
            recorder.end();
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

/// Where it all goes: files to the host, messages to the notices.
pub struct Outlet<'a> {
    pub host: &'a mut dyn Host,
    pub notices: &'a mut Notices,
}

impl Outlet<'_> {
    /// Saves a scene as it is at a time \[s\].
    pub fn save_scene(&mut self, scene: &Scene, time: f64) {
        self.save(&file_name(&scene.name, time), "toml", scene.to_toml().as_bytes());
    }

    /// Saves a table about a scene at a time \[s\].
    pub fn save_table(&mut self, scene: &str, time: f64, name: &str, csv: &str) {
        self.save(&format!("{}-{name}", file_name(scene, time)), "csv", csv.as_bytes());
    }

    fn save_screen(&mut self, name: &str, image: &ColorImage) {
        let [width, height] = image.size.map(|it| it as u32);
        let pixels = image.pixels.iter().flat_map(|it| it.to_srgba_unmultiplied()).collect();
        match (Picture { width, height, pixels }).to_png() {
            Ok(content) => self.save(name, "png", &content),
            Err(error) => self.notices.complain(error),
        }
    }

    fn save_picture(&mut self, mut picture: Picture, scene: &str, time: f64) {
        stamp(&mut picture, &stamp_text(scene, time));
        match picture.to_png() {
            Ok(content) => self.save(&file_name(scene, time), "png", &content),
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
