//! Derivatives of balls that lie, slide, roll and stop on planes: against closed forms, against differences of runs,
//! forwards and backwards alike.

mod common;

use carom::{
    Collider, CombineRule, DQuat, DVec3, DerivativeError, Friction, Gravity, Pose, Settings, Shape,
    Sides, Sphere, SphereId, SphereTangent, Tangents, Tape, Variation, ViscousDrag, World,
};
use common::derivatives::{
    assert_agree_with_differences, assert_backwards_equals_forwards, varied,
};
use common::{G, Numbers, vec};

/// A level floor, and a ball on it that moves along x.
fn on_floor(friction: Friction, ball: Sphere) -> (World, SphereId) {
    let mut world = World::default();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_restitution(0.5);
    world.add_collider(floor.with_friction(friction)).unwrap();
    let ball = world.add_sphere(ball).unwrap();
    (world, ball)
}

#[test]
fn a_shot_that_slides_rolls_and_stops_has_the_derivatives_of_its_closed_form() {
    // With the slip s = v - r w, it slides for t = 2 s/(7 mu g), rolls with v - 2 s/7, and loses 5/7 mu_r g then
    // (Coriolis 1835).
    let (mu, rolling, radius) = (0.2, 0.05, 0.03);
    let place = |v: f64, spin: f64, mu: f64, g: f64, r: f64| {
        let slip = v - r * spin;
        let slides = 2.0 * slip / (7.0 * mu * g);
        let rolls = v - 2.0 * slip / 7.0;
        v * slides - 0.5 * mu * g * slides * slides
            + 0.5 * rolls * rolls / (5.0 / 7.0 * rolling * g)
    };
    let (v, spin) = (0.9, -4.0);
    let start = Sphere::new(vec(0.0, radius, 0.0), radius)
        .with_velocity(vec(v, 0.0, 0.0))
        .with_angular_velocity(vec(0.0, 0.0, -spin));
    let (mut world, ball) = on_floor(Friction::sliding(mu).with_rolling(rolling), start);
    let mut tape = Tape::start(&world).unwrap();
    for _ in 0..30 {
        tape.step(&mut world, 0.2).unwrap();
    }
    assert_eq!(world.sphere(ball).unwrap().velocity, DVec3::ZERO);
    let along = SphereTangent { position: DVec3::X, ..SphereTangent::default() };
    let gradient = tape.gradient(&[(ball, along)]).unwrap();
    let floor = world.colliders().next().unwrap().0;
    let h = 1e-4;
    let difference = |of: &dyn Fn(f64) -> f64| {
        (8.0 * (of(h) - of(-h)) - (of(2.0 * h) - of(-2.0 * h))) / (12.0 * h)
    };
    let by = gradient.sphere(ball);
    for (found, expected) in [
        (by.position.x, 1.0),
        (by.velocity.x, difference(&|d| place(v + d, spin, mu, G, radius))),
        (-by.angular_velocity.z, difference(&|d| place(v, spin + d, mu, G, radius))),
        (gradient.collider(floor).friction, difference(&|d| place(v, spin, mu + d, G, radius))),
        (-gradient.acceleration.y, difference(&|d| place(v, spin, mu, G + d, radius))),
        (by.radius, difference(&|d| place(v, spin, mu, G, radius + 0.1 * d)) / 0.1),
    ] {
        // The fourth power of the step times the fifth derivative, and rounding over the step.
        assert!((found - expected).abs() < 1e-9 * (1.0 + expected.abs()), "{found} {expected}");
    }
    // It does not matter where it is put, and it stays on the floor.
    assert_eq!((by.position.y, by.position.z, by.mass), (0.0, 0.0, 0.0));
}

#[test]
fn a_ball_that_bounces_to_rest_keeps_the_derivatives_along_the_floor() {
    let start = Sphere::new(vec(0.0, 1.0, 0.0), 0.25).with_velocity(vec(0.4, 0.0, -0.2));
    let (mut world, ball) = on_floor(Friction::default(), start);
    let mut tape = Tape::start(&world).unwrap();
    for _ in 0..4 {
        tape.step(&mut world, 1.0).unwrap();
    }
    let by = |tangent: SphereTangent| tape.gradient(&[(ball, tangent)]).unwrap();
    let along = by(SphereTangent { position: DVec3::X, ..SphereTangent::default() });
    assert!((along.sphere(ball).position - DVec3::X).length() < 1e-12);
    assert!((along.sphere(ball).velocity - 4.0 * DVec3::X).length() < 1e-12);
    // In the end its height is that of the floor, whatever it began with.
    let height = by(SphereTangent { position: DVec3::Y, ..SphereTangent::default() });
    let floor = world.colliders().next().unwrap().0;
    assert_eq!(height.sphere(ball).position, DVec3::ZERO);
    assert_eq!(height.sphere(ball).radius, 1.0);
    assert_eq!(height.collider(floor).position, DVec3::Y);
    assert_eq!(height.collider(floor).velocity, 4.0 * DVec3::Y);
}

/// A table with several balls that roll and spin, and cushions without friction; with one ball, without cushions.
fn table(number: u64, tilt: f64, count: usize) -> (World, Vec<SphereId>) {
    let mut numbers = Numbers(number);
    let settings = Settings::default().with_friction_combine_rule(CombineRule::Product);
    let mut world = World::new(settings).unwrap();
    let (sine, cosine) = (libm::sin(tilt), libm::cos(tilt));
    world.add_force(Gravity::new(G * vec(sine, -cosine, 0.3 * sine))).unwrap();
    let friction = Friction::sliding(0.2).with_rolling(0.02).with_spinning(0.03);
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_restitution(0.5);
    world.add_collider(floor.with_friction(friction)).unwrap();
    let sides = Sides { bottom: true, top: true, ..Sides::default() };
    let size = vec(2.0, 1.0, 1.4);
    let cushions = Shape::Container { size, open: sides };
    let cushions = Collider::new(cushions, Pose::at(vec(0.0, 0.2, 0.0)));
    if count > 1 {
        world.add_collider(cushions.with_restitution(0.8)).unwrap();
    }
    let mut balls: Vec<Sphere> = Vec::new();
    while balls.len() < count {
        let radius = 0.05;
        let place = vec(numbers.between(-0.9, 0.9), radius, numbers.between(-0.6, 0.6));
        if balls.iter().all(|it| (it.position - place).length() > 0.3) {
            let ball = Sphere::new(place, radius).with_mass(numbers.between(0.5, 2.0));
            balls.push(ball.with_restitution(0.95));
        }
    }
    for ball in balls.iter_mut().take(2) {
        let along = numbers.vector() * vec(1.0, 0.0, 1.0);
        ball.velocity = 1.5 * along;
        ball.angular_velocity = 20.0 * numbers.vector();
    }
    let ids = balls.into_iter().map(|ball| world.add_sphere(ball).unwrap()).collect();
    (world, ids)
}

/// A direction in which all balls stay on the table.
fn along_the_table(numbers: &mut Numbers, world: &World, balls: &[SphereId]) -> Variation {
    let flat = vec(1.0, 0.0, 1.0);
    // A pull along the table turns the slip, which runs follow less exactly.
    let axes = if balls.len() > 1 { DVec3::Y } else { DVec3::ONE };
    let mut direction = Variation::default().with_acceleration(axes * numbers.vector());
    for &ball in balls {
        let change = direction.sphere_mut(ball);
        change.position = flat * numbers.vector();
        if world.sphere(ball).unwrap().velocity != DVec3::ZERO {
            change.velocity = flat * numbers.vector();
            change.angular_velocity = numbers.vector();
        }
        change.mass = numbers.between(-1.0, 1.0);
        change.restitution = numbers.between(-0.2, 0.2);
    }
    for (place, (collider, it)) in world.colliders().enumerate() {
        let change = direction.collider_mut(collider);
        change.restitution = numbers.between(-0.2, 0.2);
        if place == 0 {
            change.friction = numbers.between(-0.1, 0.1);
        } else {
            assert!(it.friction.sliding.is_none());
            change.position = flat * numbers.vector();
        }
    }
    direction
}

/// Compares derivatives of balls on a table, tilted by an angle, with the gradient and with differences of runs, up to
/// this part. Returns the number of runs that it compared with differences, and of their impacts.
fn compare(tilt: f64, count: usize, step_and_part: [f64; 2]) -> (u32, usize) {
    let (mut compared, mut impacts) = (0, 0);
    for number in 0..60 {
        let (world, balls) = table(number, tilt, count);
        let (force, _) = world.forces().next().unwrap();
        let (sine, cosine) = (libm::sin(tilt), libm::cos(tilt));
        let gravity = (force, G * vec(sine, -cosine, 0.3 * sine));
        let mut numbers = Numbers(1000 + number);
        let direction = along_the_table(&mut numbers, &world, &balls);
        let (mut run, mut recorded) = (world.clone(), world.clone());
        let mut tangents = Tangents::new(&world, vec![direction.clone()]).unwrap();
        let mut tape = Tape::start(&world).unwrap();
        let followed = (0..6).try_for_each(|_| {
            tangents.step(&mut run, 0.25)?;
            tape.step(&mut recorded, 0.25)
        });
        if followed.is_err() {
            continue;
        }
        assert_backwards_equals_forwards((&tangents, &tape), &direction, &balls, &mut numbers);
        let margin = tangents.margin();
        if margin.directness < 0.1 || margin.interval < 1e-2 {
            continue;
        }
        impacts += tape.impacts();
        let end = |by| {
            let mut other = varied(&world, &direction, by, Some(gravity));
            for _ in 0..6 {
                other.step(0.25).unwrap();
            }
            other
        };
        assert_agree_with_differences(&tangents, &balls, step_and_part, end);
        compared += 1;
    }
    (compared, impacts)
}

#[test]
fn derivatives_on_a_billiards_table_agree_with_differences_of_runs_and_with_the_gradient() {
    // Rounding of 1e-16 over the step, and its fourth power times derivatives that impacts make large.
    let (compared, impacts) = compare(0.0, 4, [1e-5, 1e-8]);
    assert!(compared > 40 && impacts > 60, "{compared} {impacts}");
}

#[test]
fn derivatives_on_a_tilted_table_agree_with_differences_of_runs_and_with_the_gradient() {
    // Where slip and velocity turn, the world follows the path in pieces, to some 1e-7 of the way: over the step, 1e-4.
    let (compared, _) = compare(0.08, 1, [1e-3, 5e-4]);
    assert!(compared > 50, "{compared}");
}

#[test]
fn a_pull_across_the_slip_has_the_derivative_of_its_closed_form() {
    // A slip u = c (T - t) with w' = p - w/(T - t) across it: w = p (T - t) ln(T/(T - t)), and its integral to T is
    // p T²/4. Of the slip, the velocity of a solid ball has 2/7, of the pull 5/7; then the ball rolls.
    let (mu, speed, end) = (0.3, 1.2, 0.7);
    let start = Sphere::new(vec(0.0, 0.1, 0.0), 0.1).with_velocity(vec(speed, 0.0, 0.0));
    let (mut world, ball) = on_floor(Friction::sliding(mu), start);
    let mut tape = Tape::start(&world).unwrap();
    for _ in 0..5 {
        tape.step(&mut world, end / 5.0).unwrap();
    }
    let along = SphereTangent { position: DVec3::Z, ..SphereTangent::default() };
    let by = tape.gradient(&[(ball, along)]).unwrap();
    let slides = speed / (3.5 * mu * G);
    let left = end - slides;
    assert!(left > 0.0);
    let pull = 3.0 / 7.0 * slides * slides + 5.0 / 7.0 * slides * left + 5.0 / 14.0 * left * left;
    assert!((by.acceleration.z - pull).abs() < 1e-12, "{} {pull}", by.acceleration.z);
    // A velocity across turns the slip, and keeps 5/7 of itself.
    let across = slides - 2.0 / 7.0 * (0.5 * slides) + 5.0 / 7.0 * left;
    assert!((by.sphere(ball).velocity.z - across).abs() < 1e-12);
}

#[test]
fn a_ball_that_glides_under_drag_has_the_derivatives_of_its_closed_form() {
    // Without friction, x' = e^-ct; and a floor that begins to move lifts it, but does not take it along.
    let start =
        Sphere::new(vec(0.0, 0.5, 0.0), 0.5).with_velocity(vec(2.0, 0.0, 0.0)).with_mass(2.0);
    let (mut world, ball) = on_floor(Friction::default(), start);
    world.add_force(ViscousDrag::new(0.6)).unwrap();
    let mut tape = Tape::start(&world).unwrap();
    for _ in 0..5 {
        tape.step(&mut world, 0.5).unwrap();
    }
    let floor = world.colliders().next().unwrap().0;
    let along = SphereTangent { velocity: DVec3::X, ..SphereTangent::default() };
    let by = tape.gradient(&[(ball, along)]).unwrap();
    let decay = libm::exp(-0.3 * 2.5);
    assert!((by.sphere(ball).velocity - decay * DVec3::X).length() < 1e-13);
    assert!((by.acceleration.x - (1.0 - decay) / 0.3).abs() < 1e-13);
    // The drag rate is k/m.
    assert!((by.sphere(ball).mass - 2.0 * decay * 0.3 * 2.5 / 2.0).abs() < 1e-13);
    assert_eq!((by.acceleration.y, by.collider(floor).velocity.y), (0.0, 0.0));
    assert!(by.collider(floor).velocity.length() < 1e-13);
    let up = SphereTangent { position: DVec3::Y, ..SphereTangent::default() };
    let by = tape.gradient(&[(ball, up)]).unwrap();
    assert!((by.collider(floor).velocity - 2.5 * DVec3::Y).length() < 1e-13);
}

#[test]
fn what_lies_elsewhere_than_on_one_plane_is_refused() {
    let gravity = |x: f64| Gravity::new(vec(x, -G, 0.0));
    let refused = |world: &mut World, ball: SphereId| {
        let mut tape = Tape::start(world).unwrap();
        let error = (0..40).find_map(|_| tape.step(world, 0.05).err()).unwrap();
        assert!(
            matches!(error, DerivativeError::PersistentContact { sphere, .. } if sphere == ball),
            "{error}"
        );
    };
    // Along a rough groove.
    let mut world = World::default();
    world.add_force(gravity(-3.0)).unwrap();
    let wall = DQuat::from_rotation_z(-std::f64::consts::FRAC_PI_2);
    for pose in [Pose::at(DVec3::ZERO), Pose { rotation: wall, ..Pose::at(DVec3::ZERO) }] {
        let wall = Collider::new(Shape::HalfSpace, pose).with_friction(Friction::sliding(0.2));
        world.add_collider(wall).unwrap();
    }
    let ball = Sphere::new(vec(0.5, 0.5, 0.0), 0.5).with_velocity(vec(0.0, 0.0, 0.5));
    let ball = world.add_sphere(ball).unwrap();
    refused(&mut world, ball);
    // Slowly over the end of a table, so that it turns about its edge.
    for friction in [Friction::default(), Friction::sliding(0.2)] {
        let mut world = World::default();
        world.add_force(gravity(0.0)).unwrap();
        let table = Collider::new(Shape::Box { size: DVec3::ONE }, Pose::at(vec(0.0, -0.5, 0.0)));
        world.add_collider(table.with_friction(friction)).unwrap();
        let ball = Sphere::new(vec(0.3, 0.1, 0.0), 0.1).with_velocity(vec(0.5, 0.0, 0.0));
        let ball = world.add_sphere(ball).unwrap();
        refused(&mut world, ball);
    }
}

#[test]
fn derivatives_in_contact_have_the_units_of_the_world() {
    let by_start = |size: f64| {
        let radius = 0.03 * size;
        let start = Sphere::new(vec(0.0, radius, 0.0), radius)
            .with_velocity(size.sqrt() * vec(0.9, 0.0, 0.4))
            .with_angular_velocity(vec(3.0, 5.0, 8.0) / size.sqrt());
        let friction = Friction::sliding(0.2).with_rolling(0.05).with_spinning(0.1);
        let (mut world, ball) = on_floor(friction, start);
        let mut tape = Tape::start(&world).unwrap();
        (0..4).for_each(|_| tape.step(&mut world, 0.2 * size.sqrt()).unwrap());
        let along = SphereTangent { position: vec(1.0, 0.0, 1.0), ..SphereTangent::default() };
        let by = tape.gradient(&[(ball, along)]).unwrap().sphere(ball);
        by.velocity / size.sqrt()
    };
    let usual = by_start(1.0);
    for size in [f64::from(1 << 20), 1.0 / f64::from(1 << 20)] {
        let scaled = by_start(size);
        assert!((scaled - usual).length() < 1e-9 * usual.length(), "{scaled} {usual}");
    }
}
