//! Impacts that follow each other within a sub-step of the rule `contact`, or strike what is borne: energies,
//! and the limit of short sub-steps.

mod common;

use carom::{
    Collider, Contact, DQuat, DVec3, EnergyAccount, Exact, Gravity, Pose, Rule, Settings, Shape,
    Sides, Sphere, World,
};
use common::{Numbers, vec};

const G: f64 = 9.81;
const FRAME: f64 = 1.0 / 60.0;
/// Lengths of all worlds are multiplied by these, and times by their roots.
const SIZES: [f64; 3] = [1e-6, 1.0, 1e6];

fn exact() -> Rule {
    Exact::default().into()
}

fn contact() -> Rule {
    Contact::default().into()
}

fn heavy_world(rule: Rule) -> World {
    let mut world = World::new(Settings::default().with_rule(rule)).unwrap();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    world
}

fn add_floor(world: &mut World, restitution: f64) {
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO));
    world.add_collider(floor.with_restitution(restitution)).unwrap();
}

/// Steps a world for a time in frames of such a length; its account, and the largest and smallest energy.
fn watch(world: &mut World, seconds: f64, frame: f64) -> (EnergyAccount, [f64; 2]) {
    let mut account = EnergyAccount::default();
    let mut range = [world.total_energy(); 2];
    for _ in 0..(seconds / frame).round() as u32 {
        account += world.step(frame).unwrap().energy_account;
        let energy = world.total_energy();
        range = [range[0].min(energy), range[1].max(energy)];
    }
    (account, range)
}

#[test]
fn energy_of_a_ball_bouncing_on_a_borne_ball_is_kept() {
    for size in SIZES {
        for (restitution, masses) in [(0.5, [1000.0, 1.0]), (0.0, [1.0, 1.0]), (1.0, [1.0, 3.0])] {
            let mut world = heavy_world(contact());
            add_floor(&mut world, restitution);
            let radius = 0.125 * size;
            let ball = |height: f64, mass: f64| {
                Sphere::new(vec(0.0, height * size, 0.0), radius).with_mass(mass)
            };
            world.add_sphere(ball(0.125, masses[0])).unwrap();
            world.add_sphere(ball(1.5, masses[1])).unwrap();
            let bouncing = masses[1] * G * 1.125 * size;
            let start = world.total_energy();
            let scale = size.sqrt();
            let (account, [least, most]) = watch(&mut world, 60.0 * scale, FRAME * scale);
            // Impulses are iterated to a part of 1e-12 of the largest, in sixty bounces.
            let tolerance = 1e-9 * bouncing;
            assert!((most - start).abs() < tolerance, "{size} {masses:?}: {most} of {start}");
            assert!((least - start).abs() < tolerance, "{size} {masses:?}: {least} of {start}");
            assert!(account.contacts.abs() < tolerance, "{account:?}");
        }
    }
}

#[test]
fn a_ball_that_bounces_on_a_stack_keeps_its_energy() {
    let mut world = heavy_world(contact());
    add_floor(&mut world, 0.0);
    for number in 0..5 {
        world.add_sphere(Sphere::new(vec(0.0, 0.1 + 0.2 * f64::from(number), 0.0), 0.1)).unwrap();
    }
    world.add_sphere(Sphere::new(vec(0.0, 2.0, 0.0), 0.1)).unwrap();
    let start = world.total_energy();
    let (account, [least, most]) = watch(&mut world, 20.0, FRAME);
    // What comes to rest at first: m (g h)² for each.
    let tolerance = 1e-3 * start;
    assert!(most - start < 1e-9 * start, "{most} of {start}, {account:?}");
    assert!(start - least < tolerance, "{least} of {start}, {account:?}");
}

/// A ball over the seam of two boards that rise from it.
fn vee(degrees: f64, offset: f64, restitution: f64) -> World {
    let mut world = heavy_world(contact());
    let angle = degrees.to_radians();
    for side in [1.0, -1.0] {
        let pose = Pose {
            position: vec(side * 0.5 * libm::cos(angle), 0.5 * libm::sin(angle), 0.0),
            rotation: DQuat::from_rotation_z(side * angle),
        };
        let board = Shape::Rectangle { size_x: 1.0, size_z: 1.0 };
        world.add_collider(Collider::new(board, pose)).unwrap();
    }
    let ball = Sphere::new(vec(offset, 1.05, 0.0), 0.05).with_restitution(restitution);
    world.add_sphere(ball).unwrap();
    world
}

#[test]
fn an_elastic_ball_keeps_its_energy_in_a_vee() {
    for degrees in [1.0, 5.0, 10.0, 30.0, 45.0] {
        for offset in [0.0, 0.0005, 0.01] {
            let mut world = vee(degrees, offset, 1.0);
            let start = world.total_energy();
            let (account, [least, most]) = watch(&mut world, 10.0, FRAME);
            let tolerance = 1e-9 * start;
            assert!(
                most - start < tolerance && start - least < tolerance,
                "{degrees} {offset}: {least} to {most} of {start}, {account:?}"
            );
        }
    }
}

#[test]
fn an_elastic_ball_over_the_seam_of_a_symmetric_vee_comes_straight_back() {
    for degrees in [1.0, 5.0, 10.0, 30.0, 45.0] {
        let mut world = vee(degrees, 0.0, 1.0);
        let mut highest: f64 = 0.0;
        for _ in 0..65 {
            world.step(FRAME).unwrap();
            let [at] = world.spheres().positions() else { panic!("one ball") };
            if world.time() > 0.6 {
                highest = highest.max(at.y);
            }
        }
        // The top of a flight may lie between two frames.
        let missed = 0.5 * G * (0.5 * FRAME) * (0.5 * FRAME);
        assert!((highest - 1.05).abs() < missed + 1e-6, "{degrees}: {highest}");
    }
}

/// A cue ball, and a rack with gaps of 30 um, on a table without friction.
fn rack(rule: Rule) -> World {
    let radius = 0.028575;
    let mut world = heavy_world(rule);
    add_floor(&mut world, 0.5);
    let cushions = Shape::Container {
        size: vec(2.54, 0.4, 1.27),
        open: Sides { top: true, bottom: true, ..Sides::NONE },
    };
    let cushions = Collider::new(cushions, Pose::at(vec(0.0, 0.2, 0.0))).with_restitution(0.8);
    world.add_collider(cushions).unwrap();
    let ball = |x: f64, z: f64| {
        Sphere::new(vec(x, radius, z), radius).with_mass(0.17).with_restitution(0.95)
    };
    let speed = 3.0 * vec(libm::cos(0.01), 0.0, libm::sin(0.01));
    world.add_sphere(ball(-0.635, 0.0).with_velocity(speed)).unwrap();
    let step = 2.0 * radius * 1.0005;
    for row in 0..5 {
        for place in 0..=row {
            let across = f64::from(place) - 0.5 * f64::from(row);
            let x = 0.6 + f64::from(row) * step * 0.8660254;
            world.add_sphere(ball(x, across * step)).unwrap();
        }
    }
    world
}

#[test]
fn the_energy_of_a_gapped_rack_converges_with_the_frame() {
    let after = |rule: Rule, frame: f64| {
        let mut world = rack(rule);
        watch(&mut world, 0.42, frame);
        world.kinetic_energy() / (0.5 * 0.17 * 9.0)
    };
    let limit = after(exact(), FRAME / 4.0);
    assert!((limit - 0.6346).abs() < 1e-3, "{limit}");
    let mut last = 0.05 * limit;
    let mut all = Vec::new();
    for frame in [1.0, 4.0, 20.0, 80.0].map(|part| 0.42 / (25.0 * part)) {
        let error = (after(contact(), frame) - limit).abs();
        all.push(error);
        // Below that, it is the first contact of the cue ball that rounding moves.
        assert!(error <= last.max(1e-3), "{frame}: {all:?} of {limit}");
        last = error;
    }
}

#[test]
fn what_bounces_in_a_tube_never_gains() {
    // Under `exact` they are stepped.
    for (rule, size) in SIZES.map(|size| (contact(), size)).into_iter().chain([(exact(), 1.0)]) {
        let mut world = heavy_world(rule);
        let shape = Shape::Container { size: vec(0.2, 4.0, 0.2) * size, open: Sides::NONE };
        let tube = Collider::new(shape, Pose::at(DVec3::ZERO)).with_restitution(0.0);
        world.add_collider(tube.with_friction(0.3)).unwrap();
        for (height, speed) in [(-1.5, 2.0), (-1.28, 0.0)] {
            let ball = Sphere::new(vec(0.0, height * size, 0.0), 0.1 * size).with_friction(0.3);
            world.add_sphere(ball.with_velocity(vec(0.0, speed * size.sqrt(), 0.0))).unwrap();
        }
        let start = world.total_energy();
        let scale = size.sqrt();
        let (account, [_, most]) = watch(&mut world, 60.0 * scale, FRAME * scale);
        assert_eq!(world.was_stepped(), rule == exact());
        assert!(most <= start + 1e-12 * start.abs(), "{size}: {most} of {start}, {account:?}");
        assert!(account.contacts < 0.0);
        let remainder = world.total_energy() - start - account.total();
        // What falls comes to rest as if it had moved with its mean velocity in a sub-step: m g h s at 3 m/s.
        assert!(remainder.abs() < 5e-3 * start.abs(), "{size}: {remainder}, {account:?}");
    }
}

#[test]
fn an_elastic_ball_keeps_its_energy_between_a_slope_and_a_steep_wall() {
    for size in SIZES {
        let mut world = heavy_world(contact());
        for degrees in [20.0_f64, -75.0] {
            let rotation = DQuat::from_rotation_z(degrees.to_radians());
            world
                .add_collider(Collider::new(
                    Shape::HalfSpace,
                    Pose { position: DVec3::ZERO, rotation },
                ))
                .unwrap();
        }
        let ball = Sphere::new(vec(0.05, 1.0, 0.0) * size, 0.1 * size);
        world.add_sphere(ball).unwrap();
        let start = world.total_energy();
        let scale = size.sqrt();
        let (account, [least, most]) = watch(&mut world, 60.0 * scale, FRAME * scale);
        let tolerance = 1e-9 * start;
        assert!(most - start < tolerance, "{size}: {most} of {start}, {account:?}");
        assert!(start - least < tolerance, "{size}: {least} of {start}, {account:?}");
    }
}

/// Too many to be followed one by one.
#[test]
fn a_ball_that_bounces_on_a_large_layer_gains_nothing() {
    for size in SIZES {
        let mut world = heavy_world(contact());
        add_floor(&mut world, 0.0);
        let ball = |x: f64, y: f64, z: f64| Sphere::new(vec(x, y, z) * size, 0.1 * size);
        for number in 0..100 {
            let (x, z) = (0.2 * f64::from(number % 10), 0.2 * f64::from(number / 10));
            world.add_sphere(ball(x, 0.1, z)).unwrap();
        }
        world.add_sphere(ball(1.0, 1.5, 1.0)).unwrap();
        let start = world.total_energy();
        let scale = size.sqrt();
        let (account, [_, most]) = watch(&mut world, 60.0 * scale, FRAME * scale);
        assert!(most - start < 1e-12 * start, "{size}: {most} of {start}, {account:?}");
        assert!(account.contacts <= 0.0, "{size}: {account:?}");
    }
}

#[test]
fn elastic_balls_in_a_box_keep_their_energy_when_several_meet_in_a_sub_step() {
    for speed in [5.0, 20.0] {
        let mut world = World::new(Settings::default().with_rule(contact())).unwrap();
        let shape = Shape::Container { size: DVec3::ONE, open: Sides::NONE };
        world.add_collider(Collider::new(shape, Pose::at(DVec3::ZERO))).unwrap();
        let mut numbers = Numbers(3);
        for number in 0..20 {
            let cell = vec(f64::from(number % 3), f64::from(number / 9), f64::from(number / 3 % 3));
            let place = 0.3 * (cell - 1.0) + 0.05 * numbers.vector();
            let ball = Sphere::new(place, 0.03);
            let direction = numbers.vector().normalize();
            world.add_sphere(ball.with_velocity(speed * direction)).unwrap();
        }
        let start = world.kinetic_energy();
        let (account, [least, most]) = watch(&mut world, 10.0, FRAME);
        // Some roundings for each of some thousand impacts.
        let tolerance = 1e-12 * start;
        assert!(
            most - start < tolerance && start - least < tolerance,
            "{speed}: {least} to {most} of {start}, {account:?}"
        );
    }
}

/// Elastic balls of 1 kg in a box without forces, as many along each edge, which fill this part of the plane or of
/// space.
fn gas(across: [i32; 3], packing: f64) -> World {
    let mut world = World::new(Settings::default().with_rule(contact())).unwrap();
    let radius: f64 = 0.05;
    let is_flat = across[2] == 1;
    let of_ball = std::f64::consts::PI * if is_flat { 1.0 } else { 4.0 / 3.0 };
    let cell =
        radius * if is_flat { (of_ball / packing).sqrt() } else { libm::cbrt(of_ball / packing) };
    let counts = across.map(f64::from);
    let size = cell * DVec3::from_array(counts);
    let walls =
        Shape::Container { size: if is_flat { size.with_z(1.0) } else { size }, open: Sides::NONE };
    let walls = Collider::new(walls, Pose::at(DVec3::ZERO));
    world.add_collider(walls.with_restitution(1.0)).unwrap();
    let mut numbers = Numbers(7);
    for number in 0..across.into_iter().product() {
        let place =
            [number % across[0], number / across[0] % across[1], number / across[0] / across[1]];
        let place = cell * (DVec3::from_array(place.map(f64::from)) + 0.5) - 0.5 * size;
        let velocity = 2.0 * numbers.vector();
        let velocity = if is_flat { velocity.with_z(0.0) } else { velocity };
        let ball = Sphere::new(if is_flat { place.with_z(0.0) } else { place }, radius);
        let ball = ball.with_mass(1.0).with_velocity(velocity).with_restitution(1.0);
        world.add_sphere(ball).unwrap();
    }
    world
}

#[test]
fn elastic_balls_in_a_crowded_box_keep_their_energy() {
    // Islands of balls of different speeds reach into each other, and grow to the whole gas.
    for (across, packing, seconds) in [
        ([2, 2, 1], 0.6, 2.0),
        ([4, 4, 1], 0.6, 2.0),
        ([6, 6, 1], 0.5, 2.0),
        ([10, 10, 1], 0.3, 1.0),
        ([10, 10, 1], 0.6, 1.0),
        ([10, 10, 1], 0.75, 0.5),
        ([6, 6, 6], 0.3, 0.3),
        ([32, 32, 1], 0.1, 0.2),
        ([32, 32, 1], 0.6, 0.1),
        ([10, 10, 10], 0.4, 0.1),
    ] {
        let mut world = gas(across, packing);
        let start = world.total_energy();
        let (account, [least, _]) = watch(&mut world, seconds, FRAME);
        // Each of some thousand impacts is iterated to 1e-12 of the largest impulse.
        assert!((least - start).abs() < 1e-9 * start, "{across:?} {packing}: {least} of {start}");
        assert!(account.contacts.abs() < 1e-9 * start, "{across:?} {packing}: {account:?}");
    }
}
