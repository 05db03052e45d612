//! Thermostats (`docs/physics/thermostats.md`): Maxwell's distribution and its temperature within the statistical error,
//! a kinetic temperature to rounding, a heating rate, the steady state of a driven granular gas, and an account that
//! closes.

use std::f64::consts::PI;

use carom::packing::{self, Start};
use carom::{
    Boundary, Collider, Contact, DVec3, Error, Friction, Gravity, Pose, Settings, Shape, Sides,
    Sphere, Spring, Thermostat, ViscousDrag, World,
};

mod common;

use common::{Numbers, assert_close, vec};

/// Statistical errors are below this many standard deviations: the seeds are fixed, and one in 10⁶ would fail.
const DEVIATIONS: f64 = 5.0;

const ANDERSEN: Thermostat = Thermostat::Andersen { frequency: 3.0, temperature: 0.7, seed: 5 };
const RESCALE: Thermostat = Thermostat::Rescale { interval: 0.05, temperature: 0.7 };
const NOISE: Thermostat = Thermostat::WhiteNoise { interval: 0.02, strength: 0.5, seed: 5 };

fn settings(thermostat: Thermostat) -> Settings {
    Settings::default().with_thermostat(Some(thermostat))
}

/// Spheres of two masses on a lattice in a periodic cube.
fn gas(thermostat: Thermostat, side: usize, restitution: f64) -> World {
    let edge = 2.0 * side as f64;
    let boundary = Boundary::Periodic { size: DVec3::splat(edge) };
    let mut world = World::new(settings(thermostat).with_boundary(boundary)).unwrap();
    let mut numbers = Numbers(3);
    for number in 0..side * side * side {
        let place = [number % side, number / side % side, number / (side * side)];
        let place = place.map(|it| (it as f64 + 0.5) * 2.0 - 0.5 * edge);
        let sphere = Sphere::new(DVec3::from_array(place), 0.5)
            .with_velocity(numbers.vector())
            .with_mass(1.0 + (number % 2) as f64)
            .with_restitution(restitution);
        world.add_sphere(sphere).unwrap();
    }
    world
}

/// Kinetic temperature \[J\].
fn temperature(world: &World) -> f64 {
    2.0 * world.kinetic_energy() / (3.0 * world.spheres().len() as f64)
}

#[test]
fn andersen_gas_has_maxwells_distribution_at_its_temperature() {
    let mut world = gas(ANDERSEN, 6, 1.0);
    let mut scaled = Vec::new();
    for _ in 0..40 {
        // The velocity of a sphere is a new one with all but e^-9 of the chances.
        world.step(3.0).unwrap();
        let spheres = world.spheres();
        for (mass, velocity) in spheres.masses().iter().zip(spheres.velocities()) {
            scaled.extend((*velocity * (mass / 0.7).sqrt()).to_array());
        }
    }
    let count = scaled.len() as f64;
    let moment =
        |power: i32| scaled.iter().map(|it| libm::pow(*it, f64::from(power))).sum::<f64>() / count;
    // Variances of the powers of a normal number: 1, 2, 15, 96.
    for (power, expected, variance) in
        [(1, 0.0, 1.0), (2, 1.0, 2.0), (3, 0.0, 15.0), (4, 3.0, 96.0)]
    {
        let error = DEVIATIONS * f64::sqrt(variance / count);
        assert_close(moment(power), expected, error);
    }
}

#[test]
fn spheres_of_an_andersen_gas_are_struck_as_often_as_its_rate_says() {
    // Without impacts each sphere has its velocity for an exponential time: exp(-rate t) still have the first one.
    let mut world = World::new(settings(ANDERSEN).with_spheres_collide(false)).unwrap();
    for _ in 0..4000 {
        world.add_sphere(Sphere::new(DVec3::ZERO, 0.5)).unwrap();
    }
    for step in 1..=4 {
        world.step(0.125).unwrap();
        let unstruck = world.spheres().velocities().iter().filter(|it| **it == DVec3::ZERO).count();
        let expected = libm::exp(-3.0 * 0.125 * f64::from(step));
        let error = DEVIATIONS * (4000.0 * expected * (1.0 - expected)).sqrt();
        assert_close(unstruck as f64, 4000.0 * expected, error);
    }
}

#[test]
fn rescaled_gas_has_its_temperature_after_each_change() {
    let mut world = gas(RESCALE, 4, 0.8);
    for _ in 0..20 {
        world.step(0.05).unwrap();
        // A sum of 64 squares.
        assert_close(temperature(&world), 0.7, 1e-12);
    }
    assert!(world.report().energy_account.thermostat > 0.0);
}

#[test]
fn spheres_at_rest_stay_so_where_velocities_are_rescaled() {
    let mut world = World::new(settings(RESCALE)).unwrap();
    world.step(1.0).unwrap();
    world.add_sphere(Sphere::new(DVec3::ZERO, 0.5)).unwrap();
    world.step(1.0).unwrap();
    assert_eq!(world.kinetic_energy(), 0.0);
}

#[test]
fn white_noise_heats_free_spheres_at_its_strength_and_keeps_the_momentum() {
    let mut world = World::new(settings(NOISE).with_spheres_collide(false)).unwrap();
    let count = 1000;
    for number in 0..count {
        let sphere = Sphere::new(DVec3::ZERO, 0.5).with_mass(1.0 + f64::from(number % 2));
        world.add_sphere(sphere).unwrap();
    }
    world.step(4.0).unwrap();
    // Σ m v², of which each component has the mean m ξ₀² t (1 - m/M) and twice its square as variance.
    let masses = world.spheres().masses();
    let total: f64 = masses.iter().sum();
    let means: Vec<f64> = masses.iter().map(|m| m * 0.5 * 4.0 * (1.0 - m / total)).collect();
    let variance: f64 = means.iter().map(|mean| 3.0 * 2.0 * mean * mean).sum();
    let expected = 3.0 * means.iter().sum::<f64>();
    assert_close(2.0 * world.kinetic_energy(), expected, DEVIATIONS * variance.sqrt());
    // 200 changes of 1,000 momenta of about one, each rounded.
    assert!(world.momentum().length() < 1e-10, "{}", world.momentum());
    assert_close(
        world.report().energy_account.thermostat,
        world.kinetic_energy(),
        1e-10 * expected,
    );
}

/// Steady temperature \[J\] of a driven gas of smooth spheres with density `n`, diameter, mass 1, restitution and
/// contact value of the pair distribution: van Noije and Ernst, Granular Matter 1, 57 (1998), with their second
/// Sonine coefficient in the cooling rate.
fn van_noije_ernst(strength: f64, restitution: f64, n: f64, diameter: f64, chi: f64) -> f64 {
    let (d, e) = (3.0, restitution);
    let rate = (1.0 - e * e) * 4.0 * PI * chi * n * diameter * diameter;
    let bare = libm::pow(d * strength * PI.sqrt() / rate, 2.0 / 3.0);
    let sonine = 16.0 * (1.0 - e) * (1.0 - 2.0 * e * e)
        / (73.0 + 56.0 * d - 24.0 * d * e - 105.0 * e + 30.0 * (1.0 - e) * e * e);
    bare * libm::pow(1.0 + 3.0 / 16.0 * sonine, -2.0 / 3.0)
}

#[test]
fn driven_granular_gas_has_the_temperature_of_van_noije_and_ernst() {
    let (radii, fraction, restitution) = (vec![0.5; 500], 0.05, 0.9_f64);
    let mut world = packing::start(&Start::of(radii, 1).with_packing_fraction(fraction)).unwrap();
    let thermostat = Thermostat::WhiteNoise { interval: 0.1, strength: 0.02, seed: 2 };
    let settings = world.settings().with_thermostat(Some(thermostat));
    world.set_settings(settings).unwrap();
    let ids = world.spheres().ids().to_vec();
    for id in ids {
        let mut sphere =
            world.sphere(id).unwrap().with_mass(1.0).with_restitution(restitution.sqrt());
        sphere.radius = 0.5;
        world.set_sphere(id, sphere).unwrap();
    }
    let density = 500.0 / volume_of_box(&world);
    let chi = (1.0 - 0.5 * fraction) / libm::pow(1.0 - fraction, 3.0);
    // Momentum is conserved, so one of N spheres does not count.
    let expected = van_noije_ernst(0.02 * (1.0 - 1.0 / 500.0), restitution, density, 1.0, chi);
    // The temperature relaxes in some 15 s, so 100 s end the start.
    world.step(100.0).unwrap();
    let samples = 100;
    let mean = (0..samples)
        .map(|_| {
            world.step(5.0).unwrap();
            temperature(&world)
        })
        .sum::<f64>()
        / f64::from(samples);
    // Some 30 independent samples of 3.7 %, the fluctuation of 1,500 squares.
    assert_close(mean, expected, 0.02 * expected);
}

/// Volume of the periodic box \[m³\].
fn volume_of_box(world: &World) -> f64 {
    match world.settings().boundary {
        Boundary::Periodic { size } => size.element_product(),
        Boundary::Open => f64::INFINITY,
    }
}

#[test]
fn changes_do_not_depend_on_frames() {
    for thermostat in [ANDERSEN, RESCALE, NOISE] {
        let hashes = [1, 3, 40].map(|frames| {
            let mut world = gas(thermostat, 3, 0.9);
            // Binary parts of 3 s, so that all end at one time.
            let length = 3.0 / f64::from(frames);
            for _ in 0..frames {
                world.step(length).unwrap();
            }
            world.spheres().velocities().to_vec()
        });
        for velocities in &hashes[1..] {
            for (one, other) in hashes[0].iter().zip(velocities) {
                assert_eq!(one, other, "{thermostat:?}");
            }
        }
    }
}

/// Balls on springs and in a box with friction under gravity and drag, of which some lie on the floor.
fn full_world(thermostat: Thermostat) -> World {
    let mut world = World::new(settings(thermostat)).unwrap();
    world.add_force(Gravity::new(DVec3::NEG_Y * 9.81)).unwrap();
    world.add_force(ViscousDrag::new(0.05)).unwrap();
    let walls = Shape::Container { size: DVec3::splat(6.0), open: Sides::NONE };
    let friction = Friction::sliding(0.3);
    let walls = Collider::new(walls, Pose::at(DVec3::ZERO)).with_friction(friction);
    world.add_collider(walls).unwrap();
    let mut numbers = Numbers(9);
    let mut ids = Vec::new();
    for number in 0..27 {
        let place = [number % 3, number / 3 % 3, number / 9].map(|it| (it as f64 - 1.0) * 1.5);
        let sphere = Sphere::new(DVec3::from_array(place), 0.4)
            .with_velocity(numbers.vector())
            .with_friction(friction)
            .with_restitution(0.6);
        ids.push(world.add_sphere(sphere).unwrap());
    }
    world.add_spring(Spring::between(ids[0], ids[1], 1.5).with_stiffness(40.0)).unwrap();
    world
}

#[test]
fn account_closes_with_the_energy_of_thermostats() {
    for thermostat in [ANDERSEN, RESCALE, NOISE] {
        for mut world in [gas(thermostat, 4, 0.8), full_world(thermostat)] {
            for _ in 0..60 {
                let before = world.total_energy();
                let account = world.step(1.0 / 16.0).unwrap().energy_account;
                let scale = before.abs() + world.kinetic_energy() + account.thermostat.abs();
                // Curves under springs are steps of 15th order; zones have an error of their own.
                let tolerance = if world.was_stepped() { 1e-2 } else { 1e-8 };
                assert_close(world.total_energy() - before, account.total(), tolerance * scale);
            }
        }
    }
}

#[test]
fn thermostats_are_refused_where_they_make_no_sense() {
    let refused = |settings: Settings| match World::new(settings) {
        Err(Error::Invalid { source, .. }) => source.field,
        other => panic!("{other:?}"),
    };
    assert_eq!(refused(settings(RESCALE).with_rule(Contact::default())), "thermostat");
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let andersen = Thermostat::Andersen { frequency: bad, temperature: 1.0, seed: 0 };
        assert_eq!(refused(settings(andersen)), "frequency");
        let rescale = Thermostat::Rescale { interval: 1.0, temperature: bad };
        assert_eq!(refused(settings(rescale)), "temperature");
        let noise = Thermostat::WhiteNoise { interval: 1.0, strength: bad, seed: 0 };
        assert_eq!(refused(settings(noise)), "strength");
    }
    let often = Thermostat::Rescale { interval: 1e-9, temperature: 1.0 };
    let mut world = World::new(settings(often)).unwrap();
    world.add_sphere(Sphere::new(vec(0.0, 0.0, 0.0), 0.5)).unwrap();
    assert!(world.check_step(1.0).is_err() && world.step(1.0).is_err());
    assert!(world.step(1e-6).is_ok());
    let id = world.spheres().ids()[0];
    assert!(world.predict(id, 1.0, 10).is_err());
}
