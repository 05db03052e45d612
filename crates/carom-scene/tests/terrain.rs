//! The built-in scene `terrain`: its ground is what its program prints, and balls fall into its hollows, not through it.

#[path = "../examples/terrain.rs"]
mod terrain;

use carom::{DVec3, QueryFilter};
use carom_scene::{BUILT_IN_FILES, Scene};

fn text() -> &'static str {
    BUILT_IN_FILES.iter().find(|(file, _)| *file == "terrain.toml").unwrap().1
}

#[test]
fn the_heights_in_the_file_are_those_of_its_program() {
    let (_, rest) = text().split_once("heights = [\n").unwrap();
    let (heights, _) = rest.split_once("\n]\n").unwrap();
    assert_eq!(heights.lines().collect::<Vec<_>>(), terrain::rows());
}

#[test]
fn every_ball_stays_on_the_ground_and_ends_in_a_hollow() {
    let scene = Scene::from_toml(text(), "terrain.toml").unwrap();
    let mut world = scene.world().unwrap();
    for _ in 0..600 {
        world.step(1.0 / 60.0).unwrap();
    }
    let spheres = world.spheres();
    assert_eq!(spheres.len(), 36);
    let only_ground = QueryFilter::default().with_spheres(false);
    for (&position, &radius) in spheres.positions().iter().zip(spheres.radii()) {
        // The hollows are within the rim, and no pile in one is higher than three of the largest balls.
        assert!(position.x.abs() < 3.5 && position.z.abs() < 3.5, "{position}");
        let way = -10.0 * DVec3::Y;
        let below = world.cast_ray(position, way, &only_ground).unwrap().unwrap();
        let height = 10.0 * below.fraction;
        assert!(height > 0.99 * radius && height < 1.32, "{position} {height}");
    }
    // Of some 800 J at the start.
    assert!(world.kinetic_energy() < 1.0);
}
