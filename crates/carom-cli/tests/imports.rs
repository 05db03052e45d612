//! `carom import` as a user meets it: files, reports, exit codes.

mod command;

use command::{bad_line, good, path, run};
use tempfile::TempDir;

/// A file of the project of Unity that `carom-unity` is tested with.
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
    assert!(bad_line(&["import", &empty], 1).contains("holds no scene of Unity"));
}
