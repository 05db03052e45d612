//! Rolling over round spheres, edges and seams.

use std::f64::consts::FRAC_1_SQRT_2;

use carom::{
    Collider, DQuat, DVec3, Ends, Exact, Friction, Gravity, Pose, Shape, Sphere, SphereId, World,
};

use crate::common::{G, vec, world};
use crate::{RADIUS, assert_close, assert_vectors_close, ball};

/// A fixed sphere of this radius about the origin, and a ball on it, `angle` \[rad\] from its top.
fn on_dome(radius: f64, angle: f64, friction: impl Into<Friction>) -> (World, SphereId) {
    let mut world = world(Exact::default());
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let dome = Collider::new(Shape::Sphere { radius }, Pose::at(DVec3::ZERO));
    world.add_collider(dome.with_restitution(0.0).with_friction(friction)).unwrap();
    let (sine, cosine) = libm::sincos(angle);
    let place = (radius + RADIUS) * vec(sine, cosine, 0.0);
    let id = world.add_sphere(Sphere::new(place, RADIUS)).unwrap();
    (world, id)
}

#[test]
fn a_ball_that_rolls_off_a_fixed_sphere_leaves_it_at_cos_ten_seventeenths() {
    // With 7/10 v² = g R (1 - cos) and v² = g R cos where nothing presses any more.
    let (radius, start) = (1.0, 0.05);
    let (mut world, id) = on_dome(radius, start, 50.0);
    let (distance, energy) = (radius + RADIUS, world.total_energy());
    let mut last = f64::NAN;
    while !world.contacts().is_empty() || world.time() == 0.0 {
        world.step(1e-3).unwrap();
        let ball = world.sphere(id).unwrap();
        let (cosine, v) = (ball.position.normalize().y, ball.velocity);
        if world.contacts().is_empty() {
            break;
        }
        last = cosine;
        assert_close(ball.position.length(), distance, 1e-8);
        assert_close(world.total_energy(), energy, 1e-5 * energy);
        // Last it slides, where next to nothing presses it on.
        if cosine > 0.62 {
            let fallen = libm::cos(start) - cosine;
            assert_close(0.7 * v.dot(v), G * distance * fallen, 1e-6 * G);
            let slip = v + ball.angular_velocity.cross(-RADIUS * ball.position.normalize());
            // Within a piece of a thousandth.
            assert_close(slip.length(), 0.0, 1e-6);
        }
    }
    assert!(!world.was_stepped());
    // It leaves within a frame of that.
    assert_close(last, 10.0 / 17.0 * libm::cos(start), 5e-3);
}

#[test]
fn a_spinning_ball_on_a_fixed_sphere_slides_before_it_rolls() {
    let (mut world, id) = on_dome(1.0, 0.1, 0.3);
    let ball = world.sphere(id).unwrap().with_angular_velocity(-40.0 * DVec3::Z);
    world.set_sphere(id, ball).unwrap();
    let slip = |ball: &Sphere| {
        let v = ball.velocity;
        (v + ball.angular_velocity.cross(-RADIUS * ball.position.normalize())).length()
    };
    let mut last = f64::INFINITY;
    let mut energy = world.total_energy();
    while world.time() < 0.3 {
        world.step(1e-3).unwrap();
        let now = slip(&world.sphere(id).unwrap());
        assert!(now < last || now < 1e-6, "{now} after {last}");
        let gained = world.total_energy() - energy;
        assert!(gained <= 1e-6 * energy, "{gained}");
        (last, energy) = (now, world.total_energy());
    }
    assert!(last < 1e-6 && !world.was_stepped(), "slip {last}");
}

#[test]
fn a_ball_rolls_off_a_table_and_hardly_loses_energy() {
    let mut world = world(Exact::default());
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let table =
        Collider::new(Shape::Box { size: vec(1.0, 0.2, 1.0) }, Pose::at(vec(0.0, -0.1, 0.0)));
    world.add_collider(table.with_restitution(0.0).with_friction(20.0)).unwrap();
    let id = world.add_sphere(ball(vec(0.1, 0.0, 0.02), vec(0.02, 0.0, -0.1) / RADIUS)).unwrap();
    let (start, mut energy) = (world.total_energy(), world.total_energy());
    while world.sphere(id).unwrap().position.y > -0.3 {
        world.step(1.0 / 120.0).unwrap();
        // It slides a little before it leaves, where next to nothing presses it on.
        let gained = world.total_energy() - energy;
        assert!(gained <= 1e-7 * start, "{gained}");
        assert!(world.total_energy() > 0.99999 * start, "{} of {start}", world.total_energy());
        assert!(world.time() < 20.0);
        energy = world.total_energy();
    }
    assert!(!world.was_stepped());
}

/// Colliders whose tops make a floor, in a turned place: a row of boxes side by side, rectangles edge to edge
/// in two directions, a small one before a large one, a box that is let into a half-space.
fn floors(size: f64, turn: DQuat) -> [Vec<Collider>; 4] {
    let place = |shape: Shape, x: f64, y: f64, z: f64| {
        Collider::new(shape, Pose::at(turn * vec(x, y, z) * size).rotated(turn))
    };
    let rectangle = |size_x: f64, size_z: f64| Shape::Rectangle {
        size_x: size_x * size,
        size_z: size_z * size,
    };
    let steps = -8..8;
    let block = Shape::Box { size: vec(0.25, 1.0, 4.0) * size };
    let blocks = steps.clone().map(|i| place(block.clone(), 0.25 * f64::from(i), -0.5, 0.0));
    let pairs = steps.clone().flat_map(|i| steps.clone().map(move |j| (i, j)));
    let tile = rectangle(0.3, 0.3);
    let tiles =
        pairs.map(|(i, j)| place(tile.clone(), 0.3 * f64::from(i), 0.0, 0.3 * f64::from(j)));
    let two = [
        place(rectangle(1.0, 4.0), -0.5, 0.0, 0.0),
        place(rectangle(1000.0, 1000.0), 500.0, 0.0, 0.0),
    ];
    let sunk = Shape::Box { size: vec(0.7, 1.0, 0.7) * size };
    let sunk = [place(Shape::HalfSpace, 0.0, 0.0, 0.0), place(sunk, 0.1, -0.5, 0.0)];
    [blocks.collect(), tiles.collect(), two.into(), sunk.into()]
}

/// How balls come over a floor: speed, direction, friction, restitution.
const WAYS: [(f64, [f64; 3], f64, f64); 7] = [
    (2.0, [1.0, 0.0, 0.0], 0.5, 1.0),
    (0.01, [1.0, 0.0, 0.0], 0.5, 1.0),
    (30.0, [1.0, 0.0, 0.0], 0.5, 0.6),
    (2.0, [0.8, 0.0, 0.6], 0.5, 1.0),
    // Through the corners of tiles.
    (2.0, [FRAC_1_SQRT_2, 0.0, FRAC_1_SQRT_2], 0.5, 1.0),
    (2.0, [1.0, 0.0, 0.0], 0.0, 1.0),
    (2.0, [0.8, 0.0, 0.6], 0.0, 0.5),
];

#[test]
fn a_ball_rolls_over_the_seams_of_a_floor_as_if_there_were_none() {
    let (radius, way) = (0.1, 0.9);
    let turned = DQuat::from_rotation_z(0.3) * DQuat::from_rotation_x(0.7);
    let scales = [1e-6, 1.0, 1e6].map(|size| [(size, DQuat::IDENTITY), (size, turned)]);
    for (size, turn) in scales.into_iter().flatten() {
        for (number, floor) in floors(size, turn).into_iter().enumerate() {
            for (speed, direction, friction, restitution) in WAYS {
                let mut world = world(Exact::default());
                world.add_force(Gravity::new(turn * vec(0.0, -G * size, 0.0))).unwrap();
                for collider in &floor {
                    world.add_collider(collider.clone().with_restitution(restitution)).unwrap();
                }
                let direction = DVec3::from(direction);
                // It begins between seams, but for tiles on one or before a corner.
                let start = vec(-0.15, radius, -0.15) - 0.3 * direction;
                let ball = Sphere::new(turn * start * size, radius * size)
                    .with_velocity(turn * direction * (speed * size))
                    .with_angular_velocity(turn * DVec3::Y.cross(direction) * (speed / radius))
                    .with_restitution(restitution)
                    .with_friction(friction);
                let id = world.add_sphere(ball).unwrap();
                let (mut impacts, mut events) = (0, 0);
                for _ in 0..64 {
                    let report = world.step(way / speed / 64.0).unwrap();
                    impacts += report.impacts.len();
                    events += report.work.events;
                }
                let case = format!("floor {number}, size {size}, {turn}, {speed} m/s, {direction}");
                assert_eq!(impacts, 0, "{case}");
                assert!(events < 100, "{events} events, {case}");
                let after = world.sphere(id).unwrap();
                // Rounding, once for every seam.
                let expected = turn * (start + way * direction) * size;
                assert_vectors_close(after.position, expected, 1e-12 * size);
                assert_vectors_close(after.velocity, ball.velocity, 1e-12 * speed * size);
            }
        }
    }
}

#[test]
fn a_ball_that_rolls_along_a_line_of_a_round_surface_stays_on_it_to_its_end() {
    let (radius, half) = (0.3, 0.5);
    let cylinder = Shape::Cylinder { radius, height: 2.0 * half };
    let capsule = Shape::Capsule { radius, length: 2.0 * half };
    let pipe = Shape::Pipe { radius, length: 2.0 * half, closed: Ends::NONE };
    let lines = [(cylinder, radius + RADIUS), (capsule, radius + RADIUS), (pipe, RADIUS - radius)];
    let slope = 0.3;
    for (shape, height) in lines {
        let mut world = world(Exact::default());
        // Gravity is tilted in place of the surface, which lies along x.
        let (sine, cosine) = libm::sincos(slope);
        world.add_force(Gravity::new(G * vec(sine, -cosine, 0.0))).unwrap();
        let lying = DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2);
        let surface = Collider::new(shape, Pose { position: DVec3::ZERO, rotation: lying });
        world.add_collider(surface.with_restitution(0.0).with_friction(0.6)).unwrap();
        let id = world.add_sphere(Sphere::new(vec(-0.4, height, 0.0), RADIUS)).unwrap();
        let start = world.total_energy();
        // It is past the end of the face after 0.66 s.
        let acceleration = 5.0 / 7.0 * G * sine;
        for frame in 1..=64 {
            world.step(1.0 / 64.0).unwrap();
            let (t, ball) = (f64::from(frame) / 64.0, world.sphere(id).unwrap());
            let x = 0.5 * acceleration * t * t - 0.4;
            if x < half {
                // Rounding of the height, which a piece of path corrects.
                assert_vectors_close(ball.position, vec(x, height, 0.0), 1e-9);
                assert_vectors_close(ball.velocity, vec(acceleration * t, 0.0, 0.0), 1e-9);
            }
        }
        assert!(world.sphere(id).unwrap().position.x > half);
        assert_close(world.total_energy(), start, 1e-6 * start.abs());
    }
}
