//! Persistent contacts of the rule `exact` under forces that are not linear: against closed forms and the account of
//! energy.

// What is expected need not have the same bits everywhere.
#![allow(clippy::disallowed_methods)]

mod common;

use carom::{
    Boundary, Collider, DQuat, DVec3, Ends, EnergyAccount, Gravity, Pose, QuadraticDrag, Settings,
    Shape, Sphere, SphereId, Spring, World,
};
use common::{G, account_of_run, assert_close, exact, vec};

const FRAME: f64 = 1.0 / 64.0;

/// A world with gravity along -y.
fn falling() -> World {
    let mut world = exact();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    world
}

/// A ball of 1 kg that does not bounce.
fn soft(place: DVec3, radius: f64) -> Sphere {
    Sphere::new(place, radius).with_mass(1.0).with_restitution(0.0)
}

fn add(world: &mut World, shape: Shape, pose: Pose) {
    world.add_collider(Collider::new(shape, pose)).unwrap();
}

/// A cube of eight balls, each on springs to all others, at a height \[m\].
fn soft_cube(world: &mut World, height: f64) {
    let places = (0..8).map(|corner| {
        let part = |bit: u32| 0.3 * f64::from((corner >> bit) & 1);
        vec(0.07 + part(0), height + part(1), part(2))
    });
    let places: Vec<DVec3> = places.collect();
    let ids: Vec<SphereId> =
        places.iter().map(|&place| world.add_sphere(soft(place, 0.1)).unwrap()).collect();
    for first in 0..8 {
        for second in first + 1..8 {
            let length = places[first].distance(places[second]);
            let spring = Spring::between(ids[first], ids[second], length).with_stiffness(2000.0);
            world.add_spring(spring).unwrap();
        }
    }
}

/// What the account of a run leaves open, as a part of its largest energy, and the account \[J\].
fn left_open(world: &mut World, seconds: f64) -> (f64, EnergyAccount) {
    let start = world.total_energy();
    let (account, left) = account_of_run(world, (seconds / FRAME) as usize, FRAME);
    (left / start, account)
}

#[test]
fn a_soft_cube_that_falls_on_stairs_loses_what_its_impacts_take() {
    let mut world = falling();
    for step in 0..4 {
        let place = vec(0.4 * f64::from(step), -0.3 * f64::from(step), 0.0);
        add(&mut world, Shape::Box { size: vec(0.4, 0.3, 3.0) }, Pose::at(place));
    }
    add(&mut world, Shape::HalfSpace, Pose::at(vec(0.0, -2.0, 0.0)));
    soft_cube(&mut world, 1.0);
    let (left, account) = left_open(&mut world, 2.5);
    assert!(account.contacts < -1.0, "{account:?}");
    // Rounding of some thousand steps.
    assert!(left.abs() < 1e-11, "{left:e}");
}

#[test]
fn a_soft_cube_on_round_things_loses_what_its_impacts_take() {
    let turn = DQuat::from_rotation_x(std::f64::consts::FRAC_PI_2);
    let lying = |position: DVec3| Pose { position, rotation: turn };
    let round: [(Shape, Pose); 5] = [
        (Shape::Sphere { radius: 0.5 }, Pose::at(vec(0.1, 0.0, 0.1))),
        (Shape::Cylinder { radius: 0.4, height: 2.0 }, lying(vec(0.1, 0.0, 0.1))),
        (Shape::Torus { ring_radius: 0.5, tube_radius: 0.2 }, Pose::at(vec(0.1, 0.0, 0.1))),
        (Shape::Pipe { radius: 1.0, length: 3.0, closed: Ends::NONE }, lying(vec(0.1, 0.6, 0.1))),
        (Shape::Disc { radius: 0.45 }, Pose::at(vec(0.1, 0.2, 0.1))),
    ];
    for (shape, pose) in round {
        let mut world = falling();
        let name = format!("{shape:?}");
        add(&mut world, shape, pose);
        soft_cube(&mut world, 1.0);
        let (left, account) = left_open(&mut world, 1.5);
        assert!(account.contacts < -1.0, "{name}: {account:?}");
        // Rounding of some thousand steps.
        assert!(left.abs() < 1e-11, "{name}: {left:e}");
    }
}

/// Speed of a ball of 1 kg, 0.1 m in radius, after 1 s in a medium of 5 kg/m³, from 3 m/s: `v0/(1 + v0 t k)`.
fn slowed() -> f64 {
    let k = 0.5 * 5.0 * 0.44 * std::f64::consts::PI * 0.01;
    3.0 / (1.0 + 3.0 * k)
}

#[test]
fn a_ball_slides_over_any_floor_as_quadratic_drag_slows_it() {
    let floors: [(Shape, Pose); 3] = [
        (Shape::HalfSpace, Pose::at(DVec3::ZERO)),
        (Shape::Box { size: vec(9.0, 1.0, 9.0) }, Pose::at(vec(0.0, -0.5, 0.0))),
        (Shape::Disc { radius: 5.0 }, Pose::at(DVec3::ZERO)),
    ];
    for (shape, pose) in floors {
        let mut world = falling();
        world.add_force(QuadraticDrag::new(5.0)).unwrap();
        let name = format!("{shape:?}");
        add(&mut world, shape, pose);
        let direction = vec(0.6, 0.0, 0.8);
        let ball = soft(vec(0.0, 0.1, 0.0), 0.1).with_velocity(3.0 * direction);
        let ball = world.add_sphere(ball).unwrap();
        for _ in 0..64 {
            world.step(FRAME).unwrap();
        }
        let Sphere { position, velocity, .. } = world.sphere(ball).unwrap();
        assert_close(velocity.dot(direction), slowed(), 1e-14);
        assert!((position.y - 0.1).abs() < 1e-15, "{name}: {}", position.y);
    }
}

#[test]
fn a_ball_at_rest_under_drag_stays_there_to_the_bit() {
    let mut world = falling();
    world.add_force(QuadraticDrag::new(1.2)).unwrap();
    add(&mut world, Shape::HalfSpace, Pose::at(DVec3::ZERO));
    let ball = world.add_sphere(soft(vec(0.0, 0.3, 0.0), 0.3)).unwrap();
    for _ in 0..64 * 100 {
        world.step(FRAME).unwrap();
    }
    let Sphere { position, velocity, .. } = world.sphere(ball).unwrap();
    assert_eq!((position, velocity), (vec(0.0, 0.3, 0.0), DVec3::ZERO));
}

#[test]
fn a_ball_that_a_spring_pulls_over_the_edge_of_a_box_keeps_its_energy() {
    let mut world = falling();
    add(&mut world, Shape::Box { size: vec(2.0, 1.0, 2.0) }, Pose::at(vec(-1.0, -0.5, 0.0)));
    let ball = world.add_sphere(soft(vec(-0.8, 0.1, 0.0), 0.1)).unwrap();
    world.add_spring(Spring::to_point(ball, vec(1.0, -0.6, 0.0), 0.0).with_stiffness(4.0)).unwrap();
    let energy = world.total_energy();
    let mut touched = 0;
    for _ in 0..80 {
        touched += usize::from(!world.contacts().is_empty());
        world.step(FRAME).unwrap();
        let ball = world.sphere(ball).unwrap();
        assert_close(world.total_energy(), energy, 1e-12 * energy.abs().max(1.0));
        assert!(ball.position.x < 0.0 || ball.position.y < 0.1, "{}", ball.position);
    }
    // On the face and over the edge.
    assert!(touched > 20, "{touched}");
}

#[test]
fn a_ball_in_a_bowl_on_a_spring_has_the_period_of_the_pendulum_with_one() {
    // Lengths R - r, a spring from the lowest point of the centre, of no length: for small swings
    // w² = g/(R - r) + k/m.
    let (length, stiffness) = (0.9, 50.0);
    let mut world = falling();
    let bowl = Shape::Bowl { radius: 1.0, opening: 1.5 };
    add(&mut world, bowl, Pose::at(vec(0.0, 1.0, 0.0)));
    let angle: f64 = 1e-6;
    let place = vec(length * angle.sin(), 1.0 - length * angle.cos(), 0.0);
    let ball = world.add_sphere(soft(place, 0.1)).unwrap();
    let anchor = vec(0.0, 0.1, 0.0);
    world.add_spring(Spring::to_point(ball, anchor, 0.0).with_stiffness(stiffness)).unwrap();
    let w = (G / length + stiffness).sqrt();
    for _ in 0..64 {
        world.step(FRAME).unwrap();
        let x = world.sphere(ball).unwrap().position.x;
        // Of the second order in the angle.
        assert_close(x, place.x * (w * world.time()).cos(), 1e-11 * length);
    }
}

#[test]
fn a_ball_that_a_spring_pulls_back_over_an_edge_comes_onto_the_face() {
    let faces = [
        (Shape::Rectangle { size_x: 2.0, size_z: 2.0 }, vec(-1.0, 0.0, 0.0)),
        (Shape::Box { size: vec(2.0, 1.0, 2.0) }, vec(-1.0, -0.5, 0.0)),
    ];
    for (shape, place) in faces {
        for (angle, stiffness) in [(0.05f64, 10.0), (0.2, 10.0), (0.2, 100.0), (0.4, 100.0)] {
            let mut world = falling();
            let name = format!("{shape:?} {angle} {stiffness}");
            add(&mut world, shape.clone(), Pose::at(place));
            // It lies on the edge along z through the origin.
            let start = 0.1 * vec(angle.sin(), angle.cos(), 0.0);
            let ball = world.add_sphere(soft(start, 0.1)).unwrap();
            let anchor = vec(-1.0, -0.6, 0.0);
            let spring = Spring::to_point(ball, anchor, 0.0).with_stiffness(stiffness);
            world.add_spring(spring).unwrap();
            let energy = world.total_energy();
            for _ in 0..64 {
                world.step(FRAME).unwrap();
                let Sphere { position, .. } = world.sphere(ball).unwrap();
                let nearest = vec(position.x.clamp(-2.0, 0.0), 0.0, 0.0);
                let gap = position.distance(nearest) - 0.1;
                assert!(gap > -1e-12, "{name}: {gap:e}");
                assert_close(world.total_energy(), energy, 1e-12 * energy.abs());
            }
        }
    }
}

/// An empty periodic world of this width along all axes \[m\].
fn periodic(width: f64) -> World {
    let boundary = Boundary::Periodic { size: DVec3::splat(width) };
    World::new(Settings::default().with_boundary(boundary)).unwrap()
}

/// How far two places are apart by their nearest images \[m\].
fn apart_in(world: &World, one: DVec3, other: DVec3) -> f64 {
    world.settings().boundary.nearest_image(one - other).length()
}

#[test]
fn a_turning_pair_on_a_spring_flies_through_the_sides_of_a_periodic_box() {
    for unit in [1e-6, 1.0, 1e6] {
        let mut world = periodic(2.0 * unit);
        let (rate, drift) = (3.0, unit * vec(1.1, 0.7, -0.3));
        let ball = |side: f64| {
            let velocity = drift + side * rate * 0.1 * unit * DVec3::Y;
            soft(side * 0.1 * unit * DVec3::X, 0.1 * unit).with_velocity(velocity)
        };
        let ids = [1.0, -1.0].map(|side| world.add_sphere(ball(side)).unwrap());
        // It pulls with 20 N in units of length, and to turn takes 0.9 N.
        world.add_spring(Spring::between(ids[0], ids[1], 0.0).with_stiffness(100.0)).unwrap();
        let start = world.total_energy();
        let (account, left) = account_of_run(&mut world, 192, FRAME);
        assert_eq!(account.contacts, 0.0);
        // Rounding of some hundred steps.
        assert!((left / start).abs() < 1e-13, "unit {unit}: {left:e}");
        let (angle, center) = (3.0 * rate, 3.0 * drift);
        let arm = 0.1 * unit * vec(angle.cos(), angle.sin(), 0.0);
        for (&place, side) in world.spheres().positions().iter().zip([1.0, -1.0]) {
            let missed = apart_in(&world, place, center + side * arm) / unit;
            assert!(missed < 1e-12, "unit {unit}: {missed:e}");
        }
    }
}

#[test]
fn a_ball_on_a_spring_circles_a_fixed_ball_at_the_side_of_a_periodic_box() {
    for (unit, friction) in [(1e-6, 0.0), (1.0, 0.0), (1.0, 0.4), (1e6, 0.4)] {
        let mut world = periodic(4.0 * unit);
        let middle = unit * vec(1.9, -1.9, 0.0);
        let fixed = Collider::new(Shape::Sphere { radius: 0.5 * unit }, Pose::at(middle));
        world.add_collider(fixed.with_friction(friction).with_restitution(0.0)).unwrap();
        let speed = 1.3 * unit;
        // It rolls.
        let ball = soft(middle + 0.6 * unit * DVec3::Y, 0.1 * unit).with_friction(friction);
        let ball = ball.with_velocity(speed * DVec3::X).with_angular_velocity(-13.0 * DVec3::Z);
        let id = world.add_sphere(ball).unwrap();
        world.add_spring(Spring::to_point(id, middle, 0.0).with_stiffness(100.0)).unwrap();
        let start = world.total_energy();
        let (_, left) = account_of_run(&mut world, 192, FRAME);
        assert!((left / start).abs() < 1e-13, "unit {unit}: {left:e}");
        let angle: f64 = 3.0 * speed / (0.6 * unit);
        let expected = middle + 0.6 * unit * vec(angle.sin(), angle.cos(), 0.0);
        let missed = apart_in(&world, world.spheres().positions()[0], expected) / unit;
        // Rounding of a hundred steps and of places up to 2.
        assert!(missed < 1e-12, "unit {unit}, friction {friction}: {missed:e}");
    }
}
