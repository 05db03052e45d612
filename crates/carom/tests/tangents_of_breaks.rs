//! Derivatives of shots on billiard tables with cloth, rough cushions and racks that touch, against differences of runs.

mod common;

use carom::{
    Collider, CombineRule, DVec3, DerivativeError, Friction, Gravity, Pose, Settings, Shape,
    Sphere, SphereId, SphereTangent, Tape, Variation, World,
};
use common::derivatives::{Followed, after, assert_agree_with_differences, follow, varied};
use common::{G, Numbers, vec};

const RADIUS: f64 = 0.028575;

/// A table whose cushions have noses above the centres of balls.
fn table(is_box: bool) -> World {
    let settings = Settings::default().with_friction_combine_rule(CombineRule::Product);
    let mut world = World::new(settings).unwrap();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let (shape, height) = match is_box {
        true => (Shape::Box { size: vec(2.66, 0.1, 1.39) }, -0.05),
        false => (Shape::HalfSpace, 0.0),
    };
    let cloth = Collider::new(shape, Pose::at(vec(0.0, height, 0.0))).with_restitution(0.5);
    let friction = Friction::sliding(0.2).with_rolling(0.006).with_spinning(0.044);
    world.add_collider(cloth.with_friction(friction)).unwrap();
    for (x, z) in [(-1.3, 0.0), (1.3, 0.0), (0.0, -0.665), (0.0, 0.665)] {
        let size = if z == 0.0 { vec(0.06, 0.04, 1.39) } else { vec(2.66, 0.04, 0.06) };
        let cushion = Collider::new(Shape::Box { size }, Pose::at(vec(x, 0.0563, z)));
        let cushion = cushion.with_restitution(0.9).with_friction(Friction::sliding(0.2));
        world.add_collider(cushion).unwrap();
    }
    world
}

/// A shot with spin at a rack of some rows that touch, or at none.
fn shot(number: u64) -> (World, Vec<SphereId>, Variation) {
    let mut numbers = Numbers(number);
    let mut world = table(number.is_multiple_of(2));
    // By the product, balls without friction have none on the cloth.
    let friction = Friction::sliding(if number.is_multiple_of(3) { 0.06 } else { 0.0 });
    let ball = |x: f64, z: f64| {
        let ball = Sphere::new(vec(x, RADIUS, z), RADIUS).with_restitution(0.97);
        ball.with_mass(0.17).with_friction(friction)
    };
    let (angle, speed) = (numbers.between(-0.04, 0.04), numbers.between(2.0, 5.0));
    let velocity = speed * vec(libm::cos(angle), 0.0, libm::sin(angle));
    let rolling = vec(velocity.z, 0.0, -velocity.x) / RADIUS;
    let spin = numbers.between(0.0, 1.5) * rolling + vec(0.0, numbers.between(-20.0, 20.0), 0.0);
    let cue = ball(-0.6, 0.0).with_velocity(velocity).with_angular_velocity(spin);
    let mut balls = vec![world.add_sphere(cue).unwrap()];
    let across = 3.0_f64.sqrt() * RADIUS;
    for row in 0..number % 4 {
        for place in 0..=row {
            let z = RADIUS * (2.0 * place as f64 - row as f64);
            balls.push(world.add_sphere(ball(0.5 + across * row as f64, z)).unwrap());
        }
    }
    let flat = vec(1.0, 0.0, 1.0);
    let direction = Variation::default()
        .with_velocity(balls[0], flat * numbers.vector())
        .with_position(balls[0], 0.1 * flat * numbers.vector())
        .with_angular_velocity(balls[0], numbers.vector());
    (world, balls, direction)
}

#[test]
fn shots_on_tables_have_the_derivatives_of_differences() {
    let (mut impacts, mut breaks) = (0, 0);
    for number in 0..24 {
        let (world, balls, direction) = shot(number);
        let Followed { tangents, tape, .. } = follow(&world, &direction, 12);
        impacts += tape.impacts();
        // Only the balls of a rack could part before they are struck: cloth and cushion have one order.
        let is_at_once = tangents.margin().interval == 0.0;
        assert!(balls.len() > 2 || !is_at_once, "{number}");
        breaks += u32::from(is_at_once);
        // Rounding over the step. Rough impacts make balls hop, and the world ends their bounces up to a contact
        // duration early, which later impacts make larger.
        let part = if number.is_multiple_of(3) { 2e-5 } else { 1e-7 };
        let end = |by| after(varied(&world, &direction, by, None), 12);
        assert_agree_with_differences(&tangents, &balls, [1e-6, part], end);
    }
    assert!(impacts > 500 && breaks > 3, "{impacts} {breaks}");
}

#[test]
fn descent_finds_the_break_that_sends_a_ball_of_the_rack_to_a_place() {
    // The last ball of the second row is to stop, 1 s after the shot, where a break at another angle sends it.
    let run = |angle: f64| -> Result<(DVec3, f64), DerivativeError> {
        let (mut world, balls, _) = shot(18);
        let mut cue = world.sphere(balls[0]).unwrap();
        let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
        cue.velocity = 3.0 * vec(cosine, 0.0, sine);
        cue.angular_velocity = 3.0 / RADIUS * vec(sine, 0.0, -cosine);
        world.set_sphere(balls[0], cue).unwrap();
        let mut tape = Tape::start(&world)?;
        (0..10).try_for_each(|_| tape.step(&mut world, 0.1))?;
        let along = SphereTangent { position: DVec3::Z, ..SphereTangent::default() };
        let by = tape.gradient(&[(balls[3], along)])?.sphere(balls[0]);
        let turned = 3.0 * vec(-sine, 0.0, cosine);
        let spun = 3.0 / RADIUS * vec(cosine, 0.0, sine);
        let slope = by.velocity.dot(turned) + by.angular_velocity.dot(spun);
        Ok((world.sphere(balls[3]).unwrap().position, slope))
    };
    let target = run(0.013).unwrap().0.z;
    let mut angle = 0.01;
    for _ in 0..20 {
        let (place, slope) = run(angle).unwrap();
        angle -= (place.z - target) / slope;
    }
    // Rounding of a place over its slope.
    assert!((angle - 0.013).abs() < 1e-10, "{angle}");
}
