//! What the desktop gives the interface: files in folders, films, gamepads.

use std::io;
use std::path::{Path, PathBuf};

use carom_scene::Source;
use carom_session::LOCAL_PAGE;
use egui::DroppedFileHandle;

use crate::host::{FilmMaker, Host, Inbox, ReadFile};
use crate::watched_file::{INTERVAL, WatchedFile};

/// A desktop, with the folder that pictures and films go to.
#[derive(Default)]
pub struct Desktop {
    folder: PathBuf,
    page: Option<String>,
    watched_file: WatchedFile,
    #[cfg(feature = "gamepad")]
    gamepad: crate::gamepad::Gamepad,
}

/// The default folder for pictures: `Pictures/carom` in the user's own folder,
/// the present folder without one.
pub fn default_folder() -> PathBuf {
    let home = std::env::var_os("HOME").or_else(|| std::env::var_os("USERPROFILE"));
    home.map(PathBuf::from).unwrap_or_default().join("Pictures").join("carom")
}

impl Desktop {
    /// A desktop whose pictures and films go to this folder, which is made when there are any.
    pub fn new(folder: PathBuf) -> Self {
        Self { folder, ..Self::default() }
    }

    /// This host, with this address of the page that opens links.
    pub fn with_page(self, page: String) -> Self {
        Self { page: Some(page), ..self }
    }

    /// A path in the folder that no file has yet: with a number where needed.
    fn new_path(&self, name: &str, ending: &str) -> PathBuf {
        let first = self.folder.join(format!("{name}.{ending}"));
        let more = (2..).map(|number| self.folder.join(format!("{name}-{number}.{ending}")));
        std::iter::once(first).chain(more).find(|path| !path.exists()).unwrap_or_default()
    }
}

/// Writes a file in a folder that may be missing.
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
        // The window goes on while the user chooses.
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

    /// A film in a file.
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
