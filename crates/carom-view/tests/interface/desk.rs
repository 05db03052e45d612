//! A window without a screen, for tests.

use std::time::Duration;

use carom_render::Quality;
use carom_scene::{Budget, Library, Source};
use carom_session::Command;
use carom_view::{App, Desktop, FilmMaker, Host, Inbox, Setup, Start, Watching};
use egui::DroppedFileHandle;
use egui_kittest::Harness;

pub type Desk = Harness<'static, App>;

/// Size of the window in points.
pub const SIZE: [f32; 2] = [1000.0, 620.0];

/// The cheapest quality: software drivers spend most of the time of these tests on shadows and
/// smooth edges. Such a desk has half a pixel per point, with the same layout.
const PLAIN: Quality = Quality { samples: 1, shadow_texels: 64, soft_shadows: false };

/// Setup of tests that do not depend on picture quality.
pub fn setup() -> Setup {
    Setup { quality: PLAIN, ..setup_for_pictures() }
}

/// Setup of tests that count pixels, without smooth edges.
pub fn setup_for_pixels() -> Setup {
    Setup { quality: Quality::DRAFT, ..setup_for_pictures() }
}

/// Setup of tests that compare pictures with approved ones.
pub fn setup_for_pictures() -> Setup {
    Setup {
        library: Library::new(),
        start: None,
        host: Box::new(Desktop::default()),
        quality: Quality::GOOD,
        // However slow the machine is, a frame does all that is due.
        inline_budget: Some(Duration::MAX),
        link_budget: Budget::LINK,
    }
}

/// A host without files and films, with these answers to what a page asks its browser.
#[derive(Default)]
pub struct PlainHost {
    pub has_coarse_pointer: bool,
    pub reduces_motion: bool,
}

impl Host for PlainHost {
    fn save(&mut self, _: &str, _: &str, _: &[u8]) -> Result<String, String> {
        Err("it keeps nothing".to_owned())
    }

    fn read(&mut self, _: &DroppedFileHandle, _: &Inbox) {}

    fn open_file(&mut self, _: &Inbox) {}

    fn begin_film(&mut self, _: &str, _: [u32; 2], _: u32) -> Result<Box<dyn FilmMaker>, String> {
        Err("it makes no films".to_owned())
    }

    fn has_coarse_pointer(&self) -> bool {
        self.has_coarse_pointer
    }

    fn reduces_motion(&self) -> bool {
        self.reduces_motion
    }
}

pub fn desk(setup: Setup) -> Desk {
    desk_of(SIZE, setup)
}

/// Opens a window with the chooser over the first scene.
pub fn choosing(setup: Setup) -> Desk {
    let mut desk = desk(setup);
    press(&mut desk, egui::Key::Enter);
    desk.run_steps(1);
    desk
}

/// Opens a window of this size in points.
pub fn desk_of(size: [f32; 2], setup: Setup) -> Desk {
    let mut desk = just_opened(size, setup);
    desk.run_steps(4);
    desk
}

/// Opens a window of this size in points and draws one frame.
pub fn just_opened(size: [f32; 2], setup: Setup) -> Desk {
    let pixels_per_point = if setup.quality == PLAIN { 0.5 } else { 1.0 };
    just_opened_in(size, pixels_per_point, setup)
}

/// Opens a window of this size in points for a picture in the repository, which has few pixels per
/// point so that it is small. With $CAROM_FINE it is as fine as on a screen, to be looked at; it
/// then matches no approved picture.
pub fn desk_for_picture(size: [f32; 2], pixels_per_point: f32, setup: Setup) -> Desk {
    let is_fine = std::env::var_os("CAROM_FINE").is_some();
    let mut desk = just_opened_in(size, if is_fine { 1.0 } else { pixels_per_point }, setup);
    desk.run_steps(4);
    desk
}

/// Opens a window that draws sixty frames a second, as a hand needs it.
pub fn quick_desk(setup: Setup) -> Desk {
    let builder = Harness::builder().with_size(SIZE).with_pixels_per_point(0.5);
    let builder = builder.with_max_steps(1).with_step_dt(1.0 / 60.0).wgpu();
    let mut desk = builder.build_eframe(|host| App::new(host, setup).expect("wgpu is there"));
    desk.run_steps(4);
    desk
}

fn just_opened_in(size: [f32; 2], pixels_per_point: f32, setup: Setup) -> Desk {
    let builder = Harness::builder().with_size(size).with_pixels_per_point(pixels_per_point);
    let builder = builder.with_max_steps(1).wgpu();
    builder.build_eframe(|host| App::new(host, setup).expect("wgpu is there"))
}

/// Opens a built-in scene.
pub fn watching(name: &str) -> Desk {
    watching_at(SIZE, name)
}

/// Opens a built-in scene in a window of this size in points.
pub fn watching_at(size: [f32; 2], name: &str) -> Desk {
    desk_of(size, Setup { start: start(name), ..setup() })
}

/// Opens a built-in scene with this setup.
pub fn watching_on(setup: Setup, name: &str) -> Desk {
    desk(Setup { start: start(name), ..setup })
}

/// Returns the start with a built-in scene.
pub fn start(name: &str) -> Option<Start> {
    let (scene, _) = Library::new().find(name, &[]).expect("a built-in scene");
    Some(Start::Scene(Box::new(scene), Source::BuiltIn))
}

/// Returns the watched scene.
pub fn scene(desk: &Desk) -> &Watching {
    desk.state().watching().expect("a scene is watched")
}

/// Seeks to a time \[s\] and waits for it.
pub fn go_to(desk: &mut Desk, time: f64) {
    desk.state_mut().command(Command::Seek(time));
    desk.run_steps(2);
    while scene(desk).view().seeking.is_some() {
        desk.run_steps(1);
    }
}

pub fn press(desk: &mut Desk, key: egui::Key) {
    desk.key_press(key);
    desk.run_steps(3);
}
