//! Pictures and films, as read by ffprobe and ffmpeg. These must be installed, with a graphics
//! driver; a software driver is sufficient.
//!
//! These tests do not check what pictures look like.
#![cfg(feature = "pictures")]

mod command;

use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use carom_render::Picture;
use command::{bad, bad_line, carom, good, path};
use tempfile::TempDir;

/// Small pictures, for software drivers.
const SMALL: [&str; 4] = ["--size", "320x180", "--quality", "draft"];
const WIDTH: usize = 320;
const HEIGHT: usize = 180;

#[track_caller]
fn picture(folder: &TempDir, arguments: &[&str]) -> Picture {
    let file = path(folder, "picture.png");
    good(&[&["picture"], arguments, &SMALL, &["--force", "--out", &file]].concat());
    Picture::from_png(&std::fs::read(&file).unwrap()).unwrap()
}

#[track_caller]
fn film(file: &str, arguments: &[&str]) -> String {
    good(&[&["record"], arguments, &SMALL, &["--force", "--out", file]].concat())
}

fn output(program: &str, arguments: &[&str]) -> Vec<u8> {
    let Output { status, stdout, stderr } = Command::new(program).args(arguments).output().unwrap();
    let errors = String::from_utf8_lossy(&stderr);
    assert!(status.success() && errors.is_empty(), "{program}: {errors}");
    stdout
}

/// Codec, width, height, rate and number of decoded frames of a film.
fn probe(file: &str) -> String {
    let entries = "stream=codec_name,width,height,avg_frame_rate,nb_read_frames";
    let arguments = ["-v", "error", "-count_frames", "-show_entries", entries, "-of", "csv=p=0"];
    let text = String::from_utf8(output("ffprobe", &[&arguments[..], &[file]].concat())).unwrap();
    text.trim().to_owned()
}

/// Decodes the frames of a film.
fn frames(file: &str) -> Vec<Vec<u8>> {
    let arguments = ["-v", "error", "-i", file, "-f", "rawvideo", "-pix_fmt", "yuv420p", "-"];
    let bytes = output("ffmpeg", &arguments);
    bytes.chunks_exact(WIDTH * HEIGHT * 3 / 2).map(<[u8]>::to_vec).collect()
}

#[test]
fn a_picture_has_the_size_asked_for_and_is_the_same_bits_again() {
    let folder = tempfile::tempdir().unwrap();
    let once = picture(&folder, &["simtest1", "--at", "2", "--no-stamp"]);
    assert_eq!([once.width as usize, once.height as usize], [WIDTH, HEIGHT]);
    assert_eq!(picture(&folder, &["simtest1", "--at", "2", "--no-stamp"]), once);
    assert_ne!(picture(&folder, &["simtest1", "--at", "3", "--no-stamp"]), once);
}

#[test]
fn the_stamp_is_in_the_lower_left_corner_only() {
    let folder = tempfile::tempdir().unwrap();
    let plain = picture(&folder, &["simtest1", "--at", "2", "--no-stamp"]);
    let stamped = picture(&folder, &["simtest1", "--at", "2"]);
    let pixels = plain.pixels.chunks_exact(4).zip(stamped.pixels.chunks_exact(4)).enumerate();
    let changed: Vec<_> = pixels.filter(|(_, (a, b))| a != b).map(|(i, _)| i).collect();
    assert!(changed.len() > 500, "{}", changed.len());
    assert!(changed.iter().all(|i| i % WIDTH < WIDTH / 2 && i / WIDTH > HEIGHT * 4 / 5));
}

#[test]
fn a_title_in_any_script_is_written_or_its_missing_characters_are_reported() {
    let folder = tempfile::tempdir().unwrap();
    let (file, scene) = (path(&folder, "p.png"), path(&folder, "s.toml"));
    // The last is no character, so no font has it.
    for (title, lacks) in [("Bälle 🎱", ""), ("a\u{10fffe}b", "\u{10fffe}")] {
        std::fs::write(&scene, format!("title = \"{title}\"\nspheres = [{{ radius = 1 }}]"))
            .unwrap();
        let run = [&["picture", &scene, "--force", "--out", &file], &SMALL[..]].concat();
        let output = carom().args(run).output().unwrap();
        let told = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.success(), "{told}");
        assert_eq!(told.contains("the stamp lacks"), !lacks.is_empty(), "{told}");
    }
}

#[test]
fn a_picture_is_that_of_the_nearest_frame() {
    let folder = tempfile::tempdir().unwrap();
    let at = |time| picture(&folder, &["tutorial1", "--at", time]);
    // Frames of 1/60 s are rounded to the nearest.
    assert_eq!(at("0.515"), at("0.5166666"));
    assert_ne!(at("0.515"), at("0.5"));
}

/// A red ball away from every axis.
const RED_BALL: &str = "name = \"red\"\n[[spheres]]\nposition = [3, 1, -2]\nradius = 0.5\n\
                        color = [0.9, 0.1, 0.1]\n";

#[test]
fn the_camera_looks_where_it_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let scene = path(&folder, "red.toml");
    std::fs::write(&scene, RED_BALL).unwrap();
    let middle_is_red = |camera| {
        let picture = picture(&folder, &[&scene, "--camera", camera]);
        let middle = 4 * (HEIGHT / 2 * WIDTH + WIDTH / 2);
        let [red, green, _, _] = picture.pixels[middle..middle + 4] else { panic!("a pixel") };
        red / 2 > green
    };
    for camera in ["scene", "front", "top", "fit", "-3,1,-2,3,1,-2"] {
        assert!(middle_is_red(camera), "{camera}");
    }
    assert!(!middle_is_red("-3,1,-2,3,4,-2"));
}

#[test]
fn a_film_of_a_second_at_30_frames_has_30() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "films/a.mp4");
    let line = film(&file, &["simtest1", "--seconds", "1"]);
    assert_eq!(probe(&file), "h264,320,180,30/1,30");
    assert!(line.starts_with(&format!("{file}: 30 frames, 1.00 s, ")), "{line}");
    film(&file, &["simtest1", "--seconds", "0.5", "--fps", "60", "--rule", "bisect"]);
    assert_eq!(probe(&file), "h264,320,180,60/1,30");
}

#[test]
fn the_film_of_a_recorded_run_is_the_film_of_the_run() {
    let folder = tempfile::tempdir().unwrap();
    let [table, live, replayed] =
        ["run.csv", "live.mp4", "replayed.mp4"].map(|name| path(&folder, name));
    let heavy = ["--set", "emitters.0.sphere.mass=3"];
    good(&[&["run", "simtest1", "--seconds", "2", "--out", &table], &heavy[..]].concat());
    // Every frame of the film is a frame of the run, because frames last 0.02 s.
    film(&live, &[&["simtest1", "--seconds", "2", "--fps", "25"], &heavy[..]].concat());
    film(&replayed, &[&["simtest1", "--from", &table, "--fps", "25"], &heavy[..]].concat());
    let [live, replayed] = [live, replayed].map(|file| frames(&file));
    assert_eq!([live.len(), replayed.len()], [50, 50], "as long as the recording");
    // Tables have all 17 digits and drawing is deterministic, so both are equal.
    assert!(live == replayed);
    assert!(live[49] != live[40], "something moves");
}

#[test]
fn threads_are_seen_in_pictures_and_in_films_of_recordings() {
    let folder = tempfile::tempdir().unwrap();
    let hung = picture(&folder, &["cradle-on-threads", "--no-stamp"]);
    let loose = picture(&folder, &["cradle-on-threads", "--no-stamp", "--set", "springs=none"]);
    assert!(hung.pixels != loose.pixels);
    let [table, live, replayed] =
        ["run.csv", "live.mp4", "replayed.mp4"].map(|name| path(&folder, name));
    good(&["run", "cradle-on-threads", "--seconds", "0.5", "--out", &table]);
    film(&live, &["cradle-on-threads", "--seconds", "0.5", "--fps", "30"]);
    film(&replayed, &["cradle-on-threads", "--from", &table, "--fps", "30"]);
    assert!(frames(&live) == frames(&replayed));
}

#[test]
fn balls_of_a_recorded_run_turn_as_they_did() {
    let folder = tempfile::tempdir().unwrap();
    let [table, plain, live, replayed, unturned] =
        ["run.csv", "plain.csv", "live.mp4", "replayed.mp4", "unturned.mp4"]
            .map(|name| path(&folder, name));
    let spun = ["--set", "emitters.0.sphere.angular_velocity=[0, 0, 20]"];
    good(&[&["run", "simtest1", "--seconds", "1", "--out", &table], &spun[..]].concat());
    film(&live, &[&["simtest1", "--seconds", "1", "--fps", "25"], &spun[..]].concat());
    film(&replayed, &[&["simtest1", "--from", &table, "--fps", "25"], &spun[..]].concat());
    // The table without its columns of rotation, as older versions wrote it.
    let text = std::fs::read_to_string(&table).unwrap();
    let cut = |line: &str| line.split(',').take(8).collect::<Vec<_>>().join(",") + "\n";
    std::fs::write(&plain, text.lines().map(cut).collect::<String>()).unwrap();
    film(&unturned, &[&["simtest1", "--from", &plain, "--fps", "25"], &spun[..]].concat());
    let [live, replayed, unturned] = [live, replayed, unturned].map(|file| frames(&file));
    assert!(live == replayed);
    assert!(live != unturned, "the bands are seen");
}

#[test]
fn a_film_of_a_recording_ends_with_it_and_can_be_shorter() {
    let folder = tempfile::tempdir().unwrap();
    let [table, file] = ["run.csv", "film.mp4"].map(|name| path(&folder, name));
    good(&["run", "tutorial1", "--seconds", "0.5", "--out", &table]);
    for (seconds, count) in [("9", 15), ("0.2", 6)] {
        film(&file, &["tutorial1", "--from", &table, "--seconds", seconds]);
        assert_eq!(probe(&file), format!("h264,320,180,30/1,{count}"));
    }
    let again = ["record", "simtest1", "--from", "none.csv", "--out", &file];
    assert!(bad_line(&again, 2).contains("--force"));
    let text = bad_line(&[&again[..], &["-f"]].concat(), 1);
    assert!(text.contains("cannot read none.csv"), "{text}");
}

#[test]
#[cfg(unix)]
fn ctrl_c_leaves_a_film_that_can_be_played() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "film.mp4");
    let mut command = carom();
    command.args(["record", "simtest1", "--seconds", "1e6", "--out", &file]).args(SMALL);
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    // The command reacts to Ctrl-C before it starts the film.
    let unfinished = format!("{file}.0.unfinished");
    let began = Instant::now();
    let is_begun = || std::fs::metadata(&unfinished).is_ok_and(|it| it.len() > 10_000);
    while !is_begun() && began.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(20));
    }
    let killed = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(killed.success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130));
    let told = String::from_utf8(output.stdout).unwrap();
    assert!(told.contains(" frames, "), "{told}");
    assert!(probe(&file).starts_with("h264,320,180,30/1,"));
    assert!(!frames(&file).is_empty());
    assert!(!Path::new(&unfinished).exists());
}

#[test]
fn a_random_maze_is_printed_and_filmed() {
    let folder = tempfile::tempdir().unwrap();
    let [maze, file] = ["maze.txt", "maze.mp4"].map(|name| path(&folder, name));
    let print = ["maze", "--random", "3", "--size", "4x3", "--print"];
    std::fs::write(&maze, good(&print)).unwrap();
    film(&file, &[&maze, "--play", "--seconds", "0.2", "--fps", "50"]);
    assert_eq!(probe(&file), "h264,320,180,50/1,10");
}

#[test]
fn all_films_are_made_and_told_one_by_one() {
    let folder = tempfile::tempdir().unwrap();
    let list = film(folder.path().to_str().unwrap(), &["--all", "--seconds", "0.1"]);
    assert_eq!(list.lines().count(), 11, "{list}");
    for name in ["SimTest1", "SimTest6", "Tutorial1", "Tutorial4", "MazeGame"] {
        let file = path(&folder, &format!("{name}.mp4"));
        assert_eq!(probe(&file), "h264,320,180,30/1,3");
        assert!(list.contains(&format!("{file}: 3 frames, 0.10 s, ")), "{list}");
    }
}

#[test]
fn bad_usage_ends_with_code_2_and_says_what_was_meant() {
    for (arguments, meant) in [
        (&["picture", "simtst1", "--out", "a.png"][..], "did you mean \"simtest1\"?"),
        (&["picture", "simtest1", "--out", "a.jpg"], "a.jpg must end in .png"),
        (&["picture", "simtest1", "--size", "0x9", "--out", "a.png"], "between 1 and"),
        (&["record", "simtest1", "--out", "a.avi"], "a.avi must end in .mp4"),
        (&["record", "simtest1", "--size", "321x180", "--out", "a.mp4"], "both must be even"),
        (&["record", "simtest1", "--fps", "31", "--out", "a.mp4"], "like 24, 25, 30"),
        (&["maze", "--random", "1", "--size", "1x1", "--print"], "2 to 40 columns and rows"),
    ] {
        let text = bad_line(arguments, 2);
        assert!(text.contains(meant), "{arguments:?}: {text}");
    }
    for (arguments, meant) in [
        (&["picture", "simtest1", "--at", "-1", "--out", "a.png"][..], "at least 0"),
        (&["picture", "simtest1", "--camera", "1,2,3", "--out", "a.png"], "six numbers"),
        (&["picture", "simtest1", "--camera", "1,2,3,1,2,3", "--out", "a.png"], "two different"),
        (&["picture", "simtest1", "--size", "9", "--out", "a.png"], "like 1280x720"),
        (&["record", "--out", "a.mp4"], "<SCENE>"),
        (&["record", "--all", "simtest1", "--out", "films"], "cannot be used with"),
        (&["record", "--all", "--set", "title=x", "--out", "films"], "cannot be used with"),
        (&["record", "maze", "--play", "--from", "t.csv", "--out", "a.mp4"], "cannot be used"),
        (&["maze", "--print"], "--random"),
    ] {
        let text = bad(arguments, 2);
        assert!(text.contains(meant), "{arguments:?}: {text}");
    }
}

#[test]
fn what_goes_wrong_on_the_way_ends_with_code_1_and_one_line() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("file"), "").unwrap();
    let [png, mp4] = ["file/a.png", "file/a.mp4"].map(|name| path(&folder, name));
    let small = |command, file| [&[command, "simtest1", "--out", file], &SMALL[..]].concat();
    for (command, file) in [("picture", &png), ("record", &mp4)] {
        let text = bad_line(&small(command, file), 1);
        assert!(text.contains(&format!("cannot write {file}")), "{text}");
    }
    let film = path(&folder, "a.mp4");
    let text = bad_line(&["record", "simtest1", "--play", "--out", &film], 1);
    assert!(text.contains("a maze has one sphere"), "{text}");
    assert!(!Path::new(&film).exists());
}

#[test]
fn a_scene_that_blows_up_leaves_the_film_until_then() {
    let folder = tempfile::tempdir().unwrap();
    let [scene, file] = ["far.toml", "far.mp4"].map(|name| path(&folder, name));
    // Its speed is beyond all numbers in the fourth frame.
    let fall = "name = 'far'\nspheres = [{ radius = 1 }]\n\
                forces = [{ gravity = { acceleration = [0, -1e308, 0] } }]\n\
                simulation = { rule = 'discrete', frame_time = 0.5 }\n\
                camera = { position = [0, 0, 9], look_at = [0, 0, 0] }\n";
    std::fs::write(&scene, fall).unwrap();
    let record = ["record", &scene, "--seconds", "60", "--out", &file];
    let text = bad_line(&[&record[..], &SMALL].concat(), 1);
    assert!(text.contains("no longer finite"), "{text}");
    assert!(!frames(&file).is_empty());
}

#[test]
#[cfg(target_os = "linux")]
fn without_a_graphics_driver_the_package_is_named_that_has_one() {
    let mut command = carom();
    command.env("VK_DRIVER_FILES", "/dev/null").env("__EGL_VENDOR_LIBRARY_FILENAMES", "/dev/null");
    let output = command.args(["picture", "simtest1", "--out", "a.png"]).output().unwrap();
    let errors = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{errors}");
    assert!(errors.contains("apt-get install mesa-vulkan-drivers"), "{errors}");
}

/// With the feature `view`, the command opens the window.
#[test]
#[cfg(not(feature = "view"))]
fn without_a_command_there_is_help() {
    assert!(bad(&[], 2).contains("Usage: carom"));
    assert!(bad_line(&["maze"], 2).contains("feature `view`"));
}
