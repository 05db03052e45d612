//! Kicks: a surface that kicks sends a sphere off with `e v + kick` under every rule, and the account has its
//! energy.

mod common;

use carom::{
    Collider, Contact, DQuat, DVec3, EnergyAccount, Gravity, Pose, Rule, Settings, Shape, Sides,
    Sphere, World,
};
use common::{Numbers, assert_close, bisect, discrete, vec};

fn rules() -> [Rule; 4] {
    [Rule::default(), Rule::Contact(Contact::default()), bisect(), discrete()]
}

fn world(rule: Rule) -> World {
    World::new(Settings::default().with_rule(rule)).unwrap()
}

/// What the account lacks after some frames \[J\].
fn unaccounted(world: &mut World, frames: usize, dt: f64) -> (f64, EnergyAccount) {
    let before = world.total_energy();
    let mut account = EnergyAccount::default();
    for _ in 0..frames {
        account += world.step(dt).unwrap().energy_account;
    }
    (world.total_energy() - before - account.total(), account)
}

#[test]
fn a_ball_leaves_a_kicker_with_e_v_plus_kick_under_every_rule() {
    let shapes = [
        (Shape::HalfSpace, vec(0.0, 0.0, 0.0)),
        (Shape::Sphere { radius: 0.5 }, vec(0.0, -0.5, 0.0)),
        (Shape::Box { size: DVec3::ONE }, vec(0.0, -0.5, 0.0)),
        (Shape::Rectangle { size_x: 1.0, size_z: 1.0 }, DVec3::ZERO),
    ];
    for rule in rules() {
        for (shape, place) in shapes.clone() {
            let mut world = world(rule);
            let kicker =
                Collider::new(shape.clone(), Pose::at(place)).with_restitution(0.5).with_kick(3.0);
            world.add_collider(kicker).unwrap();
            let ball = Sphere::new(vec(0.0, 0.12, 0.0), 0.1).with_velocity(vec(0.3, -2.0, 0.0));
            let ball = world.add_sphere(ball.with_mass(2.0)).unwrap();
            let (rest, account) = unaccounted(&mut world, 2, 1.0 / 60.0);
            let velocity = world.sphere(ball).unwrap().velocity;
            if !matches!(shape, Shape::Sphere { .. }) {
                assert_close(velocity.y, 0.5 * 2.0 + 3.0, 1e-12);
                assert_close(velocity.x, 0.3, 0.0);
                // From 1 m/s to 4 m/s, of 2 kg; restitution takes 3/4 of 4 J.
                assert_close(account.kicks, 15.0, 1e-12);
                assert_close(account.contacts, -3.0, 1e-12);
            }
            assert!(account.kicks > 10.0, "{rule:?} {shape:?}: {account:?}");
            assert_close(rest, 0.0, 1e-12);
        }
    }
}

#[test]
fn reports_tell_the_kick_and_the_ledger_leaves_it_out() {
    let mut world = World::default();
    let kicker = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_kick(1.0);
    world.add_collider(kicker.moving(vec(0.0, 0.5, 0.0), DVec3::ZERO)).unwrap();
    world
        .add_sphere(Sphere::new(vec(0.0, 2.0, 0.0), 1.0).with_velocity(vec(0.0, -1.0, 0.0)))
        .unwrap();
    let report = world.step(1.0).unwrap();
    let (impact, group) = (report.impacts[0], report.groups[0]);
    assert_eq!((impact.kick, impact.approach_speed, impact.separation_speed), (1.0, 1.5, 2.5));
    // From 1.5 to 2.5 m/s beside the surface, of 1 kg; the surface itself does work, too.
    assert_close(group.kick_work, 2.0, 1e-12);
    assert_close(group.energy_error(), 0.0, 1e-12);
    assert_close(report.energy_account.total(), 0.5 * 9.0 - 0.5, 1e-12);
}

#[test]
fn a_game_of_balls_among_bumpers_keeps_its_account() {
    for rule in rules() {
        let mut world = world(rule);
        world.add_force(Gravity::new(vec(0.0, -9.81, 0.0))).unwrap();
        let shape = Shape::Container { size: DVec3::splat(3.0), open: Sides::NONE };
        let walls = Collider::new(shape, Pose::at(DVec3::ZERO)).with_restitution(0.6);
        world.add_collider(walls).unwrap();
        let mut numbers = Numbers(3);
        for number in 0..5 {
            let place = Pose::at(vec(f64::from(number) * 0.55 - 1.1, -0.6, 0.0));
            let bumper = Collider::new(Shape::Sphere { radius: 0.2 }, place).with_restitution(0.5);
            world.add_collider(bumper.with_kick(1.5)).unwrap();
        }
        for _ in 0..8 {
            let place = vec(1.2, 0.5, 1.2) * numbers.vector() + vec(0.0, 0.7, 0.0);
            world.add_sphere(Sphere::new(place, 0.08).with_mass(0.1)).unwrap();
        }
        let (rest, account) = unaccounted(&mut world, 120, 1.0 / 60.0);
        assert!(account.kicks.is_finite() && account.kicks >= 0.0);
        let is_by_frame = matches!(rule, Rule::Bisect(_) | Rule::Discrete(_));
        // Semi-implicit Euler loses m g² h²/2 of each ball in each frame, but where balls rest.
        let frame = 9.81 / 60.0;
        let loss = if is_by_frame { 8.0 * 120.0 * 0.1 * 0.5 * frame * frame } else { 0.0 };
        assert_close(rest, -loss, if is_by_frame { 0.02 * loss } else { 1e-11 });
    }
}

#[test]
fn worlds_without_kicks_have_none_in_their_account() {
    for rule in rules() {
        let mut world = world(rule);
        world.add_force(Gravity::new(vec(0.0, -9.81, 0.0))).unwrap();
        let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_restitution(0.0);
        world.add_collider(floor).unwrap();
        world.add_sphere(Sphere::new(vec(0.0, 0.1, 0.0), 0.1)).unwrap();
        let (_, account) = unaccounted(&mut world, 30, 1.0 / 60.0);
        assert_eq!(account.kicks, 0.0, "{rule:?}");
    }
}

#[test]
fn a_kick_too_small_to_lift_a_ball_leaves_it_at_rest() {
    for rule in rules() {
        let mut world = world(rule);
        world.add_force(Gravity::new(vec(0.0, -9.81, 0.0))).unwrap();
        let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_restitution(0.0);
        world.add_collider(floor.with_kick(1e-6)).unwrap();
        for number in 0..8 {
            let place = vec(f64::from(number), 0.1 + 0.01 * f64::from(number), 0.0);
            world.add_sphere(Sphere::new(place, 0.1)).unwrap();
        }
        let mut impacts = 0;
        for _ in 0..60 {
            impacts += world.step(1.0 / 60.0).unwrap().impacts.len();
        }
        if matches!(rule, Rule::Exact(_) | Rule::Contact(_)) {
            assert!(impacts <= 16, "{rule:?}: {impacts}");
        }
    }
}

/// Wherever rounding puts the edge for each of its two faces.
#[test]
fn a_kick_at_an_edge_of_a_box_is_given_once() {
    let mut numbers = Numbers(7);
    for number in 0..400 {
        let rule =
            if number % 4 == 0 { Rule::Contact(Contact::default()) } else { Rule::default() };
        let mut world = world(rule);
        let place = if number < 4 { DVec3::ZERO } else { numbers.vector() };
        let pose = Pose::at(place).rotated(DQuat::from_rotation_z(std::f64::consts::FRAC_PI_4));
        let edge = Collider::new(Shape::Box { size: DVec3::ONE }, pose).with_kick(2.0);
        world.add_collider(edge.with_restitution(0.0)).unwrap();
        let top = std::f64::consts::FRAC_1_SQRT_2;
        let ball = Sphere::new(place + vec(0.0, top + 0.2, 0.0), 0.1);
        let ball = world.add_sphere(ball.with_velocity(vec(0.0, -8.0, 0.0))).unwrap();
        world.step(1.0 / 60.0).unwrap();
        world.step(1.0 / 60.0).unwrap();
        assert_close(world.sphere(ball).unwrap().velocity.y, 2.0, 1e-9);
    }
}

#[test]
fn a_kick_that_makes_no_sense_is_refused() {
    let mut world = World::default();
    for kick in [-1.0, f64::NAN, f64::INFINITY] {
        let wall = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_kick(kick);
        let error = world.add_collider(wall).unwrap_err().to_string();
        assert!(error.contains("`kick` must be zero or positive"), "{error}");
    }
}
