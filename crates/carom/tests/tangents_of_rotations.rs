//! Derivatives by the rotation of colliders: against a closed form, against differences of runs, forwards and backwards
//! alike.

mod common;

use carom::{
    Collider, DQuat, DVec3, DerivativeError, Friction, Gravity, Pose, Shape, Sphere, SphereTangent,
    Tangents, Tape, Variation, World,
};
use common::derivatives::{
    Followed, after, assert_agree_with_differences, assert_backwards_equals_forwards, follow,
    varied,
};
use common::{G, Numbers, vec};

#[test]
fn a_ramp_that_turns_sends_a_ball_elsewhere_by_twice_the_angle() {
    // A ball falls with v onto a ramp of 45 degrees, at its pivot: it leaves along x, and turned by an angle, by
    // twice that upwards.
    let mut world = World::default();
    let eighth = DQuat::from_rotation_z(-std::f64::consts::FRAC_PI_4);
    let pose = Pose { rotation: eighth, ..Pose::at(DVec3::ZERO) };
    let ramp = world.add_collider(Collider::new(Shape::HalfSpace, pose)).unwrap();
    let half = 0.5_f64.sqrt();
    let start = Sphere::new(vec(half, half + 2.0, 0.0), 1.0).with_velocity(vec(0.0, -2.0, 0.0));
    let ball = world.add_sphere(start).unwrap();
    let mut tape = Tape::start(&world).unwrap();
    tape.step(&mut world, 3.0).unwrap();
    let by = SphereTangent { velocity: vec(0.0, 1.0, 0.0), ..SphereTangent::default() };
    let gradient = tape.gradient(&[(ball, by)]).unwrap();
    assert!((gradient.collider(ramp).rotation.z - 4.0).abs() < 1e-12, "{gradient:?}");
    assert!(gradient.collider(ramp).rotation.truncate().length() < 1e-12);
}

#[test]
fn turned_colliders_agree_with_differences_of_runs_and_with_the_gradient() {
    let mut impacts = 0;
    for number in 0..24 {
        let mut numbers = Numbers(number);
        let mut world = World::default();
        world.add_force(Gravity::new(vec(0.1, -G, 0.2))).unwrap();
        let shapes = [
            Shape::HalfSpace,
            Shape::Box { size: vec(3.0, 0.4, 3.0) },
            Shape::Cylinder { radius: 0.5, height: 1.0 },
            Shape::Sphere { radius: 0.6 },
        ];
        let shape = shapes[number as usize % 4].clone();
        let rotation = DQuat::from_scaled_axis(0.3 * numbers.vector());
        let pose = Pose { rotation, ..Pose::at(0.2 * numbers.vector()) };
        let ramp = Collider::new(shape, pose).with_restitution(0.8);
        let ramp = world.add_collider(ramp.with_friction(Friction::sliding(0.3))).unwrap();
        let spin = 5.0 * numbers.vector();
        let start = Sphere::new(vec(0.1, 1.5, -0.05), 0.1).with_angular_velocity(spin);
        let ball = world.add_sphere(start).unwrap();
        let mut direction = Variation::default().with_velocity(ball, numbers.vector());
        direction.collider_mut(ramp).rotation = numbers.vector();
        direction.collider_mut(ramp).position = 0.1 * numbers.vector();
        let Followed { tangents, tape, .. } = follow(&world, &direction, 6);
        impacts += tape.impacts();
        assert_backwards_equals_forwards((&tangents, &tape), &direction, &[ball], &mut numbers);
        let end = |by| after(varied(&world, &direction, by, None), 6);
        // Rounding over the step, and its fourth power.
        assert_agree_with_differences(&tangents, &[ball], [1e-4, 1e-8], end);
    }
    assert!(impacts > 20, "{impacts}");
}

#[test]
fn rotations_of_what_bears_a_ball_or_moves_are_refused() {
    let mut world = World::default();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let floor = world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO))).unwrap();
    let ball = world.add_sphere(Sphere::new(vec(0.0, 0.5, 0.0), 0.5)).unwrap();
    let mut direction = Variation::default();
    direction.collider_mut(floor).rotation = DVec3::Z;
    let mut tangents = Tangents::new(&world, vec![direction.clone()]).unwrap();
    let mut tape = Tape::start(&world).unwrap();
    let error = tangents.step(&mut world.clone(), 0.1).unwrap_err();
    assert!(matches!(error, DerivativeError::Unsupported(_)), "{error}");
    tape.step(&mut world, 0.1).unwrap();
    let by = SphereTangent { position: DVec3::X, ..SphereTangent::default() };
    assert!(tape.gradient(&[(ball, by)]).unwrap().collider(floor).rotation.x.is_nan());
    let moving =
        Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).moving(DVec3::X, DVec3::ZERO);
    world.set_collider(floor, moving).unwrap();
    assert!(Tangents::new(&world, vec![direction]).is_err());
}
