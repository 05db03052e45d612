//! Groups: bodies collide only if each is in a group that the other collides with, under every rule, for
//! triggers and for queries.

mod common;

use carom::{
    Body, Boundary, Collider, Contact, DQuat, DVec3, Gravity, Groups, Pose, QueryFilter, Rule,
    Settings, Shape, Sides, Sphere, World,
};
use common::{Numbers, assert_close_vec, bisect, discrete, vec};

const RED: Groups = Groups { groups: 0b01, collides_with: 0b01 };
const BLUE: Groups = Groups { groups: 0b10, collides_with: 0b10 };

fn rules() -> [Rule; 4] {
    [Rule::default(), Rule::Contact(Contact::default()), bisect(), discrete()]
}

fn world(rule: Rule) -> World {
    World::new(Settings::default().with_rule(rule)).unwrap()
}

#[test]
fn two_kinds_in_one_box_move_as_each_kind_alone() {
    for rule in rules() {
        let run = |kinds: &[Groups]| {
            let mut world = world(rule);
            world.add_force(Gravity::new(vec(0.0, -9.81, 0.0))).unwrap();
            let shape = Shape::Container { size: DVec3::splat(2.0), open: Sides::NONE };
            let walls = Collider::new(shape, Pose::at(DVec3::ZERO)).with_restitution(0.8);
            let all = Groups { groups: 0b11, collides_with: 0b11 };
            world.add_collider(walls.with_groups(all)).unwrap();
            let mut numbers = Numbers(1);
            for number in 0..24 {
                let sphere = Sphere::new(0.85 * numbers.vector(), 0.1);
                let sphere = sphere.with_velocity(2.0 * numbers.vector());
                let kind = [RED, BLUE][number % 2];
                if kinds.contains(&kind) {
                    world.add_sphere(sphere.with_groups(kind).with_restitution(0.9)).unwrap();
                }
            }
            for _ in 0..40 {
                world.step(1.0 / 60.0).unwrap();
            }
            world
        };
        let both = run(&[RED, BLUE]);
        for kind in [RED, BLUE] {
            let alone = run(&[kind]);
            let of_kind = both.spheres().ids().iter().map(|&id| both.sphere(id).unwrap());
            let of_kind = of_kind.filter(|sphere| sphere.groups == kind);
            for (sphere, &position) in of_kind.zip(alone.spheres().positions()) {
                // Under `contact` sweeps take contacts in another order.
                let tolerance = if matches!(rule, Rule::Contact(_)) { 1e-6 } else { 1e-12 };
                assert_close_vec(sphere.position, position, tolerance);
            }
        }
    }
}

#[test]
fn a_ball_falls_through_a_floor_of_another_group() {
    for rule in rules() {
        let mut world = world(rule);
        world.add_force(Gravity::new(vec(0.0, -10.0, 0.0))).unwrap();
        for (height, groups) in [(0.0, BLUE), (-3.0, RED)] {
            let floor = Collider::new(Shape::HalfSpace, Pose::at(vec(0.0, height, 0.0)));
            world.add_collider(floor.with_restitution(0.0).with_groups(groups)).unwrap();
        }
        let ball = world.add_sphere(Sphere::new(vec(0.0, 1.0, 0.0), 0.1).with_groups(RED)).unwrap();
        for _ in 0..180 {
            world.step(1.0 / 60.0).unwrap();
        }
        assert_close_vec(world.sphere(ball).unwrap().position, vec(0.0, -2.9, 0.0), 1e-3);
        assert!(world.overlaps(1e-3).is_empty());
    }
}

#[test]
fn groups_hold_in_a_crowd_and_in_a_periodic_box() {
    let size = DVec3::splat(4.0);
    let settings = Settings::default().with_boundary(Boundary::Periodic { size });
    let mut world = World::new(settings).unwrap();
    let mut numbers = Numbers(5);
    // Two lattices in each other, at a packing fraction of 0.45 together.
    for number in 0..432 {
        let cell = [number / 2 % 6, number / 12 % 6, number / 72];
        let shift = if number % 2 == 0 { 0.0 } else { 0.2 };
        let place =
            DVec3::from_array(cell.map(|it| (f64::from(it) + 0.5) * (4.0 / 6.0) - 2.0 + shift));
        let sphere = Sphere::new(place, 0.25).with_velocity(numbers.vector());
        world.add_sphere(sphere.with_groups([RED, BLUE][number as usize % 2])).unwrap();
    }
    let (energy, mut impacts) = (world.kinetic_energy(), 0);
    for _ in 0..20 {
        let report = world.step(0.05).unwrap();
        impacts += report.impacts.len();
        for impact in &report.impacts {
            let carom::BodyPair::Spheres(first, second) = impact.between else { panic!() };
            assert_eq!(first.number() % 2, second.number() % 2);
        }
    }
    assert!(impacts > 500, "{impacts}");
    assert!((world.kinetic_energy() - energy).abs() < 1e-12 * energy);
    assert!(world.overlaps(1e-9).is_empty());
}

#[test]
fn triggers_see_and_queries_find_what_their_groups_say() {
    for rule in rules() {
        let mut world = world(rule);
        let gate = Collider::new(Shape::Box { size: DVec3::ONE }, Pose::at(DVec3::ZERO));
        world.add_collider(gate.as_trigger().with_groups(BLUE)).unwrap();
        let [red, blue] = [RED, BLUE].map(|groups| {
            let sphere = Sphere::new(vec(-1.0, 0.0, 0.0), 0.1).with_groups(groups);
            world.add_sphere(sphere.with_velocity(DVec3::X)).unwrap()
        });
        let mut seen = Vec::new();
        for _ in 0..12 {
            let report = world.step(0.1).unwrap();
            seen.extend(report.sensor_events.iter().map(|it| it.sphere));
            assert!(report.triggers.iter().all(|it| it.sphere == blue));
        }
        assert_eq!(seen, [blue], "{rule:?}");
        let find = |groups: Groups| {
            let filter = QueryFilter::default().with_groups(groups);
            let hit = world.cast_ray(vec(-5.0, 0.0, 0.0), vec(9.0, 0.0, 0.0), &filter).unwrap();
            hit.map(|hit| hit.body)
        };
        assert_eq!(find(BLUE), Some(Body::Sphere(blue)));
        assert_eq!(find(RED), Some(Body::Sphere(red)));
        assert_eq!(find(Groups { groups: 0b100, collides_with: 0b100 }), None);
    }
}

#[test]
fn one_sided_masks_do_not_collide_and_changes_count_at_once() {
    for rule in rules() {
        let mut world = world(rule);
        let shy = Groups { groups: 0b01, collides_with: 0 };
        let wall = Pose::at(vec(2.0, 0.0, 0.0)).rotated(DQuat::from_rotation_z(1.0));
        let wall = Collider::new(Shape::HalfSpace, wall);
        let wall = wall.with_pose(
            Pose::at(vec(2.0, 0.0, 0.0)).rotated(DQuat::from_rotation_arc(DVec3::Y, DVec3::NEG_X)),
        );
        world.add_collider(wall).unwrap();
        let ball = Sphere::new(DVec3::ZERO, 0.5).with_velocity(DVec3::X).with_groups(shy);
        let ball = world.add_sphere(ball).unwrap();
        let mut sphere = world.sphere(ball).unwrap();
        world.step(0.5).unwrap();
        sphere.groups = Groups::DEFAULT;
        sphere.position = world.sphere(ball).unwrap().position;
        world.set_sphere(ball, sphere).unwrap();
        for _ in 0..60 {
            world.step(1.0 / 30.0).unwrap();
        }
        assert!(world.sphere(ball).unwrap().velocity.x < 0.0, "{rule:?}");
    }
}

#[test]
fn user_data_stays_with_its_body() {
    let mut world = World::default();
    let first = world.add_sphere(Sphere::new(DVec3::ZERO, 0.1)).unwrap();
    let second = Sphere::new(DVec3::X, 0.1).with_user_data(u64::MAX);
    let second = world.add_sphere(second).unwrap();
    let wall = Collider::new(Shape::HalfSpace, Pose::at(vec(0.0, -9.0, 0.0))).with_user_data(7);
    let wall = world.add_collider(wall).unwrap();
    let hash = world.state_hash();
    world.remove_sphere(first).unwrap();
    assert_eq!(world.sphere(second).unwrap().user_data, u64::MAX);
    assert_eq!(world.collider(wall).unwrap().user_data, 7);
    let mut changed = world.sphere(second).unwrap();
    changed.user_data = 3;
    let before = world.state_hash();
    world.set_sphere(second, changed).unwrap();
    assert_ne!(hash, before);
    assert_eq!(world.state_hash(), before, "it is no part of the state");
}

#[test]
fn an_impulse_beside_the_centre_turns_a_ball_and_adds_its_work() {
    let mut world = World::default();
    let ball = world.add_sphere(Sphere::new(vec(1.0, 2.0, 3.0), 0.5).with_mass(3.0)).unwrap();
    let (impulse, point) = (vec(0.0, 0.0, 6.0), vec(1.5, 2.0, 3.0));
    world.apply_impulse_at(ball, impulse, point).unwrap();
    let sphere = world.sphere(ball).unwrap();
    // v = J / m, ω = r × J / (2/5 m r²).
    assert_close_vec(sphere.velocity, vec(0.0, 0.0, 2.0), 1e-15);
    assert_close_vec(sphere.angular_velocity, vec(0.0, -10.0, 0.0), 1e-14);
    world.set_angular_velocity(ball, vec(1.0, 0.0, 0.0)).unwrap();
    assert_eq!(world.sphere(ball).unwrap().angular_velocity, DVec3::X);
    assert!(world.set_angular_velocity(ball, DVec3::NAN).is_err());
    assert!(world.apply_impulse_at(ball, DVec3::NAN, point).is_err());
    assert_eq!(world.sphere(ball).unwrap().velocity, sphere.velocity);
}
