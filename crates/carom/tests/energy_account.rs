//! The energy account: what contacts, moving colliders, corrections and emitters did to the energy of a
//! world, under every rule.

mod common;

use carom::{
    Collider, Contact, DQuat, DVec3, Emitter, EnergyAccount, Exact, Gravity, MotionPart, Pose,
    Rule, Shape, Sides, Sphere, Spring, World,
};
use common::{G, Numbers, account_of_run, assert_close, bisect, discrete, vec, world};

const DOWN: DVec3 = DVec3::new(0.0, -G, 0.0);
const FRAME: f64 = 1.0 / 60.0;

fn exact() -> Rule {
    Exact::default().into()
}

fn contact() -> Rule {
    Contact::default().into()
}

fn heavy_world(rule: Rule) -> World {
    let mut world = world(rule);
    world.add_force(Gravity::new(DOWN)).unwrap();
    world
}

fn floor() -> Collider {
    at_origin(Shape::HalfSpace)
}

fn at_origin(shape: Shape) -> Collider {
    Collider::new(shape, Pose::at(DVec3::ZERO))
}

/// A ball that slides and rolls over a floor into others, bounces, and a box that a ball falls into.
fn busy_world(rule: Rule) -> World {
    let mut world = heavy_world(rule);
    world.add_collider(floor().with_restitution(0.6).with_friction(0.3)).unwrap();
    let turned = Pose { position: vec(4.0, 0.5, 0.0), rotation: DQuat::from_rotation_z(0.3) };
    let size = vec(2.0, 1.0, 2.0);
    world.add_collider(Collider::new(Shape::Box { size }, turned).with_restitution(0.7)).unwrap();
    let ball = |x: f64, y: f64| Sphere::new(vec(x, y, 0.0), 0.1).with_restitution(0.8);
    world.add_sphere(ball(0.0, 0.1).with_velocity(vec(3.0, 0.0, 0.0))).unwrap();
    world.add_sphere(ball(1.0, 0.1).with_friction(0.2)).unwrap();
    world.add_sphere(ball(2.0, 1.5).with_angular_velocity(vec(3.0, 2.0, 30.0))).unwrap();
    world.add_sphere(ball(4.0, 2.0)).unwrap();
    world
}

#[test]
fn under_exact_and_gravity_impacts_and_friction_are_all_that_takes_energy() {
    let mut world = busy_world(exact());
    let largest = world.total_energy();
    let (account, remainder) = account_of_run(&mut world, 240, FRAME);
    // One in a million of sliding paths over edges is the error of their pieces.
    assert!(remainder.abs() < 1e-9 * largest, "{remainder} of {largest}: {account:?}");
    assert!(account.contacts < -0.2 * largest, "{account:?}");
    assert_eq!((account.colliders, account.correction, account.emission), (0.0, 0.0, 0.0));
}

#[test]
fn the_account_does_not_depend_on_how_frames_cut_the_motion() {
    let [fine, coarse] = [1.0 / 240.0, 1.0 / 4.0].map(|dt| {
        let mut world = busy_world(exact());
        account_of_run(&mut world, (4.0 / dt) as usize, dt).0
    });
    assert_close(fine.contacts, coarse.contacts, 1e-12 * fine.contacts.abs());
}

#[test]
fn what_rests_takes_nothing() {
    for rule in [exact(), contact()] {
        let mut world = heavy_world(rule);
        world.add_collider(floor().with_friction(0.5)).unwrap();
        for x in 0..5 {
            let place = vec(0.2 * f64::from(x), 0.1, 0.0);
            world.add_sphere(Sphere::new(place, 0.1).with_restitution(0.9)).unwrap();
        }
        // In a sub-step a ball gains a speed of 0.02 m/s, which the floor takes.
        let (account, remainder) = account_of_run(&mut world, 120, FRAME);
        assert!(account.contacts.abs() < 1e-15, "{rule:?}: {account:?}");
        assert!(remainder.abs() < 1e-15, "{rule:?}: {remainder}");
    }
}

#[test]
fn a_ball_that_slides_until_it_rolls_loses_two_sevenths_of_its_energy() {
    for (rule, tolerance) in [(exact(), 1e-12), (contact(), 1e-2)] {
        let mut world = heavy_world(rule);
        world.add_collider(floor().with_friction(0.4)).unwrap();
        let ball = Sphere::new(vec(0.0, 0.1, 0.0), 0.1).with_mass(2.0);
        world.add_sphere(ball.with_velocity(vec(1.0, 0.0, 0.0))).unwrap();
        let (account, remainder) = account_of_run(&mut world, 60, FRAME);
        assert_close(account.contacts, -2.0 / 7.0, tolerance);
        assert_close(remainder, 0.0, tolerance);
    }
}

#[test]
fn balls_that_push_each_other_lose_what_friction_takes() {
    for friction in [0.05, 0.3] {
        let mut world = heavy_world(exact());
        world.add_collider(floor().with_friction(0.2).with_restitution(0.5)).unwrap();
        // One that slides catches one that rolls, and pushes it.
        let ball = Sphere::new(vec(0.0, 0.1, 0.0), 0.1).with_restitution(0.9);
        let ball = ball.with_friction(friction);
        world.add_sphere(ball.with_velocity(vec(1.0, 0.0, 0.0))).unwrap();
        let ahead = ball.with_position(vec(0.2001, 0.1, 0.001));
        let rolling = ahead.with_velocity(vec(0.9, 0.0, 0.0));
        world.add_sphere(rolling.with_angular_velocity(vec(0.0, 0.0, -9.0))).unwrap();
        let largest = world.total_energy();
        let (account, remainder) = account_of_run(&mut world, 120, FRAME);
        assert!(!world.was_stepped());
        assert!(account.contacts < 0.0);
        // To this their pieces of path are right.
        assert!(remainder.abs() < 1e-9 * largest, "{friction}: {remainder} of {account:?}");
    }
}

#[test]
fn a_belt_gives_what_its_ball_gets_and_friction_takes_half() {
    for (rule, tolerance) in [(exact(), 2e-3), (contact(), 2e-3)] {
        let mut world = heavy_world(rule);
        let belt = floor().with_friction(0.4).moving(vec(1.0, 0.0, 0.0), DVec3::ZERO);
        world.add_collider(belt).unwrap();
        world.add_sphere(Sphere::new(vec(0.0, 0.1, 0.0), 0.1).with_mass(0.2)).unwrap();
        let (account, remainder) = account_of_run(&mut world, 60, FRAME);
        // It comes to roll on the belt, with 2/7 of its speed.
        assert_close(account.colliders, 0.2 * 2.0 / 7.0, tolerance * 0.06);
        assert_close(account.contacts, -0.1 * 2.0 / 7.0, tolerance * 0.03);
        assert_close(remainder, 0.0, tolerance * 0.06);
    }
}

/// A ball of 2 kg on a spring that hardly pulls, so that its forces are computed again at each tick.
fn add_ball_on_a_spring(world: &mut World, ball: Sphere) {
    let ball = world.add_sphere(ball.with_mass(2.0).with_restitution(0.0)).unwrap();
    let spring = Spring::to_point(ball, vec(0.0, -1.0, 0.0), 0.5).with_stiffness(1e-9);
    world.add_spring(spring).unwrap();
}

#[test]
fn a_plate_that_swings_does_the_work_of_a_rise_once() {
    // From its lowest place to its highest, with less than the weight of the ball.
    let (amplitude, frequency) = (0.01, 4.0);
    for frames in [1, 8, 50] {
        let mut world = heavy_world(exact());
        let phase = -0.5 * std::f64::consts::PI;
        let part = MotionPart::Oscillate { axis: DVec3::Y, amplitude, frequency, phase };
        let plate = Collider::new(Shape::HalfSpace, Pose::at(vec(0.0, amplitude, 0.0)));
        world.add_collider(plate.with_restitution(0.0).with_motion([part])).unwrap();
        add_ball_on_a_spring(&mut world, Sphere::new(vec(0.0, 0.1, 0.0), 0.1));
        let length = 0.5 / frequency / f64::from(frames);
        let mut account = EnergyAccount::default();
        for _ in 0..frames {
            let before = world.total_energy();
            let of_frame = world.step(length).unwrap().energy_account;
            let open = world.total_energy() - before - of_frame.total();
            // Frames end within pieces of path.
            assert!(open.abs() < 1e-9 * before, "{open} of {before}: {of_frame:?}");
            account += of_frame;
        }
        let risen = 2.0 * G * 2.0 * amplitude;
        // Pieces of path miss the plate by parts of 1e-7 of a radius.
        assert_close(account.colliders, risen, 1e-8 * risen);
        assert!(account.contacts.abs() < 1e-6 * risen, "{account:?}");
    }
}

#[test]
fn friction_over_a_dome_works_once_where_forces_are_computed_again() {
    let mut world = heavy_world(exact());
    let dome = at_origin(Shape::Sphere { radius: 1.0 });
    world.add_collider(dome.with_restitution(0.0).with_friction(0.3)).unwrap();
    let ball = Sphere::new(vec(0.0, 1.1, 0.0), 0.1).with_friction(0.3);
    add_ball_on_a_spring(&mut world, ball.with_velocity(vec(0.5, 0.0, 0.0)));
    let largest = world.total_energy();
    let (account, remainder) = account_of_run(&mut world, 12, 1.0 / 64.0);
    // It slides until it rolls, as in two sevenths of its energy.
    assert_close(account.contacts, -2.0 / 7.0 * 0.25, 0.05 * 0.25);
    // The error of pieces over a curve.
    assert!(remainder.abs() < 1e-6 * largest, "{remainder} of {account:?}");
}

#[test]
fn a_wall_does_the_work_of_its_impulse() {
    // Under `bisect` a collider passes into a ball at rest.
    for rule in [exact(), contact(), discrete()] {
        let mut world = world(rule);
        let wall = floor();
        let rotation = DQuat::from_rotation_z(-std::f64::consts::FRAC_PI_2);
        let pose = Pose { position: vec(-0.5, 0.0, 0.0), rotation };
        let (wall, speed) = (wall.with_pose(pose), 2.0);
        world.add_collider(wall.moving(vec(speed, 0.0, 0.0), DVec3::ZERO)).unwrap();
        let ball = Sphere::new(DVec3::ZERO, 0.1).with_mass(3.0).with_restitution(0.5);
        world.add_sphere(ball).unwrap();
        let (account, remainder) = account_of_run(&mut world, 30, FRAME);
        // From rest to (1 + e) w: the impulse is m (1 + e) w, and its work that times w.
        let given = 3.0 * 1.5 * speed * speed;
        let is_given = (account.colliders - given).abs() < 1e-14 * given;
        assert!(is_given, "{rule:?}: {account:?}, {remainder}");
        assert_close(account.contacts, -0.5 * 3.0 * 0.75 * speed * speed, 1e-14 * given);
        assert_close(remainder, 0.0, 1e-14 * given);
    }
}

#[test]
fn a_wall_that_strikes_a_ball_at_rest_keeps_the_ledger() {
    let mut world = world(exact());
    let rotation = DQuat::from_rotation_z(-std::f64::consts::FRAC_PI_2);
    let pose = Pose { position: vec(-0.5, 0.0, 0.0), rotation };
    let wall = floor().with_pose(pose);
    world.add_collider(wall.moving(vec(2.0, 0.0, 0.0), DVec3::ZERO)).unwrap();
    world.add_sphere(Sphere::new(DVec3::ZERO, 0.1)).unwrap();
    let report = world.step(0.5).unwrap();
    let [group] = &report.groups[..] else { panic!("{report:?}") };
    assert!(group.momentum_error() < 1e-15 && group.energy_error() < 1e-15, "{group:?}");
}

#[test]
fn bounces_take_what_restitution_demands_under_every_rule() {
    for (rule, tolerance) in
        [(exact(), 1e-13), (contact(), 1e-9), (discrete(), 0.1), (bisect(), 0.05)]
    {
        let mut world = heavy_world(rule);
        world.add_collider(floor()).unwrap();
        let ball = Sphere::new(vec(0.0, 1.1, 0.0), 0.1).with_mass(2.0).with_restitution(0.9);
        world.add_sphere(ball).unwrap();
        // Falls 1 m, in 0.45 s.
        let (account, _) = account_of_run(&mut world, 30, FRAME);
        let demanded = -2.0 * G * (1.0 - 0.81);
        assert_close(account.contacts, demanded, tolerance * demanded.abs());
    }
}

#[test]
fn an_elastic_gas_closes_its_account_under_the_rules_with_impacts() {
    let mut numbers = Numbers(3);
    let states: Vec<[DVec3; 2]> = (0..30).map(|_| [numbers.vector(), numbers.vector()]).collect();
    for rule in [exact(), bisect()] {
        let mut world = world(rule);
        let size = DVec3::splat(4.0);
        let open = carom::Sides::NONE;
        world.add_collider(at_origin(Shape::Container { size, open })).unwrap();
        for [place, velocity] in &states {
            let sphere = Sphere::new(1.8 * *place, 0.05).with_velocity(3.0 * *velocity);
            world.add_sphere(sphere).unwrap();
        }
        let largest = world.total_energy();
        let (account, remainder) = account_of_run(&mut world, 100, FRAME);
        assert!(account.contacts.abs() < 1e-12 * largest, "{rule:?}: {account:?}");
        assert!(remainder.abs() < 1e-12 * largest, "{rule:?}: {remainder}");
    }
}

#[test]
fn emitted_and_retired_balls_are_an_entry() {
    for rule in [exact(), contact(), discrete(), bisect()] {
        let mut world = heavy_world(rule);
        let thrown = Sphere::new(DVec3::ZERO, 0.1).with_velocity(vec(1.0, 5.0, 0.0)).with_mass(2.0);
        let emitter = Emitter::new(thrown.with_angular_velocity(vec(0.0, 9.0, 0.0)), 0.3);
        let emitter = emitter.with_position(vec(0.0, 3.0, 0.0)).with_max_spheres(4);
        world.add_emitter(emitter).unwrap();
        let (account, remainder) = account_of_run(&mut world, 180, FRAME);
        let kinetic = 0.5 * 2.0 * 26.0 + 0.5 * (0.4 * 2.0 * 0.01) * 81.0;
        let each = kinetic + 2.0 * G * 3.0;
        let count = 10.0;
        // Without impacts or integration every ball keeps what it came with.
        let kept = 4.0 * each;
        assert_close(account.emission, kept, 0.05 * count * each);
        assert!(remainder.abs() < 0.05 * each * count, "{rule:?}: {remainder}");
        if matches!(rule, Rule::Exact(_) | Rule::Contact(_)) {
            assert_close(account.emission, kept, 1e-12 * count * each);
            assert!(remainder.abs() < 1e-12 * each * count, "{rule:?}: {remainder}");
        }
    }
}

/// A ball appears in another one that a spring holds: the spring is stretched as they are moved apart.
#[test]
fn what_overlaps_takes_the_work_of_its_spring_from_the_correction() {
    for size in [1.0 / 1048576.0, 1.0, 1048576.0] {
        let mut world = world(exact());
        let ball = |place: DVec3, radius: f64, mass: f64| {
            Sphere::new(size * place, size * radius).with_mass(mass).with_restitution(0.0)
        };
        let held = world.add_sphere(ball(vec(0.16, 0.43, 0.0), 0.5, 2e-4)).unwrap();
        let holding = world.add_sphere(ball(vec(-0.35, -0.51, 0.0), 0.5, 1.0)).unwrap();
        let length = size * vec(0.51, 0.94, 0.0).length();
        world.add_spring(Spring::between(held, holding, length).with_stiffness(1.0)).unwrap();
        let thrown = ball(DVec3::ZERO, 0.1, 1.0).with_velocity(size * vec(0.0, 2.0, 1.0));
        world.add_sphere(thrown).unwrap();
        let (account, remainder) = account_of_run(&mut world, 1, 1.0 / 64.0);
        let energy = size * size * 2.5;
        assert!(account.correction > 1e-3 * energy, "{account:?}");
        // Rounding of a step, and of sums of the energies.
        assert!(remainder.abs() < 1e-12 * energy, "{remainder:e} of {energy:e}, {account:?}");
    }
}

#[test]
fn accounts_close_where_frames_end_before_what_joins_a_zone_comes_to_its_tick() {
    let mut world = heavy_world(exact());
    let turned = Pose::at(DVec3::ZERO).rotated(DQuat::from_rotation_z(0.4));
    let shape = Shape::Container { size: DVec3::ONE, open: Sides::NONE };
    let walls = Collider::new(shape, turned).with_restitution(0.3).with_friction(0.5);
    world.add_collider(walls).unwrap();
    for place in 0..12 {
        let [x, y, z] = [place % 3, place / 6, place / 3 % 2].map(|it| f64::from(it) - 0.5);
        let ball = Sphere::new(0.25 * vec(x - 0.5, y, z), 0.1).with_mass(1.0).with_restitution(0.3);
        world.add_sphere(ball.with_friction(0.5)).unwrap();
    }
    let largest = 12.0 * G;
    let mut joined = 0;
    for frame in 0..3000 {
        let before = world.total_energy();
        let report = world.step(1.0 / 1500.0).unwrap();
        joined += report.zone_account.joined;
        let account = report.energy_account.total();
        let missing = world.total_energy() - before - account;
        // Rounding of some dozen energies.
        assert!(missing.abs() < 1e-13 * largest, "{frame}: {missing:e}");
    }
    assert!(joined > 0);
}
