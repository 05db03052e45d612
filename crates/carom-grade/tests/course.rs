//! The rule of this crate, without mistakes, equals the engine's rule `discrete` bit for bit. The
//! test has found no error yet; it protects the references of grading.

use carom_grade::{Course, Grader, Mistakes, TOLERANCE};
use carom_scene::{Library, Scene};

/// Compares the rule with the engine, frame by frame, until `seconds`.
fn compare(scene: &Scene, seconds: f64) {
    let h = scene.simulation.frame_time;
    let grader = Grader::new(Course::of(scene).unwrap(), TOLERANCE);
    let tracks = grader.planted(Mistakes::NONE, seconds, false);
    let mut world = scene.world().unwrap();
    assert_eq!(tracks.frames(), (seconds / h).round() as usize);
    for frame in 1..=tracks.frames() {
        world.step(h).unwrap();
        let spheres = world.spheres();
        for (index, id) in spheres.ids().iter().enumerate() {
            let state = tracks.state(id.number() as usize, frame).unwrap();
            let there = (state.position, state.velocity);
            let expected = (spheres.positions()[index], spheres.velocities()[index]);
            assert_eq!(there, expected, "{}, frame {frame}, ball {id:?}", scene.name);
        }
        let moved = |ball: &usize| tracks.state(*ball, frame - 1).is_some();
        let there = (0..tracks.len()).filter(|ball| tracks.state(*ball, frame).is_some());
        assert_eq!(there.filter(moved).count(), spheres.len(), "{}, frame {frame}", scene.name);
    }
}

#[test]
fn simtests_have_the_bits_of_the_engine() {
    for number in 1..=6 {
        let scene = Library::new().find(&format!("simtest{number}"), &[]).unwrap().0;
        // Longer than the time until slots are reused.
        compare(&scene, 20.0);
    }
}

#[test]
fn a_scene_of_ones_own_has_the_bits_of_the_engine() {
    let text = r#"
        name = "own"
        [simulation]
        rule = "discrete"
        frame_time = 0.0125
        spheres_collide = false
        combine_rule = "minimum"
        allow_overlap = true
        [[forces]]
        gravity = { acceleration = [0.3, -9.81, 0.0] }
        [[forces]]
        viscous-drag = { coefficient = 0.05 }
        [[spheres]]
        position = [0.2, 3.0, 0.1]
        velocity = [1.0, 0.0, -0.5]
        radius = 0.3
        density = 2.0
        restitution = 0.9
        [[emitters]]
        position = [-1.0, 4.0, 0.0]
        rotation = [0.1, 0.2, 0.3, 0.9]
        period = 0.33
        max_spheres = 3
        sphere = { radius = 0.2, mass = 2.0, velocity = [1.0, 0.5, 0.0], position = [0.1, 0.0, 0.0] }
        [[emitters]]
        position = [1.0, 5.0, 0.0]
        period = 0.2
        count = 4
        sphere = { radius = 0.15, velocity = [-1.0, 0.0, 0.1] }
        [[colliders]]
        shape = { box = { size = [4.0, 0.5, 3.0] } }
        rotation = [0.05, 0.1, 0.02, 1.0]
        restitution = 0.8
        [[colliders]]
        shape = { sphere = { radius = 0.6 } }
        position = [0.5, 0.8, 0.0]
        restitution = 0.95
        [[colliders]]
        shape = { sphere = { radius = 1.0 } }
        position = [0.0, 2.0, 0.0]
        trigger = true
    "#;
    compare(&Scene::from_toml(text, "own.toml").unwrap(), 5.0);
}

#[test]
fn what_the_course_does_not_know_is_refused_by_name() {
    let refusal = |name: &str, set: &[&str]| {
        let overrides: Vec<_> = set.iter().map(|it| it.parse().unwrap()).collect();
        let scene = Library::new().find(name, &overrides).unwrap().0;
        Course::of(&scene).unwrap_err().to_string()
    };
    assert!(refusal("simtest1", &["simulation.rule=exact"]).contains("another rule"));
    let explicit = refusal("simtest1", &["simulation.discrete.integrator=explicit-euler"]);
    assert!(explicit.contains("integrator"), "{explicit}");
    assert!(refusal("simtest1", &["simulation.spheres_collide=true"]).contains("collide"));
    let turning = refusal("simtest1", &["colliders.0.angular_velocity=[0,1,0]"]);
    assert!(turning.contains("move"), "{turning}");
}
