//! Parameters and formulas of scene files: what they become, what `--set` changes, and where errors are.

use carom::DVec3;
use carom_scene::{Override, Scene, SceneError};

const TEXT: &str = r#"name = "line"
title = "= in words"

[parameters]
r = 0.25
count = 4
height = "=2 * count * r"

[[generators]]
[generators.row]
count = "=count"
start = ["=r", "=height", 0.0]
step = ["=2.5 * r", 0.0, 0.0]
sphere = { radius = "=r" }
"#;

fn read(text: &str, overrides: &[&str]) -> Result<Scene, SceneError> {
    let overrides: Vec<Override> = overrides.iter().map(|it| it.parse().unwrap()).collect();
    Scene::from_toml_with(text, "line.toml", &overrides)
}

fn problem(text: &str, overrides: &[&str]) -> String {
    read(text, overrides).unwrap_err().to_string()
}

#[test]
fn formulas_are_the_numbers_that_they_come_to() {
    let world = read(TEXT, &[]).unwrap().world().unwrap();
    let spheres = world.spheres();
    assert_eq!(spheres.len(), 4);
    assert_eq!(spheres.positions()[3], DVec3::new(0.25 + 3.0 * 2.5 * 0.25, 2.0, 0.0));
    assert_eq!(spheres.radii(), [0.25; 4]);
    // What is written out has the numbers, and is the same scene.
    let written = read(TEXT, &[]).unwrap().to_toml();
    assert!(written.contains("title = \"= in words\""), "{written}");
    assert!(!written.contains("parameters") && !written.contains('*'), "{written}");
    assert_eq!(read(&written, &[]).unwrap(), read(TEXT, &[]).unwrap());
}

#[test]
fn a_parameter_changes_all_that_follows_from_it() {
    for changed in ["r=0.5", "parameters.r=0.5", "r==1/2"] {
        let world = read(TEXT, &[changed]).unwrap().world().unwrap();
        assert_eq!(world.spheres().positions()[1], DVec3::new(0.5 + 1.25, 4.0, 0.0), "{changed}");
    }
    let world = read(TEXT, &["count=2", "height=7"]).unwrap().world().unwrap();
    assert_eq!(world.spheres().positions()[1].y, 7.0);
    assert_eq!(world.spheres().len(), 2);
}

#[test]
fn a_field_goes_before_a_parameter_of_its_name() {
    let with_name = TEXT.replace("r = 0.25", "r = 0.25\nname = 3");
    let scene = read(&with_name, &["name=other"]).unwrap();
    assert_eq!(scene.name, "other");
}

#[test]
fn errors_name_the_line_and_what_may_be_meant() {
    let file = |from: &str, to: &str| problem(&TEXT.replace(from, to), &[]);
    let unknown = file("\"=2.5 * r\"", "\"=2.5 * radius\"");
    assert!(unknown.starts_with("line.toml:13: generators[0].row.step[0]: unknown name `radius`"));
    let late = file("r = 0.25", "r = \"=count / 16\"");
    assert!(late.starts_with("line.toml:5: parameters.r: unknown name `count`"), "{late}");
    let whole = file("count = 4", "count = 2.5");
    assert!(whole.contains("generators[0].row.count: invalid type: floating point"), "{whole}");
    let text_for_number = file("r = 0.25", "r = \"wide\"");
    assert!(text_for_number.contains("neither a number nor a formula"), "{text_for_number}");
    let taken = file("r = 0.25", "pi = 3");
    assert!(taken.contains("parameters.pi: \"pi\" has a meaning in formulas"), "{taken}");
    let no_name = file("r = 0.25", "\"2r\" = 3");
    assert!(no_name.contains("begins with no digit"), "{no_name}");
    let no_table = problem("name = \"x\"\nparameters = 3", &[]);
    assert!(no_table.starts_with("line.toml:2: parameters: is no table"), "{no_table}");
}

#[test]
fn overrides_of_parameters_that_are_not_there_are_errors() {
    let unknown = problem(TEXT, &["parameters.heigt=3"]);
    assert_eq!(
        unknown,
        "--set parameters.heigt=3: the scene has no parameter `heigt`; did you mean \"height\"?"
    );
    assert!(problem(TEXT, &["parameters.x=3"]).ends_with("no parameter `x`"));
    let mistyped = problem(TEXT, &["heigt=3"]);
    assert!(mistyped.ends_with("did you mean \"height\"?"), "{mistyped}");
}
