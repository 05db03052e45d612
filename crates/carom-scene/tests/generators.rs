//! Generators of scene files: spheres are where rows, rings and packings have them, and mistakes are
//! reported with line and field.

use carom::DVec3;
use carom_scene::Scene;

fn read(text: &str) -> Scene {
    Scene::from_toml(&format!("name = 'test'\n{text}"), "test.toml").unwrap()
}

fn refusal(text: &str) -> String {
    Scene::from_toml(&format!("name = 'test'\n{text}"), "test.toml").unwrap_err().to_string()
}

fn centers(scene: &Scene) -> Vec<DVec3> {
    scene.world().unwrap().spheres().positions().to_vec()
}

/// How many others touch each: closer than by a billionth of this distance more.
fn neighbours(centers: &[DVec3], distance: f64) -> Vec<usize> {
    let touching = |center: &DVec3| {
        let near = |other: &&DVec3| center.distance(**other) < (1.0 + 1e-9) * distance;
        centers.iter().filter(near).count() - 1
    };
    centers.iter().map(touching).collect()
}

const RING: &str = "generators = [{ ring = { count = 12, center = [1, 2, 3], radius = 2, \
                    axis = [0, 0, 5], sphere = { radius = 0.1, position = [0, 0, 1] } } }]";

#[test]
fn a_ring_has_its_spheres_evenly_on_a_circle() {
    let scene = read(RING);
    let centers = centers(&scene);
    assert_eq!(centers.len(), 12);
    let middle = DVec3::new(1.0, 2.0, 4.0);
    assert!((centers[0] - middle).distance(DVec3::X * 2.0) < 1e-15, "the first is at +x");
    assert!((centers[3] - middle).distance(DVec3::Y * 2.0) < 1e-15, "by the right-hand rule");
    let side = 4.0 * (std::f64::consts::PI / 12.0).sin();
    for (i, center) in centers.iter().enumerate() {
        assert!((center.distance(middle) - 2.0).abs() < 1e-15);
        assert!((center.distance(centers[(i + 1) % 12]) - side).abs() < 1e-14);
        assert_eq!(center.z, 4.0);
    }
    assert_eq!(read(&scene.to_toml().replacen("name = \"test\"", "", 1)), scene);
}

#[test]
fn a_ring_lies_flat_unless_it_has_an_axis() {
    let flat = RING.replace("axis = [0, 0, 5], ", "");
    assert!(centers(&read(&flat)).iter().all(|center| center.y == 2.0));
    let upright = centers(&read(&RING.replace("[0, 0, 5]", "[3, 0, 0]")));
    assert!(upright.iter().all(|center| center.x == 1.0));
    assert!(upright[0].distance(DVec3::new(1.0, 4.0, 4.0)) < 1e-15, "the first is at +y");
}

fn packing(stacking: &str) -> Vec<DVec3> {
    let text = format!(
        "generators = [{{ close-packing = {{ counts = [5, 6, 7], start = [1, 0, -2], \
         {stacking}sphere = {{ radius = 0.25 }} }} }}]"
    );
    centers(&read(&text))
}

#[test]
fn spheres_of_a_close_packing_touch_twelve_others() {
    for stacking in ["", "stacking = 'hcp', ", "stacking = 'fcc', "] {
        let centers = packing(stacking);
        assert_eq!((centers.len(), centers[0]), (5 * 6 * 7, DVec3::new(1.0, 0.0, -2.0)));
        let counts = neighbours(&centers, 0.5);
        assert_eq!(counts.iter().max(), Some(&12), "{stacking}");
        // All that have others on every side.
        let inner = counts.iter().filter(|count| **count == 12).count();
        assert_eq!(inner, 3 * 4 * 5, "{stacking}");
    }
}

/// In face-centred cubic packing, neighbours lie opposite each other; in hexagonal packing, layers
/// lie above the next but one.
#[test]
fn stacking_says_where_the_third_layer_lies() {
    let (hcp, fcc) = (packing(""), packing("stacking = 'fcc', "));
    let layer = |centers: &[DVec3], number: usize| centers[35 * number] - centers[0];
    let flat = |way: DVec3| DVec3::new(way.x, 0.0, way.z);
    assert!(flat(layer(&hcp, 2)).length() < 1e-15);
    assert!((flat(layer(&fcc, 2)).length() - 0.5 / 3.0_f64.sqrt()).abs() < 1e-15);
    assert!(flat(layer(&fcc, 3)).length() < 1e-15);
    let opposite = |centers: &[DVec3]| {
        let middle = centers[35 * 2 + 5 * 3 + 2];
        let near = |place: DVec3| centers.iter().any(|center| center.distance(place) < 1e-9);
        let others = centers.iter().filter(|other| (0.4..0.6).contains(&other.distance(middle)));
        others.filter(|other| near(2.0 * middle - **other)).count()
    };
    assert_eq!((opposite(&fcc), opposite(&hcp)), (12, 6));
}

#[test]
fn a_close_packing_can_be_loose() {
    let text = "generators = [{ close-packing = { counts = [4, 4, 4], start = [0, 0, 0], \
                spacing = 0.6, sphere = { diameter = 0.5 } } }]";
    let centers = centers(&read(text));
    assert_eq!(neighbours(&centers, 0.6).iter().max(), Some(&12));
    assert_eq!(neighbours(&centers, 0.59).iter().max(), Some(&0));
}

#[test]
fn a_mistake_in_a_generator_is_reported_with_line_and_field() {
    let ring = "[[generators]]\n[generators.ring]\ncount = 5\ncenter = [0, 0, 0]\nradius = 2\n\
                axis = [0, 1, 0]\nsphere = { radius = 0.1 }\n";
    let packing = "[[generators]]\n[generators.close-packing]\ncounts = [2, 2, 2]\n\
                   start = [0, 0, 0]\nspacing = 1.0\nstacking = 'fcc'\nsphere = { radius = 0.1 }\n";
    let cases = [
        (ring, "count = 5", "count = 0", "4: generators[0].ring.count: must make 1 to"),
        (ring, "[0, 0, 0]", "[0, nan, 0]", "5: generators[0].ring.center: must be finite"),
        (ring, "radius = 2", "radius = -2", "6: generators[0].ring.radius: must be positive"),
        (ring, "[0, 1, 0]", "[0, 0, 0]", "7: generators[0].ring.axis: must be a direction"),
        (ring, "[0, 1, 0]", "[0, inf, 0]", "7: generators[0].ring.axis: must be a direction"),
        (ring, "radius = 2", "radius = 0.1", "2: generators[0]: sphere number 1 overlaps"),
        (ring, "axis", "axes", "7: generators[0].ring.axes: unknown field"),
        (packing, "[2, 2, 2]", "[2, 0, 2]", "4: generators[0].close-packing.counts: must make"),
        (packing, "[0, 0, 0]", "[0, 0, inf]", "5: generators[0].close-packing.start: must be fin"),
        (
            packing,
            "spacing = 1.0",
            "spacing = 0",
            "6: generators[0].close-packing.spacing: must be",
        ),
        (packing, "'fcc'", "'bcc'", "7: generators[0].close-packing.stacking: unknown variant"),
        (packing, "spacing = 1.0", "spacing = 0.1", "2: generators[0]: sphere number 1 overlaps"),
        (packing, "close-", "closed-", "3: generators[0]: unknown variant"),
    ];
    for (good, word, wrong, expected) in cases {
        read(good);
        let text = refusal(&good.replacen(word, wrong, 1));
        assert!(text.starts_with(&format!("test.toml:{expected}")), "{wrong}: {text}");
    }
    // Without a radius, neighbours have no distance.
    let text = refusal(&packing.replace("spacing = 1.0\n", "").replace("radius = 0.1", "mass = 1"));
    assert!(text.contains("generators[0].close-packing.sphere: needs `radius`"), "{text}");
}

/// What is generated is the same whether it is generated or written out.
#[test]
fn generators_written_out_make_the_same_world() {
    let scene = read(&format!("{RING}\n"));
    let expanded = scene.expanded().unwrap();
    assert!(expanded.generators.is_empty() && expanded.spheres.len() == 12);
    assert_eq!(expanded.world().unwrap().state_hash(), scene.world().unwrap().state_hash());
}
