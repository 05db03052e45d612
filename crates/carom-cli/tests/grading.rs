//! The command `carom grade`: one run, a folder of runs, exit codes, files, and errors of
//! unreadable files.

mod command;

use std::path::Path;

use carom_scene::Library;
use carom_scene::recording::Replay;
use command::{bad, bad_line, good, path, run, text_of};
use serde_json::Value;

/// Writes a run with this mistake, or with `none`, to a folder.
fn plant(folder: &tempfile::TempDir, mistake: &str, scene: &str, name: &str) -> String {
    let file = path(folder, name);
    good(&["grade", "--plant", mistake, "--scene", scene, "--seconds", "4", "--out", &file]);
    file
}

/// Returns the verdicts of a call that ends with this code.
fn verdicts(arguments: &[&str], code: i32) -> Value {
    let output = run(&[&["grade", "--json"], arguments].concat());
    assert_eq!(output.status.code(), Some(code), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn a_run_of_carom_is_the_same_and_one_with_a_mistake_departs() {
    let folder = tempfile::tempdir().unwrap();
    let right = path(&folder, "right.csv");
    good(&["run", "simtest1", "--seconds", "4", "--out", &right]);
    let text = good(&["grade", &right, "--scene", "SimTest1"]);
    assert!(text.contains("same as the course's rule, to 15 digits"), "{text}");
    let wrong = plant(&folder, "restitution-squared", "simtest1", "wrong.csv");
    let output = run(&["grade", &wrong, "--scene", "simtest1"]);
    assert_eq!((output.status.code(), output.stderr.as_slice()), (Some(1), b"".as_slice()));
    let text = String::from_utf8(output.stdout).unwrap();
    for part in
        ["departs from the course's rule", "sphere of SphereCollider", "restitution-squared"]
    {
        assert!(text.contains(part), "{part}: {text}");
    }
}

#[test]
fn the_page_of_one_run_goes_into_a_folder_that_is_there() {
    let folder = tempfile::tempdir().unwrap();
    let file = plant(&folder, "none", "simtest2", "ben.csv");
    let pages = path(&folder, "pages");
    std::fs::create_dir(&pages).unwrap();
    good(&["grade", &file, "--scene", "simtest2", "--report", &pages]);
    assert!(Path::new(&pages).join("ben.html").is_file());
}

#[test]
fn a_folder_of_submissions_gets_a_table_pages_and_the_worst_exit_code() {
    let folder = tempfile::tempdir().unwrap();
    let right = plant(&folder, "none", "simtest2", "ben_SimTest2.csv");
    let wrong = plant(&folder, "drag-sign", "simtest3", "anna_SimTest3.csv");
    let (table, pages) = (path(&folder, "grades.csv"), path(&folder, "pages"));
    let output = run(&["grade", &right, &wrong, "--table", &table, "--report", &pages]);
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    let mut reader = csv::Reader::from_path(&table).unwrap();
    let columns = reader.headers().unwrap().clone();
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    let field = |row: usize, name: &str| {
        let place = columns.iter().position(|it| it == name).unwrap();
        rows[row][place].to_owned()
    };
    assert_eq!((field(0, "scene"), field(0, "result")), ("simtest2".into(), "same".into()));
    assert_eq!((field(1, "result"), field(1, "mistake")), ("departs".into(), "drag-sign".into()));
    let page = std::fs::read_to_string(path(&folder, "pages/anna_SimTest3.html")).unwrap();
    assert!(page.contains("drag-sign") && !page.contains("<script"));
    // Existing files are kept; a broken file determines the exit code.
    assert!(bad_line(&["grade", &right, "--table", &table], 2).contains("is there already"));
    let broken = path(&folder, "carl_simtest1.csv");
    std::fs::write(&broken, "t,ball,x,y,z\n0.02,0,1,2,up\n").unwrap();
    let files = ["--table", &table, "--report", &pages, "--force"];
    let errors = bad(&[&["grade", &right, &broken, &wrong][..], &files].concat(), 2);
    assert!(errors.contains("carl_simtest1.csv:2: \"up\" is no number"), "{errors}");
    assert!(errors.contains("1 of 3 runs cannot be graded"), "{errors}");
    let text = std::fs::read_to_string(&table).unwrap();
    assert!(text.contains("error") && text.contains("drag-sign"), "{text}");
    // The page of the class has all of them, with the reason for the unreadable one.
    let index = std::fs::read_to_string(path(&folder, "pages/index.html")).unwrap();
    for part in
        ["3 runs", "href=\"anna_SimTest3.html\"", "drag-sign", "cannot be read", "is no number"]
    {
        assert!(index.contains(part), "{part}: {index}");
    }
}

#[test]
fn json_has_the_departure_and_the_mistakes() {
    let folder = tempfile::tempdir().unwrap();
    let wrong = plant(&folder, "explicit-euler,one-forgotten", "simtest3", "run.csv");
    let all = verdicts(&[&wrong, "--scene", "simtest3"], 1);
    let verdict = &all[0]["verdict"];
    assert_eq!(verdict["same"], false);
    assert_eq!(verdict["departure"]["line"], 2);
    let best = &verdict["explanations"][0];
    assert_eq!(best["mistakes"], serde_json::json!(["explicit-euler", "one-forgotten"]));
    assert!(best["fit"]["rms"].as_f64().unwrap() < 1e-9, "{best}");
}

#[test]
fn columns_units_and_handedness_are_read_as_given() {
    let folder = tempfile::tempdir().unwrap();
    let right = plant(&folder, "none", "simtest6", "right.csv");
    let mut text = "when,who,a,b,c\n".to_owned();
    for row in std::fs::read_to_string(&right).unwrap().lines().skip(1) {
        let numbers: Vec<f64> = row.split(',').map(|it| it.parse().unwrap()).collect();
        let [t, ball, x, y, z] = numbers[..5].try_into().unwrap();
        text += &format!("{},{ball},{},{},{}\n", 1e3 * t, 100.0 * x, 100.0 * y, -100.0 * z);
    }
    let own = path(&folder, "own.csv");
    std::fs::write(&own, text).unwrap();
    let columns = ["--columns", "t=when,ball=who,x=a,y=b,z=c", "--scene", "simtest6"];
    let units = ["--length-unit", "cm", "--time-unit", "ms", "--unity"];
    good(&[&["grade", &own][..], &columns, &units].concat());
    // What is not said is recognised.
    let text = good(&[&["grade", &own][..], &columns, &units[..4]].concat());
    assert!(text.contains("in another form: z mirrored (--unity)"), "{text}");
    let error = bad_line(&["grade", &own, "--scene", "simtest6"], 2);
    assert!(error.contains("there is no column \"t\""), "{error}");
}

#[test]
fn what_makes_no_sense_is_refused_in_a_line() {
    let folder = tempfile::tempdir().unwrap();
    let right = plant(&folder, "none", "simtest1", "right.csv");
    let sheet = path(&folder, "damaged.xlsx");
    std::fs::write(&sheet, b"\x01\x02\x03").unwrap();
    for (arguments, expected) in [
        (vec!["grade", &right], "the file name contains no name of a scene"),
        (
            vec!["grade", &right, "--scene", "tutorial1"],
            "cannot be graded, because the course does not have",
        ),
        (vec!["grade", &right, "--scene", "nowhere"], "nowhere"),
        (vec!["grade", &sheet, "--scene", "simtest1"], "is no spreadsheet, or a damaged one"),
        (vec!["grade", "nowhere.csv", "--scene", "simtest1"], "cannot read nowhere.csv"),
        (vec!["grade", "--plant", "no-drga", "--scene", "simtest1"], "did you mean \"no-drag\"?"),
    ] {
        let error = bad_line(&arguments, 2);
        assert!(error.contains(expected), "{arguments:?}: {error}");
    }
    assert!(
        bad(&["grade", &right, "--scene", "simtest1", "--columns", "q=x"], 2).contains("names no")
    );
}

#[test]
fn a_run_with_a_mistake_can_be_filmed() {
    let folder = tempfile::tempdir().unwrap();
    let file = plant(&folder, "not-on-top", "simtest6", "sinks.csv");
    let scene = Library::new().find("simtest6", &[]).unwrap().0;
    let mut replay = Replay::open(Path::new(&file), &scene).unwrap();
    let mut frames = 0;
    while replay.next_frame().unwrap().is_some() {
        frames += 1;
    }
    assert_eq!(frames, 200);
}

#[test]
fn the_known_mistakes_are_listed() {
    let text = text_of(run(&["grade", "--mistakes"]));
    assert!(text.lines().any(|line| line.starts_with("normal-not-transformed ")), "{text}");
    let all: Value = serde_json::from_str(&good(&["grade", "--mistakes", "--json"])).unwrap();
    let names = all.as_array().unwrap().iter().map(|it| it["name"].as_str().unwrap());
    assert!(names.eq(text.lines().map(|line| line.split(' ').next().unwrap())));
}
