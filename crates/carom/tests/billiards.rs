//! Cues that strike balls, and pockets that take them out.

mod common;

use carom::{
    Collider, Contact, DVec3, Error, Exact, Gravity, Pose, Rule, Shape, Sphere, Spring, Strike,
    World,
};
use common::{
    G, Numbers, account_of_run, assert_close, assert_close_vec, bisect, discrete, vec, world,
};

const RADIUS: f64 = 0.028575;
const MASS: f64 = 0.17;

fn ball(place: DVec3) -> Sphere {
    Sphere::new(place, RADIUS).with_mass(MASS)
}

/// A ball after a strike.
fn struck(ball: Sphere, strike: Strike) -> Sphere {
    let mut world = World::default();
    let id = world.add_sphere(ball).unwrap();
    world.strike(id, strike).unwrap();
    world.sphere(id).unwrap()
}

#[test]
fn level_strike_at_the_middle_gives_the_speed_of_an_elastic_impact() {
    let after = struck(ball(DVec3::ZERO), Strike::new(3.0 * DVec3::X, 2.0).with_cue_mass(0.5));
    // Two roundings.
    assert_close(after.velocity.x, 2.0 * 2.0 / (1.0 + MASS / 0.5), 1e-15);
    assert_eq!((after.velocity.y, after.velocity.z), (0.0, 0.0));
    assert_eq!(after.angular_velocity, DVec3::ZERO);
}

/// The speed `F/m` and the spin of Leckie and Greenspan, for a tip at (a, c, b) from the centre with
/// `c = √(R² - a² - b²)`, and a cue along (0, -cos θ, -sin θ).
fn leckie_greenspan([a, b]: [f64; 2], theta: f64, speed: f64, cue_mass: f64) -> (f64, DVec3) {
    let (sine, cosine) = libm::sincos(theta);
    let c = (RADIUS * RADIUS - a * a - b * b).sqrt();
    let turning =
        a * a + (b * cosine) * (b * cosine) + (c * sine) * (c * sine) - 2.0 * b * c * cosine * sine;
    let force = 2.0 * MASS * speed / (1.0 + MASS / cue_mass + 2.5 / (RADIUS * RADIUS) * turning);
    let inertia = 0.4 * MASS * RADIUS * RADIUS;
    let spin = force / inertia * vec(-c * sine + b * cosine, a * sine, -a * cosine);
    (force / MASS, spin)
}

#[test]
fn strikes_have_the_impulse_and_spin_of_leckie_and_greenspan() {
    let mut numbers = Numbers(11);
    for _ in 0..200 {
        let theta = numbers.between(0.0, 1.2);
        let place = [numbers.between(-0.5, 0.5) * RADIUS, numbers.between(-0.3, 0.6) * RADIUS];
        let (speed, cue_mass) = (numbers.between(0.1, 8.0), numbers.between(0.3, 0.8));
        let direction = vec(0.0, -libm::cos(theta), -libm::sin(theta));
        let [a, b] = place;
        let point = vec(a, (RADIUS * RADIUS - a * a - b * b).sqrt(), b);
        // Their tip is on the side that the cue comes from.
        if point.dot(direction) > -0.2 * RADIUS {
            continue;
        }
        let strike = Strike::new(direction, speed).with_offset(point).with_cue_mass(cue_mass);
        let after = struck(ball(DVec3::ZERO), strike);
        let (gained, spin) = leckie_greenspan(place, theta, speed, cue_mass);
        assert_close_vec(after.velocity, gained * direction, 1e-13 * gained);
        // Roundings of the depth of the point, which is a difference of squares.
        assert_close_vec(after.angular_velocity, spin, 1e-12 * gained / RADIUS);
    }
}

#[test]
fn strike_keeps_the_energy_of_cue_and_ball() {
    let mut numbers = Numbers(7);
    for _ in 0..100 {
        let moving = ball(DVec3::ZERO)
            .with_velocity(numbers.vector())
            .with_angular_velocity(20.0 * numbers.vector());
        let (direction, offset) = (numbers.vector().normalize(), 0.5 * RADIUS * numbers.vector());
        let (speed, cue_mass) = (5.0, 0.55);
        let strike = Strike::new(direction, speed).with_offset(offset).with_cue_mass(cue_mass);
        let mut world = World::default();
        let id = world.add_sphere(moving).unwrap();
        let impulse = world.strike(id, strike).unwrap();
        let after = world.sphere(id).unwrap();
        let inertia = 0.4 * MASS * RADIUS * RADIUS;
        let energy = |ball: &Sphere, cue_speed: f64| {
            let spin = inertia * ball.angular_velocity.length_squared();
            0.5 * (MASS * ball.velocity.length_squared() + spin + cue_mass * cue_speed * cue_speed)
        };
        let before = energy(&moving, speed);
        let left = energy(&after, speed - impulse.dot(direction) / cue_mass);
        assert_close(left, before, 1e-14 * before);
    }
}

#[test]
fn ball_struck_at_the_centre_of_percussion_rolls_at_once() {
    let mut world = world(Exact::default());
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let cloth = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_friction(0.2);
    world.add_collider(cloth.with_restitution(0.5)).unwrap();
    let id = world.add_sphere(ball(vec(0.0, RADIUS, 0.0)).with_restitution(0.5)).unwrap();
    world.step(0.01).unwrap();
    let offset = vec(0.0, 0.4 * RADIUS, 0.0);
    world.strike(id, Strike::new(DVec3::X, 1.5).with_offset(offset)).unwrap();
    let speed = world.sphere(id).unwrap().velocity.x;
    for _ in 0..60 {
        world.step(1.0 / 60.0).unwrap();
        let after = world.sphere(id).unwrap();
        assert_close(after.velocity.x, speed, 1e-14 * speed);
        assert_close(after.angular_velocity.z, -speed / RADIUS, 1e-12);
    }
}

#[test]
fn tip_does_not_reach_a_ball_that_moves_ahead_of_it() {
    let moving = ball(DVec3::ZERO).with_velocity(vec(2.0, 0.0, 0.0));
    assert_eq!(struck(moving, Strike::new(DVec3::X, 1.5)), moving);
}

#[test]
fn impossible_strikes_are_refused_with_the_field() {
    let mut world = World::default();
    let id = world.add_sphere(ball(DVec3::ZERO)).unwrap();
    let mut refused = |strike: Strike| world.strike(id, strike).unwrap_err().to_string();
    assert!(refused(Strike::new(DVec3::ZERO, 1.0)).contains("direction"));
    assert!(refused(Strike::new(DVec3::X, -1.0)).contains("speed"));
    assert!(refused(Strike::new(DVec3::X, f64::NAN)).contains("speed"));
    assert!(refused(Strike::new(DVec3::X, 1.0).with_cue_mass(0.0)).contains("cue_mass"));
    let beside = Strike::new(DVec3::X, 1.0).with_offset(vec(9.0, RADIUS, 0.0));
    assert!(refused(beside).contains("offset"));
    assert!(refused(Strike::new(DVec3::X, 1.0).with_offset(DVec3::NAN)).contains("offset"));
    world.remove_sphere(id).unwrap();
    assert!(matches!(world.strike(id, Strike::new(DVec3::X, 1.0)), Err(Error::Unknown(_))));
}

fn rules() -> [Rule; 4] {
    [Exact::default().into(), Contact::default().into(), discrete(), bisect()]
}

fn pocket(place: DVec3, radius: f64) -> Collider {
    Collider::new(Shape::Sphere { radius }, Pose::at(place)).capturing()
}

#[test]
fn balls_that_enter_a_pocket_leave_the_world_with_their_energy_and_springs() {
    for rule in rules() {
        for size in [1e-6, 1.0, 1e6] {
            let mut world = world(rule);
            let hole = world.add_collider(pocket(size * DVec3::X, 0.1 * size)).unwrap();
            let to_pocket = Sphere::new(DVec3::ZERO, 0.1 * size).with_velocity(size * DVec3::X);
            let first = world.add_sphere(to_pocket).unwrap();
            let beside = Sphere::new(vec(0.0, size, 0.0), 0.1 * size);
            let second = world.add_sphere(beside.with_velocity(size * DVec3::X)).unwrap();
            let loose = Spring::between(first, second, 5.0 * size).with_stiffness(0.0);
            world.add_spring(loose).unwrap();
            let (mut entered, mut retired) = (Vec::new(), Vec::new());
            let before = world.total_energy();
            let mut account = 0.0;
            for _ in 0..100 {
                let start = world.time();
                let report = world.step(0.01).unwrap();
                let events = report.sensor_events.iter().filter(|it| it.collider == hole);
                entered.extend(events.map(|it| (it.sphere, it.enters, start + it.time)));
                retired.extend(report.retired.iter().copied());
                account += report.energy_account.total();
            }
            assert_eq!(retired, [first], "{rule:?}");
            assert!(matches!(entered[..], [(sphere, true, _)] if sphere == first), "{entered:?}");
            // The sweep of the other rules is right to the same rounding on a straight way.
            assert_close(entered[0].2, 0.8, 1e-13);
            assert!(world.sphere(first).is_err() && world.sphere(second).is_ok());
            assert_eq!(world.springs().count(), 0);
            assert_close(world.total_energy() - before, account, 1e-15 * before);
        }
    }
}

#[test]
fn small_pocket_misses_no_fast_ball() {
    for rule in rules() {
        let mut world = world(rule);
        world.add_collider(pocket(DVec3::ZERO, 0.005)).unwrap();
        let mut numbers = Numbers(3);
        for _ in 0..50 {
            let way = numbers.vector().normalize();
            let speed = libm::pow(10.0, numbers.between(0.0, 3.0));
            let aside = way.any_orthonormal_vector() * 0.012;
            let start = aside - numbers.between(0.1, 0.9) * speed * way;
            let fast = Sphere::new(start, 0.01).with_velocity(speed * way);
            let id = world.add_sphere(fast).unwrap();
            world.step(1.0).unwrap();
            assert_eq!(world.report().retired, [id]);
        }
    }
}

#[test]
fn break_into_a_pocket_closes_the_account_and_goes_on_from_a_snapshot() {
    for rule in [Exact::default().into(), Rule::from(Contact::default())] {
        let mut world = world(rule);
        world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
        let cloth = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_friction(0.2);
        world.add_collider(cloth.with_restitution(0.5)).unwrap();
        world.add_collider(pocket(vec(0.5, RADIUS, 0.0), 0.03)).unwrap();
        for place in [0.0, 0.2, 0.32] {
            let at = ball(vec(place, RADIUS, 0.0)).with_restitution(0.9).with_friction(0.05);
            world.add_sphere(at).unwrap();
        }
        let cue = world.spheres().ids()[0];
        world.strike(cue, Strike::new(DVec3::X, 1.5)).unwrap();
        let (_, remainder) = account_of_run(&mut world, 6, 1.0 / 60.0);
        let mut other = World::default();
        other.restore(&world.snapshot());
        let (account, rest) = account_of_run(&mut world, 60, 1.0 / 60.0);
        assert!(account.emission < 0.0 && world.spheres().len() < 3, "{account:?}");
        // Rounding of the 0.4 J that the cue gave.
        assert!(remainder.abs() + rest.abs() < 1e-14, "{remainder} {rest}");
        account_of_run(&mut other, 60, 1.0 / 60.0);
        assert_eq!(world.state_hash(), other.state_hash());
    }
}

#[test]
fn only_triggers_capture() {
    let mut solid = pocket(DVec3::ZERO, 1.0);
    solid.trigger = false;
    assert!(World::default().add_collider(solid).unwrap_err().to_string().contains("captures"));
}
