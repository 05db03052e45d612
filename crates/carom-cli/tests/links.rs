//! Links on the command line: `carom run --link` reproduces a run of `carom link` bit for bit, and
//! other texts are refused with one line.

mod command;

use std::io::Write;
use std::process::Stdio;

use carom::{DVec3, SphereId};
use carom_scene::Library;
use carom_scene::scene::Rule;
use carom_session::{Edit, Link, Session, SphereChange};
use command::{bad, carom, good, text_of};
use serde_json::Value;

const PAGE: &str = "http://127.0.0.1:8042/";

/// Returns the printed link.
#[track_caller]
fn link(arguments: &[&str]) -> String {
    let text = good(&[&["link"], arguments].concat());
    assert_eq!(text.lines().count(), 1, "{text}");
    text.trim_end().to_owned()
}

#[track_caller]
fn summary(arguments: &[&str]) -> Value {
    serde_json::from_str(&good(&[&["run"], arguments, &["--json"]].concat())).unwrap()
}

/// Removes the measured times from a summary.
fn figures(mut summary: Value) -> Value {
    for clock in ["wall_time", "stepping_time"] {
        summary.as_object_mut().unwrap().remove(clock);
    }
    summary
}

#[track_caller]
fn assert_same_run(arguments: &[&str]) -> String {
    let link = link(arguments);
    assert_eq!(figures(summary(&["--link", &link])), figures(summary(arguments)), "{link}");
    link
}

#[test]
fn a_link_runs_to_the_same_figures_as_what_it_was_made_of() {
    let set = "emitters.0.max_spheres=5";
    assert_eq!(assert_same_run(&["tutorial1"]), format!("{PAGE}#scene=tutorial1"));
    let timed = assert_same_run(&["simtest4", "--set", set, "--rule", "exact", "--seconds", "2"]);
    assert_eq!(timed, format!("{PAGE}#scene=simtest4&set={set}&rule=exact&t=2"));
    // Times are rounded up to whole frames, of 0.02 s and of 0.1 s.
    assert!(assert_same_run(&["simtest1", "--seconds", "1.51"]).ends_with("&t=1.52"));
    let long = ["simtest1", "--set", "simulation.frame_time=0.1", "--seconds", "1.51"];
    assert!(assert_same_run(&long).ends_with("&t=1.6"));
    let odd = ["simtest1", "--set", "simulation.duration=1.51", "--set", "name=\"a & b # c\""];
    assert!(assert_same_run(&odd).starts_with(&format!("{PAGE}#scene=simtest1&set=")));
    assert_eq!(link(&["two at a Time", "--time", "0"]), link(&["tutorial2", "--time", "0"]));
}

#[test]
fn a_scene_file_goes_into_the_link_whole() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("my own.toml");
    let text = "# A remark.\nname = \"own\"\n[[generators]]\nrandom = { count = 30, \
                min = [-2, 0, -2], max = [2, 4, 2], seed = 3, speed = 2, sphere = { radius = 0.2 } }\n\
                [[colliders]]\nshape = { box = { size = [1, 1, 1] } }\n";
    std::fs::write(&file, text).unwrap();
    let path = file.to_str().unwrap();
    let by_path = assert_same_run(&[path, "--seconds", "1"]);
    let parsed = Link::parse(&by_path).unwrap();
    assert!(format!("{:?}", parsed.source()).contains("A remark"));
    assert!(by_path.ends_with("&name=my%20own.toml&t=1"), "{by_path}");
    let folder = folder.path().to_str().unwrap();
    assert_eq!(link(&["own", "--seconds", "1", "--scenes", folder]), by_path);
    assert_same_run(&[path, "--set", "generators.0.random.count=4", "--seconds", "1"]);
}

#[test]
fn the_page_is_the_one_asked_for() {
    let page = "https://example.org/carom/";
    assert_eq!(link(&["simtest1", "--page", page]), format!("{page}#scene=simtest1"));
    let by_environment = |value: &str| {
        text_of(carom().args(["link", "simtest1"]).env("CAROM_PAGE", value).output().unwrap())
    };
    assert_eq!(by_environment(page), format!("{page}#scene=simtest1\n"));
    assert_eq!(by_environment(""), format!("{PAGE}#scene=simtest1\n"));
    let error = bad(&["link", "simtest1", "--page", "http://a/#b"], 2);
    assert_eq!(error, "carom: the address of a page must not contain #, as http://a/#b does\n");
}

/// A session with edits during the run, including the rule and the length of frames.
fn edited() -> Session {
    let (scene, _) = Library::new().find("simtest1", &[]).unwrap();
    let mut session = Session::new(scene).unwrap();
    session.edit(Edit::AllColliderRestitutions(0.7)).unwrap();
    session.jump(0.5).unwrap();
    session.edit(Edit::FrameTime(0.01)).unwrap();
    let velocity = Some(DVec3::new(0.1, 3.0, 1.0 / 3.0));
    let push = SphereChange { velocity, ..SphereChange::default() };
    session.edit(Edit::Sphere(SphereId::from_number(0), Box::new(push))).unwrap();
    session.jump(1.0).unwrap();
    let mut simulation = session.setup().simulation.clone();
    simulation.rule = Rule::Exact;
    session.edit(Edit::Simulation(Box::new(simulation))).unwrap();
    session.jump(2.5).unwrap();
    session
}

#[test]
fn a_run_with_edits_is_repeated_natively() {
    let session = edited();
    let link = format!("{PAGE}#{}", session.link());
    let summary = summary(&["--link", &link]);
    assert_eq!(summary["state_hash"], session.state_hash().to_string());
    assert_eq!(summary["edits"], 4);
    assert_eq!(summary["rule"], "exact", "as it is at the end");
    assert_eq!(summary["frames"], session.frame());
    let table = good(&["run", "--link", &link]);
    assert!(table.contains("edits            4 made on the way"), "{table}");
}

#[test]
fn a_run_of_a_link_is_written_like_any_other() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let link = link(&["simtest1", "--rule", "exact", "--seconds", "1"]);
    let outputs = |of: &[&str], number: u32| {
        let [out, impacts, ledger] =
            ["t", "i", "l"].map(|name| path(&format!("{name}{number}.csv")));
        let files = ["--out", &out, "--impacts", &impacts, "--ledger", &ledger];
        good(&[&["run"], of, &files].concat());
        [out, impacts, ledger].map(|file| std::fs::read_to_string(file).unwrap())
    };
    let scene = outputs(&["simtest1", "--rule", "exact", "--seconds", "1"], 1);
    assert_eq!(outputs(&["--link", &link], 2), scene);
    assert!(scene.iter().all(|text| text.lines().count() > 1));
    // The trajectory contains each frame with the edits made there.
    let (session, out) = (edited(), path("e.csv"));
    good(&["run", "--link", session.link().to_fragment().as_str(), "--out", &out]);
    let text = std::fs::read_to_string(out).unwrap();
    let pushed = format!("{:.16e},{:.16e},{:.16e}", 0.1, 3.0, 1.0 / 3.0);
    assert!(text.lines().any(|row| row.ends_with(&pushed)));
}

#[test]
fn a_link_is_read_from_the_standard_input() {
    let link = link(&["tutorial1", "--seconds", "1"]);
    let mut child = carom()
        .args(["run", "--link", "-", "--json"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    writeln!(child.stdin.take().unwrap(), "{link}").unwrap();
    let text = text_of(child.wait_with_output().unwrap());
    let run: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(figures(run), figures(summary(&["tutorial1", "--seconds", "1"])));
}

#[test]
fn what_is_no_link_ends_with_code_2_and_one_line() {
    let cases = [
        ("http://127.0.0.1:8042/", "the link is empty"),
        ("#t=1", "the link names no scene"),
        ("#scene=simtest1&seed=3", "the link has a part \"seed\""),
        ("#scene=simtest1&t=-1", "the link says t=-1.0"),
        ("#scene=simtest1&t=1e300", "more than 100,000,000 frames after the start"),
        ("#scene=simtest1&rule=magic", "the rules are exact, contact, bisect, discrete"),
        ("#scene=simtest1&set=emitters.9.period=1", "no element 9"),
        ("#scene=simtest1&edits=AAAA", "edits of the link is cut short or garbled"),
        ("#file=AAAA", "file of the link is cut short or garbled"),
        ("#scene=simtst1", "did you mean \"simtest1\"?"),
        ("#scene=scenes/simtest1.toml", "there is no scene"),
    ];
    for (link, expected) in cases {
        let error = bad(&["run", "--link", link], 2);
        assert_eq!(error.lines().count(), 1, "{error}");
        assert!(error.starts_with("carom: ") && error.contains(expected), "{error}");
    }
}

#[test]
fn a_broken_scene_in_a_link_ends_with_code_1_and_its_line() {
    let text = "name = \"broken\"\n\n[[spheres]]\nradius = -1\n".to_owned();
    let source = carom_session::LinkSource::File { name: "broken.toml".to_owned(), text };
    let error = bad(&["run", "--link", &Link::new(source).to_fragment()], 1);
    assert!(error.starts_with("carom: broken.toml:4: spheres[0].radius: must be"), "{error}");
    assert_eq!(error.lines().count(), 1);
}

#[test]
fn an_edit_that_is_refused_ends_with_code_1() {
    let mut other = Session::new(Library::new().find("tutorial1", &[]).unwrap().0).unwrap();
    other.jump(0.5).unwrap();
    other.edit(Edit::RemoveSphere(other.world().spheres().ids()[0])).unwrap();
    let edits = other.link().to_fragment();
    let edits = edits.split('&').find(|part| part.starts_with("edits=")).unwrap();
    let nothing = "#scene=simtest1&set=emitters=[]&t=3&";
    let error = bad(&["run", "--link", &format!("{nothing}{edits}")], 1);
    assert_eq!(
        error,
        "carom: the edit at frame 30 cannot be repeated: there is no sphere 0 \
         in this world\n"
    );
}

#[test]
fn a_link_says_all_of_a_run_itself() {
    let link = link(&["simtest1"]);
    for more in [
        &["simtest1"][..],
        &["--rule", "exact"],
        &["--seconds", "1"],
        &["--frames", "1"],
        &["--frame-time", "0.1"],
        &["simtest1", "--set", "name=\"a\""],
    ] {
        let error = bad(&[&["run", "--link", &link], more].concat(), 2);
        assert!(error.contains("cannot be used with"), "{error}");
    }
    bad(&["run"], 2);
    bad(&["run", "--set", "name=\"a\""], 2);
    bad(&["link"], 2);
    bad(&["link", "simtest1", "--seconds", "-1"], 2);
    bad(&["link", "simtest1", "--rule", "magic"], 2);
    assert!(bad(&["link", "simtst1"], 2).contains("did you mean \"simtest1\"?"));
    assert!(bad(&["link", "nowhere.toml"], 1).contains("cannot read"));
}
