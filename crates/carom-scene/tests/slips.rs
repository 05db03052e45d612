//! Typical mistakes of new authors and their messages: one fault for each mistake.

use carom_scene::{Budget, Scene, SceneText};

fn told(text: &str) -> Vec<String> {
    let faults = Scene::faults(&format!("name = 'x'\n{text}"), "x.toml", Budget::FILE);
    faults.iter().map(ToString::to_string).collect()
}

#[test]
fn one_slip_is_one_fault_that_says_what_to_write() {
    for (text, expected) in [
        (
            "[[forces]]\ngravity = [0, -9.81, 0]",
            "3: forces[0].gravity: is a table: { acceleration = [0.0, -9.81, 0.0] }",
        ),
        (
            "[[forces]]\ngravity = 9.81",
            "3: forces[0].gravity: is a table: { acceleration = [0.0, -9.81, 0.0] }",
        ),
        (
            "[[colliders]]\nshape = { box = [1, 1, 1] }",
            "3: colliders[0].shape.box: is a table: { size = [1.0, 1.0, 1.0] }",
        ),
        (
            "[[colliders]]\nshape = { sphere = 1 }",
            "3: colliders[0].shape.sphere: is a table: { radius = 0.5 }",
        ),
        ("[[simulation]]\nrule = 'exact'", "2: simulation: is a table: [simulation]"),
        (
            "[[forces]]",
            "2: forces[0]: is empty: it must have exactly one entry, like \
             gravity = { acceleration = [0.0, -9.81, 0.0] }",
        ),
        (
            "[simulation]\nboundary = { periodic = { size = [9, 0, 9] } }",
            "3: simulation.boundary.periodic.size: must be positive along every axis; infinite where it is open, \
             not [9, 0, 9]",
        ),
        (
            "[[generators]]\ntype = 'row'\ncount = 5",
            "2: generators[0]: has several entries: it must have exactly one entry, like \
             [generators.row] with its fields below",
        ),
        (
            "durration = 3",
            "2: durration: unknown field `durration`; \"duration\" stands in [simulation]",
        ),
        ("rule = 'exact'", "2: rule: unknown field `rule`; \"rule\" stands in [simulation]"),
        ("[[spheres]]\nradius = 0,1", "3: decimals have a point, not a comma"),
        ("[[emitters]]\nsphere = { radius = 0,1 }", "3: decimals have a point, not a comma"),
        ("[[colliders]]\ntrigger = True", "3: `True` is written small: true"),
        (
            "[[spheres]]\nposition = [0, 5 cm, 0]",
            "3: `5 cm` is no number; one with a unit has quotes: \"5 cm\"",
        ),
        ("[[spheres]]\nposition = [0 1.5, 0]", "3: between `0` and `1.5` there is no comma"),
        ("[[spheres]]\nposition = [\n  -1, 2 3\n]", "4: between `2` and `3` there is no comma"),
        ("[simulation]\nrule = exact", "3: a text stands in quotes: \"exact\""),
        (
            "[[spheres]]\nradius = 1\ncolor = 'reddish'",
            "4: spheres[0].color: \"reddish\" is no colour: write three numbers from 0 to 1, a name \
             like \"red\", or \"#c0392b\"",
        ),
        (
            "[camera]\nposition = [1, 0, 0]\nlook_at = [1, 0, 0]",
            "3: camera: the way from `position` to `look_at` must be finite and not zero, \
             not [0.0, 0.0, 0.0]",
        ),
        (
            "[[spheres]]\nradius = 1\ninclude = 'a.toml'",
            "4: spheres[0].include: `include` stands before the first table of a file",
        ),
        (
            "[parameters]\nw = 'two'\n[[spheres]]\nradius = '=w'",
            "3: parameters.w: is neither a number, like \"5 cm\", nor a formula, like \"=2*r\"",
        ),
    ] {
        assert_eq!(told(text), [format!("x.toml:{expected}")], "{text}");
    }
}

#[test]
fn what_others_call_otherwise_is_understood() {
    for (text, meant) in [
        ("includ = 'a.toml'", "include"),
        ("gravity = [0, -9.81, 0]", "forces"),
        ("[[spheres]]\nradius = 1\nweight = 2", "mass"),
        ("[[colliders]]\nbox = { size = [1, 1, 1] }", "shape"),
        (
            "[[colliders]]\nshape = 'half-space'\nrotation = { axis = [1, 0, 0], angle = 3 }",
            "degrees",
        ),
        ("[[spheres]]\nradius = 1\nmaterial = 'glass'", "finish"),
        ("[[spheres]]\nradius = 1\nfinish = 'shiny'", "glossy"),
        ("[[spheres]]\nradius = 1\nfinish = 'steel'", "metal"),
    ] {
        let [told] = &told(text)[..] else { panic!("{:?}", told(text)) };
        assert!(told.ends_with(&format!("did you mean \"{meant}\"?")), "{told}");
    }
}

#[test]
fn another_shape_is_not_taken_for_a_slip() {
    let [told] = &told("[[colliders]]\nshape = { triangle = {} }")[..] else { panic!() };
    assert!(!told.contains("did you mean") && told.contains("`rectangle`"), "{told}");
}

#[test]
fn a_field_of_a_part_that_is_set_by_its_name_alone_has_a_path() {
    let text = "name = 'x'\n[[spheres]]\nradius = 1\nposition = [0, 2, 0]\n[[colliders]]\nshape = 'half-space'\n\
                restitution = 0.5\n";
    let text = SceneText::new(text, "x.toml").unwrap();
    let set = |change: &str| text.scene(&[change.parse().unwrap()]).unwrap_err().to_string();
    assert_eq!(
        set("restitution=0.2"),
        "restitution=0.2: x.toml: restitution: unknown field `restitution`; did you mean \
         \"colliders.0.restitution\"?"
    );
    assert!(set("name=''").ends_with("name: must not be empty"), "{}", set("name=''"));
    assert!(set("friction=0.2").contains("expected one of `name`"), "{}", set("friction=0.2"));
}
