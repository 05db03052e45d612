//! Tracks of scene files: their meshes lie where their pieces lead, and balls follow them.

use std::f64::consts::TAU;

use carom::{DVec3, QueryFilter, Shape, World};
use carom_scene::{BUILT_IN_FILES, Scene};

/// A scene with a track of these pieces and more fields, and nothing else.
fn scene_of(pieces: &str, more: &str) -> String {
    format!(
        "[[colliders]]\nshape = {{ track = {{ radius = 0.05, {more} pieces = [{pieces}] }} }}\n"
    )
}

fn world_of(text: &str) -> World {
    Scene::from_toml(text, "track.toml").unwrap().world().unwrap()
}

fn problem_of(pieces: &str, more: &str) -> String {
    Scene::from_toml(&scene_of(pieces, more), "track.toml").unwrap_err().to_string()
}

/// How high the track is below a place, from its origin \[m\].
fn height_below(world: &World, place: DVec3) -> Option<f64> {
    let hit = world.cast_ray(place, -20.0 * DVec3::Y, &QueryFilter::default()).unwrap()?;
    Some(place.y - 20.0 * hit.fraction)
}

#[test]
fn a_straight_track_has_its_lowest_facet_on_the_path_at_its_slope() {
    let world = world_of(&scene_of("{ straight = { length = 2.0 } }", "pitch_degrees = -30.0,"));
    let (sin, cos) = libm::sincos(30.0_f64.to_radians());
    for part in [0.1, 0.5, 0.9] {
        let (x, y) = (2.0 * part * cos, -2.0 * part * sin);
        let height = height_below(&world, DVec3::new(x, y + 0.03, 0.001)).unwrap();
        assert!((height - y).abs() < 1e-14, "{part} {height}");
    }
    assert_eq!(height_below(&world, DVec3::new(2.0, 1.0, 0.0)), None);
}

#[test]
fn facets_across_touch_the_circle_of_the_cross_section_everywhere() {
    for (arc, sides) in [(180.0, 61), (90.0, 13), (360.0, 37), (20.0, 3)] {
        let more = format!("arc_degrees = {arc}, sides = {sides},");
        let world = world_of(&scene_of("{ straight = { length = 1.0 } }", &more));
        // From the middle of the circle, in every direction that has a wall.
        for number in 0..100 {
            let angle = (f64::from(number) / 99.0 - 0.5) * f64::to_radians(0.99 * arc);
            let way = DVec3::new(0.0, -libm::cos(angle), libm::sin(angle));
            let center = DVec3::new(0.5, 0.05, 0.0);
            let hit = world.cast_ray(center, way, &QueryFilter::default()).unwrap().unwrap();
            // A facet of the angle d reaches from r to r / cos(d / 2).
            let farthest = 0.05 / libm::cos(0.5 * f64::to_radians(arc) / f64::from(sides));
            let distance = hit.fraction;
            assert!(distance > 0.05 - 1e-15 && distance < farthest + 1e-15, "{arc} {distance}");
        }
    }
}

#[test]
fn a_curve_goes_round_its_centre_and_a_full_one_with_a_slope_is_a_helix() {
    let curve = "{ curve = { radius = 0.5, degrees = 360.0 } }";
    let world = world_of(&scene_of(curve, "pitch_degrees = -10.0, facet_degrees = 2.0,"));
    let fall = TAU * 0.5 * libm::tan(10.0_f64.to_radians());
    for number in 1..16 {
        // To the left, that is towards -z.
        let angle = TAU * f64::from(number) / 16.0;
        let (sin, cos) = libm::sincos(angle);
        let y = -fall * f64::from(number) / 16.0;
        let place = DVec3::new(0.5 * sin, y + 0.03, -0.5 + 0.5 * cos);
        let height = height_below(&world, place).unwrap();
        // Between two stations a helix of facets is off by the sagitta of the path, R (1 - cos 1°).
        assert!((height - y).abs() < 2e-4, "{number} {height} {y}");
    }
}

#[test]
fn a_loop_comes_back_to_its_level_beside_its_beginning() {
    let pieces = "{ straight = { length = 1.0 } }, \
                  { bend = { radius = 0.3, degrees = 360.0, shift = 0.2 } }, \
                  { straight = { length = 1.0 } }";
    let world = world_of(&scene_of(pieces, ""));
    for (x, z) in [(0.5, 0.001), (1.5, -0.199)] {
        let height = height_below(&world, DVec3::new(x, 0.03, z)).unwrap();
        assert!(height.abs() < 1e-14, "{x} {height}");
    }
    // Its top: the lowest line of the gutter is the highest there.
    let top = DVec3::new(1.0, 0.55, -0.1);
    let up = world.cast_ray(top, DVec3::Y, &QueryFilter::default()).unwrap().unwrap();
    assert!((up.fraction - 0.05).abs() < 1e-3, "{}", up.fraction);
}

#[test]
fn a_gap_has_no_floor_and_sets_where_and_how_steep_the_track_goes_on() {
    let pieces = "{ straight = { length = 1.0 } }, \
                  { gap = { length = 0.4, drop = 0.1, pitch_degrees = -45.0 } }, \
                  { straight = { length = 1.0 } }";
    let world = world_of(&scene_of(pieces, ""));
    assert_eq!(height_below(&world, DVec3::new(1.2, 0.03, 0.0)), None);
    let height = height_below(&world, DVec3::new(1.5, 0.03, 0.0)).unwrap();
    assert!((height + 0.2).abs() < 1e-14, "{height}");
}

#[test]
fn a_ball_without_friction_rounds_a_loop_from_above_five_halves_and_not_from_below() {
    // The way of the centre has the radius R - r. An answer of a facet, e = 0, takes sin² 1.5° of the energy: to the
    // top, where it counts, 8 % of some 1.9 of the 2.8.
    let round = 0.3 - 0.02;
    for (start, is_high_enough) in [(2.8_f64, true), (2.3, false)] {
        let pieces = "{ straight = { length = 0.2 } }, \
                      { bend = { radius = 0.3, degrees = 360.0, shift = 0.15 } }, \
                      { straight = { length = 3.0 } }";
        let speed = (2.0 * 9.81 * start * round).sqrt();
        let text = format!(
            "[[forces]]\ngravity = {{ acceleration = [0, -9.81, 0] }}\n\
             [[spheres]]\nposition = [0.05, 0.02, 0.0]\nradius = 0.02\nvelocity = [{speed}, 0, 0]\n{}\
             restitution = 0.0\n",
            scene_of(pieces, "facet_degrees = 1.5, sides = 15,")
        );
        let mut world = world_of(&text);
        let (mut highest, mut account) = (0.0_f64, 0.0);
        for _ in 0..60 {
            let report = world.step(1.0 / 60.0).unwrap();
            account += report.energy_account.contacts;
            highest = world.spheres().positions()[0].y.max(highest);
        }
        let place = world.spheres().positions()[0];
        assert_eq!(highest > 0.57 && place.x > 1.0, is_high_enough, "{start}: {highest} {place}");
        // All that is lost is taken by impacts, to rounding of the sums.
        let lost = world.total_energy() - 0.5 * speed * speed - 9.81 * 0.02;
        assert!((lost - account).abs() < 1e-9, "{start}: {lost} {account}");
    }
}

#[test]
fn a_track_is_written_and_read_again_and_knows_units() {
    let pieces = "{ curve = { radius = \"30 cm\", degrees = \"0.25 turns\", bank_degrees = 20 } }, \
                  { gap = { length = \"5 cm\", drop = \"1 cm\" } }, { straight = { length = 1 } }";
    let scene = Scene::from_toml(&scene_of(pieces, "arc_degrees = 150,"), "one.toml").unwrap();
    let again = Scene::from_toml(&scene.to_toml(), "again.toml").unwrap();
    assert_eq!(again.colliders, scene.colliders);
    let meshes = [scene, again].map(|scene| {
        let world = scene.world().unwrap();
        let Shape::Mesh(mesh) = &world.colliders().next().unwrap().1.shape else { panic!() };
        mesh.clone()
    });
    assert_eq!(meshes[0], meshes[1]);
    // The right rim is 75 degrees beside the lowest line; facets touch the circle from outside.
    let rim = 0.3 + 0.05 * libm::sin(75.0_f64.to_radians());
    assert!((meshes[0].bounds()[1].x - rim).abs() < 2e-4, "{:?}", meshes[0].bounds());
}

#[test]
fn mistakes_in_a_track_are_named_by_piece_and_field() {
    let straight = "{ straight = { length = 1.0 } }";
    for (pieces, more, problem) in [
        ("", "", "pieces"),
        ("{ straight = { length = -1.0 } }", "", "pieces[0].straight: `length` must be positive"),
        ("{ curve = { radius = 0.05, degrees = 90 } }", "", "`radius` must be above 0.05"),
        ("{ curve = { radius = 1, degrees = 0 } }", "", "`degrees` must be finite and not 0"),
        ("{ bend = { radius = 1, degrees = inf } }", "", "bend: `degrees` must be finite"),
        ("{ gap = { length = 1.0 } }", "", "nothing but gaps"),
        ("{ gap = { length = -1.0 } }", "", "gap: `length` must not be negative"),
        (straight, "arc_degrees = 400,", "`arc_degrees` must be above 0 and at most 360, not 400"),
        (straight, "sides = 4,", "`sides` must be an odd number from 3 to 999, not 4"),
        (straight, "facet_degrees = 0,", "`facet_degrees` must be from 0.1 to 45, not 0"),
        (straight, "pitch_degrees = nan,", "`pitch_degrees` must be finite"),
        ("{ curve = { radius = 1, degrees = 1e9 } }", "", "triangles, and 1000000 are allowed"),
        ("{ loop = { radius = 1 } }", "", "loop"),
        (
            "{ bend = { radius = 1, degrees = 90 } }, { curve = { radius = 1, degrees = 90 } }",
            "",
            "pieces[1].curve: begins at a slope of 90 degrees",
        ),
    ] {
        let found = problem_of(pieces, more);
        assert!(found.contains(problem) && found.contains("track.toml:2"), "{problem}: {found}");
    }
}

#[test]
fn the_first_marble_of_the_built_in_run_takes_the_loop_the_jump_and_the_funnel() {
    let text = BUILT_IN_FILES.iter().find(|(file, _)| *file == "marble-run.toml").unwrap().1;
    let mut world = Scene::from_toml(text, "marble-run.toml").unwrap().world().unwrap();
    // Places on the way: the top of the loop, above the gap, in the funnel.
    let mut places =
        vec![([0.6, 1.3], [1.5, 1.8]), ([1.7, 2.2], [0.8, 1.1]), ([1.4, 2.9], [-1.2, -0.6])];
    places.reverse();
    for _ in 0..600 {
        world.step(1.0 / 60.0).unwrap();
        let Some(&place) = world.spheres().positions().first() else { continue };
        let is_in = |[low, high]: [f64; 2], at: f64| (low..high).contains(&at);
        if places.last().is_some_and(|&(x, y)| is_in(x, place.x) && is_in(y, place.y)) {
            places.pop();
        }
    }
    assert!(places.is_empty(), "it missed {places:?}");
}
