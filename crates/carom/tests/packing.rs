//! Dense packings and fluids by growth (`carom::packing`): they come to the packing fraction or the pressure asked
//! for, without overlap, and press as published equations of state say.

use carom::packing::{self, Compression, Start, Until};
use carom::{
    Boundary, Collider, DVec3, Error, Pose, Settings, Shape, Sides, Sphere, World, volume,
};

mod common;

use common::assert_close;

/// Pressure of the hard-sphere fluid by Carnahan and Starling, J. Chem. Phys. 51, 635 (1969).
fn carnahan_starling(p: f64) -> f64 {
    (1.0 + p + p * p - p * p * p) / ((1.0 - p) * (1.0 - p) * (1.0 - p))
}

fn fluid(count: usize, fraction: f64) -> World {
    let start = Start::of(vec![0.5; count], 3).with_packing_fraction(fraction);
    let mut world = packing::start(&start).unwrap();
    let until = Compression::until(Until::PackingFraction(fraction)).with_growth(0.05);
    assert!(packing::compress(&mut world, &until).unwrap().is_reached);
    world
}

#[test]
fn compression_ends_at_the_packing_fraction_with_the_radii_asked_for() {
    let radii: Vec<f64> = (0..200).map(|number| [0.5, 0.7][number % 2]).collect();
    let start = Start::of(radii.clone(), 1).with_packing_fraction(0.5);
    let mut world = packing::start(&start).unwrap();
    let energy = world.kinetic_energy();
    let compression = Compression::until(Until::PackingFraction(0.5)).with_growth(0.02);
    let compressed = packing::compress(&mut world, &compression).unwrap();
    assert!(compressed.is_reached && compressed.collisions > 1000);
    // Radii grow in some hundred frames, in each of which they are rounded.
    assert_close(compressed.packing_fraction, 0.5, 1e-12);
    for (radius, asked) in world.spheres().radii().iter().zip(&radii) {
        assert_close(*radius, *asked, 1e-12);
    }
    assert!(world.overlaps(1e-12).is_empty());
    assert!(world.spheres().growth_speeds().iter().all(|&speed| speed == 0.0));
    assert!(compressed.energy_gained > 0.0 && world.kinetic_energy() < 2.0 * energy);
}

#[test]
fn compressed_fluid_presses_as_carnahan_and_starling_say() {
    for fraction in [0.3, 0.45] {
        let mut world = fluid(500, fraction);
        packing::equilibrate(&mut world, 100.0, None).unwrap();
        let measured = packing::equilibrate(&mut world, 200.0, None).unwrap();
        let expected = carnahan_starling(fraction);
        // 50,000 collisions scatter by half a per cent; 500 spheres differ from many by as much.
        let error = (measured.pressure / expected - 1.0).abs();
        assert!(error < 0.015, "{} instead of {expected}", measured.pressure);
        // Each collision gives the virial √π/2 of a crossing on the mean: the rate follows from the pressure.
        let rate = 12.0 / std::f64::consts::PI.sqrt() * (measured.pressure - 1.0) / 2.0;
        assert!((measured.collision_rate / rate - 1.0).abs() < 0.02, "{}", measured.collision_rate);
    }
}

#[test]
fn jammed_spheres_end_a_compression_by_their_pressure() {
    let mut world = packing::start(&Start::of(vec![0.5; 200], 5)).unwrap();
    let compression = Compression::until(Until::PackingFraction(0.74)).with_growth(0.02);
    let compression = compression.with_most_pressure(1e6);
    let compressed = packing::compress(&mut world, &compression).unwrap();
    assert!(!compressed.is_reached);
    // Random close packing; of so few spheres it scatters by a hundredth.
    assert!((0.62..0.66).contains(&compressed.packing_fraction), "{compressed:?}");
    assert!(world.overlaps(1e-12).is_empty());
    let rattlers = packing::rattlers(&world, 100.0 / compressed.fluid.pressure).unwrap();
    // Some per cent of the spheres, in published packings: Torquato and Stillinger (2010).
    assert!(0 < rattlers && rattlers < 20, "{rattlers}");
}

#[test]
fn compression_ends_at_a_pressure_or_a_collision_rate() {
    for until in [Until::Pressure(10.0), Until::CollisionRate(30.0)] {
        let mut world = packing::start(&Start::of(vec![0.5; 200], 5)).unwrap();
        let compression = Compression::until(until).with_growth(0.05);
        let compressed = packing::compress(&mut world, &compression).unwrap();
        assert!(compressed.is_reached);
        let fluid = compressed.fluid;
        match until {
            Until::Pressure(_) => assert!((10.0..13.0).contains(&fluid.pressure), "{fluid:?}"),
            _ => assert!((30.0..40.0).contains(&fluid.collision_rate), "{fluid:?}"),
        }
    }
}

#[test]
fn compression_is_the_same_in_every_run_and_differs_by_seed() {
    let hash = |seed: u64| {
        let mut world = packing::start(&Start::of(vec![0.5; 60], seed)).unwrap();
        let compression = Compression::until(Until::PackingFraction(0.4)).with_growth(0.1);
        packing::compress(&mut world, &compression).unwrap();
        world.state_hash()
    };
    assert_eq!(hash(1), hash(1));
    assert_ne!(hash(1), hash(2));
}

#[test]
fn spheres_in_a_container_are_compressed() {
    let mut world = World::default();
    let shape = Shape::Container { size: DVec3::splat(4.0), open: Sides::NONE };
    world.add_collider(Collider::new(shape, Pose::at(DVec3::ZERO))).unwrap();
    for number in 0..64 {
        let along = |number: i32| f64::from(number % 4) - 1.5;
        let place = DVec3::new(along(number), along(number / 4), along(number / 16));
        let velocity = DVec3::new(f64::from(number % 5) - 2.0, f64::from(number % 7) - 3.0, 0.5);
        world.add_sphere(Sphere::new(place, 0.1).with_velocity(velocity)).unwrap();
    }
    let compression = Compression::until(Until::PackingFraction(0.4)).with_growth(0.1);
    let unknown = packing::compress(&mut world, &compression).unwrap_err();
    assert!(unknown.to_string().contains("volume"), "{unknown}");
    let compressed = packing::compress(&mut world, &compression.with_volume(64.0)).unwrap();
    let filled: f64 = world.spheres().radii().iter().map(|&radius| volume(radius)).sum();
    assert_close(filled / 64.0, 0.4, 1e-12);
    assert!(compressed.is_reached && world.overlaps(1e-12).is_empty());
}

#[test]
fn no_sphere_of_a_crystal_is_a_rattler_but_one_in_a_cage_is() {
    let size = DVec3::splat(4.0);
    let settings = Settings::default().with_boundary(Boundary::Periodic { size });
    let mut world = World::new(settings).unwrap();
    // A simple cubic lattice that touches: six contacts each. One sphere is smaller.
    for number in 0..64 {
        let along = |number: i32| f64::from(number % 4) - 1.5;
        let place = DVec3::new(along(number), along(number / 4), along(number / 16));
        let radius = if number == 21 { 0.3 } else { 0.5 };
        world.add_sphere(Sphere::new(place, radius)).unwrap();
    }
    assert_eq!(packing::rattlers(&world, 1e-6).unwrap(), 1);
    assert_eq!(packing::rattlers(&world, 0.3).unwrap(), 0);
}

#[test]
fn numbers_that_make_no_sense_are_refused() {
    let says = |error: Error, part: &str| assert!(error.to_string().contains(part), "{error}");
    says(packing::start(&Start::of(vec![], 0)).unwrap_err(), "radii");
    says(packing::start(&Start::of(vec![-1.0], 0)).unwrap_err(), "radius");
    says(packing::start(&Start::of(vec![0.5; 2], 0)).unwrap_err(), "four times");
    let dense = Start::of(vec![0.5; 20], 0).with_packing_fraction(1.0);
    says(packing::start(&dense).unwrap_err(), "packing_fraction");
    let mut world = packing::start(&Start::of(vec![0.5; 60], 0)).unwrap();
    let mut refused =
        |until| packing::compress(&mut world, &Compression::until(until)).unwrap_err();
    says(refused(Until::PackingFraction(1.2)), "packing_fraction");
    says(refused(Until::PackingFraction(0.001)), "packing_fraction");
    says(refused(Until::Pressure(0.5)), "pressure");
    says(refused(Until::CollisionRate(0.0)), "collision_rate");
    let mut still = World::new(*world.settings()).unwrap();
    still.add_sphere(Sphere::new(DVec3::ZERO, 0.1)).unwrap();
    let until = Compression::until(Until::PackingFraction(0.4));
    says(packing::compress(&mut still, &until).unwrap_err(), "kinetic energy");
}
