//! Scene files: all fields can be read, and every error names the line, the field and the nearest
//! known name.

use carom::Mass;
use carom_scene::{Library, Override, Scene, SceneError};

fn read(text: &str) -> Result<Scene, SceneError> {
    Scene::from_toml(text, "test.toml")
}

fn refusal(text: &str) -> String {
    read(text).unwrap_err().to_string()
}

/// A small valid scene with each part on lines of its own.
const GOOD: &str = r#"name = "test"

[[forces]]
gravity = { acceleration = [0, -9.81, 0] }

[[spheres]]
position = [0, 2, 0]
radius = 0.5

[[generators]]
[generators.row]
count = 3
start = [0, 5, 0]
step = [2, 0, 0]
sphere = { diameter = 1.0, density = 2.0, velocity = [0, -1, 0] }

[[colliders]]
name = "floor"
restitution = 0.5

[colliders.shape.rectangle]
size_x = 10
size_z = 10

[[emitters]]
period = 0.5
position = [0, 20, 0]
sphere = { radius = 0.1, mass = 2 }

[camera]
position = [0, 1, 10]
"#;

#[test]
fn a_scene_becomes_the_world_it_describes() {
    let world = read(GOOD).unwrap().world().unwrap();
    let spheres = world.spheres();
    assert_eq!(spheres.len(), 4);
    assert_eq!(spheres.positions()[3].to_array(), [4.0, 5.0, 0.0]);
    assert_eq!(spheres.velocities()[3].to_array(), [0.0, -1.0, 0.0]);
    assert_eq!(spheres.radii(), [0.5; 4]);
    assert_eq!(spheres.masses()[0], 1.0);
    assert_eq!(spheres.get(1).mass, Mass::Kilograms(2.0 * carom::volume(0.5)));
    assert_eq!(world.colliders().next().unwrap().1.restitution, 0.5);
}

#[test]
fn every_mistake_is_told_with_its_line_and_field() {
    // Text to replace in the valid scene, its replacement, and the start of the expected error.
    let cases = [
        ("radius = 0.5", "radius = -0.5", "8: spheres[0].radius: must be positive"),
        ("radius = 0.5", "radius = nan", "8: spheres[0].radius: must be positive"),
        ("radius = 0.5", "", "6: spheres[0]: needs `radius` or `diameter`"),
        ("radius = 0.5", "radius = 1\ndiameter = 2", "9: spheres[0].diameter: `radius` says"),
        ("radius = 0.5", "diameter = inf", "8: spheres[0].diameter: must be positive"),
        (
            "radius = 0.5",
            "radius = \"big\"",
            "8: spheres[0].radius: invalid type: string \"big\", expected a number",
        ),
        (
            "count = 3",
            "count = 3.5",
            "12: generators[0].row.count: invalid type: floating point `3.5`, expected a whole number",
        ),
        ("radius = 0.5", "radius = 1\nmass = 0", "9: spheres[0].mass: must be positive"),
        ("radius = 0.5", "radius = 1\nmass = 1\ndensity = 1", "10: spheres[0].density: `mass`"),
        ("radius = 0.5", "radius = 0.5 m", "8"),
        (
            "position = [0, 2, 0]",
            "position = [0, 2]",
            "7: spheres[0].position: has 2 values, not 3",
        ),
        (
            "[0, -9.81, 0]",
            "[0, -9,81, 0]",
            "4: forces[0].gravity.acceleration: 4 values are too many",
        ),
        ("[0, 2, 0]", "[0, inf, 0]", "7: spheres[0].position: must be finite"),
        ("[0, -9.81, 0]", "[0, nan, 0]", "4: forces[0].gravity.acceleration: must be finite"),
        ("[0, -9.81, 0]", "\"down\"", "4: forces[0].gravity.acceleration: invalid type"),
        ("[[spheres]]", "[spheres]", "6: spheres: is one table, not a list"),
        ("count = 3", "count = 0", "12: generators[0].row.count: must make 1 to"),
        ("count = 3", "count = -3", "12: generators[0].row.count: invalid value"),
        ("[0, 5, 0]", "[nan, 5, 0]", "13: generators[0].row.start: must be finite"),
        ("[2, 0, 0]", "[2, inf, 0]", "14: generators[0].row.step: must be finite"),
        ("density = 2.0", "density = -2.0", "15: generators[0].row.sphere.density: must be"),
        ("diameter = 1.0", "diameter = \"big\"", "15: generators[0].row.sphere.diameter: invalid"),
        ("restitution = 0.5", "restitution = 1.5", "19: colliders[0].restitution: must be in"),
        ("radius = 0.5", "radius = 1\nfriction = -0.1", "9: spheres[0].friction: must be"),
        ("radius = 0.5", "radius = 1\nfriction = nan", "9: spheres[0].friction: must be"),
        ("radius = 0.5", "radius = 1\nfriction = 'much'", "9: spheres[0].friction: invalid type"),
        ("radius = 0.5", "radius = 1\ninertia_factor = 0", "9: spheres[0].inertia_factor: must be"),
        (
            "radius = 0.5",
            "radius = 1\norientation = [0, 0, 0, 0]",
            "9: spheres[0].orientation: must be",
        ),
        (
            "radius = 0.5",
            "radius = 1\nangular_velocity = [0, inf, 0]",
            "9: spheres[0].angular_velocity: must be finite",
        ),
        (
            "restitution = 0.5",
            "tangential_restitution = 1.5",
            "19: colliders[0].tangential_restitution: must be in",
        ),
        (
            "density = 2.0",
            "rolling_friction = -2.0",
            "15: generators[0].row.sphere.rolling_friction: must be",
        ),
        ("mass = 2", "spinning_friction = -2", "28: emitters[0].sphere.spinning_friction: must be"),
        ("size_x = 10", "size_x = 0", "22: colliders[0].shape.rectangle.size_x: must be positive"),
        ("size_x = 10", "size_x = [1, 2]", "22: colliders[0].shape.rectangle.size_x: invalid"),
        ("period = 0.5", "period = 0", "26: emitters[0].period: must be positive and finite"),
        ("[0, 20, 0]", "[0, 0, 0]", "27: emitters[0].position: puts spheres into a collider"),
        ("mass = 2", "mass = -2", "28: emitters[0].sphere.mass: must be positive"),
        ("[camera]", "[camera]\nvertical_fov_degrees = 180", "31: camera.vertical_fov_degrees"),
        ("[camera]", "[camera]\nnear = 0", "31: camera.near: must be positive"),
        ("[camera]", "[camera]\nfar = 0.1", "31: camera.far: must be farther"),
        ("[camera]", "[camera]\nrotation = [0, 0, 0, 0]", "31: camera.rotation: must be a quat"),
        ("[0, 1, 10]", "[0, nan, 10]", "31: camera.position: must be finite"),
        ("[camera]", "[simulation]\nframe_time = 0\n[camera]", "31: simulation.frame_time"),
        ("[camera]", "[simulation]\nduration = -1\n[camera]", "31: simulation.duration"),
        (
            "[camera]",
            "[simulation]\nrule = 'bisect'\nbisect = { max_halvings = 0 }\n[camera]",
            "32: simulation.bisect.max_halvings: must be at least 1",
        ),
        (
            "[camera]",
            "[simulation]\nrule = 'contact'\ncontact = { sub_steps = 0 }\n[camera]",
            "32: simulation.contact.sub_steps: must be at least 1",
        ),
        (
            "[camera]",
            "[simulation.exact]\ncontact_duration = 0\n[camera]",
            "31: simulation.exact.contact_duration: must be positive",
        ),
        (
            "[camera]",
            "[simulation.boundary.periodic]\nsize = [9, 0, 9]\n[camera]",
            "31: simulation.boundary.periodic.size: must be positive",
        ),
        (
            "[camera]",
            "[simulation]\nrule = 'discrete'\nboundary = { periodic = { size = [9, 9, 9] } }\n[camera]",
            "32: simulation.boundary: must be open under rules other than `exact` and `contact`",
        ),
        (
            "[camera]",
            "[simulation]\nrule = 'bisect'\nbisect = { tolerance = 0.01 }\n[camera]",
            "32: simulation.bisect.tolerance: must be at most 0.001, 1/100 of the smallest radius, not 0.01",
        ),
        ("[camera]", "[colors]\nspheres = [0, 0, 2]\n[camera]", "31: colors.spheres: must have"),
        (
            "[camera]",
            "[sun]\nrotation = [0, 0, 0, 1]\ncolor = [1, 1, 1]\nintensity = -1\n[camera]",
            "33: sun.intensity: must be zero or positive",
        ),
        ("name = \"test\"", "name = \"\"", "1: name: must not be empty"),
    ];
    for (good, bad, expected) in cases {
        assert!(GOOD.contains(good), "{good}");
        let text = refusal(&GOOD.replacen(good, bad, 1));
        assert!(text.starts_with(&format!("test.toml:{expected}")), "{bad}: {text}");
        assert_eq!(text.lines().count(), 1, "{text}");
    }
}

#[test]
fn what_one_rule_reads_stands_in_its_table_alone() {
    let read = |key: &str| read(&format!("name = 'test'\n[simulation]\n{key}"));
    for key in ["integrator = 'rk4'", "impact_law = 'sequential'", "restitution_rule = 'average'"] {
        let text = read(key).unwrap_err().to_string();
        assert!(text.starts_with("test.toml:3: simulation."), "{text}");
        let name = key.split(' ').next().unwrap();
        assert!(
            text.contains(&format!("unknown field `{name}`, expected one of `rule`")),
            "{text}"
        );
        assert!(text.contains("`combine_rule`") && text.contains("`discrete`"), "{text}");
    }
    let of_another_rule = ["exact.integrator = 'rk4'", "discrete.impact_law = 'sequential'"];
    assert!(of_another_rule.into_iter().all(|key| read(key).is_err()));
    for key in ["exact.impact_law = 'sequential'", "bisect.integrator = 'rk4'"] {
        read(key).unwrap();
    }
}

#[test]
fn a_scene_without_a_name_has_that_of_its_file() {
    let text = GOOD.replacen("name = \"test\"", "", 1);
    let scene = Scene::from_toml(&text, "some/folder/drop.toml").unwrap();
    assert_eq!(scene.name, "drop");
    let text = refusal(&GOOD.replacen("name = \"test\"", "name = \"\"", 1));
    assert!(text.contains("name: must not be empty"), "{text}");
}

#[test]
fn unknown_names_bring_the_nearest_known_one() {
    let cases = [
        ("radius = 0.5", "radus = 0.5", 8, "radius"),
        ("restitution = 0.5", "restitutoin = 0.5", 19, "restitution"),
        ("size_x = 10", "sizex = 10", 22, "size_x"),
        ("shape.rectangle", "shape.rectange", 21, "rectangle"),
        ("gravity =", "gravty =", 4, "gravity"),
        ("generators.row", "generators.rows", 11, "row"),
        ("[[emitters]]", "[[emiters]]", 25, "emitters"),
        ("mass = 2", "mas = 2", 28, "mass"),
        ("[colliders.shape.rectangle]", "shape = \"plane\"\n[other]", 21, "half-space"),
        ("restitution = 0.5", "bounciness = 0.5", 19, "restitution"),
        ("radius = 0.5", "radius = 0.5\nspin = [0, 1, 0]", 9, "angular_velocity"),
        ("[[spheres]]", "[[balls]]", 6, "spheres"),
        (
            "[camera]",
            "[simulation.bisect]\nintegrator = \"runge-kuta-4\"\n[camera]",
            31,
            "runge-kutta-4",
        ),
    ];
    for (good, bad, line, meant) in cases {
        let text = refusal(&GOOD.replacen(good, bad, 1));
        assert!(text.contains(&format!("did you mean \"{meant}\"?")), "{text}");
        assert!(text.starts_with(&format!("test.toml:{line}: ")), "{bad}: {text}");
    }
}

#[test]
fn spheres_that_overlap_at_the_start_are_refused_unless_allowed() {
    let overlapping = GOOD.replacen("start = [0, 5, 0]", "start = [0, 2.5, 0]", 1);
    let text = refusal(&overlapping);
    assert!(
        text.starts_with("test.toml:10: generators[0]: sphere number 1 overlaps sphere number 0 (spheres[0]) by 5.000e-1"),
        "{text}"
    );
    let sunk = GOOD.replacen("position = [0, 2, 0]", "position = [0, 0.25, 0]", 1);
    assert!(refusal(&sunk).contains("spheres[0]: sphere number 0 overlaps colliders[0] \"floor\""));
    for bad in [overlapping, sunk] {
        let allowed = bad.replacen("[camera]", "[simulation]\nallow_overlap = true\n[camera]", 1);
        read(&allowed).unwrap();
    }
    let across = "[simulation]\nboundary = { periodic = { size = [6, 6, 6] } }\n\
                  [[generators]]\n[generators.lattice]\ncounts = [2, 1, 1]\n\
                  start = [-3, 0, 0]\nspacing = [6, 1, 1]\nsphere = { radius = 0.5 }\n";
    assert!(
        refusal(across).contains("number 1 overlaps sphere number 0 (generators[0]) by 1.000e0 m")
    );
    // Spheres that do not collide cannot overlap.
    let free = GOOD.replacen("start = [0, 5, 0]", "start = [0, 2.5, 0]", 1);
    read(&free.replacen("[camera]", "[simulation]\nspheres_collide = false\n[camera]", 1)).unwrap();
}

#[test]
fn what_the_first_step_would_refuse_is_refused_before_it() {
    let balls = "spheres = [{ radius = 0.5 }, { position = [2, 0, 0], radius = 0.5 }]\n";
    let small = "[simulation.boundary.periodic]\nsize = [9, 1.9, 9]\n";
    let refused = refusal(&format!("name = 'test'\n{balls}{small}"));
    let place = "test.toml:4: simulation.boundary.periodic.size: must be at least four times the";
    assert!(refused.starts_with(place), "{refused}");
    let spring = "[[springs]]\nspheres = [0, 1]\nstiffness = 1e15\n";
    let stiff = format!("name = 'test'\n{balls}{spring}");
    for rule in ["exact", "contact", "discrete", "bisect"] {
        let stiff = format!("{stiff}[simulation]\nrule = '{rule}'\n");
        let refused = refusal(&stiff);
        assert!(refused.starts_with("test.toml:3: springs: `stiffness` must be"), "{refused}");
        read(&stiff.replace("1e15", "1e3")).unwrap();
    }
}

#[test]
fn a_size_that_a_range_of_radii_replaces_makes_sense_all_the_same() {
    for (bad, field) in [("radius = 0, ", "radius"), ("diameter = -2, ", "diameter")] {
        let text = refusal(&RANDOM.replacen("radius = 1, ", bad, 1));
        let expected = format!("generators[0].random.sphere.{field}: must be");
        assert!(text.contains(&expected), "{text}");
    }
}

#[test]
fn texts_for_people_do_not_steer_a_terminal() {
    for field in ["name", "title", "description", "origin"] {
        let text = format!("{field} = \"a\\u001b[2J\"\n[[spheres]]\nradius = 1\n");
        let text = refusal(&text);
        assert!(text.contains(&format!("{field}: must have no control characters")), "{text}");
    }
    let emitter = "[[emitters]]\nname = \"a\\u009b2J\"\nperiod = 1\nsphere = { radius = 1 }\n";
    let collider = "[[colliders]]\nname = \"a\\u001b[2J\"\nshape = { sphere = { radius = 1 } }\n";
    for (bad, field) in [(emitter, "emitters[0].name"), (collider, "colliders[0].name")] {
        let text = refusal(bad);
        assert!(text.starts_with("test.toml:2: "), "{text}");
        assert!(text.contains(&format!("{field}: must have no control characters")), "{text}");
    }
    read("name = \"a\"\r\ndescription = \"\"\"one\r\n\ttwo\"\"\"\r\n[[spheres]]\r\nradius = 1\r\n")
        .unwrap();
}

/// A list of two hundred million overlaps would fill the memory.
#[test]
fn a_crowd_in_one_place_is_refused_by_one_overlap() {
    let crowd = "[[generators]]\n[generators.row]\ncount = 20000\nstart = [0, 0, 0]\n\
                 step = [1e-9, 0, 0]\nsphere = { radius = 0.5 }\n";
    let text = refusal(crowd);
    assert!(
        text.contains("generators[0]: sphere number") && text.contains("m at the start"),
        "{text}"
    );
}

#[test]
fn generators_make_no_more_together_than_one_may() {
    let million = "[[generators]]\n[generators.lattice]\ncounts = [100, 100, 100]\n\
                   start = [0, 0, 0]\nspacing = [1, 1, 1]\nsphere = { radius = 0.1 }\n";
    let text = refusal(&million.repeat(1000));
    let expected = "generators[2]: makes 3000000 spheres with those before it, and a scene has \
                    2000000 at most";
    assert!(text.contains(expected), "{text}");
}

#[test]
fn a_scene_written_out_reads_back_as_the_same() {
    for entry in Library::new().entries().unwrap() {
        let scene = entry.scene.unwrap();
        assert_eq!(Scene::from_toml(&scene.to_toml(), "again").unwrap(), scene);
        let expanded = scene.expanded().unwrap();
        assert!(expanded.generators.is_empty());
        let hash = |scene: &Scene| scene.world().unwrap().state_hash();
        assert_eq!(hash(&expanded), hash(&scene));
        assert_eq!(hash(&Scene::from_toml(&expanded.to_toml(), "again").unwrap()), hash(&scene));
    }
}

const RANDOM: &str = r#"
name = "random"
[[spheres]]
position = [5, 5, 5]
radius = 3
[[colliders]]
shape = { box = { size = [4, 4, 4] } }
[[generators]]
[generators.random]
count = 600
min = [-5, -5, -5]
max = [8, 8, 8]
seed = 7
speed = 2
radius_range = [0.05, 0.4]
sphere = { radius = 1, velocity = [10, 0, 0] }
"#;

#[test]
fn random_fillings_overlap_nothing_and_repeat_by_their_seed() {
    let scene = read(RANDOM).unwrap();
    let world = scene.world().unwrap();
    assert_eq!(world.spheres().len(), 601);
    assert!(world.overlaps(0.0).is_empty());
    let radii = &world.spheres().radii()[1..];
    assert!(radii.iter().all(|radius| (0.05..=0.4).contains(radius)));
    assert!(radii.iter().any(|radius| *radius < 0.1) && radii.iter().any(|radius| *radius > 0.35));
    for (x, r) in world.spheres().positions()[1..].iter().zip(radii) {
        assert!(x.min_element() - r >= -5.0 && x.max_element() + r <= 8.0);
    }
    for v in &world.spheres().velocities()[1..] {
        assert!(((*v - carom::DVec3::new(10.0, 0.0, 0.0)).length() - 2.0).abs() < 1e-12);
    }
    let hash = |seed: u64| {
        let text = RANDOM.replacen("seed = 7", &format!("seed = {seed}"), 1);
        read(&text).unwrap().world().unwrap().state_hash()
    };
    let again = hash(7);
    assert_eq!(again, world.state_hash());
    // Pinned: a scene must not change with the version of a library.
    assert_eq!(again.to_string(), "b07a1be1b806acc0");
    assert_ne!(hash(8), world.state_hash());
    // A small box cannot hold all spheres.
    let full = RANDOM.replacen("max = [8, 8, 8]", "max = [-3, -3, -3]", 1);
    assert!(refusal(&full).contains("generators[0].random.count: only "), "{}", refusal(&full));
    let aside = RANDOM.replacen("radius = 1,", "radius = 1, position = [100, 0, 0],", 1);
    let aside = read(&aside).unwrap().world().unwrap();
    assert!(aside.spheres().positions()[1..].iter().all(|x| x.x > 90.0));
    let far = RANDOM.replace("-5", "1e30").replace("max = [8, 8, 8]", "max = [2e30, 2e30, 2e30]");
    read(&far).unwrap();
    let endless = RANDOM.replacen("count = 600", "count = 4000000000", 1);
    assert!(refusal(&endless).contains("generators[0].random.count: must make 1 to"));
    let narrow = RANDOM.replacen("max = [8, 8, 8]", "max = [8, -4.5, 8]", 1);
    assert!(refusal(&narrow).contains(":12: generators[0].random.max: must be above `min`"));
}

#[test]
fn overrides_change_values_by_their_path() {
    let set = |text: &str| text.parse::<Override>();
    let with = |texts: &[&str]| {
        let overrides: Vec<_> = texts.iter().map(|text| set(text).unwrap()).collect();
        Scene::from_toml_with(GOOD, "test.toml", &overrides)
    };
    let scene = with(&[
        "simulation.rule=discrete",
        "simulation.bisect.max_halvings = 12",
        "emitters.0.max_spheres=100",
        "spheres.0.position=[1, 2, 3]",
        "title=Hello there",
    ])
    .unwrap();
    assert_eq!(scene.settings().rule, carom::Discrete::default().into());
    assert_eq!(scene.simulation.bisect.max_halvings, 12);
    assert_eq!(scene.emitters[0].max_spheres, Some(100));
    assert_eq!(scene.spheres[0].position, [1.0, 2.0, 3.0]);
    assert_eq!(scene.title, "Hello there");

    let unlimited = ["emitters.0.max_spheres=3", "emitters[0].max_spheres=none"];
    assert_eq!(with(&unlimited).unwrap().emitters[0].max_spheres, None);
    let of_bisect = ["simulation.rule=bisect", "simulation.bisect.integrator=rk4"];
    let rk4 = carom::Bisect::default().with_integrator(carom::Integrator::RungeKutta4);
    assert_eq!(with(&of_bisect).unwrap().settings().rule, rk4.into());

    let deep = format!("{}=3", vec!["a"; 100_000].join("."));
    for bad in ["simulation.rule", "=3", "a..b=3", ".a=3", "[]=3", &deep] {
        assert!(matches!(set(bad), Err(SceneError::BadOverride { .. })), "{bad}");
    }
    let refusals = [
        ("emitters.3.period=1", "emitters.3.period=1: there is no element 3, only 0 to 0"),
        ("name.first=1", "name.first=1: nothing lies below `name`"),
        ("fog.0.color=1", "fog.0.color=1: the scene has no `fog`"),
        ("camera.far=none", "camera.far=none: the scene has no `far` there"),
        ("spheres.0.radius=-1", "spheres.0.radius=-1: test.toml: spheres[0].radius: must be"),
        ("spheres[0].radius=9", "spheres[0].radius=9: test.toml: generators[0]: sphere number 1"),
        ("generators.0.row.step=[0, 0, 0]", "generators.0.row.step=[0, 0, 0]: test.toml: gen"),
        ("simulation.rle=discrete", "did you mean \"rule\"?"),
    ];
    for (text, expected) in refusals {
        let refusal = with(&[text]).unwrap_err().to_string();
        assert!(refusal.contains(expected), "{refusal}");
    }
    // An error in the file itself is not attributed to an override.
    let broken = GOOD.replacen("radius = 0.5", "radius = -1", 1);
    let harmless = [set("spheres.0.color=[1, 0, 0]").unwrap()];
    let refusal = Scene::from_toml_with(&broken, "test.toml", &harmless).unwrap_err().to_string();
    assert!(refusal.starts_with("test.toml:8: spheres[0].radius"), "{refusal}");
}

#[test]
fn scenes_are_found_in_folders_and_among_registered_ones() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("mine.toml"), GOOD.replace("\"test\"", "\"mine\"")).unwrap();
    std::fs::write(folder.path().join("simtest1.toml"), GOOD.replace("\"test\"", "\"simtest1\""))
        .unwrap();
    let broken = "name = \"simtest2\"\n[[spheres]]\nradius = ";
    std::fs::write(folder.path().join("broken.toml"), broken).unwrap();
    let mut library = Library::new();
    library.add_folder(folder.path()).unwrap();
    assert_eq!(library.find("MINE", &[]).unwrap().0.name, "mine");
    // A scene of a user takes precedence over a built-in one of the same name.
    assert!(library.find("simtest1", &[]).unwrap().0.description.is_empty());
    // A broken one also does: another scene must not run in its place.
    let broken = library.find("simtest2", &[]).unwrap_err().to_string();
    assert!(broken.contains("broken.toml:3"), "{broken}");
    let entries = library.entries().unwrap();
    let named = |name: &str| entries.iter().filter(|it| it.name == name).collect::<Vec<_>>();
    assert!(matches!(named("simtest2")[..], [entry] if entry.scene.is_err()));
    assert!(library.find("", &[]).is_err());

    let mut registered = read(GOOD).unwrap();
    registered.name = "from code".to_owned();
    library.register(registered.clone()).unwrap();
    assert_eq!(library.find("From Code", &[]).unwrap().0, registered);
    registered.spheres[0].radius = Some(f64::NAN);
    assert!(library.register(registered).unwrap_err().to_string().contains("spheres[0].radius"));

    let file = folder.path().join("mine.toml");
    assert_eq!(library.find(file.to_str().unwrap(), &[]).unwrap().0.name, "mine");
    let missing = library.find("simtst3", &[]).unwrap_err().to_string();
    assert!(missing.contains("did you mean \"simtest3\"?"), "{missing}");
    let missing = library.find("sphere", &[]).unwrap_err().to_string();
    assert!(missing.contains("did you mean \"Rain on a sphere\"?"), "{missing}");
    let missing = library.find("nosuch.toml", &[]).unwrap_err().to_string();
    assert!(missing.starts_with("cannot read nosuch.toml"), "{missing}");
    assert!(Library::new().add_folder(&folder.path().join("none")).is_err());
}
