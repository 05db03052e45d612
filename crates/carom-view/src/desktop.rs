//! The desktop as a host of the interface: files in folders, films, gamepads.

use std::io;
use std::path::{Path, PathBuf};

use carom_scene::Source;
use carom_session::LOCAL_PAGE;
use egui::DroppedFileHandle;

use crate::host::{FilmMaker, Host, Inbox, ReadFile};
use crate::watched_file::{INTERVAL, WatchedFile};

/// The desktop, with the folder for pictures and films.
#[derive(Default)]
pub struct Desktop {
    folder: PathBuf,
    page: Option<String>,
    watched_file: WatchedFile,
    #[cfg(feature = "gamepad")]
    gamepad: crate::gamepad::Gamepad,
}

/// Returns the default folder for pictures: `Pictures/carom` in the user's home folder, or in the
/// current folder if there is no home folder.
pub fn default_folder() -> PathBuf {
    let home = std::env::var_os("HOME").or_else(|| std::env::var_os("USERPROFILE"));
    home.map(PathBuf::from).unwrap_or_default().join("Pictures").join("carom")
}

impl Desktop {
    /// Returns a desktop that saves pictures and films in this folder, which is created when
    /// needed.
    pub fn new(folder: PathBuf) -> Self {
        Self { folder, ..Self::default() }
    }

    /// Returns this host with another address of the page that opens links.
    pub fn with_page(self, page: String) -> Self {
        Self { page: Some(page), ..self }
    }

    /// Returns an unused path in the folder, with a number if the plain name is taken.
    fn new_path(&self, name: &str, ending: &str) -> PathBuf {
        let first = self.folder.join(format!("{name}.{ending}"));
        let more = (2..).map(|number| self.folder.join(format!("{name}-{number}.{ending}")));
        std::iter::once(first).chain(more).find(|path| !path.exists()).unwrap_or_default()
    }
}

/// Writes a file and creates its folder if it is missing.
fn write(folder: &Path, path: &Path, content: &[u8]) -> io::Result<()> {
    std::fs::create_dir_all(folder)?;
    std::fs::write(path, content)
}

impl Host for Desktop {
    fn save(&mut self, name: &str, ending: &str, content: &[u8]) -> Result<String, String> {
        let path = self.new_path(name, ending);
        let written = write(&self.folder, &path, content);
        let shown = path.display().to_string();
        written.map_err(|error| format!("cannot write {shown}: {error}")).map(|()| shown)
    }

    fn read(&mut self, file: &DroppedFileHandle, inbox: &Inbox) {
        inbox.put(ReadFile { path: file.path().to_owned(), content: file.bytes() });
    }

    fn open_file(&mut self, inbox: &Inbox) {
        let dialog = rfd::AsyncFileDialog::new().add_filter("Scenes and mazes", &["toml", "txt"]);
        let (picked, inbox) = (dialog.pick_file(), inbox.clone());
        // A thread of its own, so that the window responds while the user chooses.
        std::thread::spawn(move || {
            if let Some(file) = pollster::block_on(picked) {
                inbox.put(ReadFile::from_disk(file.path()));
            }
        });
    }

    #[cfg(not(feature = "film"))]
    fn begin_film(
        &mut self,
        _name: &str,
        _size: [u32; 2],
        _frames_per_second: u32,
    ) -> Result<Box<dyn FilmMaker>, String> {
        Err("this build of Carom makes no films".to_owned())
    }

    #[cfg(feature = "film")]
    fn begin_film(
        &mut self,
        name: &str,
        [width, height]: [u32; 2],
        frames_per_second: u32,
    ) -> Result<Box<dyn FilmMaker>, String> {
        let path = self.new_path(name, "mp4");
        let film = carom_render::Film::create(&path, width, height, frames_per_second);
        let film = film.map_err(|error| error.to_string())?;
        Ok(Box::new(film::FilmFile { film, path }))
    }

    fn page(&self) -> String {
        self.page.clone().unwrap_or_else(|| LOCAL_PAGE.to_owned())
    }

    fn watch(&mut self, source: &Source) {
        self.watched_file.watch(source);
    }

    fn changed_file(&mut self, now: f64) -> Option<PathBuf> {
        self.watched_file.changed(now)
    }

    fn seconds_to_look(&self) -> Option<f64> {
        self.watched_file.is_any().then_some(INTERVAL)
    }

    #[cfg(feature = "gamepad")]
    fn stick(&mut self) -> Option<egui::Vec2> {
        self.gamepad.stick()
    }
}

#[cfg(feature = "film")]
mod film {
    use std::path::PathBuf;

    use carom_render::{Film, Picture};

    use crate::host::FilmMaker;

    /// A film that is written to a file.
    pub struct FilmFile {
        pub film: Film,
        pub path: PathBuf,
    }

    impl FilmMaker for FilmFile {
        fn add(&mut self, picture: &Picture, _frame: u32) -> Result<(), String> {
            self.film.add(picture).map_err(|error| error.to_string())
        }

        fn finish(self: Box<Self>) -> Result<String, String> {
            self.film.finish().map_err(|error| error.to_string())?;
            Ok(self.path.display().to_string())
        }
    }
}
