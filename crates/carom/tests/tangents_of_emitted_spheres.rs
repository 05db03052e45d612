//! Derivatives of runs in which emitters add spheres: against closed forms and against differences of runs, forwards and
//! backwards alike.

mod common;

use carom::{
    Collider, DVec3, DerivativeError, Emitter, Gravity, PointAttractor, Pose, Shape, Sides, Sphere,
    SphereId, SphereTangent, Tape, Variation, World,
};
use common::derivatives::{
    Followed, after, assert_backwards_equals_forwards, follow, off_differences, varied,
};
use common::{G, Numbers, vec};

fn along(position: DVec3) -> SphereTangent {
    SphereTangent { position, ..SphereTangent::default() }
}

#[test]
fn an_emitted_ball_has_the_derivatives_of_its_closed_form() {
    // Emitted at the time s at the height h with the speed w downwards, it comes to the floor after t with u = sqrt(w² + 2 g
    // h), and is at e u (T - s - t) - g (T - s - t)²/2 at the end.
    let (height, down, period, e, end) = (1.5, 0.7, 0.55, 0.6, 1.5);
    for scale in [1.0, libm::ldexp(1.0, -20), libm::ldexp(1.0, 20)] {
        let mut world = World::default();
        world.add_force(Gravity::new(scale * vec(0.0, -G, 0.0))).unwrap();
        let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_restitution(e);
        world.add_collider(floor).unwrap();
        let radius = 0.1 * scale;
        let start = Sphere::new(vec(0.0, scale * height + radius, 0.0), radius)
            .with_velocity(scale * vec(2.0, -down, 0.0));
        world.add_emitter(Emitter::new(start, period)).unwrap();
        let mut tape = Tape::start(&world).unwrap();
        // However the time is cut.
        for _ in 0..7 {
            tape.step(&mut world, end / 7.0).unwrap();
        }
        let place = |height: f64, down: f64, g: f64| {
            let speed = (down * down + 2.0 * g * height).sqrt();
            let left = end - period - (speed - down) / g;
            e * speed * left - 0.5 * g * left * left
        };
        // The second one, at s = period.
        let ball = world.spheres().ids()[1];
        let by = tape.gradient(&[(ball, along(DVec3::Y))]).unwrap();
        let h = 1e-3;
        let difference = |at: &dyn Fn(f64) -> f64| {
            (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h)
        };
        for (found, expected) in [
            (by.sphere(ball).position.y, difference(&|h| place(height + h, down, G))),
            (-by.sphere(ball).velocity.y, difference(&|h| place(height, down + h, G))),
            (-by.acceleration.y, difference(&|h| place(height, down, G + h))),
        ] {
            // The fourth power of the step times the fifth derivative, and rounding over the step.
            assert!((found - expected).abs() < 1e-9, "{scale}: {found} {expected}");
        }
        // The first one does not come near.
        let first = world.spheres().ids()[0];
        assert_eq!(by.sphere(first).position, DVec3::ZERO);
    }
}

/// Some rough balls in a rough box, two emitters, and an attractor if it is `curved`.
fn some_world(number: u64, curved: bool) -> (World, Vec<SphereId>, DVec3) {
    let mut numbers = Numbers(300 + number);
    let mut world = World::default();
    let gravity = vec(0.3, -2.0, 0.1);
    world.add_force(Gravity::new(gravity)).unwrap();
    if curved {
        let sun = PointAttractor::new(vec(0.2, 0.1, 0.0), 2.0).with_softening(0.3);
        world.add_force(sun).unwrap();
    }
    let walls = Shape::Container { size: DVec3::splat(4.0), open: Sides::default() };
    let walls = Collider::new(walls, Pose::at(DVec3::ZERO)).with_restitution(0.9);
    world.add_collider(walls.with_friction(0.2)).unwrap();
    let mut ball = |place: DVec3| {
        Sphere::new(place, numbers.between(0.1, 0.2))
            .with_velocity(3.0 * numbers.vector())
            .with_angular_velocity(3.0 * numbers.vector())
            .with_mass(numbers.between(0.5, 2.0))
            .with_restitution(0.95)
            .with_friction(0.3)
    };
    let places = [vec(-1.0, 0.5, 0.0), vec(0.6, -0.7, 0.4), vec(0.2, 0.9, -1.0)];
    let balls = places.map(|place| world.add_sphere(ball(place)).unwrap());
    for (place, period) in [(vec(1.2, 0.2, 0.3), 0.31), (vec(-0.3, -0.2, 1.1), 0.43)] {
        // One that appears within another one has no derivative.
        let emitter = Emitter::new(ball(place), period).with_needs_room(true);
        world.add_emitter(emitter).unwrap();
    }
    (world, balls.to_vec(), gravity)
}

/// A direction that changes the balls, the walls and gravity.
fn some_direction(world: &World, balls: &[SphereId], numbers: &mut Numbers) -> Variation {
    let mut direction = Variation::default().with_acceleration(numbers.vector());
    for &ball in balls {
        let change = direction.sphere_mut(ball);
        change.position = numbers.vector();
        change.velocity = numbers.vector();
        change.angular_velocity = numbers.vector();
        change.restitution = numbers.between(-0.2, 0.2);
        change.friction = numbers.between(-0.5, 0.5);
    }
    for (collider, _) in world.colliders() {
        direction.collider_mut(collider).position = numbers.vector();
        direction.collider_mut(collider).friction = numbers.between(-0.5, 0.5);
    }
    direction
}

#[test]
fn derivatives_of_emitted_balls_agree_with_differences_and_with_the_gradient() {
    let (mut compared, mut emitted, mut impacts) = (0, 0, 0);
    for number in 0..40 {
        let (world, balls, gravity) = some_world(number, number % 4 == 0);
        let mut numbers = Numbers(700 + number);
        let direction = some_direction(&world, &balls, &mut numbers);
        let Followed { end, tangents, tape } = follow(&world, &direction, 9);
        impacts += tape.impacts();
        let all = end.spheres().ids().to_vec();
        emitted += all.len() - balls.len();
        assert_backwards_equals_forwards((&tangents, &tape), &direction, &all, &mut numbers);
        let force = world.forces().next().map(|(force, _)| (force, gravity));
        let [off, spread] =
            off_differences(&tangents, &all, |by| after(varied(&world, &direction, by, force), 9));
        // Beyond, differences say too little: a graze or another order of impacts is near.
        if spread < 2e-10 {
            assert!(off < 1e-9, "{number}: {off:e} {spread:e}");
            compared += 1;
        }
    }
    assert!(compared > 20 && emitted > 150 && impacts > 200, "{compared} {emitted} {impacts}");
}

#[test]
fn an_emitter_that_removes_its_oldest_ball_ends_derivatives() {
    let mut world = World::default();
    let ball = Sphere::new(DVec3::ZERO, 0.1).with_velocity(DVec3::X);
    world.add_emitter(Emitter::new(ball, 0.5).with_max_spheres(2)).unwrap();
    let mut tape = Tape::start(&world).unwrap();
    tape.step(&mut world, 0.9).unwrap();
    assert_eq!(tape.step(&mut world, 0.9).unwrap_err(), DerivativeError::Changed);
}
