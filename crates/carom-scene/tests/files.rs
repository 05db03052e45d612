//! Scene files: what they can say, and that every mistake is told with its line, its field and
//! the nearest known name.

use carom::Mass;
use carom_scene::{Library, Override, Scene, SceneError};

fn read(text: &str) -> Result<Scene, SceneError> {
    Scene::from_toml(text, "test.toml")
}

fn refusal(text: &str) -> String {
    read(text).unwrap_err().to_string()
}

/// A small good scene, each part on lines of its own.
const GOOD: &str = r#"name = "test"

[[forces]]
type = "gravity"
acceleration = [0, -9.81, 0]

[[spheres]]
position = [0, 2, 0]
radius = 0.5

[[generators]]
kind = "row"
count = 3
start = [0, 5, 0]
step = [2, 0, 0]
sphere = { diameter = 1.0, density = 2.0, velocity = [0, -1, 0] }

[[colliders]]
name = "floor"
restitution = 0.5

[colliders.shape]
type = "rectangle"
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
    assert_eq!(world.colliders()[0].restitution, 0.5);
}

#[test]
fn every_mistake_is_told_with_its_line_and_field() {
    // What is replaced in the good scene, and the beginning of what must be said.
    let cases = [
        ("radius = 0.5", "radius = -0.5", "test.toml:9: spheres[0].radius: must be positive"),
        ("radius = 0.5", "radius = nan", "test.toml:9: spheres[0].radius: must be positive"),
        ("radius = 0.5", "", "test.toml:7: spheres[0]: needs `radius` or `diameter`"),
        ("radius = 0.5", "radius = 1\ndiameter = 2", "test.toml:10: spheres[0].diameter: `radius`"),
        ("radius = 0.5", "radius = \"big\"", "test.toml:9: spheres[0].radius: invalid type"),
        ("radius = 0.5", "radius = 1\nmass = 0", "test.toml:10: spheres[0].mass: must be positive"),
        ("radius = 0.5", "radius = 1\nmass = 1\ndensity = 1", "test.toml:11: spheres[0].density"),
        ("position = [0, 2, 0]", "position = [0, 2]", "test.toml:8: spheres[0].position: invalid"),
        ("[0, 2, 0]", "[0, inf, 0]", "test.toml:8: spheres[0].position: must be finite"),
        ("restitution = 0.5", "restitution = 1.5", "test.toml:20: colliders[0].restitution"),
        ("size_x = 10", "size_x = 0", "test.toml:24: colliders[0].shape.size_x: must be positive"),
        ("period = 0.5", "period = 0", "test.toml:28: emitters[0].period: must be positive"),
        ("mass = 2", "mass = -2", "test.toml:30: emitters[0].sphere.mass: must be positive"),
        ("count = 3", "count = 0", "test.toml:13: generators[0].count: must make 1 to"),
        ("density = 2.0", "density = -2.0", "test.toml:16: generators[0].sphere.density"),
        ("[0, -9.81, 0]", "[0, nan, 0]", "test.toml:5: forces[0].acceleration: must be finite"),
        ("name = \"test\"", "name = \"\"", "test.toml:1: name: must not be empty"),
        ("name = \"test\"", "", "test.toml: missing field `name`"),
        ("[camera]", "[camera]\nvertical_fov_degrees = 180", "test.toml:33: camera.vertical_fov"),
        ("[camera]", "[camera]\nnear = 0", "test.toml:33: camera.near: must be positive"),
        (
            "[camera]",
            "[simulation]\nframe_time = 0\n[camera]",
            "test.toml:33: simulation.frame_time",
        ),
        (
            "[camera]",
            "[simulation.bisect]\nmax_halvings = 0\n[camera]",
            "test.toml:33: simulation.bisect.max_halvings",
        ),
        ("[camera]", "[colors]\nspheres = [0, 0, 2]\n[camera]", "test.toml:33: colors.spheres"),
        ("radius = 0.5", "radius = 0.5 m", "test.toml:9"),
    ];
    for (good, bad, expected) in cases {
        assert!(GOOD.contains(good), "{good}");
        let text = refusal(&GOOD.replacen(good, bad, 1));
        assert!(text.starts_with(expected), "{bad}: {text}");
        assert_eq!(text.lines().count(), 1, "{text}");
    }
}

#[test]
fn unknown_names_bring_the_nearest_known_one() {
    let cases = [
        ("radius = 0.5", "radus = 0.5", 9, "radius"),
        ("restitution = 0.5", "restitutoin = 0.5", 20, "restitution"),
        ("size_x = 10", "sizex = 10", 24, "size_x"),
        ("type = \"rectangle\"", "type = \"rectange\"", 23, "rectangle"),
        ("type = \"gravity\"", "type = \"gravty\"", 4, "gravity"),
        ("kind = \"row\"", "kind = \"rows\"", 12, "row"),
        ("[[emitters]]", "[[emiters]]", 27, "emitters"),
        ("mass = 2", "mas = 2", 30, "mass"),
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
        text.starts_with("test.toml:11: generators[0]: overlaps spheres[0] by 5.000e-1"),
        "{text}"
    );
    let sunk = GOOD.replacen("position = [0, 2, 0]", "position = [0, 0.25, 0]", 1);
    assert!(refusal(&sunk).contains("spheres[0]: overlaps colliders[0] \"floor\""));
    for bad in [overlapping, sunk] {
        let allowed = bad.replacen("[camera]", "[simulation]\nallow_overlap = true\n[camera]", 1);
        read(&allowed).unwrap();
    }
    // Spheres that do not collide cannot overlap.
    let free = GOOD.replacen("start = [0, 5, 0]", "start = [0, 2.5, 0]", 1);
    read(&free.replacen("[camera]", "[simulation]\nspheres_collide = false\n[camera]", 1)).unwrap();
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
shape = { type = "box", size = [4, 4, 4] }
[[generators]]
kind = "random"
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
    assert_eq!(hash(7), world.state_hash());
    assert_ne!(hash(8), world.state_hash());
    let full = RANDOM.replacen("count = 600", "count = 600000", 1);
    assert!(refusal(&full).contains("generators[0].count: only "), "{}", refusal(&full));
    let endless = RANDOM.replacen("count = 600", "count = 4000000000", 1);
    assert!(refusal(&endless).contains("generators[0].count: must make 1 to"));
    let narrow = RANDOM.replacen("max = [8, 8, 8]", "max = [8, -4.5, 8]", 1);
    assert!(refusal(&narrow).contains(":12: generators[0].max: must be above `min`"));
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
    assert_eq!(scene.settings().rule, carom::Rule::Discrete);
    assert_eq!(scene.simulation.bisect.max_halvings, 12);
    assert_eq!(scene.emitters[0].max_spheres, Some(100));
    assert_eq!(scene.spheres[0].position, [1.0, 2.0, 3.0]);
    assert_eq!(scene.title, "Hello there");

    for bad in ["simulation.rule", "=3", "a..b=3"] {
        assert!(matches!(set(bad), Err(SceneError::BadOverride { .. })), "{bad}");
    }
    let refusals = [
        ("emitters.3.period=1", "--set emitters.3.period=1: there is no 3 among 0..1"),
        ("name.first=1", "--set name.first=1: nothing lies below first"),
        ("spheres.0.radius=-1", "--set spheres.0.radius=-1: spheres[0].radius: must be positive"),
        ("simulation.rle=discrete", "did you mean \"rule\"?"),
    ];
    for (text, expected) in refusals {
        let refusal = with(&[text]).unwrap_err().to_string();
        assert!(refusal.contains(expected), "{refusal}");
    }
}

#[test]
fn scenes_are_found_in_folders_and_among_registered_ones() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("mine.toml"), GOOD.replace("\"test\"", "\"mine\"")).unwrap();
    std::fs::write(folder.path().join("simtest1.toml"), GOOD.replace("\"test\"", "\"simtest1\""))
        .unwrap();
    std::fs::write(folder.path().join("broken.toml"), "name = ").unwrap();
    let mut library = Library::new();
    library.add_folder(folder.path()).unwrap();
    assert_eq!(library.find("MINE", &[]).unwrap().0.name, "mine");
    // A user's own comes before the built-in one of the same name.
    assert!(library.find("simtest1", &[]).unwrap().0.description.is_empty());
    let broken = library.find("broken", &[]).unwrap_err().to_string();
    assert!(broken.contains("broken.toml:1"), "{broken}");
    let entries = library.entries().unwrap();
    assert!(entries.iter().any(|entry| entry.name == "broken" && entry.scene.is_err()));

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
    assert!(Library::new().add_folder(&folder.path().join("none")).is_err());
}
