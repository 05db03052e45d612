//! Parameters and formulas of scene files: their values, overrides, and the places of errors.

use carom::DVec3;
use carom_scene::{Override, Scene, SceneError, SceneText};

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
    // The written scene contains numbers only and is equal to the original.
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
    let circle = file("r = 0.25", "r = \"=s / 16\"\ns = \"=2 * r\"");
    let expected = "line.toml:6: parameters.s: \"s\" follows from itself, by \"r\"";
    assert!(circle.starts_with(expected), "{circle}");
    let whole = file("count = 4", "count = 2.5");
    assert!(whole.contains("generators[0].row.count: invalid type: floating point"), "{whole}");
    let text_for_number = file("r = 0.25", "r = \"wide\"");
    assert!(text_for_number.contains("neither a number, like"), "{text_for_number}");
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
        "parameters.heigt=3: the scene has no parameter `heigt`; did you mean \"height\"?"
    );
    assert!(problem(TEXT, &["parameters.x=3"]).ends_with("no parameter `x`"));
    let mistyped = problem(TEXT, &["heigt=3"]);
    assert!(mistyped.ends_with("did you mean \"height\"?"), "{mistyped}");
}

#[test]
fn names_are_no_formulas_and_only_what_a_name_changes_is_blamed() {
    let named = TEXT.replace("name = \"line\"", "name = \"=line\"")
        + "[[colliders]]\nname = \"=left\"\nshape = \"half-space\"\n";
    let scene = read(&named, &[]).unwrap();
    assert_eq!(read(&scene.to_toml(), &[]).unwrap(), scene);
    assert_eq!(scene.colliders[0].name, "=left");
    let blamed = problem(TEXT, &["count=3", "r=wide"]);
    assert!(blamed.starts_with("r=wide: "), "{blamed}");
    let stray = problem(&TEXT.replace("[parameters]", "heigt = 1\n[parameters]"), &[]);
    assert!(!stray.contains("did you mean"), "{stray}");
    let singular = problem("name = \"x\"\n[parameter]\nr = 1", &[]);
    assert!(singular.ends_with("did you mean \"parameters\"?"), "{singular}");
}

#[test]
fn more_parameters_than_anybody_writes_are_refused() {
    let many: String = (0..1001).map(|i| format!("p{i} = {i}\n")).collect();
    let problem = problem(&format!("name = \"x\"\n[parameters]\n{many}"), &[]);
    assert!(problem.contains("more than 1000 parameters"), "{problem}");
}

#[test]
fn numbers_with_units_are_those_of_si() {
    let text = r#"
name = "units"
parameters = { tilt = "90 deg", r = "5 cm" }
simulation = { frame_time = "20 ms" }
forces = [{ gravity = { acceleration = [0, "-981 cm/s^2", 0] } }]

[[spheres]]
position = ["1 ft", "=2 + r", 0.5]
diameter = "10 cm"
density = "2.7 g/cm^3"
velocity = ["36 km/h", "=sin(tilt)", 0]

[[colliders]]
shape = { rectangle = { size_x = "40 cm", size_z = "2 m" } }
rotation = { axis = [0, 0, 1], degrees = "=tilt / deg" }
"#;
    let si = r#"
name = "units"
simulation = { frame_time = 0.02 }
forces = [{ gravity = { acceleration = [0, -9.81, 0] } }]

[[spheres]]
position = [0.3048, 2.05, 0.5]
diameter = 0.1
density = 2700
velocity = [10, 1, 0]

[[colliders]]
shape = { rectangle = { size_x = 0.4, size_z = 2 } }
rotation = { axis = [0, 0, 1], degrees = 90 }
"#;
    assert_eq!(read(text, &[]).unwrap(), read(si, &[]).unwrap());
    let world = read(text, &["spheres.0.diameter=2 in"]).unwrap().world().unwrap();
    assert_eq!(world.spheres().radii(), [0.0254]);
    let wrong = problem(&text.replace("\"10 cm\"", "\"10 g\""), &[]);
    assert_eq!(wrong, "line.toml:9: spheres[0].diameter: \"10 g\" is in g, not in m");
    let unknown = problem(&text.replace("20 ms", "20 msec"), &[]);
    assert!(unknown.starts_with("line.toml:4: simulation.frame_time: unknown unit `msec`"));
    assert!(unknown.ends_with("did you mean \"ms\"?"), "{unknown}");
}

#[test]
fn fields_take_the_units_that_the_schema_describes() {
    let schema: serde_json::Value = serde_json::from_str(&carom_scene::json_schema()).unwrap();
    let mut fields = Vec::new();
    described(&schema, &mut fields);
    let units = ["m/s²", "m/s", "rad/s", "kg/m³", "kg/s", "kg", "N", "degrees", "s", "m"];
    let mut checked = std::collections::BTreeSet::new();
    for (field, description) in fields {
        let says = |unit: &&str| {
            let mut parts = description.split(['.', ',', ':', ';']);
            parts.any(|part| part.to_lowercase().ends_with(&format!("in {unit}").to_lowercase()))
        };
        let Some(unit) = units.into_iter().find(says) else { continue };
        let other = if unit == "kg" { "m" } else { "t" };
        let problem = problem(&format!("name = \"x\"\n[any]\n{field} = \"1 {other}\""), &[]);
        let expected =
            format!("line.toml:3: any.{field}: \"1 {other}\" is in {other}, not in {unit}");
        assert_eq!(problem, expected, "{description}");
        checked.insert(field);
    }
    // If fewer fields are found, the descriptions no longer state units in this form.
    assert!(checked.len() >= 30, "{checked:?}");
}

fn described(schema: &serde_json::Value, fields: &mut Vec<(String, String)>) {
    let Some(object) = schema.as_object() else {
        schema.as_array().into_iter().flatten().for_each(|it| described(it, fields));
        return;
    };
    if let Some(properties) = object.get("properties").and_then(|it| it.as_object()) {
        for (name, property) in properties {
            if let Some(text) = property.get("description").and_then(|it| it.as_str()) {
                fields.push((name.clone(), text.to_owned()));
            }
        }
    }
    object.values().for_each(|it| described(it, fields));
}

#[test]
fn parameters_are_listed_in_order_with_what_they_come_to() {
    let overrides: Vec<Override> = vec!["parameters.r=0.5".parse().unwrap()];
    let list = SceneText::new(TEXT, "line.toml").unwrap().parameters(&overrides).unwrap();
    let listed: Vec<_> = list.iter().map(|it| (it.name.as_str(), it.value)).collect();
    assert_eq!(listed, [("r", 0.5), ("count", 4.0), ("height", 4.0)]);
    let kinds: Vec<_> = list.iter().map(|it| (it.is_formula, it.is_whole)).collect();
    assert_eq!(kinds, [(false, false), (false, true), (true, false)]);
    assert_eq!(SceneText::new("name = 'x'", "x.toml").unwrap().parameters(&[]).unwrap(), []);
    let error = SceneText::new("[parameters]\na = '=b'", "x.toml").unwrap().parameters(&[]);
    let error = error.unwrap_err().to_string();
    assert!(error.contains("x.toml") && error.contains("parameters.a"), "{error}");
}
