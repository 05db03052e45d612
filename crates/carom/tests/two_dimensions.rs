//! Two dimensions (`docs/physics/motion.md`): discs in a plane, their pressure and temperature, and what leaves the
//! plane.

use std::f64::consts::{FRAC_PI_2, PI};

use carom::packing::packing_fraction;
use carom::{
    Bisect, Boundary, Collider, Contact, DQuat, DVec3, Discrete, Ends, Error, Exact, Gravity, Mesh,
    Pose, Rule, Settings, Shape, Sides, Sphere, StressMeter, Thermostat, World,
};

mod common;

use common::{Numbers, assert_close, vec};

fn settings() -> Settings {
    Settings::default().with_dimensions(2)
}

/// Discs of diameter 1 on a square lattice in a periodic square, without momentum, whose mean kinetic energy is 1 J.
fn gas(settings: Settings, side: usize, spacing: f64) -> World {
    let edge = spacing * side as f64;
    let size = vec(edge, edge, f64::INFINITY);
    let mut world = World::new(settings.with_boundary(Boundary::Periodic { size })).unwrap();
    let mut numbers = Numbers(3);
    let count = side * side;
    let mut velocities: Vec<DVec3> = (0..count)
        .map(|_| vec(numbers.between(-1.0, 1.0), numbers.between(-1.0, 1.0), 0.0))
        .collect();
    let mean = velocities.iter().sum::<DVec3>() / count as f64;
    velocities.iter_mut().for_each(|it| *it -= mean);
    let square: f64 = velocities.iter().map(|it| it.length_squared()).sum();
    for (number, velocity) in velocities.iter().enumerate() {
        let place =
            [number % side, number / side].map(|it| (it as f64 + 0.5) * spacing - 0.5 * edge);
        let velocity = *velocity * (2.0 * count as f64 / square).sqrt();
        let sphere = Sphere::new(vec(place[0], place[1], 0.0), 0.5).with_velocity(velocity);
        world.add_sphere(sphere).unwrap();
    }
    world
}

#[test]
fn discs_have_the_pressure_of_henderson() {
    // Z = (1 + p²/8)/(1 - p)² at the packing fraction p (Henderson, Mol. Phys. 30, 971 (1975)).
    for spacing in [2.0, 1.4] {
        let mut world = gas(settings(), 24, spacing);
        let fraction = packing_fraction(&world, None).unwrap();
        assert_close(fraction, 0.25 * PI / (spacing * spacing), 1e-14);
        world.step(20.0).unwrap();
        let mut meter = StressMeter::new(&world);
        for _ in 0..200 {
            world.step(0.5).unwrap();
            meter.add_frame(&world);
        }
        let area = meter.volume().unwrap();
        assert_close(area, 576.0 * spacing * spacing, 1e-11);
        let stress = meter.stress(None).unwrap();
        // k T is 1 J, as the mean kinetic energy of two degrees of freedom; one of all discs is that of the momentum.
        let compressibility = stress.pressure() * area / 576.0;
        let free = 1.0 - fraction;
        let expected = (1.0 + fraction * fraction / 8.0) / (free * free);
        // Statistics of some 20,000 impacts and more; the equation is within 0.3 %.
        assert_close(compressibility, expected, 0.01 * expected);
        assert_eq!(stress.total().z_axis, DVec3::ZERO);
        assert!(world.spheres().positions().iter().all(|it| it.z == 0.0));
    }
}

#[test]
fn thermostats_keep_discs_in_the_plane_and_at_their_temperature() {
    let rescale = Thermostat::Rescale { interval: 0.25, temperature: 0.7 };
    let mut world = gas(settings().with_thermostat(Some(rescale)), 8, 1.5);
    world.step(0.5).unwrap();
    // A disc has k T of kinetic energy.
    assert_close(world.kinetic_energy(), 0.7 * 64.0, 1e-12);
    let andersen = Thermostat::Andersen { frequency: 2.0, temperature: 0.7, seed: 3 };
    let noise = Thermostat::WhiteNoise { interval: 0.1, strength: 0.5, seed: 3 };
    for thermostat in [andersen, noise] {
        let mut world = gas(settings().with_thermostat(Some(thermostat)), 8, 1.5);
        let momentum = world.momentum();
        for _ in 0..8 {
            world.step(0.5).unwrap();
        }
        assert!(world.spheres().velocities().iter().all(|it| it.z == 0.0));
        if thermostat == noise {
            assert!(world.momentum().distance(momentum) < 1e-12);
        }
    }
}

/// Quarter turns are rounded; the axes that follow from them are not.
#[test]
fn discs_stay_in_the_plane_among_pillars_and_walls_that_are_turned_upright() {
    let pillar = Shape::Cylinder { radius: 0.3, height: 1.0 };
    let ring = Shape::Pipe { radius: 1.5, length: 1.0, closed: Ends::NONE };
    let block = Shape::Box { size: vec(0.3, 1.0, 0.3) };
    let upright = DQuat::from_rotation_x(FRAC_PI_2);
    for rule in [
        Rule::Exact(Exact::default()),
        Rule::Contact(Contact::default()),
        Rule::Discrete(Discrete::default()),
        Rule::Bisect(Bisect::default()),
    ] {
        let mut world = World::new(settings().with_rule(rule)).unwrap();
        world.add_force(Gravity::new(-9.81 * DVec3::Y)).unwrap();
        let turns = [upright, DQuat::from_rotation_z(0.3) * upright, -upright.inverse()];
        for (number, (shape, turn)) in [&pillar, &block, &ring].into_iter().zip(turns).enumerate() {
            let place = [vec(-0.4, 0.0, 0.0), vec(0.6, 0.1, 0.0), DVec3::ZERO][number];
            let collider = Collider::new(shape.clone(), Pose::at(place).rotated(turn));
            world.add_collider(collider.with_restitution(0.9)).unwrap();
        }
        let ceiling = Pose::at(2.0 * DVec3::Y).rotated(DQuat::from_rotation_x(PI));
        world.add_collider(Collider::new(Shape::HalfSpace, ceiling)).unwrap();
        for x in [-0.5, -0.2, 0.1, 0.4] {
            let disc = Sphere::new(vec(x, 0.8, 0.0), 0.1);
            world.add_sphere(disc.with_restitution(0.8)).unwrap();
        }
        for _ in 0..200 {
            world.step(1.0 / 60.0).unwrap();
        }
        assert!(world.spheres().positions().iter().all(|it| it.z == 0.0), "{rule:?}");
    }
}

/// A valley whose cross-section lies in its xz plane, which a quarter turn about x makes that of the discs.
fn valley() -> Mesh {
    let profile = [[-1.0, 0.8], [-0.5, 0.1], [0.1, -0.05], [0.6, 0.2], [1.0, 0.9]];
    let along = |[x, z]: [f64; 2]| [-1.0, 1.0].map(|y| vec(x, y, -z));
    let triangles =
        (0..4).map(|it| 2 * it).flat_map(|it| [[it, it + 1, it + 2], [it + 2, it + 1, it + 3]]);
    Mesh::new(profile.into_iter().flat_map(along).collect(), triangles.collect()).unwrap()
}

/// Asserts that discs of several radii that roll and slide on a surface never leave the plane.
fn assert_stays_in_plane(settings: Settings, surface: Collider, count: usize, size: f64) {
    let what = format!("{:?}, {surface:?}, {count} discs", settings.rule);
    let mut world = World::new(settings).unwrap();
    world.add_force(Gravity::new(-9.81 * size * DVec3::Y)).unwrap();
    world.add_collider(surface.clone()).unwrap();
    for number in 0..count {
        let place = size * vec(0.1 + 0.2 * number as f64, 0.25 * number as f64, 0.0);
        let radius = size * [0.1, 0.08, 0.04, 0.02][number];
        let disc = Sphere::new(place, radius).with_restitution(0.3).with_friction(0.3);
        world.add_sphere(disc).unwrap();
    }
    for _ in 0..180 {
        world.step(1.0 / 60.0).unwrap_or_else(|error| panic!("{what}: {error}"));
    }
    let spheres = world.spheres();
    for number in 0..count {
        let [place, velocity] = [spheres.positions()[number], spheres.velocities()[number]];
        let spin = spheres.angular_velocities().get(number).copied().unwrap_or_default();
        assert_eq!([place.z, velocity.z, spin.x, spin.y], [0.0; 4], "{what}");
    }
}

#[test]
fn discs_with_friction_stay_in_the_plane_on_turned_surfaces() {
    let upright = DQuat::from_rotation_x(FRAC_PI_2);
    let tilted = DQuat::from_rotation_z(0.3) * upright;
    let pipe = Shape::Pipe { radius: 1.0, length: 1.0, closed: Ends::NONE };
    let torus = Shape::Torus { ring_radius: 0.8, tube_radius: 0.1 };
    let room = Shape::Container { size: vec(2.0, 1.0, 2.0), open: Sides::NONE };
    let surfaces = [
        (Shape::Mesh(valley()), upright),
        (Shape::Mesh(valley()), tilted),
        (Shape::Mesh(valley()), upright * DQuat::from_rotation_y(0.3)),
        (pipe, tilted),
        (torus, -upright.inverse()),
        (room, upright * DQuat::from_rotation_y(0.7)),
        (Shape::Bowl { radius: 1.0, opening: 0.9 }, DQuat::from_rotation_z(0.3)),
    ];
    for (shape, turn) in surfaces {
        let still = Collider::new(shape, Pose::at(DVec3::ZERO).rotated(turn))
            .with_friction(0.4)
            .with_restitution(0.3);
        let turning = still.clone().moving(DVec3::ZERO, 0.2 * DVec3::Z);
        for rule in [
            Rule::Exact(Exact::default()),
            Rule::Contact(Contact::default()),
            Rule::Discrete(Discrete::default()),
            Rule::Bisect(Bisect::default()),
        ] {
            for (surface, count) in [(&still, 1), (&still, 4), (&turning, 2)] {
                assert_stays_in_plane(settings().with_rule(rule), surface.clone(), count, 1.0);
            }
        }
    }
}

#[test]
fn discs_of_any_size_roll_in_the_plane() {
    let upright = DQuat::from_rotation_x(FRAC_PI_2);
    for size in [libm::ldexp(1.0, -20), libm::ldexp(1.0, 20)] {
        let pipe = Shape::Pipe { radius: size, length: size, closed: Ends::NONE };
        let surface =
            Collider::new(pipe, Pose::at(DVec3::ZERO).rotated(upright)).with_friction(0.4);
        for rule in [Rule::Exact(Exact::default()), Rule::Contact(Contact::default())] {
            assert_stays_in_plane(settings().with_rule(rule), surface.clone(), 3, size);
        }
    }
}

#[test]
fn what_leaves_the_plane_is_refused() {
    let disc = Sphere::new(DVec3::ZERO, 0.5);
    for (sphere, field) in [
        (disc.with_position(vec(0.0, 0.0, 0.1)), "position"),
        (disc.with_velocity(vec(1.0, 0.0, 0.1)), "velocity"),
        (disc.with_angular_velocity(vec(0.0, 1.0, 0.0)), "angular_velocity"),
    ] {
        for settings in [settings(), settings().with_rule(Contact::default())] {
            let mut world = World::new(settings).unwrap();
            world.add_sphere(sphere).unwrap();
            let error = world.step(0.1).unwrap_err();
            assert!(matches!(error, Error::Invalid { .. }), "{error}");
            assert!(error.to_string().contains(field), "{error}");
        }
    }
    let mut world = World::new(settings()).unwrap();
    world.add_sphere(disc).unwrap();
    world.add_force(Gravity::new(vec(0.0, -1.0, -1.0))).unwrap();
    assert!(world.step(0.1).unwrap_err().to_string().contains("plane"));
    let closed = Boundary::Periodic { size: DVec3::splat(4.0) };
    assert!(World::new(settings().with_boundary(closed)).is_err());
    assert!(World::new(settings().with_dimensions(1)).is_err());
}
