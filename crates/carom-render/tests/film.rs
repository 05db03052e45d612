//! Films have what players expect, checked by ffprobe and ffmpeg, which must be installed.
//!
//! Not checked: how a film looks.
#![cfg(feature = "film")]
#![allow(missing_docs)]

use std::path::Path;
#[cfg(unix)]
use std::path::PathBuf;
use std::process::Command;

#[cfg(unix)]
use carom_render::recover_film;
use carom_render::{Film, FilmError, Picture};
#[cfg(unix)]
use carom_scene::recording::{Recovered, RecoveryError};

const WIDTH: u32 = 320;
const HEIGHT: u32 = 180;

fn output(program: &str, args: &[&str], path: &Path) -> Vec<u8> {
    let args = args.iter().map(|arg| if *arg == "FILM" { path.as_os_str() } else { arg.as_ref() });
    let output = Command::new(program).args(args).output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && errors.is_empty(), "{program}: {errors}");
    output.stdout
}

/// Returns what ffprobe prints about the stream, as lines `key=value`.
fn probe(path: &Path, entries: &str) -> Vec<String> {
    let args =
        ["-v", "error", "-show_entries", entries, "-of", "default=noprint_wrappers=1", "FILM"];
    let text = String::from_utf8(output("ffprobe", &args, path)).unwrap();
    text.lines().map(str::to_owned).collect()
}

/// Returns the frames decoded to sRGB, three bytes per pixel.
fn frames(path: &Path) -> Vec<Vec<u8>> {
    // Without these flags ffmpeg converts colours quickly, with an error of a few levels.
    let scale = "scale=flags=bicubic+accurate_rnd+full_chroma_int";
    let args =
        ["-v", "error", "-i", "FILM", "-vf", scale, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"];
    let bytes = output("ffmpeg", &args, path);
    bytes.chunks_exact((3 * WIDTH * HEIGHT) as usize).map(<[u8]>::to_vec).collect()
}

fn picture(color: impl Fn(u32, u32) -> [u8; 3]) -> Picture {
    let places = (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y)));
    let pixels = places.flat_map(|(x, y)| {
        let [r, g, b] = color(x, y);
        [r, g, b, 255]
    });
    Picture { width: WIDTH, height: HEIGHT, pixels: pixels.collect() }
}

/// Returns a red bar on grey that moves 2 pixels per frame.
fn bar(frame: u32) -> Picture {
    let left = 20 + 2 * frame;
    picture(|x, _| if (left..left + 40).contains(&x) { [200, 40, 30] } else { [120, 130, 140] })
}

/// Writes a film of a moving bar.
fn film(path: &Path, frames: u32, rate: u32) {
    let mut film = Film::create(path, WIDTH, HEIGHT, rate).unwrap();
    for frame in 0..frames {
        film.add(&bar(frame)).unwrap();
    }
    let summary = film.finish().unwrap();
    assert_eq!(summary.frames, u64::from(frames));
    assert_eq!(summary.seconds, f64::from(frames) / f64::from(rate));
    assert_eq!(summary.bytes, std::fs::metadata(path).unwrap().len());
}

#[test]
fn players_find_h264_with_its_colours_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("films/new/bar.mp4");
    film(&path, 10, 30);
    let entries = "codec_name,width,height,pix_fmt,has_b_frames,color_range,color_space,\
                   color_transfer,color_primaries";
    let found = probe(&path, &format!("stream={entries}"));
    let expected = [
        "codec_name=h264",
        "width=320",
        "height=180",
        "has_b_frames=0",
        "pix_fmt=yuv420p",
        "color_range=tv",
        "color_space=bt709",
        "color_transfer=bt709",
        "color_primaries=bt709",
    ];
    assert_eq!(found, expected);
}

#[test]
fn every_frame_lasts_equally_long() {
    let folder = tempfile::tempdir().unwrap();
    for (rate, frames) in [(24, 25), (30, 45), (60, 90), (1, 2)] {
        let path = folder.path().join(format!("{rate}.mp4"));
        film(&path, frames, rate);
        let duration = format!("duration={:.6}", f64::from(frames) / f64::from(rate));
        let found = probe(&path, "stream=r_frame_rate,avg_frame_rate,duration,nb_frames");
        let rates =
            [format!("r_frame_rate={rate}/1"), format!("avg_frame_rate={rate}/1"), duration];
        assert_eq!(found[..3], rates);
        assert_eq!(found[3], format!("nb_frames={frames}"));
        let times = probe(&path, "packet=pts");
        let times: Vec<u32> = times.iter().map(|line| line[4..].parse().unwrap()).collect();
        let expected: Vec<u32> = (0..frames).map(|frame| frame * 90_000 / rate).collect();
        assert_eq!(times, expected);
    }
}

#[test]
fn players_can_seek_every_two_seconds() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bar.mp4");
    film(&path, 130, 30);
    let flags = probe(&path, "packet=flags");
    let keyframes = flags.iter().enumerate().filter(|(_, line)| line.starts_with("flags=K"));
    assert_eq!(keyframes.map(|(i, _)| i).collect::<Vec<_>>(), [0, 60, 120]);
}

#[test]
fn a_film_can_be_watched_while_it_is_loaded() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bar.mp4");
    film(&path, 10, 30);
    let bytes = std::fs::read(&path).unwrap();
    let place = |name: &[u8]| bytes.windows(4).position(|word| word == name).unwrap();
    assert!(place(b"moov") < place(b"mdat"));
}

/// A still film has patches of every kind of colour.
#[test]
fn colours_come_back() {
    let levels = [0, 64, 128, 192, 255];
    let color = |x: u32, y: u32| {
        let patch = (x / 20) + 16 * (y / 20);
        [patch % 5, patch / 5 % 5, patch / 25 % 5].map(|level| levels[level as usize])
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("patches.mp4");
    let mut film = Film::create(&path, WIDTH, HEIGHT, 30).unwrap();
    for _ in 0..5 {
        film.add(&picture(color)).unwrap();
    }
    film.finish().unwrap();
    let mut worst = 0;
    for frame in frames(&path) {
        // The middles of patches: colours of neighbours mix at half the resolution.
        for (x, y) in (0..9).flat_map(|j| (0..16).map(move |i| (20 * i + 10, 20 * j + 10))) {
            let start = (3 * (y * WIDTH + x)) as usize;
            for (found, wanted) in frame[start..start + 3].iter().zip(color(x, y)) {
                worst = worst.max(found.abs_diff(wanted));
            }
        }
    }
    // A level of colour in the film is up to 2.1 levels of blue; the rest is compression. With the
    // weights of BT.601, pure colours would be off by 20 and more.
    assert!(worst <= 6, "{worst}");
}

#[test]
fn frames_come_back_in_order() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bar.mp4");
    film(&path, 70, 30);
    let frames = frames(&path);
    assert_eq!(frames.len(), 70);
    for (frame, pixels) in (0..).zip(frames) {
        let row = &pixels[(3 * WIDTH * 90) as usize..][..3 * WIDTH as usize];
        let reds = row.chunks_exact(3).map(|pixel| pixel[0] > 160);
        let left = reds.clone().position(|is_red| is_red).unwrap() as u32;
        // Colours have half the resolution, so a column on each side may be mixed.
        assert!(left.abs_diff(20 + 2 * frame) <= 1, "{frame}: {left}");
        assert!(reds.filter(|is_red| *is_red).count().abs_diff(40) <= 2);
    }
}

#[test]
fn a_dropped_film_is_finished_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bar.mp4");
    let mut film = Film::create(&path, WIDTH, HEIGHT, 30).unwrap();
    for frame in 0..7 {
        film.add(&bar(frame)).unwrap();
    }
    assert!(!path.exists(), "it has no name yet");
    drop(film);
    assert_eq!(frames(&path).len(), 7);
}

#[test]
fn a_film_without_frames_leaves_what_was_there() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bar.mp4");
    std::fs::write(&path, "older").unwrap();
    drop(Film::create(&path, WIDTH, HEIGHT, 30).unwrap());
    let finished = Film::create(&path, WIDTH, HEIGHT, 30).unwrap().finish();
    assert!(matches!(finished, Err(FilmError::Empty { .. })));
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "older");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

/// Copies the unfinished film of `path`, as a killed process would leave it, to the name of an
/// unfinished film of `other`.
#[cfg(unix)]
fn left_by_a_kill(path: &Path, other: &Path) -> PathBuf {
    let named = |path: &Path| PathBuf::from(format!("{}.0.unfinished", path.display()));
    std::fs::copy(named(path), named(other)).unwrap();
    named(other)
}

#[test]
#[cfg(unix)]
fn players_open_the_unfinished_file_with_every_frame_added_so_far() {
    let folder = tempfile::tempdir().unwrap();
    let [path, seen] = ["film.mp4", "seen.mp4"].map(|name| folder.path().join(name));
    for rate in [1, 24, 30, 240] {
        let mut film = Film::create(&path, WIDTH, HEIGHT, rate).unwrap();
        for count in 1..=4 {
            film.add(&bar(count)).unwrap();
            let copy = left_by_a_kill(&path, &seen);
            let times: Vec<String> =
                (0..count).map(|k| format!("pts={}", k * 90_000 / rate)).collect();
            assert_eq!(probe(&copy, "packet=pts"), times, "{rate}");
            assert_eq!(probe(&copy, "frame=pict_type").len(), count as usize, "all are decoded");
        }
    }
}

#[test]
#[cfg(unix)]
fn a_recovered_film_is_byte_for_byte_the_film_of_its_frames() {
    let folder = tempfile::tempdir().unwrap();
    let [path, other] = ["film.mp4", "other.mp4"].map(|name| folder.path().join(name));
    // Two of these frames are keyframes.
    let mut film = Film::create(&path, WIDTH, HEIGHT, 25).unwrap();
    for frame in 0..60 {
        film.add(&bar(frame)).unwrap();
    }
    let left = left_by_a_kill(&path, &other);
    film.finish().unwrap();
    let recovered = recover_film(&left, &other).unwrap();
    let Recovered { frames, last, left_out, is_damaged } = recovered;
    assert_eq!((frames, last, left_out, is_damaged), (60, Some(59.0 / 25.0), 0, false));
    assert!(std::fs::read(&path).unwrap() == std::fs::read(&other).unwrap());
    assert!(!left.exists());
}

#[test]
#[cfg(unix)]
fn a_frame_that_is_cut_short_anywhere_is_left_out() {
    let folder = tempfile::tempdir().unwrap();
    let [path, other] = ["film.mp4", "other.mp4"].map(|name| folder.path().join(name));
    let mut film = Film::create(&path, WIDTH, HEIGHT, 30).unwrap();
    let mut ends = Vec::new();
    let mut left = PathBuf::new();
    for frame in 0..4 {
        film.add(&bar(frame)).unwrap();
        left = left_by_a_kill(&path, &other);
        ends.push(std::fs::metadata(&left).unwrap().len());
    }
    let bytes = std::fs::read(&left).unwrap();
    let places = (ends[0]..=ends[3]).step_by(37).chain([1, 3].map(|frame: usize| ends[frame]));
    for length in places {
        std::fs::write(&left, &bytes[..length as usize]).unwrap();
        let whole = ends.iter().filter(|end| **end <= length).count();
        let Recovered { frames, left_out, is_damaged, .. } = recover_film(&left, &other).unwrap();
        assert_eq!(frames, whole as u64, "{length} of {ends:?}");
        assert_eq!((left_out, is_damaged), (length - ends[whole - 1], false));
    }
    // If the file ends before the first frame does, no film is made and the file stays.
    for length in [0, ends[0] - 1] {
        std::fs::write(&left, &bytes[..length as usize]).unwrap();
        let error = recover_film(&left, &other).unwrap_err();
        assert!(matches!(error, RecoveryError::Empty { .. }), "{length}: {error}");
        assert!(left.exists());
    }
}

#[test]
#[cfg(unix)]
fn what_is_damaged_ends_a_recovered_film_and_the_unfinished_file_stays() {
    let folder = tempfile::tempdir().unwrap();
    let [path, other] = ["film.mp4", "other.mp4"].map(|name| folder.path().join(name));
    let mut film = Film::create(&path, WIDTH, HEIGHT, 30).unwrap();
    let mut ends = Vec::new();
    let mut left = PathBuf::new();
    for frame in 0..4 {
        film.add(&bar(frame)).unwrap();
        left = left_by_a_kill(&path, &other);
        ends.push(std::fs::metadata(&left).unwrap().len() as usize);
    }
    let bytes = std::fs::read(&left).unwrap();
    // In the box before the third frame, and in the length of its first part.
    for place in [ends[1] + 3, ends[1] + 50, ends[1] + 90, ends[1] + 104, ends[1] + 110] {
        let mut damaged = bytes.clone();
        damaged[place] ^= 0x10;
        std::fs::write(&left, &damaged).unwrap();
        let Recovered { frames, is_damaged, .. } = recover_film(&left, &other).unwrap();
        assert_eq!((frames, is_damaged), (2, true), "{place}");
        assert!(left.exists());
    }
    for foreign in [&b"something else"[..], &[0; 2000], &bytes[7..]] {
        std::fs::write(&left, foreign).unwrap();
        let error = recover_film(&left, &other).unwrap_err();
        assert!(matches!(error, RecoveryError::Foreign { .. }), "{error}");
    }
}

#[test]
#[cfg(unix)]
fn a_film_goes_through_a_pipe() {
    let folder = tempfile::tempdir().unwrap();
    let [pipe, copy] = ["pipe.mp4", "copy.mp4"].map(|name| folder.path().join(name));
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let out = std::fs::File::create(&copy).unwrap();
    let mut reader = Command::new("cat").arg(&pipe).stdout(out).spawn().unwrap();
    let mut film = Film::create(&pipe, WIDTH, HEIGHT, 30).unwrap();
    (0..5).for_each(|frame| film.add(&bar(frame)).unwrap());
    film.finish().unwrap();
    assert!(reader.wait().unwrap().success());
    assert_eq!(frames(&copy).len(), 5);
}

#[test]
fn the_smallest_and_largest_films_can_be_watched() {
    let folder = tempfile::tempdir().unwrap();
    for (width, height, rate) in [(16, 16, 1), (18, 34, 30), (2160, 3840, 240)] {
        let path = folder.path().join("film.mp4");
        let mut film = Film::create(&path, width, height, rate).unwrap();
        let pixels = [10, 200, 90, 255].repeat((width * height) as usize);
        film.add(&Picture { width, height, pixels }).unwrap();
        film.finish().unwrap();
        let found = probe(&path, "stream=width,height,nb_frames");
        let sizes = [format!("width={width}"), format!("height={height}")];
        assert_eq!(found[..2], sizes);
        assert_eq!(found[2], "nb_frames=1");
    }
}

#[test]
fn what_films_cannot_have_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("none.mp4");
    for (width, height) in [(321, 180), (320, 181), (0, 0), (8, 8), (3842, 2160), (2400, 2400)] {
        let error = Film::create(&path, width, height, 30).unwrap_err();
        assert!(matches!(error, FilmError::Size { .. }), "{error}");
    }
    for rate in [0, 7, 1000] {
        let error = Film::create(&path, WIDTH, HEIGHT, rate).unwrap_err();
        assert!(matches!(error, FilmError::Rate { .. }), "{error}");
    }
    let mut film = Film::create(&path, WIDTH, HEIGHT, 30).unwrap();
    let other = Picture { width: 2, height: 2, pixels: vec![0; 16] };
    assert!(matches!(film.add(&other), Err(FilmError::OtherSize { .. })));
    let broken = Picture { width: WIDTH, height: HEIGHT, pixels: vec![0; 16] };
    assert!(matches!(film.add(&broken), Err(FilmError::Picture(_))));
}

#[test]
fn a_place_that_cannot_be_written_to_is_told_at_once() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("file"), "").unwrap();
    let path = folder.path().join("file/film.mp4");
    let error = Film::create(&path, WIDTH, HEIGHT, 30).unwrap_err();
    assert!(error.to_string().starts_with(&format!("cannot write {}: ", path.display())));
}

/// `/dev/full` is a full disk on Linux.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told() {
    let mut film = Film::create("/dev/full", WIDTH, HEIGHT, 30).unwrap();
    film.add(&bar(0)).unwrap();
    let error = film.finish().unwrap_err();
    assert!(matches!(error, FilmError::Unwritable { .. }));
    assert!(error.to_string().contains("No space left"), "{error}");
}
