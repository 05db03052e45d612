//! A window without a screen, and what is done with it.

use carom_render::Quality;
use carom_scene::{Budget, Library, Source};
use carom_session::Command;
use carom_view::{App, Desktop, Setup, Start, Watching};
use egui_kittest::Harness;

pub type Desk = Harness<'static, App>;

/// In points; small, so that pictures kept in the repository are.
const SIZE: [f32; 2] = [1000.0, 620.0];

/// The cheapest there can be: drivers in software take most of the time of these tests for shadows and smooth edges. Such
/// a desk has half a pixel per point, which leaves the layout as it is.
const PLAIN: Quality = Quality { samples: 1, shadow_texels: 64, soft_shadows: false };

/// For what does not depend on how fine pictures are.
pub fn setup() -> Setup {
    Setup { quality: PLAIN, ..setup_for_pictures() }
}

/// For pictures whose pixels are counted, without smooth edges.
pub fn setup_for_pixels() -> Setup {
    Setup { quality: Quality::DRAFT, ..setup_for_pictures() }
}

/// For pictures that are compared with those that were looked at.
pub fn setup_for_pictures() -> Setup {
    Setup {
        library: Library::new(),
        start: None,
        host: Box::new(Desktop::default()),
        quality: Quality::GOOD,
        threaded: false,
        link_budget: Budget::LINK,
    }
}

pub fn desk(setup: Setup) -> Desk {
    desk_of(SIZE, setup)
}

/// A window of this size in points.
pub fn desk_of(size: [f32; 2], setup: Setup) -> Desk {
    let mut desk = just_opened(size, setup);
    desk.run_steps(4);
    desk
}

/// A window of this size in points that has shown one picture.
pub fn just_opened(size: [f32; 2], setup: Setup) -> Desk {
    let pixels_per_point = if setup.quality == PLAIN { 0.5 } else { 1.0 };
    let builder = Harness::builder().with_size(size).with_pixels_per_point(pixels_per_point);
    let builder = builder.with_max_steps(1).wgpu();
    builder.build_eframe(|host| App::new(host, setup).expect("wgpu is there"))
}

/// A desk on which a built-in scene is watched.
pub fn watching(name: &str) -> Desk {
    watching_at(SIZE, name)
}

/// A desk of this size in points on which a built-in scene is watched.
pub fn watching_at(size: [f32; 2], name: &str) -> Desk {
    desk_of(size, Setup { start: start(name), ..setup() })
}

/// A desk of this kind on which a built-in scene is watched.
pub fn watching_on(setup: Setup, name: &str) -> Desk {
    desk(Setup { start: start(name), ..setup })
}

/// Has a built-in scene watched at the start.
pub fn start(name: &str) -> Option<Start> {
    let (scene, _) = Library::new().find(name, &[]).expect("a built-in scene");
    Some(Start::Scene(Box::new(scene), Source::BuiltIn))
}

/// The scene that is watched.
pub fn scene(desk: &Desk) -> &Watching {
    desk.state().watching().expect("a scene is watched")
}

/// Goes to a time \[s\] and waits until it is there.
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
