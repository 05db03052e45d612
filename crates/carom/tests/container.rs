//! Containers: what is in one stays in it, at its walls, edges and corners, under every rule; what
//! comes over the rim falls outside, and what is outside does not come in.

use carom::{
    Bisect, Collider, Contact, DQuat, DVec3, Discrete, Exact, Friction, Gravity, Pose, Rule,
    Settings, Shape, Sides, Sphere, World,
};

const TOP: Sides = Sides { top: true, ..Sides::NONE };

fn vec(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

fn world(rule: impl Into<Rule>) -> World {
    World::new(Settings::default().with_rule(rule)).unwrap()
}

/// A container about the origin.
fn container(size: DVec3, open: Sides) -> Collider {
    Collider::new(Shape::Container { size, open }, Pose::at(DVec3::ZERO))
}

fn with_gravity(mut world: World) -> World {
    world.add_force(Gravity { acceleration: vec(0.0, -9.81, 0.0) }).unwrap();
    world
}

fn run(world: &mut World, seconds: f64, mut watch: impl FnMut(&World)) {
    while world.time() < seconds {
        world.step(1.0 / 60.0).unwrap();
        watch(world);
    }
}

#[test]
fn elastic_balls_stay_in_a_closed_container_under_every_rule() {
    // The rules of the courses miss what passes a wall within a frame.
    let rules: [(Rule, f64); 4] = [
        (Exact::default().into(), 10.0),
        (Contact::default().into(), 10.0),
        (Bisect::default().into(), 0.3),
        (Discrete::default().into(), 0.3),
    ];
    for (rule, speed) in rules {
        let mut world = world(rule);
        let turned = DQuat::from_xyzw(0.1, 0.2, 0.3, 0.9).normalize();
        let pose = Pose::at(vec(3.0, -2.0, 1.0)).rotated(turned);
        let size = vec(2.0, 3.0, 4.0);
        world.add_collider(container(size, Sides::NONE).with_pose(pose)).unwrap();
        for i in 0..27_i32 {
            let place = vec(f64::from(i % 3 - 1), f64::from(i / 3 % 3 - 1), f64::from(i / 9 - 1));
            let way = vec(f64::from(i % 5) - 2.0, f64::from(i % 7) - 3.0, f64::from(i % 11) - 5.0);
            let center = pose.position + turned * (0.5 * place);
            world.add_sphere(Sphere::new(center, 0.1).with_velocity(speed * way)).unwrap();
        }
        let energy = world.kinetic_energy();
        run(&mut world, 10.0, |world| {
            for center in world.spheres().positions() {
                let local = (turned.inverse() * (*center - pose.position)).abs();
                // The rule `discrete` lets spheres into walls for a frame.
                assert!((0.5 * size - local).min_element() > -1e-9, "{rule:?}: {local}");
            }
        });
        assert!(world.kinetic_energy() < 1.000_001 * energy, "{rule:?}");
    }
}

/// A heap presses balls into edges and corners.
#[test]
fn a_heap_fills_an_open_container_and_rests() {
    let mut world = with_gravity(world(Contact::default()));
    let floor = Friction::sliding(0.4).with_rolling(0.05);
    let size = vec(1.0, 1.0, 1.0);
    world.add_collider(container(size, TOP).with_restitution(0.3).with_friction(floor)).unwrap();
    for i in 0..200_i32 {
        let cell = vec(f64::from(i % 5), f64::from(i / 25), f64::from(i / 5 % 5));
        let place = vec(-0.4, -0.4, -0.4) + 0.2 * cell + 1e-3 * f64::from(i % 3);
        let sphere = Sphere::new(place, 0.08).with_restitution(0.3).with_friction(0.4);
        world.add_sphere(sphere).unwrap();
    }
    run(&mut world, 6.0, |_| {});
    assert!(world.spheres().positions().iter().all(|x| x.abs().max_element() < 0.5));
    let fastest = world.spheres().velocities().iter().map(|v| v.length()).fold(0.0, f64::max);
    assert!(fastest < 1e-3, "{fastest}");
    assert!(world.overlaps(0.02 * 0.08).is_empty());
}

#[test]
fn a_ball_over_the_rim_falls_outside_and_does_not_come_back() {
    for rule in [Rule::from(Contact::default()), Exact::default().into()] {
        let mut world = with_gravity(world(rule));
        let floor = Pose::at(vec(0.0, -0.5, 0.0));
        let ground = Collider::new(Shape::HalfSpace, floor).with_restitution(0.3);
        world.add_collider(ground).unwrap();
        world.add_collider(container(DVec3::ONE, TOP).with_restitution(0.3)).unwrap();
        // Flies over the rim; comes down on it, its centre outside; rolls against the wall from
        // outside; falls along it.
        for (place, velocity) in [
            (vec(0.0, 1.0, 0.0), vec(3.0, 0.0, 0.0)),
            (vec(0.2, 0.8, 0.51), vec(0.0, 0.0, 0.0)),
            (vec(-2.0, -0.4, 0.0), vec(3.0, 0.0, 0.0)),
            (vec(-0.61, 2.0, -0.3), vec(0.0, 0.0, 0.0)),
        ] {
            world.add_sphere(Sphere::new(place, 0.1).with_velocity(velocity)).unwrap();
        }
        run(&mut world, 3.0, |_| {});
        for center in world.spheres().positions() {
            let beside = center.x.abs().max(center.z.abs());
            assert!(beside > 0.6 - 1e-3 && center.y < 0.0, "{rule:?}: {center}");
        }
    }
}

/// Seams of walls stop nothing: a ball that slides in an edge does not slow down.
#[test]
fn a_ball_slides_along_an_edge_without_friction() {
    for rule in [Rule::from(Contact::default()), Exact::default().into()] {
        let mut world = with_gravity(world(rule));
        let long = vec(10.0, 1.0, 1.0);
        world.add_collider(container(long, TOP).with_restitution(0.0)).unwrap();
        let sphere = Sphere::new(vec(-4.5, -0.4, 0.4), 0.1).with_velocity(vec(3.0, 0.0, 0.0));
        let id = world.add_sphere(sphere).unwrap();
        run(&mut world, 2.9, |_| {});
        let sphere = world.sphere(id).unwrap();
        assert!((sphere.velocity - vec(3.0, 0.0, 0.0)).length() < 1e-12, "{:?}", sphere.velocity);
        assert!((sphere.position.y + 0.4).abs() < 1e-9, "{}", sphere.position);
    }
}

#[test]
fn open_sides_let_balls_through_and_no_others() {
    let directions = [DVec3::NEG_X, DVec3::X, DVec3::NEG_Y, DVec3::Y, DVec3::NEG_Z, DVec3::Z];
    for open in 0..6 {
        let sides = Sides::from_array(std::array::from_fn(|side| side == open));
        for (side, direction) in directions.into_iter().enumerate() {
            let mut world = world(Exact::default());
            world.add_collider(container(DVec3::ONE, sides)).unwrap();
            let id = world.add_sphere(Sphere::new(DVec3::ZERO, 0.1)).unwrap();
            world.set_sphere(id, world.sphere(id).unwrap().with_velocity(direction)).unwrap();
            run(&mut world, 1.0, |_| {});
            let velocity = world.sphere(id).unwrap().velocity;
            let expected = if side == open { direction } else { -direction };
            assert_eq!(velocity, expected, "side {side} with {open} open");
        }
    }
}

#[test]
fn as_a_trigger_a_container_reports_what_is_in_it() {
    let mut world = world(Exact::default());
    let id = world.add_collider(container(DVec3::ONE, TOP).as_trigger()).unwrap();
    world.add_sphere(Sphere::new(DVec3::ZERO, 0.1)).unwrap();
    world.add_sphere(Sphere::new(vec(3.0, 0.0, 0.0), 0.1)).unwrap();
    let triggers = &world.step(0.1).unwrap().triggers;
    assert!(triggers.iter().all(|it| it.collider == id));
    assert_eq!(triggers.len(), 1);
}

#[test]
fn a_container_carried_along_takes_its_balls_with_it() {
    let mut world = with_gravity(world(Contact::default()));
    let moving = container(DVec3::ONE, TOP).with_restitution(0.0).with_friction(0.5);
    world.add_collider(moving.moving(vec(0.5, 0.0, 0.0), DVec3::ZERO)).unwrap();
    let id = world.add_sphere(Sphere::new(vec(0.0, -0.4, 0.0), 0.1)).unwrap();
    run(&mut world, 4.0, |_| {});
    assert!((world.sphere(id).unwrap().position.x - 2.0).abs() < 0.5);
}
