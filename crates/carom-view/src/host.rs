//! What the interface needs of the program it runs in: a window of the desktop, a page, a test.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use carom_render::Picture;
use carom_scene::Source;
use carom_session::{LOCAL_PAGE, Link};
use egui::{Context, DroppedFileHandle, Vec2};

/// The program that the interface runs in. Texts of errors are for people.
pub trait Host {
    /// Keeps a file for the user, called `name.ending` or, if there is one already, something
    /// similar. Returns what it is called.
    ///
    /// # Errors
    /// If it cannot be written.
    fn save(&mut self, name: &str, ending: &str, content: &[u8]) -> Result<String, String>;

    /// Reads a file that was dropped, now or later, into the inbox.
    fn read(&mut self, file: &DroppedFileHandle, inbox: &Inbox);

    /// Asks the user for a file, which is read, now or later, into the inbox.
    fn open_file(&mut self, inbox: &Inbox);

    /// Begins a film called `name` of pictures of this size in pixels.
    ///
    /// # Errors
    /// If films cannot be made here.
    fn begin_film(
        &mut self,
        name: &str,
        size: [u32; 2],
        frames_per_second: u32,
    ) -> Result<Box<dyn FilmMaker>, String>;

    /// Address of the page that opens links, without `#`.
    fn page(&self) -> String {
        LOCAL_PAGE.to_owned()
    }

    /// Whether links to what is shown are of use.
    fn shows_links(&self) -> bool {
        false
    }

    /// A link to what is shown.
    fn show_link(&mut self, _link: &Link) {}

    /// Watches the file that a scene comes from, if it does come from one, instead of the last.
    fn watch(&mut self, _source: &Source) {}

    /// The watched file, once, if it was changed since the last call; `now` by any clock
    /// \[s\].
    fn changed_file(&mut self, _now: f64) -> Option<PathBuf> {
        None
    }

    /// After how many seconds to look for a changed file again; `None` without one.
    fn seconds_to_look(&self) -> Option<f64> {
        None
    }

    /// What went wrong after it was said to be done: returns each once.
    fn trouble(&mut self) -> Option<String> {
        None
    }

    /// Whether it is a part of some document, with little room: panels are closed at first.
    fn is_embedded(&self) -> bool {
        false
    }

    /// Whether it is pointed with something as coarse as a finger.
    fn has_coarse_pointer(&self) -> bool {
        false
    }

    /// Right and down by a gamepad's stick or a tilted device, each in \[-1, 1\].
    fn stick(&mut self) -> Option<Vec2> {
        None
    }

    /// Whether the user can tilt the device itself.
    fn offers_tilt(&self) -> bool {
        false
    }

    /// Begins or ends to tell the tilt of the device by [`Self::stick`].
    fn use_tilt(&mut self, _on: bool) {}
}

/// A film in the making.
pub trait FilmMaker {
    /// Adds a picture as the frame with this number, from 0 on.
    ///
    /// # Errors
    /// If it cannot be added; the film can still be finished.
    fn add(&mut self, picture: &Picture, frame: u32) -> Result<(), String>;

    /// Completes the film. Returns what it is called.
    ///
    /// # Errors
    /// If it cannot be written.
    fn finish(self: Box<Self>) -> Result<String, String>;
}

/// Where files arrive that were dropped on the interface.
#[derive(Debug, Clone, Default)]
pub struct Inbox {
    files: Arc<Mutex<Vec<ReadFile>>>,
    /// Draws anew when a file arrives.
    context: Context,
}

/// A file that was read, or why it could not be.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReadFile {
    /// Where it was; in a page, its name alone.
    pub path: PathBuf,
    /// What is in it.
    pub content: Result<Vec<u8>, String>,
}

impl ReadFile {
    /// Reads a file of the disk.
    pub fn from_disk(path: &Path) -> Self {
        let content = std::fs::read(path).map_err(|error| error.to_string());
        Self { path: path.to_owned(), content }
    }
}

impl Inbox {
    /// Of this interface, which is drawn anew when a file arrives.
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

    /// Takes out all files that have arrived.
    pub(crate) fn take(&self) -> Vec<ReadFile> {
        self.files.lock().map(|mut files| std::mem::take(&mut *files)).unwrap_or_default()
    }
}
