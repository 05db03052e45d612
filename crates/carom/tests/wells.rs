//! Square wells around spheres (`docs/physics/wells.md`): two spheres against closed forms, energies that close, time
//! that runs back, and the same bits in any frames and at any size.

use carom::{
    Boundary, Collider, Contact, DVec3, Error, Friction, Gravity, PairPotential, Pose, Settings,
    Shape, Sides, Sphere, Spring, StressMeter, Thermostat, ViscousDrag, WellEventKind, World,
};

mod common;

use common::{Numbers, assert_close, vec};

const RANGE: f64 = 1.5;

fn settings(depth: f64, range_ratio: f64) -> Settings {
    let well = PairPotential::SquareWell { depth, range_ratio };
    Settings::default().with_pair_potential(Some(well))
}

fn world_of(settings: Settings, spheres: &[Sphere]) -> World {
    let mut world = World::new(settings).unwrap();
    for &sphere in spheres {
        world.add_sphere(sphere).unwrap();
    }
    world
}

/// Two spheres of diameter 1 with masses 1 and 3, without momentum. The second one comes from the left with a speed
/// relative to the first one, `height` above it.
fn pair(depth: f64, speed: f64, height: f64) -> World {
    let still = Sphere::new(vec(0.75, 0.0, 0.0), 0.5).with_mass(1.0);
    let coming = Sphere::new(vec(-1.25, height, 0.0), 0.5).with_mass(3.0);
    let still = still.with_velocity(vec(-0.75 * speed, 0.0, 0.0));
    let coming = coming.with_velocity(vec(0.25 * speed, 0.0, 0.0));
    world_of(settings(depth, RANGE), &[still, coming])
}

/// Velocity of the second sphere relative to the first one.
fn relative_velocity(world: &World) -> DVec3 {
    world.spheres().velocities()[1] - world.spheres().velocities()[0]
}

/// Vector from the first centre to the second one.
fn offset(world: &World) -> DVec3 {
    world.spheres().positions()[1] - world.spheres().positions()[0]
}

/// Steps a world and returns the kinds of events at wells, with their times.
fn events(world: &mut World, frames: usize, frame: f64) -> Vec<(WellEventKind, f64)> {
    let mut events = Vec::new();
    for _ in 0..frames {
        let start = world.time();
        let report = world.step(frame).unwrap();
        events.extend(report.well_events.iter().map(|it| (it.kind, start + it.time)));
    }
    events
}

/// Spheres of two sizes on a lattice in a periodic cube, `spacing` apart.
fn gas(settings: Settings, side: usize, spacing: f64) -> World {
    let edge = spacing * side as f64;
    let settings = settings.with_boundary(Boundary::Periodic { size: DVec3::splat(edge) });
    let mut numbers = Numbers(3);
    let spheres = (0..side * side * side).map(|number| {
        let place = [number % side, number / side % side, number / (side * side)];
        let place = place.map(|it| (it as f64 + 0.5) * spacing - 0.5 * edge);
        Sphere::new(DVec3::from_array(place), 0.5 - 0.1 * (number % 2) as f64)
            .with_velocity(numbers.vector())
            .with_mass(1.0 + (number % 2) as f64)
    });
    world_of(settings, &spheres.collect::<Vec<_>>())
}

#[test]
fn head_on_pair_enters_bounces_and_leaves_at_the_times_of_its_energy() {
    // Reduced mass 3/4: 3/8 of the square of the speed, and 3/2 J of the well, so the square grows by 4.
    let mut world = pair(1.5, 1.5, 0.0);
    let distance = -offset(&world).x;
    let found = events(&mut world, 1, 4.0);
    let enters = (distance - RANGE) / 1.5;
    let leaves = enters + 2.0 * (RANGE - 1.0) / 2.5;
    assert_eq!(found.len(), 2);
    assert_eq!((found[0].0, found[1].0), (WellEventKind::Capture, WellEventKind::Dissociation));
    // A few operations each.
    assert_close(found[0].1, enters, 1e-15);
    assert_close(found[1].1, leaves, 2e-15);
    let impact = &world.report().impacts[0];
    assert_close(impact.approach_speed, 2.5, 1e-15);
    assert_close(relative_velocity(&world).x, -1.5, 1e-15);
    assert_eq!(world.potential_energy(), 0.0);
}

#[test]
fn oblique_pairs_are_deflected_as_light_by_a_ball_of_glass() {
    // The well is a medium of the index n: the speed inside is n times that outside (Landau and Lifshitz, Mechanics,
    // section 19, problem 2). Past the cores the pair leaves after two refractions, else after an impact between them.
    let (speed, depth) = (1.5, 1.5);
    let index = f64::sqrt(1.0 + 2.0 * depth / (0.75 * speed * speed));
    for height in [0.1, 0.5, 1.0, 1.2, 1.4, 1.45] {
        let mut world = pair(depth, speed, height);
        world.step(6.0).unwrap();
        let outside = libm::asin(height / RANGE);
        let inside = libm::asin(height / (index * RANGE));
        let nearest = height / index;
        let turn = if nearest < 1.0 {
            std::f64::consts::PI - 2.0 * (outside - inside + libm::asin(nearest))
        } else {
            -2.0 * (outside - inside)
        };
        let expected = speed * vec(libm::cos(turn), libm::sin(turn), 0.0);
        let found = relative_velocity(&world);
        // Rounding of the places, along normals at up to 75 degrees.
        assert!(found.distance(expected) < 1e-13, "{height}: {found} for {expected}");
        assert_close(world.total_energy(), 0.375 * speed * speed, 1e-14);
    }
}

#[test]
fn bound_pair_bounces_between_the_cores_and_the_edge_with_its_period() {
    let still = Sphere::new(DVec3::ZERO, 0.5).with_mass(1.0);
    let other = Sphere::new(vec(1.25, 0.0, 0.0), 0.5).with_mass(3.0);
    let other = other.with_velocity(vec(0.5, 0.0, 0.0));
    let mut world = world_of(settings(1.0, RANGE), &[still, other]);
    assert_eq!(world.potential_energy(), -1.0);
    // Half a metre out and half a metre in, 0.5 m/s.
    for period in 1..=50 {
        let found = events(&mut world, 1, 2.0);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].0, WellEventKind::Bounce);
        assert_eq!(world.report().impacts.len(), 1);
        // The rounding of each event adds up.
        let error = 2e-15 * f64::from(period);
        assert_close(offset(&world).x, 1.25, error);
        assert_close(relative_velocity(&world).x, 0.5, error);
    }
    assert_eq!(world.potential_energy(), -1.0);
}

#[test]
fn shoulder_turns_slow_spheres_back_and_slows_fast_ones_down() {
    // The shoulder takes 4 of the square of the speed.
    let mut slow = pair(-1.5, 1.9, 0.0);
    let found = events(&mut slow, 1, 4.0);
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].0, WellEventKind::Bounce);
    assert_close(relative_velocity(&slow).x, -1.9, 1e-15);
    let mut fast = pair(-1.5, 2.5, 0.0);
    let found = events(&mut fast, 1, 4.0);
    assert_eq!((found[0].0, found[1].0), (WellEventKind::Capture, WellEventKind::Dissociation));
    assert_close(fast.report().impacts[0].approach_speed, 1.5, 1e-15);
    assert_close(relative_velocity(&fast).x, -2.5, 1e-15);
}

#[test]
fn energy_and_momentum_of_a_gas_of_500_are_kept_to_rounding() {
    let mut world = gas(settings(1.2, RANGE), 8, 1.4);
    let (energy, momentum) = (world.total_energy(), world.momentum());
    let scale = world.kinetic_energy() - world.potential_energy();
    let (mut count, mut potentials) = (0, Vec::new());
    for _ in 0..10 {
        let report = world.step(1.0).unwrap();
        count += report.well_events.len() + report.impacts.len();
        assert!(report.energy_account.total().abs() < 1e-12 * scale);
        potentials.push(world.potential_energy());
        // Each of tens of thousands of events rounds the energy of a pair.
        assert_close(world.total_energy(), energy, 1e-12 * scale);
        assert!(world.momentum().distance(momentum) < 1e-12 * scale);
    }
    assert!(count > 20_000, "{count}");
    potentials.dedup();
    assert!(potentials.len() > 5);
    assert!(world.overlaps(1e-12).is_empty());
}

#[test]
fn pair_in_the_smallest_box_is_bound_by_one_of_its_images() {
    // Four times the range of a sphere: each has two images of the other one near it.
    let boundary = Boundary::Periodic { size: DVec3::splat(3.0) };
    let first = Sphere::new(vec(-0.875, 0.1, 0.2), 0.5).with_velocity(vec(1.0, 0.25, -0.125));
    let second = Sphere::new(vec(0.75, 0.0, 0.0), 0.5).with_mass(2.0);
    for depth in [0.5, -0.25, 4.0] {
        let settings = settings(depth, RANGE).with_boundary(boundary);
        let mut world = world_of(settings, &[first, second]);
        let energy = world.total_energy();
        let found = events(&mut world, 40, 0.5);
        assert!(found.len() > 10, "{depth}: {}", found.len());
        assert_close(world.total_energy(), energy, 1e-13);
    }
}

#[test]
fn time_runs_back() {
    let mut world = gas(settings(0.5, 1.6), 4, 1.7);
    let places = world.spheres().positions().to_vec();
    let turn_back = |world: &mut World| {
        for id in world.spheres().ids().to_vec() {
            let velocity = world.sphere(id).unwrap().velocity;
            world.set_velocity(id, -velocity).unwrap();
        }
    };
    world.step(0.75).unwrap();
    assert!(world.report().well_events.len() > 50);
    turn_back(&mut world);
    world.step(0.75).unwrap();
    for (now, before) in world.spheres().positions().iter().zip(places) {
        // Each event makes a difference of directions grow by about ten.
        assert!(now.distance(before) < 1e-9, "{now} {before}");
    }
}

#[test]
fn bits_do_not_depend_on_frames() {
    let mut whole = gas(settings(0.8, RANGE), 4, 1.3);
    let mut parts = whole.clone();
    whole.step(4.0).unwrap();
    for _ in 0..128 {
        parts.step(1.0 / 32.0).unwrap();
    }
    assert_eq!(whole.state_hash(), parts.state_hash());
    assert_eq!(whole.potential_energy(), parts.potential_energy());
}

#[test]
fn copies_and_thermostats_keep_what_is_bound() {
    let thermostat = Thermostat::Andersen { frequency: 0.5, temperature: 0.5, seed: 7 };
    let mut world = gas(settings(0.8, RANGE).with_thermostat(Some(thermostat)), 4, 1.3);
    let mut before = world.total_energy();
    for _ in 0..20 {
        let added = world.step(0.25).unwrap().energy_account.total();
        assert_close(world.total_energy(), before + added, 1e-11);
        before = world.total_energy();
    }
    let mut copy = World::default();
    copy.restore(&world.snapshot());
    world.step(1.0).unwrap();
    copy.step(1.0).unwrap();
    assert_eq!(world.state_hash(), copy.state_hash());
}

#[test]
fn motion_has_the_same_bits_at_any_size() {
    let small = gas(settings(0.8, RANGE), 3, 1.4);
    let spheres: Vec<Sphere> =
        small.spheres().ids().iter().map(|&id| small.sphere(id).unwrap()).collect();
    let at_scale = |power: i32| {
        let scale = libm::ldexp(1.0, power);
        let boundary = Boundary::Periodic { size: DVec3::splat(4.2 * scale) };
        let settings = settings(0.8 * scale * scale, RANGE).with_boundary(boundary);
        let scaled = spheres.iter().map(|sphere| {
            sphere
                .with_position(scale * sphere.position)
                .with_radius(scale * sphere.radius)
                .with_velocity(scale * sphere.velocity)
                .with_mass(1.0)
        });
        let mut world = world_of(settings, &scaled.collect::<Vec<_>>());
        world.step(4.0).unwrap();
        let places = world.spheres().positions().iter().map(|it| *it / scale);
        (places.collect::<Vec<_>>(), world.potential_energy() / (scale * scale))
    };
    let expected = at_scale(0);
    assert_eq!(at_scale(20), expected);
    assert_eq!(at_scale(-20), expected);
}

#[test]
fn bodies_in_a_container_under_gravity_keep_their_energy() {
    let mut world = World::new(settings(0.6, 1.8)).unwrap();
    world.add_force(Gravity::new(vec(0.0, -2.0, 0.0))).unwrap();
    let shape = Shape::Container { size: DVec3::splat(7.0), open: Sides::NONE };
    world.add_collider(Collider::new(shape, Pose::at(DVec3::ZERO)).with_restitution(1.0)).unwrap();
    let mut numbers = Numbers(9);
    for number in 0..64 {
        let place = [number % 4, number / 4 % 4, number / 16].map(|it| 1.6 * f64::from(it) - 2.4);
        let sphere = Sphere::new(DVec3::from_array(place), 0.2 + 0.1 * f64::from(number % 5));
        world.add_sphere(sphere.with_velocity(numbers.vector()).with_mass(1.0)).unwrap();
    }
    let energy = world.total_energy();
    let mut count = 0;
    for _ in 0..60 {
        count += world.step(0.25).unwrap().well_events.len();
        assert_close(world.total_energy(), energy, 1e-11);
    }
    assert!(count > 1000, "{count}");
}

#[test]
fn pressure_of_the_meter_is_that_of_the_virial() {
    let mut world = gas(settings(0.8, RANGE), 5, 1.3);
    let mut meter = StressMeter::new(&world);
    let virial = |world: &World| {
        let spheres = world.spheres();
        let terms = spheres.masses().iter().zip(spheres.velocities());
        terms.map(|(mass, velocity)| mass * velocity.length_squared()).sum::<f64>()
    };
    let (mut kinetic, mut events) = (0.0, 0.0);
    for _ in 0..10 {
        let before = virial(&world);
        world.step(0.5).unwrap();
        meter.add_frame(&world);
        kinetic += 0.25 * (before + virial(&world));
        let report = world.report();
        events += report.well_events.iter().map(|it| it.impulse * it.distance).sum::<f64>();
        let radius = |id| world.sphere(id).unwrap().radius;
        for impact in &report.impacts {
            let carom::BodyPair::Spheres(one, other) = impact.between else { continue };
            events += impact.impulse * (radius(one) + radius(other));
        }
    }
    let volume = meter.volume().unwrap();
    let momentum = world.momentum().length_squared() / world.spheres().masses().iter().sum::<f64>();
    let expected = (kinetic - 5.0 * momentum + events) / (3.0 * volume * 5.0);
    assert_close(meter.stress(None).unwrap().pressure(), expected, 1e-12);
}

#[test]
fn what_a_potential_cannot_be_combined_with_is_refused() {
    let refuses = |change: &dyn Fn(&mut World)| {
        let mut world = pair(1.0, 1.0, 0.0);
        change(&mut world);
        let error = world.step(0.1).unwrap_err();
        assert!(matches!(error, Error::Invalid { .. }), "{error}");
        assert!(error.to_string().contains("pair_potential"), "{error}");
    };
    let first = |world: &World| world.spheres().ids()[0];
    refuses(&|world| {
        world.add_force(ViscousDrag::new(0.1)).unwrap();
    });
    refuses(&|world| {
        let ids = world.spheres().ids().to_vec();
        world.add_spring(Spring::between(ids[0], ids[1], 1.0)).unwrap();
    });
    let with = |world: &mut World, change: &dyn Fn(Sphere) -> Sphere| {
        let id = first(world);
        let sphere = change(world.sphere(id).unwrap());
        world.set_sphere(id, sphere).unwrap();
    };
    refuses(&|world| with(world, &|it| it.with_restitution(0.5)));
    refuses(&|world| with(world, &|it| it.with_friction(Friction::sliding(0.5))));
    let mut world = pair(1.0, 1.0, 0.0);
    with(&mut world, &|it| it.with_growth_speed(0.1));
    assert!(world.step(0.1).unwrap_err().to_string().contains("pair potential"));
    for settings in [
        settings(1.0, 1.0),
        settings(f64::NAN, 1.5),
        settings(1.0, 1.5).with_rule(Contact::default()),
        settings(1.0, 1.5).with_spheres_collide(false),
    ] {
        assert!(matches!(World::new(settings), Err(Error::Invalid { .. })));
    }
    let small = settings(1.0, 1.5).with_boundary(Boundary::Periodic { size: DVec3::splat(2.5) });
    let mut world = world_of(small, &[Sphere::new(DVec3::ZERO, 0.5)]);
    assert!(world.step(0.1).unwrap_err().to_string().contains("range_ratio"));
}

#[test]
fn sphere_that_rests_on_a_floor_is_refused_by_type() {
    let mut world = World::new(settings(1.0, RANGE)).unwrap();
    world.add_force(Gravity::new(vec(0.0, -10.0, 0.0))).unwrap();
    world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO))).unwrap();
    world.add_sphere(Sphere::new(vec(0.0, 0.5, 0.0), 0.5)).unwrap();
    let error = world.step(0.1).unwrap_err();
    assert!(matches!(error, Error::RestsInPotential { .. }), "{error}");
}
