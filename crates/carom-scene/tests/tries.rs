//! Suggestions of scene files: what to try, with a slider.

use carom_scene::{Library, Scene, Tried};

const SCENE: &str = r#"
name = "one"
[[spheres]]
radius = 0.5
[[colliders]]
name = "floor"
shape = "half-space"
restitution = 0.5
position = [0, -2, 0]
[[emitters]]
position = [0, 3, 0]
period = 0.5
count = 4
sphere = { radius = 0.1 }
"#;

fn with(tries: &str) -> Result<Scene, String> {
    let text = format!("{SCENE}{tries}");
    Scene::from_toml(&text, "one.toml").map_err(|error| error.to_string())
}

fn one(text: &str, path: &str, range: &str) -> String {
    format!("[[try]]\ntext = \"{text}\"\npath = \"{path}\"\nrange = {range}\n")
}

#[test]
fn a_suggestion_reads_and_changes_the_number_at_its_path() {
    let scene = with(&one("Bounce", "colliders.0.restitution", "[0, 1]")).unwrap();
    let suggestion = &scene.tries[0];
    assert_eq!(suggestion.number_in(&scene), Some(Tried { value: 0.5, is_whole: false }));
    let changed = suggestion.applied_to(&scene, 0.75).unwrap();
    assert_eq!(changed.colliders[0].restitution, 0.75);
    assert_eq!(changed.tries, scene.tries);
    let error = suggestion.applied_to(&scene, 2.0).unwrap_err();
    assert!(error.to_string().contains("restitution"), "{error}");
}

#[test]
fn a_count_stays_whole() {
    let scene = with(&one("More", "emitters[0].count", "[1, 9]")).unwrap();
    let suggestion = &scene.tries[0];
    assert_eq!(suggestion.number_in(&scene), Some(Tried { value: 4.0, is_whole: true }));
    assert_eq!(suggestion.applied_to(&scene, 6.6).unwrap().emitters[0].count, Some(7));
}

#[test]
fn a_path_without_a_number_has_no_slider() {
    for path in ["colliders.3.restitution", "colliders.0.name", "forces.0.gravity"] {
        let scene = with(&one("Bounce", path, "[0, 1]")).unwrap();
        assert_eq!(scene.tries[0].number_in(&scene), None, "{path}");
    }
}

#[test]
fn a_wrong_suggestion_is_refused_at_its_line_and_field() {
    let path = "colliders.0.restitution";
    let cases = [
        (one("", path, "[0, 1]"), "try[0].text"),
        (one("Bounce", "restitution", "[0, 1]"), "try[0].path"),
        (one("Bounce", path, "[1, 0]"), "try[0].range"),
        (one("Bounce", path, "[0, inf]"), "try[0].range"),
        (one("Bounce", path, "[0]"), "try"),
        (one("Bounce", path, "[0, 1]").replace("text", "txt"), "try[0].txt"),
        (one("Bounce", path, "[0, 1]").repeat(4), "try"),
    ];
    for (tries, field) in cases {
        let error = with(&tries).unwrap_err();
        assert!(error.starts_with("one.toml:") && error.contains(field), "{error}");
    }
}

#[test]
fn a_text_is_no_formula_and_a_scene_keeps_its_suggestions_as_text() {
    let scene = with(&one("=1+1", "colliders.0.restitution", "[0, 1]")).unwrap();
    assert_eq!(scene.tries[0].text, "=1+1");
    let again = Scene::from_toml(&scene.to_toml(), "again").unwrap();
    assert_eq!(again.tries, scene.tries);
}

#[test]
fn suggestions_of_built_in_scenes_change_numbers_and_both_ends_are_valid() {
    let mut count = 0;
    for entry in Library::new().entries().unwrap() {
        let scene = entry.scene.unwrap();
        for suggestion in &scene.tries {
            let Tried { value, .. } = suggestion.number_in(&scene).expect(&suggestion.path);
            let [low, high] = suggestion.range;
            assert!(low <= value && value <= high, "{}: {}", scene.name, suggestion.text);
            for end in [low, high] {
                let changed = suggestion.applied_to(&scene, end);
                let changed = changed.unwrap_or_else(|error| panic!("{}: {error}", scene.name));
                changed.world().unwrap();
            }
            count += 1;
        }
    }
    assert!(count > 40, "{count}");
}
