//! Worlds with meshes that move, against worlds in which each sphere is tested against all of their surfaces.

use std::sync::Arc;

use glam::{DQuat, DVec3};

use super::World;
use crate::collider::{Collider, Shape};
use crate::collider_motion::{Keyframe, Keyframes, MotionPart};
use crate::forces::Gravity;
use crate::mesh::Mesh;
use crate::pose::Pose;
use crate::report::BodyPair;
use crate::settings::{Contact, Exact, Rule, Settings, Zones};
use crate::sphere::Sphere;

/// Numbers in [-1, 1) that look random, the same in every run (Knuth's MMIX generator).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.next(), self.next(), self.next())
    }

    fn motion(&mut self) -> MotionPart {
        let axis = self.vector() + 1.5 * DVec3::Y;
        let (pivot, frequency) = (self.vector(), 1.0 + 0.5 * self.next());
        match (2.0 * self.next() + 2.0) as u32 {
            3 => {
                let turned = DQuat::from_axis_angle(axis.normalize(), 0.5);
                let middle = Keyframe::at(0.4, 0.2 * self.vector()).rotated(turned);
                let ends = [0.0, 1.1].map(|time| Keyframe::at(time, DVec3::ZERO));
                let keyframes = Keyframes::new([ends[0], middle, ends[1]]).repeating();
                MotionPart::Keyframes(keyframes.about(pivot))
            }
            0 => MotionPart::Oscillate { axis, amplitude: 0.2, frequency, phase: self.next() },
            1 => MotionPart::Swing { axis, pivot, amplitude: 0.3, frequency, phase: self.next() },
            _ => MotionPart::Turn { axis, pivot, rate: 2.0 * self.next() },
        }
    }
}

/// Rough balls over a bowl of some hundred facets and a bar of boxes, all of which move.
fn random_world(numbers: &mut Numbers, rule: Rule) -> World {
    let mut world = World::new(Settings::default().with_rule(rule)).unwrap();
    world.add_force(Gravity::new(DVec3::new(0.0, -9.81, 0.0))).unwrap();
    let heights: Vec<Vec<f64>> = (-5i32..6)
        .map(|z| {
            let height = |x: i32| 0.03 * f64::from(x * x + z * z) + 0.05 * numbers.next();
            (-5i32..6).map(height).collect()
        })
        .collect();
    let mesh = Mesh::from_heights([2.0; 2], &heights).unwrap();
    let bowl = Collider::new(Shape::Mesh(mesh), Pose::at(DVec3::ZERO));
    let friction = numbers.next().max(0.0);
    let bowl = bowl.with_restitution(0.6).with_friction(friction).with_motion([numbers.motion()]);
    world.add_collider(bowl).unwrap();
    let velocity = 0.5 * numbers.vector();
    for _ in 0..3 {
        let place = 0.5 * numbers.vector() + 1.5 * DVec3::Y;
        let bar = Collider::new(Shape::Box { size: DVec3::new(0.4, 0.1, 0.2) }, Pose::at(place));
        world.add_collider(bar.moving(velocity, 2.0 * numbers.vector())).unwrap();
    }
    for number in 0..9 {
        let (x, z) = (0.4 * f64::from(number % 3 - 1), 0.4 * f64::from(number / 3 - 1));
        let center = DVec3::new(x, 0.9, z) + 0.05 * numbers.vector();
        let sphere = Sphere::new(center, 0.08).with_velocity(2.0 * numbers.vector());
        world.add_sphere(sphere.with_restitution(0.6).with_friction(friction)).unwrap();
    }
    world
}

#[test]
fn spheres_near_moving_meshes_go_the_same_way_as_where_all_surfaces_are_tested() {
    let mut numbers = Numbers(7);
    let mut impacts = 0;
    for case in 0..24 {
        let rule: Rule = match case % 3 {
            0 => Contact::default().into(),
            1 => Exact::default().into(),
            _ => Exact::default().with_zones(Zones::Automatic).with_contact_duration(1e-3).into(),
        };
        let mut world = random_world(&mut numbers, rule);
        let mut oracle = world.clone();
        Arc::make_mut(&mut oracle.state.colliders).find_moving_everywhere();
        for frame in 0..30 {
            impacts += world.step(1.0 / 60.0).unwrap().impacts.len();
            oracle.step(1.0 / 60.0).unwrap();
            assert_eq!(world.state_hash(), oracle.state_hash(), "case {case}, frame {frame}");
        }
    }
    assert!(impacts > 500, "{impacts}");
}

/// A gas in a box, of which one wall moves, about a plate that swings and a ball that turns about a pivot.
fn gas(numbers: &mut Numbers, case: usize) -> World {
    let mut world = World::new(Settings::default()).unwrap();
    let motion = numbers.motion();
    for (number, normal) in DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]).enumerate() {
        let turn = DQuat::from_rotation_arc(DVec3::Y, normal);
        let shape = match case % 2 {
            0 => Shape::HalfSpace,
            _ => Shape::Rectangle { size_x: 8.0, size_z: 8.0 },
        };
        let wall = Collider::new(shape, Pose::at(-3.0 * normal).rotated(turn));
        let wall = match (number, case / 2 % 3) {
            (0, 0) => {
                let (amplitude, frequency) = (0.2, 0.7);
                let axis = DVec3::X;
                wall.with_motion([MotionPart::Oscillate { axis, amplitude, frequency, phase: 0.0 }])
            }
            (0, 1) => wall.moving(0.1 * DVec3::X, DVec3::ZERO),
            (0, _) => wall.moving(DVec3::ZERO, DVec3::new(0.0, 0.02, 0.05)),
            _ => wall,
        };
        world.add_collider(wall).unwrap();
    }
    let plate = Shape::Box { size: DVec3::new(0.5, 0.1, 0.8) };
    world.add_collider(Collider::new(plate, Pose::at(DVec3::ZERO)).with_motion([motion])).unwrap();
    for number in 0..125 {
        let place = [number % 5, number / 5 % 5, number / 25].map(|it| f64::from(it) - 2.0);
        let sphere = Sphere::new(DVec3::from_array(place) + 0.5, 0.06);
        world.add_sphere(sphere.with_velocity(numbers.vector())).unwrap();
    }
    world
}

#[test]
fn a_gas_beside_walls_that_move_goes_the_same_way_as_where_each_sphere_is_near_them() {
    let mut numbers = Numbers(11);
    let mut at_colliders = 0;
    for case in 0..6 {
        let mut world = gas(&mut numbers, case);
        let mut oracle = world.clone();
        Arc::make_mut(&mut oracle.state.colliders).find_moving_everywhere();
        // Longer than spheres are found to be clear of what moves.
        for frame in 0..120 {
            let impacts = &world.step(1.0 / 60.0).unwrap().impacts;
            at_colliders +=
                impacts.iter().filter(|it| matches!(it.between, BodyPair::Collider { .. })).count();
            oracle.step(1.0 / 60.0).unwrap();
            assert_eq!(world.state_hash(), oracle.state_hash(), "case {case}, frame {frame}");
        }
    }
    assert!(at_colliders > 100, "{at_colliders}");
}
