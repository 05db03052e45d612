//! Scenes like those of the course, with prefab instances and scripts: the imported scene runs as
//! the built-in one does. The numbers of the fixture are those of SimTest1.

mod fixtures;

use carom_scene::Library;
use carom_scene::scene::Rule;
use fixtures::{imported, reasons};

#[test]
fn a_scene_like_the_first_of_the_course_runs_as_the_built_in_one() {
    let scene = imported("First").scene;
    let (built_in, _) = Library::new().find("simtest1", &[]).unwrap();
    let (mut world, mut expected) = (scene.world().unwrap(), built_in.world().unwrap());
    assert_eq!(scene.simulation.rule, Rule::Discrete);
    for _ in 0..500 {
        world.step(scene.simulation.frame_time).unwrap();
        expected.step(built_in.simulation.frame_time).unwrap();
        let (spheres, others) = (world.spheres(), expected.spheres());
        assert_eq!(spheres.len(), others.len());
        for (position, other) in spheres.positions().iter().zip(others.positions()) {
            // Required accuracy of the course's scenes over ten seconds.
            assert!((*position - *other).length() < 1e-9, "{position} {other}");
        }
    }
    assert!(world.spheres().len() > 10);
}

#[test]
fn camera_and_sun_are_those_of_the_built_in_scene() {
    let scene = imported("First").scene;
    let (built_in, _) = Library::new().find("simtest1", &[]).unwrap();
    assert_eq!(scene.camera, built_in.camera);
    assert_eq!(scene.sun, built_in.sun);
}

#[test]
fn what_the_first_scene_has_without_a_counterpart_is_listed() {
    assert_eq!(
        reasons(&imported("First")),
        [
            "Assets/Prefabs/Plane.prefab: modification of restitution: its object is not in the prefab (any more)",
            "First.unity: RenderSettings: has no counterpart",
            "Main Camera: AudioListener: has no counterpart",
            "Emitter: script \"emitter\": its field sphereGameObject is not read",
        ]
    );
}

#[test]
fn a_material_that_an_instance_changes_gives_the_colour() {
    let scene = imported("First").scene;
    assert_eq!(scene.colliders[0].color, Some([0.75, 0.25, 0.125]));
    assert_eq!(scene.colliders[1].color, None);
}
