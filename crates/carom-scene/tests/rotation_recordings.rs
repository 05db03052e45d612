//! Recordings contain orientations and angular velocities if spheres can rotate, and no new columns
//! otherwise.
#![cfg(feature = "recording")]

use std::io::Read;
use std::path::Path;

use carom::{DVec3, World};
use carom_scene::Scene;
use carom_scene::recording::{Replay, Trajectory};

const HEADER: &str = "t,ball,x,y,z,vx,vy,vz";

/// A ball that slides on the floor with this friction.
fn scene(friction: &str) -> Scene {
    let text = format!(
        "name = 'slide'\nsimulation = {{ rule = 'contact' }}\n\
         forces = [{{ gravity = {{ acceleration = [0, -9.81, 0] }} }}]\n\
         spheres = [{{ position = [0, 0.1, 0], velocity = [1, 0, 0], radius = 0.1 }}]\n\
         colliders = [{{ shape = 'half-space', restitution = 0, {friction} }}]\n"
    );
    Scene::from_toml(&text, "slide.toml").unwrap()
}

/// Records ten frames; returns the world at their end.
fn record(scene: &Scene, path: &Path) -> World {
    let mut world = scene.world().unwrap();
    let mut trajectory = Trajectory::create(path).unwrap();
    for _ in 0..10 {
        world.step(scene.simulation.frame_time).unwrap();
        trajectory.write(&world).unwrap();
    }
    trajectory.finish().unwrap();
    world
}

/// Number of arrays in an archive.
fn arrays(path: &Path) -> usize {
    zip::ZipArchive::new(std::fs::File::open(path).unwrap()).unwrap().len()
}

/// All numbers of an array in an archive.
fn array(path: &Path, name: &str) -> Vec<f64> {
    let mut archive = zip::ZipArchive::new(std::fs::File::open(path).unwrap()).unwrap();
    let mut bytes = Vec::new();
    archive.by_name(&format!("{name}.npy")).unwrap().read_to_end(&mut bytes).unwrap();
    npyz::NpyFile::new(&bytes[..]).unwrap().into_vec().unwrap()
}

/// Names of the attributes of each sphere in a file for ParaView.
fn attributes(path: &Path) -> Vec<String> {
    let frame = vtkio::Vtk::import(path).unwrap();
    let vtkio::model::DataSet::PolyData { pieces, .. } = frame.data else { panic!("poly data") };
    let vtkio::model::Piece::Inline(piece) = &pieces[0] else { panic!("inline") };
    piece.data.point.iter().map(|attribute| attribute.name().to_owned()).collect()
}

#[test]
fn a_ball_that_turns_is_recorded_with_its_rotation() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let scene = scene("friction = 0.5");
    let world = record(&scene, &path("t.csv"));
    record(&scene, &path("t.npz"));
    record(&scene, &path("t.pvd"));

    let turns = world.spheres().angular_velocities()[0];
    assert!(turns.z < -1.0, "friction makes it roll: {turns}");
    let is = [&world.spheres().orientations()[0].to_array()[..], &turns.to_array()].concat();

    let text = std::fs::read_to_string(path("t.csv")).unwrap();
    assert_eq!(text.lines().next().unwrap(), format!("{HEADER},qx,qy,qz,qw,wx,wy,wz"));
    let last = text.lines().last().unwrap().split(',').skip(8);
    assert_eq!(last.map(|text| text.parse().unwrap()).collect::<Vec<f64>>(), is);

    let (orientations, rates) =
        (array(&path("t.npz"), "orientation"), array(&path("t.npz"), "angular_velocity"));
    assert_eq!((orientations.len(), rates.len()), (40, 30));
    assert_eq!([&orientations[36..], &rates[27..]].concat(), is);

    let names = attributes(&path("t_frames/000009.vtp"));
    assert!(names.iter().any(|it| it == "orientation"), "{names:?}");
    assert!(names.iter().any(|it| it == "angular_velocity"), "{names:?}");

    let mut replay = Replay::open(&path("t.csv"), &scene).unwrap();
    assert!(replay.next_frame().unwrap().is_some(), "it can be played again");
}

#[test]
fn recordings_without_rotation_stay_as_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let mut frictionless = scene("friction = 0.0");
    for rule in [carom_scene::scene::Rule::Contact, carom_scene::scene::Rule::Exact] {
        frictionless.simulation.rule = rule;
        let world = record(&frictionless, &path("t.csv"));
        assert!(world.spheres().angular_velocities().iter().all(|&it| it == DVec3::ZERO));
        let text = std::fs::read_to_string(path("t.csv")).unwrap();
        assert!(text.lines().all(|line| line.split(',').count() == 8));
        record(&frictionless, &path("t.npz"));
        assert_eq!(arrays(&path("t.npz")), 9);
        record(&frictionless, &path("t.pvd"));
        assert_eq!(attributes(&path("t_frames/000009.vtp")).len(), 4);
    }
}

#[test]
fn a_table_without_a_frame_has_its_header() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.csv");
    Trajectory::create(&path).unwrap().finish().unwrap();
    assert_eq!(std::fs::read_to_string(&path).unwrap(), format!("{HEADER}\n"));
}
