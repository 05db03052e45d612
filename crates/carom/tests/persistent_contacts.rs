//! The contacts that persist, against statics: forces carry the weights above them, gaps are closed,
//! and nothing is in contact that flies.

use carom::{
    BodyPair, Boundary, Collider, DQuat, DVec3, Gravity, Pose, Settings, Shape, Sphere, World,
};

const G: f64 = 9.81;

fn world_with_floor(restitution: f64) -> World {
    let mut world = World::new(Settings::default()).unwrap();
    world.add_force(Gravity::new(DVec3::new(0.0, -G, 0.0))).unwrap();
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO));
    world.add_collider(floor.with_restitution(restitution)).unwrap();
    world
}

fn ball(x: f64, y: f64, mass: f64) -> Sphere {
    Sphere::new(DVec3::new(x, y, 0.0), 1.0).with_mass(mass).with_restitution(0.0)
}

#[test]
fn each_contact_of_a_column_carries_the_weight_above_it() {
    let mut world = world_with_floor(0.0);
    let masses = [1.0, 2.0, 4.0];
    for (place, mass) in masses.into_iter().enumerate() {
        world.add_sphere(ball(0.0, 1.0 + 2.0 * place as f64, mass)).unwrap();
    }
    world.step(0.5).unwrap();
    let contacts = world.contacts();
    let pairs = contacts.iter().filter(|it| matches!(it.between, BodyPair::Spheres(..))).count();
    assert_eq!((contacts.len(), pairs), (3, 2));
    // Pairs first: the lower one carries 6 kg, the upper one 4 kg; then the floor, 7 kg.
    for (contact, carried) in contacts.iter().zip([6.0, 4.0, 7.0]) {
        let weight = carried * G;
        assert!((contact.normal_force - weight).abs() <= 1e-12 * weight, "{contact:?}");
        assert!((contact.normal - DVec3::Y).length() <= 1e-12, "{contact:?}");
        assert!(contact.gap.abs() <= 1e-12, "{contact:?}");
    }
}

#[test]
fn a_ball_in_a_trough_presses_on_both_sides() {
    let mut world = World::new(Settings::default()).unwrap();
    world.add_force(Gravity::new(DVec3::new(0.0, -G, 0.0))).unwrap();
    let eighth = std::f64::consts::FRAC_PI_4;
    for angle in [eighth, -eighth] {
        let pose = Pose { rotation: DQuat::from_rotation_z(angle), ..Pose::at(DVec3::ZERO) };
        world.add_collider(Collider::new(Shape::HalfSpace, pose).with_restitution(0.0)).unwrap();
    }
    world.add_sphere(ball(0.0, 2.0f64.sqrt(), 3.0)).unwrap();
    world.step(0.1).unwrap();
    let forces: Vec<f64> = world.contacts().iter().map(|it| it.normal_force).collect();
    // Two forces under 45 degrees carry the weight: each is m g / √2.
    let expected = 3.0 * G / 2.0f64.sqrt();
    assert_eq!(forces.len(), 2);
    assert!(forces.iter().all(|force| (force - expected).abs() <= 1e-9 * expected), "{forces:?}");
}

#[test]
fn what_flies_or_bounces_is_in_no_persistent_contact() {
    let mut world = world_with_floor(1.0);
    world.add_sphere(ball(0.0, 3.0, 1.0).with_restitution(1.0)).unwrap();
    for _ in 0..100 {
        world.step(0.05).unwrap();
        assert!(world.contacts().is_empty());
    }
}

#[test]
fn contacts_are_known_until_something_is_changed() {
    let mut world = world_with_floor(0.0);
    let id = world.add_sphere(ball(0.0, 1.0, 1.0)).unwrap();
    assert!(world.contacts().is_empty(), "no step yet");
    world.step(0.1).unwrap();
    assert_eq!(world.contacts().len(), 1);
    assert_eq!(world.clone().contacts(), world.contacts());
    world.set_sphere(id, ball(0.0, 1.0, 2.0)).unwrap();
    assert!(world.contacts().is_empty());
    world.step(0.1).unwrap();
    assert!((world.contacts()[0].normal_force - 2.0 * G).abs() <= 1e-12);
}

#[test]
fn a_ball_that_slides_over_a_round_top_presses_less_the_faster_it_is() {
    let mut world = World::new(Settings::default()).unwrap();
    world.add_force(Gravity::new(DVec3::new(0.0, -G, 0.0))).unwrap();
    let hill = Collider::new(Shape::Sphere { radius: 9.0 }, Pose::at(DVec3::ZERO));
    world.add_collider(hill.with_restitution(0.0)).unwrap();
    let speed = 5.0;
    let sphere = ball(0.0, 10.0, 1.0).with_velocity(DVec3::X * speed);
    world.add_sphere(sphere).unwrap();
    let duration = 1e-3;
    world.step(duration).unwrap();
    let force = world.contacts()[0].normal_force;
    // m (g - v²/R) at the top; it changes by 3 g φ²/2 until the angle φ = v t/R, 4e-6.
    let expected = G - speed * speed / 10.0;
    assert!((force - expected).abs() <= 1e-5, "{force} {expected}");
}

/// Rounding leaves heights, and speeds along which normals turn in an hour or so: far beyond the end of the floor.
#[test]
fn a_row_that_slides_on_a_floor_with_an_end_stays_on_it_whatever_rounding_its_heights_have() {
    for count in 2..6 {
        let mut world = World::new(Settings::default()).unwrap();
        world.add_force(Gravity::new(DVec3::new(0.0, -G, 0.0))).unwrap();
        let floor = Shape::Rectangle { size_x: 12.0, size_z: 4.0 };
        world.add_collider(Collider::new(floor, Pose::at(DVec3::Y * -10.0))).unwrap();
        let start = |i: usize| -3.31 + 0.3 * i as f64;
        for i in 0..count {
            let (height, speed) = if i % 2 == 0 { (0.0, 0.0) } else { (9.3e-14, 1e-30) };
            let ball = Sphere::new(DVec3::new(start(i), -9.85 + height, 0.0), 0.15)
                .with_velocity(DVec3::new(-1.0, speed, 0.0))
                .with_restitution(0.4);
            world.add_sphere(ball).unwrap();
        }
        for _ in 0..120 {
            world.step(1.0 / 60.0).unwrap();
        }
        for (i, place) in world.spheres().positions().iter().enumerate() {
            // Rounding of coordinates up to 10 m, some times over.
            let expected = DVec3::new(start(i) - world.time(), -9.85, 0.0);
            assert!((*place - expected).length() < 1e-12, "{count} balls, ball {i}: {place}");
        }
    }
}

#[test]
fn a_ball_slides_over_the_seams_of_a_floor_in_a_periodic_box() {
    for restitution in [0.0, 0.5, 1.0] {
        // Within the box, and outside: there the floor is an image.
        for start in [DVec3::new(-1.7, -0.5, 0.2), DVec3::new(2.3, -0.5, 4.2)] {
            let size = DVec3::new(4.0, f64::INFINITY, 4.0);
            let boundary = Boundary::Periodic { size };
            let mut world = World::new(Settings::default().with_boundary(boundary)).unwrap();
            world.add_force(Gravity::new(DVec3::new(0.0, -G, 0.0))).unwrap();
            for tile in 0..10 {
                let place = DVec3::new(0.4 * f64::from(tile) - 1.8, -0.8, 0.3);
                let form = Shape::Box { size: DVec3::new(0.4, 0.4, 2.0) };
                let tile = Collider::new(form, Pose::at(place)).with_restitution(restitution);
                world.add_collider(tile).unwrap();
            }
            let velocity = DVec3::new(1.7, 0.0, 0.1);
            let ball = Sphere::new(start, 0.1).with_velocity(velocity);
            let id = world.add_sphere(ball).unwrap();
            let (mut impacts, mut events) = (0, 0);
            for _ in 0..128 {
                let report = world.step(1.0 / 64.0).unwrap();
                impacts += report.impacts.len();
                events += report.work.events;
            }
            let case = format!("restitution {restitution}, from {start}");
            assert_eq!(impacts, 0, "{case}");
            // An event for each tile, and one for each cell.
            assert!(events < 40, "{events} events, {case}");
            let after = world.sphere(id).unwrap();
            assert_eq!(after.velocity, velocity, "{case}");
            let moved = boundary.nearest_image(after.position - start - 2.0 * velocity);
            // Rounding, once for every seam.
            assert!(moved.length() < 1e-13, "{moved}, {case}");
        }
    }
}
