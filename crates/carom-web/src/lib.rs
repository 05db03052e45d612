//! Hosts the interface of Carom in a web page.
//!
//! The page's script makes a `Page` on a canvas and passes it services that only a page has:
//! downloads, films, the tilt of the device, the address bar (listed in `services.rs`). Scripts can
//! read the state of the interface as data (`Page::status`, `Page::widgets`) and control the scene
//! (`commands.rs`).

#![cfg(target_arch = "wasm32")]

mod commands;
mod page_host;
mod services;
mod status;
mod version;
mod widgets;

use std::cell::{OnceCell, RefCell};
use std::rc::Rc;
use std::time::Duration;

use carom_render::Quality;
use carom_render::wgpu::Backend;
use carom_scene::{Budget, Library};
use carom_session::Link;
use carom_view::{App, Setup, Start};
use eframe::{CreationContext, WebOptions, WebRunner};
use egui::accesskit::ActionData;
use egui::{Context, Ui};
use wasm_bindgen::prelude::*;
use web_sys::HtmlCanvasElement;

use crate::page_host::PageHost;
use crate::services::Services;
use crate::status::Status;
use crate::version::Version;
use crate::widgets::Widgets;

/// Longest time for the physics in a frame: a page has one thread.
const FRAME_BUDGET: Duration = Duration::from_millis(20);

/// The interface in the canvas of a web page.
#[wasm_bindgen]
pub struct Page {
    app: Rc<RefCell<App>>,
    context: Context,
    graphics: &'static str,
    /// Names of all scenes, filled when a script first reads them.
    scenes: OnceCell<Vec<String>>,
    /// Version of the watched scene for scripts.
    version: Version,
    /// Runs the interface as long as it exists.
    runner: WebRunner,
}

/// Parts of a page that exist once there is a graphics device.
struct Started {
    app: Rc<RefCell<App>>,
    context: Context,
    graphics: &'static str,
}

#[wasm_bindgen]
impl Page {
    /// Starts the interface on a canvas with the run in `fragment`, the part of the address after
    /// `#`.
    ///
    /// # Errors
    /// An `Error` with a message for the user if the browser cannot draw.
    pub async fn start(
        canvas: HtmlCanvasElement,
        services: Services,
        fragment: String,
    ) -> Result<Page, JsError> {
        let started = Rc::new(RefCell::new(None));
        let runner = WebRunner::new();
        let options = WebOptions { renderer: eframe::Renderer::Wgpu, ..Default::default() };
        let result = Rc::clone(&started);
        let create: eframe::AppCreator<'static> = Box::new(move |host| {
            let start = started_on(host, services, &fragment)?;
            let app = Box::new(SharedApp(Rc::clone(&start.app)));
            *result.borrow_mut() = Some(start);
            Ok(app)
        });
        runner.start(canvas, options, create).await.map_err(|error| {
            let text = error.as_string().unwrap_or_else(|| format!("{error:?}"));
            JsError::new(&text)
        })?;
        let started = started.borrow_mut().take();
        let Started { app, context, graphics } =
            started.ok_or_else(|| JsError::new("the interface did not start"))?;
        let (scenes, version) = (OnceCell::new(), Version::default());
        Ok(Self { app, context, graphics, scenes, version, runner })
    }

    /// Opens the run in the part of an address after `#`; the interface shows an error if it
    /// cannot.
    #[wasm_bindgen(js_name = openFragment)]
    pub fn open_fragment(&self, fragment: &str) {
        if let Ok(mut app) = self.app.try_borrow_mut() {
            follow(&mut app, fragment);
            self.context.request_repaint();
        }
    }

    /// Returns the state of the interface as plain data; see `status.rs` for its fields.
    /// `undefined` while a frame is being drawn.
    pub fn status(&self) -> JsValue {
        let Ok(app) = self.app.try_borrow() else { return JsValue::UNDEFINED };
        // A page has no folders, so the list of scenes never changes.
        let scenes = self.scenes.get_or_init(|| status::scenes(&app));
        let version = self.version.of(&app);
        let status = Status::of(&app, scenes, version, &self.context, self.graphics);
        parsed(serde_json::to_string(&status))
    }

    /// Returns a sentence about the hardest impact of the watched scene after a time \[s\]; `undefined`
    /// without one, and while a frame is being drawn.
    #[wasm_bindgen(js_name = hardestImpactAfter)]
    pub fn hardest_impact_after(&self, time: f64) -> Option<String> {
        self.app.try_borrow().ok()?.watching()?.hardest_impact_after(time)
    }

    /// Returns every labelled control as last drawn: role, label, value, and position in CSS
    /// pixels. The first call returns an empty list and starts the recording.
    pub fn widgets(&self) -> JsValue {
        parsed(serde_json::to_string(&Widgets::shown(&self.context)))
    }

    /// Presses the control with this id from `widgets`, in the next frame.
    pub fn press(&self, id: &str) {
        Widgets::ask(&self.context, id, None);
    }

    /// Sets the number of the control with this id, in the next frame.
    #[wasm_bindgen(js_name = setNumber)]
    pub fn set_number(&self, id: &str, value: f64) {
        Widgets::ask(&self.context, id, Some(ActionData::NumericValue(value)));
    }

    /// Sets the text of the field with this id, in the next frame.
    #[wasm_bindgen(js_name = setText)]
    pub fn set_text(&self, id: &str, text: &str) {
        Widgets::ask(&self.context, id, Some(ActionData::Value(text.into())));
    }
}

fn parsed(json: serde_json::Result<String>) -> JsValue {
    json.ok().and_then(|text| js_sys::JSON::parse(&text).ok()).unwrap_or_default()
}

fn started_on(
    host: &CreationContext,
    services: Services,
    fragment: &str,
) -> Result<Started, String> {
    let context = host.egui_ctx.clone();
    let backend = host.wgpu_render_state.as_ref().map(|state| state.adapter.get_info().backend);
    let graphics = if backend == Some(Backend::BrowserWebGpu) { "WebGPU" } else { "WebGL2" };
    let spheres = services.max_spheres().map_or(Budget::LINK.spheres, |most| most as u64);
    let spheres = spheres.clamp(1, Budget::MOST.spheres);
    let (start, refusal) = match Link::parse(fragment) {
        _ if fragment.is_empty() => (None, None),
        Ok(link) => (Some(Start::Link(Box::new(link))), None),
        Err(error) => (None, Some(error.to_string())),
    };
    let setup = Setup {
        library: Library::new(),
        start,
        host: Box::new(PageHost::new(services, context.clone())),
        quality: Quality::default(),
        inline_budget: Some(FRAME_BUDGET),
        link_budget: Budget { spheres, ..Budget::LINK },
    };
    let mut app = App::new(host, setup)?;
    if let Some(why) = refusal {
        app.refuse_link(&why);
    }
    let app = Rc::new(RefCell::new(app));
    Ok(Started { app, context, graphics })
}

fn follow(app: &mut App, fragment: &str) {
    match Link::parse(fragment) {
        Ok(link) => app.follow(&link),
        Err(error) => app.refuse_link(&error.to_string()),
    }
}

/// The interface, shared with the page, which reads it between two frames.
struct SharedApp(Rc<RefCell<App>>);

impl eframe::App for SharedApp {
    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        self.0.borrow_mut().save(storage);
    }

    fn auto_save_interval(&self) -> std::time::Duration {
        self.0.borrow().auto_save_interval()
    }

    fn ui(&mut self, ui: &mut Ui, frame: &mut eframe::Frame) {
        self.0.borrow_mut().ui(ui, frame);
    }
}
