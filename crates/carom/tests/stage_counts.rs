//! The work of a step, counted by stage: proves that the counts follow from the world alone, and what
//! the simplest worlds cost; nothing about time.

use carom::{
    Bisect, Collider, Contact, DQuat, DVec3, Discrete, Gravity, Mesh, Pose, Rule, Settings, Shape,
    Sides, Sphere, StageCounts, World,
};

fn row_of_spheres(rule: Rule, count: u32) -> World {
    let mut world = World::new(Settings::default().with_rule(rule)).unwrap();
    for place in 0..count {
        let position = DVec3::new(3.0 * f64::from(place), 0.0, 0.0);
        world.add_sphere(Sphere::new(position, 1.0)).unwrap();
    }
    world
}

#[test]
fn a_lone_sphere_costs_one_prediction_and_no_pair_test() {
    let mut world = row_of_spheres(Rule::default(), 1);
    let counts = world.step(1.0).unwrap().work;
    assert_eq!((counts.predictions, counts.pair_tests, counts.events), (1, 0, 0));
}

#[test]
fn nothing_is_predicted_anew_while_nothing_happens() {
    let mut world = row_of_spheres(Rule::default(), 5);
    assert_eq!(world.step(1.0).unwrap().work.predictions, 5);
    assert_eq!(world.step(1.0).unwrap().work, StageCounts::default());
}

#[test]
fn each_rule_tests_the_pairs_that_its_broad_phase_leaves() {
    let spheres = 5;
    let pairs = spheres * (spheres - 1) / 2;
    // `exact` has one cell for so few spheres, and predicts each of them; `bisect` sorts them, and
    // they are apart; `discrete` tests all pairs of so few.
    for (rule, tests) in [
        (Rule::default(), 2 * pairs),
        (Bisect::default().into(), 0),
        (Discrete::default().into(), pairs),
    ] {
        let mut world = row_of_spheres(rule, spheres);
        assert_eq!(world.step(0.1).unwrap().work.pair_tests, u64::from(tests), "{rule:?}");
    }
}

#[test]
fn a_pyramid_that_comes_to_rest_needs_groups_and_iterations_of_their_solver() {
    let mut world = World::new(Settings::default()).unwrap();
    world.add_force(Gravity::new(DVec3::new(0.0, -9.81, 0.0))).unwrap();
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO));
    world.add_collider(floor.with_restitution(0.0)).unwrap();
    for (x, y) in [(-1.0, 1.0), (1.0, 1.0), (0.0, 2.8)] {
        let sphere = Sphere::new(DVec3::new(x, y, 0.0), 1.0);
        world.add_sphere(sphere.with_restitution(0.0)).unwrap();
    }
    let counts = world.step(0.5).unwrap().work;
    assert!(counts.groups > 0 && counts.solver_iterations > 0, "{counts:?}");
    assert!(counts.events >= counts.groups + counts.cell_crossings, "{counts:?}");
}

#[test]
fn a_ball_without_restitution_comes_to_rest_in_a_corner_of_a_turned_box_by_few_events() {
    let size = DVec3::splat(4.0);
    for case in 0..300 {
        let mut world = World::new(Settings::default()).unwrap();
        // Directions and turns of all kinds: multiples of irrational parts of a circle.
        let angle = |part: f64| f64::from(case) * part;
        let rotation = DQuat::from_scaled_axis(DVec3::new(angle(0.7), angle(1.3), angle(2.9)));
        let walls = Shape::Container { size, open: Sides::default() };
        let walls = Collider::new(walls, Pose { position: DVec3::ZERO, rotation });
        world.add_collider(walls.with_restitution(0.0)).unwrap();
        let velocity = 5.0 * DVec3::from_array([1.1, 2.3, 3.7].map(|it| libm::sin(angle(it))));
        let sphere = Sphere::new(DVec3::ZERO, 0.5).with_velocity(velocity);
        world.add_sphere(sphere.with_restitution(0.0)).unwrap();
        let events: u64 = (0..200).map(|_| world.step(1.0 / 64.0).unwrap().work.events).sum();
        // Three walls, each met once, and again by what rounding leaves of the speed.
        assert!(events <= 6, "{case}: {events} events");
    }
}

#[test]
fn a_copy_of_a_world_does_the_same_work() {
    let mut world = row_of_spheres(Rule::default(), 40);
    let mut sphere = Sphere::new(DVec3::new(-3.0, 0.0, 0.0), 1.0);
    sphere.velocity = DVec3::X;
    world.add_sphere(sphere).unwrap();
    world.step(1.0).unwrap();
    let mut copy = world.clone();
    for _ in 0..5 {
        let counts = world.step(1.0).unwrap().work;
        assert_eq!(copy.step(1.0).unwrap().work, counts);
        assert!(counts.events > 0);
    }
}

#[test]
fn a_fast_ball_over_a_fine_mesh_has_contacts_with_the_facets_around_it_only() {
    let mut world = World::new(Settings::default().with_rule(Contact::default())).unwrap();
    // Each facet is half as long as the ball is wide, and none continues another.
    let height = |column: u32, row: u32| 0.01 * f64::from((column * column + 3 * row) % 5);
    let heights: Vec<Vec<f64>> =
        (0..80).map(|row| (0..80).map(|column| height(column, row)).collect()).collect();
    let ground = Shape::Mesh(Mesh::from_heights([8.0; 2], &heights).unwrap());
    world.add_collider(Collider::new(ground, Pose::at(DVec3::ZERO))).unwrap();
    let ball = Sphere::new(DVec3::new(-2.0, 0.2, 0.0), 0.1);
    world.add_sphere(ball.with_velocity(DVec3::new(6.0, 0.0, 0.5))).unwrap();
    for _ in 0..30 {
        let counts = world.step(1.0 / 60.0).unwrap().work;
        // Faces, edges and corners whose bounds reach into a cube of three radii about the ball.
        assert!(counts.contacts <= 64, "{counts:?}");
    }
}
