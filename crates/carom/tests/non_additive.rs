//! Spheres of named materials that touch at `(1 + Δ)` times the sum of their radii: proves that they meet there and
//! nowhere else, under every rule, with growth, shear, walls and emitters; it proves nothing about pressures.

mod common;

use carom::{
    Boundary, Collider, Contact, DVec3, DerivativeError, Emitter, Exact, Friction, Gravity,
    MaterialPair, Pose, Rule, Settings, Shape, Sides, Sphere, StressMeter, ViscousDrag, World,
    packing::rattlers,
};
use common::{Numbers, account_of_run, assert_close, assert_close_vec, bisect, discrete, vec};

/// Contact distances are reached to the rounding of coordinates, which are some ten radii.
const ROUNDING: f64 = 1e-13;

/// Non-additivity parameters: spheres of the two materials that sink into each other, and that keep apart.
const PARAMETERS: [f64; 4] = [-0.5, -0.2, 0.3, 2.0];

fn sphere(x: f64, radius: f64, material: u8) -> Sphere {
    Sphere::new(DVec3::X * x, radius).with_material(material)
}

fn world_with(settings: Settings, non_additivity: f64) -> World {
    let mut world = World::new(settings).unwrap();
    let pair = MaterialPair::new(1, 2).with_non_additivity(non_additivity);
    world.set_material_pairs([pair]).unwrap();
    world
}

fn rule(rule: impl Into<Rule>) -> Settings {
    Settings::default().with_rule(rule)
}

fn factor(world: &World, materials: [u8; 2]) -> f64 {
    let is_of = |pair: &&MaterialPair| {
        let [first, second] = pair.materials;
        [first, second] == materials || [second, first] == materials
    };
    let pair = world.material_pairs().iter().find(is_of);
    1.0 + pair.map_or(0.0, |pair| pair.non_additivity)
}

/// The least distance of two centres, with images, as a multiple of their contact distance; by trying every pair.
fn least_distance(world: &World) -> f64 {
    let spheres = world.spheres();
    let (period, slide) = match world.settings().boundary {
        Boundary::Periodic { size } => {
            let slide = world.settings().shear_rate * size.y * world.time();
            (size, slide - (slide / size.x).round() * size.x)
        }
        _ => (DVec3::INFINITY, 0.0),
    };
    let nearest = |mut offset: DVec3| {
        let turns = if period.y.is_finite() { (offset.y / period.y).round() } else { 0.0 };
        offset.y -= if turns == 0.0 { 0.0 } else { turns * period.y };
        offset.x -= turns * slide;
        for axis in [0, 2] {
            if period[axis].is_finite() {
                offset[axis] -= (offset[axis] / period[axis]).round() * period[axis];
            }
        }
        offset.length()
    };
    let mut least = f64::INFINITY;
    for second in 1..spheres.len() {
        for first in 0..second {
            let [one, other] = [first, second].map(|index| spheres.get(index));
            let distance =
                factor(world, [one.material, other.material]) * (one.radius + other.radius);
            least = least.min(nearest(other.position - one.position) / distance);
        }
    }
    least
}

/// Spheres of two materials and of several sizes on a lattice, whose neighbours touch no contact distance.
fn mixture(settings: Settings, non_additivity: f64, side: usize, radii: [f64; 3]) -> World {
    let mut world = world_with(settings, non_additivity);
    let largest = radii.into_iter().fold(0.0, f64::max);
    let gap = 2.1 * largest * (1.0 + non_additivity).max(1.0);
    let mut numbers = Numbers(11);
    for number in 0..side * side * side {
        let place = [number % side, number / side % side, number / (side * side)];
        let place = DVec3::from_array(place.map(|it| (it as f64 + 0.5) * gap));
        let radius = radii[number % 3];
        let sphere = Sphere::new(place - 0.5 * gap * side as f64, radius)
            .with_density(1.0)
            .with_velocity(largest * numbers.vector())
            .with_material(1 + (numbers.next() * 2.0) as u8);
        world.add_sphere(sphere).unwrap();
    }
    world
}

/// The box of such a lattice.
fn box_of(non_additivity: f64, side: usize, largest: f64) -> Settings {
    let edge = 2.1 * largest * (1.0 + non_additivity).max(1.0) * side as f64;
    Settings::default().with_boundary(Boundary::Periodic { size: DVec3::splat(edge) })
}

/// Runs a world and checks after every frame that nothing sinks in; returns the number of impacts of both materials.
fn run_without_overlaps(world: &mut World, frames: usize, h: f64) -> [usize; 2] {
    let mut count = [0; 2];
    for _ in 0..frames {
        let impacts = world.step(h).unwrap().impacts.clone();
        for impact in impacts {
            let carom::BodyPair::Spheres(first, second) = impact.between else { continue };
            let of = |id| world.sphere(id).map_or(0, |it| it.material);
            count[usize::from(of(first) != of(second))] += 1;
        }
        let least = least_distance(world);
        assert!(least > 1.0 - ROUNDING, "{least}");
        assert_eq!(world.overlaps(1e-9 * world.spheres().radii()[0]), []);
    }
    count
}

#[test]
fn two_spheres_meet_at_the_distance_of_their_materials_and_those_of_one_at_the_sum_of_radii() {
    for power in [-20, 0, 20] {
        let size = libm::ldexp(1.0, power);
        for non_additivity in PARAMETERS {
            for (second, distance) in [(2, (1.0 + non_additivity) * 0.8), (1, 0.8), (3, 0.8)] {
                for rule in [Rule::from(Exact::default()), Contact::default().into()] {
                    let mut world = world_with(Settings::default().with_rule(rule), non_additivity);
                    let first = sphere(0.0, 0.5 * size, 1).with_velocity(DVec3::X * size);
                    let one = world.add_sphere(first.with_mass(1.0)).unwrap();
                    let other = sphere(4.0 * size, 0.3 * size, second).with_mass(1.0);
                    let two = world.add_sphere(other).unwrap();
                    let mut at = None;
                    for frame in 0..400 {
                        let report = world.step(1.0 / 64.0).unwrap();
                        at = at.or(report
                            .impacts
                            .first()
                            .map(|it| (f64::from(frame) / 64.0 + it.time, it.point)));
                    }
                    let (time, point) = at.unwrap();
                    // `contact` answers an impact within the sub-step in which it is.
                    let tolerance = if rule == Exact::default().into() { 1e-14 } else { 0.005 };
                    assert_close(time, 4.0 - distance, 4.0 * tolerance);
                    let part = distance / 0.8 * 0.5;
                    assert_close(point.x / size, 4.0 - distance + part, 8.0 * tolerance);
                    assert_close_vec(
                        world.sphere(one).unwrap().velocity,
                        DVec3::ZERO,
                        1e-12 * size,
                    );
                    let after = world.sphere(two).unwrap().velocity;
                    assert_close_vec(after, DVec3::X * size, 1e-12 * size);
                }
            }
        }
    }
}

#[test]
fn rules_that_answer_overlaps_find_them_at_the_distance_of_the_materials() {
    for rule in [discrete(), bisect()] {
        for non_additivity in PARAMETERS {
            let mut world = world_with(Settings::default().with_rule(rule), non_additivity);
            world.add_sphere(sphere(0.0, 0.5, 1).with_velocity(DVec3::X)).unwrap();
            world.add_sphere(sphere(4.0, 0.5, 2)).unwrap();
            let mut frames = 0;
            while world.step(1e-3).unwrap().impacts.is_empty() {
                frames += 1;
            }
            // Within a frame.
            assert_close(f64::from(frames) * 1e-3, 3.0 - non_additivity, 2e-3);
        }
    }
}

#[test]
fn a_gas_of_two_materials_misses_no_impact_and_keeps_energy_and_momentum() {
    for power in [-20, 0, 20] {
        let size = libm::ldexp(1.0, power);
        for non_additivity in PARAMETERS {
            // One size; two that share a level of the cells; sizes of several levels.
            for radii in [[0.5, 0.5, 0.5], [0.5, 0.4, 0.5], [0.5, 0.05, 0.01]] {
                let radii = radii.map(|radius| radius * size);
                let settings = box_of(non_additivity, 5, 0.5 * size);
                let mut world = mixture(settings, non_additivity, 5, radii);
                let (energy, momentum) = (world.kinetic_energy(), world.momentum());
                let counts = run_without_overlaps(&mut world, 20, 1.0);
                assert!(counts[1] > 20, "{counts:?}");
                assert_close(world.kinetic_energy() / energy, 1.0, 1e-12);
                let scale = energy / size;
                assert_close_vec(world.momentum() / scale, momentum / scale, 1e-12);
            }
        }
    }
}

#[test]
fn a_crowd_with_lists_of_neighbours_misses_no_impact() {
    for non_additivity in [-0.2, 0.1] {
        let settings = box_of(non_additivity, 7, 0.5);
        let mut world = mixture(settings, non_additivity, 7, [0.5; 3]);
        let counts = run_without_overlaps(&mut world, 4, 1.0);
        assert!(counts.into_iter().all(|count| count > 100), "{counts:?}");
    }
}

#[test]
fn spheres_that_fall_drag_and_bounce_between_walls_miss_no_impact() {
    for non_additivity in PARAMETERS {
        let lattice = box_of(non_additivity, 4, 0.5);
        let Boundary::Periodic { size } = lattice.boundary else { unreachable!() };
        for has_drag in [false, true] {
            let mut world = mixture(Settings::default(), non_additivity, 4, [0.5, 0.3, 0.5]);
            let walls = Shape::Container { size, open: Sides::NONE };
            world.add_collider(Collider::new(walls, Pose::at(DVec3::ZERO))).unwrap();
            world.add_force(Gravity::new(vec(0.0, -0.3, 0.0))).unwrap();
            if has_drag {
                world.add_force(ViscousDrag::new(0.02)).unwrap();
            }
            let counts = run_without_overlaps(&mut world, 40, 0.25);
            assert!(counts[1] > 20, "{counts:?}");
        }
    }
}

#[test]
fn a_pair_with_the_parameter_zero_changes_no_bit() {
    let make = |pair: MaterialPair| {
        let settings = box_of(0.0, 5, 0.5);
        let mut world = mixture(settings, 0.0, 5, [0.5, 0.4, 0.5]);
        world.set_material_pairs([pair]).unwrap();
        (0..20).for_each(|_| drop(world.step(0.5).unwrap().clone()));
        world.state_hash()
    };
    let additive = make(MaterialPair::new(1, 2));
    assert_eq!(make(MaterialPair::new(1, 2).with_non_additivity(0.0)), additive);
    assert_ne!(make(MaterialPair::new(1, 2).with_non_additivity(1e-3)), additive);
}

#[test]
#[cfg(feature = "rayon")]
fn the_bits_depend_on_no_number_of_threads() {
    let contact = box_of(0.3, 14, 0.5).with_rule(Contact::default());
    for settings in [box_of(0.3, 14, 0.5), contact] {
        let hashes = [1, 2, 3, 8].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let mut world = mixture(settings, 0.3, 14, [0.5, 0.4, 0.5]);
                (0..6).for_each(|_| drop(world.step(0.25).unwrap().clone()));
                world.state_hash()
            })
        });
        assert!(hashes.iter().all(|hash| *hash == hashes[0]), "{hashes:?}");
    }
}

#[test]
fn a_snapshot_goes_on_with_the_same_bits() {
    for rule in [Rule::from(Exact::default()), Contact::default().into()] {
        let mut world = mixture(box_of(0.3, 4, 0.5).with_rule(rule), 0.3, 4, [0.5, 0.4, 0.5]);
        (0..10).for_each(|_| drop(world.step(0.25).unwrap().clone()));
        let snapshot = world.snapshot();
        let mut other = world.clone();
        other.restore(&snapshot);
        for _ in 0..10 {
            assert_eq!(world.step(0.25).unwrap().clone(), *other.step(0.25).unwrap());
        }
        assert_eq!(world.state_hash(), other.state_hash());
    }
}

#[test]
fn distances_of_growing_spheres_grow_with_their_radii_and_none_sinks_in() {
    for non_additivity in [-0.5, 0.3] {
        let mut world = mixture(box_of(non_additivity, 4, 0.5), non_additivity, 4, [0.4, 0.3, 0.4]);
        world.set_growth_rate(0.02).unwrap();
        let before = world.kinetic_energy();
        let mut count = 0;
        let mut worked = 0.0;
        for _ in 0..8 {
            let report = world.step(1.0).unwrap();
            worked += report.energy_account.growth;
            count += report.impacts.len();
            let least = least_distance(&world);
            assert!(least > 1.0 - ROUNDING, "{least}");
        }
        assert!(count > 50, "{count}");
        // The work of growth is all that the energy changes by.
        let change = world.kinetic_energy() - before;
        assert!(worked > 0.0);
        assert_close(change / worked, 1.0, 1e-12);
    }
}

#[test]
fn sheared_boxes_miss_no_impact_and_their_stress_is_the_work_of_shear() {
    for non_additivity in [-0.5, 0.3] {
        for rule in [Rule::from(Exact::default()), Contact::default().into()] {
            let is_exact = rule == Exact::default().into();
            let settings = box_of(non_additivity, 5, 0.5).with_rule(rule).with_shear_rate(0.5);
            let mut world = mixture(settings, non_additivity, 5, [0.5, 0.4, 0.5]);
            let Boundary::Periodic { size } = settings.boundary else { unreachable!() };
            let mut meter = StressMeter::new(&world);
            let mut work = 0.0;
            for _ in 0..40 {
                let before = world.kinetic_energy();
                let report = world.step(0.1).unwrap();
                let account = report.energy_account;
                work += account.shear;
                let left = world.kinetic_energy() - before - account.total();
                assert_close(left / before, 0.0, 1e-11);
                meter.add_frame(&world);
                // `contact` leaves its slop.
                let slop = if is_exact { ROUNDING } else { 0.02 };
                let least = least_distance(&world);
                assert!(least > 1.0 - slop, "{least} {rule:?}");
            }
            let stress = meter.stress(None).unwrap().total();
            let expected = -size.element_product() * stress.y_axis.x * 0.5 * meter.time();
            // The stress of motion is sampled at the ends of frames, some of which have an impact.
            assert_close(work / expected, 1.0, 0.03);
        }
    }
}

#[test]
fn a_ball_rests_on_another_at_their_distance() {
    for non_additivity in [-0.4, 0.5] {
        let expected = 0.5 + (1.0 + non_additivity);
        for (settings, tolerance) in [
            (rule(Exact::default()), 1e-9),
            (rule(Exact::default().with_zone_budget(1)), 0.02),
            (rule(Contact::default()), 0.02),
        ] {
            let mut world = world_with(settings, non_additivity);
            world.add_force(Gravity::new(vec(0.0, -9.81, 0.0))).unwrap();
            let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO));
            world.add_collider(floor.with_restitution(0.0)).unwrap();
            let ball = |y: f64, material| {
                Sphere::new(vec(0.0, y, 0.0), 0.5).with_restitution(0.0).with_material(material)
            };
            world.add_sphere(ball(0.5, 1)).unwrap();
            let upper = world.add_sphere(ball(expected + 0.2, 2)).unwrap();
            let (_, left) = account_of_run(&mut world, 120, 1.0 / 60.0);
            let height = world.sphere(upper).unwrap().position.y;
            assert_close(height, expected, tolerance);
            assert_close(left, 0.0, 1e-9);
        }
    }
}

#[test]
fn a_heap_of_two_materials_holds_together_under_every_solver() {
    for non_additivity in [0.0, -0.3, 0.3] {
        for settings in [rule(Exact::default()), rule(Contact::default())] {
            let mut world = mixture(settings, non_additivity, 3, [0.5, 0.4, 0.5]);
            let Boundary::Periodic { size } = box_of(non_additivity, 3, 0.5).boundary else {
                unreachable!()
            };
            let walls = Shape::Container { size, open: Sides::NONE };
            world
                .add_collider(Collider::new(walls, Pose::at(DVec3::ZERO)).with_restitution(0.3))
                .unwrap();
            world.add_force(Gravity::new(vec(0.0, -9.81, 0.0))).unwrap();
            let pairs = [(1, 1, 0.0), (1, 2, non_additivity), (2, 2, 0.0)].map(|(one, two, it)| {
                MaterialPair::new(one, two).with_restitution(0.3).with_non_additivity(it)
            });
            world.set_material_pairs(pairs).unwrap();
            let before = world.total_energy();
            let mut account = carom::EnergyAccount::default();
            for _ in 0..180 {
                account += world.step(1.0 / 60.0).unwrap().energy_account;
                let least = least_distance(&world);
                // The slop of sub-steps, also of zones under `exact`.
                assert!(least > 0.97, "{least}");
            }
            let left = world.total_energy() - before - account.total();
            let scale = world.spheres().masses().iter().sum::<f64>() * 9.81 * size.y;
            // The account of an additive heap with contacts that persist closes to 2e-9.
            assert_close(left / scale, 0.0, 2e-8);
            // Smooth balls still roll about in the box.
            assert!(world.kinetic_energy() < 1e-2 * scale, "{}", world.kinetic_energy());
        }
    }
}

/// Smooth spheres that collapse into a corner between three walls, answered so seldom that they become a zone.
#[test]
fn zones_hold_spheres_at_the_distances_of_the_materials() {
    for size in [libm::ldexp(1.0, -20), 1.0, libm::ldexp(1.0, 20)] {
        for non_additivity in [-0.3, 0.0, 0.3] {
            let zones = Exact::default().with_zone_budget(2_000);
            let radii = [0.5, 0.4, 0.5].map(|it| it * size);
            let mut world = mixture(rule(zones), non_additivity, 4, radii);
            let Boundary::Periodic { size: room } = box_of(non_additivity, 4, 0.5 * size).boundary
            else {
                unreachable!()
            };
            let walls = Shape::Container { size: room, open: Sides::NONE };
            let walls = Collider::new(walls, Pose::at(DVec3::ZERO)).with_restitution(0.3);
            world.add_collider(walls).unwrap();
            world.add_force(Gravity::new(size * vec(-3.0, -9.0, -2.0))).unwrap();
            let pairs = [(1, 1, 0.0), (1, 2, non_additivity), (2, 2, 0.0)].map(|(one, two, it)| {
                MaterialPair::new(one, two).with_restitution(0.3).with_non_additivity(it)
            });
            world.set_material_pairs(pairs).unwrap();
            let mut most = 0;
            for _ in 0..240 {
                most = most.max(world.step(1.0 / 60.0).unwrap().zone_account.spheres);
                let least = least_distance(&world);
                // What sub-steps of zones leave.
                assert!(least > 0.97, "{size} {non_additivity} {least}");
            }
            assert!(most > 20, "{size} {non_additivity}: {most} were stepped");
            // They lie on each other: some of both materials at their distance.
            assert!(least_distance(&world) < 1.01, "{size} {non_additivity}");
        }
    }
}

#[test]
fn emitted_spheres_wait_for_room() {
    let mut world = world_with(rule(Contact::default()), 1.0);
    world.add_sphere(sphere(0.0, 0.5, 1)).unwrap();
    for (place, material, expected) in [(1.9, 2, 0), (2.1, 2, 1), (-1.1, 1, 1)] {
        let emitter = Emitter::new(sphere(place, 0.5, material), 10.0).with_max_spheres(1);
        let mut world = world.clone();
        world.add_emitter(emitter).unwrap();
        world.step(1.0 / 60.0).unwrap();
        assert_eq!(world.spheres().len(), 1 + expected, "{place}");
    }
}

#[test]
fn contacts_of_packings_are_counted_at_the_distances_of_the_materials() {
    let mut world = world_with(Settings::default(), 0.5);
    for (x, y) in [(0.0, 0.0), (1.5, 0.0), (3.0, 0.0), (1.5, 1.5), (1.5, -1.5)] {
        let material = if (x, y) == (1.5, 0.0) { 1 } else { 2 };
        world.add_sphere(Sphere::new(vec(x, y, 0.0), 0.5).with_material(material)).unwrap();
    }
    // The outer spheres have one contact each, and without them the inner one has none.
    assert_eq!(rattlers(&world, 1e-6).unwrap(), 5);
    assert_eq!(world.overlaps(1e-9), []);
    world.set_material_pairs([MaterialPair::new(1, 2).with_non_additivity(0.6)]).unwrap();
    assert_eq!(world.overlaps(0.09).len(), 4);
    assert_close(world.overlaps(0.0)[0].depth, 0.1, 1e-14);
}

#[test]
fn what_is_not_built_is_refused_by_name() {
    let mut world = World::default();
    for number in [f64::NAN, -0.91, 9.1, f64::INFINITY] {
        let pair = MaterialPair::new(1, 2).with_non_additivity(number);
        let error = world.set_material_pairs([pair]).unwrap_err();
        assert!(error.to_string().contains("non_additivity"), "{error}");
    }
    let rough = MaterialPair::new(1, 2).with_non_additivity(0.2).with_friction(0.3);
    let error = world.set_material_pairs([rough]).unwrap_err();
    assert!(error.to_string().contains("non_additivity"), "{error}");
    let rough = |material| sphere(3.0 * f64::from(material), 0.5, material).with_friction(0.3);
    let mut world = world_with(Settings::default(), 0.2);
    world.add_sphere(rough(1)).unwrap();
    world.add_sphere(sphere(6.0, 0.5, 2)).unwrap();
    let error = world.step(0.1).unwrap_err();
    assert!(
        error.to_string().starts_with("sphere 0: `friction` must be 0 for a sphere"),
        "{error}"
    );
    // The pair can say that there is none.
    let smooth = MaterialPair::new(1, 2).with_non_additivity(0.2).with_friction(0.0);
    world.set_material_pairs([smooth]).unwrap();
    world.step(0.1).unwrap();
    let rolls = Friction::sliding(0.3).with_rolling(0.1);
    world.add_sphere(sphere(-3.0, 0.5, 1).with_friction(rolls)).unwrap();
    assert!(world.step(0.1).is_err());

    let world = world_with(Settings::default(), 0.2);
    let error = carom::Tape::start(&world).err();
    assert!(matches!(error, Some(DerivativeError::Unsupported(_))), "{error:?}");

    let boundary = Boundary::Periodic { size: DVec3::splat(2.5) };
    let mut world = world_with(Settings::default().with_boundary(boundary), 0.5);
    world.add_sphere(sphere(0.0, 0.5, 1)).unwrap();
    let error = world.step(0.1).unwrap_err();
    assert!(error.to_string().contains("non_additivity"), "{error}");
}
