//! The periodic box in trajectories: NPZ and VTK have its sides, and none where space is open.
#![allow(missing_docs)]

use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

use carom_scene::recording::Trajectory;
use carom_scene::{Library, Scene};

fn written(scene: &Scene, path: &Path) {
    let mut world = scene.world().unwrap();
    let mut trajectory = Trajectory::create(path).unwrap();
    for _ in 0..3 {
        world.step(0.1).unwrap();
        trajectory.write(&world).unwrap();
    }
    trajectory.finish().unwrap();
}

/// Sides in an NPZ file, and field data of the last frame of a series.
fn boxes(scene: &Scene) -> (Option<Vec<f64>>, Option<String>) {
    let folder = tempfile::tempdir().unwrap();
    let [npz, pvd] = ["t.npz", "t.pvd"].map(|name| folder.path().join(name));
    written(scene, &npz);
    written(scene, &pvd);
    let mut archive = zip::ZipArchive::new(File::open(&npz).unwrap()).unwrap();
    let sides = archive.by_name("box.npy").ok().map(|mut file| {
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).unwrap();
        npyz::NpyFile::new(&bytes[..]).unwrap().into_vec().unwrap()
    });
    let frame = fs::read_to_string(folder.path().join("t_frames/000002.vtp")).unwrap();
    let field = frame.split_once("<FieldData>").map(|(_, rest)| rest.to_owned());
    let field = field.and_then(|it| it.split_once("</FieldData>").map(|(it, _)| it.to_owned()));
    (sides, field)
}

#[test]
fn the_sides_of_a_periodic_box_are_in_npz_and_vtk() {
    let text = "[simulation]\nboundary = { periodic = { size = [3, 3.3, inf] } }\n\
                [[spheres]]\nradius = 0.3\nvelocity = [1, 2, 3]\n";
    let (sides, field) = boxes(&Scene::from_toml(text, "text").unwrap());
    assert_eq!(sides, Some(vec![3.0, 3.3, f64::INFINITY]));
    let field = field.unwrap();
    assert!(field.contains("Name=\"box\"") && field.contains(">3 3.3 0<"), "{field}");
}

#[test]
fn trajectories_without_a_box_have_no_sides() {
    assert_eq!(boxes(&Library::new().find("simtest1", &[]).unwrap().0), (None, None));
}

#[test]
fn how_far_a_sheared_box_slid_is_in_vtk() {
    let text = "[simulation]\n\
                boundary = { periodic = { size = [4, 8, inf], shear_rate = 0.5 } }\n\
                [[spheres]]\nradius = 0.3\nvelocity = [1, 2, 3]\n";
    let (sides, field) = boxes(&Scene::from_toml(text, "text").unwrap());
    assert_eq!(sides, Some(vec![4.0, 8.0, f64::INFINITY]));
    // The box above moves with 4 m/s for 0.3 s.
    let field = field.unwrap();
    assert!(field.contains("Name=\"slide\"") && field.contains(">1.2"), "{field}");
}
