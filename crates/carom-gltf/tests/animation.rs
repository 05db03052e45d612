//! Recorded runs: keys are the states of the run in 32 bits, nodes those of its start in 64 bits,
//! and the import of a recording returns the scene.

mod files;

use std::path::Path;

use carom::World;
use carom_gltf::{Animation, Options};
use carom_scene::recording::{Format, Trajectory};
use carom_scene::{Library, Scene};
use serde_json::Value;
use tempfile::TempDir;

/// A file, split into its parts.
struct Recorded {
    json: Value,
    binary: Vec<u8>,
}

impl Recorded {
    fn read(path: &Path) -> Self {
        let bytes = std::fs::read(path).unwrap();
        let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!(word(8), bytes.len());
        let json = &bytes[20..20 + word(12)];
        let binary = bytes.get(28 + word(12)..).unwrap_or_default().to_vec();
        Self { json: serde_json::from_slice(json).unwrap(), binary }
    }

    fn node(&self, name: &str) -> usize {
        let nodes = self.json["nodes"].as_array().unwrap();
        nodes.iter().position(|it| it["name"] == name).unwrap_or_else(|| panic!("{name}"))
    }

    /// Times and values of an animated property of a node.
    fn keys(&self, name: &str, path: &str) -> Option<(Vec<f32>, Vec<Vec<f32>>)> {
        let (node, animation) = (self.node(name), &self.json["animations"][0]);
        let channels = animation["channels"].as_array()?;
        let is_of = |it: &&Value| it["target"]["node"] == node && it["target"]["path"] == path;
        let channel = channels.iter().find(is_of)?;
        let sampler = &animation["samplers"][channel["sampler"].as_u64()? as usize];
        let times = self.numbers(sampler["input"].as_u64()? as usize);
        let values = self.numbers(sampler["output"].as_u64()? as usize);
        let width = values.len() / times.len();
        Some((times, values.chunks(width).map(<[f32]>::to_vec).collect()))
    }

    fn numbers(&self, accessor: usize) -> Vec<f32> {
        let accessor = &self.json["accessors"][accessor];
        let view = &self.json["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
        let offset = |it: &Value| it["byteOffset"].as_u64().unwrap_or(0) as usize;
        let width = match accessor["type"].as_str().unwrap() {
            "SCALAR" => 1,
            "VEC3" => 3,
            _ => 4,
        };
        let start = offset(view) + offset(accessor);
        let count = accessor["count"].as_u64().unwrap() as usize * width;
        let bytes = &self.binary[start..start + 4 * count];
        bytes.chunks(4).map(|it| f32::from_le_bytes(it.try_into().unwrap())).collect()
    }
}

fn scene(name: &str) -> Scene {
    Library::new().find(name, &[]).unwrap().0
}

/// Records frames of a scene and calls `look` with the world after each, including the start.
fn record(scene: &Scene, frames: usize, path: &Path, mut look: impl FnMut(&World)) {
    let mut world = scene.world().unwrap();
    let animation = Animation::create(path, scene, &world).unwrap();
    let mut trajectory = Trajectory::in_format(path, Box::new(animation));
    look(&world);
    for _ in 0..frames {
        world.step(scene.simulation.frame_time).unwrap();
        trajectory.write(&world).unwrap();
        look(&world);
    }
    trajectory.finish().unwrap();
}

#[test]
fn keys_are_the_positions_and_rotations_of_the_run_in_32_bits() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("billiards.glb");
    let mut run: Vec<(f64, [f64; 3], [f64; 4])> = Vec::new();
    record(&scene("billiards"), 60, &path, |world| {
        let ball = world.spheres().get(0);
        let rotation = ball.orientation.normalize().to_array();
        run.push((world.time(), ball.position.to_array(), rotation));
    });
    let file = Recorded::read(&path);
    let (times, places) = file.keys("ball 0", "translation").unwrap();
    let (_, rotations) = file.keys("ball 0", "rotation").unwrap();
    assert_eq!(times.len(), run.len());
    for (i, (time, place, rotation)) in run.iter().enumerate() {
        assert_eq!(times[i], *time as f32);
        assert_eq!(places[i], place.map(|it| it as f32));
        let same = rotation.map(|it| it as f32);
        assert!(rotations[i] == same || rotations[i] == same.map(|it| -it), "frame {i}");
    }
    // Each step follows the smaller angle.
    let along = |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f32>();
    assert!(rotations.windows(2).all(|pair| along(&pair[0], &pair[1]) >= 0.0));
}

#[test]
fn balls_have_their_size_from_the_frame_on_in_which_they_appear() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("simtest1.glb");
    let mut first = std::collections::BTreeMap::new();
    let mut frame = 0;
    record(&scene("simtest1"), 200, &path, |world| {
        for (id, radius) in world.spheres().ids().iter().zip(world.spheres().radii()) {
            first.entry(id.number()).or_insert((frame, *radius, world.time()));
        }
        frame += 1;
    });
    let file = Recorded::read(&path);
    assert!(first.len() > 3);
    for (ball, (frame, radius, time)) in first {
        let (times, sizes) = file.keys(&format!("ball {ball}"), "scale").unwrap();
        assert_eq!(times, [0.0, time as f32]);
        assert_eq!(sizes, [vec![0.0; 3], vec![radius as f32; 3]]);
        let (times, _) = file.keys(&format!("ball {ball}"), "translation").unwrap();
        assert_eq!(times.len(), 201 - frame);
    }
}

#[test]
fn colliders_move_as_they_do_in_the_world() {
    let mut scene = Scene::new("paddle");
    let mut collider =
        carom_scene::scene::Collider::new(carom_scene::scene::Shape::Box { size: [1.0; 3] });
    (collider.velocity, collider.angular_velocity) = ([1.0, 0.0, 0.0], [0.0, 0.5, 0.0]);
    scene.colliders.push(collider);
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("paddle.glb");
    let mut places = Vec::new();
    record(&scene, 30, &path, |world| {
        let (_, collider) = world.colliders().next().unwrap();
        places.push(collider.pose.position.to_array().map(|it| it as f32).to_vec());
    });
    let file = Recorded::read(&path);
    assert_eq!(file.keys("collider 0", "translation").unwrap().1, places);
    assert!(file.keys("collider 0", "rotation").is_some());
    let imported = carom_gltf::import(&path, &Options::default()).unwrap().scene;
    let [moving] = &imported.colliders[..] else { panic!() };
    assert_eq!((moving.velocity, moving.angular_velocity), ([1.0, 0.0, 0.0], [0.0, 0.5, 0.0]));
}

#[test]
fn a_collider_by_keyframes_has_keys_on_its_curve() {
    let text = "name = \"lift\"\nsimulation = { frame_time = 0.0625 }\n\
                [[colliders]]\nshape = { box = { size = [1, 1, 1] } }\n\
                motion = { keyframes = { times = [0, 1], positions = [[0, 0, 0], [0, 2, 0]] } }\n";
    let scene = Scene::from_toml(text, "lift").unwrap();
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("lift.glb");
    record(&scene, 16, &path, |_| {});
    let (times, places) = Recorded::read(&path).keys("collider 0", "translation").unwrap();
    assert_eq!(times.len(), 17);
    for (time, place) in times.iter().zip(&places) {
        // Cubic, at rest at both ends; the keys have 32 bits.
        let height = 2.0 * time * time * (3.0 - 2.0 * time);
        assert!((place[1] - height).abs() <= 4.0 * f32::EPSILON, "{time}: {place:?}");
    }
}

#[test]
fn the_start_of_a_recording_comes_back_to_the_bit() {
    let folder = TempDir::new().unwrap();
    for name in ["cradle", "tutorial4", "billiards", "gas"] {
        let (path, scene) = (folder.path().join(format!("{name}.glb")), scene(name));
        record(&scene, 2, &path, |_| {});
        let imported = carom_gltf::import(&path, &Options::default()).unwrap();
        let (before, after) = (scene.world().unwrap(), imported.scene.world().unwrap());
        let (before, after) = (before.spheres(), after.spheres());
        assert_eq!(after.positions(), before.positions(), "{name}");
        assert_eq!(after.velocities(), before.velocities(), "{name}");
        assert_eq!(after.radii(), before.radii(), "{name}");
        assert_eq!(after.masses(), before.masses(), "{name}");
        let restitutions =
            |it: &carom::Spheres| (0..it.len()).map(|i| it.get(i).restitution).collect::<Vec<_>>();
        assert_eq!(restitutions(after), restitutions(before), "{name}");
    }
}

#[test]
fn an_imported_cradle_runs_as_the_one_that_was_recorded() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("cradle.glb");
    let cradle = scene("cradle");
    record(&cradle, 2, &path, |_| {});
    let imported = carom_gltf::import(&path, &Options::default()).unwrap().scene;
    let hash = |scene: &Scene| {
        let mut world = scene.world().unwrap();
        (0..60).for_each(|_| world.step(cradle.simulation.frame_time).map(drop).unwrap());
        world.state_hash()
    };
    assert_eq!(hash(&imported), hash(&cradle));
}

#[test]
fn what_rests_has_no_keys_and_frames_at_one_time_are_refused() {
    let mut scene = Scene::new("rest");
    scene.spheres.push(carom_scene::scene::Sphere::at([0.1, 0.2, 0.3], 0.5));
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("rest.glb");
    record(&scene, 5, &path, |_| {});
    let file = Recorded::read(&path);
    assert!(file.json.get("animations").is_none());
    assert_eq!(
        file.json["nodes"][file.node("ball 0")]["translation"],
        serde_json::json!([0.1, 0.2, 0.3])
    );
    let world = scene.world().unwrap();
    let mut animation = Animation::create(&path, &scene, &world).unwrap();
    let error = animation.write(&world).unwrap_err().to_string();
    assert!(error.contains("32 bits"), "{error}");
}
