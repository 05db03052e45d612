//! Containers in scene files: open sides may be one word or a list, are written back unchanged, and
//! errors name line and field.

use carom::Sides;
use carom_scene::scene::{Shape, Side};
use carom_scene::{Scene, json_schema};

fn file(open: &str) -> String {
    format!(
        "name = 'test'\n[[colliders]]\nshape = {{ container = {{ size = [1, 2, 3]{open} }} }}\n"
    )
}

fn read(open: &str) -> Scene {
    Scene::from_toml(&file(open), "test.toml").unwrap()
}

fn open_sides(scene: &Scene) -> Sides {
    let world = scene.world().unwrap();
    let collider = world.colliders().next().unwrap().1;
    let carom::Shape::Container { open, .. } = collider.shape else { panic!("{collider:?}") };
    open
}

#[test]
fn open_is_one_side_or_a_list_or_missing() {
    let top = Sides { top: true, ..Sides::NONE };
    let both = Sides { left: true, front: true, ..Sides::NONE };
    let cases = [
        ("", Sides::NONE),
        (", open = []", Sides::NONE),
        (", open = 'top'", top),
        (", open = ['top']", top),
        (", open = ['front', 'left']", both),
    ];
    for (text, expected) in cases {
        let scene = read(text);
        assert_eq!(open_sides(&scene), expected, "{text}");
        let written = scene.to_toml();
        assert_eq!(Scene::from_toml(&written, "again").unwrap(), scene, "{written}");
    }
    assert!(read(", open = ['top']").to_toml().contains("open = \"top\""));
    assert!(!read("").to_toml().contains("open ="));
}

#[test]
fn every_side_has_a_name() {
    let names = ["left", "right", "bottom", "top", "back", "front"];
    for (side, name) in names.into_iter().enumerate() {
        let open = open_sides(&read(&format!(", open = '{name}'")));
        assert_eq!(open, Sides::from_array(std::array::from_fn(|it| it == side)), "{name}");
    }
    let Shape::Container { open, .. } = &read(", open = 'back'").colliders[0].shape else {
        panic!()
    };
    assert_eq!(open, &[Side::Back]);
}

#[test]
fn a_mistake_in_a_container_is_reported_with_line_and_field() {
    let all = ", open = ['left', 'right', 'bottom', 'top', 'back', 'front']";
    let cases = [
        (", open = 'above'", "open: unknown variant `above`, expected one of `left`"),
        (", open = 'tops'", "did you mean \"top\"?"),
        (", open = ['top', 'up']", "unknown variant `up`"),
        (", open = 3", "open: invalid type: integer `3`, expected a side or a list of sides"),
        (", opened = 'top'", "unknown field `opened`"),
        (all, "open: must leave one wall at least"),
    ];
    for (open, expected) in cases {
        let text = Scene::from_toml(&file(open), "test.toml").unwrap_err().to_string();
        assert!(text.starts_with("test.toml:3: colliders[0].shape.container"), "{text}");
        assert!(text.contains(expected), "{text}");
    }
    let flat = file("").replace("[1, 2, 3]", "[1, 0, 3]");
    let text = Scene::from_toml(&flat, "test.toml").unwrap_err().to_string();
    assert!(
        text.starts_with("test.toml:3: colliders[0].shape.container.size.y: must be pos"),
        "{text}"
    );
}

#[test]
fn random_fillings_keep_clear_of_walls_and_fit_inside() {
    let filling = "[[generators]]\n[generators.random]\ncount = 40\nmin = [-0.5, -1, -1.5]\n\
                   max = [0.5, 3, 1.5]\nseed = 1\nsphere = { radius = 0.1 }\n";
    let text = format!("{}{filling}", file(", open = 'top'"));
    let world = Scene::from_toml(&text, "test.toml").unwrap().world().unwrap();
    assert!(world.overlaps(0.0).is_empty());
}

#[test]
fn the_schema_has_sides() {
    let schema = json_schema();
    assert!(schema.contains("\"container\"") && schema.contains("\"bottom\""));
    assert!(schema.contains("#/$defs/OneOrMore"));
}
