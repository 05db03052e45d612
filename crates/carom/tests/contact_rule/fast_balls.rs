//! Fast balls: they neither tunnel nor lose their way.

use carom::{Collider, DQuat, DVec3, Pose, Settings, Shape, Sides, Sphere, World};

use crate::{FRAME, add_box, add_wall, run, under_gravity, world};

#[test]
fn fast_balls_do_not_tunnel() {
    let thin = [
        Shape::HalfSpace,
        Shape::Rectangle { size_x: 4.0, size_z: 4.0 },
        Shape::Sphere { radius: 0.3 },
        Shape::Box { size: DVec3::new(2.0, 0.01, 2.0) },
        Shape::Container { size: DVec3::new(2.0, 0.5, 2.0), open: Sides::NONE },
    ];
    for speed in [10.0, 100.0, 1000.0, 10_000.0] {
        for shape in thin.clone() {
            for (offset, radius) in [(0.0, 0.005), (0.0, 0.05), (0.13, 0.05), (0.29, 0.05)] {
                let mut world = world();
                world.add_collider(Collider::new(shape.clone(), Pose::at(DVec3::ZERO))).unwrap();
                let ball = Sphere::new(DVec3::new(offset, 3.0, 0.5 * offset), radius)
                    .with_velocity(-speed * DVec3::Y);
                let id = world.add_sphere(ball).unwrap();
                let frames = (3.0 / speed / FRAME) as u32 + 3;
                run(&mut world, frames);
                let end = world.sphere(id).unwrap();
                // From all but a sphere beside its middle, straight back.
                let least = if matches!(shape, Shape::Sphere { .. }) { -0.999 } else { 0.999 };
                assert!(end.velocity.y > least * speed, "{shape:?} {speed} {offset}: {end:?}");
                let lost = end.velocity.length() / speed - 1.0;
                // Some roundings of positions of some metres, by way of normals, each half an ulp.
                assert!(lost.abs() < 1e-12, "{shape:?} {speed} {offset}: {lost:e}");
            }
        }
        // Two balls head on.
        let mut world = world();
        let ids = [DVec3::X, DVec3::NEG_X].map(|side| {
            let ball = Sphere::new(2.0 * side, 0.05).with_velocity(-speed * side);
            world.add_sphere(ball).unwrap()
        });
        run(&mut world, (4.0 / speed / FRAME) as u32 + 3);
        let [first, second] = ids.map(|id| world.sphere(id).unwrap());
        assert!((first.velocity.x - speed).abs() < 1e-9 * speed, "{first:?}");
        assert!((second.velocity.x + speed).abs() < 1e-9 * speed, "{second:?}");
    }
}

/// Within a sub-step it may come from one wall to the next.
#[test]
fn a_fast_ball_stays_in_its_box() {
    for speed in [10.0, 100.0, 1000.0] {
        for direction in [DVec3::new(0.6, 0.64, 0.48), DVec3::new(1.0, 2.0, 2.0) / 3.0] {
            let mut world = world();
            let shape = Shape::Container { size: DVec3::ONE, open: Sides::NONE };
            world.add_collider(Collider::new(shape, Pose::at(DVec3::ZERO))).unwrap();
            let place = DVec3::new(0.1, 0.2, -0.1);
            let ball = Sphere::new(place, 0.03).with_velocity(speed * direction);
            world.add_sphere(ball).unwrap();
            for frame in 0..120 {
                run(&mut world, 1);
                let at = world.spheres().positions()[0];
                // Overlaps of a two-thousandth of the radius are left as they are.
                assert!(at.abs().max_element() < 0.4701, "{speed} {direction} {frame}: {at}");
            }
            let lost = world.spheres().velocities()[0].length() / speed - 1.0;
            // Some roundings for each of some hundred impacts.
            assert!(lost.abs() < 1e-12, "{speed} {direction}: {lost:e}");
        }
    }
}

/// A piston is met as it moves, also by a ball that comes to it after a bounce.
#[test]
fn a_fast_ball_does_not_pass_a_piston() {
    for speed in [50.0, 200.0, 1000.0] {
        let mut world = world();
        add_wall(&mut world, DVec3::X, DVec3::ZERO, 1.0);
        let facing = DQuat::from_rotation_arc(DVec3::Y, DVec3::NEG_X);
        let pose = Pose::at(DVec3::new(0.6, 0.0, 0.0)).rotated(facing);
        let piston = Collider::new(Shape::Rectangle { size_x: 2.0, size_z: 2.0 }, pose);
        let piston = piston.moving(DVec3::new(-0.1, 0.0, 0.0), DVec3::ZERO);
        world.add_collider(piston).unwrap();
        let ball = Sphere::new(DVec3::new(0.3, 0.0, 0.0), 0.05);
        world.add_sphere(ball.with_velocity(DVec3::new(-speed, 0.0, 0.0))).unwrap();
        for frame in 1..=120 {
            run(&mut world, 1);
            let (at, piston) =
                (world.spheres().positions()[0].x, 0.6 - 0.1 * FRAME * f64::from(frame));
            assert!(at > 0.049 && at < piston - 0.049, "{speed}, frame {frame}: {at} of {piston}");
        }
    }
}

/// A floor bears it all the while.
#[test]
fn a_ball_that_slides_fast_into_a_wall_comes_back_as_fast() {
    let mut world = under_gravity();
    add_box(&mut world, 5.0, 1.0);
    let radius = 0.1;
    let ball = Sphere::new(DVec3::new(0.0, radius, 0.0), radius).with_velocity(DVec3::X * 40.0);
    world.add_sphere(ball).unwrap();
    for frame in 0..120 {
        run(&mut world, 1);
        let spheres = world.spheres();
        let (at, velocity) = (spheres.positions()[0], spheres.velocities()[0]);
        assert!((at.y - radius).abs() < 1e-3 * radius, "{frame}: {at}");
        assert!((velocity.x.abs() - 40.0).abs() < 1e-9, "{frame}: {velocity}");
    }
}

#[test]
fn a_fast_ball_that_passes_is_not_stopped() {
    let mut world = world();
    world
        .add_collider(Collider::new(Shape::Sphere { radius: 0.3 }, Pose::at(DVec3::ZERO)))
        .unwrap();
    world.add_sphere(Sphere::new(DVec3::new(3.0, 0.0, 0.36), 0.3)).unwrap();
    let plate = Shape::Rectangle { size_x: 1.0, size_z: 1.0 };
    world.add_collider(Collider::new(plate, Pose::at(DVec3::new(0.0, -1.0, 2.0)))).unwrap();
    let velocity = 1000.0 * DVec3::X;
    let fast = Sphere::new(DVec3::new(-5.0, 0.0, -0.36), 0.05).with_velocity(velocity);
    let id = world.add_sphere(fast).unwrap();
    run(&mut world, 3);
    assert_eq!(world.sphere(id).unwrap().velocity, velocity);
}

#[test]
fn a_ball_that_passes_a_plate_from_behind_flies_on_and_overlaps_nothing() {
    let plate = Shape::Rectangle { size_x: 2.0, size_z: 2.0 };
    for shape in [plate, Shape::Disc { radius: 1.0 }] {
        for settings in [*world().settings(), Settings::default()] {
            let mut world = World::new(settings).unwrap();
            world.add_collider(Collider::new(shape.clone(), Pose::at(DVec3::ZERO))).unwrap();
            let ball = Sphere::new(-2.0 * DVec3::Y, 0.5).with_velocity(DVec3::Y);
            world.add_sphere(ball).unwrap();
            for frame in 1..=240 {
                run(&mut world, 1);
                let free = f64::from(frame) * FRAME - 2.0;
                let at = world.spheres().positions()[0].y;
                // Under `contact` an overlap of less than a fiftieth of the radius is corrected.
                assert!(
                    (at - free).abs() < 0.0101,
                    "{shape:?}, frame {frame}: {at} instead of {free}"
                );
                assert!(world.overlaps(0.0).is_empty(), "{shape:?}, frame {frame}");
                assert_eq!(world.spheres().velocities()[0], DVec3::Y);
            }
        }
    }
}
