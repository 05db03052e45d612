//! Heavy balls on light ones, up to a ratio of 100 of their sizes and a million of their masses.

use std::f64::consts::SQRT_2;

use carom::{Collider, Contact, DVec3, Exact, Gravity, Pose, Rule, Settings, Shape, Sphere, World};

const FRAME: f64 = 1.0 / 60.0;
/// Density of all balls \[kg/m³\].
const DENSITY: f64 = 2500.0;

fn ball(position: DVec3, radius: f64, friction: f64) -> Sphere {
    Sphere::new(position, radius)
        .with_density(DENSITY)
        .with_restitution(0.0)
        .with_friction(friction)
}

/// A world under gravity with a floor, y = 0, where all lengths are `unit` \[m\].
fn on_a_floor(rule: impl Into<Rule>, friction: f64, unit: f64) -> World {
    let mut world = World::new(Settings::default().with_rule(rule)).unwrap();
    world.add_force(Gravity::new(-9.81 * unit * DVec3::Y)).unwrap();
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_friction(friction);
    world.add_collider(floor.with_restitution(0.0)).unwrap();
    world
}

/// Half the distance of neighbours of the four small balls, of radius 1.
const HALF: f64 = 1.05;

/// Height of the centre of a ball of this radius that stands on four of radius 1.
fn height(ratio: f64) -> f64 {
    1.0 + ((ratio + 1.0) * (ratio + 1.0) - 2.0 * HALF * HALF).sqrt()
}

/// A ball that stands on four small ones of the radius `unit` \[m\]; the large one has the id 0.
fn on_four(rule: impl Into<Rule>, ratio: f64, friction: f64, unit: f64) -> World {
    let mut world = on_a_floor(rule, friction, unit);
    // A gap of rounding, since worlds refuse overlaps at the start.
    let top = unit * (height(ratio) + 1e-9) * DVec3::Y;
    world.add_sphere(ball(top, unit * ratio, friction)).unwrap();
    for (x, z) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)] {
        let place = DVec3::new(HALF * x, 1.0, HALF * z);
        world.add_sphere(ball(unit * place, unit, friction)).unwrap();
    }
    world
}

fn after(mut world: World, frames: u32, frame: f64) -> World {
    for _ in 0..frames {
        world.step(frame).unwrap();
    }
    world
}

#[test]
fn a_ball_stands_on_four_a_hundredth_as_large() {
    for ratio in [3.0, 10.0, 30.0, 100.0] {
        let world = after(on_four(Contact::default(), ratio, 0.5, 0.01), 600, FRAME);
        let missed = world.spheres().positions()[0].y / 0.01 - height(ratio);
        // Overlaps of 0.0005 of the sum of radii stay.
        assert!(missed.abs() < 5e-4, "ratio {ratio}: {missed} of the radius of the small balls");
    }
}

#[test]
fn a_ball_stands_on_four_small_ones_in_a_stepped_zone() {
    for ratio in [10.0, 30.0, 100.0] {
        let world = after(on_four(Exact::default(), ratio, 0.5, 0.01), 300, FRAME);
        let missed = world.spheres().positions()[0].y / 0.01 - height(ratio);
        // Before they are a zone, the balls part by what an impact leaves.
        assert!(missed.abs() < 1e-2, "ratio {ratio}: {missed} of the radius of the small balls");
    }
}

/// A small ball under a heavy one and on the floor bears two forces, and its weight. Their moments about its centre
/// say that both have the same part across; along the floor, that `N sin θ = T (1 + cos θ)` with the force N and T of the
/// heavy ball and the angle θ of its normal to the vertical. So it stays for `T / N = tan(θ/2)` below the friction.
#[test]
fn small_balls_are_squeezed_out_below_a_friction_of_the_tangent_of_half_the_angle() {
    for ratio in [10.0, 100.0] {
        let sine = SQRT_2 * HALF / (ratio + 1.0);
        let least = libm::tan(0.5 * libm::asin(sine));
        for (part, stands) in [(1.01, true), (0.99, false)] {
            let world = after(on_four(Contact::default(), ratio, part * least, 0.01), 120, FRAME);
            let fallen = height(ratio) - world.spheres().positions()[0].y / 0.01;
            assert_eq!(fallen < 1e-3, stands, "ratio {ratio}, friction {part} of that: {fallen}");
        }
    }
}

#[test]
fn a_ball_stands_on_a_column_of_small_ones() {
    for ratio in [3.0, 10.0, 100.0] {
        let mut world = on_a_floor(Contact::default(), 0.0, 0.01);
        for number in 0..5 {
            let place = 0.01 * (1.0 + 2.0 * f64::from(number)) * DVec3::Y;
            world.add_sphere(ball(place, 0.01, 0.0)).unwrap();
        }
        world.add_sphere(ball(0.01 * (10.0 + ratio) * DVec3::Y, 0.01 * ratio, 0.0)).unwrap();
        let world = after(world, 60, FRAME);
        let missed = world.spheres().positions()[5].y / 0.01 - (10.0 + ratio);
        // Overlaps of 0.0005 of the sum of radii stay.
        assert!(missed.abs() < 5e-4, "ratio {ratio}: {missed} of the radius of the small balls");
    }
}

#[test]
fn blocks_have_the_same_bits_at_other_sizes() {
    let unit = 1.0 / 128.0;
    let one = after(on_four(Contact::default(), 20.0, 0.3, unit), 60, 1.0 / 64.0);
    for scale in [1.0 / 1_048_576.0, 1_048_576.0] {
        let other = after(on_four(Contact::default(), 20.0, 0.3, unit * scale), 60, 1.0 / 64.0);
        for (a, b) in one.spheres().positions().iter().zip(other.spheres().positions()) {
            assert_eq!(*a * scale, *b);
        }
    }
}

/// In free space a heavy ball is caught between light ones: nothing but their impulses act.
#[test]
fn a_block_keeps_momentum_and_takes_no_energy_but_that_of_plastic_impacts() {
    let mut world = World::new(Settings::default().with_rule(Contact::default())).unwrap();
    world.add_sphere(ball(DVec3::ZERO, 1.0, 0.5).with_velocity(0.3 * DVec3::X)).unwrap();
    for (x, y) in [(-1.1, 0.0), (1.1, 0.0), (0.0, 1.1), (0.0, -1.1)] {
        let place = DVec3::new(x, y, 0.0);
        world.add_sphere(ball(place, 0.1, 0.5).with_velocity(-place)).unwrap();
    }
    let (momentum, energy) = (world.momentum(), world.kinetic_energy());
    let mut world = after(world, 60, FRAME);
    assert!(world.kinetic_energy() <= energy);
    let change = (world.momentum() - momentum).length();
    // Rounding of some hundred sub-steps.
    assert!(change < 1e-12 * momentum.length(), "{change}");
    world.step(FRAME).unwrap();
}
