//! Input and output of commands: standard streams, existing files, watched files, and the
//! configuration of a user.

mod command;

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, Output, Stdio};
use std::time::{Duration, Instant};

use command::{bad, bad_line, carom, good, path};

/// Longer than any step of these tests on a shared machine.
const PATIENCE: Duration = Duration::from_secs(60);

const DROP: &str = "spheres = [{ position = [0, 1, 0], radius = 0.5 }]\n\
                    forces = [{ gravity = { acceleration = [0, -9.81, 0] } }]\n";

/// Runs the command with `input` on its standard input.
fn fed(arguments: &[&str], input: &str) -> Output {
    let mut command = carom();
    let piped = command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = piped.stderr(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
    child.wait_with_output().unwrap()
}

fn text(stream: &[u8]) -> &str {
    std::str::from_utf8(stream).unwrap()
}

#[test]
fn a_dash_reads_the_scene_from_the_standard_input() {
    let run = ["run", "-", "--seconds", "0.1", "--set", "spheres.0.radius=0.25"];
    let run = fed(&run, DROP);
    assert!(run.status.success(), "{}", text(&run.stderr));
    assert!(text(&run.stdout).starts_with("scene            stdin\n"));
    // The output of `show` can be run.
    let shown = good(&["show", "tutorial1"]);
    let (piped, direct) =
        (fed(&["run", "-", "--json"], &shown), good(&["run", "tutorial1", "--json"]));
    let hash = |json: &str| json.split("state_hash").nth(1).map(str::to_owned);
    assert_eq!(hash(text(&piped.stdout)), hash(&direct));
    let checked = fed(&["check", "-"], "nmae = 'x'\n");
    assert!(text(&checked.stderr).contains("stdin:1: nmae: unknown field"));
    let link = fed(&["link", "-", "--page", "https://example.org/"], DROP);
    let link = text(&link.stdout).trim().to_owned();
    assert!(good(&["run", "--link", &link, "--json"]).contains("\"stdin\""));
}

#[test]
fn a_dash_grades_the_run_in_the_standard_input() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "run.csv");
    good(&["run", "simtest1", "--seconds", "2", "--out", &file]);
    let recorded = std::fs::read_to_string(&file).unwrap();
    let pages = path(&folder, "");
    let graded = fed(&["grade", "-", "--scene", "simtest1", "--report", &pages], &recorded);
    assert!(graded.status.success(), "{}", text(&graded.stderr));
    assert!(text(&graded.stdout).starts_with("run        stdin, "), "{}", text(&graded.stdout));
    assert!(text(&graded.stdout).contains("same as the course's rule"));
    assert!(Path::new(&path(&folder, "stdin.html")).is_file());
    let nameless = fed(&["grade", "-"], &recorded);
    assert!(text(&nameless.stderr).contains("stdin: the file name contains no name of a scene"));
    let broken = fed(&["grade", "-", "--scene", "simtest1"], "t,ball,x,y,z\n0.02,0,1,2,up\n");
    assert!(text(&broken.stderr).contains("stdin:2: \"up\" is no number"));
}

#[test]
fn a_dash_writes_the_trajectory_to_the_standard_output_and_the_summary_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "t.csv");
    let run = ["run", "simtest1", "--seconds", "1", "--out"];
    good(&[&run[..], &[&file]].concat());
    let piped = command::run(&[&run[..], &["-"]].concat());
    assert_eq!(text(&piped.stdout), std::fs::read_to_string(&file).unwrap());
    assert!(text(&piped.stderr).contains("state hash"), "{}", text(&piped.stderr));
}

#[test]
fn every_table_goes_to_the_standard_output_by_each_of_its_names() {
    let folder = tempfile::tempdir().unwrap();
    let run = ["run", "tutorial4", "--rule", "exact", "--seconds", "2"];
    for option in ["--out", "--impacts", "--ledger"] {
        let file = path(&folder, "t.csv");
        good(&[&run[..], &[option, &file, "--force"]].concat());
        let table = std::fs::read_to_string(&file).unwrap();
        assert!(table.lines().count() > 3, "{option}");
        let names: &[&str] = if cfg!(unix) { &["-", "/dev/stdout"] } else { &["-"] };
        for name in names {
            let piped = command::run(&[&run[..], &[option, name]].concat());
            assert_eq!(text(&piped.stdout), table, "{option} {name}");
            assert!(text(&piped.stderr).contains("state hash"), "{option} {name}");
        }
        // The shell is responsible for a file that it opened.
        let shell_file = path(&folder, "shell.csv");
        let mut command = carom();
        command.args(run).args([option, names[names.len() - 1]]);
        command.stdout(std::fs::File::create(&shell_file).unwrap());
        assert!(command.output().unwrap().status.success(), "{option}");
        assert_eq!(std::fs::read_to_string(&shell_file).unwrap(), table, "{option}");
    }
}

#[test]
fn missing_folders_are_made_for_every_format() {
    let folder = tempfile::tempdir().unwrap();
    let run = ["run", "tutorial1", "--rule", "exact", "--frames", "2"];
    for (option, name) in [
        ("--out", "a/t.csv"),
        ("--out", "b/t.npz"),
        ("--out", "c/t.pvd"),
        ("--out", "d/t.glb"),
        ("--impacts", "e/of/t.csv"),
        ("--ledger", "f/t.csv"),
    ] {
        let file = path(&folder, name);
        good(&[&run[..], &[option, &file]].concat());
        assert!(Path::new(&file).is_file(), "{name}");
    }
    let file = path(&folder, "g/apart.csv");
    good(&["compare", "tutorial1", "--seconds", "0.1", "--out", &file]);
    assert!(Path::new(&file).is_file());
    let file = path(&folder, "h/new.toml");
    good(&["new", &file]);
    assert!(Path::new(&file).is_file());
}

#[test]
fn distances_of_rules_go_to_the_standard_output_beside_no_table() {
    let compare = ["compare", "tutorial1", "--seconds", "0.1", "--out", "-"];
    let output = carom().args(compare).output().unwrap();
    assert!(output.status.success());
    let rows = String::from_utf8(output.stdout).unwrap();
    assert!(rows.starts_with("t,exact_rms,") && rows.lines().count() == 7, "{rows}");
    assert!(rows.lines().skip(1).all(|row| row.split(',').all(|it| it.parse::<f64>().is_ok())));
    assert!(String::from_utf8_lossy(&output.stderr).contains("state hash"));
}

#[test]
fn a_picture_is_no_scene_and_the_error_says_what_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let files: [(&str, &[u8], &str); 4] = [
        ("photo.jpg", b"\xff\xd8\xff\xe0\0\x10JFIF\0", "it begins like a JPEG picture"),
        ("photo.toml", b"\x89PNG\r\n\x1a\n\0\0", "it begins like a PNG picture"),
        ("wide.toml", b"\xff\xfen\0a\0", "it is text in UTF-16: save it in UTF-8"),
        ("latin1.toml", b"name = 'fl\xe4che'", "it is not text in UTF-8 (byte 11 of it is 0xe4)"),
    ];
    for (name, bytes, what) in files {
        let file = path(&folder, name);
        std::fs::write(&file, bytes).unwrap();
        for command in ["run", "check"] {
            let told = bad(&[command, &file], 1);
            let expected = format!("cannot read {file}: it is not a scene file: {what}");
            assert!(told.contains(&expected), "{told}");
        }
        // A file in the current folder is found by its name.
        let beside = carom().args(["run", name]).current_dir(folder.path()).output().unwrap();
        assert!(text(&beside.stderr).contains(what), "{}", text(&beside.stderr));
        let mut piped = carom();
        piped.args(["run", "-"]).stdin(std::fs::File::open(&file).unwrap());
        let piped = piped.output().unwrap();
        assert!(text(&piped.stderr).contains(what), "{}", text(&piped.stderr));
        let including = path(&folder, "including.toml");
        std::fs::write(&including, format!("include = {name:?}\n")).unwrap();
        assert!(bad(&["check", &including], 1).contains(what));
    }
}

#[test]
fn a_file_that_is_there_is_replaced_only_by_force() {
    let folder = tempfile::tempdir().unwrap();
    for (option, name) in [("--out", "t.csv"), ("--impacts", "i.csv"), ("-o", "t.npz")] {
        let file = path(&folder, name);
        let run = ["run", "tutorial1", "--frames", "2", option, &file];
        good(&run);
        let before = std::fs::read(&file).unwrap();
        let refused = bad_line(&run, 2);
        assert!(refused.contains(&file) && refused.contains("--force"), "{refused}");
        assert_eq!(std::fs::read(&file).unwrap(), before);
        good(&[&run[..], &["-f"]].concat());
    }
    let table = path(&folder, "c.csv");
    let compare = ["compare", "tutorial1", "--seconds", "0.1", "--out", &table];
    good(&compare);
    assert!(bad_line(&compare, 2).contains("--force"));
    good(&[&compare[..], &["--force"]].concat());
}

#[test]
fn a_reader_that_has_seen_enough_of_a_table_ends_the_run_without_a_word() {
    for (arguments, start) in [
        (&["run", "tutorial4", "--out", "-"][..], "t,ball,x"),
        (&["compare", "tutorial3", "--seconds", "30", "--out", "-"], "t,"),
        (&["grade", "--plant", "none", "--scene", "simtest1", "--seconds", "60"], "t,ball,x"),
    ] {
        let mut command = carom();
        command.args(arguments).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
        assert!(lines.next().unwrap().unwrap().starts_with(start), "{arguments:?}");
        drop(lines);
        let output = child.wait_with_output().unwrap();
        assert_eq!((output.status.code(), text(&output.stderr)), (Some(0), ""), "{arguments:?}");
    }
}

/// A running command, which is killed at the end of the test.
struct AtWork(Child);

impl Drop for AtWork {
    fn drop(&mut self) {
        self.0.kill().ok();
        self.0.wait().ok();
    }
}

#[test]
fn a_scene_file_that_is_watched_runs_again_when_it_is_changed() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("drop.toml");
    std::fs::write(&file, DROP).unwrap();
    let mut command = carom();
    command.args(["run", file.to_str().unwrap(), "--frames", "6", "--watch"]);
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap();
    let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
    let _at_work = AtWork(child);
    let mut next = |title: &str| {
        lines.by_ref().map(Result::unwrap).find(|line| line.starts_with(title)).expect("a summary")
    };
    let first = next("state hash");
    // A mistake in the file does not end the command.
    for text in ["spheres = [", &DROP.replace("1, 0]", "2, 0]")] {
        // A file system may store times in steps of some milliseconds.
        std::thread::sleep(Duration::from_millis(500));
        std::fs::write(&file, text).unwrap();
    }
    let began = Instant::now();
    assert_ne!(next("state hash"), first);
    assert!(began.elapsed() < PATIENCE);
    assert!(bad_line(&["run", "tutorial1", "--watch"], 2).contains("needs a scene file"));
}

/// Runs the command with this configuration file.
fn configured(config: &Path, arguments: &[&str]) -> Output {
    carom().env("CAROM_CONFIG", config).args(arguments).output().unwrap()
}

#[test]
fn a_configuration_file_names_folders_and_the_page() {
    let folder = tempfile::tempdir().unwrap();
    let scenes = folder.path().join("scenes");
    std::fs::create_dir(&scenes).unwrap();
    std::fs::write(scenes.join("drop.toml"), DROP).unwrap();
    let config = folder.path().join("config.toml");
    let content = format!("scenes = [{scenes:?}]\npage = \"https://example.org/carom/\"\n");
    std::fs::write(&config, content).unwrap();
    let run = configured(&config, &["run", "drop", "--frames", "1"]);
    assert!(run.status.success(), "{}", text(&run.stderr));
    let link = configured(&config, &["link", "tutorial1"]);
    assert!(text(&link.stdout).starts_with("https://example.org/carom/#"));
    // The command line takes precedence.
    let link = configured(&config, &["link", "tutorial1", "--page", "https://other.org/"]);
    assert!(text(&link.stdout).starts_with("https://other.org/#"));
    std::fs::write(&config, "page = 3\n").unwrap();
    let broken = configured(&config, &["scenes"]);
    assert_eq!(broken.status.code(), Some(2));
    assert!(text(&broken.stderr).contains("config.toml:1: "), "{}", text(&broken.stderr));
}

#[test]
fn check_tells_all_faults_of_a_file_with_their_lines() {
    let broken = "name = 'x'\n[simulation]\nframe_time = -1\nrule = 'exat'\n[[spheres]]\n\
                  radus = 1\n[[spheres]]\nradius = 0.5\n[[spheres]]\nradius = -2\n\
                  [[colliders]]\nshape = 'plane'\n";
    let checked = fed(&["check", "-"], broken);
    let told = text(&checked.stderr);
    for line in [3, 4, 6, 10, 12] {
        assert!(told.contains(&format!("stdin:{line}: ")), "{line}: {told}");
    }
    assert!(told.contains("spheres[2].radius"), "places are those of the file: {told}");
    let of_syntax = fed(&["check", "-"], "a = \nb = \n");
    let told = text(&of_syntax.stderr);
    assert!(told.contains("stdin:1:") && told.contains("stdin:2:"), "{told}");
}

/// A ball of 0.1 kg on a spring of 1e5 N/m; the longest stable frame is 2 sqrt(m / k) = 2e-3 s.
const STIFF: &str = "[simulation]\nrule = 'discrete'\nduration = 20\n\
                     [[spheres]]\nposition = [1, 0, 0]\nradius = 0.1\nmass = 0.1\n\
                     [[springs]]\nsphere = 0\nanchor = [0, 0, 0]\nrest_length = 0.5\nstiffness = 1e5\n";

#[test]
fn frames_too_long_for_springs_are_refused_in_one_line() {
    for rule in ["discrete", "bisect"] {
        let stiff = STIFF.replace("discrete", rule);
        for line in [&["check", "-"][..], &["run", "-"]] {
            let refused = fed(line, &stiff);
            assert_eq!(refused.status.code(), Some(1), "{refused:?}");
            let told = text(&refused.stderr);
            assert!(told.contains("stdin:8: springs: `stiffness` must be"), "{told}");
            assert!(told.contains("is stable up to frames of 2.000e-3 s"), "{told}");
        }
        let fine = stiff.replace("duration", "frame_time = 1.9e-3\nduration");
        assert!(fed(&["run", "-", "--seconds", "0.1"], &fine).status.success());
    }
    for fine in [STIFF.replace("discrete", "exact"), STIFF.replace("1e5", "1e2")] {
        let checked = fed(&["check", "-"], &fine);
        assert_eq!(text(&checked.stdout).lines().count(), 1, "{checked:?}");
        assert!(fed(&["run", "-"], &fine).status.success());
    }
}
