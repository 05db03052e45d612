//! The rule `discrete`, contact by contact, as the course defines it.

mod common;

use carom::{
    BodyPair, Collider, DQuat, DVec3, Gravity, Pose, Settings, Shape, Sphere, SphereId, World,
};
use common::{assert_close, assert_close_vec, discrete, vec, world};

const PLATE: Shape = Shape::Rectangle { size_x: 4.0, size_z: 2.0 };

fn world_around(collider: Collider) -> World {
    let mut world = world(discrete());
    world.add_collider(collider).unwrap();
    world
}

/// Adds a ball of radius 1/2 and takes one step of 1/8 s.
fn throw(world: &mut World, position: DVec3, velocity: DVec3) -> (SphereId, Sphere) {
    let id = world.add_sphere(Sphere::new(position, 0.5).with_velocity(velocity)).unwrap();
    world.step(0.125).unwrap();
    (id, world.sphere(id).unwrap())
}

#[test]
fn a_face_reflects_with_its_restitution_and_puts_the_sphere_onto_it() {
    let mut world = world_around(Collider::new(PLATE, Pose::at(DVec3::ZERO)).with_restitution(0.5));
    let (id, ball) = throw(&mut world, vec(1.0, 0.75, 0.5), vec(2.0, -4.0, 0.0));
    // The centre would be at 0.25: put back to one radius above the face.
    assert_eq!(ball.position, vec(1.25, 0.5, 0.5));
    assert_eq!(ball.velocity, vec(2.0, 2.0, 0.0));
    let [impact] = world.report().impacts[..] else { panic!("one impact") };
    assert_eq!((impact.time, impact.approach_speed, impact.impulse), (0.125, 4.0, 6.0));
    assert_eq!((impact.point, impact.normal), (vec(1.25, 0.0, 0.5), DVec3::Y));
    assert!(matches!(impact.between, BodyPair::Collider { sphere, .. } if sphere == id));
}

#[test]
fn touching_a_face_is_contact_and_touching_a_sphere_is_not() {
    let mut world = world_around(Collider::new(PLATE, Pose::at(DVec3::ZERO)));
    let (_, ball) = throw(&mut world, vec(0.0, 1.0, 0.0), vec(0.0, -4.0, 0.0));
    assert_eq!(ball.velocity.y, 4.0);

    let mut world =
        world_around(Collider::new(Shape::Sphere { radius: 1.0 }, Pose::at(DVec3::ZERO)));
    let (_, ball) = throw(&mut world, vec(0.0, 2.0, 0.0), vec(0.0, -4.0, 0.0));
    assert_eq!(ball.velocity.y, -4.0);
}

#[test]
fn from_underneath_nothing_collides() {
    let mut world = world_around(Collider::new(PLATE, Pose::at(DVec3::ZERO)));
    let (_, ball) = throw(&mut world, vec(0.0, -0.625, 0.0), vec(0.0, 4.0, 0.0));
    assert_eq!((ball.position.y, ball.velocity.y), (-0.125, 4.0));
    assert!(world.report().impacts.is_empty());
}

#[test]
fn an_edge_reflects_along_the_direction_to_the_centre() {
    let mut world = world_around(Collider::new(PLATE, Pose::at(DVec3::ZERO)));
    // Ends at (2.24, 0.32, 0): 0.4 from the edge at x = 2, in the direction (0.6, 0.8, 0).
    let start = vec(2.24, 0.32 + 0.5, 0.0);
    let (_, ball) = throw(&mut world, start, vec(0.0, -4.0, 0.0));
    let normal = vec(0.6, 0.8, 0.0);
    assert_close_vec(ball.position, vec(2.0, 0.0, 0.0) + 0.5 * normal, 1e-15);
    assert_close_vec(ball.velocity, vec(0.0, -4.0, 0.0) + 6.4 * normal, 1e-14);
}

#[test]
fn a_corner_reflects_along_the_direction_to_the_centre() {
    let mut world = world_around(Collider::new(PLATE, Pose::at(DVec3::ZERO)));
    let normal = vec(2.0, 2.0, 1.0) / 3.0;
    let corner = vec(2.0, 0.0, 1.0);
    let velocity = vec(0.0, -4.0, 0.0);
    let (_, ball) = throw(&mut world, corner + 0.3 * normal - 0.125 * velocity, velocity);
    assert_close_vec(ball.position, corner + 0.5 * normal, 1e-15);
    assert_close_vec(ball.velocity, velocity - 2.0 * velocity.dot(normal) * normal, 1e-14);
}

#[test]
fn beyond_a_corner_there_is_nothing() {
    let mut world = world_around(Collider::new(PLATE, Pose::at(DVec3::ZERO)));
    // Within the radius of both edges' lines, but not of the corner.
    let (_, ball) = throw(&mut world, vec(2.4, 0.5, 1.4), vec(0.0, -4.0, 0.0));
    assert_eq!(ball.velocity.y, -4.0);
}

#[test]
fn a_turned_rectangle_reflects_about_its_turned_normal() {
    // 45 degrees about z, given with a length that is not 1.
    let rotation = DQuat::from_xyzw(0.0, 0.0, 0.5_f64.sqrt() - 0.5, 0.5) * 3.0;
    let mut world = world_around(Collider::new(PLATE, Pose::at(DVec3::ZERO).rotated(rotation)));
    let normal = rotation.normalize() * DVec3::Y;
    let (_, ball) = throw(&mut world, 0.9 * normal, -4.0 * normal);
    assert_close_vec(ball.velocity, 4.0 * normal, 1e-14);
    assert_close_vec(ball.position, 0.5 * normal, 1e-14);
}

#[test]
fn a_fixed_sphere_reflects_and_leaves_the_position_alone() {
    let fixed = Collider::new(Shape::Sphere { radius: 1.0 }, Pose::at(vec(1.0, 0.0, 0.0)));
    let mut world = world_around(fixed.with_restitution(0.2));
    let (_, ball) = throw(&mut world, vec(1.0, 1.75, 0.0), vec(1.0, -4.0, 0.0));
    let normal = vec(0.125, 1.25, 0.0).normalize();
    assert_eq!(ball.position, vec(1.125, 1.25, 0.0));
    let velocity = vec(1.0, -4.0, 0.0);
    assert_close_vec(ball.velocity, velocity - 1.2 * velocity.dot(normal) * normal, 1e-14);
}

#[test]
fn a_later_collider_sees_what_an_earlier_one_made_of_the_sphere() {
    // A corner of two walls: the floor moves the sphere up, out of reach of a low second plate.
    let mut world = world_around(Collider::new(PLATE, Pose::at(vec(0.0, 0.0, 0.0))));
    world.add_collider(Collider::new(PLATE, Pose::at(vec(0.0, -0.2, 0.0)))).unwrap();
    throw(&mut world, vec(0.0, 0.6, 0.0), vec(0.0, -4.0, 0.0));
    assert_eq!(world.report().impacts.len(), 1);

    // Put up by the first, the sphere reaches a second that it did not touch before.
    let mut world = world_around(Collider::new(PLATE, Pose::at(vec(0.0, 0.0, 0.0))));
    let ceiling = Pose::at(vec(0.0, 0.95, 0.0)).rotated(DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0));
    world.add_collider(Collider::new(Shape::HalfSpace, ceiling)).unwrap();
    let (_, ball) = throw(&mut world, vec(0.0, 0.7, 0.0), vec(0.0, -4.0, 0.0));
    assert_eq!(world.report().impacts.len(), 2);
    assert_close(ball.velocity.y, -4.0, 1e-15);
}

#[test]
fn a_trigger_reports_and_deflects_nothing() {
    let trigger = Collider::new(PLATE, Pose::at(DVec3::ZERO)).as_trigger();
    let mut world = world_around(trigger);
    let (id, ball) = throw(&mut world, vec(0.0, 0.9, 0.0), vec(0.0, -4.0, 0.0));
    assert_eq!((ball.position.y, ball.velocity.y), (0.4, -4.0));
    assert!(world.report().impacts.is_empty());
    let [contact] = world.report().triggers[..] else { panic!("one trigger contact") };
    assert_eq!((contact.sphere, contact.collider.number()), (id, 0));
}

#[test]
fn a_box_bounces_on_each_of_its_six_faces() {
    let size = vec(1.0, 2.0, 3.0);
    for normal in [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z] {
        let mut world = world_around(Collider::new(Shape::Box { size }, Pose::at(DVec3::ONE)));
        let height = 0.5 * size.dot(normal.abs());
        let (_, ball) = throw(&mut world, DVec3::ONE + (height + 0.75) * normal, -4.0 * normal);
        assert_eq!(ball.velocity, 4.0 * normal);
        assert_close_vec(ball.position, DVec3::ONE + (height + 0.5) * normal, 1e-15);
    }
}

#[test]
fn a_trigger_box_reports_a_sphere_once_at_its_edge_and_inside() {
    let size = vec(4.0, 4.0, 4.0);
    let trigger = Collider::new(Shape::Box { size }, Pose::at(DVec3::ZERO)).as_trigger();
    for (position, inside) in
        [(vec(2.3, 2.3, 0.0), true), (vec(0.1, 0.3, 0.2), true), (vec(2.4, 2.4, 0.0), false)]
    {
        let mut world = world_around(trigger.clone());
        throw(&mut world, position, DVec3::ZERO);
        assert_eq!(world.report().triggers.len(), usize::from(inside), "{position}");
    }
}

#[test]
fn spheres_collide_unless_the_scene_says_no() {
    for spheres_collide in [true, false] {
        let settings =
            Settings::default().with_rule(discrete()).with_spheres_collide(spheres_collide);
        let mut world = World::new(settings).unwrap();
        let left = Sphere::new(vec(-0.5, 0.0, 0.0), 0.5).with_velocity(vec(1.0, 0.0, 0.0));
        let left = world.add_sphere(left).unwrap();
        world.add_sphere(Sphere::new(vec(0.51, 0.0, 0.0), 0.5)).unwrap();
        world.step(0.125).unwrap();
        let expected = if spheres_collide { 0.0 } else { 1.0 };
        assert_eq!(world.sphere(left).unwrap().velocity.x, expected);
    }
}

#[test]
fn a_ball_stays_on_a_floor_it_rests_on() {
    let mut world = world_around(Collider::new(PLATE, Pose::at(DVec3::ZERO)).with_restitution(0.8));
    world.add_force(Gravity::new(vec(0.0, -9.81, 0.0))).unwrap();
    let ball = world.add_sphere(Sphere::new(vec(0.0, 0.5, 0.0), 0.5)).unwrap();
    for _ in 0..1000 {
        world.step(0.02).unwrap();
        // Gravity gives it g h in a frame; it hops off with 0.8 of that, for at most
        // (0.8 g h)^2 / 2 g + 0.8 g h^2 = 0.0044.
        assert!((0.5..0.5 + 0.0045).contains(&world.sphere(ball).unwrap().position.y));
    }
}
