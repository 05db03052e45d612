//! What a page gives the interface: downloads, films, the tilt of the device.

use std::cell::Cell;
use std::path::PathBuf;
use std::rc::Rc;
use std::sync::Arc;
use std::time::Duration;

use carom_render::Picture;
use carom_view::{FilmMaker, Host, Inbox, ReadFile};
use egui::{Context, DroppedFileHandle, Vec2};
use wasm_bindgen_futures::spawn_local;

use crate::services::{FilmService, Services, message};

/// How often to look whether a film is complete.
const FILM_INTERVAL: Duration = Duration::from_millis(100);

/// A page.
pub struct PageHost {
    services: Rc<Services>,
    context: Context,
    tilting: Rc<Cell<Tilting>>,
    /// Films that wait for their last frames to be encoded.
    films: Vec<Rc<FilmService>>,
}

/// How far it has come with the tilt of the device.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Tilting {
    Off,
    On,
    /// Asked for, and not to be had; nobody was told yet.
    Refused,
}

impl PageHost {
    /// A page with these services.
    pub fn new(services: Rc<Services>, context: Context) -> Self {
        let tilting = Rc::new(Cell::new(Tilting::Off));
        Self { services, context, tilting, films: Vec::new() }
    }
}

impl Host for PageHost {
    fn save(&mut self, name: &str, ending: &str, content: &[u8]) -> Result<String, String> {
        let kind = match ending {
            "png" => "image/png",
            _ => "application/toml",
        };
        let name = format!("{name}.{ending}");
        self.services.save(&name, kind, content);
        Ok(name)
    }

    fn read(&mut self, file: &DroppedFileHandle, inbox: &Inbox) {
        let (file, inbox, context) = (Arc::clone(file), inbox.clone(), self.context.clone());
        spawn_local(async move {
            let path = PathBuf::from(file.path());
            inbox.put(ReadFile { path, content: file.bytes_async().await });
            context.request_repaint();
        });
    }

    fn begin_film(
        &mut self,
        name: &str,
        [width, height]: [u32; 2],
        frames_per_second: u32,
    ) -> Result<Box<dyn FilmMaker>, String> {
        let film = self.services.begin_film(width, height, frames_per_second);
        let film = Rc::new(film.map_err(message)?);
        self.films.push(Rc::clone(&film));
        let seconds_per_frame = 1.0 / f64::from(frames_per_second);
        Ok(Box::new(PageFilm { film, name: name.to_owned(), seconds_per_frame }))
    }

    fn news(&mut self) -> Option<Result<String, String>> {
        if self.tilting.get() == Tilting::Refused {
            self.tilting.set(Tilting::Off);
            return Some(Err("This device does not tell how it is tilted.".to_owned()));
        }
        if self.films.is_empty() {
            return None;
        }
        self.context.request_repaint_after(FILM_INTERVAL);
        let news = |film: &FilmService| match film.error() {
            Some(error) => Some(Err(error)),
            None => film.saved().map(|name| Ok(format!("saved {name}"))),
        };
        let (place, news) =
            self.films.iter().enumerate().find_map(|(i, film)| Some((i, news(film)?)))?;
        self.films.remove(place);
        Some(news)
    }

    fn stick(&mut self) -> Option<Vec2> {
        if self.tilting.get() != Tilting::On {
            return None;
        }
        match self.services.tilt()?[..] {
            [right, up] => Some(Vec2::new(right, -up)),
            _ => None,
        }
    }

    fn offers_tilt(&self, context: &Context) -> bool {
        // What has no touch screen is seldom held in hands.
        context.input(|input| input.has_touch_screen())
    }

    fn use_tilt(&mut self, on: bool) {
        self.tilting.set(Tilting::Off);
        if !on {
            return;
        }
        let (services, tilting) = (Rc::clone(&self.services), Rc::clone(&self.tilting));
        let context = self.context.clone();
        spawn_local(async move {
            let tells = services.ask_for_tilt().await.is_truthy();
            tilting.set(if tells { Tilting::On } else { Tilting::Refused });
            context.request_repaint();
        });
    }
}

/// A film that the browser encodes.
struct PageFilm {
    film: Rc<FilmService>,
    name: String,
    /// \[s\]
    seconds_per_frame: f64,
}

impl FilmMaker for PageFilm {
    fn add(&mut self, picture: &Picture, frame: u32) -> Result<(), String> {
        let seconds = f64::from(frame) * self.seconds_per_frame;
        self.film.add(&picture.pixels, seconds).map_err(message)?;
        self.film.error().map_or(Ok(()), Err)
    }

    fn is_busy(&self) -> bool {
        self.film.busy()
    }

    fn finish(self: Box<Self>) -> Result<Option<String>, String> {
        // What follows the last point is taken for an ending.
        self.film.finish(&format!("{}.film", self.name));
        Ok(None)
    }
}
