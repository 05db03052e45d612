//! Derivatives of balls that several planes hold, that planes carry, and that leave planes over their ends: against closed
//! forms, against differences of runs, forwards and backwards alike.

mod common;

use carom::{
    Collider, DQuat, DVec3, Friction, Gravity, Pose, Shape, Sphere, SphereId, SphereTangent, Tape,
    Variation, World,
};
use common::derivatives::{
    after, assert_agree_with_differences, assert_backwards_equals_forwards, follow, varied,
};
use common::{G, Numbers, vec};

/// Frames of a tenth of a second.
const FRAMES: usize = 15;

/// A world with gravity.
fn world_with(gravity: DVec3) -> World {
    let mut world = World::default();
    world.add_force(Gravity::new(gravity)).unwrap();
    world
}

/// A half-space whose front faces along a direction in the plane z = 0, at an angle from the y axis \[rad\].
fn half_space(place: DVec3, angle: f64) -> Collider {
    let pose = Pose { rotation: DQuat::from_rotation_z(angle), ..Pose::at(place) };
    Collider::new(Shape::HalfSpace, pose).with_restitution(0.0)
}

/// Changes of all that balls and colliders have but rotations and coefficients. Colliders that do not move stay at rest
/// unless `moves`.
fn some_direction(world: &World, numbers: &mut Numbers, moves: bool) -> Variation {
    // Where pulls are across the slip, runs themselves are off by some 10⁻⁷.
    let pull = if moves { numbers.vector() } else { numbers.between(-1.0, 1.0) * DVec3::Y };
    let mut direction = Variation::default().with_acceleration(0.5 * pull);
    for &id in world.spheres().ids() {
        let change = direction.sphere_mut(id);
        change.position = 0.3 * numbers.vector();
        change.velocity = 0.3 * numbers.vector();
        change.radius = 0.1 * numbers.between(-1.0, 1.0);
        change.mass = 0.1 * numbers.between(-1.0, 1.0);
    }
    for (id, _) in world.colliders() {
        let change = direction.collider_mut(id);
        change.position = 0.1 * numbers.vector();
        if moves {
            change.velocity = 0.1 * numbers.vector();
        }
    }
    direction
}

/// Asserts that derivatives agree with differences in steps of `h` to a part, and backwards with forwards.
#[track_caller]
fn check((world, gravity): (&World, DVec3), direction: &Variation, [h, part]: [f64; 2]) {
    let balls: Vec<SphereId> = world.spheres().ids().to_vec();
    let force = world.forces().next().unwrap().0;
    let it = follow(world, direction, FRAMES);
    let end = |by: f64| after(varied(world, direction, by, Some((force, gravity))), FRAMES);
    assert_agree_with_differences(&it.tangents, &balls, [h, part], end);
    let mut numbers = Numbers(77);
    assert_backwards_equals_forwards((&it.tangents, &it.tape), direction, &balls, &mut numbers);
}

#[test]
fn a_ball_in_a_groove_agrees_with_differences_and_with_the_gradient() {
    let gravity = vec(0.0, -G, 1.5);
    let mut numbers = Numbers(1);
    for _ in 0..20 {
        let mut world = world_with(gravity);
        let mean = numbers.between(-0.2, 0.2);
        for side in [-1.0, 1.0] {
            let angle = mean + side * std::f64::consts::FRAC_PI_4;
            world.add_collider(half_space(DVec3::ZERO, angle)).unwrap();
        }
        let place = vec(numbers.between(-0.3, 0.3), 0.8, 0.0);
        let velocity = vec(0.0, 0.0, numbers.between(-1.0, 1.0));
        let ball = Sphere::new(place, 0.1).with_velocity(velocity);
        world.add_sphere(ball).unwrap();
        let direction = some_direction(&world, &mut numbers, true);
        // The fourth power of the step times the fifth derivative of the times of the impacts.
        check((&world, gravity), &direction, [1e-3, 1e-7]);
    }
}

#[test]
fn a_ball_in_a_corner_goes_with_its_walls() {
    let gravity = vec(-3.0, -G, -2.0);
    let mut world = world_with(gravity);
    for axis in [DVec3::Y, DVec3::X, DVec3::Z] {
        let rotation = DQuat::from_rotation_arc(DVec3::Y, axis);
        let wall = Collider::new(Shape::HalfSpace, Pose { rotation, ..Pose::at(DVec3::ZERO) });
        world.add_collider(wall.with_restitution(0.0)).unwrap();
    }
    let ball = world.add_sphere(Sphere::new(vec(0.3, 0.1, 0.2), 0.1)).unwrap();
    let mut tape = Tape::start(&world).unwrap();
    for _ in 0..30 {
        tape.step(&mut world, 0.1).unwrap();
    }
    assert!((world.sphere(ball).unwrap().position - DVec3::splat(0.1)).length() < 1e-12);
    let along = vec(1.0, 2.0, 4.0);
    let place = SphereTangent { position: along, ..SphereTangent::default() };
    let by = tape.gradient(&[(ball, place)]).unwrap();
    // Where it began does not matter: the centre is a radius off each wall.
    let of_ball = by.sphere(ball);
    assert_eq!((of_ball.position, of_ball.velocity), (DVec3::ZERO, DVec3::ZERO));
    assert!((of_ball.radius - 7.0).abs() < 1e-12, "{of_ball:?}");
    for ((id, _), axis) in world.colliders().zip([DVec3::Y, DVec3::X, DVec3::Z]) {
        let wall = by.collider(id);
        assert!((wall.position - along * axis).length() < 1e-12, "{wall:?}");
        assert!((wall.velocity - 3.0 * along * axis).length() < 1e-12, "{wall:?}");
    }
}

#[test]
fn a_ball_that_leaves_a_table_agrees_with_differences_and_with_the_gradient() {
    let gravity = vec(0.0, -G, 0.0);
    let rough = Friction::sliding(0.2).with_rolling(0.02).with_spinning(0.01);
    let mut numbers = Numbers(2);
    for number in 0..40 {
        let mut world = world_with(gravity);
        let friction = if number % 2 == 0 { Friction::default() } else { rough };
        let top = match number % 4 {
            0 | 1 => Shape::Box { size: vec(2.0, 1.0, 6.0) },
            _ => Shape::Cylinder { radius: 1.0, height: 1.0 },
        };
        let table = Collider::new(top, Pose::at(vec(0.0, -0.5, 0.0))).with_restitution(0.0);
        let mut table = table.with_friction(friction);
        if number % 2 == 0 {
            // A rough table that moves is stepped in zones.
            table.velocity = vec(numbers.between(-0.2, 0.2), 0.0, 0.0);
        }
        world.add_collider(table).unwrap();
        let ball = Sphere::new(vec(0.0, 0.2, numbers.between(-0.3, 0.3)), 0.1);
        let velocity = vec(numbers.between(2.0, 3.0), 0.0, numbers.between(-1.0, 1.0));
        let ball = ball.with_velocity(velocity).with_angular_velocity(5.0 * numbers.vector());
        world.add_sphere(ball).unwrap();
        let direction = some_direction(&world, &mut numbers, number % 2 == 0);
        check((&world, gravity), &direction, [1e-3, 1e-7]);
    }
}

#[test]
fn a_ball_that_rolls_off_a_table_has_the_derivatives_of_its_closed_form() {
    let mut world = world_with(vec(0.0, -G, 0.0));
    let table = Collider::new(Shape::Box { size: DVec3::ONE }, Pose::at(vec(0.0, -0.5, 0.0)));
    let table = world.add_collider(table).unwrap();
    let (speed, end) = (2.0, 0.7);
    let ball = Sphere::new(vec(0.1, 0.1, 0.0), 0.1).with_velocity(vec(speed, 0.0, 0.0));
    let ball = world.add_sphere(ball).unwrap();
    let mut tape = Tape::start(&world).unwrap();
    tape.step(&mut world, end).unwrap();
    // It leaves at .5/2 s - x/v, and then falls: y = r - g (T - t)²/2.
    let (leaves, falls) = (0.2, end - 0.2);
    assert!(
        (world.sphere(ball).unwrap().position.y - (0.1 - 0.5 * G * falls * falls)).abs() < 1e-12
    );
    let height = SphereTangent { position: DVec3::Y, ..SphereTangent::default() };
    let by = tape.gradient(&[(ball, height)]).unwrap();
    let later = G * falls;
    for (found, expected) in [
        (by.sphere(ball).position.x, -later / speed),
        (by.sphere(ball).velocity.x, -later * leaves / speed),
        (by.collider(table).position.x, later / speed),
        (by.collider(table).velocity.x, later * leaves / speed),
        (by.collider(table).position.y, 1.0),
        (by.sphere(ball).radius, 1.0),
        (by.acceleration.y, 0.5 * falls * falls),
    ] {
        assert!((found - expected).abs() < 1e-12, "{found} {expected}");
    }
    assert!((tape.margin().directness - 1.0).abs() < 1e-12);
}

#[test]
fn a_ball_on_a_lift_or_a_belt_agrees_with_differences_and_with_the_gradient() {
    let gravity = vec(0.0, -G, 0.0);
    let rough = Friction::sliding(0.2).with_rolling(0.02).with_spinning(0.01);
    let mut numbers = Numbers(3);
    for number in 0..40 {
        let mut world = world_with(gravity);
        let tilt = if number % 3 == 1 { 0.0 } else { numbers.between(-0.1, 0.1) };
        let mut lift = half_space(DVec3::ZERO, tilt);
        // A rough lift is stepped in zones.
        match number % 3 {
            0 => lift.velocity = vec(0.3, 0.5, -0.2) + 0.2 * numbers.vector(),
            _ => lift.surface_velocity = vec(0.5, 0.0, 0.4),
        }
        let friction = if number % 3 == 1 { rough } else { Friction::default() };
        world.add_collider(lift.with_friction(friction).with_restitution(0.0)).unwrap();
        let ball = Sphere::new(vec(0.0, 0.5, 0.0), 0.1).with_velocity(numbers.vector());
        let ball = ball.with_angular_velocity(5.0 * numbers.vector());
        world.add_sphere(ball).unwrap();
        let direction = some_direction(&world, &mut numbers, number % 3 != 1);
        check((&world, gravity), &direction, [1e-3, 1e-7]);
    }
}

#[test]
fn derivatives_of_held_balls_have_the_units_of_the_world() {
    // A groove that ends in a wall, and a table that a ball leaves.
    let by_start = |size: f64| {
        let unit = size.sqrt();
        let mut world = world_with(vec(0.0, -G, 1.5));
        for side in [-1.0, 1.0] {
            let angle = side * std::f64::consts::FRAC_PI_4;
            world.add_collider(half_space(DVec3::ZERO, angle)).unwrap();
        }
        let table = Shape::Box { size: size * vec(1.0, 1.0, 4.0) };
        let table = Collider::new(table, Pose::at(size * vec(0.0, 4.5, 0.0)));
        world.add_collider(table.with_restitution(0.0)).unwrap();
        let in_groove = Sphere::new(size * vec(0.1, 0.8, 0.0), 0.1 * size);
        let on_table = Sphere::new(size * vec(0.0, 5.2, 0.0), 0.1 * size);
        let on_table = on_table.with_velocity(unit * vec(1.5, 0.0, 0.0));
        let balls = [in_groove, on_table].map(|it| world.add_sphere(it).unwrap());
        let mut tape = Tape::start(&world).unwrap();
        for _ in 0..6 {
            tape.step(&mut world, 0.1 * unit).unwrap();
        }
        balls.map(|ball| {
            let place = SphereTangent { position: vec(1.0, 2.0, 3.0), ..SphereTangent::default() };
            let by = tape.gradient(&[(ball, place)]).unwrap();
            by.sphere(ball).velocity / unit
        })
    };
    let usual = by_start(1.0);
    for size in [f64::from(1 << 20), 1.0 / f64::from(1 << 20)] {
        for (scaled, usual) in by_start(size).into_iter().zip(usual) {
            assert!((scaled - usual).length() < 1e-9 * usual.length(), "{scaled} {usual}");
        }
    }
}
