//! Built-in scenes: each can be found, matches its description, and runs under every rule.

use std::collections::BTreeSet;
use std::path::Path;

use carom::{DVec3, World};
use carom_scene::scene::Rule;
use carom_scene::{BUILT_IN_FILES, Library, Scene, json_schema};

fn scene(name: &str) -> Scene {
    Library::new().find(name, &[]).unwrap().0
}

/// Runs a scene and calls `watch` with the world after each frame.
fn run(scene: &Scene, seconds: f64, mut watch: impl FnMut(&World)) -> World {
    let mut world = scene.world().unwrap();
    for _ in 0..(seconds / scene.simulation.frame_time).round() as usize {
        world.step(scene.simulation.frame_time).unwrap();
        watch(&world);
    }
    world
}

fn folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn every_file_in_the_folder_is_built_in() {
    let files = std::fs::read_dir(folder().join("scenes")).unwrap();
    let files: BTreeSet<String> = files
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".toml"))
        .collect();
    let built_in: BTreeSet<String> = BUILT_IN_FILES.iter().map(|f| f.0.to_owned()).collect();
    assert_eq!(files, built_in);
}

#[test]
fn every_scene_is_found_by_name_and_title_in_any_case() {
    let library = Library::new();
    let entries = library.entries().unwrap();
    let names: BTreeSet<&str> = entries.iter().map(|entry| entry.name.as_str()).collect();
    assert_eq!(names.len(), entries.len());
    for entry in &entries {
        let scene = entry.scene.as_ref().unwrap();
        assert_eq!(scene.name, entry.name);
        assert!(!scene.title.is_empty() && !scene.description.is_empty());
        for name in [&scene.name, &scene.title, &scene.title.to_uppercase()] {
            assert_eq!(&library.find(name, &[]).unwrap().0, scene);
        }
    }
}

mod every_scene_runs_under_every_rule {
    use super::{BUILT_IN_FILES, Scene};

    /// Most impacts of a run. Under `bisect` the balls of a heap sink into each other, and deeper
    /// overlaps cause more impacts, up to a million in a second. The first 10,000 exercise all
    /// code.
    const IMPACTS: usize = 10_000;

    /// Largest counted work of a frame for each sphere, per impact of the frame and one more: no scene may hang.
    /// Each sweep of `contact` counts every surface near a sphere, and a marble of `marble-run` has some 300
    /// facets of its track around it.
    const WORK: u64 = 50_000;

    /// Largest counted work of a frame for each sphere, impacts included, by rule. `discrete` tests each pair of near
    /// balls once; `bisect` does so after each contact of an island, until two bodies meet too often.
    const WORK_OF_STEPS: [(&str, u64); 2] = [("discrete", 200), ("bisect", 10_000)];

    /// Scenes whose balls touch in one island, which `bisect` integrates again after each contact: a frame takes up to a
    /// second, and twenty seconds take an hour or more.
    const HEAPS_UNDER_BISECT: [&str; 6] = [
        "avalanche.toml",
        "chain-reaction.toml",
        "drum.toml",
        "granular-column.toml",
        "hourglass.toml",
        "pour.toml",
    ];

    /// Runs every scene for a second, or for [`IMPACTS`] impacts.
    fn holds(rule: &str) {
        runs(rule, 1.0, |_| IMPACTS);
    }

    /// Runs every scene for twenty seconds; the heaps under `bisect` for ten times [`IMPACTS`] impacts.
    fn holds_for_twenty_seconds(rule: &str) {
        let is_heap = |file: &str| rule == "bisect" && HEAPS_UNDER_BISECT.contains(&file);
        runs(rule, 20.0, |file| if is_heap(file) { 10 * IMPACTS } else { usize::MAX });
    }

    /// Runs every scene for some time \[s\], or for a number of impacts by its file. A scene with springs that are too
    /// stiff for the rule is refused.
    fn runs(rule: &str, seconds: f64, most_impacts: impl Fn(&str) -> usize) {
        for (file, text) in BUILT_IN_FILES {
            let override_rule = format!("simulation.rule={rule}").parse().unwrap();
            let read = Scene::from_toml_with(text, file, &[override_rule]);
            if let Err(refused) = &read {
                assert!(refused.to_string().contains("springs: `stiffness` must be"), "{refused}");
                assert_eq!((*file, rule == "contact"), ("cradle-on-threads.toml", false));
                continue;
            }
            let scene = read.unwrap();
            let mut world = scene.world().unwrap();
            let (mut impacts, mut busiest, mut of_steps) = (0, 0, 0);
            while world.time() < seconds && impacts < most_impacts(file) {
                let report = world.step(scene.simulation.frame_time).unwrap();
                let (work, of_frame) = (report.work, report.impacts.len());
                let events = work.predictions + work.events + work.groups;
                let tests = work.pair_tests + work.solver_iterations + work.sweeps * work.contacts;
                let shares = (world.spheres().len() + 1) as u64 * (of_frame + 1) as u64;
                busiest = busiest.max((events + tests) / shares);
                let all = events + tests + of_frame as u64;
                of_steps = of_steps.max(all / (world.spheres().len() + 1) as u64);
                impacts += of_frame;
            }
            println!("{file}, {rule}: {busiest}, {of_steps}");
            assert!(busiest < WORK, "{file}, {rule}: {busiest}");
            let most = WORK_OF_STEPS.iter().find(|it| it.0 == rule);
            assert!(most.is_none_or(|it| of_steps < it.1), "{file}, {rule}: {of_steps}");
            assert!(!world.spheres().is_empty());
        }
    }

    #[test]
    fn discrete() {
        holds("discrete");
    }

    #[test]
    fn bisect() {
        holds("bisect");
    }

    #[test]
    fn contact() {
        holds("contact");
    }

    mod for_twenty_seconds {
        use super::holds_for_twenty_seconds;

        #[test]
        #[ignore = "takes minutes"]
        fn exact() {
            holds_for_twenty_seconds("exact");
        }

        #[test]
        #[ignore = "takes minutes"]
        fn contact() {
            holds_for_twenty_seconds("contact");
        }

        #[test]
        #[ignore = "takes half a minute"]
        fn discrete() {
            holds_for_twenty_seconds("discrete");
        }

        #[test]
        #[ignore = "takes minutes"]
        fn bisect() {
            holds_for_twenty_seconds("bisect");
        }
    }
}

#[test]
fn scenes_repeat_bit_for_bit() {
    for (file, text) in BUILT_IN_FILES {
        let scene = Scene::from_toml(text, file).unwrap();
        // By then every heap has thousands of contacts.
        let hashes = [(); 2].map(|()| run(&scene, 1.0, |_| {}).state_hash());
        assert_eq!(hashes[0], hashes[1], "{file}");
    }
}

mod state_hashes_of_all_scenes_are_the_same_everywhere {
    use super::{BUILT_IN_FILES, Rule, Scene, run};

    /// The slowest scenes, in parts of about equal work that run in parallel.
    const HEAPS: [&[&str]; 2] =
        [&["hourglass.toml"], &["avalanche.toml", "granular-column.toml", "pour.toml"]];

    fn holds(is_of_part: impl Fn(&str) -> bool) {
        let hashes: Vec<String> = BUILT_IN_FILES
            .iter()
            .filter(|(file, _)| is_of_part(file))
            .flat_map(|(file, text)| {
                let own = Scene::from_toml(text, file).unwrap();
                let hash = |scene| run(scene, 10.0, |_| {}).state_hash();
                let mut hashes = vec![format!("{file} {}", hash(&own))];
                // The rule `exact` is not meant for heaps.
                if !matches!(own.simulation.rule, Rule::Contact | Rule::Exact) {
                    let mut exact = own.clone();
                    exact.simulation.rule = Rule::Exact;
                    hashes.push(format!("{file} exact {}", hash(&exact)));
                }
                hashes
            })
            .collect();
        // Pinned. Hashes may change only with the physics or the scenes; the changelog then says
        // so.
        let expected = include_str!("state_hashes.txt").lines();
        let expected: Vec<&str> =
            expected.filter(|line| is_of_part(line.split(' ').next().unwrap())).collect();
        assert_eq!(hashes.join("\n"), expected.join("\n"));
    }

    #[test]
    fn an_hourglass() {
        holds(|file| HEAPS[0].contains(&file));
    }

    #[test]
    fn heaps() {
        holds(|file| HEAPS[1].contains(&file));
    }

    #[test]
    fn all_others() {
        holds(|file| !HEAPS.concat().contains(&file));
    }
}

#[test]
fn nothing_touches_in_tutorial_1_and_the_dense_are_bent_the_least() {
    let mut impacts = 0;
    let world = run(&scene("tutorial1"), 3.0, |world| impacts += world.report().impacts.len());
    assert_eq!(impacts, 0);
    let drift: Vec<f64> = world.spheres().positions()[..3].iter().map(|x| x.x).collect();
    assert!(drift[0] > drift[1] && drift[1] > drift[2], "{drift:?}");
}

#[test]
fn every_pair_of_tutorial_2_collides_once_and_keeps_momentum_and_energy() {
    let mut impacts = 0;
    let scene = scene("tutorial2");
    let start = scene.world().unwrap();
    let end = run(&scene, 6.0, |world| impacts += world.report().impacts.len());
    assert_eq!(impacts, scene.spheres.len() / 2);
    let (energy, momentum) = (start.kinetic_energy(), start.momentum());
    assert!((end.kinetic_energy() - energy).abs() <= 1e-13 * energy);
    assert!((end.momentum() - momentum).length() <= 1e-13 * momentum.length());
    let densities: BTreeSet<u64> =
        scene.spheres.iter().map(|sphere| sphere.density.unwrap() as u64).collect();
    assert_eq!(densities, BTreeSet::from([1000, 2000, 3000]));
}

#[test]
fn in_tutorial_3_as_many_balls_leave_the_cradle_as_come_in() {
    let scene = scene("tutorial3");
    let world = run(&scene, 5.0, |_| {});
    for (z, balls_in) in [(-6.0, 1), (-3.0, 2), (0.0, 3)] {
        let spheres = world.spheres();
        let mut row: Vec<(f64, f64)> = spheres
            .positions()
            .iter()
            .zip(spheres.velocities())
            .filter(|(x, _)| x.z == z)
            .map(|(x, v)| (x.x, v.x))
            .collect();
        row.sort_by(|a, b| a.0.total_cmp(&b.0));
        assert_eq!(row.len(), 5);
        for (i, (_, speed)) in row.iter().enumerate() {
            let expected = if i >= 5 - balls_in { 2.0 } else { 0.0 };
            assert!((speed - expected).abs() < 1e-12, "{balls_in} in: {row:?}");
        }
    }
}

#[test]
fn in_tutorial_4_a_hundred_spheres_scatter_from_the_fixed_one() {
    let scene = scene("tutorial4");
    let mut hits = BTreeSet::new();
    let world = run(&scene, 5.0, |world| {
        for impact in &world.report().impacts {
            if let carom::BodyPair::Collider { sphere, .. } = impact.between {
                hits.insert(sphere);
            }
        }
    });
    assert!(world.spheres().len() >= 100);
    assert!(hits.len() >= 100, "{}", hits.len());
    // All spheres have left it, on every side.
    let positions = world.spheres().positions();
    assert!(positions.iter().all(|x| x.length() > 3.0));
    for direction in [DVec3::X, DVec3::NEG_X, DVec3::Z, DVec3::NEG_Z] {
        assert!(positions.iter().any(|x| x.dot(direction) > 3.0));
    }
}

#[test]
fn the_committed_schema_is_current() {
    let path = folder().join("scenes/scene.schema.json");
    if std::env::var_os("CAROM_WRITE_SCHEMA").is_some() {
        std::fs::write(&path, json_schema()).unwrap();
    }
    let committed = std::fs::read_to_string(path).unwrap_or_default();
    assert!(committed == json_schema(), "run `cargo xtask schema` and commit the result");
}
