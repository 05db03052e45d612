//! Spheres alone with surfaces at rest, which the rule `exact` answers without a group.

mod common;

use carom::{
    Boundary, Collider, DVec3, Gravity, Pose, Settings, Shape, Sphere, ViscousDrag, World,
};
use common::{Numbers, vec};

const FRAME: f64 = 1.0 / 60.0;

/// A tray with a block and a round stone in it.
fn tray(boundary: Boundary, spheres_collide: bool) -> World {
    let settings =
        Settings::default().with_boundary(boundary).with_spheres_collide(spheres_collide);
    let mut world = World::new(settings).unwrap();
    let floor = Shape::Rectangle { size_x: 4.0, size_z: 4.0 };
    let mut add = |shape: Shape, place: DVec3, restitution: f64| {
        let collider = Collider::new(shape, Pose::at(place)).with_restitution(restitution);
        world.add_collider(collider).unwrap();
    };
    add(floor, DVec3::ZERO, 0.5);
    let (along_x, along_z) = (vec(4.4, 9.0, 0.2), vec(0.2, 9.0, 4.4));
    for side in [-2.1, 2.1] {
        add(Shape::Box { size: along_z }, vec(side, 4.5, 0.0), 0.7);
        add(Shape::Box { size: along_x }, vec(0.0, 4.5, side), 1.0);
    }
    add(Shape::Box { size: vec(0.6, 0.5, 0.4) }, vec(-0.5, 0.25, 0.3), 0.8);
    add(Shape::Sphere { radius: 0.4 }, vec(0.7, 0.0, -0.6), 0.9);
    world
}

fn add_falling(world: &mut World, count: usize) {
    let mut numbers = Numbers(5);
    world.add_force(Gravity::new(vec(1.5, -9.81, -0.7))).unwrap();
    world.add_force(ViscousDrag::new(0.02)).unwrap();
    for n in 0..count {
        let place = vec(0.8 * (n % 5) as f64 - 1.6, 0.7 + 0.3 * (n / 5) as f64, 0.0);
        let place = place + vec(0.0, 0.2, 1.2) * numbers.vector();
        let sphere = Sphere::new(place, 0.1).with_velocity(2.0 * numbers.vector());
        world.add_sphere(sphere).unwrap();
    }
}

/// In a periodic box, however wide, contacts are answered in groups: it may be images that touch.
fn wide_box() -> Boundary {
    Boundary::Periodic { size: DVec3::splat(500.0) }
}

#[test]
fn spheres_alone_with_surfaces_do_what_they_do_in_groups() {
    for (spheres_collide, frames, least) in [(false, 90, 150), (true, 60, 40)] {
        let mut worlds = [Boundary::Open, wide_box()].map(|it| tray(it, spheres_collide));
        let mut impacts = [0; 2];
        for (world, impacts) in worlds.iter_mut().zip(&mut impacts) {
            add_falling(world, 15);
            for _ in 0..frames {
                *impacts += world.step(FRAME).unwrap().impacts.len();
            }
        }
        assert_eq!(impacts[0], impacts[1]);
        assert!(impacts[0] > least, "{impacts:?}");
        let [alone, grouped] = worlds.each_ref().map(|world| world.spheres().positions());
        for (a, b) in alone.iter().zip(grouped) {
            // Rounding, which each bounce off something round makes some ten times larger.
            assert!((*a - *b).length() < 1e-9, "{a} {b}");
        }
    }
}

#[test]
fn three_planes_met_at_once_each_give_back_their_own_part() {
    let mut world = World::new(Settings::default()).unwrap();
    for (normal, restitution) in [(DVec3::X, 0.25), (DVec3::Y, 0.5), (DVec3::Z, 1.0)] {
        let pose = Pose::at(DVec3::ZERO).rotated(carom::DQuat::from_rotation_arc(DVec3::Y, normal));
        let plane = Collider::new(Shape::HalfSpace, pose).with_restitution(restitution);
        world.add_collider(plane).unwrap();
    }
    let ball = Sphere::new(vec(1.5, 2.5, 3.5), 0.5).with_mass(2.0);
    world.add_sphere(ball.with_velocity(vec(-1.0, -2.0, -3.0))).unwrap();
    let report = world.step(1.5).unwrap();
    assert_eq!(report.impacts.len(), 3);
    let [group] = &report.groups[..] else { panic!("{:?}", report.groups) };
    // Half of m (1 - e²) u² is lost at each plane.
    let lost = 1.0 - 0.25 * 0.25 + (1.0 - 0.25) * 4.0;
    // Some roundings of the 14 J, and of normals that are turned.
    let tolerance = 1e-13;
    assert!((group.energy_demanded + lost).abs() < tolerance, "{}", group.energy_demanded);
    assert!((group.energy_after - group.energy_before + lost).abs() < tolerance);
    assert!((group.momentum_after - group.momentum_before).length() < tolerance);
    let velocity = world.spheres().velocities()[0];
    assert!((velocity - vec(0.25, 1.0, 3.0)).length() < tolerance, "{velocity}");
}

#[test]
fn a_ball_steered_in_every_frame_meets_the_walls_that_a_falling_one_meets() {
    let weight = vec(3.0, -9.81, -2.0);
    let mut steered = tray(Boundary::Open, false);
    let mut falling = tray(Boundary::Open, false);
    falling.add_force(Gravity::new(weight)).unwrap();
    let mut impacts = [0; 2];
    for world in [&mut steered, &mut falling] {
        for n in 0..4 {
            let place = vec(-1.5, 0.1, 1.2 - 0.3 * f64::from(n));
            let ball = Sphere::new(place, 0.1).with_mass(1.0).with_velocity(vec(2.0, 0.0, -3.5));
            world.add_sphere(ball).unwrap();
        }
    }
    for _ in 0..120 {
        steered.set_applied_forces(&[weight; 4]).unwrap();
        impacts[0] += steered.step(FRAME).unwrap().impacts.len();
        impacts[1] += falling.step(FRAME).unwrap().impacts.len();
        let places = [&steered, &falling].map(|world| world.spheres().positions());
        for (a, b) in places[0].iter().zip(places[1]) {
            // Steered balls begin a flight in every frame, with a rounding each time.
            assert!((*a - *b).length() < 1e-9, "{a} {b}");
        }
    }
    assert_eq!(impacts[0], impacts[1]);
    assert!(impacts[0] > 40, "{impacts:?}");
}

#[test]
fn a_ball_rolls_over_an_edge_without_an_impact() {
    let mut world = World::new(Settings::default()).unwrap();
    world.add_force(Gravity::new(vec(0.0, -9.81, 0.0))).unwrap();
    let plate = Shape::Rectangle { size_x: 10.0, size_z: 10.0 };
    let plate = Collider::new(plate, Pose::at(DVec3::ZERO)).with_restitution(0.5);
    world.add_collider(plate).unwrap();
    let radius = 0.25;
    let ball = Sphere::new(vec(0.0, radius, 4.99), radius).with_velocity(vec(0.3, 0.0, 0.4));
    world.add_sphere(ball).unwrap();
    let energy = |world: &World| {
        let spheres = world.spheres();
        0.5 * spheres.velocities()[0].length_squared() + 9.81 * spheres.positions()[0].y
    };
    let before = energy(&world);
    let mut on_the_edge = 0;
    for _ in 0..30 {
        assert_eq!(world.step(1.0 / 120.0).unwrap().impacts, []);
        let across = world.spheres().positions()[0] - vec(0.0, 0.0, 5.0);
        let gap = vec(0.0, across.y, across.z).length() - radius;
        // Pieces of a thousandth of a radian leave the edge by less than this part of the radius.
        if across.z > 0.0 && gap < 1e-9 * radius {
            assert!(gap > -1e-9 * radius, "{gap}");
            on_the_edge += 1;
        }
        // And each changes the energy by about that part of it.
        assert!((energy(&world) - before).abs() < 1e-6 * before, "{}", energy(&world) - before);
    }
    assert!(on_the_edge > 10, "{on_the_edge}");
}
