//! The program that hosts the interface: a desktop window, a web page, a test.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use carom_render::Picture;
use carom_scene::Source;
use carom_session::{LOCAL_PAGE, Link};
use egui::{Context, DroppedFileHandle, Vec2};

/// The program that hosts the interface. Error texts are for the user.
pub trait Host {
    /// Saves a file for the user as `name.ending`, or under a similar name if that is taken.
    /// Returns the name.
    ///
    /// # Errors
    /// If it cannot be written.
    fn save(&mut self, name: &str, ending: &str, content: &[u8]) -> Result<String, String>;

    /// Reads a dropped file into the inbox, now or later.
    fn read(&mut self, file: &DroppedFileHandle, inbox: &Inbox);

    /// Lets the user choose a file and reads it into the inbox, now or later.
    fn open_file(&mut self, inbox: &Inbox);

    /// Starts a film called `name` of pictures of this size in pixels.
    ///
    /// # Errors
    /// If films cannot be made here.
    fn begin_film(
        &mut self,
        name: &str,
        size: [u32; 2],
        frames_per_second: u32,
    ) -> Result<Box<dyn FilmMaker>, String>;

    /// Returns the address of the page that opens links, without `#`.
    fn page(&self) -> String {
        LOCAL_PAGE.to_owned()
    }

    /// Returns whether the host uses links to the present view.
    fn shows_links(&self) -> bool {
        false
    }

    /// Receives a link to the present view.
    fn show_link(&mut self, _link: &Link) {}

    /// Watches the file of a scene for changes, instead of the last file.
    fn watch(&mut self, _source: &Source) {}

    /// Returns the watched file once after it changed. `now` is the time by any clock \[s\].
    fn changed_file(&mut self, _now: f64) -> Option<PathBuf> {
        None
    }

    /// Returns the seconds until the next check for changes; `None` without a watched file.
    fn seconds_to_look(&self) -> Option<f64> {
        None
    }

    /// Returns an error of an action that was reported as done, once for each error.
    fn trouble(&mut self) -> Option<String> {
        None
    }

    /// Returns whether the interface is embedded in a document: panels are closed at first to save
    /// space.
    fn is_embedded(&self) -> bool {
        false
    }

    /// Returns whether the pointer is as coarse as a finger.
    fn has_coarse_pointer(&self) -> bool {
        false
    }

    /// Returns whether the user asked their system for little motion.
    fn reduces_motion(&self) -> bool {
        false
    }

    /// Returns the tilt by a gamepad's stick or a tilted device: right and down, each in \[-1, 1\].
    fn stick(&mut self) -> Option<Vec2> {
        None
    }

    /// Returns whether the user can tilt the device itself.
    fn offers_tilt(&self) -> bool {
        false
    }

    /// Switches on or off that [`Self::stick`] returns the tilt of the device.
    fn use_tilt(&mut self, _on: bool) {}
}

/// A film that is being written.
pub trait FilmMaker {
    /// Adds a picture as the frame with this number, from 0.
    ///
    /// # Errors
    /// If it cannot be added; the film can still be finished.
    fn add(&mut self, picture: &Picture, frame: u32) -> Result<(), String>;

    /// Completes the film. Returns its name.
    ///
    /// # Errors
    /// If it cannot be written.
    fn finish(self: Box<Self>) -> Result<String, String>;
}

/// Receives files that were opened or dropped.
#[derive(Debug, Clone, Default)]
pub struct Inbox {
    files: Arc<Mutex<Vec<ReadFile>>>,
    /// Redraws the interface when a file arrives.
    context: Context,
}

/// A file that was read, or the error.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReadFile {
    /// Path of the file; in a web page, its name alone.
    pub path: PathBuf,
    /// Content of the file.
    pub content: Result<Vec<u8>, String>,
}

impl ReadFile {
    /// Reads a file from the disk.
    pub fn from_disk(path: &Path) -> Self {
        let content = std::fs::read(path).map_err(|error| error.to_string());
        Self { path: path.to_owned(), content }
    }
}

impl Inbox {
    /// Makes an inbox for the interface of this context, which is redrawn when a file arrives.
    pub(crate) fn new(context: Context) -> Self {
        Self { files: Arc::default(), context }
    }

    /// Adds a file.
    pub fn put(&self, file: ReadFile) {
        if let Ok(mut files) = self.files.lock() {
            files.push(file);
        }
        self.context.request_repaint();
    }

    /// Removes and returns all files that have arrived.
    pub(crate) fn take(&self) -> Vec<ReadFile> {
        self.files.lock().map(|mut files| std::mem::take(&mut *files)).unwrap_or_default()
    }
}
