//! Derivatives through flights on curves: springs, threads, and forces without a closed form.

mod common;

use std::ops::Range;

use carom::{
    Buoyancy, Collider, DVec3, DerivativeError, Force, ForceDerivatives, ForceEdge, Gravity,
    MutualGravity, PointAttractor, Pose, QuadraticDrag, Shape, Sides, Sphere, SphereId,
    SphereState, SphereTangent, Spring, Tape, Variation, Vortex, World,
};
use common::derivatives::{
    Followed, after, assert_backwards_equals_forwards, follow, off_differences, varied,
};
use common::{Numbers, vec};

/// Adds the forces of one kind to a world with some balls.
fn add_forces(world: &mut World, balls: &[SphereId], kind: u64, numbers: &mut Numbers) {
    let damping = if kind.is_multiple_of(2) { 0.0 } else { 0.3 };
    if kind < 4 {
        let mut add = |spring: Spring| {
            let spring = spring.with_stiffness(numbers.between(3.0, 9.0)).with_damping(damping);
            world.add_spring(spring.with_only_pulls(kind >= 2)).unwrap();
        };
        add(Spring::between(balls[0], balls[1], 0.9));
        add(Spring::between(balls[1], balls[2], 0.5));
        add(Spring::to_point(balls[3], vec(0.1, 0.3, -0.2), 0.4));
    }
    match kind {
        4 => {
            let sun = PointAttractor::new(vec(0.2, 0.1, 0.0), 2.0).with_softening(0.3);
            world.add_force(sun).unwrap();
        }
        5 => {
            let air = QuadraticDrag::new(0.8).with_wind(vec(0.4, 0.1, 0.0));
            world
                .add_force(air.with_viscosity(if numbers.next() < 0.5 { 0.0 } else { 0.05 }))
                .unwrap();
        }
        6 => {
            world.add_force(Vortex::new(vec(0.1, 0.0, 0.2), 3.0, 0.5)).unwrap();
            world.add_force(Buoyancy::new(20.0, 0.1)).unwrap();
        }
        7 => {
            world.add_force(MutualGravity::new(0.4).with_softening(0.05)).unwrap();
            world.add_spring(Spring::between(balls[0], balls[3], 0.6)).unwrap();
        }
        _ => {}
    }
}

/// Some rough balls in a rough box at rest, under forces of a kind.
fn some_world(number: u64) -> (World, Vec<SphereId>, DVec3) {
    let mut numbers = Numbers(77 + number);
    let mut world = World::default();
    let gravity = vec(0.3, -2.0, 0.1);
    world.add_force(Gravity::new(gravity)).unwrap();
    let walls = Shape::Container { size: DVec3::splat(4.0), open: Sides::default() };
    let walls =
        Collider::new(walls, Pose::at(DVec3::ZERO)).with_restitution(0.9).with_friction(0.2);
    world.add_collider(walls).unwrap();
    let mut balls: Vec<Sphere> = Vec::new();
    while balls.len() < 4 {
        let ball = Sphere::new(1.2 * numbers.vector(), numbers.between(0.1, 0.25))
            .with_velocity(3.0 * numbers.vector())
            .with_angular_velocity(3.0 * numbers.vector())
            .with_mass(numbers.between(0.5, 2.0))
            .with_restitution(0.95)
            .with_friction(0.3);
        let is_free =
            |it: &Sphere| it.position.distance(ball.position) > it.radius + ball.radius + 0.05;
        if balls.iter().all(is_free) {
            balls.push(ball);
        }
    }
    let ids: Vec<SphereId> = balls.into_iter().map(|it| world.add_sphere(it).unwrap()).collect();
    add_forces(&mut world, &ids, number % 8, &mut numbers);
    (world, ids, gravity)
}

/// A direction that changes all that may be.
fn some_direction(world: &World, balls: &[SphereId], numbers: &mut Numbers) -> Variation {
    let mut direction = Variation::default().with_acceleration(numbers.vector());
    for &ball in balls {
        let change = direction.sphere_mut(ball);
        change.position = numbers.vector();
        change.velocity = numbers.vector();
        change.angular_velocity = numbers.vector();
        change.radius = numbers.between(-0.1, 0.1);
        change.mass = numbers.between(-0.5, 0.5);
        change.restitution = numbers.between(-0.2, 0.2);
        change.friction = numbers.between(-0.5, 0.5);
        change.acceleration = numbers.vector();
    }
    for (collider, _) in world.colliders() {
        let change = direction.collider_mut(collider);
        change.position = numbers.vector();
        change.restitution = numbers.between(-0.2, 0.2);
        change.friction = numbers.between(-0.5, 0.5);
    }
    for (spring, it) in world.springs() {
        let change = direction.spring_mut(spring);
        change.stiffness = numbers.between(-1.0, 1.0);
        change.rest_length = numbers.between(-0.2, 0.2);
        change.damping = if it.damping > 0.0 { numbers.between(-0.2, 0.2) } else { 0.0 };
    }
    direction
}

/// Compares derivatives of some worlds with differences of runs, up to 1e-9 of them, and with the gradient, to 1e-12. Returns the
/// number of worlds of each kind that it compared with differences, and of impacts.
fn compare(numbers_of_worlds: Range<u64>) -> ([u32; 8], usize) {
    let (mut compared, mut impacts) = ([0; 8], 0);
    for number in numbers_of_worlds {
        let (world, balls, gravity) = some_world(number);
        let mut numbers = Numbers(5000 + number);
        let direction = some_direction(&world, &balls, &mut numbers);
        let Followed { tangents, tape, .. } = follow(&world, &direction, 6);
        impacts += tape.impacts();
        assert_backwards_equals_forwards((&tangents, &tape), &direction, &balls, &mut numbers);
        let force = world.forces().next().map(|(force, _)| (force, gravity));
        let [off, spread] = off_differences(&tangents, &balls, |by| {
            after(varied(&world, &direction, by, force), 6)
        });
        // Where a ball dips into a liquid, the second derivative of the force jumps, and differences are less exact.
        let (clear, part) = if number % 8 == 6 { (1e-8, 1e-7) } else { (2e-10, 1e-9) };
        // Beyond, differences say too little: a graze or another order of impacts is near.
        if spread < clear {
            assert!(off < part, "{number}: {off:e} {spread:e}");
            compared[number as usize % 8] += 1;
        }
    }
    (compared, impacts)
}

#[test]
fn derivatives_along_curves_agree_with_differences_and_with_the_gradient() {
    let (compared, impacts) = compare(0..48);
    assert!(compared.iter().all(|&it| it > 0) && impacts > 40, "{compared:?} {impacts}");
}

#[test]
#[ignore = "takes minutes"]
fn derivatives_of_a_thousand_worlds_along_curves_agree_with_differences() {
    let (compared, impacts) = compare(0..1000);
    println!("{compared:?} worlds, {impacts} impacts");
    assert!(compared == [125; 8] && impacts > 1000, "{compared:?} {impacts}");
}

#[test]
fn an_oscillator_has_the_derivatives_of_its_closed_form() {
    // x = l + A cos ωt with ω² = k/m, on a spring of the length l from the origin.
    let (stiffness, mass, rest, amplitude, time) = (3.0, 0.7, 1.5, 0.4, 2.3);
    let mut world = World::default();
    let ball = Sphere::new(vec(rest + amplitude, 0.0, 0.0), 0.1).with_mass(mass);
    let ball = world.add_sphere(ball).unwrap();
    let spring = Spring::to_point(ball, DVec3::ZERO, rest).with_stiffness(stiffness);
    let spring = world.add_spring(spring).unwrap();
    let mut tape = Tape::start(&world).unwrap();
    for _ in 0..10 {
        tape.step(&mut world, time / 10.0).unwrap();
    }
    let along = SphereTangent { position: DVec3::X, ..SphereTangent::default() };
    let by = tape.gradient(&[(ball, along)]).unwrap();
    let rate = (stiffness / mass).sqrt();
    let (sin, cos) = (libm::sin(rate * time), libm::cos(rate * time));
    let by_rate = -amplitude * time * sin;
    let expected = [
        (by.sphere(ball).position.x, cos),
        (by.sphere(ball).velocity.x, sin / rate),
        (by.sphere(ball).mass, -by_rate * rate / (2.0 * mass)),
        (by.spring(spring).stiffness, by_rate * rate / (2.0 * stiffness)),
        (by.spring(spring).rest_length, 1.0 - cos),
    ];
    for (found, expected) in expected {
        // Rounding of the weights of the quadrature, over some tens of steps.
        assert!((found - expected).abs() < 2e-12, "{found} {expected}");
    }
}

#[test]
fn a_damped_thread_that_becomes_taut_has_the_derivatives_of_its_closed_form() {
    // A ball flies with the speed v along x, at the length l the thread of stiffness 0 and damping c begins to brake it:
    // with τ = m/c and T the time since then, x = l + v τ (1 - exp(-T/τ)), T = t - (l - x0)/v.
    let (mass, damping, rest, start, speed, end) = (0.8, 0.5, 1.3, 0.4, 2.0, 1.1);
    let mut world = World::default();
    let ball = Sphere::new(vec(start, 0.0, 0.0), 0.1).with_velocity(vec(speed, 0.0, 0.0));
    let ball = world.add_sphere(ball.with_mass(mass)).unwrap();
    let thread = Spring::to_point(ball, DVec3::ZERO, rest).with_stiffness(0.0);
    let thread = thread.with_damping(damping).with_only_pulls(true);
    let thread = world.add_spring(thread).unwrap();
    let mut tape = Tape::start(&world).unwrap();
    for _ in 0..7 {
        tape.step(&mut world, end / 7.0).unwrap();
    }
    let along = SphereTangent { position: DVec3::X, ..SphereTangent::default() };
    let by = tape.gradient(&[(ball, along)]).unwrap();
    let left = end - (rest - start) / speed;
    let tau = mass / damping;
    let slower = libm::exp(-left / tau);
    let by_tau = speed * (1.0 - slower) - speed * left / tau * slower;
    let expected = [
        (by.sphere(ball).position.x, slower),
        (by.spring(thread).rest_length, 1.0 - slower),
        (by.sphere(ball).velocity.x, tau * (1.0 - slower) + slower * (rest - start) / speed),
        (by.spring(thread).damping, -by_tau * tau / damping),
        (by.sphere(ball).mass, by_tau / damping),
    ];
    for (found, expected) in expected {
        // Rounding of the weights of the quadrature.
        assert!((found - expected).abs() < 2e-12, "{found} {expected}");
    }
}

/// A layer between two heights in which every sphere gets an acceleration \[m/s²\], once its highest point is there.
#[derive(Debug, Clone, Copy)]
struct Layer {
    heights: [f64; 2],
    acceleration: DVec3,
}

impl Force for Layer {
    fn on(&self, sphere: &SphereState, _time: f64) -> DVec3 {
        let [low, high] = self.heights;
        let is_inside = (low..high).contains(&(sphere.position.y + sphere.radius));
        if is_inside { sphere.mass * self.acceleration } else { DVec3::ZERO }
    }

    fn edges(&self, radius: f64) -> Vec<ForceEdge> {
        self.heights.map(|it| ForceEdge { normal: DVec3::Y, height: it - radius }).to_vec()
    }

    fn derivatives(&self, sphere: &SphereState, time: f64) -> Option<ForceDerivatives> {
        let by_mass = self.on(sphere, time) / sphere.mass;
        Some(ForceDerivatives { by_mass, ..ForceDerivatives::ZERO })
    }
}

#[test]
fn a_layer_that_a_ball_passes_has_the_derivatives_of_its_closed_form() {
    // It comes with the speed v to the lower edge after (l - r - y)/v, leaves the layer of the width w with u, u² = v² +
    // 2 a w, and gets b t across in the layer.
    let (radius, start, width, a, b, end) = (0.1, 0.2, 0.3, 7.0, -3.0, 1.0);
    for scale in [1.0, libm::ldexp(1.0, -20), libm::ldexp(1.0, 20)] {
        let mut world = World::default();
        let heights = [1.0, 1.0 + width].map(|it| scale * it);
        world.add_force(Layer { heights, acceleration: scale * vec(b, a, 0.0) }).unwrap();
        let speed = 2.0;
        let ball = Sphere::new(vec(0.0, scale * start, 0.0), scale * radius);
        let ball = world.add_sphere(ball.with_velocity(vec(0.0, scale * speed, 0.0))).unwrap();
        let mut tape = Tape::start(&world).unwrap();
        for _ in 0..7 {
            tape.step(&mut world, end / 7.0).unwrap();
        }
        let of = |y: f64, v: f64, r: f64| {
            let u = (v * v + 2.0 * a * width).sqrt();
            let (comes, inside) = ((1.0 - r - y) / v, (u - v) / a);
            let left = end - comes - inside;
            [b * inside * (0.5 * inside + left), 1.0 - r + width + u * left]
        };
        for (number, axis) in [DVec3::X, DVec3::Y].into_iter().enumerate() {
            let h = 1e-3;
            let difference = |at: &dyn Fn(f64) -> [f64; 2]| {
                let at = |h: f64| at(h)[number];
                (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h)
            };
            let along = SphereTangent { position: axis, ..SphereTangent::default() };
            let by = tape.gradient(&[(ball, along)]).unwrap().sphere(ball);
            for (found, expected) in [
                (by.position.y, difference(&|h| of(start + h, speed, radius))),
                (by.velocity.y, difference(&|h| of(start, speed + h, radius))),
                (by.radius, difference(&|h| of(start, speed, radius + h))),
                (by.mass, 0.0),
            ] {
                // The fourth power of the step times the fifth derivative, and rounding over the step.
                assert!((found - expected).abs() < 1e-9, "{scale} {axis} {found} {expected}");
            }
        }
    }
}

#[test]
fn derivatives_through_layers_agree_with_differences_and_with_the_gradient() {
    let mut compared = 0;
    for number in 0..24 {
        let (mut world, balls, gravity) = some_world(8 * number + number % 6);
        let mut numbers = Numbers(900 + number);
        for _ in 0..2 {
            let low = numbers.between(-1.5, 1.0);
            let heights = [low, low + numbers.between(0.05, 0.5)];
            world.add_force(Layer { heights, acceleration: 3.0 * numbers.vector() }).unwrap();
        }
        let direction = some_direction(&world, &balls, &mut numbers);
        let Followed { tangents, tape, .. } = follow(&world, &direction, 6);
        assert_backwards_equals_forwards((&tangents, &tape), &direction, &balls, &mut numbers);
        let force = world.forces().next().map(|(force, _)| (force, gravity));
        let [off, spread] = off_differences(&tangents, &balls, |by| {
            after(varied(&world, &direction, by, force), 6)
        });
        // A jump is passed within the rounding of a coordinate, which differences multiply.
        if spread < 2e-9 {
            assert!(off < 1e-8, "{number}: {off:e} {spread:e}");
            compared += 1;
        }
    }
    assert!(compared > 12, "{compared}");
}

/// A force of a program, without derivatives.
#[derive(Debug)]
struct Pull;

impl Force for Pull {
    fn on(&self, sphere: &SphereState, _time: f64) -> DVec3 {
        -sphere.position
    }
}

#[test]
fn a_force_without_derivatives_is_refused() {
    let mut world = World::default();
    world.add_sphere(Sphere::new(DVec3::X, 0.1)).unwrap();
    world.add_force(Pull).unwrap();
    let refused = Tape::start(&world).unwrap_err();
    assert_eq!(refused, DerivativeError::Unsupported("a force without `derivatives`"));
}

#[test]
fn derivatives_along_curves_have_the_units_of_the_world() {
    // Lengths a million times as large or small, with the same masses, stiffness and times: a ball on a spring that
    // meets a wall, near an attractor.
    let by_start = |size: f64| {
        let mut world = World::default();
        let wall = Collider::new(Shape::Box { size: DVec3::splat(size) }, Pose::at(DVec3::ZERO));
        world.add_collider(wall).unwrap();
        let sun = PointAttractor::new(size * vec(0.0, 2.0, 0.0), size * size * size);
        world.add_force(sun).unwrap();
        let ball = Sphere::new(size * vec(1.5, 0.1, 0.0), 0.2 * size).with_mass(0.9);
        let ball = world.add_sphere(ball).unwrap();
        let spring = Spring::to_point(ball, DVec3::ZERO, 0.3 * size).with_stiffness(2.0);
        let spring = world.add_spring(spring).unwrap();
        let mut tape = Tape::start(&world).unwrap();
        for _ in 0..4 {
            tape.step(&mut world, 0.4).unwrap();
        }
        assert!(tape.impacts() > 0);
        let along = SphereTangent { position: DVec3::X, ..SphereTangent::default() };
        let by = tape.gradient(&[(ball, along)]).unwrap();
        let of_ball = by.sphere(ball);
        [of_ball.position.x, of_ball.velocity.y, by.spring(spring).stiffness / size]
    };
    let usual = by_start(1.0);
    assert!(usual.iter().all(|it| it.abs() > 1e-3), "{usual:?}");
    for power in [-20, 20] {
        let scaled = by_start(libm::ldexp(1.0, power));
        for (scaled, usual) in scaled.into_iter().zip(usual) {
            // Rounding that an impact multiplies.
            assert!((scaled - usual).abs() < 1e-9 * usual.abs().max(1.0), "{scaled} {usual}");
        }
    }
}
