//! The command `carom import`: files, reports, exit codes.

mod command;

use command::{bad_line, good, path, run};
use tempfile::TempDir;

/// Path of a file in the Unity project of the tests of `carom-unity`.
fn project(file: &str) -> String {
    format!("{}/../carom-unity/tests/fixtures/Project/{file}", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn an_imported_scene_is_printed_and_what_it_leaves_out_is_listed() {
    let output = run(&["import", &project("Assets/Scenes/First.unity")]);
    assert!(output.status.success());
    let (scene, report) = (String::from_utf8(output.stdout).unwrap(), output.stderr);
    assert!(scene.contains("[[emitters]]"), "{scene}");
    let report = String::from_utf8(report).unwrap();
    assert!(report.contains("Main Camera: AudioListener: has no counterpart"), "{report}");
}

#[test]
fn an_imported_file_runs_as_the_scene_that_it_is_like() {
    let folder = TempDir::new().unwrap();
    let file = path(&folder, "first.toml");
    assert!(
        run(&["import", &project("Assets/Scenes/First.unity"), "--out", &file]).status.success()
    );
    let hash = |scene: &str| {
        let table = good(&["run", scene, "--seconds", "10"]);
        table.lines().find(|line| line.starts_with("state hash")).unwrap().to_owned()
    };
    assert_eq!(hash(&file), hash("simtest1"));
    let again = ["import", &project("Assets/Scenes/Own.unity"), "--out", &file];
    let output = run(&again);
    assert_eq!(output.status.code(), Some(2));
    assert!(run(&[&again[..], &["--force"]].concat()).status.success());
}

#[test]
fn every_scene_of_a_folder_is_written() {
    let folder = TempDir::new().unwrap();
    let out = path(&folder, "imported");
    assert!(run(&["import", &project("Assets"), "--out", &out]).status.success());
    for name in ["Bodies", "First", "Nested", "Own"] {
        good(&["check", &format!("{out}/{name}.toml")]);
    }
}

#[test]
fn what_is_not_there_or_broken_is_one_line() {
    assert!(bad_line(&["import", "nowhere.unity"], 2).contains("nowhere.unity"));
    let folder = TempDir::new().unwrap();
    let file = path(&folder, "broken.unity");
    std::fs::write(&file, "%YAML 1.1\n--- !u!1 &x\n").unwrap();
    assert!(bad_line(&["import", &file], 1).contains("broken.unity:2: must be the head"));
    let empty = path(&folder, "");
    std::fs::remove_file(&file).unwrap();
    let other = path(&folder, "run.npz");
    std::fs::write(&other, b"PK\x03\x04").unwrap();
    assert!(
        bad_line(&["import", &other], 2).contains("run.npz: can be imported are scenes of Unity")
    );
    std::fs::remove_file(&other).unwrap();
    assert!(bad_line(&["import", &empty], 1).contains("holds no scene of Unity"));
}

/// Path of a file of the tests of `carom-gltf`.
fn gltf(file: &str) -> String {
    format!("{}/../carom-gltf/tests/fixtures/{file}", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn gltf_is_imported_and_what_it_leaves_out_is_listed() {
    let folder = TempDir::new().unwrap();
    let file = path(&folder, "bodies.toml");
    let output = run(&["import", &gltf("bodies.gltf"), "--out", &file]);
    assert!(output.status.success());
    let report = String::from_utf8(output.stderr).unwrap();
    assert!(report.contains("Pill: collider: a capsule has no counterpart"), "{report}");
    good(&["run", &file, "--seconds", "1"]);
    let meshes = run(&["import", &gltf("meshes.gltf"), "--rule", "contact", "--seconds", "3"]);
    let scene = String::from_utf8(meshes.stdout).unwrap();
    assert!(scene.contains("rule = \"contact\"") && scene.contains("duration = 3.0"), "{scene}");
    assert!(
        String::from_utf8(meshes.stderr).unwrap().contains("Egg: mesh: is scaled to an ellipsoid")
    );
    assert!(bad_line(&["import", &gltf("bodies.gltf"), "--map", &file], 2).contains("--map"));
    assert!(bad_line(&["import", "nowhere.glb"], 2).contains("nowhere.glb"));
    std::fs::write(path(&folder, "broken.gltf"), "{\n\"nodes\": 1}").unwrap();
    let error = bad_line(&["import", &path(&folder, "broken.gltf")], 1);
    assert!(error.contains("broken.gltf: line 2, nodes: "), "{error}");
}

#[test]
fn a_recorded_animation_is_a_scene_that_runs_as_the_first() {
    let folder = TempDir::new().unwrap();
    let (animation, file) = (path(&folder, "cradle.glb"), path(&folder, "cradle.toml"));
    let again = ["run", "cradle", "--seconds", "1", "--out", &animation];
    let first = good(&again);
    assert!(run(&["import", &animation, "--out", &file]).status.success());
    let second = good(&["run", &file, "--seconds", "1"]);
    let hash =
        |table: &str| table.lines().find(|it| it.starts_with("state hash")).map(str::to_owned);
    assert_eq!(hash(&second), hash(&first));
    assert!(bad_line(&again, 2).contains("cradle.glb"), "it is not written over");
    // A file cannot contain a folder.
    let nowhere = path(&folder, "cradle.toml/run.glb");
    assert!(bad_line(&["run", "cradle", "--out", &nowhere], 1).contains("run.glb"));
    assert!(
        bad_line(&["run", "cradle", "--out", "run.mov"], 2).contains(".glb (an animation in glTF)")
    );
}
