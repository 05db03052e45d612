//! A web page as a host of the interface: downloads, films, the tilt of the device.

use std::path::PathBuf;
use std::sync::Arc;

use carom_render::Picture;
use carom_session::{LOCAL_PAGE, Link};
use carom_view::{FilmMaker, Host, Inbox, ReadFile};
use egui::{Context, DroppedFileHandle, Vec2};
use wasm_bindgen::JsCast;
use wasm_bindgen::closure::Closure;

use crate::services::{FilmService, Services, message};

/// A web page.
pub struct PageHost {
    services: Services,
    context: Context,
}

impl PageHost {
    /// Makes a host with the services of a page.
    pub fn new(services: Services, context: Context) -> Self {
        Self { services, context }
    }
}

impl Host for PageHost {
    fn save(&mut self, name: &str, ending: &str, content: &[u8]) -> Result<String, String> {
        let kind = match ending {
            "png" => "image/png",
            "csv" => "text/csv",
            _ => "application/toml",
        };
        let name = format!("{name}.{ending}");
        self.services.save(&name, kind, content);
        Ok(name)
    }

    fn read(&mut self, file: &DroppedFileHandle, inbox: &Inbox) {
        let (file, inbox, context) = (Arc::clone(file), inbox.clone(), self.context.clone());
        wasm_bindgen_futures::spawn_local(async move {
            let path = PathBuf::from(file.path());
            inbox.put(ReadFile { path, content: file.bytes_async().await });
            context.request_repaint();
        });
    }

    fn open_file(&mut self, inbox: &Inbox) {
        let (inbox, context) = (inbox.clone(), self.context.clone());
        let take = Closure::once_into_js(move |name: String, content: Vec<u8>| {
            inbox.put(ReadFile { path: PathBuf::from(name), content: Ok(content) });
            context.request_repaint();
        });
        self.services.open_file(take.unchecked_ref());
    }

    fn begin_film(
        &mut self,
        name: &str,
        [width, height]: [u32; 2],
        frames_per_second: u32,
    ) -> Result<Box<dyn FilmMaker>, String> {
        let film = self.services.begin_film(width, height, frames_per_second);
        Ok(Box::new(PageFilm { film: film.map_err(message)?, name: name.to_owned() }))
    }

    fn page(&self) -> String {
        if self.services.is_embedded() {
            return LOCAL_PAGE.to_owned();
        }
        let address = web_sys::window().and_then(|window| window.location().href().ok());
        let address = address.unwrap_or_else(|| LOCAL_PAGE.to_owned());
        address.split('#').next().unwrap_or_default().to_owned()
    }

    fn shows_links(&self) -> bool {
        true
    }

    fn show_link(&mut self, link: &Link) {
        self.services.show_fragment(&link.to_fragment());
    }

    fn is_embedded(&self) -> bool {
        self.services.is_embedded()
    }

    fn trouble(&mut self) -> Option<String> {
        self.services.trouble()
    }

    fn has_coarse_pointer(&self) -> bool {
        matches("(pointer: coarse)")
    }

    fn reduces_motion(&self) -> bool {
        matches("(prefers-reduced-motion: reduce)")
    }

    fn stick(&mut self) -> Option<Vec2> {
        match self.services.tilt()?[..] {
            [right, down] => Some(Vec2::new(right, down)),
            _ => None,
        }
    }

    fn offers_tilt(&self) -> bool {
        self.services.offers_tilt()
    }

    fn use_tilt(&mut self, on: bool) {
        self.services.use_tilt(on);
    }
}

/// A film that the browser encodes.
struct PageFilm {
    film: FilmService,
    name: String,
}

impl FilmMaker for PageFilm {
    fn add(&mut self, picture: &Picture, frame: u32) -> Result<(), String> {
        self.film.add(&picture.pixels, frame).map_err(message)
    }

    fn finish(self: Box<Self>) -> Result<String, String> {
        self.film.finish(&self.name).map_err(message)
    }
}

/// Returns whether a media query holds for the page.
fn matches(query: &str) -> bool {
    let query = web_sys::window().and_then(|it| it.match_media(query).ok());
    query.flatten().is_some_and(|query| query.matches())
}
