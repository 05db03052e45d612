//! Gases in front of a piston that moves slowly: proves that its work heats them by the laws of thermodynamics and of
//! mechanics; not that the motion of single spheres is right beyond that.

mod common;

use carom::{
    Boundary, Collider, DQuat, DVec3, Exact, Pose, Settings, Shape, Sphere, World, volume,
};
use common::{Numbers, assert_close, vec};

const RADIUS: f64 = 0.5;

/// A world between a wall at rest and a piston that comes in with a `speed` \[m/s\]. Centres of spheres of a `radius`
/// \[m\] are in a way of this `length` along x \[m\].
fn before_a_piston(settings: Settings, [length, radius]: [f64; 2], speed: f64) -> World {
    let mut world = World::new(settings.with_rule(Exact::default())).unwrap();
    for (x, normal, speed) in [(-radius, DVec3::X, 0.0), (length + radius, DVec3::NEG_X, speed)] {
        let turn = DQuat::from_rotation_arc(DVec3::Y, normal);
        let wall = Collider::new(Shape::HalfSpace, Pose::at(x * DVec3::X).rotated(turn));
        world.add_collider(wall.moving(speed * normal, DVec3::ZERO)).unwrap();
    }
    world
}

/// Pressure of the hard-sphere fluid over that of an ideal gas (Carnahan and Starling, J. Chem. Phys. 51, 635 (1969)).
fn carnahan_starling(p: f64) -> f64 {
    (1.0 + p + p * p - p * p * p) / ((1.0 - p) * (1.0 - p) * (1.0 - p))
}

/// Numbers of spheres across a gas, along each of two axes, and along it.
const ACROSS: usize = 4;
const ALONG: usize = 38;
const COUNT: f64 = (ACROSS * ACROSS * ALONG) as f64;
/// Edge of the periodic box across a gas \[m\].
const EDGE: f64 = 6.0;

/// Adds a gas without momentum, whose centres are in a way of this `length` \[m\].
fn add_gas(world: &mut World, length: f64) {
    let mut numbers = Numbers(5);
    let velocities: Vec<DVec3> = (0..COUNT as usize).map(|_| numbers.vector()).collect();
    let mean = velocities.iter().sum::<DVec3>() / COUNT;
    for (number, velocity) in velocities.into_iter().enumerate() {
        let layer = number / (ACROSS * ACROSS);
        let cells = [layer, number % ACROSS, number / ACROSS % ACROSS];
        let [x, y, z] = cells.map(|cell| cell as f64 + 0.5);
        let part = EDGE / ACROSS as f64;
        let place = vec(x * length / ALONG as f64, y * part, z * part);
        let place = place - vec(0.0, 0.5 * EDGE, 0.5 * EDGE);
        world.add_sphere(Sphere::new(place, RADIUS).with_velocity(velocity - mean)).unwrap();
    }
}

/// `d ln T = -(2/3) Z d ln V` where the piston is slow, so that all states are in equilibrium: kinetic energy rises as
/// temperature does, with 3 N - 2 degrees of freedom, since two components of the momentum stay zero.
#[test]
fn a_slow_piston_heats_a_gas_as_carnahan_and_starling_say() {
    let length = COUNT * volume(RADIUS) / (0.1 * EDGE * EDGE);
    // A velocity has the variance 1/3 along each axis: this is 0.9 % of the thermal speed.
    let speed = 0.005;
    let boundary = Boundary::Periodic { size: vec(f64::INFINITY, EDGE, EDGE) };
    let settings = Settings::default().with_boundary(boundary);
    let mut world = before_a_piston(settings, [length, RADIUS], speed);
    add_gas(&mut world, length);
    let dt = 0.5;
    // Until the lattice is forgotten.
    for _ in 0..40 {
        world.step(dt).unwrap();
    }
    let (start, before) = (world.time(), world.kinetic_energy());
    let mut work = 0.0;
    while world.time() < 0.1 * length / speed {
        work += world.step(dt).unwrap().energy_account.colliders;
    }
    let heated = world.kinetic_energy() / before;

    let steps = 1000;
    let [from, to] = [start, world.time()].map(|time| length - speed * time);
    let mut expected = 0.0;
    for step in 0..steps {
        let place = |part: f64| from + (to - from) * (f64::from(step) + part) / f64::from(steps);
        let fraction = COUNT * volume(RADIUS) / (EDGE * EDGE * place(0.5));
        let change = libm::log(place(1.0) / place(0.0));
        expected -= 2.0 * COUNT / (3.0 * COUNT - 2.0) * carnahan_starling(fraction) * change;
    }
    assert_close(libm::log(heated) / expected, 1.0, 0.01);
    // Rounding of some 10⁵ impacts, which the energy has in all.
    let energy = world.kinetic_energy();
    assert_close(work / energy, (energy - before) / energy, 1e-12);
}

/// Between two impacts on the piston, the way to the wall and back at the speed v takes as long as the piston at the speed
/// u from one place to the next: (v + u) L is the same at each impact, as v L is where the piston is slow.
#[test]
fn without_collisions_speed_times_length_stays_at_every_impact_on_a_piston() {
    for size in [1.0, 1.0 / 1_048_576.0, 1_048_576.0] {
        let (length, speed) = (10.0 * size, 0.003 * size);
        let radius = RADIUS * size;
        let mut world = before_a_piston(Settings::default(), [length, radius], speed);
        let velocity = size * vec(1.0, 0.3, -0.2);
        let ball = Sphere::new(size * vec(2.0, 0.0, 0.0), radius);
        world.add_sphere(ball.with_velocity(velocity)).unwrap();
        let (mut invariant, mut count) = (None, 0);
        while world.time() < 2500.0 {
            let time = world.time();
            for impact in world.step(1.0).unwrap().impacts.clone() {
                if impact.normal.x > 0.0 {
                    continue;
                }
                // The speed before the impact as seen from the piston is v + u.
                let now = impact.approach_speed * (length - speed * (time + impact.time));
                let first = *invariant.get_or_insert(now);
                // Rounding of some hundred impacts.
                assert_close(now / first, 1.0, 1e-12);
                count += 1;
            }
        }
        assert!(count > 150, "{count}");
        let transverse = world.spheres().velocities()[0];
        assert_close(transverse.y / size, 0.3, 1e-14);
    }
}
