//! Derivatives through impacts: against closed forms, against differences of runs, forwards and backwards alike.

mod common;

use std::ops::Range;

use carom::{
    Boundary, Collider, ConstantForce, DVec3, DerivativeError, Force, Friction, Gravity,
    LinearForce, MotionPart, Pose, Settings, Shape, Sides, Sphere, SphereId, SphereState,
    SphereTangent, SphereVariation, Spring, Tangents, Tape, Variation, ViscousDrag, World,
};
use common::derivatives::{
    Followed, after, assert_backwards_equals_forwards, follow, off_differences, varied,
};
use common::{G, Numbers, vec};

/// Two balls head-on along x, in a world without anything else.
fn head_on(restitution: f64) -> (World, [SphereId; 2]) {
    let mut world = World::default();
    let ball = |x: f64, vx: f64| {
        let sphere = Sphere::new(vec(x, 0.0, 0.0), 0.5).with_velocity(vec(vx, 0.0, 0.0));
        sphere.with_restitution(restitution)
    };
    let first = world.add_sphere(ball(-2.0, 1.0)).unwrap();
    let second = world.add_sphere(ball(0.0, 0.0)).unwrap();
    (world, [first, second])
}

#[test]
fn elastic_balls_head_on_exchange_their_derivatives() {
    // The place of each ball at the end, by the place and velocity of the other at the start: exactly 1 and the
    // time; by its own: 0 (nimblephysics, issue 97, asks for this).
    let (mut world, balls) = head_on(1.0);
    let mut tape = Tape::start(&world).unwrap();
    tape.step(&mut world, 3.0).unwrap();
    let along = SphereTangent { position: DVec3::X, ..SphereTangent::default() };
    let gradient = tape.gradient(&[(balls[1], along)]).unwrap();
    let by = balls.map(|ball| gradient.sphere(ball));
    // The second ball is where the first would be without an impact, a diameter ahead.
    assert!((by[0].position.x - 1.0).abs() < 1e-12 && by[1].position.x.abs() < 1e-12);
    assert!((by[0].velocity.x - 3.0).abs() < 1e-12 && by[1].velocity.x.abs() < 1e-12);
    assert!((by.map(|it| it.radius) == [1.0, 1.0]), "{by:?}");
}

#[test]
fn a_bounce_has_the_derivatives_of_its_closed_form() {
    // From the height h with the speed w downwards, under g: the ball comes after t = (sqrt(w² + 2 g h) - w)/g
    // with u = sqrt(w² + 2 g h), and is at e u (T - t) - g (T - t)²/2 at the end.
    let (height, down, end, e) = (1.5, 0.7, 0.9, 0.6);
    let place = |height: f64, down: f64, g: f64, e: f64| {
        let speed = (down * down + 2.0 * g * height).sqrt();
        let left = end - (speed - down) / g;
        e * speed * left - 0.5 * g * left * left
    };
    let mut world = World::default();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_restitution(e);
    let floor = world.add_collider(floor).unwrap();
    let start = Sphere::new(vec(0.0, height + 0.25, 0.0), 0.25).with_velocity(vec(0.3, -down, 0.0));
    let ball = world.add_sphere(start).unwrap();
    let mut tape = Tape::start(&world).unwrap();
    // However the time is cut.
    for _ in 0..9 {
        tape.step(&mut world, end / 9.0).unwrap();
    }
    let along = SphereTangent { position: DVec3::Y, ..SphereTangent::default() };
    let gradient = tape.gradient(&[(ball, along)]).unwrap();
    let d = 1e-5;
    let differences = [
        (place(height + d, down, G, e) - place(height - d, down, G, e)) / (2.0 * d),
        -(place(height, down + d, G, e) - place(height, down - d, G, e)) / (2.0 * d),
        -(place(height, down, G + d, e) - place(height, down, G - d, e)) / (2.0 * d),
        (place(height, down, G, e + d) - place(height, down, G, e - d)) / (2.0 * d),
    ];
    let of_ball = gradient.sphere(ball);
    let found = [
        of_ball.position.y,
        of_ball.velocity.y,
        gradient.acceleration.y,
        gradient.collider(floor).restitution,
    ];
    for (found, difference) in found.into_iter().zip(differences) {
        // Central differences are off by the square of the step, and by rounding over it.
        assert!((found - difference).abs() < 1e-8, "{found} {difference}");
    }
    // A larger ball starts lower above the floor, and so does one over a floor that is higher.
    assert!((of_ball.radius + of_ball.position.y - 1.0).abs() < 1e-12);
    assert!((gradient.collider(floor).position.y + of_ball.position.y - 1.0).abs() < 1e-12);
}

/// Some rough balls of several sizes in a rough box that moves, with a fixed ball and a pillar in it.
fn rough_world(number: u64) -> (World, Vec<SphereId>) {
    let mut numbers = Numbers(number);
    let mut world = World::default();
    world.add_force(Gravity::new(vec(0.3, -2.0, 0.1))).unwrap();
    if number.is_multiple_of(3) {
        world.add_force(ViscousDrag::new(0.2)).unwrap();
    }
    if number % 4 == 1 {
        world.add_force(ConstantForce::new(vec(0.2, 0.4, -0.3))).unwrap();
    }
    let friction = Friction::sliding(0.3).with_tangential_restitution(0.2);
    let walls = Collider::new(
        Shape::Container { size: DVec3::splat(4.0), open: Sides::default() },
        Pose::at(DVec3::ZERO),
    )
    .with_restitution(0.9)
    .with_friction(friction);
    let turning = if number.is_multiple_of(2) { vec(0.1, 0.3, -0.2) } else { DVec3::ZERO };
    let belt = if number.is_multiple_of(5) { vec(0.4, -0.3, 0.2) } else { DVec3::ZERO };
    let walls = walls.moving(vec(0.2, -0.1, 0.3), turning).with_surface_velocity(belt);
    world.add_collider(walls).unwrap();
    let shapes = [
        Shape::Sphere { radius: 0.4 },
        Shape::Box { size: vec(0.5, 0.6, 0.7) },
        Shape::Cylinder { radius: 0.3, height: 0.8 },
    ];
    let pose = Pose::at(vec(0.1, -0.2, 0.05));
    let pillar = Collider::new(shapes[number as usize % 3].clone(), pose).with_restitution(0.8);
    let pillar = pillar.with_friction(0.5);
    let pillar = if number % 5 < 2 { pillar.with_cushion(1.7) } else { pillar };
    let axis = vec(0.6, 0.0, 0.8);
    world
        .add_collider(match number % 4 {
            0 => pillar.with_motion([MotionPart::Oscillate {
                axis,
                amplitude: 0.1,
                frequency: 1.5,
                phase: 0.3,
            }]),
            1 => pillar.with_motion([MotionPart::Swing {
                axis,
                pivot: vec(0.1, 0.2, 0.0),
                amplitude: 0.7,
                frequency: 1.0,
                phase: 0.2,
            }]),
            _ => pillar,
        })
        .unwrap();
    let mut places: Vec<(DVec3, f64)> = Vec::new();
    while places.len() < 5 {
        let (place, radius) = (1.5 * numbers.vector(), numbers.between(0.1, 0.25));
        let is_free = |&(other, r): &(DVec3, f64)| (other - place).length() > r + radius + 0.02;
        if place.length() > 1.0 && places.iter().all(is_free) {
            places.push((place, radius));
        }
    }
    let balls = places.into_iter().map(|(place, radius)| {
        let sphere = Sphere::new(place, radius)
            .with_velocity(3.0 * numbers.vector())
            .with_angular_velocity(4.0 * numbers.vector())
            .with_mass(numbers.between(0.5, 2.0))
            .with_restitution(0.95);
        if numbers.next() < 0.7 { sphere.with_friction(numbers.between(0.05, 0.4)) } else { sphere }
    });
    let balls: Vec<Sphere> = balls.collect();
    let ids = balls.into_iter().map(|ball| world.add_sphere(ball).unwrap()).collect();
    (world, ids)
}

/// A direction that changes all that may be.
fn some_direction(numbers: &mut Numbers, world: &World, balls: &[SphereId]) -> Variation {
    let mut direction = Variation::default().with_acceleration(numbers.vector());
    for &ball in balls {
        let change: &mut SphereVariation = direction.sphere_mut(ball);
        change.position = numbers.vector();
        change.velocity = numbers.vector();
        change.angular_velocity = numbers.vector();
        change.restitution = numbers.between(-0.2, 0.2);
        change.radius = numbers.between(-0.1, 0.1);
        change.mass = numbers.between(-1.0, 1.0);
        if world.sphere(ball).unwrap().friction.sliding.is_some() {
            change.friction = numbers.between(-1.0, 1.0);
        }
    }
    for (collider, it) in world.colliders() {
        let change = direction.collider_mut(collider);
        change.position = numbers.vector();
        let velocity = numbers.vector();
        change.velocity = if it.motion.is_empty() { velocity } else { DVec3::ZERO };
        change.restitution = numbers.between(-0.2, 0.2);
        change.friction = numbers.between(-1.0, 1.0);
    }
    direction
}

/// Compares derivatives of some worlds with differences of runs, up to 1e-9 of them, and with the gradient, to 1e-12. Returns the
/// number of worlds that it compared with differences, and of impacts.
fn compare(numbers_of_worlds: Range<u64>) -> (u32, usize) {
    let (mut compared, mut impacts) = (0, 0);
    for number in numbers_of_worlds {
        let (world, balls) = rough_world(number);
        let mut numbers = Numbers(1000 + number);
        let direction = some_direction(&mut numbers, &world, &balls);
        let Followed { tangents, tape, .. } = follow(&world, &direction, 8);
        impacts += tape.impacts();
        // Backwards as forwards.
        assert_backwards_equals_forwards((&tangents, &tape), &direction, &balls, &mut numbers);
        let gravity = world.forces().next().map(|(force, _)| (force, vec(0.3, -2.0, 0.1)));
        let [off, spread] = off_differences(&tangents, &balls, |by| {
            after(varied(&world, &direction, by, gravity), 8)
        });
        // Beyond, differences say too little: a graze or another order of impacts is near.
        if spread < 2e-10 {
            assert!(off < 1e-9, "{number}: {off:e} {spread:e}");
            compared += 1;
        }
    }
    (compared, impacts)
}

#[test]
fn derivatives_agree_with_differences_of_runs_and_with_the_gradient() {
    let (compared, impacts) = compare(0..60);
    assert!(compared > 30 && impacts > 120, "{compared} {impacts}");
}

#[test]
#[ignore = "takes minutes"]
fn derivatives_of_a_thousand_worlds_agree_with_differences() {
    let (compared, impacts) = compare(0..1000);
    println!("{compared} worlds, {impacts} impacts");
    assert!(compared == 1000 && impacts > 4000, "{compared} {impacts}");
}

#[test]
fn the_spectrum_of_elastic_balls_comes_in_pairs() {
    // Motion without loss keeps volumes: what grows by one factor shrinks by another.
    let settings =
        Settings::default().with_boundary(Boundary::Periodic { size: DVec3::splat(4.0) });
    let mut world = World::new(settings).unwrap();
    let mut numbers = Numbers(3);
    for place in [vec(-1.0, 0.2, 0.0), vec(1.0, 0.0, 0.3), vec(0.0, -1.2, -1.0)] {
        let sphere = Sphere::new(place, 0.6).with_velocity(numbers.vector());
        world.add_sphere(sphere).unwrap();
    }
    let ids = world.spheres().ids().to_vec();
    let directions = ids.iter().flat_map(|&id| {
        let axes = DVec3::AXES;
        let places = axes.map(|axis| Variation::default().with_position(id, axis));
        places.into_iter().chain(axes.map(|axis| Variation::default().with_velocity(id, axis)))
    });
    let mut tangents = Tangents::new(&world, directions.collect()).unwrap();
    let mut sums = vec![0.0; tangents.len()];
    for _ in 0..400 {
        tangents.step(&mut world, 0.25).unwrap();
        for (sum, size) in sums.iter_mut().zip(tangents.orthonormalize(1.0, 1.0)) {
            *sum += libm::log(size);
        }
    }
    let largest = sums.iter().fold(0.0, |largest, sum| sum.max(largest));
    assert!(largest > 20.0, "{sums:?}");
    // Of a hundred of the largest, rounding of each piece.
    assert!(sums.iter().sum::<f64>().abs() < 1e-10 * largest, "{sums:?}");
}

/// The same push on each sphere, without derivatives.
#[derive(Debug)]
struct Push;

impl Force for Push {
    fn on(&self, _sphere: &SphereState, _time: f64) -> DVec3 {
        DVec3::X
    }

    fn linear(&self, _radius: f64, mass: f64) -> Option<LinearForce> {
        Some(LinearForce { acceleration: DVec3::X / mass, drag_rate: 0.0 })
    }
}

#[test]
fn what_has_no_derivative_is_refused_and_stays_refused() {
    // Two balls meet one between them at one instant.
    let mut world = World::default();
    for (x, vx) in [(-3.0, 1.0), (0.0, 0.0), (3.0, -1.0)] {
        let ball = Sphere::new(vec(x, 0.0, 0.0), 0.5).with_velocity(vec(vx, 0.0, 0.0));
        world.add_sphere(ball).unwrap();
    }
    let mut tape = Tape::start(&world).unwrap();
    tape.step(&mut world, 1.0).unwrap();
    let error = tape.step(&mut world, 2.0).unwrap_err();
    assert!(matches!(error, DerivativeError::Simultaneous { time, .. } if time == 2.0), "{error}");
    assert_eq!(tape.step(&mut world, 1.0).unwrap_err(), error);
    assert_eq!(tape.gradient(&[]).unwrap_err(), error);

    // A ball that lies on another one that is fixed.
    let mut world = World::default();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let fixed = Collider::new(Shape::Sphere { radius: 1.0 }, Pose::at(DVec3::ZERO));
    world.add_collider(fixed).unwrap();
    let ball = world.add_sphere(Sphere::new(vec(0.0, 1.5, 0.0), 0.5)).unwrap();
    let mut tangents = Tangents::new(&world, Vec::new()).unwrap();
    let error = tangents.step(&mut world, 1.0 / 240.0).unwrap_err();
    assert!(
        matches!(error, DerivativeError::PersistentContact { sphere, .. } if sphere == ball),
        "{error}"
    );

    // A ball and a spring that are not there, masses under a force without derivatives.
    let mut world = World::default();
    let ball = world.add_sphere(Sphere::new(DVec3::ZERO, 0.5)).unwrap();
    let other = world.add_sphere(Sphere::new(vec(3.0, 0.0, 0.0), 0.5)).unwrap();
    let mut heavier = Variation::default();
    heavier.sphere_mut(ball).mass = 1.0;
    let mut draggy = world.clone();
    draggy.add_force(Push).unwrap();
    let refused = Tangents::new(&draggy, vec![heavier.clone()]).unwrap_err();
    assert!(matches!(refused, DerivativeError::Unsupported(_)));
    let mut emptied = world.clone();
    emptied.remove_sphere(ball).unwrap();
    let refused = Tangents::new(&emptied, vec![heavier]).unwrap_err();
    assert_eq!(refused, DerivativeError::UnknownSphere(ball));
    let mut tape = Tape::start(&world).unwrap();
    assert_eq!(tape.step(&mut emptied, 0.1).unwrap_err(), DerivativeError::Changed);
    let spring = world.add_spring(Spring::between(ball, other, 1.0)).unwrap();
    let mut stiffer = Variation::default();
    stiffer.spring_mut(spring).stiffness = 1.0;
    world.remove_spring(spring).unwrap();
    let refused = Tangents::new(&world, vec![stiffer]).unwrap_err();
    assert_eq!(refused, DerivativeError::UnknownSpring(spring));
}

#[test]
fn derivatives_have_the_units_of_the_world() {
    // The same world a million times as large, with times to match: places by places stay, places by velocities
    // grow as the time does.
    let by_start = |size: f64| {
        let mut world = World::default();
        world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
        world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO))).unwrap();
        let ball = |x: f64, y: f64| Sphere::new(size * vec(x, y, 0.0), 0.25 * size);
        let first = world.add_sphere(ball(0.0, 1.0)).unwrap();
        world.add_sphere(ball(0.1, 2.0)).unwrap();
        let mut tape = Tape::start(&world).unwrap();
        tape.step(&mut world, size.sqrt()).unwrap();
        let along = SphereTangent { position: DVec3::X, ..SphereTangent::default() };
        let by = tape.gradient(&[(first, along)]).unwrap().sphere(first);
        (by.position.x, by.velocity.x / size.sqrt())
    };
    let usual = by_start(1.0);
    assert!(usual.0.abs() > 2.0, "{usual:?}");
    for power in [-20, 20] {
        let size = (0..20).fold(1.0, |size, _| if power < 0 { size / 2.0 } else { size * 2.0 });
        let scaled = by_start(size);
        assert!((scaled.0 - usual.0).abs() < 1e-9 * usual.0.abs(), "{scaled:?}");
        assert!((scaled.1 - usual.1).abs() < 1e-9 * usual.1.abs().max(1.0), "{scaled:?}");
    }
}
