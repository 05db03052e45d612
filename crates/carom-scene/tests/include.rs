//! Included scene files: the merged scene, and the places of errors.

use std::fs;
use std::path::{Path, PathBuf};

use carom_scene::{Budget, ChangedFile, Scene, SceneText};
use tempfile::TempDir;

/// Writes files with these names and texts to a new folder.
fn folder(files: &[(&str, &str)]) -> TempDir {
    let folder = TempDir::new().unwrap();
    for (name, text) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    folder
}

fn refusal(path: &Path) -> String {
    Scene::from_file(path, &[]).unwrap_err().to_string()
}

const FLOOR: &str = "title = 'A floor'\n[parameters]\nwidth = 4\nhalf = '=width / 2'\n\
                     [simulation]\nframe_time = 0.02\nrule = 'contact'\n\
                     [[colliders]]\nname = 'floor'\nshape = 'half-space'\n\
                     [[colliders]]\nname = 'wall'\nposition = ['=half', 0, 0]\n\
                     shape = { box = { size = [1, 1, 1] } }\n";
const BALLS: &str = "include = '../floor.toml'\n[parameters]\nwidth = 6\n\
                     [simulation]\nframe_time = 0.01\n\
                     [[colliders]]\nname = 'own'\nposition = ['=half', 5, 0]\n\
                     shape = { sphere = { radius = 0.1 } }\n\
                     [[spheres]]\nposition = [0, 1, 0]\nradius = 0.5\n";

fn scene_in(folder: &TempDir) -> PathBuf {
    folder.path().join("scenes/balls.toml")
}

#[test]
fn what_is_included_comes_first_and_own_values_count() {
    let folder = folder(&[("floor.toml", FLOOR), ("scenes/balls.toml", BALLS)]);
    let scene = Scene::from_file(&scene_in(&folder), &[]).unwrap();
    assert_eq!((&*scene.name, &*scene.title), ("balls", ""));
    let names: Vec<_> = scene.colliders.iter().map(|it| &*it.name).collect();
    assert_eq!(names, ["floor", "wall", "own"]);
    // Formulas of the included file use the parameters of the including file.
    assert_eq!(scene.colliders[1].position[0], 3.0);
    assert_eq!(scene.simulation.frame_time, 0.01);
    assert_eq!(scene.simulation.rule, carom_scene::scene::Rule::Contact);
    let changed = Scene::from_file(&scene_in(&folder), &["width=2".parse().unwrap()]).unwrap();
    assert_eq!(changed.colliders[1].position[0], 1.0);
}

#[test]
fn one_text_says_what_all_files_say() {
    let folder = folder(&[("floor.toml", FLOOR), ("scenes/balls.toml", BALLS)]);
    let text = SceneText::from_file(&scene_in(&folder)).unwrap();
    let whole = SceneText::new(&text.whole(), "whole.toml").unwrap();
    let overrides = ["width=3".parse().unwrap()];
    assert_eq!(whole.scene(&overrides).unwrap(), text.scene(&overrides).unwrap());
    assert_eq!(whole.parameters(&[]).unwrap(), text.parameters(&[]).unwrap());
    // The text of a single file is returned as its author wrote it.
    let floor = SceneText::from_file(&folder.path().join("floor.toml")).unwrap();
    assert_eq!(floor.whole(), FLOOR);
}

#[test]
fn a_mistake_is_told_with_the_file_and_line_where_it_is() {
    let with = |floor: &str, balls: &str| {
        let folder = folder(&[("floor.toml", floor), ("scenes/balls.toml", balls)]);
        let told = refusal(&scene_in(&folder));
        let part = told.strip_prefix(&format!("{}/", folder.path().display()));
        part.unwrap_or(&told).to_owned()
    };
    let included = "scenes/../floor.toml";
    for (wrong, word, expected) in [
        ("shape = 'half-plane'", "shape = 'half-space'", "10: colliders[0].shape: unknown variant"),
        (
            "position = ['=halve', 0, 0]",
            "position = ['=half', 0, 0]",
            "13: colliders[1].position[0]:",
        ),
        ("frame_tim = 0.02", "frame_time = 0.02", "6: simulation.frame_tim: unknown field"),
        ("half = width", "half = '=width / 2'", "4: "),
    ] {
        let told = with(&FLOOR.replace(word, wrong), BALLS);
        assert!(told.starts_with(&format!("{included}:{expected}")), "{told}");
    }
    let own = "scenes/balls.toml";
    for (wrong, word, expected) in [
        ("radius = -0.5", "radius = 0.5", "12: spheres[0].radius: must be"),
        ("name = 'own'\nfriction = -1", "name = 'own'", "8: colliders[0].friction: must be"),
        ("frame_time = 0", "frame_time = 0.01", "5: simulation.frame_time: must be"),
        ("width = 'six'", "width = 6", "3: parameters.width: "),
    ] {
        let told = with(FLOOR, &BALLS.replace(word, wrong));
        assert!(told.starts_with(&format!("{own}:{expected}")), "{told}");
    }
}

#[test]
fn all_faults_of_all_files_are_told() {
    let floor = FLOOR.replace("half-space", "half-plane");
    let balls = BALLS.replace("radius = 0.5", "radius = -1").replace("name = 'own'", "nam = 'own'");
    let folder = folder(&[("floor.toml", &floor), ("scenes/balls.toml", &balls)]);
    let faults = Scene::faults_of_file(&scene_in(&folder), Budget::FILE).unwrap();
    let told: Vec<_> = faults.iter().map(|it| (it.line.unwrap(), &*it.field)).collect();
    assert_eq!(
        told,
        [(7, "colliders[0].nam"), (12, "spheres[0].radius"), (10, "colliders[0].shape")]
    );
    assert!(faults[2].source_name.ends_with("floor.toml"));
}

#[test]
fn files_that_cannot_be_included_are_refused() {
    for (include, expected) in [
        ("'none.toml'", "1: include: cannot read \"none.toml\": "),
        ("'broken'", "(os error 2); did you mean \"broken.toml\"?"),
        ("['a.toml', 7]", "1: include: must be the path of a scene file, or a list of such"),
        ("'.'", "1: include: cannot read \".\": it is no file"),
        ("'/dev/zero'", "1: include: cannot read \"/dev/zero\": it is no file"),
        ("'scene.toml'", "1: include: \"scene.toml\" includes this file"),
        ("'a.toml'", "a.toml:1: include: \"b/../scene.toml\" includes this file"),
        ("'broken.toml'", "broken.toml:1: "),
    ] {
        let folder = folder(&[
            ("scene.toml", &format!("include = {include}\n")),
            ("a.toml", "include = 'b/../scene.toml'\n"),
            ("broken.toml", "include = \n"),
            ("b/c.toml", ""),
        ]);
        let told = refusal(&folder.path().join("scene.toml"));
        assert!(told.contains(expected), "{include}: {told}");
    }
    let text = Scene::from_toml("\ninclude = 'a.toml'", "text").unwrap_err().to_string();
    assert_eq!(text, "text:2: include: only scenes in files can include files");
    let ladder: Vec<_> = (0..200)
        .map(|i| (format!("{i}.toml"), format!("include = '{}.toml'", i + 1)))
        .chain([("200.toml".to_owned(), String::new())])
        .collect();
    let ladder: Vec<_> = ladder.iter().map(|(name, text)| (&**name, &**text)).collect();
    let folder = folder(&ladder);
    let told = refusal(&folder.path().join("0.toml"));
    assert!(told.contains("include: a scene has 100 files at most"), "{told}");
}

#[test]
fn a_change_of_an_included_file_is_a_change_of_the_scene() {
    let folder = folder(&[("floor.toml", FLOOR), ("scenes/balls.toml", BALLS)]);
    let mut file = ChangedFile::new(&scene_in(&folder));
    assert!(!file.look());
    let touch = |name: &str, seconds| {
        let file = fs::File::options().append(true).open(folder.path().join(name)).unwrap();
        let now = std::time::SystemTime::now();
        file.set_modified(now + std::time::Duration::from_secs(seconds)).unwrap();
    };
    touch("floor.toml", 10);
    assert_eq!([file.look(), file.look()], [true, false]);
    // A file that is broken for a moment is still watched.
    fs::write(scene_in(&folder), "include = ").unwrap();
    touch("scenes/balls.toml", 20);
    assert_eq!([file.look(), file.look()], [true, false]);
    touch("floor.toml", 30);
    assert_eq!([file.look(), file.look()], [true, false]);
}

#[test]
fn a_file_that_is_reached_twice_counts_once() {
    let fall = "[[forces]]\ngravity = { acceleration = [0, -9.81, 0] }\n";
    let folder = folder(&[
        ("fall.toml", fall),
        ("a.toml", "include = 'fall.toml'"),
        ("b.toml", "include = ['./fall.toml', 'a.toml']"),
        ("scene.toml", "include = ['a.toml', 'b.toml', 'a.toml']"),
    ]);
    let scene = Scene::from_file(&folder.path().join("scene.toml"), &[]).unwrap();
    assert_eq!(scene.forces.len(), 1);
}

#[test]
fn parameters_of_an_included_file_may_follow_from_those_of_this_one() {
    let own = "include = 'floor.toml'\n[parameters]\nbig = 3\nwidth = '=2*big'\nless = '=half-1'\n";
    let folder = folder(&[("floor.toml", FLOOR), ("scene.toml", own)]);
    let text = SceneText::from_file(&folder.path().join("scene.toml")).unwrap();
    assert_eq!(text.scene(&[]).unwrap().colliders[1].position[0], 3.0);
    let list = text.parameters(&[]).unwrap();
    let list: Vec<_> = list.iter().map(|it| (&*it.name, it.value)).collect();
    assert_eq!(list, [("width", 6.0), ("half", 3.0), ("big", 3.0), ("less", 2.0)]);
}

#[test]
fn a_camera_is_turned_in_another_way_than_the_included_one() {
    let base = "[camera]\nposition = [0, 1, 5]\nrotation = [0, 0, 0, 1]\n";
    let own = "include = 'base.toml'\n[camera]\nlook_at = [5, 1, 5]\n";
    let folder = folder(&[("base.toml", base), ("own.toml", own)]);
    let camera = Scene::from_file(&folder.path().join("own.toml"), &[]).unwrap().camera.unwrap();
    let ahead = carom::DQuat::from_array(camera.rotation) * carom::DVec3::NEG_Z;
    assert!((ahead - carom::DVec3::X).length() < 1e-15);
}

#[test]
fn an_included_file_that_is_missing_or_broken_is_watched_until_it_is_mended() {
    let folder = folder(&[("scene.toml", "include = ['none.toml', 'broken.toml']")]);
    fs::write(folder.path().join("broken.toml"), "x = ").unwrap();
    let mut file = ChangedFile::new(&folder.path().join("scene.toml"));
    assert!(!file.look());
    fs::write(folder.path().join("none.toml"), "").unwrap();
    assert_eq!([file.look(), file.look()], [true, false]);
    let broken = fs::File::options().append(true).open(folder.path().join("broken.toml")).unwrap();
    let later = std::time::SystemTime::now() + std::time::Duration::from_secs(9);
    broken.set_modified(later).unwrap();
    assert_eq!([file.look(), file.look()], [true, false]);
}

#[test]
fn a_file_that_is_emptied_and_written_within_one_step_of_its_time_has_changed() {
    let folder = folder(&[("scene.toml", "")]);
    let path = folder.path().join("scene.toml");
    let time = fs::metadata(&path).unwrap().modified().unwrap();
    let mut file = ChangedFile::new(&path);
    fs::write(&path, "name = 'x'").unwrap();
    fs::File::options().append(true).open(&path).unwrap().set_modified(time).unwrap();
    assert_eq!([file.look(), file.look()], [true, false]);
}

#[test]
fn no_files_at_all_may_be_included() {
    let scene = Scene::from_toml("include = []\nname = 'x'", "text").unwrap();
    assert_eq!(scene.name, "x");
}
