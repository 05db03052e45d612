//! Pictures and scenes are saved; dropped, changed and broken files are handled.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use carom_render::Picture;
use carom_scene::scene::Scene;
use carom_scene::{Library, Source};
use carom_session::{Link, LinkSource};
use carom_view::{Desktop, Setup, Start};
use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable;

use crate::desk::{Desk, choosing, desk, go_to, press, scene, setup, watching};

const BALL: &str = "name = \"one\"\n[[spheres]]\nradius = 0.5\n";

#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}

fn pictures_in(folder: &Path) -> Box<Desktop> {
    Box::new(Desktop::new(folder.to_owned()))
}

fn drop_file(desk: &mut Desk, path: &Path) {
    desk.input_mut().dropped_files = vec![Arc::new(Dropped(path.to_owned()))];
    desk.run_steps(4);
}

fn only_file(folder: &Path, ending: &str) -> PathBuf {
    let files = std::fs::read_dir(folder).expect("the folder was made");
    let mut files = files.map(|it| it.expect("readable").path());
    let file = files.find(|path| path.extension().is_some_and(|it| it == ending));
    file.expect("a file was saved")
}

/// Counts pixels of the part that differ much from the pixel to their left: text has such edges, an
/// empty sky has none.
fn edges(picture: &Picture, columns: std::ops::Range<u32>, rows: std::ops::Range<u32>) -> usize {
    let at = |x: u32, y: u32| {
        let first = 4 * (y * picture.width + x) as usize;
        picture.pixels[first..first + 3].iter().map(|it| i32::from(*it)).sum::<i32>()
    };
    let is_edge = |x: u32, y: u32| (at(x, y) - at(x - 1, y)).abs() > 90;
    rows.flat_map(|y| columns.clone().map(move |x| (x, y))).filter(|(x, y)| is_edge(*x, *y)).count()
}

#[test]
fn space_saves_a_stamped_picture_in_a_folder_that_was_missing() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path().join("not").join("there");
    let (tutorial, _) = Library::new().find("tutorial1", &[]).expect("a built-in scene");
    let start = Some(Start::Scene(Box::new(tutorial), Source::BuiltIn));
    let mut desk = desk(Setup { start, host: pictures_in(&folder), ..setup() });
    press(&mut desk, Key::Space);
    let file = only_file(&folder, "png");
    let picture = Picture::from_png(&std::fs::read(file).expect("readable")).expect("a picture");
    assert_eq!([picture.width, picture.height], [1280, 720]);
    let band = 660..715;
    assert!(edges(&picture, 2..300, band.clone()) > 100, "the time stands at the lower left");
    assert_eq!(edges(&picture, 900..1279, band), 0, "and nothing at the lower right");
}

#[test]
fn a_folder_that_cannot_be_made_is_told() {
    let file = tempfile::NamedTempFile::new().expect("a file");
    let (tutorial, _) = Library::new().find("tutorial1", &[]).expect("a built-in scene");
    let start = Some(Start::Scene(Box::new(tutorial), Source::BuiltIn));
    let folder = file.path().join("below a file");
    let mut desk = desk(Setup { start, host: pictures_in(&folder), ..setup() });
    press(&mut desk, Key::Space);
    assert!(desk.state().notices().any_error());
    press(&mut desk, Key::Period);
    assert_eq!(scene(&desk).view().frame, 1, "the scene goes on");
}

#[test]
fn the_present_is_saved_as_a_scene_that_opens_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let (tutorial, _) = Library::new().find("tutorial1", &[]).expect("a built-in scene");
    let start = Some(Start::Scene(Box::new(tutorial), Source::BuiltIn));
    let mut desk = desk(Setup { start, host: pictures_in(folder.path()), ..setup() });
    go_to(&mut desk, 1.0);
    desk.key_press_modifiers(egui::Modifiers::COMMAND, Key::S);
    desk.run_steps(3);
    let saved = Scene::from_file(&only_file(folder.path(), "toml"), &[]).expect("a scene");
    let world = saved.world().expect("it makes sense");
    assert_eq!(world.spheres().positions(), scene(&desk).view().spheres.positions);
}

#[test]
fn a_dropped_scene_opens_and_a_broken_one_is_told_with_its_line() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut desk = watching("simtest1");
    let broken = folder.path().join("broken.toml");
    std::fs::write(&broken, "name = \"broken\"\n[[spheres]]\nradus = 1.0\n").expect("written");
    drop_file(&mut desk, &broken);
    assert!(desk.query_by_label_contains("broken.toml:3").is_some());
    assert_eq!(scene(&desk).view().scene.name, "simtest1", "nothing is lost");
    press(&mut desk, Key::Period);
    assert_eq!(scene(&desk).view().frame, 1);

    let good = folder.path().join("one.toml");
    std::fs::write(&good, BALL).expect("written");
    drop_file(&mut desk, &good);
    assert_eq!(scene(&desk).view().scene.name, "one");
    assert!(!desk.state().notices().any_error());
}

#[test]
fn a_dropped_photo_is_told_to_be_one() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut desk = watching("simtest1");
    for name in ["photo.jpg", "photo.toml", "photo.txt"] {
        let photo = folder.path().join(name);
        std::fs::write(&photo, b"\xff\xd8\xff\xe0\0\x10JFIF\0").expect("written");
        drop_file(&mut desk, &photo);
        let told = format!("{name}: it begins like a JPEG picture, and is not text");
        assert!(desk.query_by_label_contains(&told).is_some(), "{name}");
    }
    assert_eq!(scene(&desk).view().scene.name, "simtest1", "nothing is lost");
}

#[test]
fn a_broken_scene_in_the_chooser_says_what_is_wrong() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("broken.toml"), "name = 3\n").expect("written");
    let mut library = Library::new();
    library.add_folder(folder.path()).expect("readable");
    let mut desk = choosing(Setup { library, ..setup() });
    assert!(desk.query_by_label_contains("broken.toml:1").is_some());
    press(&mut desk, Key::Enter);
    desk.get_by_label("Choose a scene");
}

#[test]
fn a_scene_changed_on_the_disk_is_read_anew() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("one.toml");
    std::fs::write(&path, BALL).expect("written");
    let one = Scene::from_file(&path, &[]).expect("a scene");
    let start = Some(Start::Scene(Box::new(one), Source::File(path.clone())));
    let mut desk = desk(Setup { start, ..setup() });
    // A file system may count time in steps of some milliseconds.
    std::thread::sleep(std::time::Duration::from_millis(50));
    std::fs::write(&path, BALL.replace("0.5", "0.75")).expect("written");
    desk.run_steps(90);
    assert_eq!(scene(&desk).view().spheres.radii, [0.75]);
    std::thread::sleep(std::time::Duration::from_millis(50));
    std::fs::write(&path, "name = ").expect("written");
    desk.run_steps(90);
    assert!(desk.state().notices().any_error());
    assert_eq!(scene(&desk).view().spheres.radii, [0.75], "what was there stays");
}

/// A file with two named numbers.
const NAMED: &str = "[parameters]\ncount = 3\nr = 0.25\nd = \"=2*r\"\n
    [[generators]]\n[generators.row]\ncount = \"=count\"\nstart = [0, 0, 0]\n\
    step = [\"=d\", 0, 0]\nsphere = { radius = \"=r\" }\n";

#[test]
fn parameters_of_a_file_are_changed_in_the_inspector_and_stay_in_links() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("row.toml");
    std::fs::write(&path, NAMED).expect("written");
    let row = Scene::from_file(&path, &[]).expect("a scene");
    let start = Some(Start::Scene(Box::new(row), Source::File(path.clone())));
    let mut first = desk(Setup { start, ..setup() });
    first.get_by_label("Parameters");
    for (name, value, radii) in
        [("r", "1", vec![1.0; 3]), ("r", "0.5", vec![0.5; 3]), ("count", "5", vec![0.5; 5])]
    {
        first.get_by_role_and_label(Role::SpinButton, name).click();
        first.run_steps(3);
        first.event(egui::Event::Text(value.to_owned()));
        press(&mut first, Key::Enter);
        first.run_steps(3);
        assert_eq!(scene(&first).view().spheres.radii, radii);
    }
    assert_eq!(scene(&first).view().spheres.positions[1].x, 1.0, "formulas follow");
    // The link holds the text of the file, not its path, and the changed values.
    press(&mut first, Key::U);
    first.get_by_label("Copy the link").click();
    first.run_steps(1);
    let link = crate::links::copied_text(&first).expect("something was copied");
    let link = Link::parse(&link).expect("a link");
    let LinkSource::File { name, text } = link.source() else { panic!("{link}") };
    assert_eq!((name.as_str(), text.as_str()), ("row.toml", NAMED));
    let changed: Vec<_> = link.overrides().iter().map(ToString::to_string).collect();
    assert_eq!(changed, ["parameters.r=0.5", "parameters.count=5"]);
    // A click without a change restarts nothing.
    press(&mut first, Key::Escape);
    go_to(&mut first, 0.5);
    first.get_by_role_and_label(Role::SpinButton, "r").click();
    first.run_steps(3);
    press(&mut first, Key::Enter);
    first.run_steps(3);
    assert!(scene(&first).view().time > 0.4);
    // Where the link is opened, the values can be changed further.
    let mut again = desk(Setup { start: Some(Start::Link(Box::new(link))), ..setup() });
    again.run_steps(4);
    again.get_by_label("Parameters");
    assert_eq!(scene(&again).view().spheres.radii, [0.5; 5]);
    // An invalid value changes nothing and causes a notice.
    again.get_by_role_and_label(Role::SpinButton, "r").click();
    again.run_steps(3);
    again.event(egui::Event::Text("-1".to_owned()));
    press(&mut again, Key::Enter);
    again.run_steps(3);
    assert!(again.state().notices().any_error());
    assert_eq!(scene(&again).view().spheres.radii, [0.5; 5]);
}

#[test]
fn a_file_that_is_recent_and_in_a_folder_of_scenes_is_listed_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("one.toml");
    std::fs::write(&path, BALL).expect("written");
    let mut library = Library::new();
    library.add_folder(folder.path()).expect("readable");
    let mut desk = desk(Setup { library, ..setup() });
    press(&mut desk, Key::Escape);
    let one = Scene::from_file(&path, &[]).expect("a scene");
    desk.state_mut().watch(one, Source::File(path));
    desk.run_steps(2);
    press(&mut desk, Key::Enter);
    desk.get_by_label("Recent");
    assert_eq!(desk.query_all_by_role_and_label(Role::Button, "one").count(), 1);
    assert!(desk.query_by_label("Your scenes").is_none());
}

#[test]
fn a_path_that_is_typed_in_the_chooser_opens_and_is_found_under_recent() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("mine.toml");
    std::fs::write(&path, BALL).expect("written");
    let mut desk = choosing(setup());
    desk.event(egui::Event::Text(path.display().to_string()));
    desk.run_steps(3);
    press(&mut desk, Key::Enter);
    desk.run_steps(3);
    assert_eq!(scene(&desk).view().scene.name, "one");
    press(&mut desk, Key::Enter);
    desk.get_by_label("Recent");
    // The recent file comes first.
    press(&mut desk, Key::Enter);
    assert_eq!(scene(&desk).view().scene.name, "one");
    // A file that is gone is no longer offered.
    std::fs::remove_file(&path).expect("removed");
    press(&mut desk, Key::Enter);
    assert!(desk.query_by_label("Recent").is_none());
}
