//! Shapes of revolution in scene files: what is read, what is left out, and what errors say.

use carom::{Ends, Shape};
use carom_scene::{Scene, SceneError};

fn read(shape: &str) -> Result<Scene, SceneError> {
    let text = format!("name = 'x'\n[[colliders]]\nshape = {{ {shape} }}\n");
    Scene::from_toml(&text, "test.toml")
}

#[test]
fn every_shape_is_read_and_written_back() {
    let shapes = [
        (
            "cylinder = { radius = 0.5, height = '20 cm' }",
            Shape::Cylinder { radius: 0.5, height: 0.2 },
        ),
        (
            "cone = { bottom_radius = 0.5, height = 2 }",
            Shape::Cone { bottom_radius: 0.5, top_radius: 0.0, height: 2.0 },
        ),
        ("capsule = { radius = 0.5, length = 2 }", Shape::Capsule { radius: 0.5, length: 2.0 }),
        ("disc = { radius = 0.5 }", Shape::Disc { radius: 0.5 }),
        (
            "torus = { ring_radius = 1, tube_radius = 0.5 }",
            Shape::Torus { ring_radius: 1.0, tube_radius: 0.5 },
        ),
        (
            "pipe = { radius = 0.5, length = 2 }",
            Shape::Pipe { radius: 0.5, length: 2.0, closed: Ends::NONE },
        ),
        (
            "pipe = { radius = 0.5, length = 2, closed = ['top', 'bottom'] }",
            Shape::Pipe { radius: 0.5, length: 2.0, closed: Ends::BOTH },
        ),
        (
            "bowl = { radius = 0.5 }",
            Shape::Bowl { radius: 0.5, opening: std::f64::consts::FRAC_PI_2 },
        ),
        (
            "funnel = { bottom_radius = 0.1, top_radius = 0.5, height = 1 }",
            Shape::Funnel { bottom_radius: 0.1, top_radius: 0.5, height: 1.0 },
        ),
    ];
    for (text, expected) in shapes {
        let scene = read(text).unwrap();
        assert_eq!(scene.colliders[0].shape.physical().unwrap(), expected, "{text}");
        let again = Scene::from_toml(&scene.to_toml(), "again").unwrap();
        assert_eq!(again.colliders[0].shape, scene.colliders[0].shape, "{text}");
    }
}

#[test]
fn errors_name_the_field_and_the_line() {
    let wrong = [
        ("pipe = { radius = 0.5, length = 2, closed = 'left' }", "`bottom`"),
        ("bowl = { radius = 0.5, opening_degrees = 180 }", "opening_degrees"),
        ("torus = { ring_radius = 0.1, tube_radius = 0.5 }", "torus.ring_radius"),
        ("cylinder = { radius = 0.5, height = 0 }", "cylinder.height"),
        ("cone = { bottom_radius = 0, height = 1 }", "cone.top_radius"),
    ];
    for (text, field) in wrong {
        let error = read(text).and_then(|scene| scene.world().map(drop)).unwrap_err().to_string();
        assert!(error.contains(field), "{text}: {error}");
        assert!(error.contains(":3"), "{text}: {error}");
    }
}
