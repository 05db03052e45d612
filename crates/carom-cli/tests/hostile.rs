//! Hostile or broken input is refused in one line that names its place, before it costs memory or
//! time, and cannot send control characters to the terminal. These tests have found: links of a few
//! kB that took gigabytes, escape sequences of files on the error stream, and recordings with
//! incomplete rows.

mod command;

use std::fmt::Write;

use command::{bad, bad_line, carom, good, path};

/// A lattice with `count` spheres along x, on one line.
fn lattice(count: u32) -> String {
    format!(
        "[[generators]]\nlattice = {{ counts = [{count}, 100, 100], start = [0, 0, 0], \
         spacing = [1, 1, 1], sphere = {{ radius = 0.1 }} }}\n"
    )
}

/// Writes a scene file to a new folder, which exists as long as the first value.
fn scene(text: &str) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "scene.toml");
    std::fs::write(&file, text).unwrap();
    (folder, file)
}

#[test]
fn a_small_file_that_asks_for_millions_of_spheres_is_refused_before_they_are_made() {
    // All of them have no place in any memory.
    let (_folder, file) = scene(&lattice(1000).repeat(1000));
    let error = bad(&["check", &file], 1);
    let expected = "scene.toml:1: generators[0]: makes 10000000 spheres";
    assert!(error.contains(expected) && error.contains("2000000 at most"), "{error}");
}

#[test]
fn the_owner_sets_how_many_spheres_a_file_may_ask_for() {
    let (folder, file) = scene(&lattice(1));
    good(&["check", &file]);
    assert!(bad(&["check", &file, "--max-spheres", "9999"], 1).contains("9999 at most"));
    assert!(bad(&["run", &file, "--max-spheres", "9999"], 1).contains("9999 at most"));
    let limited = carom().args(["check", &file]).env("CAROM_MAX_SPHERES", "10").output().unwrap();
    assert!(String::from_utf8_lossy(&limited.stderr).contains("10 at most"));
    let config = path(&folder, "config.toml");
    std::fs::write(&config, "max_spheres = 11\n").unwrap();
    let limited = carom().args(["check", &file]).env("CAROM_CONFIG", &config).output().unwrap();
    assert!(String::from_utf8_lossy(&limited.stderr).contains("11 at most"));
    bad(&["check", &file, "--max-spheres", "0"], 2);
    let wrong = carom().args(["check", &file]).env("CAROM_MAX_SPHERES", "many").output().unwrap();
    assert_eq!(wrong.status.code(), Some(2));
}

#[test]
fn a_link_may_ask_for_fewer_spheres_than_a_file() {
    let (_folder, file) = scene(&lattice(30));
    let link = good(&["link", &file, "--page", "https://example.org/"]);
    let error = bad_line(&["run", "--link", link.trim()], 1);
    assert!(error.contains("scene.toml:1: generators[0]: makes 300000 spheres"), "{error}");
    let grown = "https://example.org/#scene=tutorial1&set=generators=\
                 [{lattice={counts=[100,100,100],start=[0,0,0],spacing=[1,1,1],sphere={radius=0.1}}}]";
    assert!(bad_line(&["run", "--link", grown], 2).contains("200000 at most"));
}

#[test]
fn what_has_no_end_is_no_scene() {
    if cfg!(unix) {
        assert!(bad(&["check", "/dev/zero"], 1).contains("/dev/zero: it is longer than"));
    }
}

#[test]
fn what_a_file_says_does_not_steer_the_terminal() {
    let (_folder, file) = scene("\"\\u001b[31mred\\u202e\" = 1\n");
    for arguments in [&["check", &file][..], &["run", &file]] {
        let error = bad(arguments, 1);
        assert!(error.contains("\\u{1b}[31mred\\u{202e}"), "{error}");
        assert!(!error.contains(['\u{1b}', '\u{202e}']), "{error:?}");
    }
    let error = bad(&["run", "x", "--every", "\u{1b}[31m\u{202e}"], 2);
    assert!(!error.contains(['\u{1b}', '\u{202e}']) && error.contains("\\u{202e}"), "{error}");
}

#[test]
fn an_integer_that_is_too_large_is_named_with_its_line() {
    let text = "name = 'x'\n[[spheres]]\nradius = 1\n[[generators]]\n[generators.row]\n\
                count = 18446744073709551615\n";
    let (_folder, file) = scene(text);
    let error = bad(&["check", &file], 1);
    assert!(error.contains("scene.toml:6: "), "{error}");
}

#[test]
fn a_tolerance_makes_sense_under_every_rule() {
    let ball = "[[spheres]]\nradius = 1\n[simulation]\nrule = 'exact'\n";
    let (_folder, file) = scene(&format!("{ball}bisect = {{ tolerance = -1.0 }}\n"));
    assert!(bad(&["check", &file], 1).contains("scene.toml:5: simulation.bisect.tolerance"));
}

#[test]
fn a_size_beside_a_range_of_radii_makes_sense() {
    let random = "[[generators]]\n[generators.random]\ncount = 2\nmin = [0, 0, 0]\nmax = [9, 9, 9]\n\
                  seed = 1\nradius_range = [0.1, 0.2]\nsphere = { radius = 0 }\n";
    let (_folder, file) = scene(random);
    assert!(bad(&["check", &file], 1).contains("scene.toml:8: "));
}

#[test]
fn energies_that_no_number_holds_are_refused() {
    let (_folder, file) = scene("[[spheres]]\nradius = 1\nvelocity = [1e308, 0, 0]\n");
    let error = bad(&["check", &file], 1);
    assert!(error.contains("scene.toml:3: spheres[0].velocity: is too large"), "{error}");
    let heavy = "spheres = [{ radius = 1, position = [0, 1e300, 0], mass = 1e9 }]\n\
                 forces = [{ gravity = { acceleration = [0, -10, 0] } }]\n";
    let (_folder, file) = scene(heavy);
    let error = bad_line(&["run", &file, "--frames", "1", "--json"], 1);
    assert!(error.contains("the energy is not finite"), "{error}");
}

#[test]
fn tables_have_files_of_their_own_that_end_as_tables_do() {
    let folder = tempfile::tempdir().unwrap();
    let (table, archive) = (path(&folder, "t.csv"), path(&folder, "x.npz"));
    let run = ["run", "tutorial1", "--rule", "exact", "--frames", "1"];
    for option in ["--wells", "--ledger"] {
        assert!(bad_line(&[&run[..], &[option, &archive]].concat(), 2).contains(".csv"));
    }
    let other = path(&folder, "./t.csv");
    let same = bad_line(&[&run[..], &["--out", &table, "--impacts", &other]].concat(), 2);
    assert!(same.contains("the same file"), "{same}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_one_line_for_every_format() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["t.csv", "t.npz"] {
        let file = path(&folder, name);
        std::os::unix::fs::symlink("/dev/full", &file).unwrap();
        let error = bad_line(&["run", "tutorial1", "--frames", "50", "--out", &file, "-f"], 1);
        assert!(error.contains("No space left"), "{error}");
    }
}

#[test]
fn thousands_of_faults_are_short_lines() {
    let mut text = String::new();
    (0..1000).for_each(|_| writeln!(text, "[[spheres]]\n{} = 1", "x".repeat(10_000)).unwrap());
    let (_folder, file) = scene(&text);
    let error = bad(&["check", &file], 1);
    assert!(error.lines().count() <= 21 && error.lines().all(|line| line.len() < 5000));
}

#[test]
fn a_benchmark_ends_some_day() {
    let bench = ["bench", "--n", "10", "--packing-fraction", "0.1", "--impacts", "4294967296"];
    bad(&bench, 2);
}
