//! Steady shear of a periodic box (`docs/physics/shear.md`): images that slide, an account that closes, work that is
//! the stress times the shear, and the same motion wherever the faces of the box are.

use carom::{
    Boundary, Collider, DVec3, Discrete, Error, Friction, Gravity, Pose, Settings, Shape, Sphere,
    StressMeter, Thermostat, World,
};

mod common;

use common::{Numbers, assert_close, vec};

fn settings(size: DVec3, rate: f64) -> Settings {
    Settings::default().with_boundary(Boundary::Periodic { size }).with_shear_rate(rate)
}

fn world_of(size: DVec3, rate: f64, spheres: &[Sphere]) -> World {
    let mut world = World::new(settings(size, rate)).unwrap();
    for &sphere in spheres {
        world.add_sphere(sphere).unwrap();
    }
    world
}

/// Spheres of two sizes on a lattice, with velocities of about one relative to the mean flow and no momentum relative to
/// it.
fn gas(side: usize, rate: f64, restitution: f64) -> World {
    let edge = 1.5 * side as f64;
    let mut numbers = Numbers(3);
    let count = side * side * side;
    let mass = |number: usize| 1.0 + (number % 2) as f64;
    let mut own: Vec<DVec3> = (0..count).map(|_| numbers.vector()).collect();
    let momentum: DVec3 = own.iter().enumerate().map(|(number, it)| mass(number) * *it).sum();
    let total: f64 = (0..count).map(mass).sum();
    own.iter_mut().for_each(|it| *it -= momentum / total);
    let spheres = (0..count).map(|number| {
        let place = [number % side, number / side % side, number / (side * side)];
        let place = place.map(|it| (it as f64 + 0.5) * 1.5 - 0.5 * edge);
        Sphere::new(DVec3::from_array(place), 0.5 - 0.1 * (number % 2) as f64)
            .with_velocity(own[number] + vec(rate * place[1], 0.0, 0.0))
            .with_mass(mass(number))
            .with_restitution(restitution)
    });
    world_of(DVec3::splat(edge), rate, &spheres.collect::<Vec<_>>())
}

#[test]
fn sphere_that_leaves_above_enters_below_where_the_image_has_slid_to() {
    let up = Sphere::new(DVec3::ZERO, 0.5).with_velocity(vec(0.0, 1.0, 0.0));
    let mut world = world_of(DVec3::splat(4.0), 0.25, &[up]);
    // Through the face at 2 s; the box above has slid by 3 m at 3 s.
    world.step(3.0).unwrap();
    let sphere = world.sphere(world.spheres().ids()[0]).unwrap();
    assert_eq!(sphere.position, vec(1.0, -1.0, 0.0));
    assert_eq!(sphere.velocity, vec(-1.0, 1.0, 0.0));
}

#[test]
fn pair_meets_across_a_sliding_face_at_the_root_of_a_quadratic() {
    // The image above of the second one moves with 1 + 2 m/s, from 3 m to the left of the first one and 0.8 m above it.
    let spheres = [
        Sphere::new(vec(0.0, 1.5, 0.0), 0.5),
        Sphere::new(vec(-3.0, -1.7, 0.0), 0.5).with_velocity(vec(1.0, 0.0, 0.0)),
    ];
    let mut world = world_of(DVec3::new(8.0, 4.0, 4.0), 0.5, &spheres);
    let impact = world.step(2.0).unwrap().impacts[0];
    assert_close(impact.time, 0.8, 1e-14);
    assert_close(impact.approach_speed, 3.0 * 0.6, 1e-14);
}

#[test]
fn head_on_impact_across_a_sliding_face_swaps_velocities_relative_to_it() {
    let spheres = [
        Sphere::new(vec(1.0, 1.0, 0.0), 0.5).with_velocity(vec(2.0, 1.0, 0.0)),
        Sphere::new(vec(1.0, -1.0, 0.0), 0.5).with_velocity(vec(0.0, -1.0, 0.0)),
    ];
    // The image above moves with 2 m/s, and at 4 s it has slid by the edge of 8 m, so it is above.
    let mut world = world_of(DVec3::new(8.0, 4.0, 4.0), 0.5, &spheres);
    world.set_time(4.0).unwrap();
    let report = world.step(1.0).unwrap();
    let impact = report.impacts[0];
    assert_close(impact.time, 0.5, 1e-14);
    assert_close(impact.approach_speed, 2.0, 1e-14);
    assert_close(impact.normal.y, 1.0, 1e-14);
    let after: Vec<DVec3> = world.spheres().velocities().to_vec();
    assert!((after[0] - vec(2.0, -1.0, 0.0)).length() < 1e-14);
    assert!((after[1] - vec(0.0, 1.0, 0.0)).length() < 1e-14);
}

#[test]
fn shear_of_rate_zero_is_none() {
    let mut sheared = gas(4, 0.0, 0.9);
    let mut plain = gas(4, 0.0, 0.9);
    plain.set_settings(plain.settings().with_shear_rate(-0.0)).unwrap();
    sheared.step(3.0).unwrap();
    plain.step(3.0).unwrap();
    assert_eq!(sheared.state_hash(), plain.state_hash());
}

#[test]
fn account_closes_and_nothing_overlaps() {
    for (rate, restitution) in [(0.3, 1.0), (-1.7, 0.8), (40.0, 1.0), (1e-6, 0.9)] {
        let mut world = gas(4, rate, restitution);
        for _ in 0..40 {
            let before = world.total_energy();
            let report = world.step(0.05).unwrap();
            let account = report.energy_account;
            let scale = before + world.total_energy();
            // Some thousand flights and impacts, each rounded.
            assert_close(world.total_energy() - before, account.total(), 1e-11 * scale);
            assert!(account.contacts <= 1e-12 * scale);
            assert!(world.overlaps(1e-9).is_empty(), "at {} s", world.time());
        }
    }
}

#[test]
fn work_is_the_stress_times_the_shear() {
    let mut world = gas(4, 0.7, 0.9);
    let mut meter = StressMeter::new(&world);
    let mut work = 0.0;
    let mut impacts = 0;
    while impacts < 200 {
        // Frames that end right before and right after each impact: between them v_x v_y is linear in time, and its
        // mean is that of the ends.
        let next = world.next_event_time(1.0).unwrap().unwrap() - world.time();
        for length in [next - 1e-13, 2e-13] {
            if length > 0.0 {
                let report = world.step(length).unwrap();
                work += report.energy_account.shear;
                impacts += report.impacts.len();
                meter.add_frame(&world);
            }
        }
    }
    let stress = meter.stress(None).unwrap().total();
    let volume = meter.volume().unwrap();
    let expected = -volume * stress.y_axis.x * 0.7 * meter.time();
    let scale = world.kinetic_energy();
    assert!(work.abs() > 0.01 * scale, "{work}");
    // 200 impacts in frames of 2e-13 s, with energies of 100 J.
    assert_close(work, expected, 1e-9 * scale);
}

#[test]
fn results_do_not_depend_on_frames() {
    let ends = [1, 8, 64].map(|frames| {
        let mut world = gas(3, 0.9, 0.9);
        for _ in 0..frames {
            world.step(2.0 / f64::from(frames)).unwrap();
        }
        world.state_hash()
    });
    assert_eq!(ends[0], ends[1]);
    assert_eq!(ends[0], ends[2]);
}

#[test]
fn motion_does_not_depend_on_where_the_faces_are() {
    let rate = 0.9;
    let mut world = gas(3, rate, 0.9);
    let shifted = world.spheres().len();
    let up = vec(0.3, 1.1, -0.7);
    let spheres: Vec<Sphere> = (0..shifted)
        .map(|index| {
            let sphere = world.spheres().get(index);
            let velocity = sphere.velocity + vec(rate * up.y, 0.0, 0.0);
            sphere.with_position(sphere.position + up).with_velocity(velocity)
        })
        .collect();
    let mut other = world_of(DVec3::splat(4.5), rate, &spheres);
    for _ in 0..10 {
        let impacts = world.step(0.1).unwrap().impacts.len();
        assert_eq!(other.step(0.1).unwrap().impacts.len(), impacts);
        // Some tens of impacts of each sphere make errors of rounding a million times larger.
        assert_close(world.kinetic_energy(), other.kinetic_energy(), 1e-8 * world.kinetic_energy());
    }
}

#[test]
fn motion_reversed_in_time_and_shear_runs_back() {
    let rate = 0.9;
    let mut world = gas(3, rate, 1.0);
    let start = world.clone();
    world.step(1.0).unwrap();
    // The box above has slid by w, so the mirrored one, which slides to the other side, is as far at -w.
    let mut back = World::new(world.settings().with_shear_rate(-rate)).unwrap();
    for index in 0..world.spheres().len() {
        let sphere = world.spheres().get(index);
        back.add_sphere(sphere.with_velocity(-sphere.velocity)).unwrap();
    }
    back.set_time(-1.0).unwrap();
    back.step(1.0).unwrap();
    for (one, other) in start.spheres().positions().iter().zip(back.spheres().positions()) {
        // Rounding of 1e-16 grows in the impacts of a second by some 10^4.
        assert!((*one - *other).length() < 1e-10, "{one} {other}");
    }
}

#[test]
fn rescaled_gas_in_shear_has_its_temperature_relative_to_the_flow() {
    let mut world = gas(4, 2.0, 1.0);
    let thermostat = Thermostat::Rescale { interval: 0.125, temperature: 0.5 };
    world.set_settings(world.settings().with_thermostat(Some(thermostat))).unwrap();
    let mut added = 0.0;
    for _ in 0..16 {
        let before = world.kinetic_energy();
        let account = world.step(0.125).unwrap().energy_account;
        added += account.thermostat;
        assert_close(world.kinetic_energy(), 1.5 * 0.5 * 64.0, 1e-10);
        let change = world.kinetic_energy() - before;
        assert_close(change, account.total(), 1e-11 * world.kinetic_energy());
    }
    // Shear heats.
    assert!(added < 0.0);
}

#[test]
fn shear_is_refused_where_it_makes_no_sense() {
    let field = |settings: Settings| match World::new(settings) {
        Err(Error::Invalid { source, .. }) => source.field,
        other => panic!("{other:?}"),
    };
    let size = DVec3::splat(4.0);
    assert_eq!(field(Settings::default().with_shear_rate(1.0)), "shear_rate");
    assert_eq!(field(settings(size, f64::NAN)), "shear_rate");
    assert_eq!(field(settings(size, 1.0).with_rule(Discrete::default())), "boundary");
    assert_eq!(field(settings(vec(f64::INFINITY, 4.0, 4.0), 1.0)), "shear_rate");
    let sphere = Sphere::new(DVec3::ZERO, 0.5);
    let refused = |change: fn(&mut World)| {
        let mut world = world_of(DVec3::splat(4.0), 1.0, &[sphere]);
        assert!(world.check_step(0.1).is_ok());
        change(&mut world);
        assert!(world.check_step(0.1).is_err());
        assert!(world.step(0.1).is_err());
    };
    refused(|world| world.set_settings(settings(DVec3::splat(4.0), 1e4)).unwrap());
    refused(|world| {
        world.add_force(Gravity::new(DVec3::NEG_Y)).unwrap();
    });
    refused(|world| {
        let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::NEG_Y * 2.0));
        world.add_collider(floor).unwrap();
    });
    refused(|world| {
        let rough = Sphere::new(DVec3::X, 0.5).with_friction(Friction::sliding(0.1));
        world.add_sphere(rough).unwrap();
    });
    refused(|world| {
        let turning = Sphere::new(DVec3::X, 0.5).with_angular_velocity(DVec3::X);
        world.add_sphere(turning).unwrap();
    });
}

#[test]
fn large_and_small_worlds_in_shear_move_alike() {
    let plain = {
        let mut world = gas(3, 0.9, 0.9);
        world.step(1.0).unwrap();
        world
    };
    for power in [-20, 20] {
        let scale = libm::ldexp(1.0, power);
        let spheres = (0..27).map(|index| {
            let sphere = gas(3, 0.9, 0.9).spheres().get(index);
            sphere
                .with_position(scale * sphere.position)
                .with_radius(scale * sphere.radius)
                .with_velocity(scale * sphere.velocity)
        });
        let mut world = world_of(DVec3::splat(4.5 * scale), 0.9, &spheres.collect::<Vec<_>>());
        world.step(1.0).unwrap();
        for (one, other) in plain.spheres().positions().iter().zip(world.spheres().positions()) {
            assert_eq!(scale * *one, *other);
        }
    }
}
