//! Compliant surfaces: impacts by Stronge's law beside those of pooltool 0.6, and what holds of them for any numbers.

mod common;

use carom::{
    Collider, Contact, DVec3, Exact, Friction, Gravity, Pose, Rule, Settings, Shape, Sphere,
    Tangents, Variation, World,
};
use common::{G, Numbers, vec};

const RADIUS: f64 = 0.028575;
/// Rounding of one impact, relative to the speeds in it.
const ROUNDING: f64 = 1e-14;

/// A surface at y = 0 with Coulomb's coefficient, restitution and frequency ratio.
fn cushion(friction: f64, restitution: f64, ratio: f64) -> Collider {
    let surface = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO));
    surface.with_friction(friction).with_restitution(restitution).with_cushion(ratio)
}

fn world(rule: impl Into<Rule>, surface: Collider) -> World {
    let mut world = World::new(Settings::default().with_rule(rule)).unwrap();
    world.add_collider(surface).unwrap();
    world
}

/// A ball of a tenth of the radius above the surface.
fn ball(velocity: DVec3, angular_velocity: DVec3) -> Sphere {
    let sphere = Sphere::new(vec(0.0, 1.1 * RADIUS, 0.0), RADIUS).with_velocity(velocity);
    sphere.with_angular_velocity(angular_velocity)
}

/// Velocity of the point of a ball that touches the surface.
fn slip(ball: &Sphere) -> DVec3 {
    ball.velocity.with_y(0.0) + ball.angular_velocity.cross(vec(0.0, -ball.radius, 0.0))
}

/// Returns a ball after an impact of this ball on a surface.
fn struck(rule: impl Into<Rule>, surface: Collider, ball: Sphere) -> Sphere {
    let mut world = world(rule, surface);
    let id = world.add_sphere(ball).unwrap();
    world.step(0.2 * RADIUS / -ball.velocity.y).unwrap();
    let after = world.sphere(id).unwrap();
    assert!(after.velocity.y >= 0.0, "no impact");
    after
}

/// Returns the slip after an impact at 2 m/s, divided by that speed and by the friction of 0.2.
fn slip_after(ratio: f64, restitution: f64, incidence: f64) -> f64 {
    let (friction, speed) = (0.2, 2.0);
    let unit = friction * speed;
    let coming = ball(vec(incidence * unit, -speed, 0.0), DVec3::ZERO);
    slip(&struck(Exact::default(), cushion(friction, restitution, ratio), coming)).x / unit
}

/// The slip of pooltool 0.6.0 by frequency ratio, restitution and slip before, from
/// `resolve_collinear_compliant_frictional_inelastic_collision(-0.4 * y, -2, 0.17, 3.5, 1, 0.2, e, 1e3,
/// 3.5 / ratio**2)[0] / -0.4` of `pooltool.physics.resolve.stronge_compliant`.
const POOLTOOL: [[f64; 4]; 40] = [
    [1.1, 0.9, 0.05, -0.049508787215519434],
    [1.1, 0.9, 0.5, -0.49568086161685826],
    [1.1, 0.9, 1.0, -0.9923842311473683],
    [1.1, 0.9, 1.5, -1.4897861998012079],
    [1.1, 0.9, 2.5, -2.4859541711400333],
    [1.1, 0.9, 4.0, -2.65],
    [1.1, 0.9, 5.5, -1.15],
    [1.1, 0.9, 7.5, 0.8499999999999996],
    [1.7, 0.5, 0.05, -0.03276684079697077],
    [1.7, 0.5, 0.5, -0.3509256277569792],
    [1.7, 0.5, 1.0, -0.7423064279141229],
    [1.7, 0.5, 1.5, -1.1992598990225578],
    [1.7, 0.5, 2.5, -1.8912947887275067],
    [1.7, 0.5, 4.0, -1.25],
    [1.7, 0.5, 5.5, 0.2500000000000002],
    [1.7, 0.5, 7.5, 2.2499999999999996],
    [1.7, 0.85, 0.05, 0.010451115594717746],
    [1.7, 0.85, 0.5, 0.02587538031349968],
    [1.7, 0.85, 1.0, -0.11393879617054184],
    [1.7, 0.85, 1.5, -0.4698793124820733],
    [1.7, 0.85, 2.5, -1.3581892244195977],
    [1.7, 0.85, 4.0, -1.91593492172125],
    [1.7, 0.85, 5.5, -0.9750000000000003],
    [1.7, 0.85, 7.5, 1.0249999999999992],
    [1.7, 1.0, 0.05, 0.028697162986265873],
    [1.7, 1.0, 0.5, 0.20958630275363627],
    [1.7, 1.0, 1.0, 0.2085389384970951],
    [1.7, 1.0, 1.5, -0.08775161985488472],
    [1.7, 1.0, 2.5, -1.0132320153968037],
    [1.7, 1.0, 4.0, -1.7509725172847923],
    [1.7, 1.0, 5.5, -1.4531392988941472],
    [1.7, 1.0, 7.5, 0.49999999999999933],
    [1.9, 0.7, 0.05, 0.016874065051797355],
    [1.9, 0.7, 0.5, 0.08982483219233753],
    [1.9, 0.7, 1.0, -0.006162797795839781],
    [1.9, 0.7, 1.5, -0.4666942180945175],
    [1.9, 0.7, 2.5, -1.303716981812328],
    [1.9, 0.7, 4.0, -1.727733573320281],
    [1.9, 0.7, 5.5, -0.4500000000000004],
    [1.9, 0.7, 7.5, 1.5499999999999992],
];

#[test]
fn slip_after_an_impact_is_that_of_pooltool() {
    for [ratio, restitution, before, expected] in POOLTOOL {
        let after = slip_after(ratio, restitution, before);
        // pooltool's search for the end of sticking stops 2e-12 before it.
        assert!((after - expected).abs() < 1e-11, "{ratio} {restitution} {before}: {after}");
    }
}

#[test]
fn a_steep_elastic_impact_reverses_slip_by_the_cosine_of_its_springs() {
    // It sticks all the time but for the end, where the normal force is as small as that of the spring.
    for ratio in [1.1, 1.5, 1.9] {
        let incidence = 1e-7;
        let after = slip_after(ratio, 1.0, incidence) / incidence;
        let expected = libm::cos(ratio * std::f64::consts::PI);
        // The contact slips from when 1e-7 of the force is left on.
        assert!((after - expected).abs() < 1e-6, "{ratio}: {after} instead of {expected}");
    }
}

#[test]
fn a_flat_impact_loses_what_coulombs_law_takes() {
    for (ratio, restitution) in [(1.0, 0.0), (1.7, 0.85), (2.0, 1.0)] {
        let after = slip_after(ratio, restitution, 9.0);
        let expected = 9.0 - 3.5 * (1.0 + restitution);
        assert!((after - expected).abs() < 100.0 * ROUNDING, "{after} instead of {expected}");
    }
}

#[test]
fn no_impact_gains_energy_and_none_exceeds_coulombs_limit() {
    let mut numbers = Numbers(7);
    for number in 0..10_000 {
        let [ratio, restitution] = [numbers.between(1.0, 2.0), numbers.between(0.0, 1.0)];
        let friction = libm::exp2(numbers.between(-6.0, 2.0));
        let speed = libm::exp2(numbers.between(-20.0, 20.0));
        let velocity = (speed * numbers.vector()).with_y(-speed);
        let spin = libm::exp2(numbers.between(-6.0, 2.0)) * speed / RADIUS * numbers.vector();
        let before = ball(velocity, spin).with_inertia_factor(numbers.between(0.1, 1.0));
        let after = struck(Exact::default(), cushion(friction, restitution, ratio), before);
        let energy = |it: &Sphere| {
            let rim = it.radius * it.angular_velocity;
            it.velocity.length_squared() + it.inertia_factor * rim.length_squared()
        };
        let gain = energy(&after) - energy(&before) * (1.0 + ROUNDING);
        assert!(gain <= 0.0, "{number}: {gain} of {}", energy(&before));
        let pushed = (after.velocity - before.velocity).with_y(0.0).length();
        let limit = friction * (after.velocity.y - before.velocity.y);
        assert!(pushed <= limit + ROUNDING * speed, "{number}: {pushed} and {limit}");
        // Angular momentum about the point of contact stays.
        let about = |it: &Sphere| {
            let moment = it.inertia_factor * it.radius * it.radius * it.angular_velocity;
            moment + vec(0.0, it.radius, 0.0).cross(it.velocity)
        };
        let change = (about(&after) - about(&before)).length();
        assert!(change <= 10.0 * ROUNDING * energy(&before).sqrt() * RADIUS, "{number}: {change}");
    }
}

#[test]
fn the_rule_contact_answers_an_impact_like_exact() {
    let mut numbers = Numbers(11);
    for number in 0..200 {
        let [ratio, restitution] = [numbers.between(1.0, 2.0), numbers.between(0.3, 1.0)];
        let velocity = numbers.vector().with_y(-1.0);
        let coming = ball(velocity, 30.0 * numbers.vector());
        let surface = || cushion(0.3, restitution, ratio);
        let [exact, contact] = [
            struck(Exact::default(), surface(), coming),
            struck(Contact::default(), surface(), coming),
        ];
        let off = (exact.velocity - contact.velocity).length();
        let turned = RADIUS * (exact.angular_velocity - contact.angular_velocity).length();
        assert!(off.max(turned) < 1e3 * ROUNDING, "{number}: {off} {turned}");
    }
}

#[test]
fn a_cushion_that_moves_answers_as_one_at_rest_seen_from_it() {
    let wind = vec(0.3, 0.0, -0.7);
    let coming = ball(vec(0.5, -1.0, 0.2), vec(3.0, -20.0, 9.0));
    let still = struck(Exact::default(), cushion(0.4, 0.8, 1.6), coming);
    let moving = cushion(0.4, 0.8, 1.6).moving(wind, DVec3::ZERO);
    let belt = cushion(0.4, 0.8, 1.6).with_surface_velocity(wind);
    for surface in [moving, belt] {
        let carried =
            struck(Exact::default(), surface, coming.with_velocity(coming.velocity + wind));
        let off = (carried.velocity - wind - still.velocity).length();
        let turned = RADIUS * (carried.angular_velocity - still.angular_velocity).length();
        assert!(off.max(turned) < 10.0 * ROUNDING, "{off} {turned}");
    }
}

#[test]
fn worlds_of_any_size_answer_alike() {
    // Powers of two change no mantissa.
    let sizes = [-20, 0, 20].map(|power| libm::ldexp(1.0, power));
    for rule in [Rule::from(Exact::default()), Rule::from(Contact::default())] {
        let run = |size: f64| {
            let mut world = World::new(Settings::default().with_rule(rule)).unwrap();
            // As long a time in all sizes, so speeds and accelerations grow with lengths.
            world.add_force(Gravity::new(vec(0.0, -G * size, 0.0))).unwrap();
            world.add_collider(cushion(0.3, 0.8, 1.7)).unwrap();
            let sphere = Sphere::new(vec(0.0, 0.5 * size, 0.0), 0.1 * size)
                .with_velocity(vec(0.4 * size, 0.0, 0.0))
                .with_angular_velocity(vec(1.0, 2.0, 5.0));
            let id = world.add_sphere(sphere).unwrap();
            for _ in 0..60 {
                world.step(1.0 / 60.0).unwrap();
            }
            (world.sphere(id).unwrap().velocity / size).to_array().map(f64::to_bits)
        };
        assert!(sizes.map(run).iter().all(|it| *it == run(1.0)));
    }
}

#[test]
fn accounts_of_bounces_on_a_cushion_close() {
    for rule in [Rule::from(Exact::default()), Rule::from(Contact::default())] {
        let mut world = World::new(Settings::default().with_rule(rule)).unwrap();
        world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
        world.add_collider(cushion(0.3, 0.9, 1.7)).unwrap();
        let ball = Sphere::new(vec(0.0, 0.5, 0.0), 0.1).with_velocity(vec(0.4, 0.0, 0.0));
        world.add_sphere(ball.with_angular_velocity(vec(1.0, 2.0, 25.0))).unwrap();
        let before = world.total_energy();
        let mut explained = 0.0;
        for _ in 0..120 {
            explained += world.step(1.0 / 60.0).unwrap().energy_account.total();
        }
        let open = world.total_energy() - before - explained;
        assert!(open.abs() < 1e-12 * before, "{open}");
    }
}

#[test]
fn a_ratio_outside_one_to_two_is_refused() {
    for ratio in [0.99, 2.01, f64::NAN, f64::INFINITY, -1.0] {
        let mut world = World::default();
        let error = world.add_collider(cushion(0.2, 0.8, ratio)).unwrap_err();
        assert!(error.to_string().contains("cushion"), "{error}");
    }
    let plain = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO));
    let friction = Friction::sliding(0.2).with_tangential_restitution(0.5);
    let coming = ball(vec(0.05, -1.0, 0.0), DVec3::ZERO);
    let after = struck(Exact::default(), plain.with_friction(friction).with_cushion(1.7), coming);
    // The ratio replaces the tangential restitution.
    let without = struck(Exact::default(), cushion(0.2, 1.0, 1.7), coming);
    assert_eq!(after.velocity, without.velocity);
}

#[test]
fn an_edge_answers_like_one_surface_moving_or_not() {
    // Both faces of the rim of a cylinder bear a part of the impulse.
    let answered = |wind: DVec3| {
        let rim = Collider::new(
            Shape::Cylinder { radius: 0.3, height: 0.8 },
            Pose::at(vec(-0.3 - 0.001, -0.4, 0.0)),
        );
        let rim = rim.with_friction(0.25).with_restitution(0.8).with_cushion(1.7);
        let mut world = world(Exact::default(), rim.moving(wind, DVec3::ZERO));
        let id = world.add_sphere(ball(vec(0.3, -1.0, 0.1) + wind, vec(9.0, 2.0, -30.0))).unwrap();
        world.step(0.01).unwrap();
        let after = world.sphere(id).unwrap();
        (after.velocity - wind, RADIUS * after.angular_velocity)
    };
    let (still, moving) = (answered(DVec3::ZERO), answered(vec(0.2, 0.1, -0.3)));
    let off = (still.0 - moving.0).length().max((still.1 - moving.1).length());
    assert!(still.0.y > 0.0 && off < 1e3 * ROUNDING, "{off}");
}

#[test]
fn a_ball_without_slip_has_the_derivative_of_a_small_one() {
    let at = |slip: f64| {
        let mut world = world(Exact::default(), cushion(0.4, 0.9, 1.7));
        let id = world.add_sphere(ball(vec(slip, -1.0, 0.0), DVec3::ZERO)).unwrap();
        let direction = Variation::default().with_velocity(id, DVec3::X);
        let mut tangents = Tangents::new(&world, vec![direction]).unwrap();
        tangents.step(&mut world, 0.2 * RADIUS).unwrap();
        tangents.sphere(0, id).unwrap().velocity.x
    };
    // The slope is a smooth function of the slip from zero on.
    assert!((at(0.0) - at(1e-7)).abs() < 1e-6, "{} and {}", at(0.0), at(1e-7));
}
