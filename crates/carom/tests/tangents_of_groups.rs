//! Derivatives through impacts of bodies that touch: against closed forms, against differences of runs, forwards and
//! backwards alike; changes that part what touches are refused.

mod common;

use carom::{
    Collider, DVec3, DerivativeError, Exact, Friction, Gravity, ImpactLaw, Pose, Rule, Settings,
    Shape, Sides, Sphere, SphereId, SphereTangent, Tangents, Tape, Variation, World,
};
use common::derivatives::{
    Followed, after, assert_agree_with_differences, assert_backwards_equals_forwards, follow,
    varied,
};
use common::{G, Numbers, vec};

/// A row of balls of radius 1/2 that touch, and one that flies towards it along x, in a world without anything else.
fn cradle(count: usize, masses: &[f64]) -> (World, Vec<SphereId>) {
    let mut world = World::default();
    let mut ball = |x: f64, vx: f64, mass: f64| {
        let sphere = Sphere::new(vec(x, 0.0, 0.0), 0.5).with_velocity(vec(vx, 0.0, 0.0));
        world.add_sphere(sphere.with_mass(mass)).unwrap()
    };
    let mut balls = vec![ball(-3.0, 1.0, masses[0])];
    balls.extend((0..count).map(|it| ball(it as f64, 0.0, masses[(it + 1) % masses.len()])));
    (world, balls)
}

/// A level table of cloth, balls of radius 0.03 that touch in a triangle, and one that rolls towards them.
fn rack(rows: usize, friction: Friction, of_balls: Friction, speed: f64) -> (World, Vec<SphereId>) {
    let mut world = World::default();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let cloth = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_restitution(0.5);
    world.add_collider(cloth.with_friction(friction)).unwrap();
    let sides = Sides { bottom: true, top: true, ..Sides::default() };
    let cushions = Shape::Container { size: vec(3.0, 1.0, 1.5), open: sides };
    let cushions = Collider::new(cushions, Pose::at(vec(0.0, 0.3, 0.0)));
    world.add_collider(cushions.with_restitution(0.8)).unwrap();
    let radius = 0.03125;
    let ball = |x: f64, z: f64| {
        let sphere = Sphere::new(vec(x, radius, z), radius).with_restitution(0.95);
        sphere.with_mass(0.17).with_friction(of_balls)
    };
    let cue = ball(-0.6, 0.011)
        .with_velocity(vec(speed, 0.0, -0.012 * speed))
        .with_angular_velocity(vec(0.0, 0.0, -speed / radius));
    let mut balls = vec![world.add_sphere(cue).unwrap()];
    let across = 3.0_f64.sqrt() * radius;
    for row in 0..rows {
        for place in 0..=row {
            let z = radius * (2.0 * place as f64 - row as f64);
            balls.push(world.add_sphere(ball(across * row as f64, z)).unwrap());
        }
    }
    (world, balls)
}

#[test]
fn a_cradle_passes_the_derivative_of_its_ball_to_the_last_one() {
    for count in 2..6 {
        let (mut world, balls) = cradle(count, &[1.0]);
        let direction = Variation::default()
            .with_velocity(balls[0], vec(1.0, 0.25, 0.0))
            .with_position(balls[0], vec(0.5, 0.0, 0.0));
        let mut tangents = Tangents::new(&world, vec![direction]).unwrap();
        let mut tape = Tape::start(&world.clone()).unwrap();
        let mut recorded = world.clone();
        for _ in 0..4 {
            tangents.step(&mut world, 1.0).unwrap();
            tape.step(&mut recorded, 1.0).unwrap();
        }
        // The last ball leaves after 2 s with what the first one brought.
        let last = tangents.sphere(0, balls[count]).unwrap();
        assert!((last.velocity.x - 1.0).abs() < 1e-12, "{last:?}");
        assert!((last.position.x - 4.5).abs() < 1e-12, "{last:?}");
        // Off the line of centres the second ball of the row takes the velocity along its own line: with the offset
        // 1/4 t at the impact after 2 s and the distance 1 of the centres, across the line the first one keeps it all.
        let second = tangents.sphere(0, balls[1]).unwrap();
        let first = tangents.sphere(0, balls[0]).unwrap();
        assert!((first.velocity.y - (0.25 + 0.5)).abs() < 1e-12, "{first:?}");
        let passed = if count > 1 { -0.5 } else { 0.0 };
        assert!((second.velocity.y - passed).abs() < 1e-12, "{second:?}");
        let margin = tape.margin();
        assert_eq!((margin.interval, margin.closest.is_some()), (0.0, true));
        let by = SphereTangent { velocity: DVec3::X, ..SphereTangent::default() };
        let gradient = tape.gradient(&[(balls[count], by)]).unwrap();
        assert!((gradient.sphere(balls[0]).velocity.x - 1.0).abs() < 1e-12);
    }
}

#[test]
fn groups_under_other_impact_laws_are_refused() {
    for law in [ImpactLaw::Sequential, ImpactLaw::Simultaneous] {
        let (mut world, balls) = cradle(3, &[1.0]);
        let rule = Rule::Exact(Exact::default().with_impact_law(law));
        world.set_settings(Settings::default().with_rule(rule)).unwrap();
        let mut tape = Tape::start(&world).unwrap();
        let error = tape.step(&mut world, 4.0).unwrap_err();
        let DerivativeError::Simultaneous { sphere, time } = error else { panic!("{error}") };
        assert!(balls.contains(&sphere) && time == 2.0, "{law}: {error}");
    }
}

#[test]
fn changes_that_part_what_touches_are_refused() {
    let changes: [fn(SphereId) -> Variation; 4] = [
        |ball| Variation::default().with_position(ball, DVec3::X),
        |ball| Variation::default().with_velocity(ball, DVec3::X),
        |ball| {
            let mut change = Variation::default();
            change.sphere_mut(ball).radius = 0.1;
            change
        },
        |ball| {
            let mut change = Variation::default();
            change.sphere_mut(ball).mass = 1.0;
            change
        },
    ];
    for (number, change) in changes.into_iter().enumerate() {
        let (mut world, balls) = cradle(3, &[1.0]);
        let mut tangents = Tangents::new(&world, vec![change(balls[2])]).unwrap();
        let error = tangents.step(&mut world, 4.0).unwrap_err();
        assert!(
            matches!(error, DerivativeError::Simultaneous { time, .. } if time == 2.0),
            "{number}: {error}"
        );
        assert_eq!(tangents.step(&mut world, 1.0).unwrap_err(), error);
    }
    // The whole row may be shifted, along itself and across, and all balls may be heavier.
    let (mut world, balls) = cradle(3, &[1.0]);
    let mut direction = Variation::default();
    for &ball in &balls {
        direction.sphere_mut(ball).mass = 1.0;
    }
    balls[1..].iter().for_each(|&ball| direction.sphere_mut(ball).position = vec(1.0, 0.5, 0.0));
    let mut tangents = Tangents::new(&world, vec![direction]).unwrap();
    tangents.step(&mut world, 4.0).unwrap();
    let last = tangents.sphere(0, balls[3]).unwrap();
    assert!(last.position.x.abs() < 1e-12, "{last:?}");
}

#[test]
fn a_break_agrees_with_differences_of_runs_and_with_the_gradient() {
    let cloth = Friction::sliding(0.2).with_rolling(0.02).with_spinning(0.03);
    let (smooth, rough) = (Friction::default(), Friction::sliding(0.06));
    // Rounding over the step. Balls that rub on each other hop, and the world ends their bounces a bit early.
    let cases = [
        (1, smooth, smooth, 2e-9),
        (2, smooth, smooth, 2e-9),
        (2, cloth, smooth, 2e-9),
        (1, cloth, rough, 1e-5),
        (2, cloth, rough, 1e-5),
        (4, cloth, smooth, 2e-9),
    ];
    let mut numbers = Numbers(5);
    for (number, (rows, friction, of_balls, part)) in cases.into_iter().enumerate() {
        let (world, balls) = rack(rows, friction, of_balls, 2.0);
        let flat = vec(1.0, 0.0, 1.0);
        let mut direction = Variation::default()
            .with_position(balls[0], 0.1 * flat * numbers.vector())
            .with_velocity(balls[0], flat * numbers.vector())
            .with_angular_velocity(balls[0], numbers.vector());
        direction.sphere_mut(balls[0]).mass = 0.1;
        let Followed { tangents, tape, .. } = follow(&world, &direction, 4);
        assert!(tape.impacts() > 0, "{number}");
        assert_backwards_equals_forwards((&tangents, &tape), &direction, &balls, &mut numbers);
        let end = |by| after(varied(&world, &direction, by, None), 4);
        assert_agree_with_differences(&tangents, &balls, [1e-6, part], end);
    }
}
