//! Valid scenes in which something has no effect get a remark with the path of the field; others get none.

use carom_scene::{Library, Scene, remarks};

/// Returns the remarks on a scene with a ball and a floor that have these fields.
fn said(ball: &str, floor: &str) -> Vec<String> {
    let text = format!(
        "[[spheres]]\nradius = 0.1\nposition = [0, 5, 0]\n{ball}\n[[colliders]]\n{floor}\n"
    );
    let scene = Scene::from_toml(&text, "scene.toml").unwrap();
    scene.world().unwrap();
    remarks(&scene)
}

fn expect(ball: &str, floor: &str, parts: [&str; 2]) {
    let found = said(ball, floor);
    let [remark] = &found[..] else { panic!("{ball}, {floor}: {found:?}") };
    assert!(parts.iter().all(|part| remark.contains(part)), "{remark}");
}

#[test]
fn belts_that_nothing_feels_are_named() {
    let belt = "colliders[0].surface_velocity";
    let box_shape = "shape = { box = { size = [1, 1, 1] } }\nsurface_velocity = [0, 1, 0]";
    let flat = "shape = 'half-space'\nsurface_velocity";
    expect("", &format!("{flat} = [1, 0, 0]"), [belt, "neither it nor a sphere has friction"]);
    expect(
        "friction = 0.3",
        &format!("{flat} = [1, 0, 0]\nfriction = 0"),
        [belt, "without friction"],
    );
    expect("friction = 0.3", &format!("{flat} = [0, 2, 0]"), [belt, "along the normal"]);
    assert!(said("friction = 0.3", &format!("{flat} = [1, 0, 0]")).is_empty());
    assert!(said("", &format!("{flat} = [1, 2, 0]\nfriction = 0.3")).is_empty());
    // A box has sides on which the velocity is along the surface.
    assert!(said("friction = 0.3", box_shape).is_empty());
}

#[test]
fn restitutions_beside_a_law_are_named() {
    let law =
        "restitution = 0.5\nrestitution_law = { power-law = { restitution = 0.7, speed = 1 } }";
    let law_alone = law.replace("restitution = 0.5\n", "");
    let Ok(_) = Scene::from_toml(&format!("[[spheres]]\nradius = 1\n{law}"), "law.toml") else {
        panic!("the law of this test is none")
    };
    expect(law, "shape = 'half-space'", ["spheres[0].restitution", "does not count"]);
    let floor = format!("shape = 'half-space'\n{law}");
    expect("", &floor, ["colliders[0].restitution", "does not count"]);
    assert!(said(&law_alone, "shape = 'half-space'").is_empty());
    let material = format!("shape = 'half-space'\n[materials.steel]\n{law}");
    expect("", &material, ["materials.steel.restitution", "does not count"]);
}

#[test]
fn kicks_and_belts_of_triggers_are_named() {
    let trigger = "shape = 'half-space'\ntrigger = true";
    let has_no_effect = "a trigger deflects nothing";
    expect("", &format!("{trigger}\nkick = 2"), ["colliders[0].kick", has_no_effect]);
    let belt = format!("{trigger}\nsurface_velocity = [1, 0, 0]");
    expect("", &belt, ["colliders[0].surface_velocity", has_no_effect]);
    assert!(said("", trigger).is_empty());
}

#[test]
fn wells_among_balls_that_stay_at_rest_are_named() {
    let wells = |velocity: &str| {
        let text = format!(
            "simulation = {{ pair_potential = {{ square-well = {{ depth = 1, range_ratio = 2 }} }} }}\n\
             [[spheres]]\nradius = 0.5\nvelocity = {velocity}\n\
             [[spheres]]\nradius = 0.5\nposition = [1.5, 0, 0]"
        );
        remarks(&Scene::from_toml(&text, "scene.toml").unwrap())
    };
    assert!(wells("[0.1, 0, 0]").is_empty());
    let [remark] = &wells("[0, 0, 0]")[..] else { panic!("{:?}", wells("[0, 0, 0]")) };
    assert!(remark.starts_with("simulation.pair_potential has no effect"), "{remark}");
}

#[test]
fn keyframes_half_a_turn_apart_are_named() {
    let turning = |degrees: [f64; 3]| {
        let rotation = |it: f64| format!("{{ axis = [0, 0, 1], degrees = {it:?} }}");
        let [first, second, third] = degrees.map(rotation);
        format!(
            "shape = 'half-space'\nmotion = {{ keyframes = {{ times = [0, 1, 2], rotations = [{first}, {second}, \
             {third}] }} }}"
        )
    };
    let motion = "colliders[0].motion";
    expect("", &turning([0.0, 360.0, 360.0]), [motion, "less than half a turn"]);
    expect("", &turning([0.0, 90.0, 300.0]), [motion, "less than half a turn"]);
    expect("", &turning([0.0, 180.0, 300.0]), [motion, "less than half a turn"]);
    expect("", &turning([17.0, 17.0, 197.0]), [motion, "less than half a turn"]);
    assert!(said("", &turning([0.0, 170.0, 300.0])).is_empty());
    assert!(said("", &turning([0.0, 0.0, 90.0])).is_empty());
}

#[test]
fn built_in_scenes_are_as_meant() {
    for entry in Library::new().entries().unwrap() {
        assert_eq!(remarks(&entry.scene.unwrap()), Vec::<String>::new(), "{}", entry.name);
    }
}
