//! Recordings of killed processes: the recovered animation is that of the frames before the kill.

use std::fs;
use std::path::{Path, PathBuf};

use carom::World;
use carom_gltf::{Animation, recover_animation};
use carom_scene::recording::{Format, Recovered, RecoveryError};
use carom_scene::{Library, Scene};
use tempfile::TempDir;

/// A scene with balls and colliders that appear, move and disappear: an emitter with a ring of a
/// few balls.
fn scene() -> Scene {
    let ring = "emitters.0.max_spheres=3".parse().unwrap();
    let often = "emitters.0.period=0.05".parse().unwrap();
    let turning = "colliders.0.angular_velocity=[0, 0.5, 0]".parse().unwrap();
    Library::new().find("simtest1", &[ring, often, turning]).unwrap().0
}

/// Records a number of frames after the start; dropping the result leaves the unfinished file.
fn record(path: &Path, frames: usize) -> Animation {
    let scene = scene();
    let mut world: World = scene.world().unwrap();
    let mut animation = Animation::create(path, &scene, &world).unwrap();
    for _ in 0..frames {
        world.step(scene.simulation.frame_time).unwrap();
        animation.write(&world).unwrap();
    }
    animation
}

/// Bytes of an unfinished recording, and the ends of its frames.
fn unfinished(folder: &Path, frames: usize) -> (Vec<u8>, Vec<usize>) {
    let path = folder.join("cut.glb");
    let ends = (0..=frames).map(|frames| {
        drop(record(&path, frames));
        let left = fs::read(folder.join("cut.glb.0.unfinished")).unwrap();
        fs::remove_file(folder.join("cut.glb.0.unfinished")).unwrap();
        left
    });
    let left: Vec<Vec<u8>> = ends.collect();
    let ends = left.iter().map(Vec::len).collect();
    (left.into_iter().last().unwrap(), ends)
}

/// Complete recording of a number of frames after the start.
fn complete(folder: &Path, frames: usize) -> Vec<u8> {
    let path = folder.join("whole.glb");
    Box::new(record(&path, frames)).finish().unwrap();
    fs::read(&path).unwrap()
}

/// Recovers these bytes; returns the result and the path of the unfinished file.
fn recover(folder: &Path, bytes: &[u8]) -> (Result<Recovered, RecoveryError>, PathBuf) {
    let (left, target) = (folder.join("t.glb.0.unfinished"), folder.join("t.glb"));
    fs::write(&left, bytes).unwrap();
    fs::remove_file(&target).ok();
    (recover_animation(&left, &target), left)
}

#[test]
fn what_is_cut_short_becomes_the_animation_of_the_frames_before_byte_for_byte() {
    const FRAMES: usize = 30;
    let folder = TempDir::new().unwrap();
    let (bytes, ends) = unfinished(folder.path(), FRAMES);
    let whole: Vec<_> = (0..=FRAMES).map(|frames| complete(folder.path(), frames)).collect();
    // Cuts at the end of each frame, next to it, and at some places between.
    let beside = ends.iter().flat_map(|end| [end - 1, *end, end + 1]);
    let cuts = beside.chain((ends[0]..bytes.len()).step_by(997));
    for cut in cuts.filter(|cut| (ends[0]..=bytes.len()).contains(cut)) {
        let before = ends.partition_point(|end| *end <= cut) - 1;
        let (recovered, left) = recover(folder.path(), &bytes[..cut]);
        let Recovered { frames, last, left_out, is_damaged } = recovered.unwrap();
        assert_eq!((frames as usize, is_damaged), (before + 1, false), "{cut} bytes");
        assert_eq!(left_out as usize, cut - ends[before]);
        assert!((last.unwrap() - before as f64 * scene().simulation.frame_time).abs() < 1e-9);
        assert!(fs::read(folder.path().join("t.glb")).unwrap() == whole[before], "{cut} bytes");
        assert!(!left.exists());
    }
}

#[test]
fn a_damaged_frame_ends_the_animation_and_the_unfinished_file_stays() {
    let folder = TempDir::new().unwrap();
    let (mut bytes, ends) = unfinished(folder.path(), 9);
    bytes[ends[4] + 100] ^= 1;
    let (recovered, left) = recover(folder.path(), &bytes);
    let recovered = recovered.unwrap();
    assert_eq!((recovered.frames, recovered.is_damaged), (5, true));
    assert!(fs::read(folder.path().join("t.glb")).unwrap() == complete(folder.path(), 4));
    assert!(fs::read(left).unwrap() == bytes);
}

#[test]
fn what_is_no_recording_is_refused_and_stays() {
    let folder = TempDir::new().unwrap();
    for foreign in [&b""[..], b"something else", &[0; 4096]] {
        let (refused, left) = recover(folder.path(), foreign);
        assert!(matches!(refused, Err(RecoveryError::Foreign { .. })), "{foreign:?}");
        assert!(left.exists() && !folder.path().join("t.glb").exists());
    }
}

#[test]
fn a_file_that_is_there_stays_until_the_recording_is_complete() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("t.glb");
    fs::write(&path, "before").unwrap();
    let animation = record(&path, 3);
    assert_eq!(fs::read(&path).unwrap(), b"before");
    Box::new(animation).finish().unwrap();
    assert!(fs::read(&path).unwrap() == complete(folder.path(), 3));
    let mut names: Vec<_> =
        fs::read_dir(&folder).unwrap().map(|it| it.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["t.glb", "whole.glb"], "nothing else is left");
}
