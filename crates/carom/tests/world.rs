//! The world as a store: ids, snapshots, hashes, and errors that leave it unchanged.

mod common;

use carom::{
    Bisect, Collider, Contact, DQuat, DVec3, Emitter, Error, Force, Gravity, Pose, Rule, Settings,
    Shape, Sphere, SphereState, ViscousDrag, World,
};
use common::{Numbers, bisect, bisect_all, discrete, vec, world};

/// A busy little world: a box of spheres under gravity and drag, with an emitter above.
fn busy_world(rule: Rule) -> World {
    let mut numbers = Numbers(11);
    let mut world = world(rule);
    world.add_force(Gravity::new(vec(0.0, -9.81, 0.0))).unwrap();
    world.add_force(ViscousDrag::new(0.05)).unwrap();
    world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO))).unwrap();
    let plate = Shape::Rectangle { size_x: 6.0, size_z: 6.0 };
    let tilt = DQuat::from_xyzw(0.1, 0.0, 0.05, 1.0);
    let plate = Collider::new(plate, Pose::at(vec(0.0, 1.0, 0.0)).rotated(tilt));
    world.add_collider(plate.with_restitution(0.7)).unwrap();
    for i in 0..40u32 {
        let cell = vec((i % 4).into(), (i / 16).into(), (i / 4 % 4).into());
        let sphere = Sphere::new(1.1 * cell + vec(-2.0, 3.0, -2.0), numbers.between(0.2, 0.5));
        let sphere = sphere.with_velocity(numbers.vector()).with_density(900.0);
        world.add_sphere(sphere.with_restitution(0.9)).unwrap();
    }
    let sphere = Sphere::new(DVec3::ZERO, 0.1).with_velocity(vec(0.0, -3.0, 0.0));
    let emitter = Emitter::new(sphere, 0.11).with_position(vec(0.3, 8.0, 0.2));
    let emitter = emitter.with_rotation(tilt).with_max_spheres(5);
    world.add_emitter(emitter).unwrap();
    world
}

fn run(world: &mut World, frames: usize) -> u64 {
    let mut impacts = 0;
    for _ in 0..frames {
        impacts += world.step(1.0 / 120.0).unwrap().impacts.len() as u64;
    }
    impacts
}

const RULES: [fn() -> Rule; 4] = [discrete, bisect, bisect_all, Rule::default];

#[test]
fn worlds_that_use_one_working_memory_have_the_bits_of_worlds_with_their_own() {
    let rules: [fn() -> Rule; 4] = [discrete, bisect, Rule::default, || Contact::default().into()];
    for rule in rules {
        let mut own = [0, 25].map(|frames| {
            let mut world = busy_world(rule());
            run(&mut world, frames);
            world
        });
        let mut shared = own.clone();
        let mut spare = World::default();
        for _ in 0..30 {
            for (own, shared) in own.iter_mut().zip(&mut shared) {
                own.step(1.0 / 120.0).unwrap();
                shared.swap_memory(&mut spare);
                shared.step(1.0 / 120.0).unwrap();
                shared.swap_memory(&mut spare);
                assert_eq!(own.state_hash(), shared.state_hash());
                assert_eq!(own.report(), shared.report());
            }
        }
    }
}

#[test]
fn a_change_of_a_collider_that_passes_the_check_is_one_that_the_world_takes() {
    let mut world = World::default();
    let plate = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO));
    let id = world.add_collider(plate.clone()).unwrap();
    let next = Pose::at(DVec3::Y);
    let moving = world.moving_to(id, next, 0.5).unwrap();
    assert_eq!(moving.velocity, 2.0 * DVec3::Y);
    for changed in [
        moving,
        plate.clone().with_restitution(1.5),
        plate.clone().with_friction(-0.1),
        plate.clone().moving(DVec3::NAN, DVec3::ZERO),
        plate.clone().with_pose(Pose::at(DVec3::INFINITY)),
    ] {
        let checked = world.check_collider(id, &changed);
        assert_eq!(checked, world.set_collider(id, changed));
    }
    assert!(world.moving_to(id, Pose::at(DVec3::NAN), 0.5).is_err());
    world.remove_collider(id).unwrap();
    assert!(world.check_collider(id, &plate).is_err());
}

#[test]
fn a_restored_snapshot_repeats_a_hundred_frames_bit_for_bit() {
    for rule in RULES {
        let mut world = busy_world(rule());
        let drag = world.add_force(ViscousDrag::new(0.0)).unwrap();
        run(&mut world, 50);
        let snapshot = world.snapshot();
        let start = world.state_hash();
        assert!(run(&mut world, 100) > 100);
        let first = world.state_hash();
        assert_ne!(first, start);
        // What is changed after the snapshot is undone too: parameters, spheres, colliders.
        world.set_force(drag, ViscousDrag::new(9.0)).unwrap();
        world.remove_sphere(world.spheres().ids()[0]).unwrap();
        world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ONE))).unwrap();
        run(&mut world, 3);
        world.restore(&snapshot);
        assert_eq!(world.state_hash(), start);
        run(&mut world, 100);
        assert_eq!(world.state_hash(), first);
    }
}

#[test]
fn the_same_world_twice_gives_the_same_hash() {
    for rule in RULES {
        let (mut first, mut second) = (busy_world(rule()), busy_world(rule()));
        run(&mut first, 120);
        run(&mut second, 120);
        assert_eq!(first.state_hash(), second.state_hash());
    }
}

#[test]
fn hashes_are_the_same_in_every_build_and_on_every_platform() {
    let hashes = RULES.map(|rule| {
        let mut world = busy_world(rule());
        run(&mut world, 240);
        world.state_hash().to_string()
    });
    // Pinned. They may change only with the physics, and then the changelog says so.
    assert_eq!(
        hashes,
        ["8e9247b68abd2831", "423918761a60ddd0", "116227964bf0d811", "2608317faaa99689"]
    );
}

#[test]
fn one_changed_bit_changes_the_hash() {
    let mut world = busy_world(discrete());
    let before = world.state_hash();
    let id = world.spheres().ids()[7];
    let sphere = world.sphere(id).unwrap();
    let position = vec(sphere.position.x.next_up(), sphere.position.y, sphere.position.z);
    world.set_sphere(id, sphere.with_position(position)).unwrap();
    assert_ne!(world.state_hash(), before);
    world.set_sphere(id, sphere).unwrap();
    assert_eq!(world.state_hash(), before);
}

#[test]
fn ids_stay_valid_while_others_go_and_are_never_given_again() {
    let mut world = world(discrete());
    let add = |world: &mut World, x| world.add_sphere(Sphere::new(vec(x, 0.0, 0.0), 0.1)).unwrap();
    let [a, b, c] = [0.0, 1.0, 2.0].map(|x| add(&mut world, x));
    assert_eq!(world.remove_sphere(b).unwrap().position.x, 1.0);
    assert_eq!(world.sphere(a).unwrap().position.x, 0.0);
    assert_eq!(world.sphere(c).unwrap().position.x, 2.0);
    assert!(matches!(world.sphere(b), Err(Error::Unknown(_))));
    assert!(matches!(world.remove_sphere(b), Err(Error::Unknown(_))));
    let d = add(&mut world, 3.0);
    assert!(![a, b, c].contains(&d));
    assert_eq!(world.spheres().ids(), [a, c, d]);
}

/// Fails after a while, as a mistaken user's force would.
#[derive(Debug)]
struct Explosive;

impl Force for Explosive {
    fn on(&self, sphere: &SphereState, time: f64) -> DVec3 {
        if time < 0.5 { DVec3::ZERO } else { sphere.position / 0.0 }
    }
}

#[test]
fn a_step_that_would_overflow_is_refused_and_the_state_before_it_kept() {
    for rule in RULES {
        let mut world = busy_world(rule());
        let explosive = world.add_force(Explosive).unwrap();
        run(&mut world, 60);
        let (before, time) = (world.state_hash(), world.time());
        let ids = world.spheres().ids().to_vec();
        let error = world.step(1.0 / 120.0).unwrap_err();
        assert!(matches!(error, Error::NonFiniteState { quantity: "velocity", .. }), "{error}");
        assert_eq!((world.state_hash(), world.time()), (before, time));
        assert_eq!(world.spheres().ids(), ids);
        assert!(world.report().impacts.is_empty());
        // The world stays usable: without the offending force it goes on, as if never disturbed.
        world.remove_force(explosive).unwrap();
        run(&mut world, 10);
        let mut undisturbed = busy_world(rule());
        run(&mut undisturbed, 70);
        if matches!(rule(), Rule::Exact(_)) {
            // A change of forces begins all flights anew, which rounds differently: by some 1e-15,
            // which ten frames of impacts may multiply by a thousand.
            let pairs = world.spheres().positions().iter().zip(undisturbed.spheres().positions());
            pairs.for_each(|(a, b)| assert!(a.distance(*b) < 1e-9));
        } else {
            assert_eq!(world.state_hash(), undisturbed.state_hash());
        }
    }
}

#[test]
fn a_speed_beyond_all_numbers_is_refused() {
    let mut world = world(discrete());
    let id = world.add_sphere(Sphere::new(DVec3::ZERO, 1.0).with_velocity(vec(1e308, 0.0, 0.0)));
    let error = world.step(10.0).unwrap_err().to_string();
    assert!(error.contains(&format!("sphere {}", id.unwrap())) && error.contains("position"));
    assert_eq!(world.time(), 0.0);
}

#[test]
fn every_field_of_a_sphere_is_checked_and_named() {
    let good = Sphere::new(DVec3::ZERO, 1.0);
    let bad = [f64::NAN, f64::INFINITY, -1.0, 0.0];
    let mut cases: Vec<(&str, Sphere)> = vec![
        ("position", good.with_position(vec(0.0, f64::NAN, 0.0))),
        ("velocity", good.with_velocity(vec(f64::INFINITY, 0.0, 0.0))),
        ("restitution", good.with_restitution(1.1)),
        ("restitution", good.with_restitution(-0.1)),
        ("restitution", good.with_restitution(f64::NAN)),
        // The volume of so small a sphere is zero.
        ("density times volume", good.with_radius(1e-200).with_density(1.0)),
    ];
    for value in bad {
        cases.push(("radius", good.with_radius(value)));
        cases.push(("mass", good.with_mass(value)));
        cases.push(("density", good.with_density(value)));
    }
    let mut world = busy_world(discrete());
    let before = world.state_hash();
    let existing = world.spheres().ids()[3];
    for (field, sphere) in cases {
        let refusals = [
            world.add_sphere(sphere).map(|_| ()).unwrap_err(),
            world.set_sphere(existing, sphere).unwrap_err(),
        ];
        for (error, id) in refusals.into_iter().zip(["sphere 40", "sphere 3"]) {
            let text = error.to_string();
            assert!(text.starts_with(id) && text.contains(&format!("`{field}`")), "{text}");
        }
    }
    assert_eq!(world.state_hash(), before);
}

#[test]
fn every_field_of_colliders_forces_emitters_and_settings_is_checked_and_named() {
    let mut world = World::default();
    let collider = |shape| Collider::new(shape, Pose::at(DVec3::ZERO));
    let plane = collider(Shape::HalfSpace);
    let zero_rotation = Pose::at(DVec3::ZERO).rotated(DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0));
    let rectangle = |size_x, size_z| collider(Shape::Rectangle { size_x, size_z });
    let colliders = [
        ("radius", collider(Shape::Sphere { radius: 0.0 })),
        ("size_x", rectangle(-1.0, 1.0)),
        ("size_z", rectangle(1.0, f64::NAN)),
        ("size.y", collider(Shape::Box { size: vec(1.0, 0.0, 1.0) })),
        ("position", plane.clone().with_pose(Pose::at(vec(0.0, 0.0, f64::NAN)))),
        ("rotation", plane.clone().with_pose(zero_rotation)),
        ("restitution", plane.with_restitution(2.0)),
    ];
    for (field, collider) in colliders {
        let text = world.add_collider(collider).unwrap_err().to_string();
        assert!(text.starts_with("collider 0") && text.contains(&format!("`{field}`")), "{text}");
    }
    assert_eq!(world.colliders().len(), 0);

    let text = world.add_force(ViscousDrag::new(-1.0)).unwrap_err().to_string();
    assert!(text.starts_with("force 0") && text.contains("`coefficient`"), "{text}");
    let text = world.add_force(Gravity::new(DVec3::NAN)).unwrap_err().to_string();
    assert!(text.contains("`acceleration`"), "{text}");

    let good = Emitter::new(Sphere::new(DVec3::ZERO, 1.0), 1.0);
    let emitters = [
        ("radius", good.with_sphere(Sphere::new(DVec3::ZERO, -1.0))),
        ("position", good.with_position(DVec3::NAN)),
        ("rotation", good.with_rotation(DQuat::from_xyzw(0.0, f64::NAN, 0.0, 0.0))),
        ("period", good.with_period(0.0)),
        ("max_spheres", good.with_max_spheres(Some(0))),
    ];
    for (field, emitter) in emitters {
        let text = world.add_emitter(emitter).unwrap_err().to_string();
        assert!(text.starts_with("emitter 0") && text.contains(&format!("`{field}`")), "{text}");
    }

    let good = Bisect::default();
    let settings = [
        ("tolerance", good.with_tolerance(f64::NAN)),
        ("max_halvings", good.with_max_halvings(0)),
        ("max_impacts", good.with_max_impacts(0)),
    ];
    for (field, bisect) in settings {
        let settings = Settings::default().with_rule(Rule::Bisect(bisect));
        let text = world.set_settings(settings).unwrap_err().to_string();
        assert!(text.starts_with("settings") && text.contains(&format!("`{field}`")), "{text}");
        assert!(World::new(settings).is_err());
    }
    assert_eq!(*world.settings(), Settings::default());

    for dt in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let text = world.step(dt).unwrap_err().to_string();
        assert!(text.starts_with("step") && text.contains("`dt`"), "{text}");
    }
}

#[test]
fn unknown_ids_are_errors_that_name_them() {
    let mut twin = busy_world(discrete());
    let force = twin.add_force(Gravity::new(DVec3::ZERO)).unwrap();
    let collider = twin.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)));
    let collider = collider.unwrap();
    let plane = twin.collider(collider).unwrap();
    let mut world = busy_world(discrete());
    let texts = [
        world.set_force(force, Gravity::new(DVec3::ZERO)).unwrap_err().to_string(),
        world.set_collider(collider, plane.clone()).unwrap_err().to_string(),
        world.set_pose(collider, plane.pose).unwrap_err().to_string(),
    ];
    for (text, name) in texts.iter().zip(["force 2", "collider 2", "collider 2"]) {
        assert!(text.contains(name), "{text}");
    }
}

#[test]
fn forces_colliders_and_emitters_can_be_looked_at_changed_and_removed() {
    let mut world = busy_world(discrete());
    let (drag, force) = world.forces().nth(1).unwrap();
    assert!(format!("{force:?}").starts_with("ViscousDrag"));
    world.remove_force(drag).unwrap();
    assert_eq!(world.remove_force(drag), Err(Error::Unknown(carom::Subject::Force(drag))));
    assert_eq!(world.forces().len(), 1);
    // An id is never given again.
    assert_ne!(world.add_force(ViscousDrag::new(1.0)).unwrap(), drag);

    let (plane, plate) = (world.colliders().next().unwrap().0, world.colliders().nth(1).unwrap().0);
    let removed = world.remove_collider(plane).unwrap();
    assert_eq!(removed.shape, Shape::HalfSpace);
    assert!(world.collider(plane).is_err());
    assert_eq!(world.collider(plate).unwrap().restitution, 0.7);
    let again = world.add_collider(removed).unwrap();
    assert_ne!(again, plane);
    assert_eq!(world.colliders().map(|(id, _)| id).collect::<Vec<_>>(), [plate, again]);

    let (id, emitter) = world.emitters().next().map(|(id, emitter)| (id, *emitter)).unwrap();
    world.step(0.01).unwrap();
    world.set_emitter(id, emitter.with_period(1e9)).unwrap();
    assert_eq!(world.step(0.01).unwrap().emitted.len(), 1);
    assert_eq!(world.step(1.0).unwrap().emitted.len(), 0);
    assert_eq!(world.remove_emitter(id).unwrap().period, 1e9);
    assert!(world.set_emitter(id, emitter).is_err());
    assert_eq!(world.emitters().len(), 0);
}

#[test]
fn a_clock_that_would_overflow_is_refused() {
    let mut world = world(discrete());
    world.add_sphere(Sphere::new(DVec3::ZERO, 1.0)).unwrap();
    world.step(1e308).unwrap();
    let text = world.step(1e308).unwrap_err().to_string();
    assert!(text.contains("`dt` must be so short that the time stays finite"), "{text}");
    assert_eq!(world.time(), 1e308);
}

#[test]
fn a_collider_put_elsewhere_collides_there() {
    let mut world = world(discrete());
    let plane = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO));
    let plane = world.add_collider(plane).unwrap();
    let ball = Sphere::new(vec(0.0, 5.0, 0.0), 0.5).with_velocity(vec(0.0, -1.0, 0.0));
    let ball = world.add_sphere(ball).unwrap();
    world.set_pose(plane, Pose::at(vec(0.0, 4.0, 0.0))).unwrap();
    world.step(1.0).unwrap();
    assert_eq!(world.sphere(ball).unwrap().velocity.y, 1.0);
    assert_eq!(world.sphere(ball).unwrap().position.y, 4.5);
}

#[test]
fn overlaps_are_listed_with_their_depth() {
    let mut world = world(discrete());
    world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO))).unwrap();
    for (x, y) in [(0.0, 1.0), (0.75, 1.0), (5.0, 0.25), (8.0, 0.5)] {
        world.add_sphere(Sphere::new(vec(x, y, 0.0), 0.5)).unwrap();
    }
    let depths: Vec<f64> = world.overlaps(1e-9).iter().map(|overlap| overlap.depth).collect();
    assert_eq!(depths, [0.25, 0.25]);
    assert_eq!(world.overlaps(0.3), []);
}

#[test]
fn a_sphere_inside_a_solid_box_overlaps_it_once() {
    let mut world = world(discrete());
    let solid = Shape::Box { size: vec(4.0, 4.0, 4.0) };
    world.add_collider(Collider::new(solid, Pose::at(DVec3::ZERO))).unwrap();
    world.add_sphere(Sphere::new(vec(0.0, 1.75, 0.0), 0.125)).unwrap();
    world.add_sphere(Sphere::new(vec(0.0, 2.0, 0.0), 0.125)).unwrap();
    let depths: Vec<f64> = world.overlaps(0.0).iter().map(|overlap| overlap.depth).collect();
    assert_eq!(depths, [0.375, 0.125]);
    assert!(world.meets_collider(DVec3::ZERO, 0.01));
    assert!(!world.meets_collider(vec(0.0, 2.2, 0.0), 0.125));
}

#[test]
fn several_colliders_change_at_once_or_not_at_all() {
    let mut world = World::new(Settings::default()).unwrap();
    let plate = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO));
    let first = world.add_collider(plate.clone()).unwrap();
    let second = world.add_collider(plate.clone()).unwrap();
    let (soft, bad) = (plate.clone().with_restitution(0.5), plate.clone().with_restitution(2.0));
    assert!(world.set_colliders(&[(first, soft.clone()), (second, bad)]).is_err());
    assert_eq!(world.collider(first).unwrap(), plate);
    world.set_colliders(&[(first, soft.clone()), (second, soft.clone())]).unwrap();
    assert!(world.colliders().all(|(_, collider)| *collider == soft));
}

#[test]
fn many_spheres_are_taken_out_at_once_or_none() {
    let mut world = busy_world(bisect());
    let ids = world.spheres().ids().to_vec();
    let unknown = world.add_sphere(Sphere::new(vec(0.0, 50.0, 0.0), 0.1)).unwrap();
    world.remove_spheres(&[unknown]).unwrap();
    assert_eq!(world.spheres().ids(), ids);
    let refused = world.remove_spheres(&[ids[3], unknown]);
    assert!(matches!(refused, Err(Error::Unknown(_))), "{refused:?}");
    assert_eq!(world.spheres().len(), ids.len());
    let mut one_by_one = world.clone();
    for id in [ids[7], ids[3]] {
        one_by_one.remove_sphere(id).unwrap();
    }
    // Twice named is once taken out.
    world.remove_spheres(&[ids[3], ids[7], ids[3]]).unwrap();
    assert_eq!(world.state_hash(), one_by_one.state_hash());
    run(&mut world, 30);
    run(&mut one_by_one, 30);
    assert_eq!(world.state_hash(), one_by_one.state_hash());
}
