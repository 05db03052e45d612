//! Generators of scene files: spheres lie at the places of rows, rings and packings, and errors
//! name line and field.

use carom::{DQuat, DVec3};
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

/// Number of touching neighbours of each centre: those within `distance`, plus a relative 1e-9.
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
        // Spheres that are not at the border have 12 neighbours.
        let inner = counts.iter().filter(|count| **count == 12).count();
        assert_eq!(inner, 3 * 4 * 5, "{stacking}");
    }
}

/// In face-centred cubic packing, opposite neighbours lie on one line; in hexagonal packing, every
/// second layer lies above the first.
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

/// Generated spheres equal those that are written out.
#[test]
fn generators_written_out_make_the_same_world() {
    let scene = read(&format!("{RING}\n"));
    let expanded = scene.expanded().unwrap();
    assert!(expanded.generators.is_empty() && expanded.spheres.len() == 12);
    assert_eq!(expanded.world().unwrap().state_hash(), scene.world().unwrap().state_hash());
}

const PEGS: &str = "[[colliders]]\nname = 'floor'\nshape = 'half-space'\n\
                    [[generators]]\n[generators.staggered-rows]\nrows = 5\ncounts = [4, 3]\n\
                    start = [1, 9, 0]\nstep = [2, 0, 0]\nrow_step = [0, -1, 0]\n\
                    [generators.staggered-rows.collider]\nname = 'peg'\nrestitution = 0.5\n\
                    position = [0, 0, 7]\ncolor = [1, 0, 0]\nshape = { sphere = { radius = 0.25 } }\n";

#[test]
fn staggered_rows_of_pegs_come_after_single_colliders() {
    let scene = read(PEGS);
    let world = scene.world().unwrap();
    let all = scene.all_colliders();
    assert_eq!((all.len(), world.colliders().len()), (1 + 4 + 3 + 4 + 3 + 4, all.len()));
    for (written, (_, collider)) in all.iter().zip(world.colliders()) {
        assert_eq!(collider.pose.position.to_array(), written.position);
    }
    let named = |name: &str| all.iter().find(|it| it.name == name).unwrap().position;
    assert_eq!(all[0].name, "floor");
    assert_eq!(named("peg 1-1"), [1.0, 9.0, 7.0]);
    assert_eq!(named("peg 1-4"), [7.0, 9.0, 7.0]);
    // The second row is centred on the first.
    assert_eq!((named("peg 2-1"), named("peg 2-3")), ([2.0, 8.0, 7.0], [6.0, 8.0, 7.0]));
    assert_eq!(named("peg 5-4"), [7.0, 5.0, 7.0]);
    assert!(world.colliders().skip(1).all(|(_, collider)| collider.restitution == 0.5));
    let palette = carom_scene::Palette::new(&scene).unwrap();
    assert_eq!(palette.collider(18).color, [1.0, 0.0, 0.0]);
    assert_ne!(palette.collider(0).color, [1.0, 0.0, 0.0]);
}

#[test]
fn pegs_written_out_make_the_same_world() {
    let scene = read(PEGS);
    let expanded = scene.expanded().unwrap();
    assert!(expanded.generators.is_empty());
    assert_eq!(expanded.colliders, *scene.all_colliders());
    assert_eq!(expanded.world().unwrap().state_hash(), scene.world().unwrap().state_hash());
    let again = Scene::from_toml(&scene.to_toml(), "again").unwrap();
    assert_eq!(again, scene);
}

#[test]
fn staggered_rows_of_spheres_make_a_triangle() {
    let text = "generators = [{ staggered-rows = { rows = 5, counts = [1, 2, 3, 4, 5], \
                start = [0, 0, 0], step = [1, 0, 0], row_step = [0, 0, 0.8660254037844387], \
                sphere = { radius = 0.5 } } }]";
    let centers = centers(&read(text));
    assert_eq!(centers.len(), 15);
    let touching = neighbours(&centers, 1.0);
    assert_eq!(touching.iter().filter(|count| **count == 2).count(), 3, "corners");
    assert_eq!(touching.iter().filter(|count| **count == 6).count(), 3, "in the middle");
    let straight = read(&text.replace("[1, 2, 3, 4, 5]", "[3]").replace("0.8660254037844387", "1"));
    assert_eq!(straight.world().unwrap().spheres().len(), 15);
}

#[test]
fn a_sphere_may_not_overlap_a_peg() {
    let text = format!("{PEGS}[[spheres]]\nposition = [2, 8.3, 7]\nradius = 0.1\n");
    let text = refusal(&text);
    assert!(text.contains("sphere number 0 overlaps colliders[5] \"peg 2-1\""), "{text}");
}

#[test]
fn a_mistake_in_staggered_rows_is_reported_with_line_and_field() {
    let both = "[generators.staggered-rows.sphere]\nradius = 1\n";
    let cases = [
        ("rows = 5", "rows = 0", "7: generators[0].staggered-rows.rows: must be at least 1"),
        ("[4, 3]", "[4, 0]", "8: generators[0].staggered-rows.counts: must be at least 1 each"),
        ("[4, 3]", "[]", "8: generators[0].staggered-rows.counts: must make 1 to 1000000 coll"),
        ("[4, 3]", "[4e9]", "8: generators[0].staggered-rows.counts[0]: invalid"),
        ("[4, 3]", "[4000000000]", "8: generators[0].staggered-rows.counts: must make 1 to"),
        ("[1, 9, 0]", "[nan, 9, 0]", "9: generators[0].staggered-rows.start: must be finite"),
        ("[2, 0, 0]", "[inf, 0, 0]", "10: generators[0].staggered-rows.step: must be finite"),
        ("[0, -1, 0]", "[inf, 0, 0]", "11: generators[0].staggered-rows.row_step: must be"),
        ("row_step", "rowstep", "11: generators[0].staggered-rows.rowstep: unknown field"),
        ("0.5", "1.5", "14: generators[0].staggered-rows.collider.restitution: must be in"),
        ("[1, 0, 0]", "[1, 0, 2]", "16: generators[0].staggered-rows.collider.color: must have"),
        ("0.25", "-1", "17: generators[0].staggered-rows.collider.shape.sphere.radius: must be"),
        (
            "[generators.staggered-rows.coll",
            &format!("{both}[generators.staggered-rows.coll"),
            "14: generators[0].staggered-rows.collider: `sphere` says",
        ),
    ];
    for (word, wrong, expected) in cases {
        let text = refusal(&PEGS.replacen(word, wrong, 1));
        assert!(text.starts_with(&format!("test.toml:{expected}")), "{wrong}: {text}");
    }
    let neither = PEGS.split("[generators.staggered-rows.collider]").next().unwrap();
    let text = refusal(neither);
    assert!(text.contains("generators[0].staggered-rows: needs `sphere` or `collider`"), "{text}");
}

/// A generator of this kind and these fields with one collider: a box, unless `more` states another
/// shape.
fn of_colliders(kind: &str, fields: &str, more: &str) -> String {
    format!(
        "[[generators]]\n[generators.{kind}]\n{fields}\n[generators.{kind}.collider]\n\
         name = 'post'\nshape = {{ box = {{ size = [1, 2, 3] }} }}\n{more}\n"
    )
}

#[test]
fn rows_and_lattices_of_colliders_stand_where_spheres_would() {
    for (kind, fields, last) in [
        ("row", "count = 4\nstart = [1, 2, 3]\nstep = [0.5, 0, 1]", "post 4"),
        ("lattice", "counts = [2, 1, 3]\nstart = [1, 2, 3]\nspacing = [4, 5, 6]", "post 2-1-3"),
        ("ring", "count = 5\ncenter = [1, 2, 3]\nradius = 2\naxis = [1, 2, 3]", "post 5"),
    ] {
        let colliders = read(&of_colliders(kind, fields, "")).all_colliders().into_owned();
        let sphere = "sphere = { radius = 0.1 }";
        let spheres = read(&format!("[[generators]]\n[generators.{kind}]\n{fields}\n{sphere}\n"));
        let places: Vec<_> =
            spheres.expanded().unwrap().spheres.iter().map(|it| it.position).collect();
        let of_colliders: Vec<_> = colliders.iter().map(|it| it.position).collect();
        assert_eq!(of_colliders, places, "{kind}");
        assert_eq!(colliders.last().unwrap().name, last);
    }
}

/// Boxes in a circle, each turned so that its face points at the axis as the first one's does.
#[test]
fn colliders_of_a_ring_are_turned_along_with_their_places() {
    let fields = "count = 8\ncenter = [0, 3, 0]\nradius = 2\naxis = [0, 0, 2]";
    let more = "position = [0.25, 0, 0]\nvelocity = [1, 0, 0]\nangular_velocity = [0, 1, 0]";
    let scene = read(&of_colliders("ring", fields, more));
    let all = scene.all_colliders();
    let close = |a: DVec3, b: DVec3| (a - b).length() < 4.0 * f64::EPSILON * 3.0;
    for (i, collider) in all.iter().enumerate() {
        let angle = std::f64::consts::TAU * i as f64 / 8.0;
        let outward = DVec3::new(angle.cos(), angle.sin(), 0.0);
        let onward = DVec3::Z.cross(outward);
        let rotation = DQuat::from_array(collider.rotation);
        assert!(close(rotation * DVec3::X, outward), "{i}");
        assert!(close(collider.position.into(), DVec3::Y * 3.0 + 2.25 * outward), "{i}");
        assert!(close(collider.velocity.into(), outward), "{i}");
        assert!(close(collider.angular_velocity.into(), onward), "{i}");
    }
    let expanded = scene.expanded().unwrap();
    assert_eq!(expanded.world().unwrap().state_hash(), scene.world().unwrap().state_hash());
    assert_eq!(Scene::from_toml(&scene.to_toml(), "again").unwrap(), scene);
}

#[test]
fn a_generator_makes_spheres_or_colliders_not_both_nor_none() {
    for (kind, fields) in [
        ("row", "count = 4\nstart = [1, 2, 3]\nstep = [9, 0, 1]"),
        ("lattice", "counts = [2, 1, 3]\nstart = [1, 2, 3]\nspacing = [4, 5, 6]"),
        ("ring", "count = 5\ncenter = [1, 2, 3]\nradius = 9"),
        (
            "staggered-rows",
            "rows = 1\ncounts = [2]\nstart = [1, 2, 3]\nstep = [9, 0, 1]\nrow_step = [0, 1, 0]",
        ),
    ] {
        let none = refusal(&format!("[[generators]]\n[generators.{kind}]\n{fields}\n"));
        let expected = format!("generators[0].{kind}: needs `sphere` or `collider`");
        assert!(none.contains(&expected), "{none}");
        let both =
            refusal(&of_colliders(kind, &format!("{fields}\nsphere = {{ radius = 1 }}"), ""));
        assert!(both.contains(&format!("generators[0].{kind}.collider: `sphere` says")), "{both}");
    }
    let many = "count = 1000001\nstart = [1, 2, 3]\nstep = [9, 0, 1]";
    let many = refusal(&of_colliders("row", many, ""));
    assert!(many.contains("row.count: must make 1 to 1000000 colliders, not 1000001"), "{many}");
}
