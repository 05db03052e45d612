//! Materials of scene files: what bodies take from them, their pairs, and what is refused.

use carom_scene::scene::{RestitutionLaw, Scene};

const TABLE: &str = r#"
name = "table"

[materials.steel]
restitution = 0.9
friction = 0.2
density = "7.8 g/cm^3"
color = "silver"

[materials.rubber]
restitution_law = { power-law = { restitution = 0.8, speed = "50 cm/s" } }
rolling_friction = 0.01
finish = "matte"

[[material_pairs]]
materials = ["steel", "rubber"]
restitution = 0.4
friction = 0.6

[[material_pairs]]
materials = ["rubber", "rubber"]
restitution_law = { viscoelastic = { speed = "10 km/s" } }

[[spheres]]
radius = 0.1
material = "steel"

[[spheres]]
position = [1.0, 0.0, 0.0]
radius = 0.1
material = "steel"
restitution = 0.5
mass = 2.0

[[generators]]
row = { count = 2, start = [3, 0, 0], step = [1, 0, 0], sphere = { radius = 0.1, material = "rubber" } }

[[emitters]]
position = [0.0, 5.0, 0.0]
period = 1.0
sphere = { radius = 0.1, material = "rubber", friction = 0.3 }

[[colliders]]
shape = "half-space"
position = [0.0, -1.0, 0.0]
material = "rubber"

[[colliders]]
shape = { sphere = { radius = 0.2 } }
position = [0.0, -5.0, 0.0]
material = "rubber"
restitution = 0.3
"#;

fn scene(text: &str) -> Scene {
    Scene::from_toml(text, "table.toml").unwrap()
}

#[test]
fn bodies_take_the_fields_that_they_do_not_have_from_their_material() {
    let scene = scene(TABLE);
    let [steel, mine] = [&scene.spheres[0], &scene.spheres[1]];
    assert_eq!((steel.restitution, steel.friction, steel.density), (0.9, Some(0.2), Some(7800.0)));
    assert_eq!(steel.color, mine.color);
    assert_eq!((mine.restitution, mine.friction, mine.density), (0.5, Some(0.2), None));
    let law = RestitutionLaw::PowerLaw { restitution: 0.8, speed: 0.5, exponent: 0.25 };
    let emitted = &scene.emitters[0].sphere;
    assert_eq!((emitted.restitution_law, emitted.friction), (Some(law), Some(0.3)));
    assert_eq!(scene.generators[0].sphere().unwrap().rolling_friction, Some(0.01));
    assert_eq!(scene.colliders[0].restitution_law, Some(law));
    // A coefficient of its own keeps the law of the material out.
    assert_eq!((scene.colliders[1].restitution, scene.colliders[1].restitution_law), (0.3, None));
    let world = scene.world().unwrap();
    let spheres = world.spheres();
    assert!((spheres.masses()[0] / (7800.0 * carom::volume(0.1)) - 1.0).abs() < 1e-15);
    let materials: Vec<u8> = (0..4).map(|it| spheres.get(it).material).collect();
    // In the order of names: rubber, steel.
    assert_eq!(materials, [2, 2, 1, 1]);
    assert!(world.colliders().all(|(_, it)| it.material == 1));
    assert!(world.emitters().all(|(_, it)| it.sphere.material == 1));
    assert_eq!(world.material_pairs().len(), 2);
    assert_eq!(world.material_pairs()[0].materials, [2, 1]);
}

#[test]
fn a_scene_that_is_written_and_read_is_the_same_and_its_materials_can_be_changed() {
    let scene = scene(TABLE);
    let again = Scene::from_toml(&scene.to_toml(), "table.toml").unwrap();
    assert_eq!(again, scene);
    assert_eq!(again.to_toml(), scene.to_toml());
    let softer = scene.with(&["materials.steel.restitution=0.7".parse().unwrap()]).unwrap();
    assert_eq!(softer.spheres[0].restitution, 0.7);
    assert_eq!(softer.spheres[1].restitution, 0.5);
    let harder = scene.with(&["material_pairs.0.restitution=1".parse().unwrap()]).unwrap();
    assert_eq!(harder.world().unwrap().material_pairs()[0].restitution, Some(1.0));
}

#[test]
fn what_is_wrong_with_materials_is_said_with_its_line() {
    let cases = [
        (
            ("material = \"steel\"\n\n", "material = \"stel\"\n\n"),
            ":26: spheres[0].material",
            "did you mean \"steel\"?",
        ),
        (("restitution = 0.9", "restitution = 1.9"), ":5: materials.steel.restitution", "[0, 1]"),
        (("friction = 0.2", "friction = -0.2"), ":6: materials.steel.friction", "zero or positive"),
        (("friction = 0.2", "frition = 0.2"), ":6: materials.steel.frition", "\"friction\"?"),
        (("\"50 cm/s\"", "0"), "materials.rubber.restitution_law.speed", "positive"),
        (("\"10 km/s\"", "nan"), "material_pairs[1].restitution_law.speed", "positive"),
        (
            ("\"steel\", \"rubber\"", "\"steel\", \"felt\""),
            "material_pairs[0].materials",
            "unknown material \"felt\"",
        ),
        (
            ("\"steel\", \"rubber\"", "\"rubber\", \"rubber\""),
            "material_pairs[1].materials",
            "a second time",
        ),
        (("\"steel\", \"rubber\"", "\"steel\""), "material_pairs[0].materials", ""),
        (("friction = 0.6", "friction = inf"), ":18: material_pairs[0].friction", "finite"),
        (("[materials.steel]", "[metals.steel]"), "unknown", ""),
    ];
    for ((from, to), field, problem) in cases {
        assert!(TABLE.contains(from), "{from}");
        let error = Scene::from_toml(&TABLE.replacen(from, to, 1), "table.toml").unwrap_err();
        let text = error.to_string();
        assert!(text.contains(field) && text.contains(problem), "{to}: {text}");
    }
}

#[test]
fn a_ball_of_a_material_bounces_as_its_pair_says() {
    let scene = scene(&TABLE.replace(
        "[[emitters]]",
        "[[forces]]\ngravity = { acceleration = [0, -10, 0] }\n\n[[emitters]]",
    ));
    let mut world = scene.world().unwrap();
    let mut found = Vec::new();
    for _ in 0..60 {
        let impacts = world.step(1.0 / 60.0).unwrap().impacts.iter();
        found.extend(impacts.map(|it| (it.point.x, it.separation_speed / it.approach_speed)));
    }
    let at = |x: f64| found.iter().find(|(place, _)| (place - x).abs() < 0.01).unwrap().1;
    // Steel on rubber by the pair, whatever the ball's own coefficient; rubber on rubber by the law of the pair.
    assert!((at(0.0) - 0.4).abs() < 1e-12 && (at(1.0) - 0.4).abs() < 1e-12, "{found:?}");
    let law = carom::RestitutionLaw::Viscoelastic { speed: 1e4 };
    let speed = (2.0_f64 * 10.0 * 0.9).sqrt();
    assert!((at(3.0) - law.at(speed)).abs() < 1e-12, "{found:?}");
}

#[test]
fn random_fillings_keep_the_distances_of_pairs_of_materials() {
    let text = |non_additivity: f64| {
        format!(
            "name = \"two fillings\"\n[materials.one]\n[materials.other]\n\
             [[material_pairs]]\nmaterials = [\"other\", \"one\"]\nnon_additivity = {non_additivity}\n\
             [[generators]]\nrandom = {{ count = 40, min = [0, 0, 0], max = [10, 10, 10], seed = 3, \
             sphere = {{ radius = 0.5, material = \"one\" }} }}\n\
             [[generators]]\nrandom = {{ count = 40, min = [0, 0, 0], max = [10, 10, 10], seed = 4, \
             sphere = {{ radius = 0.3, material = \"other\" }} }}\n"
        )
    };
    for non_additivity in [-0.5, 0.0, 0.8] {
        let scene = carom_scene::Scene::from_toml(&text(non_additivity), "fillings").unwrap();
        let worlds = [scene.world().unwrap(), scene.expanded().unwrap().world().unwrap()];
        assert_eq!(worlds[0].state_hash(), worlds[1].state_hash());
        let places = worlds[0].spheres().positions();
        let distances =
            places[..40].iter().flat_map(|one| places[40..].iter().map(|it| one.distance(*it)));
        let least = distances.fold(f64::INFINITY, f64::min);
        let allowed = 0.8 * (1.0 + non_additivity);
        assert!(least > allowed, "{least}");
        // Spheres that may sink into each other do.
        assert!(non_additivity >= 0.0 || least < 0.8, "{least}");
    }
    let error = carom_scene::Scene::from_toml(&text(10.0), "fillings").unwrap_err();
    assert!(error.to_string().contains("material_pairs[0].non_additivity"), "{error}");
}
