//! The command `carom`: files, tables, exit codes, and one clear line for every error.

mod advice;
#[path = "../command/mod.rs"]
mod command;
mod sensitivity;
mod tables;

use std::path::Path;
use std::process::{Command, Output, Stdio};

use command::{CAROM, bad, bad_line, carom, good, path};
use serde_json::Value;

/// How long a busy machine may take for what needs a moment.
#[cfg(unix)]
const PATIENCE: std::time::Duration = std::time::Duration::from_secs(60);

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn summary(arguments: &[&str]) -> Value {
    serde_json::from_str(&good(&[arguments, &["--json"]].concat())).unwrap()
}

fn rows(path: &str) -> (csv::StringRecord, Vec<Vec<String>>) {
    let mut reader = csv::Reader::from_path(path).unwrap();
    let header = reader.headers().unwrap().clone();
    let rows = reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect());
    (header, rows.collect())
}

#[test]
fn a_run_prints_its_table() {
    let table = good(&["run", "simtest1", "--seconds", "2"]);
    for (row, value) in [
        ("scene", "simtest1"),
        ("rule", "discrete, semi-implicit-euler, frames of 0.020000 s"),
        ("simulated time", "2.000 s in 100 frames"),
        ("spheres", "3 (3 emitted, 0 retired)"),
        ("impacts", ""),
        ("energy", "J"),
        ("momentum", "kg m/s"),
        ("largest overlap", "m"),
        ("wall time", "s"),
        ("state hash", ""),
    ] {
        let line = table.lines().find(|line| line.starts_with(row));
        assert!(line.is_some_and(|line| line.contains(value)), "{row}: {table}");
    }
}

#[test]
fn the_summary_has_the_work_of_all_frames_by_stage() {
    let work = |rule: &str, frames: &str| {
        let run = ["run", "tutorial3", "--rule", rule, "--frames", frames];
        summary(&run)["work"].clone()
    };
    let count = |work: &Value, stage: &str| work[stage].as_u64().unwrap();
    let (part, whole) = (work("exact", "100"), work("exact", "200"));
    assert_eq!(whole, work("exact", "200"), "the same run does the same work");
    for stage in ["predictions", "pair_tests", "events"] {
        assert!(count(&part, stage) > 0, "{stage}: {part}");
        assert!(count(&whole, stage) >= count(&part, stage), "{stage}: {whole}");
    }
    assert!(count(&whole, "groups") > 0, "{whole}");
    let discrete = work("discrete", "200");
    assert!(count(&discrete, "pair_tests") > 0, "{discrete}");
    for stage in ["predictions", "events", "cell_crossings", "groups", "solver_iterations"] {
        assert_eq!(count(&discrete, stage), 0, "{stage}: {discrete}");
    }
}

#[test]
fn frames_seconds_rule_and_overrides_do_what_they_say() {
    let frames = |arguments: &[&str]| summary(arguments)["frames"].as_u64().unwrap();
    assert_eq!(frames(&["run", "simtest1", "--frames", "7"]), 7);
    assert_eq!(frames(&["run", "simtest1", "--seconds", "0.1"]), 5);
    assert_eq!(frames(&["run", "simtest1", "--seconds", "0.11"]), 6);
    assert_eq!(frames(&["run", "simtest1", "--seconds", "1", "--frame-time", "0.25"]), 4);
    assert_eq!(frames(&["run", "simtest1", "--frames", "0"]), 0);
    let bisect = summary(&["run", "simtest1", "--rule", "bisect", "--frames", "5"]);
    assert_eq!(bisect["rule"], "bisect");
    let heavy = ["run", "simtest1", "--frames", "50", "--set", "emitters.0.sphere.mass=4"];
    assert_ne!(summary(&heavy)["state_hash"], summary(&heavy[..4])["state_hash"]);
}

#[test]
fn scenes_are_listed_with_name_description_and_origin() {
    let list = good(&["scenes"]);
    for part in ["simtest6", "maze", "Newton's cradle", "Course project 4, SimTest3", "built-in"] {
        assert!(list.contains(part), "{part}: {list}");
    }
    let json: Value = serde_json::from_str(&good(&["scenes", "--json"])).unwrap();
    assert_eq!(json[0]["name"], "billiards");
}

#[test]
fn what_show_prints_is_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    let hash = |scene: &str| summary(&["run", scene, "--frames", "60"])["state_hash"].clone();
    for arguments in [
        ["show", "tutorial4", "--set", "title=x"],
        ["show", "tutorial4", "--expand", "--set=title=x"],
    ] {
        let file = path(&folder, "shown.toml");
        std::fs::write(&file, good(&arguments)).unwrap();
        assert!(good(&["check", &file]).contains("ok, \"tutorial4\""));
        assert_eq!(hash(&file), hash("tutorial4"));
    }
}

#[test]
fn scenes_of_a_users_own_are_found_in_folders() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("own.toml"), "name = \"own\"\n[[spheres]]\nradius = 1\n")
        .unwrap();
    let directory = folder.path().to_str().unwrap();
    assert!(good(&["scenes", "--scenes", directory]).contains("own.toml"));
    good(&["run", "own", "--scenes", directory, "--frames", "3"]);
    let output = carom()
        .args(["run", "own", "--frames", "3"])
        .env("CAROM_SCENES", directory)
        .output()
        .unwrap();
    assert!(output.status.success());
    assert!(bad_line(&["run", "own"], 2).contains("there is no scene \"own\""));
    // A file of that name in the current folder is used.
    let output = carom().args(["run", "own", "--frames", "3"]).current_dir(directory).output();
    assert!(output.unwrap().status.success());
}

#[test]
fn bad_usage_ends_with_code_2_and_says_what_was_meant() {
    assert!(bad_line(&["run", "simtst1"], 2).contains("did you mean \"simtest1\"?"));
    assert!(
        bad_line(&["run", "simtest1", "--set", "emitters.9.period=1"], 2).contains("no element 9")
    );
    assert!(
        bad_line(&["run", "simtest1", "--set", "simulation.frametime=1"], 2)
            .contains("did you mean \"frame_time\"?")
    );
    assert!(bad_line(&["run", "simtest1", "--out", "t.txt"], 2).contains(".csv, .npz, .pvd"));
    assert!(bad_line(&["scenes", "--scenes", "/nowhere/at/all"], 2).contains("/nowhere/at/all"));
    assert!(
        bad_line(&["run", "simtest1", "--frame-time", "1e-300", "--seconds", "1"], 2)
            .contains("frames")
    );
    for arguments in [
        &["run"][..],
        &["run", "simtest1", "--rule", "magic"],
        &["run", "simtest1", "--seconds", "-1"],
        &["run", "simtest1", "--frame-time", "-1"],
        &["run", "simtest1", "--out", "same.csv", "--impacts", "same.csv"],
        &["run", "simtest1", "--out", "same.csv", "--impacts", "./same.csv"],
        &["run", "simtest1", "--wells", "wells.npz"],
        &["run", "simtest1", "--impacts", "impacts.parquet"],
        &["run", "simtest1", "--seconds", "1", "--frames", "2"],
        &["run", "simtest1", "--every", "0"],
        &["run", "simtest1", "--frames", "3", "--every", "4", "--out", "same.csv"],
        &["run", "simtest1", "--out", "-", "--impacts", "-"],
        &["run", "simtest1", "--set", "novalue"],
        &["fly"],
    ] {
        bad(arguments, 2);
    }
}

#[test]
fn what_a_rule_does_not_read_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let scene = path(&folder, "rough.toml");
    let text = "name = \"rough\"\n[simulation]\nrule = \"discrete\"\ncontact = { sub_steps = 4 }\n\
                [[colliders]]\nshape = \"half-space\"\nfriction = 0.5\n\
                [[spheres]]\nradius = 0.1\nposition = [0, 1, 0]\n";
    std::fs::write(&scene, text).unwrap();
    let said = "the rule discrete does not read friction, `simulation.contact`";
    assert!(good(&["check", &scene]).contains(said));
    assert!(good(&["run", &scene, "--frames", "2"]).contains(said));
    let json = good(&["run", &scene, "--frames", "2", "--json"]);
    assert!(json.contains("\"unread\": \"the rule discrete does not"), "{json}");
    for rule in ["contact", "exact"] {
        let told = good(&["run", &scene, "--frames", "2", "--rule", rule]);
        assert!(!told.contains("read friction"), "{told}");
        assert_eq!(told.contains("does not read"), rule == "exact", "{told}");
    }
}

#[test]
fn what_goes_wrong_on_the_way_ends_with_code_1_and_one_line() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(path(&folder, "file"), "").unwrap();
    let nowhere = path(&folder, "file/t.csv");
    let text = bad_line(&["run", "simtest1", "--out", &nowhere], 1);
    assert!(text.contains(&format!("cannot write {nowhere}")), "{text}");
    assert!(bad_line(&["run", "simtest1", "--impacts", &nowhere], 1).contains("cannot write"));

    let broken = path(&folder, "broken.toml");
    std::fs::write(&broken, "name = \"broken\"\n\n[[spheres]]\nradius = -1\n").unwrap();
    let text = bad_line(&["run", &broken], 1);
    assert!(text.contains("broken.toml:4: spheres[0].radius: must be positive"), "{text}");
    let text = bad(&["check", &broken, &nowhere], 1);
    assert!(text.contains("broken.toml:4") && text.contains("cannot read"), "{text}");

    // Masses times this acceleration are no numbers.
    let fall = "forces.0.gravity.acceleration=[0,-1e308,0]";
    assert!(bad_line(&["run", "tutorial1", "--set", fall], 1).contains("no longer finite"));
}

#[test]
fn scenes_are_checked_by_their_names_too() {
    assert_eq!(good(&["check", "simtest1"]), "simtest1: ok, \"simtest1\"\n");
    let text = bad(&["check", "simtest1", "simtets1"], 1);
    assert!(text.contains("simtets1") && text.contains("did you mean \"simtest1\""), "{text}");
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_one_clear_line_in_every_format() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["t.csv", "t.npz", "t.pvd"] {
        let file = folder.path().join(name);
        std::os::unix::fs::symlink("/dev/full", &file).unwrap();
        let file = file.to_str().unwrap();
        let text = bad_line(&["run", "simtest1", "--out", file], 1);
        assert!(text.contains("cannot write") && text.contains("No space left"), "{text}");
    }
    std::fs::create_dir(folder.path().join("v_frames")).unwrap();
    let frame = folder.path().join("v_frames/000000.vtp");
    std::os::unix::fs::symlink("/dev/full", &frame).unwrap();
    let series = folder.path().join("v.pvd");
    let text = bad_line(&["run", "simtest1", "--out", series.to_str().unwrap()], 1);
    assert!(text.contains("v.pvd: v_frames/000000.vtp: No space left"), "{text}");
    let impacts = folder.path().join("i.csv");
    std::os::unix::fs::symlink("/dev/full", &impacts).unwrap();
    let text = bad_line(&["run", "simtest1", "--impacts", impacts.to_str().unwrap()], 1);
    assert!(text.contains("No space left"), "{text}");
}

/// Starts a run that would take very long, and interrupts it as Ctrl-C would.
#[cfg(unix)]
fn interrupted_run(file: &Path) -> Output {
    let child = carom()
        .args(["run", "simtest1", "--seconds", "1e7", "--out"])
        .arg(file)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // When the file contains something, the run reacts to Ctrl-C. The numbers of an NPZ file are in
    // another file until the end.
    let began = std::time::Instant::now();
    let unfinished = format!("{}.0.unfinished", file.display());
    let size = |path: &Path| std::fs::metadata(path).map_or(0, |it| it.len());
    let is_written = || size(file).max(size(Path::new(&unfinished))) > 200_000;
    while !is_written() && began.elapsed() < PATIENCE {
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    let killed = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(killed.success());
    child.wait_with_output().unwrap()
}

#[test]
#[cfg(unix)]
fn ctrl_c_ends_the_run_with_what_was_written_readable() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["t.csv", "t.npz"] {
        let file = folder.path().join(name);
        let output = interrupted_run(&file);
        assert_eq!(output.status.code(), Some(130));
        assert!(stdout(&output).contains("state hash"));
        if name == "t.csv" {
            let (_, rows) = rows(file.to_str().unwrap());
            assert!(rows.len() > 1000 && rows.iter().all(|row| row.len() == 8));
        } else {
            let zip = zip::ZipArchive::new(std::fs::File::open(&file).unwrap()).unwrap();
            assert_eq!(zip.len(), 9);
        }
    }
}

/// A pile of which one frame would take minutes.
#[cfg(unix)]
const PILE: &str = r#"
name = "pile"
[simulation]
frame_time = 60.0
duration = 600.0
exact = { max_impacts = 4_000_000_000, zones = "never" }
[[forces]]
gravity = { acceleration = [0.0, -9.81, 0.0] }
[[colliders]]
shape = { sphere = { radius = 12.0 } }
position = [3.0, -12.0, 3.0]
restitution = 0.5
[[generators]]
[generators.random]
count = 300
min = [0.0, 1.0, 0.0]
max = [6.0, 40.0, 6.0]
seed = 7
sphere = { radius = 0.5, mass = 1.0, restitution = 0.5 }
"#;

#[test]
#[cfg(unix)]
fn signals_end_a_frame_of_minutes_with_a_summary_and_readable_files() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("pile.toml");
    let text = PILE.to_owned() + &walls();
    std::fs::write(&scene, text).unwrap();
    for signal in ["-INT", "-TERM"] {
        let file = folder.path().join(format!("t{signal}.csv"));
        let child = carom()
            .arg("run")
            .arg(&scene)
            .arg("--out")
            .arg(&file)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        // The file appears before the frame, which then takes minutes.
        let began = std::time::Instant::now();
        while !file.exists() && began.elapsed() < PATIENCE {
            std::thread::sleep(std::time::Duration::from_millis(20));
        }
        std::thread::sleep(std::time::Duration::from_secs(1));
        let killed = Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
        assert!(killed.success(), "the frame has ended before {signal}");
        let began = std::time::Instant::now();
        let output = child.wait_with_output().unwrap();
        // A user may wait a second, a busy machine many; the frame would take minutes.
        assert!(began.elapsed() < PATIENCE / 2, "{signal}: {:?}", began.elapsed());
        assert_eq!(output.status.code(), Some(130));
        let summary = stdout(&output);
        assert!(summary.contains("state hash") && summary.contains("in 0 frames"), "{summary}");
        assert!(std::fs::read_to_string(&file).unwrap().starts_with("t,ball,"));
    }
}

/// Four walls around the pile.
#[cfg(unix)]
fn walls() -> String {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let sides = [(0.0, 0.0, [0.0, -half]), (6.0, 0.0, [0.0, half]), (0.0, 0.0, [half, 0.0])];
    let sides = sides.into_iter().chain([(0.0, 6.0, [-half, 0.0])]);
    let wall = |(x, z, [about_x, about_z]): (f64, f64, [f64; 2])| {
        format!(
            "[[colliders]]\nshape = \"half-space\"\nposition = [{x:?}, 0.0, {z:?}]\n\
             rotation = [{about_x:?}, 0.0, {about_z:?}, {half:?}]\nrestitution = 0.5\n"
        )
    };
    sides.map(wall).collect()
}

#[test]
#[cfg(target_os = "linux")]
fn an_error_stream_that_is_gone_is_no_panic() {
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let status = carom().args(["run", "nosuch"]).stderr(full).status().unwrap();
    assert_eq!(status.code(), Some(2));
}

#[test]
#[cfg(unix)]
fn a_reader_that_has_heard_enough_is_no_error() {
    let script = format!("'{CAROM}' scenes | head -n 1; echo ${{PIPESTATUS[0]}}");
    let output = Command::new("bash").args(["-c", &script]).output().unwrap();
    assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(stdout(&output).lines().last(), Some("0"));
}

#[test]
fn a_new_scene_runs_and_replaces_nothing_unless_told() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "balls \"mine\".toml");
    let told = good(&["new", file.strip_suffix(".toml").unwrap()]);
    assert!(told.contains(&format!("carom view {file}")), "{told}");
    assert!(good(&["check", &file]).contains("balls \"mine\""));
    let json = summary(&["run", &file]);
    assert_eq!(json["spheres"], 61);
    // No ball falls through a wall.
    assert!(json["impacts"].as_u64().unwrap() > 500, "{json}");

    std::fs::write(&file, "mine").unwrap();
    let error = bad_line(&["new", &file], 2);
    assert!(error.contains("is there already; --force replaces it"), "{error}");
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "mine");
    good(&["new", &file, "--force"]);
    assert!(good(&["check", &file]).contains("ok"));
    // A file cannot contain a folder.
    assert!(bad_line(&["new", &format!("{file}/scene")], 1).contains("is not a folder"));
}

#[test]
fn shells_and_man_can_read_the_command_line() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = good(&["completions", shell]);
        assert!(script.contains("carom") && script.contains("compare"), "{shell}: {script}");
    }
    let folder = tempfile::tempdir().unwrap();
    let pages = folder.path().join("man");
    good(&["man", pages.to_str().unwrap()]);
    let run = std::fs::read_to_string(pages.join("carom-run.1")).unwrap();
    assert!(run.starts_with(".ie") && run.contains("impacts"), "{run}");
    assert!(pages.join("carom.1").exists());
}
