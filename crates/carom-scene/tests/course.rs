//! The scenes of the course compared with references computed independently of this project, and
//! with the figures of the course. In the references, spheres do not collide with each other.

use std::collections::BTreeMap;
use std::path::Path;

use carom::{DQuat, DVec3, SphereId, World};
use carom_scene::scene::{Force, Shape};
use carom_scene::{Library, Override, Scene};
use serde_json::Value;

fn scene(name: &str) -> Scene {
    Library::new().find(name, &[]).unwrap().0
}

fn step(world: &mut World, scene: &Scene) {
    world.step(scene.simulation.frame_time).unwrap();
}

/// Largest deviation \[m\] or \[m/s\] from a reference file.
fn deviation(name: &str) -> f64 {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference");
    let text = std::fs::read_to_string(folder.join(format!("{name}.csv"))).unwrap();
    // Number of the ball, position and velocity, by frame.
    let mut rows: BTreeMap<u64, Vec<(u64, [f64; 6])>> = BTreeMap::new();
    for line in text.lines().skip(1) {
        let fields: Vec<f64> = line.split(',').map(|field| field.parse().unwrap()).collect();
        let values = fields[2..8].try_into().unwrap();
        let frame = (fields[0] / 0.02).round() as u64;
        rows.entry(frame).or_default().push((fields[1] as u64, values));
    }
    assert_eq!((rows.len(), rows.keys().last()), (50, Some(&500)));
    let scene = scene(name);
    let mut world = scene.world().unwrap();
    let mut worst: f64 = 0.0;
    for frame in 1..=500 {
        step(&mut world, &scene);
        let Some(expected) = rows.get(&frame) else { continue };
        let spheres = world.spheres();
        assert_eq!(spheres.len(), expected.len());
        for (i, (ball, values)) in expected.iter().enumerate() {
            assert_eq!(spheres.ids()[i].number(), *ball);
            let (x, v) = (spheres.positions()[i].to_array(), spheres.velocities()[i].to_array());
            for (ours, theirs) in x.into_iter().chain(v).zip(values) {
                worst = worst.max((ours - theirs).abs());
            }
        }
    }
    worst
}

#[test]
fn simtests_match_the_independent_reference_over_ten_seconds() {
    // The references have 12 digits, and impacts amplify such errors; 1e-8 was measured.
    for name in ["simtest1", "simtest3", "simtest5"] {
        let worst = deviation(name);
        assert!(worst < 1e-7, "{name} is off by {worst}");
    }
}

fn vector(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|part| part.as_f64().unwrap()).collect()
}

#[test]
fn scene_files_hold_the_figures_of_the_course() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/course_scenes.json");
    let figures: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    for number in 1..=6 {
        let figures = &figures["scenes"][format!("SimTest{number}")];
        let scene = scene(&format!("SimTest{number}"));
        let emitter = &scene.emitters[0];
        let theirs = &figures["emitter"];
        assert_eq!(emitter.position.to_vec(), vector(&theirs["position"]));
        assert_eq!(emitter.rotation.to_vec(), vector(&theirs["rotation_xyzw"]));
        assert_eq!(emitter.sphere.velocity.to_vec(), vector(&theirs["velocity"]));
        assert_eq!(emitter.sphere.mass, theirs["mass"].as_f64());
        assert_eq!(emitter.sphere.diameter, theirs["diameter"].as_f64());
        assert_eq!(Some(emitter.period), theirs["period"].as_f64());
        assert_eq!(emitter.max_spheres.map(u64::from), theirs["max_spheres"].as_u64());
        let colliders = figures["colliders"].as_array().unwrap();
        assert_eq!(scene.colliders.len(), colliders.len());
        let world = scene.world().unwrap();
        for ((_, collider), theirs) in world.colliders().zip(colliders) {
            assert_eq!(collider.pose.position.to_array().to_vec(), vector(&theirs["position"]));
            assert_eq!(Some(collider.restitution), theirs["restitution"].as_f64());
            let size = match &collider.shape {
                carom::Shape::Sphere { radius } => vec![*radius],
                carom::Shape::Rectangle { size_x, size_z } => {
                    let rotation = collider.pose.rotation.to_array().to_vec();
                    assert_eq!(rotation, vector(&theirs["rotation_xyzw"]));
                    vec![*size_x, *size_z]
                }
                other => panic!("{other:?}"),
            };
            let keys = ["radius", "size_x", "size_z"];
            let theirs: Vec<f64> = keys.iter().filter_map(|key| theirs[*key].as_f64()).collect();
            assert_eq!(size, theirs);
        }
        let [Force::Constant { force }, Force::ViscousDrag { coefficient }] = scene.forces[..]
        else {
            panic!("a constant force and drag")
        };
        let theirs = &figures["emitter"];
        assert_eq!(force.to_vec(), vector(&theirs["force"]));
        assert_eq!(Some(coefficient), theirs["drag"].as_f64());
        check_view(&scene, figures);
    }
}

/// Camera and sun.
fn check_view(scene: &Scene, figures: &Value) {
    let (camera, theirs) = (scene.camera.as_ref().unwrap(), &figures["camera"]);
    assert_eq!(camera.position.to_vec(), vector(&theirs["position"]));
    assert_eq!(camera.rotation.to_vec(), vector(&theirs["rotation_xyzw"]));
    assert_eq!(Some(camera.vertical_fov_degrees), theirs["vertical_fov_deg"].as_f64());
    assert_eq!(Some(camera.near), theirs["near"].as_f64());
    assert_eq!(Some(camera.far), theirs["far"].as_f64());
    let (sun, theirs) = (scene.sun.as_ref().unwrap(), &figures["sun"]);
    assert_eq!(sun.rotation.to_vec(), vector(&theirs["rotation_xyzw"]));
    assert_eq!(sun.color.to_vec(), vector(&theirs["color"]));
    assert_eq!(Some(sun.intensity), theirs["intensity"].as_f64());
}

#[test]
fn the_maze_holds_the_figures_of_the_course() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/course_scenes.json");
    let figures: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let figures = &figures["scenes"]["MazeGame"];
    let maze = scene("maze");
    check_view(&maze, figures);
    let game = &figures["game"];
    assert_eq!(maze.spheres[0].position.to_vec(), vector(&game["ball_start"]));
    assert_eq!(maze.spheres[0].diameter, game["ball_diameter"].as_f64());
    assert_eq!(maze.spheres[0].mass, game["ball_mass"].as_f64());

    let (mut planes, mut boxes, mut collectibles) = (0, 0, 0);
    for collider in &maze.colliders {
        let (theirs, center, size, restitution) = match collider.shape {
            Shape::Rectangle { size_x, size_z } => {
                planes += 1;
                let theirs = &figures["planes"][planes - 1];
                let size = [theirs["size_x"].as_f64(), theirs["size_z"].as_f64()];
                assert_eq!([Some(size_x), Some(size_z)], size);
                assert_eq!(collider.rotation.to_vec(), vector(&theirs["rotation_xyzw"]));
                (theirs, "position", None, true)
            }
            Shape::Box { size } => {
                boxes += 1;
                (&figures["boxes"][boxes - 1], "center", Some(size.to_vec()), true)
            }
            Shape::Sphere { radius } => {
                collectibles += 1;
                let theirs = &figures["collectibles"][collectibles - 1];
                assert_eq!(Some(radius), theirs["radius"].as_f64());
                assert!(collider.trigger);
                (theirs, "position", None, false)
            }
            ref other => panic!("{other:?} is not in the maze"),
        };
        assert_eq!(collider.position.to_vec(), vector(&theirs[center]));
        assert_eq!(size, size.as_ref().map(|_| vector(&theirs["size"])));
        if restitution {
            assert_eq!(Some(collider.restitution), theirs["restitution"].as_f64());
        }
    }
    assert_eq!((planes, boxes, collectibles), (2, 20, 4));
}

/// Whether a sphere lies entirely outside the picture of the scene's camera; `aspect` is width /
/// height.
fn is_out_of_view(scene: &Scene, center: DVec3, radius: f64, aspect: f64) -> bool {
    let camera = scene.camera.as_ref().unwrap();
    let rotation = DQuat::from_array(camera.rotation).normalize();
    let local = rotation.inverse() * (center - DVec3::from_array(camera.position));
    let half = (0.5 * camera.vertical_fov_degrees).to_radians();
    let (x, y) = ((half.tan() * aspect).atan(), half);
    // Distances from the four side planes of the view, positive outside.
    let planes = [
        local.x * x.cos() + local.z * x.sin(),
        -local.x * x.cos() + local.z * x.sin(),
        local.y * y.cos() + local.z * y.sin(),
        -local.y * y.cos() + local.z * y.sin(),
    ];
    planes.iter().any(|distance| *distance > radius)
}

#[test]
fn without_recycling_the_first_ball_of_simtest4_leaves_the_picture_at_19_8_seconds() {
    let unlimited: Override = "emitters.0.max_spheres=1000".parse().unwrap();
    let scene = Library::new().find("simtest4", &[unlimited]).unwrap().0;
    let mut world = scene.world().unwrap();
    step(&mut world, &scene);
    let first: SphereId = world.spheres().ids()[0];
    // The ball starts above the picture, enters it and leaves it.
    let mut was_seen = false;
    loop {
        let ball = world.sphere(first).unwrap();
        let is_seen = !is_out_of_view(&scene, ball.position, ball.radius, 16.0 / 9.0);
        if was_seen && !is_seen {
            break;
        }
        was_seen |= is_seen;
        assert!(world.time() < 30.0, "still in view");
        step(&mut world, &scene);
    }
    assert!((world.time() - 19.8).abs() <= 0.1, "{}", world.time());
}

#[test]
fn the_ball_of_the_maze_comes_to_its_place_on_the_ground() {
    let scene = scene("maze");
    let mut world = scene.world().unwrap();
    for _ in 0..500 {
        step(&mut world, &scene);
    }
    let ball = world.spheres().positions()[0];
    // Ground at -0.2672, radius 1/2. Under this rule the ball sinks by less than the fall of one
    // frame, 9.8 * 0.02^2.
    assert!((ball - DVec3::new(2.23, 0.2328, 0.7)).length() < 0.004, "{ball}");
}
