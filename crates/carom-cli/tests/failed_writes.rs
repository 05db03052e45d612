//! Full disks at every write: the run ends with code 1 and one line of error, which is true, and
//! everything written before is kept.
//!
//! A limit on the size of files makes writes fail. The limits are closer together than the writes,
//! so each write fails in at least one case.
#![cfg(target_os = "linux")]

mod command;

use std::path::Path;
use std::process::{Command, Output};

use command::{CAROM, path};

/// A scene with impacts from the first frames on; few balls make small writes.
const RUN: [&str; 5] = ["run", "billiards", "--seconds", "0.3", "--out"];
/// Number of its frames.
const FRAMES: usize = 18;

/// Runs the command with a limit on the size of files.
fn limited(bytes: u64, arguments: &[&str]) -> Output {
    let mut shell = Command::new("sh");
    let script = format!("trap '' XFSZ; exec prlimit --fsize={bytes} \"$@\"");
    shell.args(["-c", &script, "sh", CAROM]).args(arguments);
    shell.env_remove("CAROM_CONFIG").env("XDG_CONFIG_HOME", "/nowhere");
    // Software drivers for graphics also write files.
    shell.env("XDG_RUNTIME_DIR", std::env::temp_dir()).env("MESA_SHADER_CACHE_DISABLE", "true");
    shell.output().unwrap()
}

/// Returns the line of error of a run that failed.
#[track_caller]
fn line_of(output: &Output) -> String {
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{errors}");
    assert_eq!(errors.lines().count(), 1, "{errors}");
    errors
}

/// Number of frames that the line reports as kept; 0 if it reports none.
fn kept(errors: &str) -> usize {
    let count = errors.split("kept are the ").nth(1).and_then(|it| it.split(' ').next());
    count.map_or(0, |text| text.parse().unwrap())
}

/// Sizes from 0 up to `most`.
fn sizes(most: u64, step: usize) -> impl Iterator<Item = u64> {
    (0..most).step_by(step).chain([most - 1])
}

fn size(file: &str) -> u64 {
    std::fs::metadata(file).unwrap().len()
}

#[test]
fn tables_keep_the_whole_rows_before_the_write_that_fails() {
    let folder = tempfile::tempdir().unwrap();
    let all = ["t.csv", "i.csv", "l.csv"].map(|name| path(&folder, name));
    for (option, table) in ["--out", "--impacts", "--ledger"].into_iter().zip(&all) {
        let arguments = [&RUN[..4], &[option, table]].concat();
        command::good(&arguments);
        let whole = std::fs::read_to_string(table).unwrap();
        let rows = whole.lines().count();
        assert!(rows > 10, "{option}: {rows} rows");
        for bytes in sizes(size(table), whole.len() / (2 * FRAMES)) {
            std::fs::remove_file(table).ok();
            let errors = line_of(&limited(bytes, &arguments));
            assert!(errors.contains(&format!("cannot write {table}: File too large")), "{errors}");
            let text = std::fs::read_to_string(table).unwrap();
            assert!(whole.starts_with(&text), "{option}: it is the beginning of the table");
            assert!(text.is_empty() || text.ends_with('\n'), "{option}: of whole rows");
            if option == "--out" {
                let mut times: Vec<_> = text.lines().skip(1).map(|it| &it[..22]).collect();
                times.dedup();
                assert_eq!(times.len(), kept(&errors), "{errors}");
            }
        }
    }
}

/// The times of the frames of an archive \[s\].
fn times(archive: &str) -> Vec<f64> {
    let mut zip = zip::ZipArchive::new(std::fs::File::open(archive).unwrap()).unwrap();
    let mut bytes = Vec::new();
    std::io::Read::read_to_end(&mut zip.by_name("time.npy").unwrap(), &mut bytes).unwrap();
    npyz::NpyFile::new(&bytes[..]).unwrap().into_vec::<f64>().unwrap()
}

#[test]
fn an_archive_is_made_of_the_frames_before_the_write_that_fails_or_can_be() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "t.npz");
    let arguments = [&RUN[..], &[&file]].concat();
    command::good(&arguments);
    let whole = times(&file);
    for bytes in sizes(size(&file), 1500) {
        std::fs::remove_file(&file).ok();
        let errors = line_of(&limited(bytes, &arguments));
        assert!(errors.contains(&format!("cannot write {file}: File too large")), "{errors}");
        let is_made = Path::new(&file).exists();
        if !is_made && bytes >= 16 {
            assert!(errors.contains("unfinished, for `carom recover`"), "{errors}");
            command::good(&["recover", &file]);
        } else if !is_made {
            // The archive was not even started.
            std::fs::remove_file(format!("{file}.0.unfinished")).ok();
            continue;
        }
        let times = times(&file);
        assert!(whole.starts_with(&times));
        // If only the creation of the archive failed, all frames are kept.
        let is_all = !errors.contains("kept are");
        assert_eq!(times.len(), if is_all { whole.len() } else { kept(&errors) }, "{errors}");
    }
}

/// Makes a run fail while it creates the complete file from the unfinished one, then recovers it.
fn fail_to_close(file: &str, arguments: &[&str]) {
    let obstacle = format!("{file}.0.closing");
    std::fs::create_dir(&obstacle).unwrap();
    let errors = line_of(&command::run(arguments));
    assert!(errors.contains(&format!("cannot write {file}: Is a directory")), "{errors}");
    assert!(errors.contains(&format!("in {file}.0.unfinished, for `carom recover`")), "{errors}");
    assert!(!Path::new(file).exists());
    std::fs::remove_dir(&obstacle).unwrap();
    command::good(&["recover", file]);
}

#[test]
fn an_archive_that_cannot_be_completed_can_be_recovered() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "t.npz");
    fail_to_close(&file, &[&RUN[..], &[&file]].concat());
    assert_eq!(times(&file).len(), FRAMES);
}

#[test]
fn a_series_lists_the_frames_before_the_one_that_fails() {
    for failing in 0..FRAMES {
        let folder = tempfile::tempdir().unwrap();
        let file = path(&folder, "run.pvd");
        // A folder of the same name prevents the file from being written.
        let obstacle = format!("run_frames/{failing:06}.vtp");
        std::fs::create_dir_all(folder.path().join(&obstacle)).unwrap();
        let arguments = [&RUN[..], &[&file, "--force"]].concat();
        let errors = line_of(&command::run(&arguments));
        assert!(errors.contains(&format!("cannot write {file}: {obstacle}: ")), "{errors}");
        assert_eq!(kept(&errors), failing, "{errors}");
        let list = std::fs::read_to_string(&file).unwrap();
        let listed = list.lines().filter(|line| line.contains("timestep")).count();
        assert!(list.ends_with("</VTKFile>\n") && listed == failing, "{listed} of {failing}");
    }
}

#[test]
fn a_list_that_fails_leaves_the_one_before_and_every_frame() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "run.pvd");
    std::fs::create_dir(folder.path().join("run.pvd.unfinished")).unwrap();
    let errors = line_of(&command::run(&[&RUN[..], &[&file]].concat()));
    assert!(errors.contains(&format!("cannot write {file}: ")), "{errors}");
    assert!(std::fs::read_to_string(&file).unwrap().ends_with("</VTKFile>\n"));
    assert_eq!(std::fs::read_dir(folder.path().join("run_frames")).unwrap().count(), FRAMES);
    // A frame that does not fit is not left in part.
    let small = path(&folder, "small.pvd");
    let errors = line_of(&limited(700, &[&RUN[..], &[&small]].concat()));
    assert!(errors.contains("small_frames/000000.vtp: File too large"), "{errors}");
    assert_eq!(std::fs::read_dir(folder.path().join("small_frames")).unwrap().count(), 0);
}

#[test]
fn an_animation_is_made_of_the_frames_before_the_write_that_fails_or_can_be() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "t.glb");
    // One ball: the table is larger than its motion, so that all frames may fit where the animation does not.
    let arguments = ["run", "masse", "--seconds", "0.3", "--out", &file];
    command::good(&arguments);
    let whole = std::fs::read(&file).unwrap();
    let mut counts = Vec::new();
    for bytes in sizes(size(&file), 4000) {
        std::fs::remove_file(&file).ok();
        let errors = line_of(&limited(bytes, &arguments));
        assert!(errors.contains(&format!("cannot write {file}: File too large")), "{errors}");
        let left = format!("{file}.0.unfinished");
        if !Path::new(&file).exists() {
            if !Path::new(&left).exists() {
                // The start of the run was not written.
                continue;
            }
            assert!(errors.contains("unfinished, for `carom recover`"), "{errors}");
            command::good(&["recover", &file]);
        }
        let is_all = !errors.contains("kept are");
        let frames = command::keys(&file).len();
        assert_eq!(frames, if is_all { FRAMES } else { kept(&errors) }, "{errors}");
        assert!(!is_all || std::fs::read(&file).unwrap() == whole);
        counts.push(frames);
    }
    assert!(counts.contains(&FRAMES) && counts.iter().any(|it| *it < FRAMES), "{counts:?}");
    std::fs::remove_file(&file).ok();
    fail_to_close(&file, &arguments);
    assert!(std::fs::read(&file).unwrap() == whole);
}

#[test]
#[cfg(feature = "pictures")]
fn a_film_that_cannot_be_completed_can_be_recovered() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "t.mp4");
    let arguments = [&["record", "simtest1"], &SMALL[..], &[&file]].concat();
    command::good(&arguments);
    let whole = std::fs::read(&file).unwrap();
    std::fs::remove_file(&file).unwrap();
    fail_to_close(&file, &arguments);
    assert!(std::fs::read(&file).unwrap() == whole);
}

/// A film of six small frames, for software drivers.
#[cfg(feature = "pictures")]
const SMALL: [&str; 7] = ["--size", "96x54", "--quality", "draft", "--seconds", "0.2", "--out"];

#[cfg(feature = "pictures")]
mod a_film_is_made_of_the_frames_before_the_write_that_fails_or_can_be {
    // Two tests run in parallel, because each film starts a graphics driver.
    #[test]
    fn with_one_half_of_the_limits() {
        super::a_film_is_made_or_can_be(0);
    }

    #[test]
    fn with_the_other_half() {
        super::a_film_is_made_or_can_be(1);
    }
}

/// Tests every second limit, starting with number `first`.
#[cfg(feature = "pictures")]
fn a_film_is_made_or_can_be(first: usize) {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "t.mp4");
    let arguments = [&["record", "simtest1"], &SMALL[..], &[&file]].concat();
    command::good(&arguments);
    let whole = std::fs::read(&file).unwrap();
    // The unfinished file is larger than the film.
    for bytes in sizes(whole.len() as u64, whole.len() / 8).skip(first).step_by(2) {
        std::fs::remove_file(&file).ok();
        let output = limited(bytes, &arguments);
        let errors = line_of(&output);
        assert!(errors.contains(&format!("cannot write {file}: File too large")), "{errors}");
        let told = String::from_utf8(output.stdout).unwrap();
        assert_eq!(!told.is_empty(), Path::new(&file).exists(), "{told}{errors}");
        let left = format!("{file}.0.unfinished");
        assert_eq!(Path::new(&left).exists(), errors.contains("for `carom recover`"), "{errors}");
        let count = |text: &str| text.split(" frames").next()?.rsplit(' ').next()?.parse().ok();
        let frames: Option<u64> = if Path::new(&left).exists() {
            let recovered = command::good(&["recover", &file]);
            assert_eq!(count(&recovered), count(&errors), "{recovered}{errors}");
            count(&recovered)
        } else {
            count(&told)
        };
        assert_eq!(frames.is_some(), Path::new(&file).exists(), "{told}{errors}");
        assert!(frames.is_none_or(|frames| (1..6).contains(&frames)), "{told}{errors}");
    }
}
