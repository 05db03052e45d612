//! A camera is fitted to where the balls of a scene are during its first seconds.

use carom::DVec3;
use carom_render::{Bounds, Drawing, Framing};
use carom_scene::{Library, Scene};

fn scene(text: &str) -> Scene {
    Scene::from_toml(&format!("name = \"test\"\n{text}"), "test.toml").expect("a scene")
}

fn framing(text: &str) -> Framing {
    Framing::of_scene(&scene(text)).expect("something to see")
}

const GRAVITY: &str = "forces = [{ gravity = { acceleration = [0.0, -9.81, 0.0] } }]\n";

#[test]
fn the_floor_under_a_ball_is_in_the_picture() {
    let ball = "spheres = [{ position = [0.0, 2.0, 0.0], radius = 0.5 }]\n";
    let floor = "colliders = [{ shape = \"half-space\" }]";
    let Framing { whole, balls } = framing(&format!("{GRAVITY}{ball}{floor}"));
    let tiny = 1e-9;
    assert!(whole.min.y.abs() < tiny && (whole.max.y - 2.5).abs() < tiny, "{whole:?}");
    // It touches the floor between two frames.
    assert!((0.0..0.1).contains(&balls.min.y), "{balls:?}");
    // A floor that is very far away would make the ball a dot.
    let far = "spheres = [{ position = [0.0, 2000.0, 0.0], radius = 0.5 }]\n";
    let whole = framing(&format!("{GRAVITY}{far}{floor}")).whole;
    assert!(whole.min.y > 1900.0, "{whole:?}");
}

#[test]
fn a_ball_that_flies_away_does_not_make_dots_of_the_others() {
    let others = "spheres = \
        [{ position = [0.0, 0.0, 0.0], radius = 0.5 }, { position = [3.0, 0.0, 0.0], radius = 0.5 }";
    let alone = framing(&format!("{others}]")).whole;
    let fast = ", { position = [1.5, 3.0, 0.0], velocity = [500.0, 0.0, 0.0], radius = 0.5 }]";
    let with = framing(&format!("{others}{fast}"));
    assert!(with.whole.radius() < 4.0 * alone.radius(), "{with:?}");
    assert!(with.whole.holds(&alone), "{with:?}");
    // A ball that stays near is in the picture all the time.
    let slow = ", { position = [1.5, 3.0, 0.0], velocity = [1.0, 0.0, 0.0], radius = 0.5 }]";
    let with = framing(&format!("{others}{slow}"));
    assert!((with.whole.max.x - 5.0).abs() < 0.05, "{with:?}");
}

#[test]
fn a_ball_that_falls_alone_is_in_the_picture_all_the_time() {
    let ball = "spheres = [{ position = [0.0, 20.0, 0.0], radius = 0.1 }]\n";
    let second = "simulation = { duration = 1.0 }\n";
    let whole = framing(&format!("{second}{GRAVITY}{ball}")).whole;
    // It falls g/2 in a second.
    assert!((whole.min.y - (20.0 - 4.905 - 0.1)).abs() < 1e-9, "{whole:?}");
    // Three seconds of a longer scene, or less if the ball would become a dot.
    let whole = framing(&format!("{GRAVITY}{ball}")).whole;
    assert!((-10.0..-4.0).contains(&whole.min.y), "{whole:?}");
}

#[test]
fn a_heap_that_grows_out_of_the_first_picture_is_in_the_later_one() {
    let first = framing("spheres = [{ position = [0.0, 0.0, 0.0], radius = 0.5 }]");
    let mut drawing = Drawing::default();
    for x in [-3.0, -1.0, 0.0, 1.0, 3.0] {
        let place = carom::Pose::at(DVec3::X * x);
        drawing.add_collider(carom::Shape::Sphere { radius: 0.5 }, place, [1.0; 3], false);
    }
    let now = Framing::of_run(Some(first), &drawing);
    assert!(now.whole.holds(&first.whole) && now.whole.max.x > 3.4, "{now:?}");
}

#[test]
fn what_emitters_throw_is_in_the_picture_before_it_is_there() {
    let emitter = "[[emitters]]\nposition = [0.0, 5.0, 0.0]\nperiod = 0.5\n\
                   sphere = { radius = 0.5, velocity = [0.0, -2.0, 0.0] }\n";
    let whole = framing(emitter).whole;
    assert!(whole.max.y >= 5.5 && whole.min.y < 2.0, "{whole:?}");
}

#[test]
fn every_built_in_scene_has_all_of_its_balls_in_its_framing() {
    for entry in Library::new().entries().expect("the built-in scenes") {
        let scene = entry.scene.expect("a built-in scene");
        let framing = Framing::of_scene(&scene).expect("something to see");
        let world = scene.world().expect("a world");
        let spheres = world.spheres();
        for (center, radius) in spheres.positions().iter().zip(spheres.radii()) {
            let ball = Bounds::from_sphere(*center, *radius);
            assert!(framing.whole.holds(&ball), "{}: {ball:?} in {framing:?}", scene.name);
        }
        assert!(framing.whole.radius() < 1e3, "{}: {framing:?}", scene.name);
    }
}

#[test]
fn all_that_a_double_pendulum_sweeps_is_in_the_picture_with_the_point_that_it_hangs_on() {
    let balls = "spheres = [{ position = [1.0, 0.0, 0.0], radius = 0.05 }, \
        { position = [3.0, 0.0, 0.0], radius = 0.05 }]\n";
    let rods = "springs = [{ sphere = 0, anchor = [0.0, 0.0, 0.0], stiffness = 1e5 }, \
        { spheres = [0, 1], stiffness = 1e5 }]\n";
    let Framing { whole, balls } = framing(&format!("{GRAVITY}{balls}{rods}"));
    assert!(whole.holds(&Bounds::at(DVec3::ZERO)) && whole.holds(&balls), "{whole:?}");
    // Each of them swings to the other side, and the outer one passes below.
    assert!(balls.min.x < -2.0 && balls.min.y < -2.5 && balls.max.x > 3.0, "{balls:?}");
    assert!(whole.radius() < 5.0, "{whole:?}");
}

#[test]
fn a_scene_without_anything_has_no_framing() {
    assert_eq!(Framing::of_scene(&scene("")), None);
    assert_eq!(Framing::of_drawing(&Drawing::default()), None);
    assert_eq!(Framing::of_run(None, &Drawing::default()), Framing::UNIT);
}

#[test]
fn what_has_left_the_first_framing_is_framed_where_it_is() {
    let first = framing("spheres = [{ position = [0.0, 0.0, 0.0], radius = 0.5 }]");
    let mut drawing = Drawing::default();
    let sphere = carom::Shape::Sphere { radius: 0.5 };
    let place = carom::Pose::at(DVec3::X * 100.0);
    drawing.add_collider(sphere, place, [1.0; 3], false);
    let now = Framing::of_run(Some(first), &drawing);
    assert!(now.whole.holds(&Bounds::at(DVec3::X * 100.0)), "{now:?}");
}

#[test]
fn one_of_two_balls_that_runs_away_leaves_the_other_in_the_picture() {
    let balls = "spheres = [{ position = [0.0, 0.5, 0.0], radius = 0.1 }, \
        { position = [-1.0, 0.5, 0.0], velocity = [30.0, 0.1, 0.0], radius = 0.1 }]";
    let first = framing(balls);
    let mut drawing = Drawing::default();
    for x in [0.0, 59.0] {
        let sphere = carom::Shape::Sphere { radius: 0.1 };
        let place = carom::Pose::at(DVec3::new(x, 0.5, 0.0));
        drawing.add_collider(sphere, place, [1.0; 3], false);
    }
    assert_eq!(Framing::of_run(Some(first), &drawing).whole, first.whole);
}

#[test]
fn a_fountain_is_in_the_picture_up_to_its_top() {
    let emitter = "[[emitters]]\nposition = [0.0, 0.2, 0.0]\nperiod = 0.05\n\
                   rotation = { axis = [0, 0, 1], degrees = 10 }\n\
                   sphere = { radius = 0.05, velocity = [0.0, 8.0, 0.0] }\n";
    let floor = "[[colliders]]\nshape = \"half-space\"\nrestitution = 0.5\n";
    let whole = framing(&format!("{GRAVITY}{emitter}{floor}")).whole;
    // (v cos 10°)² / 2g above the emitter.
    let top = 0.2 + (8.0 * 10f64.to_radians().cos()).powi(2) / (2.0 * 9.81);
    assert!(whole.max.y > 0.95 * top && whole.radius() < 6.0, "{whole:?}");
}

#[test]
fn a_ball_that_leaves_a_track_alone_does_not_make_it_small() {
    let track = "colliders = [{ shape = { box = { size = [1.0, 0.1, 0.2] } } }]\n";
    let ball = "spheres = [{ position = [0.4, 0.2, 0.0], velocity = [1, 0, 0], radius = 0.03 }]\n";
    let whole = framing(&format!("{GRAVITY}{track}{ball}")).whole;
    assert!(whole.min.y > -1.5 && whole.min.y < -0.5, "{whole:?}");
}

#[test]
fn colliders_that_move_are_in_the_picture_all_the_time() {
    let lift = "[[colliders]]\nshape = { box = { size = [2.0, 0.2, 2.0] } }\n\
                motion = { oscillate = { amplitude = 0.5, frequency = 0.4 } }\n";
    let ball = "[[spheres]]\nposition = [0.0, 0.3, 0.0]\nradius = 0.1\n";
    let whole = framing(&format!("{GRAVITY}{ball}{lift}")).whole;
    assert!((whole.min.y + 0.6).abs() < 1e-3, "{whole:?}");
}
