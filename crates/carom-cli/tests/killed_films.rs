//! Films of killed processes, as read by ffprobe and ffmpeg. These must be installed, with a
//! graphics driver; a software driver is sufficient.
#![cfg(all(feature = "pictures", target_os = "linux"))]

mod command;

use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant, SystemTime};

use command::{bad_line, carom, good, kills, moments, path};

/// Longer than any step of these tests on a shared machine.
const PATIENCE: Duration = Duration::from_secs(60);
/// A small film, for software drivers.
const SMALL: [&str; 4] = ["--size", "96x54", "--quality", "draft"];
/// Bytes of a frame: brightness, and colours at half the resolution.
const FRAME: usize = 96 * 54 * 3 / 2;

/// Starts to film `seconds` of a scene.
fn begin(file: &str, seconds: &str) -> Child {
    let film = ["record", "simtest1", "--seconds", seconds, "--out", file];
    carom().args(film).args(SMALL).stdout(Stdio::null()).spawn().unwrap()
}

fn unfinished(file: &str) -> PathBuf {
    PathBuf::from(format!("{file}.0.unfinished"))
}

/// Decodes a film; returns a hash of each frame.
fn frames(file: &str) -> Vec<u64> {
    let arguments = ["-v", "error", "-i", file, "-f", "rawvideo", "-pix_fmt", "yuv420p", "-"];
    let output = Command::new("ffmpeg").args(arguments).output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && errors.is_empty(), "{errors}");
    let hash = |frame: &[u8]| {
        let mut hasher = DefaultHasher::new();
        frame.hash(&mut hasher);
        hasher.finish()
    };
    output.stdout.chunks_exact(FRAME).map(hash).collect()
}

/// Number of frames of a film that can be decoded.
fn count(file: &str) -> usize {
    let arguments = ["-v", "error", "-show_entries", "frame=pict_type", "-of", "csv=p=0", file];
    let output = Command::new("ffprobe").args(arguments).output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && errors.is_empty(), "{errors}");
    String::from_utf8_lossy(&output.stdout).lines().filter(|line| !line.is_empty()).count()
}

#[test]
fn a_killed_film_opens_with_every_frame_but_the_one_at_work() {
    let folder = tempfile::tempdir().unwrap();
    let [file, copy] = ["film.mp4", "copy.mp4"].map(|name| path(&folder, name));
    let left = unfinished(&file);
    let mut films = Vec::new();
    let mut oldest = Duration::ZERO;
    for moment in moments() {
        let mut child = begin(&file, "1e6");
        let began = Instant::now();
        while std::fs::metadata(&left).map_or(0, |it| it.len()) == 0 && began.elapsed() < PATIENCE {
            std::thread::sleep(Duration::from_millis(5));
        }
        std::thread::sleep(Duration::from_millis(moment));
        // The part of the film that players can read before the kill.
        std::fs::copy(&left, &copy).unwrap();
        child.kill().unwrap();
        let killed = SystemTime::now();
        child.wait().unwrap();
        let before = count(&copy);
        assert!(before > 0 && !Path::new(&file).exists());
        let written = std::fs::metadata(&left).unwrap().modified().unwrap();
        oldest = oldest.max(killed.duration_since(written).unwrap_or_default());
        let told = good(&["recover", &file]);
        let film = frames(&file);
        assert!(told.starts_with(&format!("{file}: {} frames, up to ", film.len())), "{told}");
        assert!(film.len() >= before, "{} of {before} frames", film.len());
        films.push(film);
        std::fs::remove_file(&file).unwrap();
        std::fs::remove_file(&copy).unwrap();
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "nothing else is left");
    }
    let longest = films.iter().map(Vec::len).max().unwrap();
    eprintln!("{} films, of up to {longest} frames; the last frame was {oldest:?} old", kills());
    let seconds = (longest as f64 / 30.0).to_string();
    good(&[&["record", "simtest1", "--seconds", &seconds, "--out", &file], &SMALL[..]].concat());
    let whole = frames(&file);
    for film in films {
        assert!(whole.starts_with(&film), "it is the beginning of the film that is not killed");
    }
}

#[test]
fn a_film_that_is_killed_at_any_moment_is_whole_or_can_be_recovered() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "film.mp4");
    let began = Instant::now();
    assert!(begin(&file, "0.5").wait().unwrap().success());
    let lasts = began.elapsed();
    let whole = frames(&file);
    let mut ends = [0; 3];
    for kill in 1..=kills() {
        std::fs::remove_file(&file).ok();
        let mut child = begin(&file, "0.5");
        // Scattered over the whole run and a little longer.
        std::thread::sleep(lasts.mul_f64((kill * 7919 % 1999) as f64 / 1800.0));
        child.kill().unwrap();
        child.wait().unwrap();
        let left = unfinished(&file);
        if Path::new(&file).exists() {
            assert!(frames(&file) == whole, "what has the name of the film is the film");
            ends[0] += 1;
        }
        if std::fs::metadata(&left).is_ok_and(|it| it.len() > 0) {
            good(&["recover", left.to_str().unwrap(), "--force"]);
            assert!(whole.starts_with(&frames(&file)) && !left.exists());
            ends[1] += 1;
        } else if left.exists() {
            assert!(bad_line(&["recover", &file], 2).contains("has no whole frame"));
            std::fs::remove_file(&left).unwrap();
            ends[2] += 1;
        }
    }
    let [done, recovered, empty] = ends;
    eprintln!("{done} were whole, {recovered} recovered, {empty} without a frame");
}

#[test]
fn a_film_that_is_still_made_is_not_recovered_and_what_is_there_is_not_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "film.mp4");
    let mut child = begin(&file, "1e6");
    let left = unfinished(&file);
    let began = Instant::now();
    // The program creates the file before it locks it, and locks it before it writes.
    while std::fs::metadata(&left).map_or(0, |it| it.len()) == 0 && began.elapsed() < PATIENCE {
        std::thread::sleep(Duration::from_millis(5));
    }
    assert!(bad_line(&["recover", &file], 2).contains("a program is still writing it"));
    std::thread::sleep(Duration::from_millis(500));
    child.kill().unwrap();
    child.wait().unwrap();
    std::fs::write(&file, "older").unwrap();
    assert!(bad_line(&["recover", &file], 2).contains("--force"));
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "older");
}
